#include "monocular_eye_hand/simulation/cell/gripper.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace monocular_eye_hand {
namespace {

constexpr double kFacing = 0.8;  // cosine between pad and face beyond which rubber meets no more than an edge

using Polygon = std::vector<Eigen::Vector3d>;

/// Keeps the part with sign * (p[axis] - limit) <= 0 (Sutherland and Hodgman).
void clip(Polygon* polygon, int axis, double limit, double sign) {
  Polygon out;
  const size_t n = polygon->size();
  for (size_t k = 0; k < n; ++k) {
    const Eigen::Vector3d &a = (*polygon)[k], &b = (*polygon)[(k + 1) % n];
    const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      out.push_back(a + (b - a) * (da / (da - db)));
      out.back()[axis] = limit;
    }
  }
  polygon->swap(out);
}

struct Piece {
  Polygon polygon;
  Eigen::Vector3d normal;  // of its triangle, unit
};

/// The part's surface between the pads, in gripper_tcp.
std::vector<Piece> between(const Mesh& mesh, const Rigid3& tcp_from_object, const GripperPads& pads,
                           double opening) {
  const double low[3] = {-pads.half_width, -opening / 2, pads.z_low};
  const double high[3] = {pads.half_width, opening / 2, pads.z_high};

  Polygon points;
  points.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& p : mesh.vertices) points.push_back(tcp_from_object * p);

  std::vector<Piece> pieces;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const Eigen::Vector3d corner_low = a.cwiseMin(b).cwiseMin(c), corner_high = a.cwiseMax(b).cwiseMax(c);
    bool apart = false;
    for (int k = 0; k < 3; ++k) apart = apart || corner_low[k] > high[k] || corner_high[k] < low[k];
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (apart || !(normal.norm() > 0)) continue;

    Polygon polygon{a, b, c};
    for (int k = 0; k < 3 && !polygon.empty(); ++k) {
      if (corner_high[k] > high[k]) clip(&polygon, k, high[k], 1);
      if (corner_low[k] < low[k]) clip(&polygon, k, low[k], -1);
    }
    if (!polygon.empty()) pieces.push_back({std::move(polygon), normal.normalized()});
  }
  return pieces;
}

/// The pad at `side` (+1, -1) times y.
PadTouch padContact(const std::vector<Piece>& pieces, double side) {
  PadTouch contact;
  double outermost = -std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces)
    for (const Eigen::Vector3d& p : piece.polygon) outermost = std::max(outermost, side * p.y());
  if (!std::isfinite(outermost)) return contact;
  contact.touched = true;
  contact.y = side * outermost;

  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  for (const Piece& piece : pieces) {
    const double facing = side * piece.normal.y();
    if (facing < kFacing) continue;
    Polygon patch = piece.polygon;
    clip(&patch, 1, side * (outermost - kPadCompliance), -side);
    for (size_t k = 1; k + 1 < patch.size(); ++k) {
      const double area = (patch[k] - patch[0]).cross(patch[k + 1] - patch[0]).norm() / 2;
      contact.area += area * facing;
      centre += area * facing * (patch[0] + patch[k] + patch[k + 1]) / 3;
      normal += area * piece.normal;
    }
  }

  if (contact.area > 0) {
    contact.centre = centre / contact.area;
    contact.normal = normal.normalized();
  }
  return contact;
}

}  // namespace

GripContact gripContact(const Mesh& mesh, const Rigid3& tcp_from_object, const GripperPads& pads,
                        double opening) {
  const std::vector<Piece> pieces = between(mesh, tcp_from_object, pads, opening);
  return {padContact(pieces, -1), padContact(pieces, 1)};
}

std::string gripWeakness(const GripContact& contact, double friction) {
  if (!contact.low.touched || !contact.high.touched) return "nothing between the pads";
  if (contact.low.area < kMinPatch || contact.high.area < kMinPatch)
    return "a pad meets too little of the part";
  const double cone = 1 / std::sqrt(1 + friction * friction);  // cosine of its half angle
  const Eigen::Vector3d line = (contact.high.centre - contact.low.centre).normalized();
  if (line.dot(contact.high.normal) < cone || -line.dot(contact.low.normal) < cone)
    return "the part's faces are not opposite enough for friction to hold it";
  if (contact.high.normal.y() < cone || -contact.low.normal.y() < cone)
    return "the part's faces are too oblique to the pads";
  return "";
}

}  // namespace monocular_eye_hand
