#include <ros/ros.h>

#include "nodes/common/command_line.h"
#include "nodes/common/node_watch.h"
#include "nodes/common/parameter_server.h"
#include "nodes/image_source/node.h"

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  const meh::NodeHelp help{"image_source",
                           "plays a camera: publishes an image, a folder of images or a video",
                           "",
                           "image_raw, camera_info",
                           "service set_camera_info",
                           "image.launch source:=IMAGES camera_info:=CAMERA.yaml",
                           ""};
  int exit_code = 0;
  if (meh::endsAtCommandLine(argc, argv, help, meh::writeOptions(meh::ImageSourceParameters()), &exit_code))
    return exit_code;

  ros::init(argc, argv, "image_source");
  ros::NodeHandle node;  // keeps the node up
  const meh::NodeWatch watch;
  try {
    meh::ImageSourceParameters parameters;
    // image_transport's plugins keep their settings below the name of the topic they publish.
    meh::readOptions(meh::privateParameters({"image_raw"}), &parameters);
    parameters.source = meh::pathParameter("source", parameters.source);
    parameters.camera_info = meh::pathParameter("camera_info", parameters.camera_info);

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
