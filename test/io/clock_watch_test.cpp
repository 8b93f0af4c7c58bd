#include "monocular_eye_hand/io/clock_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

TEST(ClockWatch, SaysNothingWhileTheClockGoes) {
  ClockWatch watch(100);
  for (int k = 1; k <= 50; ++k) {
    EXPECT_EQ(watch.look(nanosecondsOf(0.1 * k), 100 + 0.1 * k).text, "");
    EXPECT_EQ(watch.problem(100 + 0.1 * k), "");
  }
}

TEST(ClockWatch, TellsOnceThatItStandsAndThatItGoesOn) {
  ClockWatch watch(100);
  watch.look(nanosecondsOf(12.3), 101);
  EXPECT_EQ(watch.look(nanosecondsOf(12.3), 102.9).text, "");
  EXPECT_EQ(watch.problem(102.9), "");

  const ClockWatch::News stands = watch.look(nanosecondsOf(12.3), 103.5);
  EXPECT_THAT(stands.text, HasSubstr("the clock stands at 12.300 s since 2.5 s"));
  EXPECT_FALSE(stands.good);
  EXPECT_EQ(watch.look(nanosecondsOf(12.3), 104).text, "");
  EXPECT_THAT(watch.problem(104), HasSubstr("the clock stands at 12.300 s since 3.0 s"));

  const ClockWatch::News goes = watch.look(nanosecondsOf(12.4), 105);
  EXPECT_EQ(goes.text, "the clock goes on, after 4.0 s");
  EXPECT_TRUE(goes.good);
  EXPECT_EQ(watch.problem(105), "");
}

TEST(ClockWatch, AClockThatNeverCameHasLonger) {
  ClockWatch watch(100);
  EXPECT_EQ(watch.look(0, 104.9).text, "");
  EXPECT_THAT(watch.problem(104.9), HasSubstr("nothing came on /clock yet"));
  EXPECT_THAT(watch.look(0, 105.2).text, HasSubstr("nothing came on /clock for 5 s"));
  EXPECT_EQ(watch.look(0, 106).text, "");
}

TEST(ClockWatch, AClockThatIsSetBackGoes) {
  ClockWatch watch(100);
  watch.look(nanosecondsOf(50), 101);
  EXPECT_EQ(watch.look(nanosecondsOf(1), 102).text, "");
  EXPECT_EQ(watch.problem(102.5), "");
}

}  // namespace
}  // namespace monocular_eye_hand
