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

TEST(WorkBudget, EveryTakerGetsAnEqualShare) {
  WorkBudget budget(100);
  EXPECT_EQ(dealtOut(&budget, 4), (std::vector<long long>{25, 25, 25, 25}));
  EXPECT_TRUE(budget.cutByWork());
  EXPECT_FALSE(budget.cutByTime());
}

TEST(WorkBudget, WhatOneLeavesOverGoesToThoseAfterIt) {
  WorkBudget budget(90);
  WorkBudget first = budget.part(3);
  first.count(10);  // of 30
  budget.add(first);
  EXPECT_EQ(dealtOut(&budget, 2), (std::vector<long long>{40, 40}));
}

TEST(WorkBudget, ATakerThatOverdrawsLeavesLessButNothingBelowZero) {
  WorkBudget budget(20);
  WorkBudget first = budget.part(2);
  first.count(35);
  EXPECT_TRUE(first.spent());
  budget.add(first);
  EXPECT_EQ(dealtOut(&budget, 2), (std::vector<long long>{0, 0}));
}

TEST(WorkBudget, NothingIsCutWhenAllWorkWasDone) {
  WorkBudget budget(10);
  while (budget.scored() < 9 && !budget.spent()) budget.count();
  EXPECT_EQ(budget.scored(), 9);
  EXPECT_FALSE(budget.cutByWork());
}

TEST(WorkBudget, WithoutLimitsNothingIsEverSpent) {
  WorkBudget budget;
  for (int i = 0; i < 100000; ++i) {
    budget.count(1000);
    ASSERT_FALSE(budget.spent());
  }
  EXPECT_FALSE(budget.cutByWork());
  EXPECT_FALSE(budget.cutByTime());
}

// What a piece of at most `most` does before it stops.
WorkBudget donePiece(const WorkBudget& budget, long long max_work) {
  WorkBudget piece = budget.upTo(max_work);
  while (!piece.spent()) piece.count();
  return piece;
}

TEST(WorkBudget, APieceEndsAtItsSizeWhichCutsNothingOfTheWhole) {
  for (WorkBudget budget : {WorkBudget(), WorkBudget(100)}) {
    budget.addPiece(donePiece(budget, 30));
    EXPECT_EQ(budget.scored(), 30);
    EXPECT_FALSE(budget.cutByWork());
  }
}

TEST(WorkBudget, APieceLargerThanWhatIsLeftIsCutByTheWhole) {
  WorkBudget budget(100);
  budget.count(80);
  budget.addPiece(donePiece(budget, 30));
  EXPECT_EQ(budget.scored(), 100);
  EXPECT_TRUE(budget.cutByWork());
}

TEST(WorkBudget, TimeThatIsOverStopsWhatIsNotCountedToo) {
  WorkBudget budget(0, 1e-9);
  EXPECT_TRUE(budget.outOfTime());
  EXPECT_TRUE(budget.spent());
  EXPECT_TRUE(budget.cutByTime());
  EXPECT_FALSE(budget.cutByWork());
}

}  // namespace
}  // namespace monocular_eye_hand
