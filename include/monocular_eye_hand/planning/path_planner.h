#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/planning/collision_world.h"
#include "monocular_eye_hand/planning/options.h"

namespace monocular_eye_hand {

/// Whether the arm may be there.
using JointTest = std::function<bool(const JointVector&)>;
/// A bound on how far any point of the arm moves when the joints turn by so much [m].
using MotionBound = std::function<double(const JointVector&)>;

/// What a path is tested with.
struct PathTest {
  JointTest valid;
  /// With these two, every edge of the result is tested in steps of which none moves the arm by more than
  /// twice the padding: with the padded arm free at both ends of a step, the true arm is free in between.
  MotionBound motion;
  double padding = 0;  ///< [m]
};
/// The test of a world with its present padding; refers to the world. What is carried without padding is
/// tested in the steps of the arm's.
PathTest testIn(const CollisionWorld& world);

/// Whether the straight edge in joint space is free: in steps of `resolution` [rad], and no longer than the
/// padding allows when `exact`. Counts the tests.
bool edgeFree(const PathTest& test, const JointVector& a, const JointVector& b, double resolution, bool exact,
              int* tests);

enum class PathOutcome { kFound, kStartInCollision, kGoalInCollision, kOutsideLimits, kNoPath };

struct JointPath {
  PathOutcome outcome = PathOutcome::kNoPath;
  std::vector<JointVector> points;  ///< corners, start and goal among them
  int goal = -1;                    ///< which goal was reached
  int tests = 0;                    ///< joint vectors tested
  bool found() const { return outcome == PathOutcome::kFound; }
};

/// Free path in joint space from `start` to one of `goals`: the straight edge, else RRT-Connect (Kuffner &
/// LaValle, ICRA 2000; OMPL), then shortened. The same call gives the same path, whatever was planned before.
/// Goals outside the limits or in collision are left out; with none left the outcome tells of the first.
/// Throws BadInput on joints that are not finite, no goal, or options out of range.
JointPath planPath(const std::array<JointLimit, 6>& limits, const JointVector& start,
                   const std::vector<JointVector>& goals, const PathTest& test,
                   const PathOptions& options = {});

/// Replaces stretches by straight edges where that is free: corner to corner, then between seeded points.
void shorten(std::vector<JointVector>* points, const PathTest& test, const PathOptions& options, int* tests);

}  // namespace monocular_eye_hand
