#include "monocular_eye_hand/geometry/camera.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

// Brown-Conrady with the rational radial factor; OpenCV's formulas and order of coefficients.
struct Distorted {
  Eigen::Vector2d xy;
  Eigen::Matrix2d jacobian;
};

Distorted distortByPolynomials(const std::array<double, 8>& d, const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y(), r2 = x * x + y * y;
  const double k1 = d[0], k2 = d[1], p1 = d[2], p2 = d[3], k3 = d[4], k4 = d[5], k5 = d[6], k6 = d[7];
  const double num = 1 + r2 * (k1 + r2 * (k2 + r2 * k3)), den = 1 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double dnum = k1 + r2 * (2 * k2 + 3 * r2 * k3), dden = k4 + r2 * (2 * k5 + 3 * r2 * k6);
  const double g = num / den, dg = (dnum * den - num * dden) / (den * den);  // d/d(r2)
  Distorted out;
  out.xy = {x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * g + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  out.jacobian << g + 2 * x * x * dg + 2 * p1 * y + 6 * p2 * x, 2 * x * y * dg + 2 * p1 * x + 2 * p2 * y,
      2 * x * y * dg + 2 * p1 * x + 2 * p2 * y, g + 2 * y * y * dg + 6 * p1 * y + 2 * p2 * x;
  return out;
}

enum class LensName { kUnnamed, kNone, kPlumbBob, kRational, kEquidistant, kInverse, kThinPrism, kUnknown };

/// Names as people write them: letters and digits count, capitals do not.
LensName lensNamed(const std::string& name) {
  std::string simple;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      simple += char(std::tolower(static_cast<unsigned char>(c)));
  }

  const std::pair<const char*, LensName> names[] = {
      {"", LensName::kUnnamed},
      {"none", LensName::kNone},
      {"nodistortion", LensName::kNone},
      {"undistorted", LensName::kNone},
      {"pinhole", LensName::kNone},
      {"perspective", LensName::kNone},

      {"plumbbob", LensName::kPlumbBob},
      {"radtan", LensName::kPlumbBob},
      {"radialtangential", LensName::kPlumbBob},
      {"brown", LensName::kPlumbBob},
      {"brownconrady", LensName::kPlumbBob},

      {"rationalpolynomial", LensName::kRational},
      {"rational", LensName::kRational},

      {"equidistant", LensName::kEquidistant},
      {"fisheye", LensName::kEquidistant},
      {"opencvfisheye", LensName::kEquidistant},
      {"kannalabrandt", LensName::kEquidistant},
      {"kannalabrandt4", LensName::kEquidistant},
      {"kb4", LensName::kEquidistant},

      // These map from raw to rectified, or are of a driver that publishes zeros.
      {"inversebrownconrady", LensName::kInverse},
      {"modifiedbrownconrady", LensName::kInverse},
      {"thinprism", LensName::kThinPrism},
      {"thinprismmodel", LensName::kThinPrism},
      {"thinprismfisheye", LensName::kThinPrism},
  };

  for (const auto& [known, lens] : names) {
    if (simple == known) return lens;
  }
  return LensName::kUnknown;
}

bool areZero(const double* begin, const double* end) {
  return std::all_of(begin, end, [](double value) { return value == 0; });
}

/// OpenCV's models of 12 and 14 coefficients: s1 to s4 stand behind k6, and then the tilt of the sensor.
void refuseThinPrism(const std::string& name, LensName lens, const double* coefficients, size_t count) {
  constexpr size_t kFirstPrism = 8, kFirstTilt = 12;
  const auto any = [&](size_t first) {
    return count > first && !areZero(coefficients + first, coefficients + count);
  };
  if (lens == LensName::kEquidistant || (lens != LensName::kThinPrism && !any(kFirstPrism))) return;
  const std::string terms = any(kFirstTilt) ? "thin prism and tilt terms" : "thin prism terms";
  throw BadInput(
      fmt::format("camera: the distortion {}of {} coefficients has {} (OpenCV's s1 to s4, tx, ty), which are "
                  "not supported: calibrate without CALIB_THIN_PRISM_MODEL and CALIB_TILTED_MODEL, or "
                  "rectify the image first and use image_rect",
                  name.empty() ? "" : "'" + name.substr(0, 40) + "' ", count, terms));
}

