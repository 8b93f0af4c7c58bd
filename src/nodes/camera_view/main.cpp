#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "nodes/camera_view/parameters.h"
#include "nodes/common/conversion.h"
#include "nodes/common/names.h"
#include "nodes/common/run_node.h"

namespace monocular_eye_hand {
namespace {

constexpr double kWarnAgain = 10.0;  // while no image comes [s, wall clock]

/// A frame beside the camera's optical frame with z up, so that rviz's grid and orbit stand upright. The
/// optical frame is that of the first image.
class CameraView {
 public:
  explicit CameraView(const CameraViewParameters& parameters) : parameters_(parameters), transport_(node_) {
    if (!parameters_.camera_frame.empty()) {
      show(parameters_.camera_frame);
      return;
    }
    image_ = transport_.subscribe(names::kImageRaw, 1, &CameraView::onImage, this,
                                  image_transport::TransportHints(parameters_.image_transport));
    timer_ = node_.createWallTimer(ros::WallDuration(kWarnAgain),
                                   [this](const ros::WallTimerEvent&) { warnOfMissingImages(); });
  }

 private:
  void onImage(const sensor_msgs::ImageConstPtr& image) {
    const std::string frame = withoutSlash(image->header.frame_id);
    if (frame.empty()) {
      ROS_WARN_THROTTLE(
          kWarnAgain,
          "the images on %s name no frame (header.frame_id is empty): set it in the camera's driver, or give "
          "camera_frame:=FRAME",
          image_.getTopic().c_str());
      return;
    }
    show(frame);
    timer_.stop();
    image_.shutdown();
  }

  void warnOfMissingImages() {
    const std::string reason =
        image_.getNumPublishers() == 0 ? "nobody publishes it" : "it has a publisher, which sends nothing";
    ROS_WARN(
        "the 3D view stays empty until an image on %s tells the camera's frame: %s. Give camera:=NAMESPACE "
        "or "
        "image:=TOPIC of your camera, or camera_frame:=FRAME",
        image_.getTopic().c_str(), reason.c_str());
  }

  void show(const std::string& optical_frame) {
    // Optical axes are right, down, ahead; those of the view ahead, left, up.
    Rigid3 optical_from_view;
    optical_from_view.rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    std_msgs::Header header;
    header.stamp = ros::Time::now();
    header.frame_id = optical_frame;
    broadcaster_.sendTransform(toTransform(header, parameters_.view_frame, optical_from_view));
    ROS_INFO("%s stands beside the camera's frame %s", parameters_.view_frame.c_str(), optical_frame.c_str());
  }

  const CameraViewParameters parameters_;
  ros::NodeHandle node_;
  image_transport::ImageTransport transport_;
  image_transport::Subscriber image_;
  ros::WallTimer timer_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
};

}  // namespace
}  // namespace monocular_eye_hand

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  meh::NodeSetup setup;
  setup.help = {"camera_view",
                "a tf frame with z up beside a camera's optical frame, for rviz",
                "image_raw, until the first image",
                "/tf_static",
                "",
                "rviz.launch",
                ""};
  return meh::runNode<meh::CameraViewParameters>(
      argc, argv, setup, [](meh::CameraViewParameters& parameters, const meh::NodeWatch&) {
        for (std::string* frame : {&parameters.camera_frame, &parameters.view_frame})
          *frame = meh::withoutSlash(*frame);

        const meh::CameraView view(parameters);
        ros::spin();
      });
}
