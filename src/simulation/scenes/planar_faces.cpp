#include "simulation/scenes/planar_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace monocular_eye_hand {
namespace {

constexpr double kFlatCosine = 0.9999;  // of two triangles' normals: below 0.8 degrees
constexpr double kFlatShare = 0.005;    // a face's points stay this near its plane, as a share of its width

struct SharedEdge {
  int a, b;  // triangles
  Eigen::Vector3d p, q;
};

Eigen::Vector3d areaVector(const Mesh& mesh, const std::array<int, 3>& t) {
  const Eigen::Vector3d& a = mesh.vertices[size_t(t[0])];
  return 0.5 * (mesh.vertices[size_t(t[1])] - a).cross(mesh.vertices[size_t(t[2])] - a);
}

std::vector<SharedEdge> sharedEdges(const Mesh& mesh) {
  using Position = std::array<double, 3>;
  std::map<std::pair<Position, Position>, int> open;
  std::vector<SharedEdge> out;

  for (size_t k = 0; k < mesh.triangles.size(); ++k)
    for (size_t side = 0; side < 3; ++side) {
      const Eigen::Vector3d& p = mesh.vertices[size_t(mesh.triangles[k][side])];
      const Eigen::Vector3d& q = mesh.vertices[size_t(mesh.triangles[k][(side + 1) % 3])];
      const Position from{p.x(), p.y(), p.z()}, to{q.x(), q.y(), q.z()};
      const auto key = std::minmax(from, to);

      const auto found = open.find(key);
      if (found == open.end()) {
        open[key] = int(k);
        continue;
      }
      out.push_back({found->second, int(k), p, q});
      open.erase(found);
    }
  return out;
}

/// Triangles in groups that lie in one plane.
class Groups {
 public:
  explicit Groups(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int k) {
    while (parent_[size_t(k)] != k) k = parent_[size_t(k)] = parent_[size_t(parent_[size_t(k)])];
    return k;
  }
  void join(int a, int b) { parent_[size_t(find(a))] = find(b); }

 private:
  std::vector<int> parent_;
};

PlanarFace faceOf(const Mesh& mesh, const std::vector<int>& triangles) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int k : triangles) sum += areaVector(mesh, mesh.triangles[size_t(k)]);
  PlanarFace face;
  face.area = sum.norm();
  const Eigen::Vector3d z = sum.normalized(), x = z.unitOrthogonal(), y = z.cross(x);
  const Eigen::Vector3d origin = mesh.vertices[size_t(mesh.triangles[size_t(triangles[0])][0])];

  std::vector<cv::Point2f> flat;  // in mm: the smallest rectangle is sought in single precision
  double deviation = 0;
  for (const int k : triangles)
    for (const int v : mesh.triangles[size_t(k)]) {
      const Eigen::Vector3d d = mesh.vertices[size_t(v)] - origin;
      flat.emplace_back(float(1000 * d.dot(x)), float(1000 * d.dot(y)));
      deviation = std::max(deviation, std::abs(d.dot(z)));
    }
  const cv::RotatedRect box = cv::minAreaRect(flat);
  double angle = box.angle * M_PI / 180;
  face.width = box.size.width / 1000;
  face.height = box.size.height / 1000;
  if (face.height > face.width) {
    std::swap(face.width, face.height);
    angle += M_PI / 2;
  }
  if (deviation > kFlatShare * face.width) face.area = 0;

  const Eigen::Vector3d along = std::cos(angle) * x + std::sin(angle) * y;
  face.object_from_face.rotation << along, z.cross(along), z;
  face.object_from_face.translation = origin + 0.001 * (box.center.x * x + box.center.y * y);
  return face;
}

FaceFold foldOver(const PlanarFace& from, const PlanarFace& to, const SharedEdge& edge) {
  FaceFold fold;
  fold.middle = 0.5 * (edge.p + edge.q);
  const Eigen::Vector3d n = from.object_from_face.rotation.col(2), m = to.object_from_face.rotation.col(2);
  fold.turn.rotation = Eigen::Quaterniond::FromTwoVectors(n, m).toRotationMatrix();
  fold.turn.translation = edge.p - fold.turn.rotation * edge.p;
  return fold;
}

}  // namespace

PlanarFaces planarFaces(const Mesh& mesh, double min_share, size_t max_faces) {
  std::vector<Eigen::Vector3d> normals;
  double surface = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d area = areaVector(mesh, t);
    surface += area.norm();
    normals.push_back(area.normalized());
  }
  const std::vector<SharedEdge> edges = sharedEdges(mesh);
  Groups groups(mesh.triangles.size());
  for (const SharedEdge& edge : edges)
    if (normals[size_t(edge.a)].dot(normals[size_t(edge.b)]) > kFlatCosine) groups.join(edge.a, edge.b);

  std::map<int, std::vector<int>> members;
  for (size_t k = 0; k < mesh.triangles.size(); ++k) members[groups.find(int(k))].push_back(int(k));
  std::vector<std::pair<PlanarFace, int>> found;
  for (const auto& group : members) {
    const PlanarFace face = faceOf(mesh, group.second);
    if (face.area > min_share * surface) found.emplace_back(face, group.first);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first.area > b.first.area; });
  if (found.size() > max_faces) found.resize(max_faces);

  PlanarFaces out;
  std::map<int, int> face_of_group;
  for (size_t k = 0; k < found.size(); ++k) {
    out.faces.push_back(found[k].first);
    face_of_group[found[k].second] = int(k);
  }
  std::map<std::pair<int, int>, SharedEdge> longest;
  for (const SharedEdge& edge : edges) {
    const auto a = face_of_group.find(groups.find(edge.a)), b = face_of_group.find(groups.find(edge.b));
    if (a == face_of_group.end() || b == face_of_group.end() || a == b) continue;
    const auto key = std::make_pair(a->second, b->second);
    const auto known = longest.find(key);
    if (known == longest.end() || (edge.p - edge.q).norm() > (known->second.p - known->second.q).norm())
      longest[key] = edge;
  }
  for (const auto& [pair, edge] : longest) {
    const PlanarFace &a = out.faces[size_t(pair.first)], &b = out.faces[size_t(pair.second)];
    FaceFold there = foldOver(a, b, edge), back = foldOver(b, a, edge);
    there.from = back.to = pair.first;
    there.to = back.from = pair.second;
    out.folds.push_back(there);
    out.folds.push_back(back);
  }
  return out;
}

}  // namespace monocular_eye_hand
