#include "nodes/task_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "node_messages.h"
#include "nodes/conversion.h"
#include "nodes/eye_hand_conversion.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

MappedObject someObject() {
  MappedObject object;
  object.object = 1;
  object.name = "frame";
  object.number = 4;
  object.base_from_object = somePose(0.1);
  object.covariance = someCovariance();
  object.free_axis = true;
  object.probability = 0.75;
  object.views = 7;
  object.misses = 2;
  object.last_stamp = 12.5;
  return object;
}

TEST(TaskMessages, AnObjectThereAndBack) {
  const LocatedObject message = toMessage(someObject(), ros::Time(12.5), "base_link");
  EXPECT_EQ(message.header.frame_id, "base_link");
  EXPECT_EQ(message.header.stamp, ros::Time(12.5));
  EXPECT_EQ(message.name, "frame");
  EXPECT_EQ(message.instance, 4);
  const MappedObject back = fromMessage(message, twoObjects());
  EXPECT_EQ(back.object, 1);
  EXPECT_EQ(back.name, "frame");
  EXPECT_EQ(back.number, 4);
  EXPECT_LT(difference(back.base_from_object, someObject().base_from_object).norm(), 1e-12);
  EXPECT_LT((back.covariance - someObject().covariance).norm(), 1e-15);
  EXPECT_TRUE(back.free_axis);
  EXPECT_FLOAT_EQ(back.probability, 0.75);
  EXPECT_EQ(back.views, 7);
  EXPECT_EQ(back.misses, 2);
  EXPECT_EQ(back.last_stamp, 12.5);
}

TEST(TaskMessages, AnObjectOfAnotherModelBaseIsRefused) {
  LocatedObject message = toMessage(someObject(), ros::Time(12.5), "base_link");
  message.name = "spoon";
  try {
    fromMessage(message, twoObjects());
    ADD_FAILURE();
  } catch (const BadInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("\"spoon\" that is not in the model base (bridge, frame)"));
  }
}

TEST(TaskMessages, AGraspIsWhatItsMessageSays) {
  GraspTarget message;
  message.pregrasp = toPose(somePose(0.1));
  message.grasp = toPose(somePose(0.2));
  message.retreat = toPose(somePose(0.3));
  message.width = 0.04;
  message.opening = 0.06;
  message.approach.x = 0.6;
  message.approach.y = 0;
  message.approach.z = -0.8;
  for (size_t j = 0; j < 6; ++j) {
    message.pregrasp_joints[j] = 0.1 * double(j);
    message.grasp_joints[j] = 1 + 0.1 * double(j);
    message.retreat_joints[j] = 2 + 0.1 * double(j);
  }
  message.free = 0.005;
  message.needed = 0.002;
  message.quality = 0.8;
  message.reason = "faces 1 and 2";

  const GraspCandidate grasp = fromMessage(message);
  EXPECT_LT(difference(grasp.base_from_pregrasp, somePose(0.1)).norm(), 1e-12);
  EXPECT_LT(difference(grasp.base_from_grasp, somePose(0.2)).norm(), 1e-12);
  EXPECT_LT(difference(grasp.base_from_retreat, somePose(0.3)).norm(), 1e-12);
  EXPECT_EQ(grasp.width, 0.04);
  EXPECT_EQ(grasp.opening, 0.06);
  EXPECT_EQ(grasp.approach, Eigen::Vector3d(0.6, 0, -0.8));
  EXPECT_DOUBLE_EQ(grasp.pregrasp_joints[5], 0.5);
  EXPECT_DOUBLE_EQ(grasp.grasp_joints[0], 1);
  EXPECT_DOUBLE_EQ(grasp.retreat_joints[3], 2.3);
  EXPECT_NEAR(grasp.clearance(), 0.003, 1e-9);
  EXPECT_NEAR(grasp.quality, 0.8, 1e-6);
  EXPECT_EQ(grasp.source, "faces 1 and 2");
}

TEST(TaskMessages, EveryOutcomeHasItsCode) {
  const std::pair<TaskOutcome, int> tasks[] = {{TaskOutcome::kCleared, ClearFrameResult::CLEARED},
                                               {TaskOutcome::kLeftovers, ClearFrameResult::LEFTOVERS},
                                               {TaskOutcome::kNoFrame, ClearFrameResult::NO_FRAME},
                                               {TaskOutcome::kCancelled, ClearFrameResult::CANCELLED},
                                               {TaskOutcome::kFault, ClearFrameResult::FAULT}};
  for (const auto& [outcome, code] : tasks) {
    TaskResult result;
    result.outcome = outcome;
    EXPECT_EQ(int(toMessage(result, "base_link", 0).outcome), code) << name(outcome);
  }
  const std::pair<ObjectOutcome, int> objects[] = {
      {ObjectOutcome::kWaiting, ClearedObject::WAITING}, {ObjectOutcome::kCarried, ClearedObject::CARRIED},
      {ObjectOutcome::kGone, ClearedObject::GONE},       {ObjectOutcome::kLeft, ClearedObject::LEFT},
      {ObjectOutcome::kHeld, ClearedObject::HELD},       {ObjectOutcome::kDropped, ClearedObject::DROPPED}};
  for (const auto& [outcome, code] : objects) {
    TaskResult result;
    result.objects.resize(1);
    result.objects[0].outcome = outcome;
    EXPECT_EQ(int(toMessage(result, "base_link", 0).objects.at(0).outcome), code) << name(outcome);
  }
}

TEST(TaskMessages, ResultAndFeedbackAreComplete) {
  TaskResult result;
  result.reason = "why";
  result.rounds = 3;
  result.objects.resize(2);
  result.objects[1].object = someObject();
  result.objects[1].reason = "because";
  result.objects[1].picks = 2;
  result.objects[1].near_looks = 5;
  const ClearFrameResult message = toMessage(result, "base_link", 41.5);
  EXPECT_EQ(message.reason, "why");
  EXPECT_EQ(message.rounds, 3);
  EXPECT_EQ(message.duration, 41.5);
  ASSERT_EQ(message.objects.size(), 2u);
  EXPECT_EQ(message.objects[1].object.instance, 4);
  EXPECT_EQ(message.objects[1].reason, "because");
  EXPECT_EQ(message.objects[1].picks, 2);
  EXPECT_EQ(message.objects[1].near_looks, 5);

  TaskFeedback feedback;
  feedback.stage = TaskStage::kVerify;
  feedback.object = "bridge 0";
  feedback.text = "the gripper holds it";
  feedback.round = 2;
  feedback.carried = 1;
  feedback.left = 4;
  const ClearFrameFeedback told = toMessage(feedback);
  EXPECT_EQ(told.stage, "verify");
  EXPECT_EQ(told.object, "bridge 0");
  EXPECT_EQ(told.text, "the gripper holds it");
  EXPECT_EQ(told.round, 2);
  EXPECT_EQ(told.carried, 1);
  EXPECT_EQ(told.left, 4);
}

}  // namespace
}  // namespace monocular_eye_hand
