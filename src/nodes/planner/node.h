#pragma once
#include <actionlib/server/simple_action_server.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <monocular_eye_hand/LocatedObjectArray.h>
#include <monocular_eye_hand/MoveAction.h>
#include <monocular_eye_hand/PickAction.h>
#include <monocular_eye_hand/PlaceAction.h>
#include <monocular_eye_hand/RecoverAction.h>
#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "monocular_eye_hand/execution/executor.h"
#include "monocular_eye_hand/parameters/planner.h"
#include "nodes/common/node_watch.h"
#include "nodes/planner/memory.h"
#include "nodes/planner/ros_robot.h"

namespace monocular_eye_hand {

/// The node planner: the actions ~pick, ~place, ~move and ~recover, one at a time. A new goal of the running
/// action stops it and is next; a goal of another one is refused. Callbacks must run beside the actions: spin
/// with more than one thread.
class PlannerNode {
 public:
  /// Throws BadInput as PickPlaceExecutor does. `node_watch` must outlive it.
  PlannerNode(const PlannerParameters& parameters, const NodeWatch& node_watch);
  ~PlannerNode();
  /// Stops the arm if it moves, waits until it stands, and takes no goal any more.
  void stop();

 private:
  template <class Action>
  using Server = actionlib::SimpleActionServer<Action>;
  template <class Action>
  using ServerPtr = std::unique_ptr<Server<Action>>;
  template <class Goal>
  using Work = std::function<ActionResult(const Goal&, const ActionMonitor&)>;

  /// Offers an action from now on.
  template <class Action>
  void serve(ServerPtr<Action>* server, const char* name, const Work<typename Server<Action>::Goal>& work);
  /// Ends the server's goal with what `work` returns.
  template <class Action>
  void run(Server<Action>* server, const char* name,
           const std::function<ActionResult(const ActionMonitor&)>& work);
  template <class Action>
  ActionMonitor monitorOf(Server<Action>* server);
  ActionResult guarded(const std::function<ActionResult()>& work);
  ActionResult pick(const PickGoal& goal, const ActionMonitor& monitor);
  ActionResult move(const MoveGoal& goal, const ActionMonitor& monitor);
  void onObjects(const LocatedObjectArrayConstPtr& message);
  void takeObjects();
  std::string running();
  void setRunning(const std::string& action);
  void remember(const char* action, const ActionResult& result);
  void robotStatus(diagnostic_updater::DiagnosticStatusWrapper& status);
  void planningStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  const PlannerParameters parameters_;
  const NodeWatch& node_watch_;
  RosRobot robot_;
  ParameterMemory memory_;
  PickPlaceExecutor executor_;
  std::atomic<bool> stopping_{false};
  std::mutex busy_;  // held by the action that runs

  std::mutex mutex_;  // of what follows
  LocatedObjectArrayConstPtr objects_;
  std::string running_, held_, last_;
  double planning_time_ = 0, longest_planning_ = 0;
  size_t done_ = 0, not_done_ = 0, known_ = 0, remembered_ = 0;

  ros::NodeHandle node_, private_node_;
  ros::Publisher path_, cell_;
  ros::Subscriber objects_subscriber_;
  ServerPtr<PickAction> pick_;
  ServerPtr<PlaceAction> place_;
  ServerPtr<MoveAction> move_;
  ServerPtr<RecoverAction> recover_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_, cell_timer_;
};

}  // namespace monocular_eye_hand
