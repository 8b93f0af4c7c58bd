#include "nodes/common/node_watch.h"

#include <XmlRpcValue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <ros/time.h>

#include "nodes/common/stamps.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPeriod = 0.1;    // between two looks at the clock [s, wall clock]
constexpr int kMasterEvery = 20;   // looks at the clock between two at the master
constexpr int kSurelyUnknown = 2;  // looks in a row

bool knownToMaster() {
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  arguments[1] = ros::this_node::getName();
  return ros::master::execute("lookupNode", arguments, result, payload, false);
}

}  // namespace

NodeWatch::NodeWatch(std::function<void()> end)
    : end_(end ? std::move(end) : [] { ros::requestShutdown(); }), clock_(ros::WallTime::now().toSec()) {
  thread_ = std::thread(&NodeWatch::watch, this);
}

NodeWatch::~NodeWatch() {
  stop_ = true;
  thread_.join();
}

void NodeWatch::watch() {
  for (int k = 1; !stop_ && ros::ok(); ++k) {
    watchClock();
    if (k % kMasterEvery == 0) watchMaster();
    ros::WallDuration(kPeriod).sleep();
  }
}

void NodeWatch::watchClock() {
  if (!ros::Time::isSimTime()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  const ClockWatch::News news = clock_.look(nanoseconds(ros::Time::now()), ros::WallTime::now().toSec());
  if (news.good)
    ROS_INFO("%s", news.text.c_str());
  else if (!news.text.empty())
    ROS_WARN("%s", news.text.c_str());
}

std::string NodeWatch::clockProblem() const {
  if (!ros::Time::isSimTime()) return "";
  const std::lock_guard<std::mutex> lock(mutex_);
  return clock_.problem(ros::WallTime::now().toSec());
}

void NodeWatch::watchMaster() {
  if (!ros::master::check()) {
    if (!master_silent_) ROS_WARN("the master %s does not answer", ros::master::getURI().c_str());
    master_silent_ = true;
    return;
  }
  const bool known = knownToMaster();
  if (!known && !ros::master::check()) return;  // it went away just now
  if (master_silent_) ROS_INFO("the master answers again");
  master_silent_ = false;
  unknown_ = registered_ && !known ? unknown_ + 1 : 0;
  registered_ = registered_ || known;
  if (unknown_ < kSurelyUnknown || stop_ || !ros::ok()) return;
  ROS_FATAL("the master %s was restarted and does not know this node: it ends; start it again",
            ros::master::getURI().c_str());
  registered_ = false;
  end_();
}

}  // namespace monocular_eye_hand
