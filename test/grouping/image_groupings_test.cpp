#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>
#include <set>

#include "hand_made.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace hand_made;
using testing::HasSubstr;

ModelBase oneBox() {
  ModelBase base;
  base.objects.push_back(known(box({0.08, 0.05, 0.03}), 200));
  return base;
}

std::vector<Grouping> grouped(const FeatureSet& f) { return groupFeatures(f, oneBox()); }

TEST(Junction, CornerIsTheLinesIntersection) {
  FeatureSet f = empty();
  addSegment(&f, {102, 100}, {200, 100});
  addSegment(&f, {100, 180}, {100, 103});
  const auto found = ofKind(grouped(f), GroupingKind::kJunction);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR((found[0].points[1] - Eigen::Vector2d(100, 100)).norm(), 0, 1e-9);
  EXPECT_NEAR((found[0].points[0] - Eigen::Vector2d(200, 100)).norm(), 0, 1e-9);
  EXPECT_NEAR((found[0].points[2] - Eigen::Vector2d(100, 180)).norm(), 0, 1e-9);
  EXPECT_LT(found[0].sigma[1], 0.3);
  EXPECT_GT(found[0].weight, 0.5);
}

TEST(Junction, SigmaOfTheCornerIsThatOfItsLines) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  FeatureSet f = empty();
  addSegment(&f, {102, 100}, {200, 100});
  addSegment(&f, {101, 102}, {160, 150});
  const double sigma = ofKind(grouped(f), GroupingKind::kJunction).at(0).sigma[1];
  double sum = 0;
  const int trials = 2000;
  Eigen::Vector2d mean = ofKind(grouped(f), GroupingKind::kJunction).at(0).points[1];
  for (int i = 0; i < trials; ++i) {
    FeatureSet g = f;
    for (LineSegment& s : g.segments) {  // draw the line from its own covariance
      const Eigen::Vector2d d = s.direction(), n(d.y(), -d.x()), middle = 0.5 * (s.p + s.q);
      const double offset = s.sigma_offset * normal(random), turn = s.sigma_angle * normal(random);
      const double half = 0.5 * s.length();
      s.p = middle + offset * n - half * (d + turn * n);
      s.q = middle + offset * n + half * (d + turn * n);
    }
    const EndMap map = mapEnds(g, {});
    ASSERT_EQ(map.corners.size(), 1u);
    sum += 0.5 * (map.corners[0].p - mean).squaredNorm();
  }

  EXPECT_NEAR(std::sqrt(sum / trials), sigma, 0.1 * sigma);
}

TEST(Junction, GapsAndFlatAnglesMakeNone) {
  FeatureSet far = empty();
  addSegment(&far, {112, 100}, {200, 100});
  addSegment(&far, {100, 180}, {100, 112});
  EXPECT_TRUE(ofKind(grouped(far), GroupingKind::kJunction).empty());
  FeatureSet flat = empty();
  addSegment(&flat, {100, 100}, {200, 100});
  addSegment(&flat, {98, 100}, {10, 108});
  EXPECT_TRUE(ofKind(grouped(flat), GroupingKind::kJunction).empty());
  FeatureSet shorts = empty();  // 6 px from corners of 12 px segments: more than a quarter
  addSegment(&shorts, {106, 100}, {118, 100});
  addSegment(&shorts, {100, 106}, {100, 118});
  EXPECT_TRUE(ofKind(grouped(shorts), GroupingKind::kJunction).empty());
}

double junctionWeight(double gap, double length, double contrast, int clutter) {
  FeatureSet f = empty();
  addSegment(&f, {300 + gap, 200}, {300 + length, 200});
  addSegment(&f, {300, 200 + length}, {300, 200});
  for (LineSegment& s : f.segments) s.contrast = contrast;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-30, -14);
  for (int i = 0; i < clutter; ++i) {
    const Eigen::Vector2d p(300 + at(random), 200 + at(random));
    addSegment(&f, p, p + Eigen::Vector2d(-10, -9));
  }
  for (const Grouping& g : grouped(f))
    if (g.kind == GroupingKind::kJunction && g.segments == std::vector<int>{0, 1}) return g.weight;
  return -1;
}

