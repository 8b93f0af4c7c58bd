#include "evaluation/pose_error.h"

#include <cmath>
#include <limits>

namespace monocular_eye_hand {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector2d project(const Eigen::Matrix3d& intrinsics, const Eigen::Vector3d& p_in_camera) {
  const Eigen::Vector3d q = intrinsics * p_in_camera;
  return q.head<2>() / q.z();
}

// min over the symmetries of the largest |image(estimate x) - image(truth S x)|.
template <class Point, class Image>
double smallestWorst(const Rigid3& estimate, const Rigid3& truth,
                     const std::vector<Eigen::Vector3d>& vertices, const std::vector<Rigid3>& symmetries,
                     const Image& image) {
  std::vector<Point> estimated;
  estimated.reserve(vertices.size());
  for (const Eigen::Vector3d& x : vertices) estimated.push_back(image(estimate * x));

  double best = kInfinity;  // squared
  for (const Rigid3& symmetry : symmetries) {
    const Rigid3 pose = truth * symmetry;
    double worst = 0;
    // One point beyond the best symmetry so far rules this one out; so does one that is not a number.
    for (size_t i = 0; i < vertices.size() && worst < best; ++i) {
      const double distance = (estimated[i] - image(pose * vertices[i])).squaredNorm();
      if (!(distance <= worst)) worst = std::isnan(distance) ? kInfinity : distance;
    }
    if (worst < best) best = worst;
  }
  return std::sqrt(best);
}

}  // namespace

std::vector<Rigid3> discretized(const BopSymmetries& symmetries, double step) {
  std::vector<Rigid3> discrete{Rigid3{}};
  discrete.insert(discrete.end(), symmetries.discrete.begin(), symmetries.discrete.end());
  if (symmetries.continuous.empty()) return discrete;
  const int count = int(std::ceil(M_PI / step));
  std::vector<Rigid3> all;
  for (const Rigid3& flip : discrete)
    for (const SymmetryAxis& axis : symmetries.continuous)
      for (int i = 0; i < count; ++i) {
        const Eigen::Matrix3d rotation = expSO3(axis.direction * (i * 2 * M_PI / count));
        all.push_back(Rigid3{rotation, axis.point - rotation * axis.point} * flip);
      }
  return all;
}

double mssd(const Rigid3& estimate, const Rigid3& truth, const std::vector<Eigen::Vector3d>& vertices,
            const std::vector<Rigid3>& symmetries) {
  return smallestWorst<Eigen::Vector3d>(estimate, truth, vertices, symmetries,
                                        [](const Eigen::Vector3d& p) { return p; });
}

double mspd(const Rigid3& estimate, const Rigid3& truth, const Eigen::Matrix3d& intrinsics,
            const std::vector<Eigen::Vector3d>& vertices, const std::vector<Rigid3>& symmetries) {
  return smallestWorst<Eigen::Vector2d>(
      estimate, truth, vertices, symmetries,
      [&intrinsics](const Eigen::Vector3d& p) { return project(intrinsics, p); });
}

double adi(const Rigid3& estimate, const Rigid3& truth, const std::vector<Eigen::Vector3d>& vertices,
           size_t max_vertices) {
  const Rigid3 truth_from_estimate = truth.inverse() * estimate;
  const size_t stride = 1 + vertices.size() / std::max<size_t>(max_vertices, 1);
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < vertices.size(); i += stride) {
    const Eigen::Vector3d moved = truth_from_estimate * vertices[i];
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& vertex : vertices)
      nearest = std::min(nearest, (vertex - moved).squaredNorm());
    sum += std::sqrt(nearest);
    ++count;
  }
  return count ? sum / double(count) : 0;
}

const std::vector<double>& mssdThresholds() {
  static const std::vector<double> thresholds = [] {
    std::vector<double> values;
    for (int i = 0; i < 10; ++i) values.push_back(0.05 + i * 0.05);
    return values;
  }();
  return thresholds;
}

const std::vector<double>& mspdThresholds() {
  static const std::vector<double> thresholds{5, 10, 15, 20, 25, 30, 35, 40, 45, 50};
  return thresholds;
}

}  // namespace monocular_eye_hand
