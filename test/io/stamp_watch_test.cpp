#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/io/stamp_watch.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

TEST(StampWatch, StampsThatGoOnAreGood) {
  StampWatch watch;
  for (int k = 0; k < 5; ++k) watch.add(nanosecondsOf(100 + 0.1 * k), nanosecondsOf(100.05 + 0.1 * k));
  EXPECT_EQ(watch.problem(), "");
  EXPECT_EQ(watch.restarts(), 0u);
}

TEST(StampWatch, ZeroIsNoStamp) {
  StampWatch watch;
  watch.add(0, nanosecondsOf(100));
  EXPECT_THAT(watch.problem(), HasSubstr("no stamp"));
  watch.add(nanosecondsOf(100.1), nanosecondsOf(100.1));
  EXPECT_EQ(watch.problem(), "");
}

TEST(StampWatch, OneStampForAllIsTold) {
  StampWatch watch;
  for (int k = 0; k < 3; ++k) {
    watch.add(nanosecondsOf(100), nanosecondsOf(100 + k));
    EXPECT_EQ(watch.problem(), "") << k;  // a driver may send an image twice
  }
  watch.add(nanosecondsOf(100), nanosecondsOf(103));
  EXPECT_THAT(watch.problem(), HasSubstr("all have one stamp"));
}

TEST(StampWatch, TheFutureIsTold) {
  StampWatch watch;
  for (int k = 0; k < 2; ++k) {  // one alone may be the last of a bag that is played again
    watch.add(nanosecondsOf(107.5 + k), nanosecondsOf(100 + k));
    EXPECT_FALSE(watch.inFuture());
  }
  watch.add(nanosecondsOf(109.5), nanosecondsOf(102));
  EXPECT_TRUE(watch.inFuture());
  EXPECT_THAT(watch.problem(), HasSubstr("7.5 s in the future"));
  watch.add(nanosecondsOf(110), 0);  // no clock yet: nobody can tell
  EXPECT_EQ(watch.problem(), "");
}

TEST(StampWatch, AnyStampIsTaken) {
  StampWatch watch;
  watch.add(nanosecondsOf(4294967295.0), nanosecondsOf(100));
  watch.add(0, nanosecondsOf(4294967295.0));
  EXPECT_EQ(watch.restarts(), 1u);
}

TEST(StampWatch, CountsHowOftenTimeBegan) {
  StampWatch watch;
  for (const double stamp : {100.0, 104.6, 104.2, 100.0, 104.6, 100.0})
    watch.add(nanosecondsOf(stamp), nanosecondsOf(stamp));
  EXPECT_EQ(watch.restarts(), 2u);  // an image that is late by less than a second is none
}

}  // namespace
}  // namespace monocular_eye_hand
