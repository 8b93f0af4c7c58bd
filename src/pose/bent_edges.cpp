#include "monocular_eye_hand/pose/bent_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace monocular_eye_hand {
namespace {

constexpr double kWindow = 6;      // places within so much shape the parabola [px]
constexpr int kFewest = 4;         // of them
constexpr double kMaxMoved = 0.5;  // [px]

// h = slope t + curvature / 2 t^2 by least squares, t along the tangent, h along the normal.
class Parabola {
 public:
  void add(double t, double h) {
    const double u = 0.5 * t * t;
    tt_ += t * t;
    tu_ += t * u;
    uu_ += u * u;
    th_ += t * h;
    uh_ += u * h;
    ++count_;
  }
  double curvature() const {
    const double determinant = tt_ * uu_ - tu_ * tu_;
    if (count_ < kFewest || !(determinant > 1e-3 * tt_ * uu_)) return 0;
    return (tt_ * uh_ - tu_ * th_) / determinant;
  }

 private:
  double tt_ = 0, tu_ = 0, uu_ = 0, th_ = 0, uh_ = 0;
  int count_ = 0;
};

double curvatureAt(const ContourPlace& here, const std::vector<ContourPlace>& contour, const int* begin,
                   const int* end) {
  const Eigen::Vector2d tangent(here.normal.y(), -here.normal.x());
  Parabola parabola;
  for (const int* other = begin; other != end; ++other) {
    const Eigen::Vector2d d = contour[size_t(*other)].uv - here.uv;
    if (d.squaredNorm() > kWindow * kWindow || !(d.squaredNorm() > 0)) continue;
    parabola.add(tangent.dot(d), here.normal.dot(d));
  }
  return parabola.curvature();
}

}  // namespace

std::vector<double> curvatures(const std::vector<ContourPlace>& contour) {
  std::vector<int> order(contour.size());
  std::iota(order.begin(), order.end(), 0);
  const auto featureOf = [&](int i) { return contour[size_t(i)].feature; };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return featureOf(i) < featureOf(j); });
  std::vector<double> found(contour.size(), 0);
  for (size_t begin = 0; begin < order.size();) {
    size_t end = begin;
    while (end < order.size() && featureOf(order[end]) == featureOf(order[begin])) ++end;
    for (size_t k = begin; k < end; ++k)
      found[size_t(order[k])] =
          curvatureAt(contour[size_t(order[k])], contour, order.data() + begin, order.data() + end);
    begin = end;
  }
  return found;
}

void correctBlurBias(const Rigid3& pose, const Camera& camera, std::vector<FeatureSample>* samples) {
  std::vector<ContourPlace> contour;
  contour.reserve(samples->size());
  for (const FeatureSample& s : *samples)
    contour.push_back({camera.project(pose * s.line.p_in_object), s.line.normal, s.feature});
  const std::vector<double> bends = curvatures(contour);
  for (size_t i = 0; i < samples->size(); ++i) {
    FeatureSample& s = (*samples)[i];
    const double moved = 0.5 * s.appearance.blur * s.appearance.blur * bends[i];
    s.line.uv -= std::clamp(moved, -kMaxMoved, kMaxMoved) * s.line.normal;
  }
}

}  // namespace monocular_eye_hand
