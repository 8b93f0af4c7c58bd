#include "nodes/common/run_node.h"

#include <ros/ros.h>

#include <optional>

#include "nodes/common/ending.h"
#include "nodes/common/parameter_server.h"

namespace monocular_eye_hand {

int runNode(int argc, char** argv, const NodeSetup& setup, const OptionTree& defaults,
            const std::function<void(const OptionTree&, const NodeWatch&)>& work) {
  if (const std::optional<int> exit_code = exitAtCommandLine(argc, argv, setup.help, defaults))
    return *exit_code;

  ros::init(argc, argv, setup.help.name, setup.ends_when_asked ? ros::init_options::NoSigintHandler : 0);
  if (setup.ends_when_asked) ending::takeRequests();
  ros::NodeHandle node;  // keeps the node up
  const NodeWatch watch(setup.ends_when_asked ? ending::ask : std::function<void()>());
  try {
    work(privateParameters(setup.foreign_parameters), watch);
    return 0;
  } catch (const std::exception& e) {
    ROS_FATAL("%s: %s", ros::this_node::getName().c_str(), e.what());
  }
  return 1;
}

void runUntilAsked(ros::AsyncSpinner* spinner, const std::string& what, const std::function<void()>& stop) {
  ending::takeSignals();
  spinner->start();
  ROS_INFO("ready; %s", what.c_str());
  while (ros::ok() && !ending::asked()) ros::WallDuration(0.05).sleep();
  stop();
  ros::shutdown();
  spinner->stop();
}

}  // namespace monocular_eye_hand
