#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tool_world.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

class ClearFrameTool : public ToolWorld {
 protected:
  ProgramResult clearFrame(const std::string& arguments) const { return run(CLEAR_FRAME_PROGRAM, arguments); }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(readText(path(name))); }

  /// A task in which a bridge was carried out, as scripts/clear_frame.py writes it down.
  nlohmann::json record() const {
    const nlohmann::json stood{{"position", {0.5, 0, 0.3}}, {"quaternion", {0, 0, 0, 1}}};
    const nlohmann::json lies{{"position", {0.5, 0.3, 0.3}}, {"quaternion", {0, 0, 0, 1}}};
    const auto bridge = [](const nlohmann::json& pose, bool in_zone) {
      return nlohmann::json{{"label", "bridge_0"},
                            {"name", "bridge"},
                            {"pose", pose},
                            {"held", false},
                            {"in_drop_zone", in_zone}};
    };

    const nlohmann::json grasp{{"position", {0.5, 0, 0.35}}, {"quaternion", {1, 0, 0, 0}}};
    const nlohmann::json result{{"outcome", 0}, {"reason", ""}, {"planning_s", 0.3}, {"motion_s", 4.0}};
    const nlohmann::json pick{{"name", "bridge"},
                              {"instance", 0},
                              {"object", stood},
                              {"grasp", grasp},
                              {"truth", {bridge(stood, false)}},
                              {"result", result}};
    const nlohmann::json end{{"reason", "nothing known is left"},
                             {"cell_seconds", 20.5},
                             {"rounds", 2},
                             {"told", nlohmann::json::array()}};
    return {{"seed", 7}, {"collisions", 0}, {"truth", {bridge(lies, true)}}, {"picks", {pick}}, {"end", end}};
  }
};

TEST_F(ClearFrameTool, reports_on_a_record_by_exit_code_table_and_json) {
  nlohmann::json written = record();
  write("record.json", written.dump());
  const std::string arguments = "--objects objects.yaml --record record.json --json report.json";
  const ProgramResult good = clearFrame(arguments);
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("carried out"));
  EXPECT_THAT(good.out, HasSubstr("nothing known is left; 0 collisions; 20.5 s of cell time, 2 rounds"));
  const nlohmann::json report = json("report.json");
  EXPECT_EQ(report["seed"], 7);
  EXPECT_EQ(report["cleared"], true);
  EXPECT_EQ(report["objects"].at(0)["label"], "bridge_0");
  EXPECT_NEAR(report["picks"].at(0)["grasp_error_mm"], 0, 1e-9);

  written["collisions"] = 1;
  write("record.json", written.dump());
  EXPECT_EQ(clearFrame(arguments).code, 1);
  written["picks"][0]["name"] = "spoon";
  written["picks"][0]["truth"][0]["name"] = "spoon";
  write("record.json", written.dump());
  const ProgramResult unknown = clearFrame(arguments);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no object is named 'spoon'"));
}

TEST_F(ClearFrameTool, bad_arguments_end_with_two) {
  const auto refused = [&](const std::string& arguments, const std::string& text) {
    const ProgramResult result = clearFrame(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(text)) << arguments;
  };
  refused("--seed -2", "--seed");
  refused("--seed 1 --seeds 0-3", "excludes");
  refused("--seeds 3-1", "of the form A-B");
  refused("--seeds all", "of the form A-B");
  refused("--record missing.json", "missing.json");
  refused("--config missing", "missing");
  refused("--cell missing.yaml", "missing.yaml");
  refused("--frames", "--frames");
}

TEST_F(ClearFrameTool, unknown_keys_are_refused_by_name_and_those_of_nodes_are_not) {
  const std::string source = MONOCULAR_EYE_HAND_SOURCE_DIR;
  std::filesystem::copy(source + "/config", path("config"));
  write("config/task.yaml", readText(source + "/config/task.yaml") + "most_round: 3\n");
  const ProgramResult refused = clearFrame("--config config --objects objects.yaml");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("config/task.yaml: unknown key 'most_round'"));
}

TEST_F(ClearFrameTool, a_scene_that_cannot_be_arranged_ends_with_two) {
  write("cell.yaml", "random: {objects: 20, gap: 0.05}\n");
  const ProgramResult full = clearFrame("--cell cell.yaml --seeds 0-0");
  EXPECT_EQ(full.code, 2) << full.out;
  EXPECT_THAT(full.err, HasSubstr("seed 0: "));
}

TEST_F(ClearFrameTool, help_tells_the_exit_codes) {
  const ProgramResult help = clearFrame("--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, HasSubstr("--seeds"));
  EXPECT_THAT(help.out, HasSubstr("2 when a scene could not be run"));
}

}  // namespace
}  // namespace monocular_eye_hand
