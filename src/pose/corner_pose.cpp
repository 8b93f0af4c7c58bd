#include "monocular_eye_hand/pose/corner_pose.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "pose/real_roots.h"

namespace monocular_eye_hand {
namespace {

/// Edge i seen in the plane of `c` (line of sight) and u_i: direction cos(theta_i) c + sin(theta_i) u_i, with
/// theta_i in (0, pi) on the observed side.
struct Corner {
  Eigen::Vector3d c;
  Eigen::Matrix3d u;      // columns: unit, normal to c
  Eigen::Matrix3d edges;  // columns: unit, object frame
};

/// Newton on the three cosines between the edges.
bool polish(const Corner& corner, Eigen::Vector3d* theta) {
  const Eigen::Matrix3d wanted = corner.edges.transpose() * corner.edges, k = corner.u.transpose() * corner.u;
  static constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};

  double size = 1;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Eigen::Array3d c = theta->array().cos(), s = theta->array().sin();
    Eigen::Vector3d r;
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const int a = pairs[i][0], b = pairs[i][1];
      r[i] = c[a] * c[b] + s[a] * s[b] * k(a, b) - wanted(a, b);
      jacobian(i, a) = -s[a] * c[b] + c[a] * s[b] * k(a, b);
      jacobian(i, b) = -c[a] * s[b] + s[a] * c[b] * k(a, b);
    }

    const Eigen::Vector3d step = jacobian.inverse() * r;
    const double next = step.cwiseAbs().maxCoeff();
    if (!(next < 1)) return r.cwiseAbs().maxCoeff() < 1e-9;  // a double root as good as it can be found
    if (next < 1e-7 && next >= size) return true;            // rounding
    size = next;
    *theta -= step;
    if (size < 1e-14) return true;
  }
  return size < 1e-6;
}

Eigen::Matrix3d rotationAt(const Corner& corner, const Eigen::Vector3d& theta) {
  Eigen::Matrix3d seen;
  for (int i = 0; i < 3; ++i)
    seen.col(i) = std::cos(theta[i]) * corner.c + std::sin(theta[i]) * corner.u.col(i);
  return nearestRotation(seen * corner.edges.transpose());
}

/// theta of each edge when edge 1 stands at theta_1 and the object is turned about it by phi.
Eigen::Vector3d anglesAt(const Corner& corner, const Eigen::Matrix3d& frame_from_object, double cosine,
                         double sine, double phi) {
  Eigen::Matrix3d frame;  // edge 1, then two normals to it
  frame.col(0) = cosine * corner.c + sine * corner.u.col(0);
  frame.col(1) = cosine * corner.u.col(0) - sine * corner.c;
  frame.col(2) = frame.col(0).cross(frame.col(1));
  Eigen::Vector3d theta;
  theta[0] = std::atan2(sine, cosine);
  for (int i = 1; i < 3; ++i) {
    const Eigen::Vector3d e = frame_from_object * corner.edges.col(i);
    const Eigen::Vector3d d = frame * Eigen::Vector3d(e[0], e[1] * std::cos(phi) - e[2] * std::sin(phi),
                                                      e[1] * std::sin(phi) + e[2] * std::cos(phi));
    theta[i] = std::atan2(d.dot(corner.u.col(i)), d.dot(corner.c));
  }
  return theta;
}

}  // namespace

