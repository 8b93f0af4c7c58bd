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
/// published; the others are kept, suppressed, until views confirm them, miss them, or the published one is
/// gone. What reaches into known space is refused with that reason.
///
/// What recognition doubts in one view several may bear out together: a wrong pose seldom comes again, in all
/// six degrees of freedom, from another side. Such candidates are kept without a number, and published when
/// their views together make them likely enough.
class ObjectMap {
 public:
  /// Keeps a pointer to `models`. Throws BadInput when an option is out of range.
  explicit ObjectMap(const ModelBase* models, const ObjectMapOptions& options = {});

  /// Throws BadInput on an object index outside the model base, and on an invalid pose, covariance,
  /// probability, camera or stamp; the map is then unchanged. A view that is not newer than the last is
  /// refused.
  ViewReport add(const ObjectView& view);

  /// What is believed to be there, by model and number, the order of the model base.
  std::vector<MappedObject> objects() const;
  /// Takes an object out, e.g. when it was carried away, and what it suppressed; false when there is none.
  bool forget(int object, int number);
  void clear();  ///< everything, numbers too

 private:
  using Key = std::pair<int, int>;  // MappedObject::object, number
  /// A SeenObject in the base frame.
  struct Observation {
    int object = -1;
    double probability = 0;
    Rigid3 base_from_object, base_from_camera;
    Matrix6d image = Matrix6d::Zero();     // held covariance of the own part
    Matrix6d hand_eye = Matrix6d::Zero();  // sensitivity to the hand-eye's error
    Matrix6d joints = Matrix6d::Zero();    // sensitivity to the joints' errors
  };
  struct Track {
    MappedObject object;                    // as published after the last view
    Observation merged;                     // all views together
    std::vector<Rigid3> base_from_cameras;  // of the merged views
    std::vector<Rigid3> missed_from;        // camera places of the misses in a row
    double evidence = 0;                    // log-odds that it is there, of all its views together
    bool believed = false;                  // likely enough to be published and to have a number
    std::vector<Observation> outliers;      // in a row, agreeing with each other
    std::vector<Key> rivals;                // cannot be there together with it
    std::optional<Key> suppressed_by;       // the rival that is published instead
    int missed = 0;                         // views in all that should have shown it and did not
    bool told() const { return believed && !suppressed_by; }
    Key key() const { return {object.object, object.number}; }
  };
  void addFloor(Matrix6d* covariance) const;
  Observation observationOf(const ObjectView& view, const SeenObject& seen) const;
  Matrix6d totalCovariance(
      const Observation& observation) const;  // held, without the floor of the merged pose
  std::string impossible(const Observation& observation, const KnownSpace& known);  // why; "": it is not
  Observation equalObservation(const Observation& observation, const Rigid3& wanted) const;
  const ObjectModel& model(int object) const { return models_->objects[size_t(object)].model; }
  double chiSquare(const Observation& a, const Observation& b) const;
  Eigen::Vector3d centreOffset(const Observation& a,
                               const Observation& b) const;  // from a to b, base axes [m]
  bool samePlace(const Observation& a, const Observation& b) const;
  std::vector<int> associate(const std::vector<Observation>& observations,
                             std::vector<double>* chi_squares) const;
  ViewDecision update(Track* track, const Observation& observation, double chi_square, double stamp) const;
  ViewDecision handleOutlier(Track* track, const Observation& observation, double chi_square,
                             double stamp) const;
  Track newTrack(const Observation& observation, double stamp) const;
  bool doubtful(const Observation& observation) const;
  double probability(const Track& track) const;
  double support(const Observation& observation) const;               // log-odds
  double evidenceOf(const std::vector<Observation>& agreeing) const;  // log-odds
  ViewDecision begin(const Observation& observation, double stamp);   // a track of its own
  void believe(Track* track, ViewDecision* decision);  // gives it a number once it is likely enough
  ViewDecision addDoubt(Track* track, const Observation& observation) const;
  void merge(Track* track, const Observation& observation) const;
  void publish(Track* track) const;
  void countMisses(const ObjectView& view, const std::vector<char>& updated, ViewReport* report);
  bool expected(const Track& track, const ObjectView& view) const;
  bool oneOf(const std::vector<Rigid3>& base_from_cameras, const Rigid3& base_from_camera) const;
  /// Whether a view that does not show the track as known says more than those from the places counted_from.
  /// A place that showed it so does each time: it was taken or moved. Another place errs in one way: once.
  bool isNewEvidence(const Track& track, const Rigid3& base_from_camera,
                     const std::vector<Rigid3>& counted_from) const;
  static std::vector<Rigid3> placesOf(const std::vector<Observation>& observations);
  const std::vector<Eigen::Vector3d>& core(int object);
  bool inOnePlace(const Track& a, const Track& b);
  void findRivals();
  void resolveConflicts();  // settles which of two rivals is published

  const ModelBase* models_;
  ObjectMapOptions options_;
  std::vector<Track> tracks_;
  std::vector<int> next_number_;                       // by ModelBase::objects
  int next_doubtful_ = -2;                             // what is not believed: told apart by negative numbers
  std::map<int, std::vector<Eigen::Vector3d>> cores_;  // points deep inside a model, by ModelBase::objects
  Matrix6d hand_eye_covariance_ = Matrix6d::Zero();
  double last_stamp_ = 0;
  bool any_view_ = false;
};

}  // namespace monocular_eye_hand
