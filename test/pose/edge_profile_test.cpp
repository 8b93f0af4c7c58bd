#include "monocular_eye_hand/pose/edge_profile.h"

#include <gtest/gtest.h>

namespace monocular_eye_hand {
namespace {

// Ten clean edges of blur 1.1 and four others, ten points each.
std::vector<EdgeAppearance> part() {
  std::vector<EdgeAppearance> appearances;
  for (int edge = 0; edge < 14; ++edge)
    for (int i = 0; i < 10; ++i)
      appearances.push_back({edge < 10 ? 1.1 + 0.002 * (i - 4.5) : 0.8 + 0.3 * (edge - 10), 0.0});
  return appearances;
}
std::vector<EdgeAppearance> edge(double blur, double turn = 0) {
  return std::vector<EdgeAppearance>(5, {blur, turn});
}

TEST(EdgeProfiles, CleanIsWhatMostEdgesShare) { EXPECT_NEAR(EdgeProfiles(part()).cleanBlur(), 1.1, 0.01); }

TEST(EdgeProfiles, TheFartherFromCleanTheFartherOff) {
  const EdgeProfiles profiles(part());
  EXPECT_LT(profiles.expectedOffset(edge(1.1)), 0.03);
  double last_wide = 0, last_narrow = 0;
  for (double step : {0.0, 0.05, 0.1, 0.2, 0.4}) {
    const double wide = profiles.expectedOffset(edge(1.1 + step)),
                 narrow = profiles.expectedOffset(edge(1.1 - step));
    EXPECT_NEAR(wide, narrow, 0.2 * wide) << step;
    EXPECT_GE(wide, last_wide);
    EXPECT_GE(narrow, last_narrow);
    last_wide = wide;
    last_narrow = narrow;
  }
  EXPECT_GT(last_wide, 0.5);
}

TEST(EdgeProfiles, AnEdgeThatRunsAcrossItsContourIsDoubtfulWhicheverWay) {
  const EdgeProfiles profiles(part());
  EXPECT_GT(profiles.expectedOffset(edge(1.1, 0.2)), 0.2);
  EXPECT_EQ(profiles.expectedOffset(edge(1.1, 0.2)), profiles.expectedOffset(edge(1.1, -0.2)));
  EXPECT_EQ(profiles.expectedOffset(edge(1.1, 0.01)), profiles.expectedOffset(edge(1.1)));
}

TEST(EdgeProfiles, ASingleStrayPointDoesNotCondemnItsEdge) {
  std::vector<EdgeAppearance> stray = edge(1.1);
  stray[2] = {3.0, 1.2};
  EXPECT_EQ(EdgeProfiles(part()).expectedOffset(stray), EdgeProfiles(part()).expectedOffset(edge(1.1)));
}

TEST(EdgeProfiles, FewPointsOrNoneAreNoError) {
  EXPECT_EQ(EdgeProfiles({}).cleanBlur(), 0);
  EXPECT_GT(EdgeProfiles({}).expectedOffset({}), 0);
  EXPECT_EQ(EdgeProfiles({{1.3, 0.0}}).cleanBlur(), 1.3);
  EXPECT_LT(EdgeProfiles({{1.3, 0.0}}).expectedOffset({{1.3, 0.0}}), 0.03);
}

}  // namespace
}  // namespace monocular_eye_hand
