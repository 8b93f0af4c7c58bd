#include "nodes/common/run_node.h"

#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <csignal>
#include <optional>

#include "nodes/common/parameter_server.h"

namespace monocular_eye_hand {
namespace {

std::atomic<bool> asked_to_end{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void askToEnd() { asked_to_end = true; }

void onSignal(int) { askToEnd(); }

/// From the master: `rosnode kill`, or a second node of the same name. The arguments: who asks, and why.
void onRequest(XmlRpc::XmlRpcValue& arguments, XmlRpc::XmlRpcValue& result) {
  if (arguments.getType() == XmlRpc::XmlRpcValue::TypeArray && arguments.size() > 1) {
    ROS_WARN("asked to end: %s", std::string(arguments[1]).c_str());
    askToEnd();
  }
  result = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace

int runNode(int argc, char** argv, const NodeSetup& setup, const OptionTree& defaults,
            const std::function<void(const OptionTree&, const NodeWatch&)>& work) {
  if (const std::optional<int> exit_code = exitAtCommandLine(argc, argv, setup.help, defaults))
    return *exit_code;

  ros::init(argc, argv, setup.help.name, setup.ends_when_asked ? ros::init_options::NoSigintHandler : 0);
  if (setup.ends_when_asked) ros::XMLRPCManager::instance()->bind("shutdown", onRequest);
  ros::NodeHandle node;  // keeps the node up
  const NodeWatch watch(setup.ends_when_asked ? askToEnd : std::function<void()>());
  try {
    work(privateParameters(setup.foreign_parameters), watch);
    return 0;
  } catch (const std::exception& e) {
    ROS_FATAL("%s: %s", ros::this_node::getName().c_str(), e.what());
  }
  return 1;
}

void runUntilAsked(ros::AsyncSpinner* spinner, const std::string& what, const std::function<void()>& stop) {
  std::signal(SIGINT, onSignal);  // until now they end the process
  std::signal(SIGTERM, onSignal);
  spinner->start();
  ROS_INFO("ready; %s", what.c_str());
  while (ros::ok() && !asked_to_end) ros::WallDuration(0.05).sleep();
  stop();
  ros::shutdown();
  spinner->stop();
}

}  // namespace monocular_eye_hand
