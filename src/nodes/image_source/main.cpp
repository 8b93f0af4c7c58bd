#include <ros/ros.h>

#include "monocular_eye_hand/io/file_path.h"
#include "nodes/common/run_node.h"
#include "nodes/image_source/node.h"

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  meh::NodeSetup setup;
  setup.help = {"image_source",
                "plays a camera: publishes an image, a folder of images or a video",
                "",
                "image_raw, camera_info",
                "service set_camera_info",
                "image.launch source:=IMAGES camera_info:=CAMERA.yaml",
                ""};
  // image_transport's plugins keep their settings below the name of the topic they publish.
  setup.foreign_parameters = {"image_raw"};
  return meh::runNode<meh::ImageSourceParameters>(
      argc, argv, setup, [](meh::ImageSourceParameters& parameters, const meh::NodeWatch&) {
        parameters.source = meh::pathParameter("source", parameters.source);
        parameters.camera_info = meh::pathParameter("camera_info", parameters.camera_info);

        ros::AsyncSpinner spinner(1);
        meh::ImageSourceNode source(parameters);
        spinner.start();
        source.run();
        ros::waitForShutdown();  // set_camera_info goes on after the last image
      });
}
