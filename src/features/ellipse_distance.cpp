#include <cmath>

#include "features/ellipse_fitting.h"

namespace monocular_eye_hand {
namespace {

// Local quantities at a point in the ellipse's own axes.
struct Local {
  double x, y;       // point
  double gx, gy, g;  // gradient of F = x^2/a^2 + y^2/b^2 - 1 and its length
  double f;
};
Local localAt(const Ellipse& e, double c, double s, const Eigen::Vector2d& uv) {
  const Eigen::Vector2d d = uv - e.centre;
  Local l;
  l.x = c * d.x() + s * d.y();
  l.y = -s * d.x() + c * d.y();
  const double ia = 1 / (e.a * e.a), ib = 1 / (e.b * e.b);
  l.f = l.x * l.x * ia + l.y * l.y * ib - 1;
  l.gx = 2 * l.x * ia;
  l.gy = 2 * l.y * ib;
  l.g = std::max(1e-9, std::sqrt(l.gx * l.gx + l.gy * l.gy));
  return l;
}

Eigen::Matrix<double, 5, 1> jacobianAt(const Ellipse& e, double c, double s, const Local& l) {
  Eigen::Matrix<double, 5, 1> j;
  const double nx = l.gx / l.g, ny = l.gy / l.g;
  j << -(c * nx - s * ny), -(s * nx + c * ny), -l.gx * l.x / (e.a * l.g), -l.gy * l.y / (e.b * l.g),
      (l.gx * l.y - l.gy * l.x) / l.g;
  return j;
}

}  // namespace

EllipseDistance EllipseFrame::distanceTo(const Eigen::Vector2d& uv) const {
  const double c = cosine_, s = sine_;
  const Local l = localAt(e_, c, s, uv);
  return {l.f / l.g, {(c * l.gx - s * l.gy) / l.g, (s * l.gx + c * l.gy) / l.g}};
}

Eigen::Matrix<double, 1, 5> EllipseFrame::distanceJacobian(const Eigen::Vector2d& uv) const {
  return jacobianAt(e_, cosine_, sine_, localAt(e_, cosine_, sine_, uv)).transpose();
}

Eigen::Vector2d EllipseFrame::onUnitCircle(const Eigen::Vector2d& uv) const {
  const Eigen::Vector2d d = uv - e_.centre;
  return {(cosine_ * d.x() + sine_ * d.y()) / e_.a, (-sine_ * d.x() + cosine_ * d.y()) / e_.b};
}

double EllipseFrame::eccentricAngle(const Eigen::Vector2d& uv) const {
  const Eigen::Vector2d on_circle = onUnitCircle(uv);
  return std::atan2(on_circle.y(), on_circle.x());
}

double circumference(const Ellipse& e) {
  const double h = (e.a - e.b) * (e.a - e.b) / ((e.a + e.b) * (e.a + e.b));
  return M_PI * (e.a + e.b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
}

}  // namespace monocular_eye_hand
