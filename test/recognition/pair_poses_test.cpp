// A true pair of groupings, seen without noise, gives the true pose: every kind, every order that is true.
#include "recognition/pair_poses.h"

#include <random>

#include "world.h"

namespace monocular_eye_hand {
namespace {

constexpr double kExact = 0.05;   // [px]
constexpr double kStepped = 14;   // the rotation about a circle's axis is tried in steps of 6 degrees [px]
constexpr double kCutOff = 30.0;  // standard deviation of an end that is cut off [px]

Ellipse imageOf(const ModelCircle& circle, const Rigid3& pose, const Camera& camera) {
  Eigen::Matrix3d plane;  // (x, y, 1) on the unit disc -> camera frame
  plane << circle.radius * (pose.rotation * circle.x_axis),
      circle.radius * (pose.rotation * circle.axis.cross(circle.x_axis)), pose * circle.centre;
  const Eigen::Matrix3d inverse = (camera.intrinsics() * plane).inverse();
  const Eigen::Matrix3d conic = inverse.transpose() * Eigen::Vector3d(1, 1, -1).asDiagonal() * inverse;
  const EllipseFromConic seen = ellipseFromConic(conic);
  EXPECT_TRUE(seen.valid);
  return seen.ellipse;
}

/// One model grouping as a camera sees it.
struct Seen {
  Grouping grouping;
  FeatureSet features;
};

Seen seenAs(const ObjectModel& model, const ModelGrouping& known, const Rigid3& pose, const Camera& camera) {
  Seen seen;
  seen.grouping.kind = known.kind;
  seen.grouping.shape = known.shape;
  for (const Eigen::Vector3d& p : known.points) {
    seen.grouping.points.push_back(camera.project(pose * p));
    seen.grouping.sigma.push_back(0.3);
  }
  for (int c : known.circles) {
    DetectedEllipse detected;
    detected.covariance.setIdentity();
    detected.ellipse = imageOf(model.circles[c], pose, camera);
    seen.grouping.ellipses.push_back(int(seen.features.ellipses.size()));
    seen.features.ellipses.push_back(detected);
  }
  return seen;
}

class EveryKind : public testing::Test {
 protected:
  // The smallest image distance of a pose from the true one over all orders.
  double nearest(const SearchModel& model, const ModelGrouping& known, const Seen& seen, const Rigid3& pose) {
    SearchImage image;
    image.camera = camera_;
    image.features = seen.features;
    image.unit_circles = unitCircles(seen.features, camera_);
    double best = 1e9;
    for (const Correspondence& order : known.orders) {
      std::vector<Rigid3> poses;
      posesOfPair(image, model.model(), {}, {seen.grouping, known, order}, &poses);
      for (const Rigid3& p : poses) best = std::min(best, model.poseDistance(camera_, p, pose));
    }
    return best;
  }
  const Camera camera_ = testCamera();
};

Rigid3 poseOfView(const SearchModel& model, int view, std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Rigid3 pose;
  pose.rotation = Eigen::AngleAxisd(3 * uniform(*random), Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                  model.viewRotation(view);
  const Eigen::Vector3d centre(0.05 * uniform(*random), 0.04 * uniform(*random), 4 * model.model().diameter);
  pose.translation = centre - pose.rotation * model.model().centre();
  return pose;
}

TEST_F(EveryKind, GivesTheTruePose) {
  std::mt19937 random(7);
  std::map<GroupingKind, int> tried, found;
  for (const KnownObject& object : shippedModels().objects) {
    const SearchModel model(object);
    std::map<GroupingKind, int> of_kind;
    for (const ModelGrouping& known : model.groupings()) {
      if (known.kind == GroupingKind::kEdge || ++of_kind[known.kind] > 12) continue;
      const SeenFrom& from = known.seen[known.seen.size() / 2];
      const Rigid3 pose =
          poseOfView(model, from.view, &random) * model.model().symmetries.discrete[size_t(from.symmetry)];
      const Seen seen = seenAs(model.model(), known, pose, camera_);
      ASSERT_TRUE(fixesPose(seen.grouping));
      const bool stepped = known.kind == GroupingKind::kEllipse || known.kind == GroupingKind::kEllipsePair;
      ++tried[known.kind];
      const double error = nearest(model, known, seen, pose);
      found[known.kind] += error < (stepped ? kStepped : kExact);
    }
  }

  EXPECT_EQ(tried.size(), size_t(kGroupingKinds - 1)) << "the shipped parts have every kind of grouping";
  // Coplanar points seen head-on, or three points on the danger cylinder, may have the true pose as a double
  // root that noise of 1e-16 makes complex.
  for (const auto& [kind, count] : tried) EXPECT_GE(found[kind], 0.95 * count) << toString(kind);
}

TEST_F(EveryKind, ARangeLeavesOutWhatIsSurelyNearerAndNothingElse) {
  std::mt19937 random(9);
  const SearchModel model(shippedModels().objects.at(size_t(shippedModels().indexOf("bridge"))));
  const ObjectModel& object = model.model();
  const DistanceRange far{8 * object.diameter, 100 * object.diameter};
  const auto farEnough = [&](const Rigid3& pose) { return (pose * object.centre()).norm() >= far.nearest; };
  int left_out = 0, far_ones = 0;

  for (const ModelGrouping& known : model.groupings()) {
    if (known.points.size() < 3) continue;
    const Seen seen =  // at 4 diameters
        seenAs(object, known, poseOfView(model, known.seen.front().view, &random), camera_);
    SearchImage image;
    image.camera = camera_;
    for (const ModelGrouping& other : model.groupings())
      for (const Correspondence& order : correspondences(seen.grouping, other)) {
        std::vector<Rigid3> all, within;
        posesOfPair(image, object, {}, {seen.grouping, other, order}, &all);
        posesOfPair(image, object, far, {seen.grouping, other, order}, &within);
        EXPECT_EQ(std::count_if(within.begin(), within.end(), farEnough),
                  std::count_if(all.begin(), all.end(), farEnough));
        far_ones += int(std::count_if(all.begin(), all.end(), farEnough));
        left_out += int(all.size() - within.size());
      }
  }

  EXPECT_GT(left_out, 0);
  EXPECT_GT(far_ones, 0);
}

TEST_F(EveryKind, ACornerWhoseEndsAreCutOffButOneIsEnough) {
  std::mt19937 random(8);
  int tried = 0, found = 0;
  for (const char* part : {"bridge", "bracket", "grenade"}) {
    const SearchModel model(shippedModels().objects.at(size_t(shippedModels().indexOf(part))));
    for (const ModelGrouping& known : model.groupings()) {
      if (known.kind != GroupingKind::kTriplet || tried > 60) continue;
      const SeenFrom& from = known.seen.front();
      const Rigid3 pose =
          poseOfView(model, from.view, &random) * model.model().symmetries.discrete[size_t(from.symmetry)];
      Seen seen = seenAs(model.model(), known, pose, camera_);
      for (int i : {1, 3}) {  // half of the edge is hidden
        seen.grouping.points[i] = 0.5 * (seen.grouping.points[0] + seen.grouping.points[i]);
        seen.grouping.sigma[i] = kCutOff;
      }
      ASSERT_TRUE(fixesPose(seen.grouping));
      ++tried;
      found += nearest(model, known, seen, pose) < kExact;
    }
  }

  ASSERT_GT(tried, 30);
  EXPECT_GE(found, 0.95 * tried);
}

TEST_F(EveryKind, WithoutOneWholeEdgeThereIsNoScale) {
  Grouping corner;
  corner.kind = GroupingKind::kTriplet;
  corner.points.resize(4, Eigen::Vector2d(100, 100));
  corner.sigma = {0.3, kCutOff, kCutOff, kCutOff};
  EXPECT_FALSE(fixesPose(corner));
  corner.sigma = {kCutOff, 0.3, 0.3, 0.3};
  EXPECT_FALSE(fixesPose(corner));
  Grouping quad;
  quad.kind = GroupingKind::kQuad;
  quad.points.resize(4);
  quad.sigma = {0.3, 0.3, 0.3, kCutOff};
  EXPECT_FALSE(fixesPose(quad));
}

}  // namespace
}  // namespace monocular_eye_hand
