#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hand_made.h"

namespace monocular_eye_hand {
namespace {

using namespace hand_made;

const Eigen::Vector3d kCube(0.05, 0.05, 0.05), kBox(0.08, 0.05, 0.03);

TEST(ModelGroupings, CubeHasOneOfEachSimpleKind) {
  const std::vector<ModelGrouping> all = modelGroupings(known(box(kCube)));
  EXPECT_EQ(box(kCube).symmetries.discrete.size(), 24u);
  const auto edges = ofKind(all, GroupingKind::kEdge);
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].orders.size(), 1u);  // half a turn reverses an edge
  const auto junctions = ofKind(all, GroupingKind::kJunction);
  ASSERT_EQ(junctions.size(), 1u);  // 24 junctions, 24 rotations
  EXPECT_EQ(junctions[0].orders.size(), 2u);
  const auto triplets = ofKind(all, GroupingKind::kTriplet);
  ASSERT_EQ(triplets.size(), 1u);
  EXPECT_TRUE(triplets[0].oriented);
  EXPECT_EQ(triplets[0].orders.size(), 1u);

  const auto quads = ofKind(all, GroupingKind::kQuad);
  ASSERT_EQ(quads.size(), 1u);
  EXPECT_TRUE(quads[0].oriented);
  EXPECT_EQ(quads[0].orders.size(), 1u);
  // A U on a face, and a left-handed and a right-handed one in space.
  EXPECT_EQ(ofKind(all, GroupingKind::kChain).size(), 3u);
  // Across a face; the pair across the body is never visible as a whole with both... edges from one side.
  EXPECT_GE(ofKind(all, GroupingKind::kParallelPair).size(), 1u);
  EXPECT_TRUE(ofKind(all, GroupingKind::kEllipse).empty());
}

TEST(ModelGroupings, WithoutSymmetriesEverythingIsCounted) {
  const std::vector<ModelGrouping> all = modelGroupings(known(box(kBox, false)));
  EXPECT_EQ(ofKind(all, GroupingKind::kEdge).size(), 12u);
  EXPECT_EQ(ofKind(all, GroupingKind::kJunction).size(), 24u);
  EXPECT_EQ(ofKind(all, GroupingKind::kTriplet).size(), 8u);
  EXPECT_EQ(ofKind(all, GroupingKind::kQuad).size(), 6u);
  EXPECT_EQ(ofKind(all, GroupingKind::kChain).size(), 48u);
  for (const ModelGrouping& m : all) {
    EXPECT_FALSE(m.views.empty());
    const size_t orders = m.kind == GroupingKind::kTriplet                                         ? 3
                          : m.kind == GroupingKind::kQuad || m.kind == GroupingKind::kParallelPair ? 4
                                                                                                   : 2;
    EXPECT_EQ(m.orders.size(), orders) << toString(m.kind);
  }
}

TEST(ModelGroupings, KindsComeInOrderAndBestFirst) {
  const std::vector<ModelGrouping> all = modelGroupings(known(box(kBox)));
  for (size_t i = 1; i < all.size(); ++i) {
    EXPECT_LE(all[i - 1].kind, all[i].kind);
    if (all[i - 1].kind == all[i].kind) {
      EXPECT_GE(all[i - 1].weight, all[i].weight);
    }
  }
}

// The weight found from the fundamental domain and the symmetric copies equals the share of the whole sphere.
TEST(ModelGroupings, WeightIsTheShareOfTheViewSphere) {
  for (const Eigen::Vector3d& half : {kCube, kBox}) {
    const ObjectModel m = box(half);
    for (const ModelGrouping& g : modelGroupings(known(m, 20000))) {
      int count = 0;
      const auto directions = sphere(20000);
      for (const Eigen::Vector3d& d : directions) {
        bool all = true;
        for (int e : g.edges) all &= visible(m.edges[e], 2.5 * m.diameter * d);
        count += all;
      }
      EXPECT_NEAR(g.weight, double(count) / directions.size(), 0.01) << toString(g.kind);
    }
  }
}

TEST(ModelGroupings, SeenFromIsTheDirectionTurnedBack) {
  const ObjectModel m = box(kBox);
  const KnownObject object = known(m);
  for (const ModelGrouping& g : modelGroupings(object))
    for (const SeenFrom& s : g.seen) {
      const SampledView& view = object.views.views[s.view];
      const Rigid3 back = m.symmetries.discrete[s.symmetry].inverse();
      for (int e : g.edges) EXPECT_TRUE(visible(m.edges[e], back * (view.distance * view.direction)));
      EXPECT_TRUE(std::binary_search(g.views.begin(), g.views.end(), s.view));
    }
}

