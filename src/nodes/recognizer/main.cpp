#include <ros/ros.h>

#include "monocular_eye_hand/model/model_base.h"
#include "nodes/common/command_line.h"
#include "nodes/common/node_watch.h"
#include "nodes/common/parameter_server.h"
#include "nodes/recognizer/node.h"

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  const meh::NodeHelp help{"recognizer",
                           "finds known CAD parts in the images of a camera",
                           "image_raw (image_rect with rectified: true), camera_info, /tf_static",
                           "~objects, ~markers, ~view, ~overlay, /tf, /diagnostics",
                           "service ~recognize; rosrun monocular_eye_hand ask NAME calls it",
                           "recognize.launch camera:=/camera objects:=FILE.yaml rviz:=true",
                           "config/recognizer.yaml"};
  int exit_code = 0;
  if (meh::endsAtCommandLine(argc, argv, help, meh::writeOptions(meh::RecognizerParameters()), &exit_code))
    return exit_code;

  ros::init(argc, argv, "recognizer");
  ros::NodeHandle node;  // keeps the node up
  const meh::NodeWatch watch;
  try {
    meh::RecognizerParameters parameters;
    // image_transport's plugins keep their settings below the name of the topic they publish.
    meh::readOptions(meh::privateParameters({"overlay"}), &parameters);
    parameters.objects = meh::pathParameter("objects", parameters.objects);

    ROS_INFO("loading the model base %s (compiled once, then cached)", parameters.objects.c_str());
    const auto tell = [](const std::string& step) { ROS_INFO("%s", step.c_str()); };
    const meh::Recognizer recognizer(meh::loadModelBase(parameters.objects, {}, parameters.cache, tell),
                                     parameters.recognition);
    for (const meh::KnownObject& known : recognizer.models().objects)
      for (const std::string& warning : known.model.warnings)
        ROS_WARN("%s: %s", known.model.name.c_str(), warning.c_str());

    const meh::RecognizerNode recognizer_node(recognizer, parameters);
    ROS_INFO("ready; knows %s", recognizer.models().names().c_str());
    ros::spin();
    return 0;
  } catch (const std::exception& e) {
    ROS_FATAL("%s: %s", ros::this_node::getName().c_str(), e.what());
  }
  return 1;
}
