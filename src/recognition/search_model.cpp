#include "recognition/search_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/model/equal_poses.h"
#include "recognition/median.h"
#include "recognition/resolved_contour.h"

namespace monocular_eye_hand {
namespace {

constexpr int kLookupSide = 24;           // cells along one side of a cube face
constexpr double kMinAnchorShare = 0.10;  // shortest ruler, as a share of the diameter
constexpr double kMinAnchorVisible = 0.8;
constexpr double kCoarseSize =
    160;  // a part's diameter where its lines are told apart for the coarse score [px]
constexpr double kSquare = 0.15;    // sides that differ by less of the larger one are taken for each other
constexpr double kSameTurn = 0.06;  // rotations nearer than this are one [rad]

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

// Farthest-first order on the samples' places: every prefix is spread out.
std::vector<int> spreadOrder(const std::vector<Eigen::Vector2d>& places, std::vector<double> nearest,
                             int count) {
  std::vector<int> order;
  while (int(order.size()) < count) {
    const int next = int(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
    if (nearest[next] <= 0) break;
    order.push_back(next);
    for (size_t i = 0; i < places.size(); ++i)
      nearest[i] = std::min(nearest[i], (places[i] - places[next]).norm());
    nearest[next] = 0;
  }
  return order;
}

struct FlatView {
  std::vector<Eigen::Vector2d> place, direction;  // metres at the centre's distance
  std::vector<int> group;
  double length = 0;
};

FlatView flatten(const SampledView& view, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& centre,
                 double step) {
  FlatView flat;
  for (const ContourSample& s : view.contour) {
    const Eigen::Vector3d p = rotation * (s.p - centre) + Eigen::Vector3d(0, 0, view.distance);
    const Eigen::Vector3d t = rotation * s.tangent;
    const double scale = view.distance / p.z();
    flat.place.emplace_back(p.head<2>() * scale);
    flat.direction.emplace_back((t.head<2>() - p.head<2>() * (t.z() / p.z())) * scale);
    flat.group.push_back(s.group);
    flat.length += flat.direction.back().norm() * step;
  }
  return flat;
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
    s.group = view.contour[i].group;
    s.silhouette = view.contour[i].silhouette;
    drawn.push_back(s);
  }
  SampledView resolved = view;
  resolved.contour.clear();
  for (size_t i : resolvedSamples(model, drawn)) resolved.contour.push_back(view.contour[i]);
  return resolved;
}

// Mean distance between neighbouring samples of the same group.
double sampleStepOf(const SampledView& view) {
  std::vector<double> gaps;
  for (size_t i = 1; i < view.contour.size(); ++i)
    if (view.contour[i].group == view.contour[i - 1].group)
      gaps.push_back((view.contour[i].p - view.contour[i - 1].p).norm());
  if (gaps.empty()) return 0.01;
  return median(&gaps);
}

}  // namespace

SearchModel::SearchModel(const KnownObject& object) : object_(&object), groupings_(modelGroupings(object)) {
  const Eigen::Vector3d centre = model().centre();
  for (const SampledView& view : object.views.views) {
    view_rotation_.push_back(lookAtRotation(view.direction));
    steps_.push_back(float(sampleStepOf(view)));
    const SampledView resolved = resolvedView(model(), view, view_rotation_.back());
    const FlatView flat = flatten(resolved, view_rotation_.back(), centre, steps_.back());
    std::vector<double> weight(flat.place.size());
    for (size_t i = 0; i < weight.size(); ++i) weight[i] = 1e3 + flat.place[i].norm();
    const std::vector<int> order = spreadOrder(flat.place, weight, 64);
    std::vector<ViewSample> samples;
    for (int i : order) {
      const ContourSample& s = resolved.contour[i];
      samples.push_back({s.p.cast<float>(), s.tangent.cast<float>(), s.group});
    }
    // Fewer samples stand for the same contour: the step grows accordingly.
    if (!samples.empty()) steps_.back() *= float(resolved.contour.size()) / float(samples.size());
    samples_.push_back(std::move(samples));
  }
  for (int i = 0; i < 8; ++i) extent_.push_back(model().bounds.corner(Eigen::AlignedBox3d::CornerType(i)));
  buildLookup();
  buildAnchors();
  buildBoxTurns();
  buildHull();
}

void SearchModel::buildBoxTurns() {
  const Symmetries& symmetries = model().symmetries;
  if (symmetries.sphere) return;
  std::vector<Rigid3> known = symmetries.discrete;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = model().bounds.sizes()[(axis + 1) % 3], b = model().bounds.sizes()[(axis + 2) % 3];
    const bool square = std::abs(a - b) < kSquare * std::max(a, b);
    for (int quarters : {2, 1, 3}) {
      if (quarters != 2 && !square) continue;
      const Eigen::AngleAxisd turn(quarters * M_PI / 2, Eigen::Vector3d::Unit(axis));
      const Rigid3 motion = turnAbout(model().centre(), turn.toRotationMatrix());
      const auto same = [&](const Rigid3& other) {
        return angleBetween(turnedTowards(model(), other, motion).rotation, motion.rotation) < kSameTurn;
      };
      if (std::any_of(known.begin(), known.end(), same)) continue;
      known.push_back(motion);
      box_turns_.push_back(motion);
    }
  }
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
      if (off > widest) widest = off, meridian_ = azimuth(*symmetries.axis, v);
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
        if (cosine > best + 1e-12) best = cosine, lookup_[cell] = {int16_t(k), int16_t(s)};
      }
    }
  }
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
      result = result * turnAbout(model().centre(),
                                  Eigen::Quaterniond::FromTwoVectors(seen.direction, d).toRotationMatrix());
    } else {
      const SymmetryAxis& axis = *symmetries.axis;
      result = result * turnAbout(axis, azimuth(axis, d) - meridian_);
    }
  }
  if (view) {
    int level = 0;
    double best = std::numeric_limits<double>::max();
    const auto& distances = object_->views.distances;
    for (size_t i = 0; i < distances.size(); ++i) {
      const double gap = std::abs(1 / distances[i] - 1 / distance);
      if (gap < best) best = gap, level = int(i);
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

void SearchModel::buildAnchors() {
  const ViewSphere& sphere = object_->views;
  const double diameter = model().diameter;
  const Eigen::Vector3d centre = model().centre();
  for (size_t l = 0; l < sphere.distances.size(); ++l) {
    AnchorLevel level;
    const double ratio = sphere.distances[l] / diameter;
    // Levels meet half way in 1 / ratio, which is what perspective depends on.
    level.min_ratio = l == 0 ? 0.8 * ratio : levels_.back().max_ratio;
    level.max_ratio =
        l + 1 == sphere.distances.size() ? 1e9 : 2 / (1 / ratio + diameter / sphere.distances[l + 1]);
    for (int k = 0; k < sphere.directions; ++k) {
      const int index = int(l) * sphere.directions + k;
      const SampledView& view = sphere.views[index];
      const double step = sampleStepOf(view);
      const FlatView flat = flatten(view, view_rotation_[index], centre, step);
      std::vector<int> visible(model().edges.size(), 0);
      for (int g : flat.group)
        if (g < int(visible.size())) ++visible[g];
      for (size_t e = 0; e < model().edges.size(); ++e) {
        const ModelEdge& edge = model().edges[e];
        const double whole = (edge.q - edge.p).norm();
        if (visible[e] * step < kMinAnchorVisible * whole) continue;
        const auto flatPoint = [&](const Eigen::Vector3d& p) -> Eigen::Vector2d {
          const Eigen::Vector3d c =
              view_rotation_[index] * (p - centre) + Eigen::Vector3d(0, 0, view.distance);
          return c.head<2>() * (view.distance / c.z());
        };
        const Eigen::Vector2d a = flatPoint(edge.p), b = flatPoint(edge.q), ab = b - a;
        if (ab.norm() < kMinAnchorShare * diameter) continue;
        // Samples of other features first, farthest from the ruler first.
        std::vector<double> weight(flat.place.size());
        for (size_t i = 0; i < weight.size(); ++i) {
          const double along = std::clamp((flat.place[i] - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
          weight[i] =
              flat.group[i] == int(e) ? 1e-6 : (flat.place[i] - a - along * ab).norm() + 1e-3 * diameter;
        }
        std::vector<int> order = spreadOrder(flat.place, weight, Anchor::kSamples);
        if (order.empty()) continue;
        const size_t distinct = order.size();
        while (order.size() < size_t(Anchor::kSamples)) order.push_back(order[order.size() % distinct]);
        Anchor anchor;
        anchor.a = a.cast<float>();
        anchor.b = b.cast<float>();
        anchor.length = float(ab.norm());
        anchor.contour = float(flat.length);
        anchor.view = index;
        anchor.centre_x = float(-a.dot(ab) / ab.squaredNorm());
        anchor.centre_y = float((ab.y() * a.x() - ab.x() * a.y()) / ab.squaredNorm());
        for (int i = 0; i < Anchor::kSamples; ++i) {
          const Eigen::Vector2d r = flat.place[order[i]] - a, d = flat.direction[order[i]];
          anchor.x[i] = float(r.dot(ab) / ab.squaredNorm());
          anchor.y[i] = float((ab.x() * r.y() - ab.y() * r.x()) / ab.squaredNorm());
          const double angle = std::atan2(ab.x() * d.y() - ab.y() * d.x(), ab.dot(d));
          anchor.angle[i] = uint8_t(int(std::lround(angle / M_PI * 256.0)) & 255);
        }
        level.anchors.push_back(anchor);
      }
    }
    std::stable_sort(level.anchors.begin(), level.anchors.end(),
                     [](const Anchor& p, const Anchor& q) { return p.length < q.length; });
    levels_.push_back(std::move(level));
  }
}

CoarseScore scorePose(const SearchModel& model, int view, const Rigid3& pose, const Camera& camera,
                      const EvidenceMap& map) {
  const std::vector<ViewSample>& samples = model.samples(view);
  const Eigen::Matrix3f r = pose.rotation.cast<float>();
  const Eigen::Vector3f t = pose.translation.cast<float>();
  const float fx = float(camera.fx), fy = float(camera.fy);
  const float cx = float(camera.cx) - map.u0() + 0.5f, cy = float(camera.cy) - map.v0() + 0.5f;
  float sum = 0, inside = 0, total = 0;
  const int count = int(samples.size());
  CoarseScore score;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f p = r * samples[i].p + t;
    if (p.z() <= 1e-3f) return {-1e6f, 0};
    const Eigen::Vector3f d = r * samples[i].tangent;
    const float w = 1.0f / p.z(), x = p.x() * w, y = p.y() * w;
    const float du = fx * (d.x() - x * d.z()) * w, dv = fy * (d.y() - y * d.z()) * w;
    const float length = std::sqrt(du * du + dv * dv);
    total += length;
    const float u = fx * x + cx, v = fy * y + cy;
    if (u < 0 || v < 0) continue;
    const int8_t value = map.at(orientationBin(du, dv), int(u), int(v));
    if (value == kOutside) continue;
    inside += length;
    sum += length * float(value);
    // Hopeless: on average against the pose after a quarter, not for it after half.
    if (i == count / 4 && sum < -0.6f * kEvidenceUnit * inside) return {-1e6f, 0};
    if (i == count / 2 && sum < -0.1f * kEvidenceUnit * inside) return {-1e6f, 0};
  }
  score.evidence = sum * model.sampleStep(view) / (5.0f * kEvidenceUnit);
  score.in_frame = total > 0 ? inside / total : 0;
  return score;
}

}  // namespace monocular_eye_hand
