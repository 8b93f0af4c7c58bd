#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/eye_hand/view_map.h"
#include "monocular_eye_hand/grasp/grasping_options.h"
#include "monocular_eye_hand/grasp/object_grasps.h"

namespace monocular_eye_hand {

/// Where the arm stands; `problem` tells why that is not known.
struct ArmNow {
  JointVector joints = JointVector::Zero();
  std::string problem;
};

enum class GraspStatus {
  kFound,
  kUnknownName,   ///< not in the model base
  kNotReady,      ///< no view was used yet, or nobody knows where the arm stands
  kNotKnown,      ///< no such object is in the map
  kNoGrasp,       ///< it is, and every grasp is refused
  kTooUncertain,  ///< ... but a better known pose would give one: look from nearer
};

/// What there is to say of the grasps of an object.
struct GraspAnswer {
  GraspStatus status = GraspStatus::kNoGrasp;
  std::string text;                        ///< for people
  std::optional<size_t> index;             ///< kFound: which of MapState::objects
  std::vector<GraspCandidate> candidates;  ///< kFound: best first
};

/// The best grasp of an object, or why it has none.
struct BestGrasp {
  size_t index = 0;  ///< MapState::objects
  std::optional<GraspCandidate> grasp;
  std::string reason;  ///< without a grasp
};

/// Tells the grasps of what is known, or why there are none. Const calls are safe from several threads.
class GraspAdvisor {
 public:
  /// Samples the grasps of all models. `models` and `arm` must outlive it. Throws BadInput when an option is
  /// out of range.
  GraspAdvisor(const ModelBase& models, const GraspingOptions& options, const Puma560& arm,
               const Rigid3& tool0_from_tcp);

  /// Of the object of this name and number; -1: of the one of that name that has the best grasp.
  /// `table_height`: z of the table's top in base when no view told it [m].
  GraspAnswer answer(const std::string& name, int number, const MapState& known, const ArmNow& arm,
                     double table_height) const;
  /// Of each known object that may be grasped.
  std::vector<BestGrasp> best(const MapState& known, const ArmNow& arm, double table_height) const;

  const Rigid3& tool0FromTcp() const { return tool0_from_tcp_; }
  /// Of a model, by ModelBase::objects.
  const ModelGrasps& modelGrasps(int object) const { return grasps_.ofModel(object); }

 private:
  std::optional<double> tableHeight(const MapState& known, double untold) const;

  const ModelBase& models_;
  const bool table_;
  const Rigid3 tool0_from_tcp_;
  const ObjectGrasps grasps_;
};

}  // namespace monocular_eye_hand