constexpr double kWidestAngle = 1.52;  // off the axis of an equidistant lens, 87 degrees [rad]

/// theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8): the radius at which the ray at the angle
/// theta off the axis is seen (Kannala, Brandt), with its derivative.
std::pair<double, double> equidistantRadius(const std::array<double, 8>& d, double theta) {
  const double t2 = theta * theta;
  const double radius = theta * (1 + t2 * (d[0] + t2 * (d[1] + t2 * (d[2] + t2 * d[3]))));
  const double slope = 1 + t2 * (3 * d[0] + t2 * (5 * d[1] + t2 * (7 * d[2] + t2 * 9 * d[3])));
  return {radius, slope};
}

Distorted distortEquidistant(const std::array<double, 8>& d, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm(), r = std::sqrt(r2);
  double scale = 1 + (d[0] - 1.0 / 3) * r2;   // of the radius
  double scale_slope = 2 * (d[0] - 1.0 / 3);  // its derivative to r, over r
  if (r > 1e-4) {
    const auto [radius, slope] = equidistantRadius(d, std::atan(r));
    scale = radius / r;
    scale_slope = (slope / (1 + r2) - scale) / r2;
  }
  Distorted out;
  out.xy = scale * p;
  out.jacobian = scale * Eigen::Matrix2d::Identity() + scale_slope * p * p.transpose();
  return out;
}

/// The ray that an equidistant lens sees there: one equation in the angle.
Eigen::Vector2d undistortEquidistant(const std::array<double, 8>& d, const Eigen::Vector2d& seen) {
  const double radius = seen.norm();
  if (radius < 1e-12) return seen;
  double theta = std::min(radius, kWidestAngle);
  for (int i = 0; i < 50; ++i) {
    const auto [at, slope] = equidistantRadius(d, theta);
    if (!(slope > 0)) break;
    const double step = std::clamp((radius - at) / slope, -0.25, 0.25);
    const double next = std::clamp(theta + step, 0.0, kWidestAngle);
    const double moved = std::abs(next - theta);
    theta = next;
    if (moved < 1e-16) break;
  }
  return seen * (std::tan(theta) / radius);
}

Distorted distortNormalized(const Camera& c, const Eigen::Vector2d& p) {
  return c.model == DistortionModel::kEquidistant ? distortEquidistant(c.d, p) : distortByPolynomials(c.d, p);
}

/// Where the distorted image stops growing on the way out along a direction (unit, focal lengths are 1), as a
/// distance from the principal point; `reach` when it grows up to there.
double foldAlong(const Camera& camera, const Eigen::Vector2d& direction, double reach) {
  constexpr double kFarthest = 20;  // 87 degrees off the axis
  const double step = reach / 50;
  double before = 0;
  for (double out = step; out < kFarthest; out += std::max(step, 0.02 * out)) {
    const Distorted at = distortNormalized(camera, out * direction);
    const double now = at.xy.norm();
    if (!(now > before && at.jacobian.determinant() > 0)) return before;
    if (now >= reach) return reach;
    before = now;
  }
  return reach;  // the corners of a fisheye image show nothing
}

[[noreturn]] void refuse(const std::string& field, double value, const std::string& rule) {
  throw BadInput(fmt::format("camera: {} = {:g} {}", field, value, rule));
}

/// A fit of too few points near the corners may give a lens that shows two directions in one pixel.
void refuseFold(const Camera& c) {
  constexpr int kAlongSide = 8;
  for (int k = 0; k < 4 * kAlongSide; ++k) {
    const double at = double(k % kAlongSide) / kAlongSide;
    const double u = k / kAlongSide == 0 ? at : k / kAlongSide == 1 ? 1 : k / kAlongSide == 2 ? 1 - at : 0;
    const double v = k / kAlongSide == 0 ? 0 : k / kAlongSide == 1 ? at : k / kAlongSide == 2 ? 1 : 1 - at;
    const Eigen::Vector2d border((u * (c.width - 1) - c.cx) / c.fx, (v * (c.height - 1) - c.cy) / c.fy);
    const double reach = border.norm(), fold = reach > 0 ? foldAlong(c, border / reach, reach) : reach;
    if (fold >= reach) continue;
    const double to_pixels = 0.5 * (c.fx + c.fy);
    throw BadInput(
        fmt::format("camera: the lens model folds over inside the image, {} px from its middle, where the "
                    "border is {} px away: one pixel would show two directions. Calibrate again with the "
                    "board up to the corners, or with fewer coefficients",
                    std::lround(fold * to_pixels), std::lround(reach * to_pixels)));
  }
}

}  // namespace

