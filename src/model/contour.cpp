#include "monocular_eye_hand/model/contour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/contour_index.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/ray_scene.h"

namespace monocular_eye_hand {
namespace {

/// Positions along a feature: one step apart, the rest shared by both ends; at least one.
struct Steps {
  int count;
  double first, step;
  Steps(double length, double wanted)
      : count(std::max(1, int(std::lround(length / wanted)))),
        first(0.5 * (length - (count - 1) * wanted)),
        step(wanted) {}
  /// A closed line has no ends: the rest is shared by all steps.
  static Steps closed(double length, double wanted) {
    Steps s(length, wanted);
    s.step = length / s.count;
    s.first = 0.5 * s.step;
    return s;
  }
  double at(int k) const { return first + k * step; }
};

class View {
 public:
  View(const ObjectModel& model, const Eigen::Vector3d& eye, const ContourOptions& options)
      : model_(model), index_(*model.contour_index), eye_(eye), options_(options) {}

  std::vector<ContourSample> contour() {
    out_.reserve(256);
    for (size_t e = 0; e < model_.edges.size(); ++e) addEdge(int(e));
    for (size_t c = 0; c < model_.circles.size(); ++c) addCircle(int(c));
    for (const CylinderWall& wall : index_.walls) addWall(wall);
    for (const FreeformPatch& patch : index_.patches) {
      for (const Polyline& line : silhouetteLines(patch, eye_)) addPolyline(patch, line);
    }
    return std::move(out_);
  }

 private:
  /// How a crease between two surfaces looks from the eye.
  struct Crease {
    bool shown = false;
    bool silhouette = false;
    Eigen::Vector3d away;    ///< unit, out of the material: where visibility rays start
    Eigen::Vector3d inside;  ///< into the surface that faces the eye, along it
  };

  /// `t` runs with surface 0 on its left.
  Crease judge(const Eigen::Vector3d& p, const Eigen::Vector3d& t, const Eigen::Vector3d& n0,
               const Eigen::Vector3d& n1, bool rim, bool convex, double dihedral) const {
    Crease c;
    const Eigen::Vector3d view = eye_ - p;
    if (rim) {
      c.shown = c.silhouette = true;
      c.inside = n0.cross(t);
      c.away = (n0.dot(view) > 0 ? n0 : Eigen::Vector3d(-n0)) - c.inside;
      c.away.normalize();
      return c;
    }

    const bool front0 = n0.dot(view) > 0, front1 = n1.dot(view) > 0;
    c.silhouette = front0 != front1;
    // A concave edge can only be seen between its two surfaces.
    c.shown = convex ? (front0 || front1) && (c.silhouette || dihedral >= options_.min_dihedral)
                     : front0 && front1 && dihedral >= options_.min_dihedral;
    c.silhouette = c.silhouette && convex;

    c.away = n0 + n1;
    const double norm = c.away.norm();
    c.away = norm > 1e-3 ? Eigen::Vector3d(c.away / norm) : (front0 ? n0 : n1);
    c.inside = front0 ? n0.cross(t) : t.cross(n1);
    return c;
  }

  /// Whether both surfaces that a fillet or a round joins face the eye; p: on its middle. Beside one that
  /// turns away it has a silhouette, which is found with the surface's own.
  bool facesBoth(const Eigen::Vector3d& p, const Eigen::Vector3d& n0, const Eigen::Vector3d& n1,
                 double rounding, bool convex) const {
    const double radius = convex ? rounding : -rounding;
    const Eigen::Vector3d view = eye_ - (p - radius * (n0 + n1).normalized());
    return n0.dot(view) > radius && n1.dot(view) > radius;
  }

  bool visible(const Eigen::Vector3d& start) const { return !model_.rays->occluded(start, eye_); }

  void push(const Eigen::Vector3d& p, const Eigen::Vector3d& t, int feature, bool silhouette,
            const Eigen::Vector3d& inside) {
    ContourSample s;
    s.p = p;
    s.tangent = t;
    s.feature = feature;
    s.silhouette = silhouette;
    if (silhouette) s.inner_side = t.cross(p - eye_).dot(inside) > 0 ? 1 : -1;
    out_.push_back(s);
  }

  void addEdge(int e) {
    const ModelEdge& edge = model_.edges[e];
    const double length = (edge.q - edge.p).norm();
    const Eigen::Vector3d t = (edge.q - edge.p) / length;
    // The two planes contain the whole edge: one judgement holds for all of it.
    const Crease c =
        judge(edge.p, t, edge.normal[0], edge.normal[1], edge.surface[1] < 0, edge.convex, edge.dihedral);
    if (!c.shown) return;
    const bool rounded = edge.rounding > 0;
    if (rounded && !facesBoth(edge.p, edge.normal[0], edge.normal[1], edge.rounding, edge.convex)) return;
    const Steps steps(length, options_.step);
    const Eigen::Vector3d away = std::min(index_.start, 0.25 * length) * c.away;
    for (int k = 0; k < steps.count; ++k) {
      const Eigen::Vector3d p = edge.p + t * steps.at(k);
      if (visible(p + away)) push(p, t, model_.featureOfEdge(e), c.silhouette, c.inside);
    }
  }

