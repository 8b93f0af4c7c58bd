#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/parameters/eye_hand.h"
#include "monocular_eye_hand/recognition/options.h"

namespace monocular_eye_hand {
namespace {

const std::string kSource = MONOCULAR_EYE_HAND_SOURCE_DIR;

EyeHandParameters someEyeHand() {
  EyeHandParameters parameters;
  parameters.objects = kSource + "/config/objects.yaml";
  parameters.urdf = kSource + "/urdf/puma560.urdf";
  return parameters;
}

// Every key of `whole` is in `part`, but for `left_out`.
void expectNames(const OptionTree& whole, const OptionTree& part, const std::string& where,
                 const std::vector<std::string>& left_out) {
  for (const auto& entry : whole.map) {
    const std::string key = where + entry.first;
    if (std::find(left_out.begin(), left_out.end(), key) != left_out.end()) continue;
    const OptionTree* value = part.find(entry.first);
    ASSERT_NE(value, nullptr) << key;
    if (entry.second.kind == OptionTree::Kind::kMap) expectNames(entry.second, *value, key + ".", left_out);
  }
}

// Defaults stand in the structs; the shipped file repeats them for people and must not drift.
TEST(EyeHandParameters, ShippedFileHoldsTheDefaults) {
  EyeHandParameters parameters = someEyeHand();
  readOptions(loadYaml(kSource + "/config/eye_hand.yaml"), &parameters);
  EXPECT_EQ(writeOptions(parameters), writeOptions(someEyeHand()));
}

TEST(EyeHandParameters, ShippedFileNamesEveryParameter) {
  expectNames(writeOptions(EyeHandParameters()), loadYaml(kSource + "/config/eye_hand.yaml"), "",
              {"objects", "urdf", "arm", "gripper.body"});
}

TEST(EyeHandParameters, ObjectsAreExpectedWhereTheRecogniserLooks) {
  const RecognitionOptions recognition;
  EXPECT_EQ(ObjectMapOptions().expected_nearest, recognition.min_distance);
  EXPECT_EQ(ObjectMapOptions().expected_farthest, recognition.max_distance);
}

TEST(EyeHandParameters, AreChecked) {
  const auto refused = [](const std::string& field, auto change) {
    EyeHandParameters parameters = someEyeHand();
    EXPECT_NO_THROW(parameters.check());
    change(&parameters);
    try {
      parameters.check();
      ADD_FAILURE() << field;
    } catch (const BadInput& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(field));
    }
  };

  using P = EyeHandParameters;
  refused("objects is not set", [](P* p) { p->objects.clear(); });
  refused("urdf is not set", [](P* p) { p->urdf.clear(); });
  refused("base_frame is not set", [](P* p) { p->base_frame.clear(); });
  refused("tool_frame is not set", [](P* p) { p->tool_frame.clear(); });
  refused("joint_names", [](P* p) { p->joint_names[3].clear(); });
  refused("wait = 0", [](P* p) { p->wait = 0; });
  refused("memory = -1", [](P* p) { p->memory = -1; });
  refused("max_joint_gap", [](P* p) { p->max_joint_gap = 0; });
  refused("max_joint_age", [](P* p) { p->max_joint_age = 0; });
  refused("max_tf_distance", [](P* p) { p->max_tf_distance = 0; });
  refused("max_tf_rotation", [](P* p) { p->max_tf_rotation = 0; });
  refused("max_waiting = 0", [](P* p) { p->max_waiting = 0; });
  refused("table_height", [](P* p) { p->table_height = std::nan(""); });
  refused("marker_triangles = -1", [](P* p) { p->marker_triangles = -1; });
  refused("label_height = 0", [](P* p) { p->label_height = 0; });
  refused("diagnostic_period", [](P* p) { p->diagnostic_period = 0; });
}

TEST(EyeHandSetup, TheShippedArmIsTheDefaultOne) {
  const ArmDescription description = loadSameArm(someEyeHand(), Puma560(someEyeHand().arm));
  EXPECT_NEAR(description.tool0_from_tcp.translation.z(), 0.16, 1e-9);
}

TEST(EyeHandSetup, AnotherArmOrGripperIsRefused) {
  EyeHandParameters parameters = someEyeHand();
  parameters.arm.a2 = 0.44;
  EXPECT_THROW(loadSameArm(parameters, Puma560(parameters.arm)), BadInput);
  parameters = someEyeHand();
  parameters.gripper.opening_max = 0.12;
  try {
    loadSameArm(parameters, Puma560());
    ADD_FAILURE() << "a gripper that is not on the arm";
  } catch (const BadInput& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("gripper.opening_max = 0.12"));
  }
  parameters.urdf = kSource + "/urdf/none.urdf";
  EXPECT_THROW(loadSameArm(parameters, Puma560()), BadInput);
}

// The frame is something that other things lie in; the rest may be grasped.
TEST(EyeHandSetup, ShippedModelBaseMarksTheFrame) {
  const ModelBase models = loadModels(someEyeHand().objects, ModelDepth::kShape, {}, "none");
  ASSERT_GE(models.indexOf("frame"), 0);
  for (const KnownObject& known : models.objects) {
    EXPECT_EQ(known.handling.obstacle, known.model.name == "frame") << known.model.name;
    EXPECT_TRUE(known.model.rays) << known.model.name;
  }
}

}  // namespace
}  // namespace monocular_eye_hand
