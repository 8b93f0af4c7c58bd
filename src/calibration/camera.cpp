#include "calibration/camera.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibration/homography.h"
#include "calibration/target_pose.h"
#include "monocular_eye_hand/adjustment/adjust.h"
#include "monocular_eye_hand/adjustment/uncertainty.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

Eigen::VectorXd intrinsicsOf(const Camera& camera) {
  Eigen::VectorXd all(kIntrinsics);
  all << camera.fx, camera.fy, camera.cx, camera.cy, Eigen::Map<const Eigen::VectorXd>(camera.d.data(), 8);
  return all;
}

Camera withIntrinsics(Camera camera, const Eigen::VectorXd& all) {
  camera.fx = all[0];
  camera.fy = all[1];
  camera.cx = all[2];
  camera.cy = all[3];
  Eigen::Map<Eigen::VectorXd>(camera.d.data(), 8) = all.tail<8>();
  return camera;
}

Camera centred(int width, int height, const Eigen::Vector2d& focal) {
  return {width, height, focal.x(), focal.y(), 0.5 * (width - 1), 0.5 * (height - 1), DistortionModel::kNone,
          {}};
}

/// A flat target that stands up in its middle by w_x (1 - x^2) + w_y (1 - y^2), x and y from -1 to 1 over its
/// points.
struct Target {
  Eigen::AlignedBox3d bounds;
  bool flat = true;

  explicit Target(const std::vector<CalibrationView>& views) {
    for (const CalibrationView& view : views)
      for (const TargetPoint& p : view.points) bounds.extend(p.p_in_target);
    flat = bounds.sizes().z() < 1e-9;
  }
  Eigen::Vector2d heightByWarp(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d half = bounds.sizes().head<2>().cwiseMax(1e-9) / 2;
    const Eigen::Vector2d at = (p - bounds.center()).head<2>().cwiseQuotient(half);
    return Eigen::Vector2d::Ones() - at.cwiseProduct(at);
  }
};

/// Blocks: intrinsics, warp, camera_from_target.
Term pointsOf(const CalibrationView& view, const Camera& camera, const Target& target, double robust_width) {
  Term term;
  term.residuals = 2 * int(view.points.size());
  term.residuals_per_error = 2;
  term.loss = RobustLoss::huber(robust_width);
  term.evaluate = [points = view.points, camera, target](const TermValues& at, bool derivatives,
                                                         TermErrors* errors) {
    const Camera adjusted = withIntrinsics(camera, at.vector(0));
    const Rigid3& pose = at.pose(2);
    if (!(std::min(adjusted.fx, adjusted.fy) > 0)) return false;

    for (size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d rise = target.heightByWarp(points[i].p_in_target);
      const Eigen::Vector3d p = points[i].p_in_target + Eigen::Vector3d(0, 0, rise.dot(at.vector(1)));
      const Eigen::Vector3d rotated = pose.rotation * p;
      const Eigen::Vector3d q = rotated + pose.translation;
      if (!(q.z() > 0)) return false;
      const Projection seen = projectWithDerivatives(adjusted, q);
      const int row = 2 * int(i);
      const double weight = 1 / points[i].sigma;
      errors->residuals.segment<2>(row) = weight * (seen.uv_raw - points[i].uv_raw);
      if (!derivatives) continue;

      const Eigen::Matrix<double, 2, 3> by_q = weight * seen.by_point;
      errors->jacobians[0].middleRows<2>(row) = weight * seen.by_intrinsics;
      errors->jacobians[1].middleRows<2>(row) = by_q * pose.rotation.col(2) * rise.transpose();
      errors->jacobians[2].middleRows<2>(row) << by_q, -by_q * skew(rotated);
    }
    return true;
  };
  return term;
}

struct CameraProblem {
  AdjustmentProblem problem;
  BlockId intrinsics = 0, warp = 0;
  std::vector<BlockId> poses;
};

/// What is being fitted: a lens model with its start, and where the target stood in each view.
struct CameraState {
  Camera camera;
  Eigen::VectorXd warp = Eigen::Vector2d::Zero();
  std::vector<Rigid3> poses;
  double cost = std::numeric_limits<double>::infinity();
};

/// The camera with a lens of this model that does not yet distort, or, an equidistant one, as its model does
/// by itself.
Camera withLensModel(Camera camera, const std::string& model) {
  constexpr double kNone[4] = {};
  setDistortion(&camera, model, kNone, 4);
  return camera;
}

int coefficientsOf(const Camera& camera) {
  return camera.model == DistortionModel::kNone ? 0 : distortionCount(camera);
}

