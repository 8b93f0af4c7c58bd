#include <gtest/gtest.h>

#include "../mesh/shapes.h"
#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/characteristic_views.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;

/// Largest angle from a random direction to the nearest symmetric copy of a view direction.
double largestGap(const std::vector<Eigen::Vector3d>& directions, const Symmetries& s) {
  std::mt19937 random(1);
  std::normal_distribution<double> g;
  double worst = 1;

  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d probe = Eigen::Vector3d(g(random), g(random), g(random)).normalized();
    double best = -1;
    for (const Rigid3& motion : s.discrete) {
      const Eigen::Vector3d copy = motion.rotation * probe;
      for (const Eigen::Vector3d& d : directions) {
        double dot = copy.dot(d);
        if (s.axis) {
          const double a = std::acos(std::clamp(copy.dot(s.axis->direction), -1.0, 1.0));
          const double b = std::acos(std::clamp(d.dot(s.axis->direction), -1.0, 1.0));
          dot = std::cos(a - b);
        }
        best = std::max(best, dot);
      }
    }
    worst = std::min(worst, best);
  }
  return std::acos(worst);
}

TEST(ViewDirections, CoverTheSphereModuloSymmetry) {
  const std::vector<std::pair<Mesh, double>> parts{
      {box(0.03, 0.03, 0.03), 24}, {box(0.438, 0.785, 0.556), 4}, {prism(polygon(6, 0.03), 0.05), 12}};
  const size_t whole = viewDirections(Symmetries{}, 0.21).size();
  EXPECT_NEAR(double(whole), 330, 20);
  EXPECT_LT(largestGap(viewDirections(Symmetries{}, 0.21), Symmetries{}), 0.75 * 0.21);
  for (const auto& [mesh, order] : parts) {
    const Symmetries s = buildModel("part", mesh).symmetries;
    for (const double spacing : {0.1, 0.21, 0.4}) {
      const auto directions = viewDirections(s, spacing);
      EXPECT_LT(largestGap(directions, s), 0.75 * spacing) << order << " " << spacing;
      // No more than its share, but for the seams of a small domain.
      const double all = double(viewDirections(Symmetries{}, spacing).size());
      EXPECT_LT(double(directions.size()), 1.3 * all / order + 6) << order << " " << spacing;
      for (const Eigen::Vector3d& d : directions) EXPECT_NEAR(d.norm(), 1, 1e-9);
    }
  }
}

TEST(ViewDirections, AxisHasOneMeridianAndTheSphereOneView) {
  Symmetries s;
  s.axis = SymmetryAxis{Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 2, 3).normalized()};
  const auto half = viewDirections(s, 0.21);
  EXPECT_EQ(half.size(), 16u);
  EXPECT_NEAR(half.front().dot(s.axis->direction), 1, 1e-12);
  EXPECT_NEAR(half.back().dot(s.axis->direction), -1, 1e-12);
  EXPECT_LT(largestGap(half, s), 0.75 * 0.21);
  s.discrete.push_back(
      {Eigen::AngleAxisd(kPi, s.axis->direction.unitOrthogonal()).toRotationMatrix(), {0, 0, 0}});
  const auto quarter = viewDirections(s, 0.21);
  EXPECT_EQ(quarter.size(), 9u);
  EXPECT_LT(largestGap(quarter, s), 0.75 * 0.21);
  s.sphere = true;
  EXPECT_EQ(viewDirections(s, 0.21).size(), 1u);
  EXPECT_THROW(viewDirections(s, 0), BadInput);
}

class Views : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, Views, testing::Values("bridge", "grenade", "frame", "flange", "bracket"));