TEST(Weight, FallsWithGapAndClutterRisesWithLengthAndContrast) {
  const double plain = junctionWeight(2, 60, 20, 0);
  EXPECT_GT(plain, 0);
  EXPECT_LT(plain, 1);
  EXPECT_GT(plain, junctionWeight(5, 60, 20, 0));
  EXPECT_GT(junctionWeight(5, 60, 20, 0), junctionWeight(7, 60, 20, 0));
  EXPECT_GT(plain, junctionWeight(2, 60, 20, 20));
  EXPECT_GT(junctionWeight(2, 60, 20, 20), junctionWeight(2, 60, 20, 60));
  EXPECT_LT(plain, junctionWeight(2, 120, 20, 0));
  EXPECT_LT(plain, junctionWeight(2, 60, 40, 0));
}

Grouping onlyTriplet(const std::vector<double>& degrees) {
  FeatureSet f = empty();
  for (double angle : degrees) {
    const Eigen::Vector2d d(std::cos(angle * M_PI / 180), std::sin(angle * M_PI / 180));
    addSegment(&f, Eigen::Vector2d(300, 200) + 1.5 * d, Eigen::Vector2d(300, 200) + 80 * d);
  }
  const auto found = ofKind(grouped(f), GroupingKind::kTriplet);
  EXPECT_EQ(found.size(), 1u);
  return found.empty() ? Grouping{} : found[0];
}

TEST(Triplet, ArrowYAndT) {
  EXPECT_EQ(onlyTriplet({0, 50, 100}).shape, GroupingShape::kArrow);
  EXPECT_EQ(onlyTriplet({0, 120, 240}).shape, GroupingShape::kY);
  EXPECT_EQ(onlyTriplet({0, 90, 180}).shape, GroupingShape::kT);
  EXPECT_LT(onlyTriplet({0, 90, 180}).weight, onlyTriplet({0, 120, 240}).weight);
}

TEST(Triplet, FarEndsComeInAngularOrder) {
  const Grouping g = onlyTriplet({240, 10, 130});
  ASSERT_EQ(g.points.size(), 4u);
  EXPECT_NEAR((g.points[0] - Eigen::Vector2d(300, 200)).norm(), 0, 1e-6);
  double last = -4;
  for (int i = 1; i < 4; ++i) {
    const Eigen::Vector2d d = g.points[i] - g.points[0];
    EXPECT_GT(std::atan2(d.y(), d.x()), last);
    last = std::atan2(d.y(), d.x());
  }
}

FeatureSet rectangle(int sides) {
  FeatureSet f = empty();
  const Eigen::Vector2d c[4] = {{200, 150}, {320, 160}, {310, 260}, {195, 250}};
  for (int i = 0; i < sides; ++i) {
    const Eigen::Vector2d d = (c[(i + 1) % 4] - c[i]).normalized();
    addSegment(&f, c[i] + d, c[(i + 1) % 4] - d);
  }
  return f;
}

TEST(Quad, ClosedOnceAndInTurningOrder) {
  const auto all = grouped(rectangle(4));
  int closed = 0;
  for (const Grouping& g : ofKind(all, GroupingKind::kQuad)) {
    double area = 0;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d &p = g.points[i], &q = g.points[(i + 1) % 4];
      area += p.x() * q.y() - p.y() * q.x();
    }
    EXPECT_GT(area, 0);  // growing atan2(v, u)
    if (g.shape != GroupingShape::kClosed) continue;
    ++closed;
    EXPECT_EQ(std::set<int>(g.segments.begin(), g.segments.end()), (std::set<int>{0, 1, 2, 3}));
    const FeatureSet f = rectangle(4);
    for (int i = 0; i < 4; ++i) {  // segments[i] joins points[i] and points[i + 1]
      const Eigen::Vector2d middle = 0.5 * (g.points[i] + g.points[(i + 1) % 4]);
      const LineSegment& s = f.segments[g.segments[i]];
      EXPECT_LT((0.5 * (s.p + s.q) - middle).norm(), 1.0);
    }
  }

  EXPECT_EQ(closed, 1);
  EXPECT_EQ(ofKind(all, GroupingKind::kJunction).size(), 4u);
  EXPECT_EQ(ofKind(all, GroupingKind::kChain).size(), 4u);
}

TEST(Quad, OneSideMissing) {
  const auto all = grouped(rectangle(3));
  const auto quads = ofKind(all, GroupingKind::kQuad);
  ASSERT_EQ(quads.size(), 1u);
  EXPECT_EQ(quads[0].shape, GroupingShape::kOpen);
  EXPECT_EQ(quads[0].segments.size(), 3u);
  const auto chains = ofKind(all, GroupingKind::kChain);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].shape, GroupingShape::kU);
  EXPECT_LT(quads[0].weight, chains[0].weight);
}

