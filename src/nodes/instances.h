#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

struct InstanceOptions {
  double forget_after = 2.0;  ///< an object not seen for so long gives its number back [s]
  double speed =
      0.25;  ///< fastest motion of an object relative to the camera at which it keeps its number [m/s]

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("forget_after", forget_after);
    v("speed", speed);
  }
};

/// Gives objects of one name numbers from 0 that stay with them while they are in view: an object takes the
/// number of the nearest one of its name seen lately, when the distance of the centres (which symmetric poses
/// share) is at most half a diameter plus what `speed` allows; a new one takes the smallest free number. A
/// stamp before the last one (a bag played again) starts afresh.
class Instances {
 public:
  /// Throws BadInput when an option is out of range.
  Instances(const ModelBase& models, const InstanceOptions& options);
  /// The number of each object, in the order given. `stamp`: of the image [s].
  std::vector<int> assign(const std::vector<ObjectEstimate>& objects, double stamp);
  /// The objects as last seen, for RecognitionRequest::previous; those that an image at `stamp` would still
  /// know.
  std::vector<ObjectEstimate> previous(double stamp) const;

 private:
  struct Track {
    ObjectEstimate object;
    int number = 0;
    double stamp = 0;
  };
  struct Shape {
    Eigen::Vector3d centre;  // object frame
    double diameter;
  };
  bool alive(const Track& track, double stamp) const;
  double distance(const ObjectEstimate& a, const ObjectEstimate& b) const;
  int freeNumber(int object) const;

  InstanceOptions options_;
  std::vector<Shape> shapes_;  // by ModelBase::objects
  std::vector<Track> tracks_;
};

/// "<prefix><name>_<number>", with what tf does not take in a frame's name (anything but letters, digits,
/// '_', '-',
/// '.', '/') replaced by '_'.
std::string objectFrame(const std::string& prefix, const std::string& name, int number);

}  // namespace monocular_eye_hand