/// Of any camera: coefficients of a rational lens are alike in what they do and would run away along a
/// valley.
Eigen::MatrixXd usualSpread(const Camera& camera) {
  constexpr double kWidths = 10, kCoefficient = 3;
  Eigen::VectorXd sigmas(kIntrinsics);
  sigmas << Eigen::Vector4d::Constant(kWidths * camera.width), Eigen::VectorXd::Constant(8, kCoefficient);
  return sigmas.cwiseAbs2().asDiagonal();
}

/// `without`: a view that is left out; -1: none.
CameraProblem problemFrom(const std::vector<CalibrationView>& views, const CameraState& start,
                          int coefficients, const CameraOptions& options, int without) {
  const Target target(views);
  CameraProblem p;
  p.intrinsics = p.problem.addVector("the camera", intrinsicsOf(start.camera));
  for (int k = 4 + coefficients; k < kIntrinsics; ++k) p.problem.hold(p.intrinsics, k);
  const Camera usual =
      centred(start.camera.width, start.camera.height, Eigen::Vector2d::Constant(start.camera.width));
  p.problem.addPrior(p.intrinsics, intrinsicsOf(usual), usualSpread(usual));
  p.warp = p.problem.addVector("the target's warp", start.warp);
  if (options.free_warp && target.flat) {
    constexpr double kWarp = 5e-3;  // of the target's half diagonal: a board that is bent more is seen to be
    const double sigma = kWarp * target.bounds.diagonal().norm() / 2;
    p.problem.addPrior(p.warp, Eigen::VectorXd(Eigen::Vector2d::Zero()),
                       sigma * sigma * Eigen::Matrix2d::Identity());
  } else {
    p.problem.hold(p.warp);
  }

  for (size_t v = 0; v < views.size(); ++v) {
    p.poses.push_back(p.problem.addPose("the target in " + views[v].name, start.poses[v]));
    if (int(v) == without) {
      p.problem.hold(p.poses.back());
      continue;
    }
    p.problem.eliminate(p.poses.back());
    Term term = pointsOf(views[v], start.camera, target, options.robust_width);
    term.blocks = {p.intrinsics, p.warp, p.poses.back()};
    term.group = int(v);
    p.problem.addTerm(std::move(term));
  }
  return p;
}

CameraState stateOf(const CameraProblem& p, const Camera& camera, double cost) {
  CameraState state;
  state.camera = withIntrinsics(camera, p.problem.vector(p.intrinsics));
  state.warp = p.problem.vector(p.warp);
  for (const BlockId pose : p.poses) state.poses.push_back(p.problem.pose(pose));
  state.cost = cost;
  return state;
}

CameraState fitted(const std::vector<CalibrationView>& views, const CameraState& start, int coefficients,
                   const CameraOptions& options, int without = -1) {
  CameraProblem p = problemFrom(views, start, coefficients, options, without);
  const AdjustmentReport report = adjust(&p.problem);
  if (report.end == AdjustmentEnd::kBadStart) return start;
  return stateOf(p, start.camera, report.cost);
}

/// Root mean square distance [px] of a view's points from where a camera sees them, the target where it fits
/// best.
double rmsOf(const CalibrationView& view, const std::vector<CalibrationView>& views, const CameraState& state,
             const Rigid3& pose, const CameraOptions& options) {
  AdjustmentProblem problem;
  const BlockId intrinsics = problem.addVector("the camera", intrinsicsOf(state.camera));
  const BlockId warp = problem.addVector("the target's warp", state.warp);
  const BlockId block = problem.addPose("the target in " + view.name, pose);
  problem.hold(intrinsics);
  problem.hold(warp);
  const Target target(views);
  Term term = pointsOf(view, state.camera, target, options.robust_width);
  term.blocks = {intrinsics, warp, block};
  problem.addTerm(std::move(term));
  adjust(&problem);

  double sum = 0;
  for (const TargetPoint& point : view.points) {
    const double rise = target.heightByWarp(point.p_in_target).dot(state.warp);
    const Eigen::Vector3d q = problem.pose(block) * (point.p_in_target + Eigen::Vector3d(0, 0, rise));
    sum += (state.camera.distort(state.camera.project(q)) - point.uv_raw).squaredNorm();
  }
  return std::sqrt(sum / double(view.points.size()));
}

/// Focal lengths to begin with: Zhang's, and those of usual lenses, 90 to 35 degrees wide.
std::vector<Eigen::Vector2d> focalStarts(const std::vector<CalibrationView>& views, int width, int height) {
  std::vector<Eigen::Matrix3d> homographies;
  for (const CalibrationView& view : views)
    if (const std::optional<Eigen::Matrix3d> h = homographyOf(view)) homographies.push_back(*h);

  std::vector<Eigen::Vector2d> starts;
  const Eigen::Vector2d middle(0.5 * (width - 1), 0.5 * (height - 1));
  if (const auto zhang = focalLengths(homographies, middle)) starts.push_back(*zhang);
  for (const double widths : {0.5, 0.9, 1.6}) starts.push_back(Eigen::Vector2d::Constant(widths * width));
  return starts;
}

