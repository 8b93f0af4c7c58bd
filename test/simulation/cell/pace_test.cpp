#include <gtest/gtest.h>

#include "monocular_eye_hand/simulation/cell/pace.h"

namespace monocular_eye_hand {
namespace {

TEST(CellPace, KeepsItsFactor) {
  for (const double factor : {0.5, 1.0, 4.0}) {
    CellPace pace(factor);
    EXPECT_EQ(pace.wait(1.0, 50.0, true), 0);
    EXPECT_NEAR(pace.wait(1.2, 50.0, true), 0.2 / factor, 1e-9) << factor;
    EXPECT_NEAR(pace.wait(1.2, 50.0 + 0.15 / factor, false), 0.05 / factor, 1e-9) << factor;
    EXPECT_EQ(pace.wait(1.2, 50.0 + 0.2 / factor, false), 0);
    EXPECT_NEAR(pace.wait(1.3, 50.0 + 0.25 / factor, true), 0.05 / factor, 1e-9) << factor;
  }
}

TEST(CellPace, ZeroWaitsOnlyWhileNothingMoves) {
  CellPace pace(0);
  EXPECT_EQ(pace.wait(1.0, 50.0, false), 0);
  EXPECT_NEAR(pace.wait(1.1, 50.0, false), 0.1, 1e-9);
  for (double cell = 1.1; cell < 20; cell += 0.1) EXPECT_EQ(pace.wait(cell, 50.1, true), 0);
  // Rest begins where the motion ended: neither a pause nor a rush.
  EXPECT_EQ(pace.wait(20.0, 50.2, true), 0);
  EXPECT_NEAR(pace.wait(20.1, 50.2, false), 0.1, 1e-9);
}

TEST(CellPace, DoesNotRushAfterALongDelay) {
  CellPace pace(1);
  pace.wait(1.0, 50.0, true);
  EXPECT_EQ(pace.wait(1.1, 60.0, true), 0);  // the machine was away for ten seconds
  EXPECT_EQ(pace.wait(1.1 + CellPace::kLongestLag, 60.0, true), 0);
  EXPECT_NEAR(pace.wait(1.2 + CellPace::kLongestLag, 60.0, true), 0.1, 1e-9);
}

TEST(CellInstants, AreEvenlySpacedHoweverLateSomebodyLooks) {
  CellInstants instants(10, nanosecondsOf(1));
  EXPECT_FALSE(instants.pass(nanosecondsOf(0.9)));
  EXPECT_TRUE(instants.pass(nanosecondsOf(1)));
  EXPECT_FALSE(instants.pass(nanosecondsOf(1)));
  EXPECT_EQ(instants.next(), nanosecondsOf(1.1));
  EXPECT_TRUE(instants.pass(nanosecondsOf(1.15)));
  EXPECT_EQ(instants.next(), nanosecondsOf(1.2));
}

}  // namespace
}  // namespace monocular_eye_hand
