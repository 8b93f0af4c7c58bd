#pragma once
#include <opencv2/core.hpp>
#include <vector>

namespace monocular_eye_hand {

/// Separable derivative-of-Gaussian filter, scaled so that a ramp of one grey level per pixel answers 1.
struct GradientKernel {
  int radius = 0;
  std::vector<float> smooth;      ///< smooth[k], k = 0..radius; symmetric, sums to 1
  std::vector<float> derivative;  ///< derivative[k], k = 0..radius; antisymmetric: weight k at +k, -k at -k
  double noise_gain = 0;  ///< standard deviation of a gradient component per grey level of white image noise
  double difference_gain =
      0;  ///< the same of half the difference of two gradients 2 px apart along the gradient
  double correlation_length =
      0;  ///< sum of the noise autocorrelation along an edge [px]: points per independent one
};
GradientKernel gradientKernel(double sigma);

/// Standard deviation of the image noise [grey levels] from the lower third of second differences
/// (Immerkaer's mask, at one and at two pixels so that smoothed noise counts too); edges and texture hardly
/// move it. Never below the rounding noise of an 8-bit image.
double imageNoise(const cv::Mat& grey);

/// Gradients of an 8-bit image row after row; borders are replicated.
class GradientRows {
 public:
  /// Image and kernel have to stay while rows are asked for.
  explicit GradientRows(const GradientKernel& kernel) : kernel_(kernel) {}
  void start(const cv::Mat& grey);
  /// Computes row y into dx, dy, magnitude (each `cols` floats). Rows must be asked for in ascending order
  /// from 0.
  void compute(int y, float* dx, float* dy, float* magnitude);

 private:
  const float* row(int y);
  const GradientKernel& kernel_;
  const cv::Mat* grey_ = nullptr;
  int loaded_ = -1;                         // last image row in the ring
  std::vector<float> ring_;                 // 2 radius + 1 rows of floats
  std::vector<float> smooth_, derivative_;  // vertically filtered row, padded by radius on both sides
};

}  // namespace monocular_eye_hand
