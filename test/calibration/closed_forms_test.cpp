#include "calibration/closed_forms.h"

#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/random.h"

namespace monocular_eye_hand {
namespace {

Rigid3 somePose(Random& random, double turn) {
  return {expSO3(turn * randomDirection(random)), 0.3 * randomDirection(random)};
}

std::vector<HandEyePair> pairsFor(Random& random, const Rigid3& x, int count, double turn) {
  const Rigid3 z = somePose(random, 2);
  std::vector<HandEyePair> pairs;
  for (int i = 0; i < count; ++i) {
    const Rigid3 arm = somePose(random, uniform(random, 0.2, turn));
    pairs.push_back({arm, (arm * x).inverse() * z});
  }
  return pairs;
}

TEST(ClosedForms, EachFindsTheHandEyeOfExactPoses) {
  Random random(1);
  for (int run = 0; run < 200; ++run) {
    const Rigid3 x = somePose(random, uniform(random, 0, 3));
    const std::vector<HandEyePair> pairs = pairsFor(random, x, 3 + run % 5, 1.2);
    const std::vector<HandEyeStart> starts = closedForms(pairs);
    ASSERT_EQ(starts.size(), 5u);
    for (const HandEyeStart& start : starts)
      EXPECT_THAT(start.x, PoseNear(x, 1e-3, 1e-4)) << start.method << " run " << run;
  }
}

TEST(ClosedForms, TheTargetIsWhereTheViewsPutIt) {
  Random random(2);
  const Rigid3 x = somePose(random, 1);
  const std::vector<HandEyePair> pairs = pairsFor(random, x, 6, 1);
  const Rigid3 target = pairs[0].arm * x * pairs[0].camera_from_target;
  EXPECT_THAT(meanTarget(pairs, x), PoseNear(target, 1e-6, 1e-6));
}

TEST(ClosedForms, ThereAreNoneOfMotionsAboutOneAxis) {
  Random random(3);
  const Rigid3 x = somePose(random, 1), z = somePose(random, 2);
  std::vector<HandEyePair> pairs;
  for (int i = 0; i < 8; ++i) {
    const Rigid3 arm{expSO3({0, 0, 0.3 * i}), 0.3 * randomDirection(random)};
    pairs.push_back({arm, (arm * x).inverse() * z});
  }
  EXPECT_TRUE(closedForms(pairs).empty());
  EXPECT_TRUE(closedForms(pairsFor(random, x, 2, 1)).empty());
}

TEST(ClosedForms, NoiseMovesNoneFar) {
  Random random(4);
  for (int run = 0; run < 50; ++run) {
    const Rigid3 x = somePose(random, 1);
    std::vector<HandEyePair> pairs = pairsFor(random, x, 15, 1.2);
    for (HandEyePair& pair : pairs) {
      Vector6d d;
      d << 2e-4 * randomVector(random), 4e-4 * randomVector(random);
      pair.camera_from_target = perturbed(pair.camera_from_target, d);
    }
    for (const HandEyeStart& start : closedForms(pairs))
      EXPECT_THAT(start.x, PoseNear(x, 5, 0.5)) << start.method << " run " << run;
  }
}

}  // namespace
}  // namespace monocular_eye_hand
