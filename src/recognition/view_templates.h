#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// A 2-D template of one view with a base edge, a straight line of its contour: once the two ends of that are
/// laid on an image segment, every other contour sample has its place. Offsets are complex multiples of the
/// base edge (x along it, y across).
struct ViewTemplate {
  static constexpr int kSamples = 16;
  std::array<float, kSamples> x, y;
  std::array<uint8_t, kSamples> angle;  ///< sample direction relative to the base edge, 256 = pi
  Eigen::Vector2f a, b;  ///< the base edge's ends in the view: metres at the distance of the object's centre
  float centre_x = 0, centre_y = 0;  ///< the object's centre, in multiples of the base edge
  float length = 0;                  ///< |b - a|
  float contour = 0;                 ///< length of the whole visible contour in the same unit
  int view = 0;                      ///< ViewSphere::views
};

/// The templates of one eye distance, ascending by the length of the base edge.
struct TemplateLevel {
  double min_ratio = 0, max_ratio = 0;  ///< eye distances in diameters for which this level stands
  std::vector<ViewTemplate> templates;
};

/// The view templates of a model, level by level. Base edges are its straight sharp edges, in views that show
/// few of them the straight pieces of other lines, where a cylinder or a rounded part ends against the
/// background, and in views without a long base edge the straight sides of the outline, as along a thread.
/// `view_rotations`: the camera's axes in the object frame as rows, one per view of the sphere.
std::vector<TemplateLevel> templateLevels(const KnownObject& object,
                                          const std::vector<Eigen::Matrix3d>& view_rotations);

}  // namespace monocular_eye_hand
