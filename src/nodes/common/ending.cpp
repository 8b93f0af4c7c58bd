#include "nodes/common/ending.h"

#include <ros/console.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <csignal>

namespace monocular_eye_hand {
namespace ending {
namespace {

std::atomic<bool> asked_to_end{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void onSignal(int) { ask(); }

/// The arguments: who asks, and why.
void onRequest(XmlRpc::XmlRpcValue& arguments, XmlRpc::XmlRpcValue& result) {
  if (arguments.getType() == XmlRpc::XmlRpcValue::TypeArray && arguments.size() > 1) {
    ROS_WARN("asked to end: %s", std::string(arguments[1]).c_str());
    ask();
  }
  result = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace

void takeRequests() { ros::XMLRPCManager::instance()->bind("shutdown", onRequest); }

void takeSignals() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

void ask() { asked_to_end = true; }

bool asked() { return asked_to_end; }

}  // namespace ending
}  // namespace monocular_eye_hand