/// The best fit without a lens, from any start.
std::optional<CameraState> withoutLens(const std::vector<CalibrationView>& views, int width, int height,
                                       const CameraOptions& options) {
  std::optional<CameraState> best;
  for (const Eigen::Vector2d& focal : focalStarts(views, width, height)) {
    CameraState start;
    start.camera = {
        width, height, focal.x(), focal.y(), 0.5 * (width - 1), 0.5 * (height - 1), DistortionModel::kNone,
        {}};
    for (const CalibrationView& view : views) {
      const std::optional<Rigid3> pose = targetPose(view, start.camera);
      if (!pose) break;
      start.poses.push_back(*pose);
    }
    if (start.poses.size() < views.size()) continue;
    const CameraState state = fitted(views, start, 0, options);
    if (!best || state.cost < best->cost) best = state;
  }
  return best;
}

std::vector<std::string> modelsOf(const CameraOptions& options) {
  if (!options.model.empty()) return {options.model};
  return {"plumb_bob", "rational_polynomial", "equidistant"};
}

CameraCalibration calibrationOf(const std::vector<CalibrationView>& views, const CameraState& state,
                                const CameraOptions& options) {
  CameraCalibration result;
  result.camera = state.camera;
  result.warp = state.warp;
  const int coefficients = coefficientsOf(state.camera);
  double sum = 0;
  double left_out = 0;
  size_t points = 0;
  for (size_t v = 0; v < views.size(); ++v) {
    CalibratedView view{views[v].name, state.poses[v], rmsOf(views[v], views, state, state.poses[v], options),
                        0};
    const CameraState others = fitted(views, state, coefficients, options, int(v));
    view.left_out_rms = rmsOf(views[v], views, others, state.poses[v], options);
    const size_t count = views[v].points.size();
    sum += double(count) * view.rms * view.rms;
    left_out += double(count) * view.left_out_rms * view.left_out_rms;
    points += count;
    result.views.push_back(view);
  }
  result.rms = std::sqrt(sum / double(points));
  result.left_out_rms = std::sqrt(left_out / double(points));
  return result;
}

struct Fit {
  CameraState state;
  CameraCalibration calibration;
};

/// Of the lenses that predict left-out views as well as the best, but for chance, the one with the fewest
/// coefficients.
Fit bestOf(const std::vector<Fit>& fits) {
  constexpr double kChance = 1.01;  // of the root mean square
  double least = std::numeric_limits<double>::infinity();
  for (const Fit& fit : fits) least = std::min(least, fit.calibration.left_out_rms);

  const Fit* best = nullptr;
  for (const Fit& fit : fits) {
    if (fit.calibration.left_out_rms > kChance * least) continue;
    if (!best || coefficientsOf(fit.state.camera) < coefficientsOf(best->state.camera)) best = &fit;
  }
  return best ? *best : fits.front();
}

void requireUsable(const std::vector<CalibrationView>& views) {
  if (views.size() < 3)
    throw BadInput(
        fmt::format("calibrating a camera needs at least 3 views, better 20: there are {}", views.size()));
  for (const CalibrationView& view : views)
    if (view.points.size() < 4)
      throw BadInput(fmt::format("{}: {} points of the target are seen, at least four are needed", view.name,
                                 view.points.size()));
}

}  // namespace

void CameraOptions::check() const {
  if (!model.empty()) withLensModel({}, model);
  requirePositive("robust_width", robust_width);
}

CameraCalibration calibrateCamera(const std::vector<CalibrationView>& views, int width, int height,
                                  const CameraOptions& options) {
  options.check();
  requireUsable(views);
  const std::optional<CameraState> plain = withoutLens(views, width, height, options);
  if (!plain)
    throw BadInput(
        "no usual lens shows the target so: does its drawing, its size and its kind, agree with the images?");

  std::vector<Fit> fits;
  for (const std::string& model : modelsOf(options)) {
    CameraState start = *plain;
    start.camera = withLensModel(start.camera, model);
    const CameraState state = fitted(views, start, coefficientsOf(start.camera), options);
    fits.push_back({state, calibrationOf(views, state, options)});
  }
  const Fit best = bestOf(fits);

  const CameraProblem p = problemFrom(views, best.state, coefficientsOf(best.state.camera), options, -1);
  const std::optional<Eigen::MatrixXd> covariance = AdjustmentUncertainty(p.problem).sandwich({p.intrinsics});
  if (!covariance)
    throw BadInput(
        "the views leave the camera open: tilt the target by 30 degrees and more, about both of its axes");
  CameraCalibration result = best.calibration;
  result.covariance = *covariance;
  return result;
}

}  // namespace monocular_eye_hand
