#include "recognition/search_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/model/equal_poses.h"
#include "recognition/flat_view.h"
#include "recognition/focal_length.h"
#include "recognition/resolved_contour.h"
#include "recognition/view_templates.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMaxCompared = 2000;  // vertices that tell whether two poses coincide
constexpr int kLookupSide = 24;        // cells along one side of a cube face
constexpr double kCoarseSize =
    160;  // a part's diameter where its lines are told apart for the coarse score [px]
constexpr double kSquare = 0.15;     // sides that differ by less of the larger one are taken for each other
constexpr double kNearbyEyes = 0.3;  // eyes this near to one that sees a grouping may see it, too [rad]
constexpr double kSameRotation = 0.06;  // rotations nearer than this are one [rad]

int lookupCell(const Eigen::Vector3d& d) {
  int axis;
  d.cwiseAbs().maxCoeff(&axis);
  const int face = 2 * axis + (d[axis] < 0 ? 1 : 0);
  const double major = std::abs(d[axis]);
  const auto index = [&](double value) {
    return std::clamp(int((value / major * 0.5 + 0.5) * kLookupSide), 0, kLookupSide - 1);
  };
  return (face * kLookupSide + index(d[(axis + 1) % 3])) * kLookupSide + index(d[(axis + 2) % 3]);
}

Eigen::Vector3d cellDirection(int cell) {
  const int face = cell / (kLookupSide * kLookupSide), rest = cell % (kLookupSide * kLookupSide);
  const int axis = face / 2;
  Eigen::Vector3d d;
  d[axis] = face % 2 ? -1 : 1;
  const int row = rest / kLookupSide, column = rest % kLookupSide;
  d[(axis + 1) % 3] = (row + 0.5) / kLookupSide * 2 - 1;
  d[(axis + 2) % 3] = (column + 0.5) / kLookupSide * 2 - 1;
  return d.normalized();
}

// Looking from `direction` (object to eye) at the centre: rows are the camera axes in the object frame.
Eigen::Matrix3d lookAtRotation(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z = -direction;
  const Eigen::Vector3d up = std::abs(z.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d x = z.cross(up).normalized();
  Eigen::Matrix3d r;
  r << x.transpose(), z.cross(x).transpose(), z.transpose();
  return r;
}

double azimuth(const SymmetryAxis& axis, const Eigen::Vector3d& d) {
  const Eigen::Vector3d x = axis.direction.unitOrthogonal(), y = axis.direction.cross(x);
  return std::atan2(d.dot(y), d.dot(x));
}

// The view with what a camera can tell apart when the part fills kCoarseSize px.
SampledView resolvedView(const ObjectModel& model, const SampledView& view, const Eigen::Matrix3d& rotation) {
  const FlatView flat = flatten(view, rotation, model.centre(), 1);
  std::vector<SeenSample> drawn;
  for (size_t i = 0; i < view.contour.size(); ++i) {
    SeenSample s;
    s.p_in_object = view.contour[i].p;
    s.uv = flat.place[i] * (kCoarseSize / model.diameter);
    s.direction = flat.direction[i].normalized();
    s.feature = view.contour[i].feature;
    s.silhouette = view.contour[i].silhouette;
    drawn.push_back(s);
  }
  SampledView resolved = view;
  resolved.contour.clear();
  for (size_t i : resolvedSamples(model, drawn)) resolved.contour.push_back(view.contour[i]);
  return resolved;
}

}  // namespace

