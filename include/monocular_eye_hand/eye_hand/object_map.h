#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/eye_hand/chain.h"
#include "monocular_eye_hand/eye_hand/known_space.h"
#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/model/model_base.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else.
struct ObjectMapOptions {
  ArmErrorOptions arm;
  HandEyeErrorOptions hand_eye;  ///< used when the view brings no covariance of its own
  double min_probability = 0.5;  ///< what recognition trusts less is left out
  /// Sigma of what CAD and part differ by, each axis: added to every view's own part, and once more to the
  /// merged pose, where no number of views takes it away [m].
  double floor_position = 1e-4;
  double floor_rotation = 1e-3;  ///< the same about each axis [rad]
  double gate = 30;              ///< chi-square (6 degrees of freedom) beyond which a view is an outlier
  double same_place = 0.5;       ///< two of a name are one when their centres are nearer than this share of
                                 ///< the smallest side of the part's box: parts do not lie inside each other;
                                 ///< of obstacles, nearer along each side than this share of it
  double max_distance = 0.05;    ///< or nearer than this and inside the gate [m]
  int outliers_to_restart = 2;   ///< so many outliers in a row that agree: the object was moved
  double min_motion = 0.01;      ///< views from nearer camera places share their errors [m] ...
  double min_turn = 0.03;        ///< ... unless the camera turned by this [rad]: they are not averaged
  int most_views = 200;          ///< merged per object; more tell nothing new
  double overlap_depth = 0.004;  ///< two objects that reach into each other deeper are not both there [m]
  /// What reaches deeper than this, and known_sigmas of its pose, into table, walls or the hand is not there
  /// [m].
  double known_depth = 0.004;
  double known_sigmas = 3;
  int forget_after_misses = 5;  ///< views in a row that should have shown an object and did not
  double expected_share = 0.7;  ///< of an object must be in view and free for that ...
  double expected_size = 40;    ///< ... at this size in the image at least [px] ...
  double expected_border = 5;   ///< ... this far from the image's border [px] ...
  /// ... and its centre where recognition looks for objects (min_distance, max_distance of its options, none
  /// nearer than its diameter) [m].
  double expected_nearest = 0.05, expected_farthest = 2.5;

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("arm", arm);
    v("hand_eye", hand_eye);
    v("min_probability", min_probability);

    v("floor_position", floor_position);
    v("floor_rotation", floor_rotation);
    v("gate", gate);
    v("same_place", same_place);
    v("max_distance", max_distance);

    v("outliers_to_restart", outliers_to_restart);
    v("min_motion", min_motion);
    v("min_turn", min_turn);
    v("most_views", most_views);
    v("overlap_depth", overlap_depth);
    v("forget_after_misses", forget_after_misses);
    v("known_depth", known_depth);
    v("known_sigmas", known_sigmas);

    v("expected_share", expected_share);
    v("expected_size", expected_size);
    v("expected_border", expected_border);
    v("expected_nearest", expected_nearest);
    v("expected_farthest", expected_farthest);
  }
};

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
  double probability = 0;                        ///< the best of its views
  int views = 0;                                 ///< merged
  /// In a row: views that should have shown it and did not. From a camera place that never showed it they
  /// count once.
  int misses = 0;
  int outliers = 0;                        ///< in a row: views that contradict this pose
  double first_stamp = 0, last_stamp = 0;  ///< of the views that showed it [s]
};

enum class ViewOutcome {
  kNew,        ///< an object not known before
  kMerged,     ///< made a known one more exact
  kSeenAgain,  ///< confirms a known one from where it was seen already
  kRestarted,  ///< the known one was moved: its earlier views are dropped
  kOutlier,    ///< contradicts a known one: not used
  kRefused     ///< not used at all
};
const char* name(ViewOutcome outcome);

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

/// The objects on the table in the base frame, merged over the views of a moving camera. Same views in the
/// same order, same map.
///
/// Each view's error has an own part (image) and parts that all views share: the hand-eye's and the joints'
/// zeros. They are not estimated, but considered (Schmidt 1966): views are weighted by the information of
/// their own part, and the sensitivity of the merged pose to the common errors is carried along, so that a
/// hundred views from one side are no better than the hand-eye calibration allows.
///
/// Solid things are never in one place. Of objects that reach into each other the one with more views is
/// told; the others are kept, untold, until views confirm them, miss them, or the told one is gone. What
/// reaches into known space is refused with that reason.
class ObjectMap {
 public:
  /// Keeps a pointer to `models`. Throws BadInput when an option is out of range.
  explicit ObjectMap(const ModelBase* models, const ObjectMapOptions& options = {});

