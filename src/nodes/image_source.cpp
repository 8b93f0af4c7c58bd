#include <ros/ros.h>

#include "nodes/image_source_node.h"
#include "nodes/node_watch.h"
#include "nodes/parameter_server.h"

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  ros::init(argc, argv, "image_source");
  ros::NodeHandle node;  // keeps the node up
  const meh::NodeWatch watch;
  try {
    meh::ImageSourceParameters parameters;
    // image_transport's plugins keep their settings below the name of the topic they publish.
    meh::readOptions(meh::privateParameters({"image_raw"}), &parameters);
    ros::AsyncSpinner spinner(1);
    meh::ImageSourceNode source(parameters);
    spinner.start();
    source.run();
    ros::waitForShutdown();  // set_camera_info goes on after the last image
    return 0;
  } catch (const std::exception& e) {
    ROS_FATAL("%s: %s", ros::this_node::getName().c_str(), e.what());
  }
  return 1;
}
