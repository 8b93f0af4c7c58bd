#pragma once
#include <cmath>
#include <random>
#include <vector>

#include "grouping/segment_ends.h"
#include "monocular_eye_hand/grouping/grouping.h"

// Models and features made by hand, so that these tests depend on no other room's algorithms.
namespace monocular_eye_hand::hand_made {

inline Camera camera() { return {640, 480, 600, 600, 320, 240, DistortionModel::kNone, {}}; }

inline int addSegment(FeatureSet* f, Eigen::Vector2d p, Eigen::Vector2d q) {
  LineSegment s;
  s.p = p;
  s.q = q;
  s.sigma_offset = 0.05;
  s.sigma_angle = 0.1 / (q - p).norm();
  s.sigma_p = s.sigma_q = 0.5;
  s.contrast = 30;
  f->segments.push_back(s);
  return int(f->segments.size()) - 1;
}

inline int addEllipse(FeatureSet* f, Eigen::Vector2d centre, double a, double b, double angle,
                      double coverage = 0.9) {
  DetectedEllipse e;
  e.ellipse.centre = centre;
  e.ellipse.a = a;
  e.ellipse.b = b;
  e.ellipse.angle = angle;
  e.covariance = 0.01 * Eigen::Matrix<double, 5, 5>::Identity();
  e.coverage = coverage;
  e.rms = 0.2;
  f->ellipses.push_back(e);
  return int(f->ellipses.size()) - 1;
}

inline FeatureSet empty() {
  FeatureSet f;
  f.camera = camera();
  return f;
}

/// The proper rotations of a cube that map a box of these half sizes to itself.
inline std::vector<Rigid3> boxRotations(const Eigen::Vector3d& half) {
  std::vector<Rigid3> result{Rigid3{}};
  const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (const auto& p : order)
    for (int signs = 0; signs < 8; ++signs) {
      Rigid3 motion;
      motion.rotation.setZero();
      for (int i = 0; i < 3; ++i) motion.rotation(i, p[i]) = (signs >> i) & 1 ? -1 : 1;
      if (motion.rotation.determinant() < 0 || motion.rotation.isIdentity()) continue;
      if (((motion.rotation * half).cwiseAbs() - half).norm() < 1e-9) result.push_back(motion);
    }
  return result;
}

/// A box about the origin; `symmetric` = false leaves its symmetries out.
inline ObjectModel box(const Eigen::Vector3d& half, bool symmetric = true) {
  ObjectModel m;
  m.name = "box";
  for (int axis = 0; axis < 3; ++axis)
    for (int sign : {1, -1}) {
      Surface s;
      s.kind = Surface::Kind::kPlane;
      s.axis = sign * Eigen::Vector3d::Unit(axis);
      s.point = half[axis] * s.axis;
      m.surfaces.push_back(s);  // surface 2 * axis + (sign < 0)
    }

  const auto corner = [&](int bits) {
    return Eigen::Vector3d((bits & 1 ? -1 : 1) * half.x(), (bits & 2 ? -1 : 1) * half.y(),
                           (bits & 4 ? -1 : 1) * half.z());
  };
  m.corners.resize(8);
  for (int bits = 0; bits < 8; ++bits) m.corners[bits].p = corner(bits);

  for (int axis = 0; axis < 3; ++axis)
    for (int bits = 0; bits < 8; ++bits) {
      if (bits & (1 << axis)) continue;
      ModelEdge e;
      e.vertex = {bits, bits | (1 << axis)};
      e.p = corner(e.vertex[0]);
      e.q = corner(e.vertex[1]);
      int k = 0;
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        e.surface[k] = 2 * other + ((bits >> other) & 1);
        e.normal[k] = m.surfaces[e.surface[k]].axis;
        ++k;
      }
      e.dihedral = M_PI / 2;
      for (int v : e.vertex) m.corners[v].edges.push_back(int(m.edges.size()));
      m.edges.push_back(e);
    }

  m.bounds = Eigen::AlignedBox3d(-half, half);
  m.diameter = 2 * half.norm();
  if (symmetric) m.symmetries.discrete = boxRotations(half);
  return m;
}

