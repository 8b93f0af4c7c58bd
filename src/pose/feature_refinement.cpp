#include "monocular_eye_hand/pose/feature_refinement.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "monocular_eye_hand/geometry/median.h"
#include "monocular_eye_hand/pose/refine.h"

namespace monocular_eye_hand {
namespace {

// How many observations it is worth what is known of a feature's errors before anything is seen.
constexpr double kCommonWorth = 4, kSampleWorth = 4;
constexpr double kSampleError = 0.04;  // of a sample by itself, at first [px]
constexpr double kRotated = 0.45;    // displacement at an edge's ends by its rotation, over that of the whole
constexpr double kMinSpread = 0.03;  // [px]
constexpr double kCorrelation = 3;   // neighbouring samples err alike: so many count as one
constexpr double kOutlier = 1.5;     // residuals beyond this belong to something else [px]
constexpr int kIterations = 12;
// What is known of a pose without any feature [m, rad]: keeps the inverse finite.
constexpr double kPriorMetres = 1.0, kPriorRadians = 1.8;
constexpr double kHeld = 1e9;  // information about a free axis while it is held

// Where the residuals spread farther than of a true model in a sharp image, every feature may be displaced by
// so much of the excess.
constexpr double kUsualSpread = 0.1, kExcessShare = 0.8;  // [px]
// What a pose that has locked to wrong edges does not know of itself grows with the residuals' spread:
// measured, the covariance has to be as many times wider as the spread is than this [px].
constexpr double kHonestSpread = 0.093;
// Measured: all edges of a part may be displaced alike, however many there are (light from one side?) [px].
constexpr double kCommonShift = 0.015;

struct Sample {
  Eigen::Vector2d uv;
  double residual;  // [px]
  Vector6d derivative;
  EdgeAppearance appearance;
  double displacement;
};

// The samples of one feature: residual + derivative^T motion = basis^T common + independent error, where
// basis = (1, place along the feature, place across it), places within -kRotated .. kRotated. A straight edge
// is displaced or rotated, a circle grows or is displaced.
class Feature {
 public:
  Feature(const std::vector<Sample>& samples, double expected_offset)
      : samples_(double(samples.size())),
        expected_common_(expected_offset * expected_offset),
        common_variance_(expected_common_) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Sample& s : samples) mean += s.uv / samples_;
    const Eigen::Vector2d along = direction(samples, mean);
    const Eigen::Vector2d across(-along.y(), along.x());
    double reach = 0;
    for (const Sample& s : samples) reach = std::max(reach, std::abs(along.dot(s.uv - mean)));
    const double scale = samples.size() < 3 || !(reach > 0) ? 0 : kRotated / reach;

    for (const Sample& s : samples) {
      const Eigen::Vector2d place = s.uv - mean;
      const Eigen::Vector3d basis(1, scale * along.dot(place), scale * across.dot(place));
      jj_ += s.derivative * s.derivative.transpose();
      jb_ += s.derivative * basis.transpose();
      jr_ += s.derivative * s.residual;
      bb_ += basis * basis.transpose();
      br_ += basis * s.residual;
      rr_ += s.residual * s.residual;
    }
  }

  // Begins anew with an offset to be expected beside the present one [px].
  void expectMore(double offset) {
    expected_common_ += offset * offset;
    common_variance_ = expected_common_;
    sample_variance_ = kSampleError * kSampleError;
  }

  // Adds J^T W J and J^T W r, W the inverse covariance of the samples' errors.
  void addTo(Matrix6d* information, Vector6d* gradient) {
    const double weight = 1 / (kCorrelation * sample_variance_);
    common_covariance_ =
        (Eigen::Matrix3d::Identity() / common_variance_ + weight * bb_).inverse();  // given the motion
    const Eigen::Matrix<double, 6, 3> shared = weight * weight * jb_ * common_covariance_;
    *information += weight * jj_ - shared * jb_.transpose();
    *gradient += weight * jr_ - shared * br_;
  }

