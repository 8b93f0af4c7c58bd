#include <gtest/gtest.h>

#include <algorithm>

#include "hand_made.h"
#include "monocular_eye_hand/model/contour.h"
#include "monocular_eye_hand/model/model_base.h"

// The models that ship with the package, seen from random sides: bridges and frames have concave corners,
// openings and holes that a box has not.
namespace monocular_eye_hand {
namespace {

using namespace hand_made;

const ModelBase& shipped() {
  static const ModelBase base =
      loadModels(MONOCULAR_EYE_HAND_SOURCE_DIR "/config/objects.yaml", ModelDepth::kViews, {}, "none");
  return base;
}

const KnownObject& shippedObject(const std::string& object) {
  return shipped().objects.at(shipped().indexOf(object));
}

size_t count(const std::string& object, GroupingKind kind) {
  return ofKind(modelGroupings(shippedObject(object)), kind).size();
}

/// Images of the edges that are visible over their whole length; segment i shows edge (*edges)[i].
FeatureSet projectVisible(const ObjectModel& m, const Rigid3& camera_from_object, std::vector<int>* edges,
                          std::mt19937* random) {
  FeatureSet f = empty();
  ContourOptions options;
  options.step = m.diameter / 150;
  std::vector<int> samples(m.featureCount(), 0);
  for (const ContourSample& s : visibleContour(m, camera_from_object.inverse().translation, options))
    ++samples[s.feature];

  edges->clear();
  std::normal_distribution<double> normal(0, 0.05);
  for (int e = 0; e < int(m.edges.size()); ++e) {
    const double length = (m.edges[e].q - m.edges[e].p).norm();
    if (samples[m.featureOfEdge(e)] < 0.95 * length / options.step) continue;
    Eigen::Vector2d p = f.camera.project(camera_from_object * m.edges[e].p);
    Eigen::Vector2d q = f.camera.project(camera_from_object * m.edges[e].q);
    if ((p - q).norm() < 20) continue;
    const Eigen::Vector2d d = (q - p).normalized();
    p += d + Eigen::Vector2d(normal(*random), normal(*random));
    q -= d + Eigen::Vector2d(normal(*random), normal(*random));
    if ((*random)() % 2) std::swap(p, q);
    addSegment(&f, p, q);
    edges->push_back(e);
  }
  return f;
}

/// The model point at which two edges meet; null when they do not.
const Eigen::Vector3d* meetingPoint(const ObjectModel& m, int a, int b) {
  for (const Eigen::Vector3d* p : {&m.edges[a].p, &m.edges[a].q})
    for (const Eigen::Vector3d* q : {&m.edges[b].p, &m.edges[b].q})
      if (a != b && (*p - *q).norm() < 1e-4 * m.diameter) return p;
  return nullptr;
}

/// Is a junction, triplet, chain or quad made of edges that meet in the model where the segments meet in the
/// image, and are its far ends the edges' far ends?
bool trueStructure(const ObjectModel& m, const Grouping& g, const std::vector<int>& edges,
                   const Camera& camera, const Rigid3& pose) {
  for (double sigma : g.sigma)
    if (sigma >= kCutOffSigma) return false;

  const auto at = [&](int i, int j, int point) {
    const Eigen::Vector3d* p = meetingPoint(m, edges[g.segments[i]], edges[g.segments[j]]);
    return p != nullptr && (camera.project(pose * *p) - g.points[point]).norm() < 3.0;
  };
  const auto ends = [&](int i, int point) {
    const ModelEdge& e = m.edges[edges[g.segments[i]]];
    return std::min((camera.project(pose * e.p) - g.points[point]).norm(),
                    (camera.project(pose * e.q) - g.points[point]).norm()) < 3.0;
  };

  switch (g.kind) {
    case GroupingKind::kEdge:
      return ends(0, 0) && ends(0, 1);
    case GroupingKind::kJunction:
      return at(0, 1, 1) && ends(0, 0) && ends(1, 2);
    case GroupingKind::kTriplet:
      return g.shape != GroupingShape::kT && at(0, 1, 0) && at(1, 2, 0) && at(0, 2, 0) && ends(0, 1) &&
             ends(1, 2) && ends(2, 3);
    case GroupingKind::kChain:
      return at(0, 1, 1) && at(1, 2, 2) && ends(0, 0) && ends(2, 3);
    case GroupingKind::kQuad:
      return g.shape == GroupingShape::kClosed && at(3, 0, 0) && at(0, 1, 1) && at(1, 2, 2) && at(2, 3, 3);
    default:
      return false;
  }
}

bool explained(const Grouping& image, const ModelGrouping& model, const KnownObject& object,
               const Camera& camera, const Rigid3& pose) {
  for (const Correspondence& order : correspondences(image, model))
    for (const Rigid3& s : object.model.symmetries.discrete) {
      bool all = true;
      for (size_t i = 0; i < image.points.size() && all; ++i)
        all = (camera.project(pose * (s * model.points[order.points[i]])) - image.points[i]).norm() < 4.0;
      if (all) return true;
    }
  return false;
}

bool flat(const KnownObject& object, const Grouping& g, const std::vector<int>& edges) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const ObjectModel& m = object.model;
  const auto direction = [&](int i) {
    const ModelEdge& e = m.edges[edges[g.segments[i]]];
    return Eigen::Vector3d((e.q - e.p).normalized());
  };
  for (size_t i = 1; i < g.segments.size(); ++i)
    if (normal.norm() < 0.1) normal = direction(0).cross(direction(int(i)));
  for (size_t i = 1; i < g.segments.size(); ++i)
    if (std::abs(normal.normalized().dot(direction(int(i)))) > 0.02) return false;
  return true;
}

class Shipped : public testing::TestWithParam<const char*> {};

TEST_P(Shipped, CandidatesAndOrdersHoldTheTruth) {
  const KnownObject& object = shippedObject(GetParam());
  const int index = shipped().indexOf(GetParam());
  const std::vector<ModelGrouping> groupings = modelGroupings({object.model, {}});  // whatever the views show
  std::mt19937 random(17);
  int checked = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Rigid3 pose = randomPose(&random, 2.2 * object.model.diameter);
    pose.translation -= pose.rotation * object.model.centre();
    std::vector<int> edges;
    const FeatureSet f = projectVisible(object.model, pose, &edges, &random);
    for (const Grouping& g : groupFeatures(f, shipped())) {
      if (!trueStructure(object.model, g, edges, f.camera, pose)) continue;
      // A ring in space is no face, even when it looks like one.
      if (g.kind == GroupingKind::kQuad && !flat(object, g, edges)) continue;
      ++checked;
      EXPECT_TRUE(std::binary_search(g.candidates.begin(), g.candidates.end(), index)) << toString(g.kind);
      EXPECT_TRUE(
          std::any_of(groupings.begin(), groupings.end(),
                      [&](const ModelGrouping& m) { return explained(g, m, object, f.camera, pose); }))
          << toString(g.kind) << " " << toString(g.shape) << " trial " << trial;
    }
  }

