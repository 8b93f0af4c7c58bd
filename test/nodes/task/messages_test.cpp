#include "nodes/task/messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "node_messages.h"
#include "nodes/common/conversion.h"
#include "nodes/eye_hand/messages.h"

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

// What eye_hand answers when it is asked for the grasps of a bridge.
GraspTargetsResponse answerFor(const MappedObject& bridge, const ros::Time& stamp) {
  const LocatedObject object = toMessage(bridge, stamp, "base_link");
  GraspTargetsResponse response;
  response.status = GraspTargetsResponse::FOUND;
  response.text = "two grasps";
  for (int k = 0; k < 2; ++k) {
    GraspCandidate grasp;
    grasp.base_from_pregrasp = bridge.base_from_object * somePose(0.1);
    grasp.base_from_grasp = bridge.base_from_object * somePose(0.2);
    grasp.base_from_lift = bridge.base_from_object * somePose(0.3);
    grasp.part_width = 0.03;
    grasp.opening = 0.05;
    grasp.approach = {0.6, 0, -0.8};
    grasp.branch = {Shoulder::kLeft, Elbow::kDown, k == 0 ? Wrist::kNegative : Wrist::kPositive};
    grasp.pregrasp_joints << 1, 2, 3, 4, 5, 6;
    grasp.grasp_joints << 11, 12, 13, 14, 15, 16;
    grasp.lift_joints << 21, 22, 23, 24, 25, 26;
    grasp.free = 0.01;
    grasp.needed = 0.004;
    grasp.quality = 0.9 - 0.1 * k - 0.01 * bridge.number;
    grasp.source = "faces " + std::to_string(k) + " of bridge " + std::to_string(bridge.number);
    response.targets.push_back(toMessage(object, grasp));
  }
  return response;
}

MappedObject bridgeAt(double x, int number) {
  MappedObject bridge = someObject();
  bridge.object = 0;
  bridge.name = "bridge";
  bridge.number = number;
  bridge.base_from_object = somePose(x);
  return bridge;
}

std::string refusal(const GraspTargetsResponse& response, const MappedObject& asked) {
  try {
    fromMessage(response, asked, "base_link");
  } catch (const BadInput& e) {
    return e.what();
  }
  return "";
}

void expectSamePose(const geometry_msgs::Pose& a, const geometry_msgs::Pose& b) {
  EXPECT_LT(difference(fromPose(a), fromPose(b)).norm(), 1e-12);
}

// Grasps of two bridges are asked for one after the other; that of the first is picked. Since they were
// planned, the map has moved on (continuous), and the task has the pose of its last look.
TEST(TaskMessages, TheGraspOfTheRightBridgeReachesThePlanner) {
  const MappedObject planned_for[] = {bridgeAt(0.4, 0), bridgeAt(0.6, 1)};
  const MappedObject last_look[] = {bridgeAt(0.41, 0), bridgeAt(0.61, 1)};
  const GraspTargetsResponse answers[] = {answerFor(planned_for[0], ros::Time(20.5)),
                                          answerFor(planned_for[1], ros::Time(20.75))};
  const TaskGrasps grasps[] = {fromMessage(answers[0], last_look[0], "base_link"),
                               fromMessage(answers[1], last_look[1], "base_link")};
  for (size_t bridge = 0; bridge < 2; ++bridge)
    for (size_t k = 0; k < 2; ++k) {
      const PlannedGrasp chosen{grasps[bridge].object, grasps[bridge].plan.candidates.at(k)};
      EXPECT_EQ(chosen.grasp.model_grasp, -1) << "the message does not tell it";
      const GraspTarget& asked_for = answers[bridge].targets[k];
      GraspTarget goal = toMessage(chosen, "base_link");
      expectSamePose(goal.object.pose, asked_for.object.pose);
      expectSamePose(goal.pregrasp, asked_for.pregrasp);
      expectSamePose(goal.grasp, asked_for.grasp);
      expectSamePose(goal.retreat, asked_for.retreat);

      // All else is the same to the last bit.
      goal.object.pose = asked_for.object.pose;
      goal.pregrasp = asked_for.pregrasp;
      goal.grasp = asked_for.grasp;
      goal.retreat = asked_for.retreat;
      EXPECT_EQ(goal, asked_for);
    }
  EXPECT_EQ(grasps[0].object.views, 7) << "the rest of the object is that of the last look";
}

TEST(TaskMessages, GraspsOfAnotherObjectFrameOrPoseAreRefused) {
  const MappedObject zero = bridgeAt(0.4, 0), one = bridgeAt(0.6, 1);
  const GraspTargetsResponse answer = answerFor(one, ros::Time(20.75));
  EXPECT_EQ(refusal(answer, one), "");
  EXPECT_THAT(refusal(answer, zero), HasSubstr("grasps of bridge 0 and answered with one of bridge 1"));
  GraspTargetsResponse other = answer;
  other.targets[1].header.frame_id = "world";
  EXPECT_THAT(refusal(other, one), HasSubstr("in the frame 'world', the task in 'base_link'"));
  other = answer;
  other.targets[1].object.pose.position.x += 0.01;
  EXPECT_THAT(refusal(other, one), HasSubstr("bridge 1 for more than one pose"));
  other = answer;
  other.targets[1].branch = "sideways";
  EXPECT_THAT(refusal(other, one), HasSubstr("'sideways' is no branch of the arm"));
}

TEST(TaskMessages, NoGraspHasItsReason) {
  GraspTargetsResponse response;
  response.status = GraspTargetsResponse::TOO_UNCERTAIN;
  response.text = "3 sigma need 9 mm";
  const TaskGrasps grasps = fromMessage(response, bridgeAt(0.4, 0), "base_link");
  EXPECT_TRUE(grasps.plan.candidates.empty());
  EXPECT_TRUE(grasps.plan.too_uncertain);
  EXPECT_EQ(grasps.plan.reason, "3 sigma need 9 mm");
}

TEST(TaskMessages, AGraspIsWhatItsMessageSays) {
  GraspTarget message;
  message.branch = "left-down-negative";
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
  EXPECT_LT(difference(grasp.base_from_lift, somePose(0.3)).norm(), 1e-12);
  EXPECT_EQ(grasp.part_width, 0.04);
  EXPECT_EQ(grasp.opening, 0.06);
  EXPECT_EQ(grasp.approach, Eigen::Vector3d(0.6, 0, -0.8));
  EXPECT_EQ(toString(grasp.branch), "left-down-negative");
  EXPECT_DOUBLE_EQ(grasp.pregrasp_joints[5], 0.5);
  EXPECT_DOUBLE_EQ(grasp.grasp_joints[0], 1);
  EXPECT_DOUBLE_EQ(grasp.lift_joints[3], 2.3);
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
    EXPECT_EQ(int(toMessage(result, "base_link", 0).outcome), code) << toString(outcome);
  }
  const std::pair<ObjectOutcome, int> objects[] = {
      {ObjectOutcome::kWaiting, ClearedObject::WAITING}, {ObjectOutcome::kCarried, ClearedObject::CARRIED},
      {ObjectOutcome::kGone, ClearedObject::GONE},       {ObjectOutcome::kLeft, ClearedObject::LEFT},
      {ObjectOutcome::kHeld, ClearedObject::HELD},       {ObjectOutcome::kDropped, ClearedObject::DROPPED}};
  for (const auto& [outcome, code] : objects) {
    TaskResult result;
    result.objects.resize(1);
    result.objects[0].outcome = outcome;
    EXPECT_EQ(int(toMessage(result, "base_link", 0).objects.at(0).outcome), code) << toString(outcome);
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