bool Camera::distorted() const {
  if (model == DistortionModel::kEquidistant) return true;
  return model != DistortionModel::kNone &&
         std::any_of(d.begin(), d.end(), [](double value) { return value != 0; });
}

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& uv_rect) const {
  if (!distorted()) return uv_rect;
  const Eigen::Vector2d p = distortNormalized(*this, {(uv_rect.x() - cx) / fx, (uv_rect.y() - cy) / fy}).xy;
  return {fx * p.x() + cx, fy * p.y() + cy};
}

DistortedPixel Camera::distortWithJacobian(const Eigen::Vector2d& uv_rect) const {
  if (!distorted()) return {uv_rect, Eigen::Matrix2d::Identity()};
  const Distorted at = distortNormalized(*this, {(uv_rect.x() - cx) / fx, (uv_rect.y() - cy) / fy});
  DistortedPixel out{{fx * at.xy.x() + cx, fy * at.xy.y() + cy}, at.jacobian};
  out.jacobian(0, 1) *= fx / fy;
  out.jacobian(1, 0) *= fy / fx;
  return out;
}

Eigen::Vector2d Camera::undistort(const Eigen::Vector2d& uv_raw) const {
  if (!distorted()) return uv_raw;
  const Eigen::Vector2d target((uv_raw.x() - cx) / fx, (uv_raw.y() - cy) / fy);

  if (model == DistortionModel::kEquidistant) {
    const Eigen::Vector2d ray = undistortEquidistant(d, target);
    return {fx * ray.x() + cx, fy * ray.y() + cy};
  }

  Eigen::Vector2d p = target;
  for (int i = 0; i < 30; ++i) {
    const Distorted at = distortNormalized(*this, p);
    const Eigen::Vector2d residual = at.xy - target;
    if (residual.squaredNorm() < 1e-28) break;
    Eigen::Vector2d step = at.jacobian.inverse() * residual;
    if (!step.allFinite()) break;
    const double limit = 0.25;  // outside the one-to-one region Newton may jump
    if (step.norm() > limit) step *= limit / step.norm();
    p -= step;
  }
  return {fx * p.x() + cx, fy * p.y() + cy};
}

Eigen::Matrix3d Camera::intrinsics() const {
  Eigen::Matrix3d k;
  k << fx, 0, cx, 0, fy, cy, 0, 0, 1;
  return k;
}

Camera Camera::resized(double factor) const {
  const double min_factor = 0.5 / std::min(width, height), max_factor = 1e5 / std::max(width, height);
  if (!(factor >= min_factor && factor <= max_factor))
    refuse("resize factor", factor, "leaves no image, or one too large");
  Camera c = *this;
  c.width = int(std::lround(width * factor));
  c.height = int(std::lround(height * factor));
  const double sx = double(c.width) / width, sy = double(c.height) / height;
  c.fx = fx * sx;
  c.fy = fy * sy;
  c.cx = (cx + 0.5) * sx - 0.5;
  c.cy = (cy + 0.5) * sy - 0.5;
  return c;
}

Camera Camera::seenThrough(const PixelWindow& window) const {
  const PixelWindow& w = window;
  const auto inside = [](int begin, int length, int bin, int whole) {
    return begin >= 0 && bin >= 1 && length >= bin && length <= whole && begin <= whole - length;
  };
  if (!inside(w.x, w.width, w.bin_x, width) || !inside(w.y, w.height, w.bin_y, height))
    throw BadInput(fmt::format("the region of interest ({}x{} at {}, {}) leaves the camera's {}x{} image",
                               w.width, w.height, w.x, w.y, width, height));

  Camera c = *this;
  c.width = w.width / w.bin_x;
  c.height = w.height / w.bin_y;
  c.fx /= w.bin_x;
  c.fy /= w.bin_y;
  c.cx = (cx - w.x + 0.5) / w.bin_x - 0.5;
  c.cy = (cy - w.y + 0.5) / w.bin_y - 0.5;

  if (!(c.cx > 0 && c.cx < c.width && c.cy > 0 && c.cy < c.height))
    throw BadInput("the region of interest leaves out the principal point, which is not supported: widen it");
  return c;
}