  EXPECT_GT(checked, 200);
}
INSTANTIATE_TEST_SUITE_P(Models, Shipped, testing::Values("bridge", "grenade", "frame", "bracket"));

TEST(ShippedModels, FlangeHasCirclesOnly) {
  EXPECT_EQ(count("flange", GroupingKind::kEdge), 0u);
  EXPECT_EQ(count("flange", GroupingKind::kJunction), 0u);
  EXPECT_GE(count("flange", GroupingKind::kEllipse), 3u);
  EXPECT_GE(count("flange", GroupingKind::kEllipsePair), 3u);
}

TEST(ShippedModels, BridgeIsCountedModuloItsSymmetry) {
  const ObjectModel& m = shippedObject("bridge").model;
  const size_t order = m.symmetries.discrete.size();
  EXPECT_EQ(order, 2u);
  EXPECT_EQ(modelGroupings({m, {}}).front().kind, GroupingKind::kEdge);
  ObjectModel plain = m;
  plain.symmetries = {};
  const size_t all = ofKind(modelGroupings({plain, {}}), GroupingKind::kEdge).size();
  const size_t kept = ofKind(modelGroupings({m, {}}), GroupingKind::kEdge).size();
  EXPECT_EQ(all, m.edges.size());
  EXPECT_GE(kept, all / order);
  EXPECT_LE(kept, all / order + 2);  // edges that half a turn maps onto themselves
}

TEST(ShippedModels, EveryCopyIsSeenFromItsViews) {
  for (const KnownObject& object : shipped().objects) {
    for (const ModelGrouping& g : modelGroupings(object)) {
      EXPECT_FALSE(g.orders.empty());
      EXPECT_GT(g.weight, 0);
      EXPECT_LE(g.weight, 1 + 1e-9);
      for (const SeenFrom& s : g.seen) {
        EXPECT_LT(s.view, object.views.directions);
        EXPECT_LT(s.symmetry, int(object.model.symmetries.discrete.size()));
      }
    }
  }
}

}  // namespace
}  // namespace monocular_eye_hand