  void addCircle(int index) {
    const ModelCircle& circle = model_.circles[index];
    const Eigen::Vector3d y_axis = circle.axis.cross(circle.x_axis);
    const double length = circle.length();
    const Steps steps = circle.full() ? Steps::closed(length, options_.step) : Steps(length, options_.step);

    const Eigen::Vector2d &m0 = circle.normal[0], &m1 = circle.normal[1];
    // A hole's true rim lies in the material of the tessellated model: rays start where the mesh's chords
    // are.
    const bool hole = m0.x() + m1.x() < 0;
    const double shrink = hole ? circle.radius * (1 - std::cos(0.5 * circle.segment)) : 0;
    const double start = std::min(index_.start, 0.25 * circle.radius);

    for (int k = 0; k < steps.count; ++k) {
      const double angle = circle.start + steps.at(k) / circle.radius;
      const double cosine = std::cos(angle), sine = std::sin(angle);
      const Eigen::Vector3d radial = cosine * circle.x_axis + sine * y_axis;
      const Eigen::Vector3d t = -sine * circle.x_axis + cosine * y_axis;
      const Eigen::Vector3d p = circle.centre + circle.radius * radial;
      const Eigen::Vector3d n0 = m0.x() * radial + m0.y() * circle.axis;
      const Eigen::Vector3d n1 = m1.x() * radial + m1.y() * circle.axis;

      const bool rim = circle.surface[1] < 0;
      const Crease c =
          judge(p, circle.left ? t : Eigen::Vector3d(-t), n0, n1, rim, circle.convex, circle.dihedral);
      if (!c.shown) continue;
      if (circle.rounding > 0 && !facesBoth(p, n0, n1, circle.rounding, circle.convex)) continue;
      if (visible(p - shrink * radial + start * c.away)) {
        push(p, t, model_.featureOfCircle(index), c.silhouette, c.inside);
      }
    }
  }

  void addWall(const CylinderWall& wall) {
    const Eigen::Vector3d d = eye_ - wall.point;
    const double x = d.dot(wall.x), y = d.dot(wall.y), distance = std::hypot(x, y);
    if (distance <= wall.radius) return;

    const double middle = std::atan2(y, x), half = std::acos(wall.radius / distance);
    for (const double side : {-1.0, 1.0}) {
      double angle = middle + side * half;
      if (angle > M_PI) angle -= 2 * M_PI;
      if (angle < -M_PI) angle += 2 * M_PI;
      wall.cover(angle, &intervals_);

      const Eigen::Vector3d radial = std::cos(angle) * wall.x + std::sin(angle) * wall.y;
      for (const HeightRange& i : intervals_) {
        const Steps steps(i.high - i.low, options_.step);
        for (int k = 0; k < steps.count; ++k) {
          const Eigen::Vector3d p = wall.point + wall.radius * radial + (i.low + steps.at(k)) * wall.axis;
          if (visible(p + std::min(wall.start, 0.25 * wall.radius) * radial)) {
            push(p, wall.axis, wall.feature, true, -radial);
          }
        }
      }
    }
  }

  void addPolyline(const FreeformPatch& patch, const Polyline& line) {
    double length = 0;
    for (size_t k = 1; k < line.points.size(); ++k) length += (line.points[k] - line.points[k - 1]).norm();
    if (!(length > 0)) return;

    const Steps steps(length, options_.step);
    double walked = 0;
    size_t piece = 0;
    for (int k = 0; k < steps.count; ++k) {
      double size = (line.points[piece + 1] - line.points[piece]).norm();
      while (walked + size < steps.at(k) && piece + 2 < line.points.size()) {
        walked += size;
        ++piece;
        size = (line.points[piece + 1] - line.points[piece]).norm();
      }

      const double share = size > 0 ? std::clamp((steps.at(k) - walked) / size, 0.0, 1.0) : 0;
      const Eigen::Vector3d p = line.points[piece] + share * (line.points[piece + 1] - line.points[piece]);
      const Eigen::Vector3d n =
          (line.normals[piece] + share * (line.normals[piece + 1] - line.normals[piece]));

      // The direction over about one step: single triangles make it jitter.
      size_t before = piece, after = piece + 1;
      while (before > 0 && (line.points[before] - p).norm() < 0.5 * options_.step) --before;
      while (after + 1 < line.points.size() && (line.points[after] - p).norm() < 0.5 * options_.step) ++after;
      const Eigen::Vector3d chord = line.points[after] - line.points[before];
      if (!(chord.norm() > 0)) continue;
      if (visible(p + patch.start * n.normalized())) push(p, chord.normalized(), patch.feature, true, -n);
    }
  }

  const ObjectModel& model_;
  const ContourIndex& index_;
  const Eigen::Vector3d eye_;
  const ContourOptions& options_;
  std::vector<HeightRange> intervals_;
  std::vector<ContourSample> out_;
};

}  // namespace

void ContourOptions::check() const {
  if (!(step > 0) || !std::isfinite(step)) {
    throw BadInput(fmt::format("ContourOptions.step is {:g}; it must be a positive length [m]", step));
  }
  if (!(min_dihedral >= 0) || min_dihedral > 3.15) {
    throw BadInput(
        fmt::format("ContourOptions.min_dihedral is {:g}; it must be 0 to pi [rad]", min_dihedral));
  }
}

std::vector<ContourSample> visibleContour(const ObjectModel& model, const Eigen::Vector3d& eye_in_object,
                                          const ContourOptions& options) {
  options.check();
  if (!model.contour_index || !model.rays) {
    throw BadInput("visibleContour needs a model made by buildModel; this one has no ray scene");
  }
  return View(model, eye_in_object, options).contour();
}

}  // namespace monocular_eye_hand
