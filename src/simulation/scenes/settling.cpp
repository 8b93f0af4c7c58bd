#include "simulation/scenes/settling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/mesh/stable_poses.h"

namespace monocular_eye_hand {
namespace {

constexpr double kGrid = 0.001;  // of the height maps [m]
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Heights of a surface on the grid cells of a rectangle; NaN where it is not.
struct HeightMap {
  cv::Rect cells;
  cv::Mat1f z;
  float at(const cv::Point& cell) const { return cells.contains(cell) ? z(cell - cells.tl()) : kNone; }
};

/// Lowest (upper = false) or highest point of the object over each cell.
HeightMap heightMap(const SceneObject& object, bool upper) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : object.mesh->vertices) points.push_back(object.world_from_object * p);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);

  const auto cell = [](double x) { return int(std::floor(x / kGrid)); };
  const cv::Point low(cell(box.min().x()) - 1, cell(box.min().y()) - 1);
  const cv::Point high(cell(box.max().x()) + 2, cell(box.max().y()) + 2);
  HeightMap map{cv::Rect(low, high), {}};
  map.z = cv::Mat1f(map.cells.size(), kNone);

  for (const auto& t : object.mesh->triangles) {
    const Eigen::Vector3d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const Eigen::Vector2d u = (b - a).head<2>(), v = (c - a).head<2>();
    const double cross = u.x() * v.y() - u.y() * v.x();
    if (std::abs(cross) < 1e-12) continue;  // stands upright
    const Eigen::Vector3d corner_low = a.cwiseMin(b).cwiseMin(c), corner_high = a.cwiseMax(b).cwiseMax(c);
    for (int y = cell(corner_low.y()); y <= cell(corner_high.y()); ++y)
      for (int x = cell(corner_low.x()); x <= cell(corner_high.x()); ++x) {
        const Eigen::Vector2d d = Eigen::Vector2d((x + 0.5) * kGrid, (y + 0.5) * kGrid) - a.head<2>();
        const double s = (d.x() * v.y() - d.y() * v.x()) / cross, r = (u.x() * d.y() - u.y() * d.x()) / cross;
        if (s < 0 || r < 0 || s + r > 1) continue;
        const float z = float(a.z() + s * (b.z() - a.z()) + r * (c.z() - a.z()));
        float& known = map.z(cv::Point(x, y) - low);
        if (std::isnan(known) || (upper ? z > known : z < known)) known = z;
      }
  }
  return map;
}

/// How far the underside can sink before it meets the other's upper side; infinite when they are side by
/// side.
double clearance(const HeightMap& underside, const HeightMap& upper) {
  constexpr double kThrough = 0.005;  // deeper below it than this, it is not on top of it
  double min_gap = std::numeric_limits<double>::infinity();
  const cv::Rect both = underside.cells & upper.cells;
  for (int y = both.y; y < both.y + both.height; ++y)
    for (int x = both.x; x < both.x + both.width; ++x) {
      const double gap = underside.at({x, y}) - upper.at({x, y});
      if (gap > -kThrough) min_gap = std::min(min_gap, gap);  // false for NaN
    }
  return min_gap;
}

/// Turned about the centre of mass into the nearest stable pose.
Rigid3 tipped(const Mesh& mesh, const Rigid3& world_from_object, Eigen::Vector3d* centre) {
  const std::vector<StablePose> poses = stablePoses(mesh);
  const Eigen::Vector3d down = world_from_object.rotation.transpose() * -Eigen::Vector3d::UnitZ();
  const StablePose* best = &poses.front();
  double nearest = -2;
  for (const StablePose& pose : poses) {
    const double cosine = down.dot(pose.table_from_object.rotation.transpose() * -Eigen::Vector3d::UnitZ());
    if (cosine > nearest + 1e-9) {
      nearest = cosine;
      best = &pose;
    }
  }

  const Eigen::Vector3d best_down = best->table_from_object.rotation.transpose() * -Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d pivot = centreOfMass(mesh);
  *centre = world_from_object * pivot;
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(world_from_object.rotation * best_down, -Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  const Eigen::Matrix3d rotation = turn * world_from_object.rotation;
  return {rotation, *centre - rotation * pivot};
}

double lowestPoint(const SceneObject& object) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& t : object.mesh->triangles)
    for (int v : t)
      lowest = std::min(lowest, (object.world_from_object * object.mesh->vertices[size_t(v)]).z());
  return lowest;
}

}  // namespace

double dropHeight(const SceneObject& object, const std::vector<const SceneObject*>& others) {
  const HeightMap underside = heightMap(object, false);
  double drop = lowestPoint(object);
  for (const SceneObject* other : others)
    drop = std::min(drop, clearance(underside, heightMap(*other, true)));
  return drop;
}

Rest settle(const SceneObject& object, const std::vector<const SceneObject*>& others, const Table& table,
            double floor_z) {
  SceneObject resting = object;
  Eigen::Vector3d centre;
  resting.world_from_object = tipped(*object.mesh, object.world_from_object, &centre);

  const HeightMap underside = heightMap(resting, false);
  const double lowest = lowestPoint(resting);
  const bool over_table = table.present && std::abs(centre.x()) <= table.half_width &&
                          std::abs(centre.y()) <= table.half_depth && centre.z() > 0;

  Rest rest;
  rest.on = over_table ? kOnTable : kOnFloor;
  double drop = lowest - (over_table ? 0 : floor_z);
  for (size_t k = 0; k < others.size(); ++k) {
    if (!others[k]) continue;
    const double gap = clearance(underside, heightMap(*others[k], true));
    if (gap < drop) {
      drop = gap;
      rest.on = int(k);
    }
  }

  rest.world_from_object = resting.world_from_object;
  rest.world_from_object.translation.z() -= drop;
  return rest;
}

}  // namespace monocular_eye_hand
