#include <fmt/format.h>

// Renders scenes with known truth: the pictures that ship with the package, or random ones.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/camera_file.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "monocular_eye_hand/simulation/render/truth.h"
#include "monocular_eye_hand/simulation/scenes/random_scene.h"
#include "tools/bop_output.h"
#include "tools/demo_scenes.h"

namespace meh = monocular_eye_hand;
namespace fs = std::filesystem;

namespace {

struct Arguments {
  std::string objects, out, set = "random", level = "easy", camera, appearance = "plain";
  unsigned seed = 1;
  int count = 1, samples = 0;
  meh::BopRequest bop;
};

constexpr int kPictureSamples = 6;

meh::Camera defaultCamera() { return {640, 480, 700, 700, 319.5, 239.5, meh::DistortionModel::kNone, {}}; }

// A short lens as industrial cameras have it: straight lines bend by some 20 px at the border.
meh::Camera wideAngleCamera() {
  return {
      640, 480, 620, 621, 322.7, 236.4, meh::DistortionModel::kPlumbBob, {-0.28, 0.08, 0.001, -0.0005, 0}};
}

meh::SceneLevel levelOf(const std::string& name) {
  if (name == "easy") return meh::SceneLevel::kEasy;
  if (name == "mixed") throw meh::BadInput("--level mixed goes with --bop");
  return name == "medium" ? meh::SceneLevel::kMedium : meh::SceneLevel::kHard;
}

std::vector<meh::NamedMesh> readMeshes(const std::string& objects) {
  std::vector<meh::NamedMesh> meshes;
  for (const meh::ObjectEntry& entry : meh::readObjectEntries(objects))
    meshes.push_back({entry.name, std::make_shared<meh::Mesh>(meh::loadMesh(entry.mesh, entry.unit))});
  return meshes;
}

std::vector<meh::DemoScene> chooseScenes(const Arguments& arguments) {
  const std::vector<meh::NamedMesh> meshes = readMeshes(arguments.objects);
  if (arguments.set == "demo") return meh::demoScenes(meshes);
  if (arguments.set == "golden") return meh::goldenScenes(meshes);
  std::vector<meh::DemoScene> scenes;
  for (int k = 0; k < arguments.count; ++k) {
    meh::RandomSceneOptions options;
    options.level = levelOf(arguments.level);
    if (arguments.appearance == "mixed") options.appearance = meh::Appearance::kMixed;
    scenes.push_back(
        {fmt::format("{:06}", k), meh::randomScene(meshes, arguments.seed + unsigned(k), options)});
  }
  return scenes;
}

void renderAll(const Arguments& arguments) {
  const std::vector<meh::DemoScene> scenes = chooseScenes(arguments);
  const meh::Camera camera = arguments.camera.empty() ? defaultCamera() : meh::loadCamera(arguments.camera);
  fs::create_directories(arguments.out);
  const std::string folder = arguments.out + "/";
  meh::writeCamera(folder + "camera.yaml", camera);

  meh::RenderOptions options;
  options.samples = options.edge_samples = arguments.samples > 0 ? arguments.samples : kPictureSamples;
  options.ambient_occlusion = options.samples >= 5;
  options.seed = arguments.seed;

  for (const meh::DemoScene& demo : scenes) {
    const meh::Camera& used = demo.distorted ? wideAngleCamera() : camera;
    if (demo.distorted) meh::writeCamera(folder + "camera_" + demo.file + ".yaml", used);
    const meh::RenderedImage image = meh::renderScene(demo.scene, used, options);

    const std::string picture = folder + demo.file + ".png";
    if (!cv::imwrite(picture, image.grey, {cv::IMWRITE_PNG_COMPRESSION, 9}))
      throw meh::BadInput(picture + ": cannot be written");

    const std::vector<meh::TruthObject> truth = meh::truthOf(demo.scene, image);
    meh::writeTruth(folder + demo.file + ".truth.json", truth);
    std::cout << picture << ": " << truth.size() << " known objects\n";
  }
}

void renderBop(const Arguments& arguments) {
  if (arguments.set != "random") throw meh::BadInput("--bop: only random scenes (--set random) are written");
  if (!arguments.camera.empty()) throw meh::BadInput("--bop draws its cameras: leave --camera out");
  meh::BopRequest request = arguments.bop;
  request.objects = arguments.objects;
  request.count = arguments.count;
  request.seed = arguments.seed;
  request.level = arguments.level;
  request.mixed_appearance = arguments.appearance == "mixed";
  if (arguments.samples > 0) request.samples = arguments.samples;
  request.edge_samples = std::max(request.samples, request.edge_samples);
  meh::renderBopScene(request);
}

void addPictureOptions(CLI::App* app, Arguments* arguments) {
  app->add_option("--objects", arguments->objects, "model base (YAML)")->required();
  app->add_option("--out", arguments->out, "folder for NAME.png, NAME.truth.json and camera.yaml");

  app->add_option("--set", arguments->set,
                  "random scenes of these parts, or the pictures of the package: demo, golden")
      ->check(CLI::IsMember({"random", "demo", "golden"}))
      ->capture_default_str();
  app->add_option("--level", arguments->level, "of random scenes; mixed: one after the other, with --bop")
      ->check(CLI::IsMember({"easy", "medium", "hard", "mixed"}))
      ->capture_default_str();
  app->add_option("--appearance", arguments->appearance,
                  "of random scenes; mixed: half of the parts with prints, wear, rounded edges, gloss or "
                  "translucent, clutter of a workshop, varied light")
      ->check(CLI::IsMember({"plain", "mixed"}))
      ->capture_default_str();
  app->add_option("--count", arguments->count, "random scenes")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app->add_option("--seed", arguments->seed, "of the first random scene and of the noise")
      ->capture_default_str();

  app->add_option("--camera", arguments->camera, "calibration YAML (default: 640x480, f = 700 px)");
  app->add_option(
         "--samples", arguments->samples,
         "per pixel along each axis; from 5 on with soft ambient shadows (default: 6; with --bop: 2, "
         "and 4 at edges)")
      ->check(CLI::Range(1, 16));
}

void addBopOptions(CLI::App* app, meh::BopRequest* bop) {
  app->add_option("--bop", bop->dataset,
                  "folder of a data set in the BOP format, instead of --out: --count images of random scenes "
                  "with drawn cameras in one scene folder");
  app->add_option("--split", bop->split, "of the data set")->capture_default_str();
  app->add_option("--scene", bop->scene,
                  "number of the scene folder; another number or split, other pictures")
      ->check(CLI::Range(0, 999999))
      ->capture_default_str();
  app->add_option("--distractors", bop->distractors,
                  "model base of further parts: up to three stand in each scene and are not in the truth");
  app->add_option("--sizes", bop->sizes, "of images, WIDTHxHEIGHT:WEIGHT,...; one is drawn per scene folder")
      ->capture_default_str();
  app->add_option("--part-pixels", bop->part_pixels,
                  "smallest and largest diameter of a part, roughly, in an image of 640 px")
      ->check(CLI::Range(2.0, 640.0))
      ->capture_default_str();
  app->add_option("--piled", bop->piled, "share of the parts of hard scenes that lie on or lean on others")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Renders grey images of scenes with known objects, their camera and their truth."};
  addPictureOptions(&app, &arguments);
  addBopOptions(&app, &arguments.bop);
  CLI11_PARSE(app, argc, argv);
  try {
    if (arguments.out.empty() == arguments.bop.dataset.empty())
      throw meh::BadInput("give either --out FOLDER or --bop DATASET");
    if (arguments.bop.dataset.empty())
      renderAll(arguments);
    else
      renderBop(arguments);
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "render_scene: " << e.what() << "\n";
    return 1;
  }
}
