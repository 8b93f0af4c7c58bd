#include "monocular_eye_hand/adjustment/loss.h"

#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

TEST(RobustLoss, TheWeightIsTheDerivativeOfTheCost) {
  for (const RobustLoss& loss : {RobustLoss::squares(), RobustLoss::huber(1.5), RobustLoss::cauchy(2)})
    for (const double s : {0.01, 1.0, 2.0, 10.0, 1e4}) {
      const double h = 1e-6 * s;
      EXPECT_NEAR(loss.weight(s), (loss.cost(s + h) - loss.cost(s - h)) / (2 * h), 1e-6) << s;
    }
}

TEST(RobustLoss, SmallErrorsCostTheirSquareAndLargeOnesLess) {
  EXPECT_EQ(RobustLoss::squares().cost(9), 9);
  EXPECT_EQ(RobustLoss::huber(2).cost(3), 3);
  EXPECT_NEAR(RobustLoss::cauchy(2).cost(1e-6), 1e-6, 1e-12);
  EXPECT_LT(RobustLoss::huber(2).cost(100), 40);
  EXPECT_LT(RobustLoss::cauchy(2).cost(100), RobustLoss::huber(2).cost(100));
}

TEST(RobustLoss, AWidthMustBePositive) {
  EXPECT_THROW(RobustLoss::huber(0).check(), BadInput);
  EXPECT_THROW(RobustLoss::cauchy(-1).check(), BadInput);
  EXPECT_NO_THROW(RobustLoss::squares().check());
}

}  // namespace
}  // namespace monocular_eye_hand