TEST(ModelGroupings, WithoutViewsAllAreKept) {
  const std::vector<ModelGrouping> all = modelGroupings({box(kBox, false), {}});
  EXPECT_EQ(ofKind(all, GroupingKind::kEdge).size(), 12u);
  EXPECT_EQ(all.front().weight, 0.0);
}

// Both in one model; hidden by each other they are not.
ObjectModel with(ObjectModel m, const ObjectModel& other, const Eigen::Vector3d& shift) {
  const int corners = int(m.corners.size()), edges = int(m.edges.size()), surfaces = int(m.surfaces.size());
  for (Surface surface : other.surfaces) {
    surface.point += shift;
    m.surfaces.push_back(surface);
  }
  for (auto corner : other.corners) {
    corner.p += shift;
    for (int& edge : corner.edges) edge += edges;
    m.corners.push_back(corner);
  }

  for (ModelEdge edge : other.edges) {
    edge.p += shift;
    edge.q += shift;
    for (int& vertex : edge.vertex) vertex += corners;
    for (int& surface : edge.surface) surface += surfaces;
    m.edges.push_back(edge);
  }
  return m;
}

TEST(ModelGroupings, OfVeryManyTheLargeOnesAreKept) {
  ObjectModel crumbs = box(kBox, false);
  const int large = int(crumbs.edges.size());
  for (int i = 1; i <= 30; ++i) crumbs = with(crumbs, box(0.04 * kBox, false), {0.01 * i, 0.2, 0});
  const std::vector<ModelGrouping> all = modelGroupings(known(crumbs, 100));
  const auto junctions = ofKind(all, GroupingKind::kJunction);
  EXPECT_EQ(junctions.size(), 500u) << "of 31 boxes with 24 each";
  const auto of_the_large_box = [&](const ModelGrouping& m) { return m.edges[0] < large; };
  EXPECT_EQ(std::count_if(junctions.begin(), junctions.end(), of_the_large_box), 24);
}

TEST(ModelGroupings, CirclesOfAFlange) {
  ObjectModel m;
  m.diameter = 0.1;
  m.bounds = Eigen::AlignedBox3d(Eigen::Vector3d(-0.04, -0.04, 0), Eigen::Vector3d(0.04, 0.04, 0.04));
  for (const auto& [radius, z] : {std::pair{0.04, 0.0}, {0.04, 0.01}, {0.02, 0.01}, {0.02, 0.04}}) {
    ModelCircle c;
    c.centre = {0, 0, z};
    c.axis = Eigen::Vector3d::UnitZ();
    c.x_axis = Eigen::Vector3d::UnitX();
    c.radius = radius;
    c.sweep = 2 * M_PI;
    m.circles.push_back(c);
  }

  ModelCircle aside = m.circles[0];  // a bolt hole: parallel axis, but not the same
  aside.centre.x() = 0.03;
  aside.radius = 0.004;
  m.circles.push_back(aside);
  const std::vector<ModelGrouping> all = modelGroupings({m, {}});
  EXPECT_EQ(ofKind(all, GroupingKind::kEllipse).size(), 5u);
  EXPECT_EQ(ofKind(all, GroupingKind::kEllipsePair).size(), 6u);
  EXPECT_TRUE(ofKind(all, GroupingKind::kEllipseLine).empty());
  EXPECT_TRUE(ofKind(all, GroupingKind::kEdge).empty());
}

TEST(ModelGroupings, CircleAndEveryEdge) {
  ObjectModel m = box(kBox, false);
  ModelCircle hole;
  hole.centre = {0, 0, 0.03};
  hole.axis = Eigen::Vector3d::UnitZ();
  hole.x_axis = Eigen::Vector3d::UnitX();
  hole.radius = 0.01;
  hole.sweep = 2 * M_PI;
  m.circles.push_back(hole);
  const auto lines = ofKind(modelGroupings({m, {}}), GroupingKind::kEllipseLine);
  ASSERT_EQ(lines.size(), 12u);
  EXPECT_EQ(lines[0].circles, std::vector<int>{0});
  EXPECT_EQ(lines[0].points.size(), 2u);
}

