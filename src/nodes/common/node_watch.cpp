#include "nodes/common/node_watch.h"

#include <XmlRpcValue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include "monocular_eye_hand/geometry/seconds_text.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPeriod = 0.1;        // between two looks at the clock [s, wall clock]
constexpr int kMasterEvery = 20;       // looks at the clock between two at the master
constexpr int kSurelyUnknown = 2;      // looks in a row
constexpr double kStands = 2.0;        // a clock that does not go on for so long stands [s, wall clock]
constexpr double kFirstMessage = 5.0;  // so long a clock may take to begin [s, wall clock]

bool knownToMaster() {
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  arguments[1] = ros::this_node::getName();
  return ros::master::execute("lookupNode", arguments, result, payload, false);
}

}  // namespace

NodeWatch::NodeWatch(std::function<void()> end)
    : end_(end ? std::move(end) : [] { ros::requestShutdown(); }), ticked_at_(ros::WallTime::now()) {
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
  const ros::Time now = ros::Time::now();
  const double stands = (ros::WallTime::now() - ticked_at_).toSec();
  if (now == clock_) return warnOfClock(stands);
  if (warned_) ROS_INFO("the clock goes on, after %s", secondsText(stands, 1).c_str());
  warned_ = false;
  clock_ = now;
  ticked_at_ = ros::WallTime::now();
}

void NodeWatch::warnOfClock(double stands) {
  if (warned_ || stands < (clock_.isZero() ? kFirstMessage : kStands)) return;
  warned_ = true;
  if (clock_.isZero())
    ROS_WARN(
        "use_sim_time is set and nothing came on /clock for %s: start the simulation or the bag (rosbag play "
        "--clock), or set use_sim_time to false before the nodes start",
        secondsText(stands, 0).c_str());
  else
    ROS_WARN(
        "the clock stands at %s since %s: is the simulation or the bag paused, or the machine too busy? "
        "Waits of "
        "this node are paused, too",
        secondsText(clock_.toSec(), 3).c_str(), secondsText(stands, 1).c_str());
}

std::string NodeWatch::clockProblem() const {
  if (!ros::Time::isSimTime()) return "";
  const std::lock_guard<std::mutex> lock(mutex_);
  const double stands = (ros::WallTime::now() - ticked_at_).toSec();
  if (stands < kStands) return "";
  if (clock_.isZero())
    return "nothing came on /clock yet, though use_sim_time is set: does the simulation run?";
  return "the clock stands at " + secondsText(clock_.toSec(), 3) + " since " + secondsText(stands, 1) +
         ": is the simulation paused, or the machine too busy?";
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
