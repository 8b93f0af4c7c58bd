#include <gtest/gtest.h>

#include "hand_made.h"

namespace monocular_eye_hand {
namespace {

using namespace hand_made;

Grouping edge(const FeatureSet& f, int segment) {
  for (const Grouping& g : groupFeatures(f, {}))
    if (g.kind == GroupingKind::kEdge && g.segments[0] == segment) return g;
  return {};
}

TEST(Ends, StemOfATIsCutOff) {
  FeatureSet f = empty();
  addSegment(&f, {100, 200}, {300, 200});
  const int stem = addSegment(&f, {200, 198}, {210, 100});
  const EndMap map = mapEnds(f, {});
  EXPECT_EQ(map.state[2 * stem], EndState::kStem);
  EXPECT_EQ(map.state[2 * stem + 1], EndState::kFree);
  EXPECT_EQ(map.state[0], EndState::kFree);
  const Grouping g = edge(f, stem);
  EXPECT_GE(g.sigma[0], kCutOffSigma);
  EXPECT_LT(g.sigma[1], kCutOffSigma);
}

TEST(Ends, StemOfABrokenBarIsCutOff) {
  FeatureSet f = empty();
  addSegment(&f, {100, 200}, {198, 200});
  addSegment(&f, {202, 200}, {300, 200});
  const int stem = addSegment(&f, {200, 198}, {210, 100});
  const EndMap map = mapEnds(f, {});
  EXPECT_EQ(map.state[2 * stem], EndState::kStem);
  EXPECT_EQ(map.state[1], EndState::kContinued);
  EXPECT_EQ(map.state[2], EndState::kContinued);
  EXPECT_EQ(map.continued_by[1], std::vector<int>{2});
  const auto triplets = ofKind(groupFeatures(f, {}), GroupingKind::kTriplet);
  ASSERT_EQ(triplets.size(), 1u);
  EXPECT_EQ(triplets[0].shape, GroupingShape::kT);
}

TEST(Ends, CornerBesideAPassingLineStaysACorner) {
  FeatureSet f = empty();
  addSegment(&f, {100, 200}, {300, 200});
  const int a = addSegment(&f, {200, 201}, {150, 300});
  addSegment(&f, {201, 201}, {260, 290});
  EXPECT_EQ(mapEnds(f, {}).state[2 * a], EndState::kCorner);
}

TEST(Ends, BorderCutsOff) {
  FeatureSet f = empty();
  addSegment(&f, {2, 200}, {100, 220});
  const EndMap map = mapEnds(f, {});
  EXPECT_EQ(map.state[0], EndState::kBorder);
  EXPECT_EQ(map.state[1], EndState::kFree);
  EXPECT_GE(edge(f, 0).sigma[0], kCutOffSigma);
}

TEST(Ends, BorderIsThatOfTheRawImage) {
  FeatureSet f = empty();
  f.camera.model = DistortionModel::kPlumbBob;
  f.camera.d[0] = -0.28;
  const Eigen::Vector2d uv = f.camera.undistort({1, 240});
  ASSERT_LT(uv.x(), -10);
  addSegment(&f, uv, {100, 240});
  addSegment(&f, {2, 100}, {100, 120});  // well inside the raw image
  const EndMap map = mapEnds(f, {});
  EXPECT_EQ(map.state[0], EndState::kBorder);
  EXPECT_EQ(map.state[2], EndState::kFree);
}

FeatureSet joined() {
  FeatureSet f = empty();
  addSegment(&f, {100, 200}, {200, 200});
  addSegment(&f, {230, 200}, {330, 200});
  addSegment(&f, {99, 199}, {99, 100});
  const int whole = addSegment(&f, {100, 200}, {330, 200});
  f.segments[whole].piece_count = 2;
  f.joined_pieces = {0, 1};
  return f;
}

TEST(Ends, PiecesOfAJoinedSegmentGoOn) {
  const EndMap map = mapEnds(joined(), {});
  EXPECT_EQ(map.state[1], EndState::kContinued);
  EXPECT_EQ(map.state[2], EndState::kContinued);
  EXPECT_EQ(map.state[0], EndState::kCorner);
  EXPECT_EQ(map.state[6], EndState::kCorner);
  EXPECT_EQ(map.state[7], EndState::kFree);
}

TEST(Ends, JoinedSegmentsMakeGroupingsOfTheirOwn) {
  std::vector<Eigen::Vector2d> far;
  for (const Grouping& g : ofKind(groupFeatures(joined(), {}), GroupingKind::kJunction)) {
    ASSERT_EQ(g.segments[1] == 2 || g.segments[0] == 2, true);
    far.push_back(g.segments[0] == 2 ? g.points[2] : g.points[0]);
  }
  ASSERT_EQ(far.size(), 2u);  // with the piece, and with the whole
  EXPECT_NEAR(std::max(far[0].x(), far[1].x()), 330, 1e-9);
  EXPECT_NEAR(std::min(far[0].x(), far[1].x()), 200, 1e-9);
}

TEST(Ends, EdgeEndsAtTheCornerFoundThere) {
  FeatureSet f = empty();
  addSegment(&f, {102, 100}, {200, 100});
  addSegment(&f, {100, 103}, {100, 180});
  const Grouping g = edge(f, 0);
  EXPECT_NEAR((g.points[0] - Eigen::Vector2d(100, 100)).norm(), 0, 1e-9);
  EXPECT_LT(g.sigma[0], 0.3);
  EXPECT_GE(g.sigma[1], 1.0);  // a free end may be a lost contrast
}

}  // namespace
}  // namespace monocular_eye_hand