SearchModel::SearchModel(const KnownObject& object)
    : object_(&object),
      groupings_(modelGroupings(object)),
      surface_(std::make_shared<ClosestPoint>(object.model.mesh)) {
  const Eigen::Vector3d centre = model().centre();
  for (const SampledView& view : object.views.views) {
    view_rotation_.push_back(lookAtRotation(view.direction));
    float step = float(sampleStepOf(view));
    const SampledView resolved = resolvedView(model(), view, view_rotation_.back());
    const FlatView flat = flatten(resolved, view_rotation_.back(), centre, step);

    std::vector<double> weight(flat.place.size());
    for (size_t i = 0; i < weight.size(); ++i) weight[i] = 1e3 + flat.place[i].norm();
    const std::vector<int> order = spreadOrder(flat.place, weight, CoarseContour::kMaxSamples);
    std::vector<ViewSample> samples;
    for (int i : order) {
      const ContourSample& s = resolved.contour[i];
      samples.push_back({s.p.cast<float>(), s.tangent.cast<float>(), s.feature});
    }
    // Fewer samples stand for the same contour: the step grows accordingly.
    if (!samples.empty()) step *= float(resolved.contour.size()) / float(samples.size());
    coarse_.emplace_back(samples, step);
    samples_.push_back(std::move(samples));
  }

  for (int i = 0; i < 8; ++i) extent_.push_back(model().bounds.corner(Eigen::AlignedBox3d::CornerType(i)));
  buildLookup();
  buildShown();
  levels_ = templateLevels(object, view_rotation_);
  buildBoxRotations();
  buildHull();
}

void SearchModel::buildBoxRotations() {
  const Symmetries& symmetries = model().symmetries;
  if (symmetries.sphere) return;
  std::vector<Rigid3> known = symmetries.discrete;

  for (int axis = 0; axis < 3; ++axis) {
    const double a = model().bounds.sizes()[(axis + 1) % 3], b = model().bounds.sizes()[(axis + 2) % 3];
    const bool square = std::abs(a - b) < kSquare * std::max(a, b);
    for (int quarters : {2, 1, 3}) {
      if (quarters != 2 && !square) continue;
      const Eigen::AngleAxisd rotation(quarters * M_PI / 2, Eigen::Vector3d::Unit(axis));
      const Rigid3 motion = rotationAbout(model().centre(), rotation.toRotationMatrix());
      const auto same = [&](const Rigid3& other) {
        return angleBetween(turnedTowards(model(), other, motion).rotation, motion.rotation) < kSameRotation;
      };
      if (std::any_of(known.begin(), known.end(), same)) continue;
      known.push_back(motion);
      box_rotations_.push_back(motion);
    }
  }
}

bool SearchModel::coincide(const Camera& camera, const Rigid3& a, const Rigid3& b, double resolved) const {
  const double distance = (a * model().centre()).norm();
  const double limit = resolved * distance / focalLength(camera);
  const std::vector<Eigen::Vector3d>& points = model().mesh.vertices;
  const size_t stride = 1 + points.size() / kMaxCompared;
  const Rigid3 a_to_b = b.inverse() * a, b_to_a = a.inverse() * b;
  for (size_t i = 0; i < points.size(); i += stride) {
    if (surface_->distance(a_to_b * points[i], 2 * limit) > limit) return false;
    if (surface_->distance(b_to_a * points[i], 2 * limit) > limit) return false;
  }
  return true;
}

void SearchModel::buildHull() {
  constexpr int kDirections = 400, kViews = 120;
  const auto onSphere = [](int k, int count) -> Eigen::Vector3d {  // evenly spread: Fibonacci's spiral
    const double z = 1 - (2 * k + 1.0) / count, angle = k * 2.399963229728653, r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  };
  std::vector<char> outermost(model().mesh.vertices.size(), 0);
  for (int k = 0; k < kDirections; ++k) {
    const Eigen::Vector3d direction = onSphere(k, kDirections);
    size_t best = 0;
    double farthest = -std::numeric_limits<double>::max();
    for (size_t i = 0; i < outermost.size(); ++i) {
      const double reach = direction.dot(model().mesh.vertices[i]);
      if (reach <= farthest) continue;
      farthest = reach;
      best = i;
    }
    outermost[best] = 1;
  }
  for (size_t i = 0; i < outermost.size(); ++i)
    if (outermost[i]) hull_.push_back(model().mesh.vertices[i]);

  for (int k = 0; k < kViews; ++k) {
    const ViewExtent seen = extentAlong(onSphere(k, kViews));
    largest_.area = std::max(largest_.area, seen.area);
    largest_.length = std::max(largest_.length, seen.length);
  }
}

