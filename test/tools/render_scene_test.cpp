#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tool_world.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

class RenderScene : public ToolWorld {
 protected:
  ProgramResult render(const std::string& arguments) const { return run(RENDER_SCENE_PROGRAM, arguments); }
};

// Parts that are none of the package's: a base of two, and one of a single part under another name.
TEST_F(RenderScene, ShowsOwnPartsWithoutAnOption) {
  write("one.yaml", "objects: [{name: thing, mesh: " + std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) +
                        "/models/flange.ply, unit: mm}]\n");
  for (const std::string base : {"objects", "one"}) {
    const ProgramResult result =
        render("--objects " + base + ".yaml --samples 1 --out " + base + "/pictures");
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(cv::imread(path(base + "/pictures/000000.png")).cols, 640);
    EXPECT_TRUE(std::filesystem::exists(path(base + "/pictures/camera.yaml")));
    const auto truth = nlohmann::json::parse(readText(path(base + "/pictures/000000.truth.json")));
    EXPECT_FALSE(truth.at("objects").empty());
  }
}

TEST_F(RenderScene, ThePackagesOwnScenesNeedItsParts) {
  for (const char* set : {"demo", "golden"}) {
    const ProgramResult result = render(std::string("--objects objects.yaml --out pictures --set ") + set);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err, HasSubstr("leave --set out"));
  }
}

}  // namespace
}  // namespace monocular_eye_hand
