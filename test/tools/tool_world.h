#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>

#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "monocular_eye_hand/simulation/render/truth.h"
#include "support/camera.h"

namespace monocular_eye_hand {

inline std::string readText(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What a program left behind.
struct ProgramResult {
  int code = -1;
  std::string out, err;
};

/// A folder with a model base of two parts, a camera and rendered pictures of a bridge alone on a plain
/// table, for the tools to work on. Compiled models are cached beside it, for all the tests of a program.
class ToolWorld : public testing::Test {
 protected:
  ToolWorld() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("tools_") + info->test_suite_name() + "_" + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    const std::string models = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/models/";
    write("objects.yaml", "objects:\n  - {name: bridge, mesh: " + models + "bridge.ply, unit: mm}\n" +
                              "  - {name: bracket, mesh: " + models + "bracket.ply, unit: mm}\n");
    writeCamera(path("camera.yaml"), camera_);
  }
  ~ToolWorld() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }

  /// Writes the picture and returns where the bridge is in it.
  Rigid3 renderBridge(const std::string& name, double azimuth) const {
    SceneObject bridge;
    bridge.name = "bridge";
    bridge.model = 0;
    bridge.mesh = std::make_shared<Mesh>(
        loadMesh(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/models/bridge.ply", "mm"));
    Scene scene;
    scene.objects = {bridge};
    scene.lights = {Light{}};
    scene.world_from_camera = lookFrom(azimuth, 0.8, 0.55, {0, 0, 0.03});
    save(name, renderScene(scene, camera_).grey);
    return scene.cameraFromObject(0);
  }
  void save(const std::string& name, const cv::Mat& picture) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    ASSERT_TRUE(cv::imwrite(path(name), picture)) << name;
  }

  /// Runs a program with the arguments, from the folder.
  ProgramResult run(const std::string& program, const std::string& arguments) const {
    const std::string cache = testing::TempDir() + "/tools_test_cache";
    const std::string command = "cd '" + folder_.string() + "' && XDG_CACHE_HOME='" + cache + "' '" +
                                program + "' " + arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    ProgramResult result;
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.out = readText(path("stdout.txt"));
    result.err = readText(path("stderr.txt"));
    return result;
  }

  std::filesystem::path folder_;
  const Camera camera_ = centredCamera(640, 480, 700);
};

}  // namespace monocular_eye_hand