ViewExtent SearchModel::extentAlong(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d x = direction.unitOrthogonal(), y = direction.cross(x);
  std::vector<cv::Point2f> points, hull;
  for (const Eigen::Vector3d& p : hull_) points.emplace_back(float(x.dot(p)), float(y.dot(p)));
  if (points.size() < 3) return {};
  cv::convexHull(points, hull);
  ViewExtent extent;
  extent.area = cv::contourArea(hull);
  for (size_t i = 0; i < hull.size(); ++i)
    for (size_t j = i + 1; j < hull.size(); ++j)
      extent.length = std::max(extent.length, cv::norm(hull[i] - hull[j]));
  return extent;
}

ViewExtent SearchModel::extentSeenFrom(const Rigid3& pose) const {
  const Eigen::Vector3d eye = -(pose.rotation.transpose() * pose.translation);
  return extentAlong((eye - model().centre()).normalized());
}

void SearchModel::buildLookup() {
  const Symmetries& symmetries = model().symmetries;
  const int directions = object_->views.directions;
  if (symmetries.axis) {
    // A meridian's views share their azimuth; at a pole it is undefined, so it is read off the widest tilt.
    double widest = -1;
    for (int k = 0; k < directions; ++k) {
      const Eigen::Vector3d& v = object_->views.views[k].direction;
      const double off = symmetries.axis->direction.cross(v).norm();
      if (off > widest) {
        widest = off;
        meridian_ = azimuth(*symmetries.axis, v);
      }
    }
  }

  lookup_.resize(6 * kLookupSide * kLookupSide);
  for (size_t cell = 0; cell < lookup_.size(); ++cell) {
    const Eigen::Vector3d d = cellDirection(int(cell));
    double best = -2;
    for (size_t s = 0; s < symmetries.discrete.size(); ++s) {
      const Eigen::Vector3d moved = symmetries.discrete[s].rotation.transpose() * d;
      for (int k = 0; k < directions; ++k) {
        const Eigen::Vector3d& v = object_->views.views[k].direction;
        double cosine = v.dot(moved);
        if (symmetries.axis) {  // only the tilt counts
          const double a = symmetries.axis->direction.dot(v), b = symmetries.axis->direction.dot(moved);
          cosine = std::cos(std::acos(std::clamp(a, -1.0, 1.0)) - std::acos(std::clamp(b, -1.0, 1.0)));
        }
        if (symmetries.sphere) cosine = 1 - 1e-6 * double(k + s);
        if (cosine > best + 1e-12) {
          best = cosine;
          lookup_[cell] = {int16_t(k), int16_t(s)};
        }
      }
    }
  }
}

void SearchModel::buildShown() {
  const Symmetries& symmetries = model().symmetries;
  const size_t directions = size_t(object_->views.directions);
  const size_t copies = symmetries.discrete.size();
  const auto eye = [&](size_t copy, size_t view) -> Eigen::Vector3d {
    return symmetries.discrete[copy].rotation * object_->views.views[view].direction;
  };
  const auto beside = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    if (symmetries.sphere) return true;
    if (!symmetries.axis) return a.dot(b) >= std::cos(kNearbyEyes);
    const Eigen::Vector3d& axis = symmetries.axis->direction;  // only the tilt counts
    const auto tilt = [&](const Eigen::Vector3d& d) { return std::acos(std::clamp(axis.dot(d), -1.0, 1.0)); };
    return std::abs(tilt(a) - tilt(b)) <= kNearbyEyes;
  };

  // Eyes of the lookup beside each that `seen` may name: with a symmetry's inverse.
  std::vector<std::vector<size_t>> neighbours(copies * directions);
  for (size_t i = 0; i < neighbours.size(); ++i) {
    const Eigen::Vector3d from =
        symmetries.discrete[i / directions].rotation.transpose() * eye(0, i % directions);
    for (size_t k = 0; k < neighbours.size(); ++k)
      if (beside(eye(k / directions, k % directions), from)) neighbours[i].push_back(k);
  }

  for (const ModelGrouping& grouping : groupings_) {
    std::vector<char> shown(neighbours.size(), 0);
    for (const SeenFrom& from : grouping.seen)
      for (size_t k : neighbours[size_t(from.symmetry) * directions + size_t(from.view)]) shown[k] = 1;
    shown_.push_back(std::move(shown));
  }
}

