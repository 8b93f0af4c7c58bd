#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/eye_hand/known_space.h"
#include "monocular_eye_hand/eye_hand/object_map_options.h"
#include "monocular_eye_hand/eye_hand/object_view.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

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
