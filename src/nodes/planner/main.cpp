#include <ros/ros.h>

#include "nodes/common/command_line.h"
#include "nodes/common/conversion.h"
#include "nodes/common/ending.h"
#include "nodes/common/parameter_server.h"
#include "nodes/planner/node.h"

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  const meh::NodeHelp help{"planner",
                           "plans and drives the arm: picks objects up, puts them down",
                           "joint_states, gripper/state, eye_hand/objects",
                           "arm_controller/command, gripper/command, ~path, ~cell, /diagnostics",
                           "actions ~pick, ~place, ~move, ~recover",
                           "planner.launch objects:=FILE.yaml urdf:=ARM.urdf",
                           "config/planner.yaml"};
  int exit_code = 0;
  if (meh::endsAtCommandLine(argc, argv, help, meh::writeOptions(meh::PlannerParameters()), &exit_code))
    return exit_code;

  // An arm that moves is stopped before the topics go away.
  ros::init(argc, argv, "planner", ros::init_options::NoSigintHandler);
  meh::ending::takeRequests();
  ros::NodeHandle node;  // keeps the node up
  try {
    meh::PlannerParameters parameters;
    // actionlib keeps its settings below the names of the actions.
    meh::readOptions(meh::privateParameters({"pick", "place", "move", "recover"}), &parameters);
    parameters.base_frame = meh::withoutSlash(parameters.base_frame);
    parameters.objects = meh::pathParameter("objects", parameters.objects);
    parameters.urdf = meh::pathParameter("urdf", parameters.urdf);
    const meh::NodeWatch watch(meh::ending::ask);

    ros::AsyncSpinner spinner(2);
    meh::PlannerNode planner(parameters, watch);
    meh::ending::takeSignals();
    spinner.start();
    ROS_INFO("ready; %zu places in the drop zone", parameters.drop_zone.places().size());
    while (ros::ok() && !meh::ending::asked()) ros::WallDuration(0.05).sleep();

    planner.stop();
    ros::shutdown();
    spinner.stop();
    return 0;
  } catch (const std::exception& e) {
    ROS_FATAL("%s: %s", ros::this_node::getName().c_str(), e.what());
  }
  return 1;
}