TEST_P(Views, ClassesPartitionTheViewsAndTheirWeightsSumToOne) {
  const ObjectModel m = buildModel(GetParam(), loadMesh(shippedModel(GetParam()), "mm"));
  const ViewOptions options;
  const ViewSphere sphere = sampleViews(m, options);
  ASSERT_EQ(sphere.views.size(), sphere.distances.size() * sphere.directions);
  ASSERT_EQ(sphere.distances.size(), 3u);

  double samples = 0;
  for (size_t k = 0; k < sphere.views.size(); ++k) {
    const SampledView& v = sphere.views[k];
    samples += double(v.contour.size());
    EXPECT_EQ(v.distance, sphere.distances[k / sphere.directions]);
    EXPECT_FALSE(v.contour.empty());
    ASSERT_TRUE(v.characteristic_view >= 0 && v.characteristic_view < int(sphere.characteristic.size()));
  }
  EXPECT_NEAR(samples / double(sphere.views.size()), options.samples_per_view,
              0.15 * options.samples_per_view);

  std::vector<int> times(sphere.views.size(), 0);
  for (size_t c = 0; c < sphere.characteristic.size(); ++c) {
    const CharacteristicView& view = sphere.characteristic[c];
    for (const int v : view.views) {
      ++times[v];
      EXPECT_EQ(sphere.views[v].characteristic_view, int(c));
    }
    ASSERT_EQ(view.features.size(), view.weight.size());
    ASSERT_EQ(view.features.size(), view.visible.size());
    EXPECT_TRUE(std::is_sorted(view.features.begin(), view.features.end()));
    double sum = 0;
    for (size_t k = 0; k < view.features.size(); ++k) {
      EXPECT_GT(view.weight[k], 0);
      EXPECT_TRUE(view.visible[k] > 0 && view.visible[k] <= 1);
      EXPECT_LT(view.features[k], m.featureCount());
      sum += view.weight[k];
    }
    EXPECT_NEAR(sum, 1, 1e-9);
  }
  for (const int t : times) EXPECT_EQ(t, 1);
}

TEST(Views, CubeShowsOneTwoOrThreeFaces) {
  const ObjectModel m = buildModel("cube", box(0.08, 0.08, 0.08));
  ViewOptions options;
  options.distance_ratios = {5};
  options.spacing = 0.1;
  const ViewSphere sphere = sampleViews(m, options);
  std::vector<size_t> kinds;
  for (const CharacteristicView& v : sphere.characteristic) kinds.push_back(v.features.size());
  for (const size_t k : kinds) EXPECT_TRUE(k == 4 || k == 7 || k == 9) << k;
  EXPECT_TRUE(std::count(kinds.begin(), kinds.end(), 9u) > 0);
}

TEST(Views, LongerAndRarerFeaturesWeighMore) {
  // In a view of a long box's end the four end edges are short; the weights follow the visible length.
  const ObjectModel m = buildModel("bar", box(0.02, 0.03, 0.2));
  const ViewSphere sphere = sampleViews(m, {});
  int compared = 0;
  for (const CharacteristicView& v : sphere.characteristic) {
    if (v.features.size() != 9) continue;
    double longest = 0, shortest = 0;
    for (size_t k = 0; k < v.features.size(); ++k) {
      const double length = (m.edges[v.features[k]].q - m.edges[v.features[k]].p).norm();
      if (length > 0.1) longest = std::max(longest, v.weight[k]);
      if (length < 0.025) shortest = std::max(shortest, v.weight[k]);
    }
    EXPECT_GT(longest, shortest);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

TEST(Views, SameInputSameOutput) {
  const ObjectModel m = buildModel("bridge", loadMesh(shippedModel("bridge"), "mm"));
  const ViewSphere a = sampleViews(m, {}), b = sampleViews(m, {});
  ASSERT_EQ(a.views.size(), b.views.size());
  for (size_t k = 0; k < a.views.size(); ++k) {
    ASSERT_EQ(a.views[k].contour.size(), b.views[k].contour.size());
    for (size_t s = 0; s < a.views[k].contour.size(); ++s)
      EXPECT_EQ(a.views[k].contour[s].p, b.views[k].contour[s].p);
  }
}

TEST(Views, BadOptionsAreNamed) {
  ViewOptions options;
  options.distance_ratios = {0.4};
  EXPECT_THROW(options.check(), BadInput);
  options.distance_ratios.clear();
  EXPECT_THROW(options.check(), BadInput);
  options = {};
  options.spacing = -1;
  EXPECT_THROW(options.check(), BadInput);
  options = {};
  options.samples_per_view = 0;
  EXPECT_THROW(options.check(), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
