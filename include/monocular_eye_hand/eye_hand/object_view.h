#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/eye_hand/chain.h"
#include "monocular_eye_hand/eye_hand/known_space.h"
#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// What recognition says of one object in one image.
struct SeenObject {
  int object = -1;  ///< ModelBase::objects
  Rigid3 camera_from_object;
  Matrix6d covariance = Matrix6d::Zero();  ///< camera axes; see docs/conventions.md
  double probability = 1;
};

/// One image's objects and where the camera was.
struct ObjectView {
  double stamp = 0;  ///< of the image [s]
  HandPose hand;     ///< at that stamp
  HandEye hand_eye;  ///< covariance zero: ObjectMapOptions::hand_eye stands in
  Camera camera;
  KnownSpace known;  ///< at that stamp
  /// What is missing counts: every object was looked for, the search ended by itself, the camera stood, and
  /// no hand was in the way.
  bool complete = true;
  std::vector<SeenObject> objects;
};

/// An object as all views together know it.
struct MappedObject {
  int object = -1;  ///< ModelBase::objects
  std::string name;
  int number = 0;  ///< counts from 0 per name; stays; is not given again before clear()
  Rigid3 base_from_object;
  Matrix6d covariance = Matrix6d::Zero();        ///< base axes: image and common part
  Matrix6d image_covariance = Matrix6d::Zero();  ///< the part that more views shrink
  bool free_axis = false;                        ///< the rotation about the model's axis has no meaning
  double probability = 0;  ///< the best of its views; of all together where each is doubtful
  int views = 0;           ///< merged
  /// In a row: views that should have shown it and did not. From a camera place that never showed it they
  /// count once.
  int misses = 0;
  int outliers = 0;  ///< in a row: views that contradict this pose
  /// Of the first view that showed it and of the last that did without doubt, or began the doubt [s].
  double first_stamp = 0, last_stamp = 0;
};

enum class ViewOutcome {
  kNew,        ///< an object not known before
  kMerged,     ///< made a known one more exact
  kSeenAgain,  ///< confirms a known one from where it was seen already
  kRestarted,  ///< the known one was moved: its earlier views are dropped
  kOutlier,    ///< contradicts a known one: not used
  kDoubtful,   ///< kept, and not published before other views agree
  kRefused     ///< not used at all
};
std::string toString(ViewOutcome outcome);

/// What became of one SeenObject.
struct ViewDecision {
  ViewOutcome outcome = ViewOutcome::kRefused;
  int object = -1;          ///< ModelBase::objects
  int number = -1;          ///< of the mapped object concerned; -1: none
  double chi_square = -1;   ///< against the mapped object; -1: none
  std::string reason;       ///< for people
  bool impossible = false;  ///< refused, since it reaches into known space
};

struct ViewReport {
  std::string refused;                  ///< the whole view was not used: why; empty: it was
  std::vector<ViewDecision> decisions;  ///< one per ObjectView::objects
  std::vector<MappedObject> forgotten;  ///< as last known
};
/// What became of each object, for people.
std::string textOf(const ViewReport& report, const ModelBase& models);

}  // namespace monocular_eye_hand
