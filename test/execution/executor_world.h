#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/execution/executor.h"
#include "scripted_robot.h"

namespace monocular_eye_hand {

inline const ExecutorOptions& executorOptions() {
  static const ExecutorOptions options = [] {
    const std::string source = MONOCULAR_EYE_HAND_SOURCE_DIR;
    ExecutorOptions options;
    options.objects = source + "/config/objects.yaml";
    options.urdf = source + "/urdf/puma560.urdf";
    return options;
  }();
  return options;
}

constexpr double kTableTop = 0.3;      // [m]
constexpr double kBridgeWidth = 0.04;  // where the pads take it [m]

/// gripper_tcp looking down, the pads along base y.
inline Rigid3 down(double x, double y, double z) {
  Rigid3 pose;
  pose.rotation = Eigen::Vector3d(1, -1, -1).asDiagonal();
  pose.translation = {x, y, z};
  return pose;
}

/// A bridge that stands on the table.
inline PlacedObject bridge(double x = 0.5, double y = 0, int instance = 0) {
  PlacedObject object{"bridge", instance, {}};
  object.base_from_object.translation = {x, y, kTableTop + 1e-4};
  return object;
}

inline PickOrder pickOrder(const PlacedObject& object, int place = 0) {
  const Eigen::Vector3d at = object.base_from_object.translation;
  PickOrder order;
  order.object = object;
  order.place = place;
  order.target.object = object.label();
  order.target.base_from_pregrasp = down(at.x(), at.y(), at.z() + 0.128);
  order.target.base_from_grasp = down(at.x(), at.y(), at.z() + 0.048);
  order.target.base_from_lift = down(at.x(), at.y(), at.z() + 0.148);
  order.target.part_width = kBridgeWidth;
  order.target.opening = 0.06;
  return order;
}

/// An executor with a scripted arm that looks at a table with one bridge.
class ExecutorTest : public testing::Test {
 protected:
  ExecutorTest() {
    restart();
    standAt(down(0.45, 0.0, 0.62));
    robot.on_step = [this] { step(); };
    executor->see({bridge()});
  }

  ActionMonitor monitor() {
    ActionMonitor monitor;
    monitor.cancelled = [this] {
      return !cancel_in.empty() && !stages.empty() && stages.back() == cancel_in;
    };
    monitor.reportProgress = [this](const std::string& stage, double) {
      if (stages.empty() || stages.back() != stage) stages.push_back(stage);
    };
    monitor.show = [this](const std::vector<Trajectory>& motions) { shown = motions; };
    monitor.log = [this](const std::string& text) { log.push_back(text); };
    return monitor;
  }

  ActionResult pick(int place = 0) { return pick(pickOrder(bridge(), place)); }
  ActionResult pick(const PickOrder& order) {
    stages.clear();
    robot.part_width = kBridgeWidth;
    return executor->pick(order, monitor());
  }
  ActionResult place(int place = 0) {
    stages.clear();
    return executor->place(PlaceOrder{place}, monitor());
  }
  ActionResult move(const MoveOrder& order) {
    stages.clear();
    return executor->move(order, monitor());
  }
  ActionResult recover() {
    stages.clear();
    return executor->recover(monitor());
  }
  MoveOrder moveTo(const Rigid3& base_from_tcp) const {
    MoveOrder order;
    order.base_from_tcp = {base_from_tcp};
    return order;
  }

  /// In the first step of this stage.
  void at(const std::string& stage, const std::function<void()>& change) { changes[stage] = change; }
  /// The part falls out of the hand.
  void dropAt(const std::string& stage) {
    at(stage, [this] { robot.part_width = 0; });
  }
  /// As when the program starts again; the robot stays as it is.
  void restart() { executor = std::make_unique<PickPlaceExecutor>(options, &robot, &memory); }

  /// Another executor, that knows nothing of the last pick, and an open gripper.
  void beginAnew() {
    restart();
    executor->see({bridge()});
    memory.keep(std::nullopt);
    robot.sendGripper(0.06);
    for (int i = 0; i < 100; ++i) robot.wait(0.01);
  }

  /// The arm is there, as if it had always been.
  void standAt(const Rigid3& base_from_tcp) {
    ArmSolutions solutions;
    executor->arm().inverse(base_from_tcp, JointVector::Zero(), &solutions);
    robot.joints = solutions[0].joints;
    robot.wait(0.01);
  }

  void expectStopped(const ActionResult& result) {
    EXPECT_GE(robot.sent_stops, 1) << result.reason;
    EXPECT_EQ(robot.commands.back(), "stop") << "nothing was sent after it";
    EXPECT_TRUE(robot.stands()) << "it was waited for";
  }
  bool tcpIsAt(const Rigid3& pose) const {
    return (executor->arm().baseFromTcp(robot.joints).translation - pose.translation).norm() < 1e-3;
  }

  ExecutorOptions options = executorOptions();
  ScriptedRobot robot;
  VolatilePickMemory memory;
  std::unique_ptr<PickPlaceExecutor> executor;
  std::string cancel_in;
  std::vector<std::string> stages;
  std::vector<Trajectory> shown;
  std::vector<std::string> log;
  std::map<std::string, std::function<void()>> changes;

 private:
  void step() {
    if (stages.empty()) return;
    const auto change = changes.find(stages.back());
    if (change == changes.end()) return;
    const auto run = change->second;
    changes.erase(change);
    run();
  }
};

}  // namespace monocular_eye_hand
