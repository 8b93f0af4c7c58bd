#pragma once
#include <Eigen/Core>
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// A flat part of a mesh's surface and the smallest rectangle about it.
struct PlanarFace {
  Rigid3 object_from_face;       ///< origin in the rectangle's middle, x along its longer side, z outwards
  double width = 0, height = 0;  ///< of the rectangle; width >= height [m]
  double area = 0;               ///< [m^2]
};

/// The face on the other side of the longest edge that two faces share.
struct FaceFold {
  int from = -1, to = -1;  ///< indices of faces
  Rigid3 turn;             ///< about the edge: carries what lies in the plane of `from` into that of `to`
  Eigen::Vector3d middle;  ///< of the edge, object frame
};

struct PlanarFaces {
  std::vector<PlanarFace> faces;  ///< largest first
  std::vector<FaceFold> folds;
};

/// Faces with more than `min_share` of the mesh's surface, at most `max_faces` of them.
PlanarFaces planarFaces(const Mesh& mesh, double min_share = 0.03, size_t max_faces = 8);

}  // namespace monocular_eye_hand
