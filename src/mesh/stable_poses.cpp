#include "monocular_eye_hand/mesh/stable_poses.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/convex_hull.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/random.h"

namespace monocular_eye_hand {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points distinctVertices(const Mesh& mesh) {
  Points points;
  for (const auto& triangle : mesh.triangles)
    for (int v : triangle) points.push_back(mesh.vertices[v]);
  const auto before = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

// Of a fine mesh only the points that are extreme in some direction matter.
Points extremePoints(const Points& points, size_t max_points) {
  if (points.size() <= max_points) return points;
  std::vector<bool> keep(points.size(), false);
  for (size_t k = 0; k < max_points; ++k) {
    const double z = 1 - 2 * (k + 0.5) / max_points, angle = k * M_PI * (3 - std::sqrt(5.0)),
                 r = std::sqrt(1 - z * z);
    const Eigen::Vector3d d(r * std::cos(angle), r * std::sin(angle), z);
    size_t best = 0;
    for (size_t i = 1; i < points.size(); ++i)
      if (points[i].dot(d) > points[best].dot(d)) best = i;
    keep[best] = true;
  }
  Points out;
  for (size_t i = 0; i < points.size(); ++i)
    if (keep[i]) out.push_back(points[i]);
  return out;
}

Eigen::Vector3d centreOfMass(const Mesh& mesh, const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / double(points.size());
  double volume = 0, absolute = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - mean, b = mesh.vertices[t[1]] - mean,
                          c = mesh.vertices[t[2]] - mean;
    const double v = a.dot(b.cross(c)) / 6;
    volume += v;
    absolute += std::abs(v);
    moment += v * (a + b + c) / 4;
  }
  // An open mesh has no inside: take the middle of its vertices.
  return std::abs(volume) > 1e-3 * absolute ? Eigen::Vector3d(mean + moment / volume) : mean;
}

// Distance of a point inside a convex counter-clockwise polygon from its border; negative outside.
double insideBy(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  double min_distance = polygon.size() >= 3 ? 1e300 : -1;
  for (size_t k = 0; k < polygon.size() && polygon.size() >= 3; ++k) {
    const Eigen::Vector2d& a = polygon[k];
    const Eigen::Vector2d e = polygon[(k + 1) % polygon.size()] - a;
    min_distance = std::min(min_distance, (e.x() * (p.y() - a.y()) - e.y() * (p.x() - a.x())) / e.norm());
  }
  return min_distance;
}

Eigen::Matrix3d scatterOf(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / double(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) scatter += (p - mean) * (p - mean).transpose();
  return scatter;
}

bool flat(const Points& points, double thickness) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatterOf(points), Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] < thickness * thickness;
}

// The plane through the points that are lowest along `down`, refined until it rests on exactly those.
Eigen::Vector3d settle(const Points& points, Eigen::Vector3d down, double thickness) {
  for (int pass = 0; pass < 3; ++pass) {
    double lowest = -1e300;
    for (const Eigen::Vector3d& p : points) lowest = std::max(lowest, p.dot(down));
    Points support;
    for (const Eigen::Vector3d& p : points)
      if (p.dot(down) > lowest - thickness) support.push_back(p);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatterOf(support));
    if (solver.eigenvalues()[1] < thickness * thickness)
      return down;  // a line or a point: no plane of its own
    const Eigen::Vector3d normal = solver.eigenvectors().col(0);
    down = normal.dot(down) < 0 ? Eigen::Vector3d(-normal) : normal;
  }
  return down;
}

}  // namespace

Eigen::Vector3d centreOfMass(const Mesh& mesh) {
  const Points points = distinctVertices(mesh);
  if (points.empty()) throw BadInput("centre of mass: the mesh is empty");
  return centreOfMass(mesh, points);
}

std::vector<StablePose> stablePoses(const Mesh& mesh) {
  const Points all = distinctVertices(mesh);
  if (all.size() < 4) throw BadInput("stable poses: the mesh is empty or flat");

  const Points points = extremePoints(all, 4000);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  const double size = box.diagonal().norm();
  if (flat(points, 1e-4 * size)) throw BadInput("stable poses: the mesh is flat");

  // CAD faces put many points in one plane: a tiny seeded shake brings them into general position.
  Points shaken = points;
  Generator random(1);
  for (Eigen::Vector3d& p : shaken)
    for (int k = 0; k < 3; ++k) p[k] += random.uniform(-1e-5, 1e-5) * size;

  const std::vector<Eigen::Vector3d> normals = hullNormals(shaken);
  const Eigen::Vector3d com = centreOfMass(mesh, all);
  std::vector<StablePose> poses;
  Points downs;
  double sum = 0;
  for (const Eigen::Vector3d& normal : normals) {
    const double thickness = 1e-4 * size;
    const Eigen::Vector3d down = settle(points, normal, thickness);
    if (std::any_of(downs.begin(), downs.end(),
                    [&](const Eigen::Vector3d& d) { return d.dot(down) > 0.99985; }))
      continue;

    const Eigen::Matrix3d rotation =
        Eigen::Quaterniond::FromTwoVectors(down, -Eigen::Vector3d::UnitZ()).toRotationMatrix();
    double lowest = 1e300;
    for (const Eigen::Vector3d& p : points) lowest = std::min(lowest, (rotation * p).z());

    std::vector<Eigen::Vector2d> support;
    for (const Eigen::Vector3d& p : points)
      if ((rotation * p).z() < lowest + 2 * thickness) support.push_back((rotation * p).head<2>());
    const Eigen::Vector3d centre = rotation * com;
    const double margin = insideBy(planarHull(support), centre.head<2>());
    if (margin < 1e-3 * size) continue;

    downs.push_back(down);
    const double weight = std::atan2(margin, centre.z() - lowest);  // angle to topple
    poses.push_back({{rotation, {-centre.x(), -centre.y(), -lowest}}, weight});
    sum += weight;
  }

  if (poses.empty()) throw BadInput("stable poses: the mesh is flat");
  for (StablePose& pose : poses) pose.weight /= sum;
  std::stable_sort(poses.begin(), poses.end(),
                   [](const StablePose& a, const StablePose& b) { return a.weight > b.weight; });
  return poses;
}

}  // namespace monocular_eye_hand
