#include "model/rounded_circles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "model/rounded_edges.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSquare = 0.999;  // cosine between the plane's normal and the wall's axis
constexpr double kOnCircle =
    1e-3;                         // vertices of a border lie on its circle within this share of the diameter
constexpr double kRound = 0.1;    // a band is as wide as it is high but for this share
constexpr double kWidest = 0.5;   // of a band over the wall's radius
constexpr double kCovered = 0.9;  // of an arc by mesh edges

using Border = std::vector<const MeshEdge*>;
using BorderOfSurface = std::map<int, Border>;

// Of each free-form band: where it joins planes and cylinder walls smoothly.
std::map<int, BorderOfSurface> bordersOfBands(const Topology& topology, const SurfaceSplit& split) {
  std::map<int, BorderOfSurface> borders;
  const auto isBand = [&](int s) { return split.surfaces[size_t(s)].kind == Surface::Kind::kFreeform; };
  for (const SmoothBorder& border : smoothBorders(topology, split)) {
    if (isBand(border.a) && !isBand(border.b)) borders[border.a][border.b].push_back(border.edge);
    if (isBand(border.b) && !isBand(border.a)) borders[border.b][border.a].push_back(border.edge);
  }
  return borders;
}

// The plane and the wall square to it that a band joins, when there is one such pair.
std::optional<std::array<int, 2>> planeAndWall(const BorderOfSurface& borders, const SurfaceSplit& split) {
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [plane_index, plane_border] : borders)
    for (const auto& [wall_index, wall_border] : borders) {
      const Surface &plane = split.surfaces[size_t(plane_index)], &wall = split.surfaces[size_t(wall_index)];
      if (plane.kind != Surface::Kind::kPlane || wall.kind != Surface::Kind::kCylinder) continue;
      if (std::abs(plane.axis.dot(wall.axis)) > kSquare) pairs.push_back({plane_index, wall_index});
    }
  if (pairs.size() != 1) return std::nullopt;
  return pairs.front();
}

// Places about an axis.
class Turned {
 public:
  Turned(const Mesh& mesh, const Eigen::Vector3d& point, const Eigen::Vector3d& axis)
      : mesh_(mesh), point_(point), axis_(axis), x_(axis.unitOrthogonal()), y_(axis.cross(x_)) {}

  /// Distance from the axis, height along it [m].
  Eigen::Vector2d profile(int vertex) const {
    const Eigen::Vector3d d = at(vertex);
    return {(d - axis_ * axis_.dot(d)).norm(), axis_.dot(d)};
  }
  double angle(int vertex) const { return std::atan2(y_.dot(at(vertex)), x_.dot(at(vertex))); }
  Eigen::Vector3d radial(double angle) const { return std::cos(angle) * x_ + std::sin(angle) * y_; }

  /// The circle about the axis that the border lies on, as a place in the profile.
  std::optional<Eigen::Vector2d> circleOf(const Border& border, double tolerance) const {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const MeshEdge* e : border) mean += (profile(e->a) + profile(e->b)) / (2 * double(border.size()));
    for (const MeshEdge* e : border)
      if (std::max((profile(e->a) - mean).norm(), (profile(e->b) - mean).norm()) > tolerance)
        return std::nullopt;
    return mean;
  }

 private:
  Eigen::Vector3d at(int vertex) const { return mesh_.vertices[size_t(vertex)] - point_; }

  const Mesh& mesh_;
  Eigen::Vector3d point_, axis_, x_, y_;
};

// How far round a border goes [rad].
struct Extent {
  double start = 0, sweep = 0;
  double covered = 0;  // by mesh edges
  double segment = 0;  // the longest of them
};
Extent extentOf(const Border& border, const Turned& turned) {
  Extent extent;
  std::vector<double> angles;
  for (const MeshEdge* e : border) {
    const double from = turned.angle(e->a), to = turned.angle(e->b);
    const double turn = std::abs(std::remainder(to - from, 2 * M_PI));
    extent.covered += turn;
    extent.segment = std::max(extent.segment, turn);
    angles.insert(angles.end(), {from, to});
  }

  std::sort(angles.begin(), angles.end());
  extent.start = angles.front();
  double gap = angles.front() + 2 * M_PI - angles.back();
  for (size_t i = 1; i < angles.size(); ++i) {
    if (angles[i] - angles[i - 1] <= gap) continue;
    gap = angles[i] - angles[i - 1];
    extent.start = angles[i];
  }
  extent.sweep = extent.covered > 2 * M_PI - 0.01 ? 2 * M_PI : 2 * M_PI - gap;
  return extent;
}

bool isArc(const Extent& extent) {
  return extent.segment < kLargestSegment && extent.sweep > kSmallestSweep &&
         extent.covered > kCovered * extent.sweep;
}

std::optional<ModelCircle> middleOf(const Mesh& mesh, const SurfaceSplit& split,
                                    const BorderOfSurface& borders, const std::array<int, 2>& surfaces,
                                    double tolerance) {
  const Surface &plane = split.surfaces[size_t(surfaces[0])], &wall = split.surfaces[size_t(surfaces[1])];
  const Border& plane_border = borders.at(surfaces[0]);
  const Turned turned(mesh, wall.point, plane.axis);
  const auto on_plane = turned.circleOf(plane_border, tolerance);
  const auto on_wall = turned.circleOf(borders.at(surfaces[1]), tolerance);
  if (!on_plane || !on_wall) return std::nullopt;

  const double width = std::abs(on_plane->x() - on_wall->x()),
               height = std::abs(on_plane->y() - on_wall->y());
  if (std::abs(width - height) > kRound * std::max(width, height)) return std::nullopt;
  if (width > kWidest * wall.radius) return std::nullopt;
  const Extent extent = extentOf(plane_border, turned);
  if (!isArc(extent)) return std::nullopt;

  ModelCircle circle;
  const bool plane_inside = on_plane->x() < on_wall->x();
  circle.surface = surfaces;
  circle.normal = {Eigen::Vector2d(0, 1), Eigen::Vector2d(wall.convex ? 1 : -1, 0)};
  circle.dihedral = M_PI / 2;
  circle.convex = plane_inside == wall.convex;
  circle.left = plane_inside;
  circle.rounding = 0.5 * (width + height);
  circle.axis = plane.axis;
  circle.x_axis = turned.radial(extent.start);
  circle.sweep = extent.sweep;
  circle.segment = extent.segment;

  // The band's centre line lies a radius behind both surfaces, before them where it is concave.
  const double behind = circle.convex ? circle.rounding : -circle.rounding;
  const Eigen::Vector2d centre(on_wall->x() - behind * circle.normal[1].x(), on_plane->y() - behind);
  const Eigen::Vector2d middle = centre + behind * (circle.normal[0] + circle.normal[1]).normalized();
  circle.radius = middle.x();
  circle.centre = wall.point + plane.axis * middle.y();
  return circle;
}

}  // namespace

std::vector<ModelCircle> findRoundedCircles(const Mesh& mesh, const Topology& topology,
                                            const SurfaceSplit& split, double diameter) {
  std::vector<ModelCircle> found;
  for (const auto& [band, borders] : bordersOfBands(topology, split)) {
    const auto surfaces = planeAndWall(borders, split);
    if (!surfaces) continue;
    const auto circle = middleOf(mesh, split, borders, *surfaces, kOnCircle * diameter);
    if (circle && circle->dihedral * circle->rounding < kWidestRound * diameter) found.push_back(*circle);
  }
  return found;
}

}  // namespace monocular_eye_hand
