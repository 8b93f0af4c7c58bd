#include "monocular_eye_hand/evaluation/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

TEST(Statistics, WilsonIntervalOfKnownShares) {
  EXPECT_NEAR(wilson95({8, 10}).low, 0.490, 5e-4);
  EXPECT_NEAR(wilson95({8, 10}).high, 0.943, 5e-4);
  EXPECT_EQ(wilson95({0, 5}).low, 0);
  EXPECT_NEAR(wilson95({0, 5}).high, 0.4345, 5e-4);
  EXPECT_NEAR(wilson95({5, 5}).low, 1 - 0.4345, 5e-4);
  EXPECT_EQ(wilson95({5, 5}).high, 1);
  EXPECT_EQ(wilson95({0, 0}).low, 0);
  EXPECT_EQ(wilson95({0, 0}).high, 1);
  EXPECT_THROW(wilson95({3, 2}), BadInput);
  EXPECT_THROW(wilson95({-1, 2}), BadInput);
}

TEST(Statistics, MedianOfOddEvenAndNone) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Statistics, McnemarIsTheBinomialOfTheChangedPairs) {
  PairedCounts pairs;
  for (int k = 0; k < 5; ++k) pairs.add(true, false);
  pairs.add(false, true);
  for (int k = 0; k < 7; ++k) pairs.add(true, true);
  pairs.add(false, false);
  EXPECT_EQ(pairs.only_a, 5);
  EXPECT_EQ(pairs.only_b, 1);
  EXPECT_EQ(pairs.both, 7);
  EXPECT_EQ(pairs.neither, 1);
  EXPECT_NEAR(pairs.chance(), 2 * (1 + 6) / 64.0, 1e-12);
  EXPECT_NEAR((PairedCounts{0, 10, 0, 0}.chance()), 2 / 1024.0, 1e-12);
  EXPECT_EQ((PairedCounts{9, 0, 0, 9}.chance()), 1);
  EXPECT_EQ((PairedCounts{0, 3, 3, 0}.chance()), 1);
}

TEST(Statistics, ReliabilityInBinsOfEqualCount) {
  // Five at 0.2 of which one is right, five at 0.8 of which three are right.
  std::vector<Prediction> all;
  for (int k = 0; k < 5; ++k) {
    all.push_back({0.8, k < 3});
    all.push_back({0.2, k < 1});
  }
  const auto bins = reliabilityBins(all, 2);
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_EQ(bins[0].right.part, 1);
  EXPECT_EQ(bins[0].right.whole, 5);
  EXPECT_NEAR(bins[0].mean_probability, 0.2, 1e-12);
  EXPECT_EQ(bins[1].right.part, 3);
  EXPECT_NEAR(bins[1].mean_probability, 0.8, 1e-12);
  EXPECT_NEAR(calibrationError(bins), (0 + 0.2) / 2, 1e-12);
}

TEST(Statistics, BinsHoldAllPredictionsAndNoneIsEmpty) {
  std::vector<Prediction> all;
  for (int k = 0; k < 23; ++k) all.push_back({k / 23.0, false});
  int count = 0;
  for (const ReliabilityBin& bin : reliabilityBins(all)) {
    EXPECT_GE(bin.right.whole, 2);
    EXPECT_LE(bin.right.whole, 3);
    count += bin.right.whole;
  }
  EXPECT_EQ(count, 23);
  EXPECT_EQ(reliabilityBins({{0.5, true}, {0.6, false}}).size(), 2u);
  EXPECT_TRUE(reliabilityBins({}).empty());
  EXPECT_TRUE(std::isnan(calibrationError({})));
  EXPECT_THROW(reliabilityBins({}, 0), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