TEST(Chain, ZWhenTheFarEndsLieOnDifferentSides) {
  FeatureSet f = empty();
  addSegment(&f, {100, 101}, {100, 200});
  addSegment(&f, {101, 100}, {199, 100});
  addSegment(&f, {200, 99}, {200, 20});
  const auto chains = ofKind(grouped(f), GroupingKind::kChain);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].shape, GroupingShape::kZ);
  EXPECT_EQ(chains[0].segments[1], 1);
  EXPECT_TRUE(ofKind(grouped(f), GroupingKind::kQuad).empty());
}

TEST(ParallelPair, SideBySideInOneSense) {
  FeatureSet f = empty();
  addSegment(&f, {100, 100}, {200, 102});
  addSegment(&f, {205, 140}, {110, 139});
  addSegment(&f, {300, 100}, {400, 100});  // beside neither
  addSegment(&f, {100, 101}, {200, 103});  // one doubled edge
  const auto pairs = ofKind(grouped(f), GroupingKind::kParallelPair);
  ASSERT_EQ(pairs.size(), 2u);
  for (const Grouping& g : pairs) {
    EXPECT_EQ(g.segments[0] == 1 || g.segments[1] == 1, true);
    EXPECT_GT((g.points[1] - g.points[0]).dot(g.points[3] - g.points[2]), 0);
  }
}

TEST(EllipsePair, AlongTheMinorAxisOnly) {
  FeatureSet f = empty();
  const double angle = 0.4;
  const Eigen::Vector2d minor(-std::sin(angle), std::cos(angle)), major(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d c(250, 200);
  addEllipse(&f, c, 60, 30, angle);
  addEllipse(&f, c + 40 * minor, 58, 30, angle + 0.03);  // the other rim of a cylinder
  addEllipse(&f, c + 45 * major, 60, 30, angle);         // beside it
  addEllipse(&f, c + 20 * minor, 60, 55, angle);         // another tilt
  addEllipse(&f, c + 2 * minor, 25, 12.5, angle);        // a hole about the same axis
  std::set<std::vector<int>> pairs;
  for (const Grouping& g : ofKind(grouped(f), GroupingKind::kEllipsePair)) pairs.insert(g.ellipses);
  EXPECT_EQ(pairs, (std::set<std::vector<int>>{{0, 1}, {0, 4}, {1, 4}}));
}

TEST(EllipseLine, NearSegmentsOnly) {
  FeatureSet f = empty();
  addEllipse(&f, {250, 200}, 20, 15, 0);
  addSegment(&f, {200, 240}, {300, 240});
  addSegment(&f, {500, 400}, {600, 400});
  const auto lines = ofKind(grouped(f), GroupingKind::kEllipseLine);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].segments, std::vector<int>{0});
  EXPECT_EQ(lines[0].points.size(), 2u);
}

FeatureSet randomSegments(int count, unsigned seed) {
  FeatureSet f = empty();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(5, 635), v(5, 475), turn(0, 2 * M_PI), length(8, 60);
  for (int i = 0; i < count; ++i) {
    const double angle = turn(random);
    const Eigen::Vector2d p(u(random), v(random));
    addSegment(&f, p, p + length(random) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  for (int i = 0; i < count / 20; ++i)
    addEllipse(&f, {u(random), v(random)}, length(random), 7, turn(random), 0.4);
  return f;
}

TEST(Cover, HoldsEveryFeature) {
  for (int count : {0, 1, 50, 1500}) {
    const FeatureSet f = randomSegments(count, 11);
    GroupingOptions options;
    options.max_per_kind = 10;
    std::set<int> segments, ellipses;
    for (const Grouping& g : groupFeatures(f, oneBox(), options)) {
      segments.insert(g.segments.begin(), g.segments.end());
      ellipses.insert(g.ellipses.begin(), g.ellipses.end());
      EXPECT_GT(g.weight, 0);
      EXPECT_LT(g.weight, 1);
      EXPECT_EQ(g.points.size(), g.sigma.size());
      for (double sigma : g.sigma) EXPECT_TRUE(sigma > 0 && std::isfinite(sigma));
    }
    EXPECT_EQ(segments.size(), f.segments.size());
    EXPECT_EQ(ellipses.size(), f.ellipses.size());
  }
}

TEST(GroupFeatures, KeepsTheBestOfAKind) {
  const FeatureSet f = randomSegments(1500, 2);
  GroupingOptions few, many;
  few.max_per_kind = 5;
  const auto best = ofKind(groupFeatures(f, oneBox(), few), GroupingKind::kJunction);
  const auto all = ofKind(groupFeatures(f, oneBox(), many), GroupingKind::kJunction);
  ASSERT_EQ(best.size(), 5u);
  ASSERT_GT(all.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(best[i].segments, all[i].segments);
}

TEST(GroupFeatures, IsTheSameEveryTime) {
  const FeatureSet f = randomSegments(800, 4);
  const auto a = grouped(f), b = grouped(f);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].kind, b[i].kind);
    EXPECT_EQ(a[i].segments, b[i].segments);
    EXPECT_EQ(a[i].weight, b[i].weight);
    EXPECT_EQ(a[i].candidates, b[i].candidates);
  }
}