  // The most likely sizes of the errors, given what addTo() was asked for: a motion and its covariance.
  void estimate(const Vector6d& motion, const Matrix6d& covariance) {
    const double weight = 1 / (kCorrelation * sample_variance_);
    const Eigen::Matrix<double, 3, 6> follows = weight * common_covariance_ * jb_.transpose();
    const Eigen::Vector3d common = weight * common_covariance_ * br_ + follows * motion;
    // Expectations of common common^T and of the squared independent errors.
    const Eigen::Matrix3d second =
        common * common.transpose() + common_covariance_ + follows * covariance * follows.transpose();
    const Matrix6d moved = jj_ - 2 * jb_ * follows + follows.transpose() * bb_ * follows;
    const double independent = squares(motion) - 2 * common.dot(br_ + jb_.transpose() * motion) +
                               common.dot(bb_ * common) + (bb_ * common_covariance_).trace() +
                               (moved * covariance).trace();
    common_variance_ = (kCommonWorth * expected_common_ + second.trace()) / (kCommonWorth + 3);
    sample_variance_ =
        (kSampleWorth * kSampleError * kSampleError + std::max(0.0, independent)) / (kSampleWorth + samples_);
  }

  // Sum of squared residuals after the motion [px^2].
  double squares(const Vector6d& motion) const {
    return rr_ + 2 * motion.dot(jr_) + motion.dot(jj_ * motion);
  }
  double samples() const { return samples_; }

 private:
  static Eigen::Vector2d direction(const std::vector<Sample>& samples, const Eigen::Vector2d& mean) {
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const Sample& s : samples) spread += (s.uv - mean) * (s.uv - mean).transpose();
    const double angle = 0.5 * std::atan2(2 * spread(0, 1), spread(0, 0) - spread(1, 1));
    return {std::cos(angle), std::sin(angle)};
  }

  double samples_;
  Matrix6d jj_ = Matrix6d::Zero();
  Eigen::Matrix<double, 6, 3> jb_ = Eigen::Matrix<double, 6, 3>::Zero();
  Vector6d jr_ = Vector6d::Zero();
  Eigen::Matrix3d bb_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d br_ = Eigen::Vector3d::Zero();
  double rr_ = 0;
  double expected_common_, common_variance_, sample_variance_ = kSampleError * kSampleError;  // [px^2]
  Eigen::Matrix3d common_covariance_ = Eigen::Matrix3d::Zero();
};

using SamplesByFeature = std::map<int, std::vector<Sample>>;
SamplesByFeature usableSamples(const Rigid3& pose, const Camera& camera,
                               const std::vector<FeatureSample>& all) {
  SamplesByFeature usable;
  for (const FeatureSample& given : all) {
    Sample sample;
    sample.uv = given.line.uv;
    sample.appearance = given.appearance;
    sample.displacement = given.displacement;
    sample.residual = lineResidual(pose, camera, given.line, &sample.derivative);
    if (std::abs(sample.residual) < kOutlier && sample.derivative.allFinite())
      usable[given.feature].push_back(sample);
  }
  return usable;
}

std::vector<EdgeAppearance> appearancesOf(const std::vector<Sample>& samples) {
  std::vector<EdgeAppearance> appearances;
  appearances.reserve(samples.size());
  for (const Sample& s : samples) appearances.push_back(s.appearance);
  return appearances;
}

std::vector<Feature> featuresOf(const SamplesByFeature& samples) {
  std::vector<EdgeAppearance> all;
  for (const auto& [number, of_feature] : samples)
    for (const Sample& s : of_feature) all.push_back(s.appearance);
  const EdgeProfiles profiles(all);
  std::vector<Feature> features;
  for (const auto& [number, of_feature] : samples)
    features.emplace_back(of_feature, std::hypot(of_feature.front().displacement,
                                                 profiles.expectedOffset(appearancesOf(of_feature))));
  return features;
}

