#include "recognition/work_budget.h"

#include <gtest/gtest.h>

#include <vector>

namespace monocular_eye_hand {
namespace {

// How much each of the takers gets when all of them would take more than there is.
std::vector<long long> dealtOut(WorkBudget* budget, int takers) {
  std::vector<long long> taken;
  for (int i = 0; i < takers; ++i) {
    WorkBudget part = budget->part(takers - i);
    while (!part.spent()) part.count();
    taken.push_back(part.scored());
    budget->add(part);
  }
  return taken;
}

TEST(WorkBudget, every_taker_gets_an_equal_share) {
  WorkBudget budget(100);
  EXPECT_EQ(dealtOut(&budget, 4), (std::vector<long long>{25, 25, 25, 25}));
  EXPECT_TRUE(budget.cutByWork());
  EXPECT_FALSE(budget.cutByTime());
}

TEST(WorkBudget, what_one_leaves_over_goes_to_those_after_it) {
  WorkBudget budget(90);
  WorkBudget first = budget.part(3);
  first.count(10);  // of 30
  budget.add(first);
  EXPECT_EQ(dealtOut(&budget, 2), (std::vector<long long>{40, 40}));
}

TEST(WorkBudget, a_taker_that_overdraws_leaves_less_but_nothing_below_zero) {
  WorkBudget budget(20);
  WorkBudget first = budget.part(2);
  first.count(35);
  EXPECT_TRUE(first.spent());
  budget.add(first);
  EXPECT_EQ(dealtOut(&budget, 2), (std::vector<long long>{0, 0}));
}

TEST(WorkBudget, nothing_is_cut_when_all_work_was_done) {
  WorkBudget budget(10);
  while (budget.scored() < 9 && !budget.spent()) budget.count();
  EXPECT_EQ(budget.scored(), 9);
  EXPECT_FALSE(budget.cutByWork());
}

TEST(WorkBudget, without_limits_nothing_is_ever_spent) {
  WorkBudget budget;
  for (int i = 0; i < 100000; ++i) {
    budget.count(1000);
    ASSERT_FALSE(budget.spent());
  }
  EXPECT_FALSE(budget.cutByWork());
  EXPECT_FALSE(budget.cutByTime());
}

// What a piece of at most `most` does before it stops.
WorkBudget donePiece(const WorkBudget& budget, long long most) {
  WorkBudget piece = budget.upTo(most);
  while (!piece.spent()) piece.count();
  return piece;
}

TEST(WorkBudget, a_piece_ends_at_its_size_which_cuts_nothing_of_the_whole) {
  for (WorkBudget budget : {WorkBudget(), WorkBudget(100)}) {
    budget.addPiece(donePiece(budget, 30));
    EXPECT_EQ(budget.scored(), 30);
    EXPECT_FALSE(budget.cutByWork());
  }
}

TEST(WorkBudget, a_piece_larger_than_what_is_left_is_cut_by_the_whole) {
  WorkBudget budget(100);
  budget.count(80);
  budget.addPiece(donePiece(budget, 30));
  EXPECT_EQ(budget.scored(), 100);
  EXPECT_TRUE(budget.cutByWork());
}

TEST(WorkBudget, time_that_is_over_stops_what_is_not_counted_too) {
  WorkBudget budget(0, 1e-9);
  EXPECT_TRUE(budget.outOfTime());
  EXPECT_TRUE(budget.spent());
  EXPECT_TRUE(budget.cutByTime());
  EXPECT_FALSE(budget.cutByWork());
}

}  // namespace
}  // namespace monocular_eye_hand