TEST(GroupFeatures, DoesNotExplodeInClutter) {
  const FeatureSet f = randomSegments(2000, 9);
  const ModelBase base = oneBox();
  const std::clock_t start = std::clock();  // of this process: other work on the machine does not count
  const auto all = groupFeatures(f, base);
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  RecordProperty("milliseconds", int(1000 * seconds));
  EXPECT_LT(seconds, 1.0);  // the bound leaves room for slow machines
  for (int kind = 1; kind < kGroupingKinds; ++kind) EXPECT_LE(ofKind(all, GroupingKind(kind)).size(), 4000u);
  // A star of a thousand ends in one place: the worst case for pairs of ends.
  FeatureSet star = empty();
  for (int i = 0; i < 1000; ++i) {
    const double angle = i * 2.399963;
    addSegment(&star, {320, 240},
               Eigen::Vector2d(320, 240) + 100 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  EXPECT_LE(mapEnds(star, {}).corners.size(), 1000u * 8);
  EXPECT_LE(ofKind(groupFeatures(star, base), GroupingKind::kTriplet).size(), 4000u);
}

TEST(GroupFeatures, OddInput) {
  EXPECT_TRUE(groupFeatures(empty(), {}).empty());
  FeatureSet f = rectangle(4);
  for (const Grouping& g : groupFeatures(f, {})) EXPECT_TRUE(g.candidates.empty());
  FeatureSet outside = empty();  // rectified features can lie outside the image
  addSegment(&outside, {-80, -60}, {-20, -50});
  addSegment(&outside, {700, 500}, {900, 640});
  EXPECT_EQ(groupFeatures(outside, {}).size(), 2u);
}

TEST(Candidates, NeedWhatTheGroupingShows) {
  ModelBase base = oneBox();
  ObjectModel ring;
  ring.name = "ring";
  ring.diameter = 0.1;
  ring.circles.resize(1);
  ring.circles[0].centre.setZero();
  ring.circles[0].axis.setUnit(2);
  ring.circles[0].x_axis.setUnit(0);
  ring.circles[0].radius = 0.05;
  base.objects.push_back({ring, {}});
  FeatureSet f = rectangle(4);
  addEllipse(&f, {260, 200}, 20, 15, 0);
  addEllipse(&f, {262, 200}, 30, 22, 0);

  for (const Grouping& g : groupFeatures(f, base)) {
    if (g.kind == GroupingKind::kEllipse)
      EXPECT_EQ(g.candidates, std::vector<int>{1});
    else if (g.kind == GroupingKind::kEllipsePair || g.kind == GroupingKind::kEllipseLine)
      EXPECT_TRUE(g.candidates.empty());
    else
      EXPECT_EQ(g.candidates, std::vector<int>{0}) << toString(g.kind);
  }
}

TEST(Options, AreChecked) {
  GroupingOptions().check();
  const auto message = [](GroupingOptions o) -> std::string {
    return refusal([&] { groupFeatures(empty(), {}, o); });
  };
  GroupingOptions o;
  o.corner_gap = -1;
  EXPECT_THAT(message(o), HasSubstr("corner_gap = -1"));
  o = {};
  o.corner_gap_ratio = 0.7;
  EXPECT_THAT(message(o), HasSubstr("corner_gap_ratio = 0.7"));

  o = {};
  o.max_per_kind = 0;
  EXPECT_THAT(message(o), HasSubstr("max_per_kind = 0"));
  o = {};
  o.min_corner_angle = std::nan("");
  EXPECT_THAT(message(o), HasSubstr("min_corner_angle"));
  std::set<std::string> names;
  o.visit([&](const char* field, auto&) { names.insert(field); });
  EXPECT_EQ(names.size(), 13u);
}

}  // namespace
}  // namespace monocular_eye_hand