std::vector<Eigen::Matrix3d> cornerRotations(const CornerObservation& seen,
                                             const Eigen::Matrix3d& directions) {
  std::vector<Eigen::Matrix3d> rotations;
  if (!seen.corner.allFinite() || !seen.far_points.allFinite() || !directions.allFinite()) return rotations;
  Corner corner;
  corner.c = seen.corner.normalized();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d far = seen.far_points.col(i) - corner.c * corner.c.dot(seen.far_points.col(i));
    const double length = far.norm(), edge = directions.col(i).norm();
    if (!(length > 1e-12) || !(edge > 0)) return rotations;
    corner.u.col(i) = far / length;
    corner.edges.col(i) = directions.col(i) / edge;
  }
  // Object axes: edge 1, edge 2's part normal to it, and their cross product.
  Eigen::Matrix3d frame_from_object;
  const Eigen::Vector3d normal = corner.edges.col(0).cross(corner.edges.col(1));
  if (!(normal.norm() > 1e-9) || !(corner.edges.col(0).cross(corner.edges.col(2)).norm() > 1e-9) ||
      !(corner.edges.col(1).cross(corner.edges.col(2)).norm() > 1e-9))
    return rotations;
  frame_from_object.row(0) = corner.edges.col(0);
  frame_from_object.row(2) = normal.normalized();
  frame_from_object.row(1) = frame_from_object.row(2).cross(frame_from_object.row(0));

  // Camera axes x = u_1, y, z = c, so that edge 1 = (s, 0, x), with x = cos theta_1, s = sin theta_1. An edge
  // with frame coordinates (e0, e1, e2), turned by phi, lies in the plane of normal n = (nx, ny, 0) when
  //   A cos phi + B sin phi + C s = 0,  A = nx x e1 + ny' e2,  B = -nx x e2 + ny' e1,  C = nx e0.
  // frame axis 2 = edge 1 x (x u_1 - s c) = c x u_1 * (x^2 + s^2): the y axis.
  const Eigen::Vector3d y_axis = corner.c.cross(corner.u.col(0));
  std::array<double, 2> a0, a1, b0, b1, c;  // A = a0 + a1 x, B = b0 + b1 x
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d n = corner.c.cross(corner.u.col(i + 1));
    const Eigen::Vector3d e = frame_from_object * corner.edges.col(i + 1);
    const double nx = n.dot(corner.u.col(0)), ny = n.dot(y_axis);
    a0[i] = ny * e[2];
    a1[i] = nx * e[1];
    b0[i] = ny * e[1];
    b1[i] = -nx * e[2];
    c[i] = nx * e[0];
  }
  // cos phi : sin phi : 1 = s (B1 C2 - B2 C1) : s (C1 A2 - C2 A1) : (A1 B2 - A2 B1)
  const double p0 = b0[0] * c[1] - b0[1] * c[0], p1 = b1[0] * c[1] - b1[1] * c[0];
  const double q0 = c[0] * a0[1] - c[1] * a0[0], q1 = c[0] * a1[1] - c[1] * a1[0];
  const double r0 = a0[0] * b0[1] - a0[1] * b0[0];
  const double r1 = a0[0] * b1[1] + a1[0] * b0[1] - a0[1] * b1[0] - a1[1] * b0[0];
  const double r2 = a1[0] * b1[1] - a1[1] * b1[0];
  const double m0 = p0 * p0 + q0 * q0, m1 = 2 * (p0 * p1 + q0 * q1), m2 = p1 * p1 + q1 * q1;
  const Quartic quartic = {r0 * r0 - m0, 2 * r0 * r1 - m1, r1 * r1 + 2 * r0 * r2 - m2 + m0, 2 * r1 * r2 + m1,
                           r2 * r2 + m2};
  for (const double x : realRoots(quartic, -1, 1)) {
    const double s = std::sqrt(std::max(0.0, 1 - x * x));
    // The turn about edge 1 from one of the two conditions, both its solutions; the other condition is
    // checked by the polishing (solving both linearly fails where they are the same equation).
    const double amplitude[2] = {std::hypot(a0[0] + a1[0] * x, b0[0] + b1[0] * x),
                                 std::hypot(a0[1] + a1[1] * x, b0[1] + b1[1] * x)};
    const int k = amplitude[1] > amplitude[0];
    if (!(amplitude[k] > 0)) continue;
    const double middle = std::atan2(b0[k] + b1[k] * x, a0[k] + a1[k] * x);
    const double spread = std::acos(std::clamp(-c[k] * s / amplitude[k], -1.0, 1.0));
    for (const double phi : {middle + spread, middle - spread}) {
      Eigen::Vector3d theta = anglesAt(corner, frame_from_object, x, s, phi);
      if (!(theta.minCoeff() > -1e-6) || !polish(corner, &theta)) continue;
      if (!(theta.minCoeff() > 0 && theta.maxCoeff() < M_PI)) continue;
      const Eigen::Matrix3d rotation = rotationAt(corner, theta);
      double worst = 0;  // the mirror image satisfies the cosines too, but no rotation gives it
      for (int i = 0; i < 3; ++i)
        worst = std::max(worst, (rotation * corner.edges.col(i) - std::cos(theta[i]) * corner.c -
                                 std::sin(theta[i]) * corner.u.col(i))
                                    .norm());
      if (!(worst < 1e-7)) continue;
      const bool known = std::any_of(rotations.begin(), rotations.end(), [&](const Eigen::Matrix3d& other) {
        return (other - rotation).norm() < 1e-7;
      });
      if (!known && rotations.size() < 4) rotations.push_back(rotation);
    }
  }
  return rotations;
}

double cornerDepth(const Eigen::Vector3d& corner, const Eigen::Vector3d& end, const Eigen::Vector3d& edge,
                   double length) {
  // depth * corner + length * edge = range * end: in the plane's axes along `end` and normal to it
  const Eigen::Vector3d normal = corner - end * end.dot(corner);
  const double across = normal.squaredNorm();
  if (!(across > 0)) return 0;
  const double depth = -length * edge.dot(normal) / across;
  const double range = end.dot(depth * corner + length * edge);
  return depth > 0 && range > 0 ? depth : 0;
}

}  // namespace monocular_eye_hand
