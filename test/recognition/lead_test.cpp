// How far a candidate stands out among the others of its object.
#include "monocular_eye_hand/recognition/lead.h"

#include <gtest/gtest.h>

namespace monocular_eye_hand {
namespace {

TEST(Lead, WithoutOthersIsTheLargest) {
  const std::vector<Lead> leads = leadsAmong({{0, -3, {}}, {1, 2, {}}});
  ASSERT_EQ(leads.size(), 2u);
  for (const Lead& lead : leads) {
    EXPECT_EQ(lead.over_most, 8) << "candidates of other objects do not count";
    EXPECT_EQ(lead.elsewhere, 8);
    EXPECT_EQ(lead.in_place, 8);
  }
}

TEST(Lead, InItsPlaceIsOverTheBestThatConflictsWhoeverNamesTheConflict) {
  const std::vector<Lead> leads = leadsAmong({{0, 3, {}}, {0, 1, {0}}, {0, -1, {0}}, {0, 2.5, {}}});
  EXPECT_EQ(leads[0].in_place, 2);
  EXPECT_EQ(leads[1].in_place, -2);
  EXPECT_EQ(leads[2].in_place, -2) << "bounded";
  EXPECT_EQ(leads[3].in_place, 8);
}

TEST(Lead, ElsewherePassesOverOtherInstancesAndTheTwoBestImprobableOnes) {
  const std::vector<Lead> leads =
      leadsAmong({{0, 4, {}}, {0, 5, {}}, {0, 3, {}}, {0, -1, {}}, {0, -2, {}}, {0, -3, {}}, {0, -6, {}}});
  EXPECT_EQ(leads[0].elsewhere, 7) << "over the one at -3";
  EXPECT_EQ(leads[3].elsewhere, 5) << "over the one at -6";
  EXPECT_EQ(leadsAmong({{0, 1, {}}, {0, -1, {}}, {0, -2, {}}})[0].elsewhere, 8) << "too few to tell";
}

TEST(Lead, OverMostIsOverTheLowerQuartile) {
  const std::vector<Lead> leads = leadsAmong({{0, 1, {}}, {0, 0, {}}, {0, -1, {}}, {0, -2, {}}, {0, -3, {}}});
  EXPECT_EQ(leads[0].over_most, 3) << "of 0, -1, -2, -3 a quarter lies below -2";
  EXPECT_EQ(leads[4].over_most, -2);
}

}  // namespace
}  // namespace monocular_eye_hand
