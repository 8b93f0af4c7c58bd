#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/planning/path_planner.h"

namespace monocular_eye_hand {

PathTest testIn(const CollisionWorld& world) {
  PathTest test;
  test.valid = [&world](const JointVector& joints) { return world.valid(joints); };
  test.motion = [&world](const JointVector& delta) { return world.motionBound(delta); };
  test.padding = world.padding();
  if (!world.carried().empty() && world.carriedPadding() > 0)
    test.padding = std::min(test.padding, world.carriedPadding());
  return test;
}

bool edgeFree(const PathTest& test, const JointVector& a, const JointVector& b, double resolution, bool exact,
              int* tests) {
  const JointVector delta = b - a;
  int steps = std::max(1, int(std::ceil(delta.norm() / resolution)));
  if (exact && test.motion && test.padding > 0)
    steps = std::max(steps, int(std::ceil(test.motion(delta) / (2 * test.padding))));
  int stride = 1;
  while (stride < steps) stride *= 2;
  if (++*tests, !test.valid(b)) return false;
  for (stride /= 2; stride >= 1; stride /= 2)  // coarse first: a hit is found early
    for (int i = stride; i < steps; i += 2 * stride)
      if (++*tests, !test.valid(a + delta * (double(i) / steps))) return false;
  return true;
}

}  // namespace monocular_eye_hand