void Camera::check() const {
  if (width <= 0) refuse("width", width, "must be positive");
  if (height <= 0) refuse("height", height, "must be positive");
  const std::pair<const char*, double> focal[] = {{"fx", fx}, {"fy", fy}};
  for (const auto& [field, value] : focal) {
    if (!std::isfinite(value)) refuse(field, value, "is not finite: calibrate the camera again");
    if (value == 0) refuse(field, value, "means uncalibrated: calibrate the camera (camera_calibration)");
    if (value < width / 5.0)
      refuse(field, value,
             fmt::format("px is implausible, below a fifth of the image width ({} px): check the calibration "
                         "and its image size",
                         width));
  }

  if (!(cx > 0 && cx < width)) refuse("cx", cx, "px lies outside the image: check the calibration");
  if (!(cy > 0 && cy < height)) refuse("cy", cy, "px lies outside the image: check the calibration");
  const char* names[] = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  for (size_t i = 0; i < d.size(); ++i)
    if (!std::isfinite(d[i])) refuse(names[i], d[i], "is not finite: calibrate the camera again");
  if (distorted()) refuseFold(*this);
}

void setDistortion(Camera* camera, const std::string& name, const double* coefficients, size_t count) {
  camera->d.fill(0);
  camera->model = DistortionModel::kNone;
  const bool all_zero = areZero(coefficients, coefficients + count);
  const LensName lens = lensNamed(name);
  refuseThinPrism(name, lens, coefficients, count);
  if (lens == LensName::kNone && !all_zero)
    throw BadInput("camera: the distortion model is '" + name +
                   "' but coefficients are not zero: name their model (plumb_bob, rational_polynomial)");
  if (lens == LensName::kUnknown || (lens == LensName::kInverse && !all_zero))
    throw BadInput("camera: distortion model '" + name.substr(0, 40) +
                   "' is not supported; known: plumb_bob, rational_polynomial, equidistant, none. Rectify "
                   "the image first and use "
                   "image_rect.");
  if (lens == LensName::kEquidistant) {
    if (count != 4 && !(count > 4 && areZero(coefficients + 4, coefficients + count)))
      throw BadInput(
          fmt::format("camera: equidistant has 4 distortion coefficients (k1 to k4), got {}", count));
    camera->model = DistortionModel::kEquidistant;
    std::copy(coefficients, coefficients + 4, camera->d.begin());
    return;
  }
  if (count == 0 || lens == LensName::kNone || lens == LensName::kInverse) return;
  if (lens == LensName::kUnnamed && all_zero) return;

  const bool rational = lens == LensName::kRational || (lens == LensName::kUnnamed && count > 5);
  const size_t used = rational ? 8 : 5;
  if (count > used && !areZero(coefficients + used, coefficients + count))
    throw BadInput(
        fmt::format("camera: plumb_bob has at most 5 distortion coefficients, got {} that are not zero: if "
                    "they are k1, k2, p1, p2, k3 to k6, name the model rational_polynomial",
                    count));
  camera->model = rational ? DistortionModel::kRationalPolynomial : DistortionModel::kPlumbBob;
  std::copy(coefficients, coefficients + std::min(count, used), camera->d.begin());
}

std::string distortionName(const Camera& camera) {
  if (camera.model == DistortionModel::kRationalPolynomial) return "rational_polynomial";
  return camera.model == DistortionModel::kEquidistant ? "equidistant" : "plumb_bob";
}

int distortionCount(const Camera& camera) {
  if (camera.model == DistortionModel::kRationalPolynomial) return 8;
  return camera.model == DistortionModel::kEquidistant ? 4 : 5;
}

}  // namespace monocular_eye_hand
