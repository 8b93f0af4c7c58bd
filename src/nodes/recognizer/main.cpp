#include <ros/ros.h>

#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/model/model_base.h"
#include "nodes/common/run_node.h"
#include "nodes/recognizer/node.h"

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  meh::NodeSetup setup;
  setup.help = {"recognizer",
                "finds known CAD parts in the images of a camera",
                "image_raw (image_rect with rectified: true), camera_info, /tf_static",
                "~objects, ~markers, ~view, ~overlay, /tf, /diagnostics",
                "service ~recognize; rosrun monocular_eye_hand ask NAME calls it",
                "recognize.launch camera:=/camera objects:=FILE.yaml rviz:=true",
                "config/recognizer.yaml"};
  // image_transport's plugins keep their settings below the name of the topic they publish.
  setup.foreign_parameters = {"overlay"};
  return meh::runNode<meh::RecognizerParameters>(
      argc, argv, setup, [](meh::RecognizerParameters& parameters, const meh::NodeWatch&) {
        parameters.objects = meh::pathParameter("objects", parameters.objects);
        ROS_INFO("loading the model base %s (compiled once, then cached)", parameters.objects.c_str());
        const auto log = [](const std::string& step) { ROS_INFO("%s", step.c_str()); };
        const meh::Recognizer recognizer(
            meh::loadModels(parameters.objects, meh::ModelDepth::kViews, {}, parameters.cache, log),
            parameters.recognition);
        for (const meh::KnownObject& known : recognizer.models().objects)
          for (const std::string& warning : known.model.warnings)
            ROS_WARN("%s: %s", known.model.name.c_str(), warning.c_str());

        const meh::RecognizerNode recognizer_node(recognizer, parameters);
        ROS_INFO("ready; knows %s", recognizer.models().names().c_str());
        ros::spin();
      });
}