/// Edges of a convex polyhedron seen from `eye`.
inline bool visible(const ModelEdge& e, const Eigen::Vector3d& eye) {
  return e.normal[0].dot(eye - e.p) > 0 || e.normal[1].dot(eye - e.p) > 0;
}

inline std::vector<Eigen::Vector3d> sphere(int count) {
  std::vector<Eigen::Vector3d> result;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, turn = i * 2.399963229728653, r = std::sqrt(1 - z * z);
    result.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return result;
}

/// Views of a convex polyhedron at one distance, modulo its discrete symmetries.
inline ViewSphere views(const ObjectModel& m, double distance, int count) {
  ViewSphere v;
  v.distances = {distance};
  v.step = 0;                                     // ten samples per edge, whatever its length
  const Eigen::Vector3d probe(0.82, 0.47, 0.31);  // the domain: nearest to this among the symmetric copies

  for (const Eigen::Vector3d& d : sphere(count)) {
    bool inside = true;
    for (const Rigid3& s : m.symmetries.discrete) inside &= probe.dot(d) >= probe.dot(s.rotation * d) - 1e-12;
    if (!inside) continue;
    SampledView view;
    view.direction = d;
    view.distance = distance;
    for (int e = 0; e < int(m.edges.size()); ++e) {
      if (!visible(m.edges[e], distance * d)) continue;
      for (int k = 0; k < 10; ++k) {
        ContourSample s;
        s.p = m.edges[e].p + (k + 0.5) / 10 * (m.edges[e].q - m.edges[e].p);
        s.tangent = (m.edges[e].q - m.edges[e].p).normalized();
        s.feature = e;
        view.contour.push_back(s);
      }
    }
    v.views.push_back(view);
  }

  v.directions = int(v.views.size());
  return v;
}

inline KnownObject known(const ObjectModel& m, int view_count = 2000) {
  return {m, views(m, 2.5 * m.diameter, view_count)};
}

/// A pose that looks at the object's origin from a random side.
inline Rigid3 randomPose(std::mt19937* random, double distance) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(*random), normal(*random), normal(*random), normal(*random));
  return {q.normalized().toRotationMatrix(), Eigen::Vector3d(0, 0, distance)};
}

/// The visible edges of a convex polyhedron as segments; segment i is the image of edge (*edges)[i].
inline FeatureSet project(const ObjectModel& m, const Rigid3& camera_from_object, std::vector<int>* edges,
                          std::mt19937* random, double noise) {
  FeatureSet f = empty();
  std::normal_distribution<double> normal(0, noise);
  const Eigen::Vector3d eye = camera_from_object.inverse().translation;
  edges->clear();

  for (int e = 0; e < int(m.edges.size()); ++e) {
    if (!visible(m.edges[e], eye)) continue;
    Eigen::Vector2d p = f.camera.project(camera_from_object * m.edges[e].p);
    Eigen::Vector2d q = f.camera.project(camera_from_object * m.edges[e].q);
    if ((p - q).norm() < 20) continue;
    const Eigen::Vector2d d = (q - p).normalized();
    p += d + Eigen::Vector2d(normal(*random), normal(*random));  // detected edges stop a little short
    q -= d + Eigen::Vector2d(normal(*random), normal(*random));
    if ((*random)() % 2) std::swap(p, q);
    addSegment(&f, p, q);
    edges->push_back(e);
  }
  return f;
}

inline std::vector<Grouping> ofKind(const std::vector<Grouping>& all, GroupingKind kind) {
  std::vector<Grouping> result;
  for (const Grouping& g : all)
    if (g.kind == kind) result.push_back(g);
  return result;
}
inline std::vector<ModelGrouping> ofKind(const std::vector<ModelGrouping>& all, GroupingKind kind) {
  std::vector<ModelGrouping> result;
  for (const ModelGrouping& g : all)
    if (g.kind == kind) result.push_back(g);
  return result;
}

}  // namespace monocular_eye_hand::hand_made