  /// Throws BadInput on an object index outside the model base, and on a pose, covariance, probability,
  /// camera or stamp that is none; the map is then unchanged. A view that is not newer than the last is
  /// refused.
  ViewReport add(const ObjectView& view);

  /// What is believed to be there, by model and number, the order of the model base.
  std::vector<MappedObject> objects() const;
  /// Takes an object out, e.g. when it was carried away, and what yielded to it; false when there is none.
  bool forget(int object, int number);
  void clear();  ///< everything, numbers too

 private:
  using Key = std::pair<int, int>;  // MappedObject::object, number
  /// A SeenObject in the base frame.
  struct Sighting {
    int object = -1;
    double probability = 0;
    Rigid3 base_from_object, base_from_camera;
    Matrix6d image = Matrix6d::Zero();     // held covariance of the own part
    Matrix6d hand_eye = Matrix6d::Zero();  // sensitivity to the hand-eye's error
    Matrix6d joints = Matrix6d::Zero();    // sensitivity to the joints' errors
  };
  struct Track {
    MappedObject object;                    // as published after the last view
    Sighting merged;                        // all views together
    std::vector<Rigid3> base_from_cameras;  // of the merged views
    std::vector<Rigid3> missed_from;        // camera places of the misses in a row
    std::vector<Sighting> outliers;         // in a row, agreeing with each other
    std::vector<Key> rivals;                // cannot be there together with it
    std::optional<Key> yields_to;           // the rival that is believed instead
    int missed = 0;                         // views in all that should have shown it and did not
    Key key() const { return {object.object, object.number}; }
  };
  void addFloor(Matrix6d* covariance) const;
  Sighting sighting(const ObjectView& view, const SeenObject& seen) const;
  Matrix6d totalCovariance(const Sighting& sighting) const;  // held, without the floor of the merged pose
  std::string impossible(const Sighting& sighting, const KnownSpace& known);  // why; "": it is not
  Sighting equalSighting(const Sighting& sighting, const Rigid3& wanted) const;
  const ObjectModel& model(int object) const { return models_->objects[size_t(object)].model; }
  double chiSquare(const Sighting& a, const Sighting& b) const;
  Eigen::Vector3d centreOffset(const Sighting& a, const Sighting& b) const;  // from a to b, base axes [m]
  bool samePlace(const Sighting& a, const Sighting& b) const;
  std::vector<int> associate(const std::vector<Sighting>& sightings, std::vector<double>* chi_squares) const;
  ViewDecision meet(Track* track, const Sighting& sighting, double chi_square, double stamp) const;
  ViewDecision contradict(Track* track, const Sighting& sighting, double chi_square, double stamp) const;
  Track started(const Sighting& sighting, double stamp) const;
  void merge(Track* track, const Sighting& sighting) const;
  void publish(Track* track) const;
  void countMisses(const ObjectView& view, const std::vector<char>& met, ViewReport* report);
  bool expected(const Track& track, const ObjectView& view) const;
  bool oneOf(const std::vector<Rigid3>& base_from_cameras, const Rigid3& base_from_camera) const;
  /// Whether a view that does not show the track as known says more than those from the places told_from. A
  /// place that showed it so does each time: it was taken or moved. Another place errs in one way: once.
  bool tellsOfChange(const Track& track, const Rigid3& base_from_camera,
                     const std::vector<Rigid3>& told_from) const;
  static std::vector<Rigid3> placesOf(const std::vector<Sighting>& sightings);
  const std::vector<Eigen::Vector3d>& core(int object);
  bool inOnePlace(const Track& a, const Track& b);
  void findRivals();
  void believe();  // settles who yields to whom

  const ModelBase* models_;
  ObjectMapOptions options_;
  std::vector<Track> tracks_;
  std::vector<int> next_number_;                       // by ModelBase::objects
  std::map<int, std::vector<Eigen::Vector3d>> cores_;  // points deep inside a model, by ModelBase::objects
  Matrix6d hand_eye_covariance_ = Matrix6d::Zero();
  double last_stamp_ = 0;
  bool started_ = false;
};

}  // namespace monocular_eye_hand