bool SearchModel::shows(size_t grouping, const Rigid3& pose) const {
  const Eigen::Vector3d eye = -(pose.rotation.transpose() * pose.translation);
  const Nearest nearest = lookup_[size_t(lookupCell(eye - model().centre()))];
  return shown_[grouping][size_t(nearest.symmetry) * size_t(object_->views.directions) +
                          size_t(nearest.direction)] != 0;
}

Rigid3 SearchModel::canonical(const Rigid3& pose, int* view) const {
  const Symmetries& symmetries = model().symmetries;
  const Eigen::Vector3d eye = -(pose.rotation.transpose() * pose.translation);
  const Eigen::Vector3d from_centre = eye - model().centre();
  const double distance = from_centre.norm();
  const Eigen::Vector3d direction = from_centre / std::max(distance, 1e-12);

  const Nearest nearest = lookup_[lookupCell(direction)];
  const SampledView& seen = object_->views.views[nearest.direction];
  Rigid3 result = nearest.symmetry ? pose * symmetries.discrete[nearest.symmetry] : pose;
  if (symmetries.sphere || symmetries.axis) {
    const Eigen::Vector3d d =
        (-(result.rotation.transpose() * result.translation) - model().centre()).normalized();
    if (symmetries.sphere) {
      result =
          result * rotationAbout(model().centre(),
                                 Eigen::Quaterniond::FromTwoVectors(seen.direction, d).toRotationMatrix());
    } else {
      const SymmetryAxis& axis = *symmetries.axis;
      result = result * rotationAbout(axis, azimuth(axis, d) - meridian_);
    }
  }

  if (view) {
    int level = 0;
    double best = std::numeric_limits<double>::max();
    const auto& distances = object_->views.distances;
    for (size_t i = 0; i < distances.size(); ++i) {
      const double gap = std::abs(1 / distances[i] - 1 / distance);
      if (gap < best) {
        best = gap;
        level = int(i);
      }
    }
    *view = level * object_->views.directions + nearest.direction;
  }
  return result;
}

bool SearchModel::seenFromOutside(const Rigid3& pose) const {
  const Eigen::Vector3d eye = -(pose.rotation.transpose() * pose.translation);
  if (model().bounds.contains(eye)) return false;
  const Eigen::RowVector3d depth = pose.rotation.row(2);
  return std::all_of(model().mesh.vertices.begin(), model().mesh.vertices.end(),
                     [&](const Eigen::Vector3d& p) { return depth.dot(p) + pose.translation.z() > 0; });
}

double SearchModel::poseDistance(const Camera& camera, const Rigid3& a, const Rigid3& b) const {
  const auto largest = [&](const Rigid3& other) {
    double worst = 0;
    for (const Eigen::Vector3d& p : extent_) {
      const Eigen::Vector3d pa = a * p, pb = other * p;
      if (pa.z() <= 0 || pb.z() <= 0) return std::numeric_limits<double>::max();
      worst = std::max(worst, (camera.project(pa) - camera.project(pb)).norm());
    }
    return worst;
  };
  double best = std::numeric_limits<double>::max();
  for (const Rigid3& s : model().symmetries.discrete) {
    best = std::min(best, largest(turnedTowards(model(), b * s, a)));
  }
  return best;
}

}  // namespace monocular_eye_hand
