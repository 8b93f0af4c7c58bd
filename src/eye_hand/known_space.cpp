// What is known to be filled rules out poses that reach into it.
#include "monocular_eye_hand/eye_hand/known_space.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/length_text.h"
#include "monocular_eye_hand/model/interior.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMaxSamples = 1000;  // of a box
constexpr double kMaxShrunk = 0.7;    // share of a box's half sides that a tolerance takes at most

/// Sigma of the height of a point of the object: a small turn lifts it by its lever arm.
double sigmaOfHeight(const Eigen::Vector3d& offset, const Matrix6d& covariance) {
  Vector6d gradient;
  gradient << 0, 0, 1, offset.y(), -offset.x(), 0;
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

std::string belowTable(const ObjectModel& model, const Rigid3& base_from_object, const Matrix6d& covariance,
                       double table_height, const KnownSpaceTolerance& tolerance) {
  double deepest = 0;
  for (const Eigen::Vector3d& vertex : model.mesh.vertices) {
    const Eigen::Vector3d offset = base_from_object.rotation * vertex;
    const double depth = table_height - (base_from_object.translation.z() + offset.z());
    const double allowed = tolerance.depth + tolerance.sigmas * sigmaOfHeight(offset, covariance);
    if (depth > allowed) deepest = std::max(deepest, depth);
  }
  if (deepest <= 0) return "";
  return "reaches " + millimetresText(deepest) +
         " below the table's top (z = " + millimetresText(table_height) + ")";
}

/// Points of a regular grid in a box around the origin.
std::vector<Eigen::Vector3d> gridPoints(const Eigen::Vector3d& half_size, double step) {
  const double cell = std::max(step, std::cbrt(8 * half_size.prod() / kMaxSamples));
  const Eigen::Array3i cells = (2 * half_size / cell).array().ceil().max(1).cast<int>();
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < cells[0]; ++i)
    for (int j = 0; j < cells[1]; ++j)
      for (int k = 0; k < cells[2]; ++k) {
        const Eigen::Array3d share = (Eigen::Array3d(i, j, k) + 0.5) / cells.cast<double>();
        points.push_back((2 * share - 1) * half_size.array());
      }
  return points;
}

bool reachesInto(const KnownBox& box, const ObjectModel& model, const std::vector<Eigen::Vector3d>& core,
                 const Rigid3& base_from_object, double margin) {
  const Rigid3 box_from_object = box.base_from_box.inverse() * base_from_object;
  const double apart = (box_from_object * model.centre()).norm();
  if (apart > (box.size.norm() + model.bounds.diagonal().norm()) / 2) return false;

  const Eigen::Vector3d half = box.size / 2;
  const Eigen::Vector3d shrunk = half - (kMaxShrunk * half).cwiseMin(margin);
  const auto inside = [&](const Eigen::Vector3d& p_in_object) {
    return ((box_from_object * p_in_object).cwiseAbs().array() < shrunk.array()).all();
  };
  if (std::any_of(core.begin(), core.end(), inside)) return true;
  if (std::any_of(model.mesh.vertices.begin(), model.mesh.vertices.end(), inside)) return true;

  const Rigid3 object_from_box = box_from_object.inverse();
  const std::vector<Eigen::Vector3d> points = gridPoints(shrunk, std::max(1e-3, margin));
  return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& p_in_box) {
    return insideSolid(model, object_from_box * p_in_box);
  });
}

}  // namespace

std::string reachesIntoKnown(const ObjectModel& model, const std::vector<Eigen::Vector3d>& core,
                             const Rigid3& base_from_object, const Matrix6d& covariance,
                             const KnownSpace& space, const KnownSpaceTolerance& tolerance) {
  if (space.table_height) {
    const std::string below = belowTable(model, base_from_object, covariance, *space.table_height, tolerance);
    if (!below.empty()) return below;
  }
  if (space.boxes.empty()) return "";
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> position(covariance.topLeftCorner<3, 3>(),
                                                                Eigen::EigenvaluesOnly);
  const double sigma = std::sqrt(std::max(0.0, position.eigenvalues().maxCoeff()));
  const double margin = tolerance.depth + tolerance.sigmas * sigma;
  for (const KnownBox& box : space.boxes)
    if (reachesInto(box, model, core, base_from_object, margin)) return "reaches into " + box.name;
  return "";
}

}  // namespace monocular_eye_hand
