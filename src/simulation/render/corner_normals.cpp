#include "simulation/render/corner_normals.h"

#include <Eigen/Geometry>
#include <array>
#include <map>

namespace monocular_eye_hand {
namespace {

constexpr double kSmoothCosine =
    0.94;  // triangles that meet below 20 degrees are shaded as one curved surface

Eigen::Vector3d areaNormal(const Mesh& mesh, const std::array<int, 3>& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

}  // namespace

std::vector<Eigen::Vector3f> cornerNormals(const Mesh& mesh, const Eigen::Matrix3d& rotation) {
  // By position, not by index: a mesh that is not welded is smoothed all the same.
  std::map<std::array<double, 3>, std::vector<int>> around;
  const auto key = [&](int v) {
    const Eigen::Vector3d& p = mesh.vertices[v];
    return std::array<double, 3>{p.x(), p.y(), p.z()};
  };
  for (size_t k = 0; k < mesh.triangles.size(); ++k)
    for (int v : mesh.triangles[k]) around[key(v)].push_back(int(k));

  std::vector<Eigen::Vector3f> normals;
  normals.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d own = areaNormal(mesh, triangle).normalized();
    for (int v : triangle) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int other : around[key(v)]) {
        const Eigen::Vector3d n = areaNormal(mesh, mesh.triangles[other]);
        if (n.normalized().dot(own) > kSmoothCosine) sum += n;
      }
      const Eigen::Vector3d n = sum.norm() > 0 ? sum.normalized() : own;
      normals.push_back((rotation * n).cast<float>());
    }
  }
  return normals;
}

}  // namespace monocular_eye_hand
