#include "features/undistortion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

struct Distorted {
  Eigen::Vector2d uv;        // raw pixel
  Eigen::Matrix2d jacobian;  // d raw / d rectified, pixels
};

class Undistorter {
 public:
  explicit Undistorter(const Camera& camera) : c_(camera), max_radius2_(oneToOneRadius2()) {}

  /// False when no rectified pixel inside the one-to-one region maps to uv_raw.
  bool solve(const Eigen::Vector2d& uv_raw, bool follow, Eigen::Vector2d* uv_rect,
             Eigen::Matrix2d* jacobian) {
    Eigen::Vector2d p = follow ? Eigen::Vector2d(last_rect_ + last_inverse_ * (uv_raw - last_raw_)) : uv_raw;
    // Far out an equidistant lens is so curved that Newton's method needs a near start.
    if (c_.model == DistortionModel::kEquidistant && !follow) p = c_.undistort(uv_raw);

    for (int i = 0; i < 20; ++i) {
      const Distorted at = distort(p);
      const double det = at.jacobian.determinant();
      if (!(std::fabs(det) > 1e-6)) return false;
      const Eigen::Matrix2d inverse = at.jacobian.inverse();
      Eigen::Vector2d step = inverse * (uv_raw - at.uv);
      const double length = step.norm();
      if (!(length < 1e6)) return false;
      if (length > 0.25 * c_.fx) step *= 0.25 * c_.fx / length;
      p += step;
      if (length < 0.05) {  // quadratic convergence: what is left is below 1e-5 px
        if (det <= 0 || radius2(p) > max_radius2_) return false;
        last_raw_ = uv_raw;
        last_rect_ = *uv_rect = p;
        last_inverse_ = inverse;
        *jacobian = at.jacobian;
        return true;
      }
    }
    return false;
  }

 private:
  double radius2(const Eigen::Vector2d& uv) const {
    const double x = (uv.x() - c_.cx) / c_.fx, y = (uv.y() - c_.cy) / c_.fy;
    return x * x + y * y;
  }
  // The radial factor and its derivative to r^2.
  void radial(double r2, double* g, double* dg) const {
    const auto& d = c_.d;
    const double num = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    const double den = 1 + r2 * (d[5] + r2 * (d[6] + r2 * d[7]));
    const double dnum = d[0] + r2 * (2 * d[1] + 3 * r2 * d[4]);
    const double dden = d[5] + r2 * (2 * d[6] + 3 * r2 * d[7]);
    *g = num / den;
    *dg = (dnum * den - num * dden) / (den * den);
  }
  Distorted distort(const Eigen::Vector2d& uv) const {
    if (c_.model == DistortionModel::kEquidistant) {
      const DistortedPixel at = c_.distortWithJacobian(uv);
      return {at.uv_raw, at.jacobian};
    }
    const double x = (uv.x() - c_.cx) / c_.fx, y = (uv.y() - c_.cy) / c_.fy, r2 = x * x + y * y;
    const double p1 = c_.d[2], p2 = c_.d[3];
    double g, dg;
    radial(r2, &g, &dg);
    Distorted out;
    out.uv = {c_.fx * (x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + c_.cx,
              c_.fy * (y * g + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + c_.cy};
    const double xx = g + 2 * x * x * dg + 2 * p1 * y + 6 * p2 * x;
    const double xy = 2 * x * y * dg + 2 * p1 * x + 2 * p2 * y;
    const double yy = g + 2 * y * y * dg + 6 * p1 * y + 2 * p2 * x;
    out.jacobian << xx, xy * c_.fx / c_.fy, xy * c_.fy / c_.fx, yy;
    return out;
  }
  // Squared radius up to which the radial part r g(r^2) keeps growing.
  double oneToOneRadius2() const {
    constexpr double kStep = 0.01, kFarthest = 20;
    if (c_.model == DistortionModel::kEquidistant) return kFarthest * kFarthest;  // the determinant tells
    for (double r = kStep; r < kFarthest; r += kStep) {
      double g, dg;
      radial(r * r, &g, &dg);
      if (!(g > 0 && g + 2 * r * r * dg > 0)) return (r - kStep) * (r - kStep);
    }
    return kFarthest * kFarthest;
  }

  const Camera& c_;
  const double max_radius2_;
  Eigen::Vector2d last_raw_ = Eigen::Vector2d::Zero(), last_rect_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d last_inverse_ = Eigen::Matrix2d::Identity();
};

// Gradients are covariant: a level line's normal turns with the transposed Jacobian, distances along it
// shrink by its length.
EdgePoint moved(const EdgePoint& raw, const Eigen::Vector2d& uv_rect, const Eigen::Matrix2d& jacobian) {
  EdgePoint p = raw;
  const Eigen::Vector2d n = jacobian.transpose() * raw.normal.cast<double>();
  const double length = n.norm();
  p.uv = uv_rect.cast<float>();
  p.normal = (n / length).cast<float>();
  p.sigma = float(raw.sigma / length);
  p.blur = float(raw.blur / length);
  return p;
}

}  // namespace

void undistortEdges(const LinkedEdges& raw, const Camera& camera, int min_trace_points, LinkedEdges* out) {
  out->points.clear();
  out->traces.clear();
  out->points.reserve(raw.points.size());
  out->traces.reserve(raw.traces.size());

  Undistorter undistorter(camera);
  for (const EdgeTrace& trace : raw.traces) {
    EdgeTrace now{int(out->points.size()), 0, trace.closed};
    const auto finish = [&] {
      now.count = int(out->points.size()) - now.first;
      if (now.count >= min_trace_points)
        out->traces.push_back(now);
      else
        out->points.resize(now.first);
      now = {int(out->points.size()), 0, false};
    };

    bool follow = false;
    for (int i = trace.first; i < trace.first + trace.count; ++i) {
      Eigen::Vector2d uv_rect;
      Eigen::Matrix2d jacobian;
      if (undistorter.solve(raw.points[i].uv.cast<double>(), follow, &uv_rect, &jacobian)) {
        follow = true;
        out->points.push_back(moved(raw.points[i], uv_rect, jacobian));
      } else {
        follow = false;
        now.closed = false;
        finish();
      }
    }
    finish();
  }
}

}  // namespace monocular_eye_hand
