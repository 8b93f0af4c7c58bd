#include "recognition/shading.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/median.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMinPixels = 40;
constexpr int kRounds = 4;  // of weighing pixels by their residual
constexpr double kDamping =
    1e-3;  // per pixel, on the light: faces that all look the same way tell nothing of it
constexpr double kFarOff = 2.5;  // median residuals at which a pixel counts half
constexpr double kLargest = 60;  // a difference of more greys counts as this

double capped(double difference) { return std::min(difference * difference, kLargest * kLargest); }

}  // namespace

FittedLight fitLight(const std::vector<ShadedPixel>& pixels) {
  const Eigen::Index n = Eigen::Index(pixels.size());
  Eigen::MatrixX4d a(n, 4);
  Eigen::VectorXd grey(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ShadedPixel& pixel = pixels[size_t(i)];
    a.row(i) << 1, pixel.normal.cast<double>().transpose();
    grey[i] = pixel.grey;
  }

  FittedLight fitted;
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(n);
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixX4d weighted = weight.asDiagonal() * a;
    Eigen::Matrix4d normal = a.transpose() * weighted;
    normal.diagonal().array() += kDamping * double(n);
    fitted.light = normal.ldlt().solve(weighted.transpose() * grey);

    const Eigen::VectorXd residual = (grey - a * fitted.light).cwiseAbs();
    std::vector<double> sizes(residual.data(), residual.data() + n);
    fitted.residual = median(&sizes);
    const double scale = kFarOff * std::max(1.0, fitted.residual);
    weight = (1 + (residual / scale).array().square()).inverse();
  }
  return fitted;
}

double shadingExplained(const std::vector<ShadedPixel>& pixels) {
  if (pixels.size() < kMinPixels) return 0;
  const FittedLight fitted = fitLight(pixels);
  std::vector<float> greys;
  for (const ShadedPixel& pixel : pixels) greys.push_back(pixel.grey);
  const double middle = median(&greys);

  double unexplained = 0, spread = 0;
  for (const ShadedPixel& pixel : pixels) {
    unexplained += capped(pixel.grey - fitted.grey(pixel.normal));
    spread += capped(pixel.grey - middle);
  }
  return 1 - unexplained / std::max(spread, double(pixels.size()));
}

}  // namespace monocular_eye_hand
