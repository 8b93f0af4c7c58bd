#pragma once
#include <vector>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else.
struct ObjectTrackerOptions {
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

/// Gives the objects of one camera's images numbers from 0 per name that stay with them while they are in
/// view: an object takes the number of the nearest one of its name seen lately, when the distance of the
/// centres (which symmetric poses share) is at most half a diameter plus what `speed` allows; a new one takes
/// the smallest free number. A stamp before the last one (a bag played again) starts afresh.
class ObjectTracker {
 public:
  /// Throws BadInput when an option is out of range.
  ObjectTracker(const ModelBase& models, const ObjectTrackerOptions& options);
  /// Takes in what an image showed and returns the number of each object, in the order given. `stamp`: of the
  /// image [s].
  std::vector<int> update(const std::vector<ObjectEstimate>& objects, double stamp);
  /// The objects as last seen, for RecognitionRequest::previous; those that an image at `stamp` [s] would
  /// still know.
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

  ObjectTrackerOptions options_;
  std::vector<Shape> shapes_;  // by ModelBase::objects
  std::vector<Track> tracks_;
};

}  // namespace monocular_eye_hand
