#pragma once
#include <array>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "monocular_eye_hand/arm/joint_sample.h"
#include "monocular_eye_hand/arm/puma560.h"

namespace monocular_eye_hand {

/// The arm's joint angles over time. The joints may come in several samples, of several devices: each has a
/// history of its own. Safe from several threads.
class JointHistory {
 public:
  enum class Match {
    kNone,    ///< of one of the joints there is none within `max_gap` [s]
    kNear,    ///< the nearest within it
    kBetween  ///< of all joints interpolated between two within it
  };
  /// The joints at a stamp, as far as they are known.
  struct Found {
    Match match = Match::kNone;
    JointVector joints = JointVector::Zero();
  };
  /// The last angle of every joint.
  struct Latest {
    Nanoseconds stamp = 0;  ///< since then all of them are known
    JointVector joints = JointVector::Zero();
  };

  /// Angles are kept for `memory` [s].
  JointHistory(const std::array<std::string, 6>& names, double memory) : names_(names), memory_(memory) {}

  /// Takes what a sample says of the six joints; other ones (the fingers') are left out, and so is a sample
  /// in which one of the six has no position or one that is not finite. When the time of a joint goes back by
  /// more than a second what is older is forgotten.
  void add(const JointSample& sample);

  Found at(Nanoseconds stamp, double max_gap) const;
  /// How fast the fastest joint turns at `stamp`, on average over `span` before or after it, whichever is
  /// slower; 0 when that is not known [s, rad/s].
  double speedAt(Nanoseconds stamp, double span, double max_gap) const;
  /// None while one of the joints is not known.
  std::optional<Latest> latest() const;
  /// What is wrong with the samples of late, or that none came; "": nothing.
  std::string problem() const;

 private:
  struct Entry {
    Nanoseconds stamp = 0;
    double angle = 0;
  };
  void addAngle(size_t joint, const Entry& entry);
  Match angleAt(size_t joint, Nanoseconds stamp, double max_gap, double* angle) const;

  const std::array<std::string, 6> names_;
  const double memory_;
  mutable std::mutex mutex_;
  std::array<std::deque<Entry>, 6> entries_;  // by stamp
  bool any_ = false;                          // a sample came
  std::string problem_;                       // of the last sample that named one of the joints
};

}  // namespace monocular_eye_hand
