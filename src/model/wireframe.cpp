#include "monocular_eye_hand/model/wireframe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kArcStep = 0.15;  // of a circle's chords [rad]

void addArc(const ModelCircle& circle, std::vector<WireframeLine>* lines) {
  const Eigen::Vector3d y_axis = circle.axis.cross(circle.x_axis);
  const auto at = [&](double angle) {
    return Eigen::Vector3d(circle.centre +
                           circle.radius * (std::cos(angle) * circle.x_axis + std::sin(angle) * y_axis));
  };

  const int chords = std::max(1, int(std::ceil(circle.sweep / kArcStep)));
  for (int k = 0; k < chords; ++k)
    lines->push_back(
        {at(circle.start + circle.sweep * k / chords), at(circle.start + circle.sweep * (k + 1) / chords)});
}

void addBox(const Eigen::AlignedBox3d& box, std::vector<WireframeLine>* lines) {
  using Corner = Eigen::AlignedBox3d::CornerType;  // a bit for each axis
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis) {
      const int other = corner | (1 << axis);
      if (other != corner) lines->push_back({box.corner(Corner(corner)), box.corner(Corner(other))});
    }
}

}  // namespace

std::vector<WireframeLine> wireframe(const ObjectModel& model) {
  std::vector<WireframeLine> lines;
  for (const ModelEdge& edge : model.edges) lines.push_back({edge.p, edge.q});
  for (const ModelCircle& circle : model.circles) addArc(circle, &lines);
  if (lines.empty()) addBox(model.bounds, &lines);
  return lines;
}

}  // namespace monocular_eye_hand
