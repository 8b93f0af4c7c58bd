#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/parameters/task.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

const std::string kTaskConfig = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/task.yaml";

TaskParameters someTask() {
  TaskParameters parameters;
  parameters.objects = "objects.yaml";
  parameters.urdf = "arm.urdf";
  return parameters;
}

template <class Call>
std::string refusalOf(Call call) {
  try {
    call();
  } catch (const BadInput& e) {
    return e.what();
  }
  return "";
}

// Defaults stand in the structs; the shipped file repeats them for people and must not drift.
TEST(TaskParameters, ShippedFileHoldsTheDefaults) {
  TaskParameters parameters = someTask();
  parameters.centre.fill(0);
  readOptions(loadYaml(kTaskConfig), &parameters);
  EXPECT_EQ(writeOptions(parameters), writeOptions(someTask()));
}

TEST(TaskParameters, ShippedFileNamesEveryParameter) {
  const OptionTree file = loadYaml(kTaskConfig), all = writeOptions(TaskParameters());
  for (const auto& entry : all.map) {
    if (entry.first == "objects" || entry.first == "urdf" || entry.first == "arm") continue;
    const OptionTree* value = file.find(entry.first);
    ASSERT_NE(value, nullptr) << entry.first;
    for (const auto& inner : entry.second.map)
      EXPECT_NE(value->find(inner.first), nullptr) << entry.first << "." << inner.first;
  }
}

TEST(TaskParameters, UnknownKeysAreRefusedByName) {
  const auto refused = [](const std::string& yaml) {
    return refusalOf([&] {
      TaskParameters parameters = someTask();
      readOptions(parseYaml(yaml), &parameters);
    });
  };
  EXPECT_EQ(refused("{settle: 0.2, clear_frame: {max_rounds: 3}, views: {min_distance: 0.3}}"), "");
  EXPECT_THAT(refused("{setle: 0.2}"), HasSubstr("unknown key 'setle'; did you mean 'settle'?"));
  EXPECT_THAT(refused("{clear_frame: {most_round: 3}}"), HasSubstr("'clear_frame.most_round'"));
  EXPECT_THAT(refused("{views: {near: 0.3}}"), HasSubstr("'views.near'"));
  EXPECT_THAT(refused("{views: {min_distance: far}}"), HasSubstr("views.min_distance"));
}

TEST(TaskParameters, AreChecked) {
  const auto refused = [](const std::string& text, auto change) {
    TaskParameters parameters = someTask();
    EXPECT_NO_THROW(parameters.check());
    change(&parameters);
    EXPECT_THAT(refusalOf([&] { parameters.check(); }), HasSubstr(text));
  };
  using P = TaskParameters;
  refused("objects is not set", [](P* p) { p->objects.clear(); });
  refused("urdf is not set", [](P* p) { p->urdf.clear(); });
  refused("base_frame", [](P* p) { p->base_frame.clear(); });
  refused("centre", [](P* p) { p->centre[1] = std::nan(""); });
  refused("settle = -0.1", [](P* p) { p->settle = -0.1; });
  refused("look_timeout = 0", [](P* p) { p->look_timeout = 0; });
  refused("answer_timeout", [](P* p) { p->answer_timeout = -1; });
  refused("motion_timeout", [](P* p) { p->motion_timeout = std::nan(""); });
  refused("holding_width", [](P* p) { p->holding_width = 0; });
  refused("state_max_age", [](P* p) { p->state_max_age = 0; });
}

}  // namespace
}  // namespace monocular_eye_hand
