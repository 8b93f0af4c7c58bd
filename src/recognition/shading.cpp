#include "recognition/shading.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "recognition/median.h"

namespace monocular_eye_hand {
namespace {

constexpr int kLeastPixels = 40;
constexpr int kRounds = 4;  // of weighing pixels by their residual
constexpr double kDamping =
    1e-3;  // per pixel, on the light: faces that all look the same way tell nothing of it
constexpr double kFarOff = 2.5;  // median residuals at which a pixel counts half
constexpr double kLargest = 60;  // a difference of more greys counts as this

double capped(double difference) { return std::min(difference * difference, kLargest * kLargest); }

}  // namespace

double shadingExplained(const std::vector<ShadedPixel>& pixels) {
  const Eigen::Index n = Eigen::Index(pixels.size());
  if (n < kLeastPixels) return 0;
  Eigen::MatrixX4d a(n, 4);
  Eigen::VectorXd grey(n);
  std::vector<float> greys;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ShadedPixel& pixel = pixels[size_t(i)];
    a.row(i) << 1, pixel.normal.cast<double>().transpose();
    grey[i] = pixel.grey;
    greys.push_back(pixel.grey);
  }

  Eigen::VectorXd weight = Eigen::VectorXd::Ones(n), residual(n);
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixX4d weighted = weight.asDiagonal() * a;
    Eigen::Matrix4d normal = a.transpose() * weighted;
    normal.diagonal().array() += kDamping * double(n);
    const Eigen::Vector4d light = normal.ldlt().solve(weighted.transpose() * grey);
    residual = (grey - a * light).cwiseAbs();
    std::vector<double> sizes(residual.data(), residual.data() + n);
    const double scale = kFarOff * std::max(1.0, median(&sizes));
    weight = (1 + (residual / scale).array().square()).inverse();
  }

  const double middle = median(&greys);
  double unexplained = 0, spread = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    unexplained += capped(residual[i]);
    spread += capped(grey[i] - middle);
  }
  return 1 - unexplained / std::max(spread, double(n));
}

}  // namespace monocular_eye_hand