/// Is there an order that puts every image point on the projection of its model point?
bool explained(const Grouping& image, const ModelGrouping& model, const Camera& camera, const Rigid3& pose,
               const std::vector<Rigid3>& symmetries, double tolerance) {
  for (const Correspondence& order : correspondences(image, model))
    for (const Rigid3& s : symmetries) {
      bool all = true;
      for (size_t i = 0; i < image.points.size() && all; ++i) {
        const Eigen::Vector3d p = pose * (s * model.points[order.points[i]]);
        all = (camera.project(p) - image.points[i]).norm() < tolerance;
      }
      if (all) return true;
    }
  return false;
}

/// Do the model edges behind an image grouping meet where its segments do?
bool connected(const ObjectModel& m, const Grouping& g, const std::vector<int>& edges) {
  const auto meet = [&](int i, int j) {
    const auto &a = m.edges[edges[g.segments[i]]].vertex, &b = m.edges[edges[g.segments[j]]].vertex;
    return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
  };
  const int count = int(g.segments.size());
  for (int i = 0; i + 1 < count; ++i)
    if (!meet(i, i + 1)) return false;
  return g.kind != GroupingKind::kQuad || meet(0, count - 1);
}

// Every grouping found in images of a box is the image of some model grouping in one of the admissible
// orders: neither the symmetries, nor the turning sense, nor the U / Z rule leave a true one out.
TEST(Correspondences, HoldEveryTrueOrder) {
  std::mt19937 random(7);
  for (const Eigen::Vector3d& half : {kCube, kBox}) {
    for (bool symmetric : {true, false}) {
      const ObjectModel m = box(half, symmetric);
      const KnownObject object = known(m);
      const std::vector<ModelGrouping> groupings = modelGroupings(object);
      ModelBase base;
      base.objects.push_back(object);
      std::array<int, kGroupingKinds> checked{};

      for (int trial = 0; trial < 60; ++trial) {
        const Rigid3 pose = randomPose(&random, 0.45);
        std::vector<int> edges;
        const FeatureSet f = project(m, pose, &edges, &random, 0.05);
        for (const Grouping& g : groupFeatures(f, base)) {
          if (g.kind >= GroupingKind::kParallelPair || g.shape == GroupingShape::kT) continue;
          // Is it true structure? Corners of the image that are corners of the model.
          bool cut_off = false;
          for (double sigma : g.sigma) cut_off |= sigma >= kCutOffSigma;
          if (cut_off || g.shape == GroupingShape::kOpen) continue;
          if (!connected(m, g, edges)) continue;
          ++checked[int(g.kind)];
          const bool any = std::any_of(groupings.begin(), groupings.end(), [&](const ModelGrouping& model) {
            return explained(g, model, f.camera, pose, m.symmetries.discrete, 4.0);
          });
          EXPECT_TRUE(any) << toString(g.kind) << " " << toString(g.shape) << " trial " << trial;
        }
      }

      for (GroupingKind kind : {GroupingKind::kEdge, GroupingKind::kJunction, GroupingKind::kTriplet,
                                GroupingKind::kChain, GroupingKind::kQuad})
        EXPECT_GT(checked[int(kind)], 20) << toString(kind);
    }
  }
}

// Orders are permutations, and segments go with their points.
TEST(Correspondences, KeepSegmentsWithTheirPoints) {
  for (const ModelGrouping& m : modelGroupings({box(kBox, false), {}})) {
    const ObjectModel b = box(kBox, false);
    for (const Correspondence& order : m.orders) {
      std::set<int> used;
      for (size_t i = 0; i < m.points.size(); ++i) used.insert(order.points[i]);
      EXPECT_EQ(used.size(), m.points.size());
      if (m.kind != GroupingKind::kQuad) continue;
      for (int i = 0; i < 4; ++i) {
        const ModelEdge& e = b.edges[m.edges[order.segments[i]]];
        const Eigen::Vector3d &p = m.points[order.points[i]], &q = m.points[order.points[(i + 1) % 4]];
        EXPECT_NEAR(std::min((e.p - p).norm() + (e.q - q).norm(), (e.p - q).norm() + (e.q - p).norm()), 0,
                    1e-9);
      }
    }
  }
}

TEST(Correspondences, OtherKindsAndFlatShapesDoNotMatch) {
  Grouping image;
  image.kind = GroupingKind::kChain;
  image.shape = GroupingShape::kZ;
  for (const ModelGrouping& m : modelGroupings({box(kBox, false), {}})) {
    const auto& orders = correspondences(image, m);
    EXPECT_EQ(orders.empty(), m.kind != GroupingKind::kChain || m.shape == GroupingShape::kU);
  }
}

}  // namespace
}  // namespace monocular_eye_hand