// Robust standard deviation of the residuals after a motion [px].
double spread(const SamplesByFeature& samples, const Vector6d& motion) {
  std::vector<double> sizes;
  for (const auto& [group, of_feature] : samples)
    for (const Sample& s : of_feature) sizes.push_back(std::abs(s.residual + s.derivative.dot(motion)));
  return std::max(kMinSpread, median(&sizes) / 0.6745);
}

// The motion of perturbed() that rotates the object about its free axis.
Vector6d freeRotation(const Rigid3& pose, const FreeAxis& axis) {
  Vector6d rotation = Vector6d::Zero();
  if (!axis.present) return rotation;
  const Eigen::Vector3d direction = (pose.rotation * axis.direction).normalized();
  rotation << (pose.rotation * axis.point).cross(direction), direction;
  return rotation;
}

// Covariance of the motion that shifts the whole part in the image.
Matrix6d shiftCovariance(const Camera& camera, double depth) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance(0, 0) = std::pow(kCommonShift * depth / camera.fx, 2);
  covariance(1, 1) = std::pow(kCommonShift * depth / camera.fy, 2);
  return covariance;
}

// The most likely motion and its covariance.
struct Estimate {
  Vector6d motion = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Identity();
};
Estimate maximizeExpectation(const Vector6d& rotation, std::vector<Feature>* features) {
  Vector6d prior;
  prior << Eigen::Vector3d::Constant(1 / (kPriorMetres * kPriorMetres)),
      Eigen::Vector3d::Constant(1 / (kPriorRadians * kPriorRadians));
  Estimate estimate;
  for (int i = 0; i <= kIterations; ++i) {
    if (i > 0)
      for (Feature& feature : *features) feature.estimate(estimate.motion, estimate.covariance);
    Matrix6d information = prior.asDiagonal();
    information += kHeld * rotation * rotation.transpose();
    Vector6d gradient = Vector6d::Zero();
    for (Feature& feature : *features) feature.addTo(&information, &gradient);
    estimate.covariance = information.ldlt().solve(Matrix6d::Identity());
    estimate.motion = -estimate.covariance * gradient;
  }
  return estimate;
}

}  // namespace

RefinedPose refineByFeatures(const Rigid3& start, const Camera& camera,
                             const std::vector<FeatureSample>& samples, const FreeAxis& axis) {
  RefinedPose refined;
  refined.camera_from_object = start;
  const SamplesByFeature usable = usableSamples(start, camera, samples);
  if (usable.empty()) return refined;

  std::vector<Feature> features = featuresOf(usable);
  const Vector6d rotation = freeRotation(start, axis);
  Estimate estimate = maximizeExpectation(rotation, &features);
  const double first_spread = spread(usable, estimate.motion);
  if (first_spread > kUsualSpread) {
    for (Feature& f : features)
      f.expectMore(kExcessShare * std::sqrt(first_spread * first_spread - kUsualSpread * kUsualSpread));
    estimate = maximizeExpectation(rotation, &features);
  }

  const Matrix6d covariance = spread(usable, estimate.motion) / kHonestSpread * estimate.covariance +
                              shiftCovariance(camera, start.translation.z()) +
                              M_PI * M_PI / 3 * rotation * rotation.transpose();
  if (!estimate.motion.allFinite() || !covariance.allFinite()) return refined;
  refined.camera_from_object = perturbed(start, estimate.motion);
  refined.covariance = 0.5 * (covariance + covariance.transpose());

  double squares = 0;
  for (const Feature& f : features) {
    squares += f.squares(estimate.motion);
    refined.inliers += f.samples();
  }
  refined.rms = std::sqrt(std::max(0.0, squares) / refined.inliers);
  refined.iterations = kIterations * (first_spread > kUsualSpread ? 2 : 1);
  refined.converged = refined.well_posed = true;
  return refined;
}

}  // namespace monocular_eye_hand
