#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/parameters/planner.h"

namespace monocular_eye_hand {
namespace {

PlannerParameters usable() {
  PlannerParameters parameters;
  parameters.objects = "objects.yaml";
  parameters.urdf = "arm.urdf";
  return parameters;
}

std::string refusal(const std::string& yaml) {
  PlannerParameters parameters = usable();
  try {
    readOptions(parseYaml(yaml), &parameters);
  } catch (const BadInput& e) {
    return e.what();
  }
  return "";
}

TEST(PlannerParameters, TheFileHoldsTheDefaults) {
  OptionTree tree = loadYaml(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/planner.yaml");
  PlannerParameters parameters = usable();
  readOptions(tree, &parameters);
  EXPECT_EQ(writeOptions(parameters), writeOptions(usable()));
  for (const auto& entry : writeOptions(usable()).map) {
    const bool given_elsewhere = entry.first == "objects" || entry.first == "urdf" || entry.first == "arm";
    EXPECT_EQ(tree.find(entry.first) == nullptr, given_elsewhere) << entry.first;
  }
}

TEST(PlannerParameters, RefusesByName) {
  EXPECT_EQ(refusal("{}"), "");
  EXPECT_NE(refusal("tabel: {x: 1}").find("did you mean 'table'"), std::string::npos);
  EXPECT_NE(refusal("table: {length: 0}").find("length = 0"), std::string::npos);
  EXPECT_NE(refusal("drop_zone: {columns: 0}").find("columns = 0"), std::string::npos);
  EXPECT_NE(refusal("drop_above: 0.0005").find("drop_above"), std::string::npos);
  EXPECT_NE(refusal("execution: {squeeze: 0.001}").find("width_tolerance"), std::string::npos);
  EXPECT_NE(refusal("execution: {follow: {lag: -1}}").find("lag = -1"), std::string::npos);
  EXPECT_NE(refusal("planning: {padding: -1}").find("padding"), std::string::npos);
  EXPECT_NE(refusal("boxes: [{name: table, size: [1, 1, 1]}]").find("'table' stands twice"),
            std::string::npos);
  EXPECT_NE(refusal("boxes: [{name: post, size: [1, 0, 1]}]").find("size = 0"), std::string::npos);
  EXPECT_NE(refusal("objects: ''").find("objects is not set"), std::string::npos);
  EXPECT_NE(refusal("urdf: ''").find("urdf is not set"), std::string::npos);
}

}  // namespace
}  // namespace monocular_eye_hand
