#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

// Lengths in metres, in the object frame, which is the CAD file's frame and never moved.

/// A maximal connected set of triangles that meet without a sharp edge: a plane, a cylinder wall, a free
/// form.
struct Surface {
  enum class Kind { kPlane, kCylinder, kFreeform };
  Kind kind = Kind::kFreeform;
  std::vector<int> triangles;
  double area = 0;         ///< [m^2]
  Eigen::Vector3d point;   ///< on the plane; on the cylinder's axis at the middle of the wall
  Eigen::Vector3d axis;    ///< outward plane normal; cylinder axis (unit)
  double radius = 0;       ///< cylinder
  double half_length = 0;  ///< cylinder
  bool convex = true;      ///< cylinder: boss (true) or hole (false)
};

/// A straight edge between two surfaces, sharp or rounded (or the rim of an open mesh: surface[1] = -1). It
/// runs so that, seen from outside, surface[0] lies on its left: normal[0] x (q - p) points into surface[0],
/// (q - p) x normal[1] into surface[1].
struct ModelEdge {
  Eigen::Vector3d p, q;
  std::array<int, 2> vertex{-1,
                            -1};  ///< ObjectModel::corners at p and q, -1 where no other straight edge ends
  std::array<int, 2> surface{-1, -1};
  std::array<Eigen::Vector3d, 2> normal{
      Eigen::Vector3d::Zero(),
      Eigen::Vector3d::Zero()};  ///< outward normals of the two surfaces along the edge
  double dihedral = 0;           ///< angle between the normals [rad]
  bool convex = true;
  double rounding = 0;  ///< radius of the fillet or round on whose middle p and q lie, 0: sharp [m]
};

/// A circle or arc recovered from a tessellated edge.
struct ModelCircle {
  Eigen::Vector3d centre,
      axis;                ///< axis: unit; towards the outside of the planar surface it bounds, if one does
  Eigen::Vector3d x_axis;  ///< unit, perpendicular to axis; zero of the angles
  double radius = 0;
  double start = 0, sweep = 0;  ///< [rad], counter-clockwise about axis; sweep = 2 pi for a full circle
  std::array<int, 2> surface{-1, -1};  ///< surface[1] = -1 on the rim of an open mesh
  /// Per surface: its outward normal on the circle as (share outwards along the radius, share along axis).
  std::array<Eigen::Vector2d, 2> normal{Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 0)};
  double dihedral = 0;  ///< angle between the two normals [rad]
  bool convex = true;
  double segment = 0;   ///< largest angle one edge of the mesh covers [rad]
  bool left = true;     ///< surface[0] lies on the left of the counter-clockwise tangent, seen from outside
  double rounding = 0;  ///< radius of the fillet or round on whose middle it lies, 0: sharp [m]
  double length() const { return radius * sweep; }
  bool full() const { return sweep > 6.28; }
};

/// A vertex where at least two straight edges meet.
struct ModelCorner {
  Eigen::Vector3d p;
  std::vector<int> edges;  ///< ObjectModel::edges
};

/// A rotation axis about which the object looks the same at every angle.
struct SymmetryAxis {
  Eigen::Vector3d point, direction;  ///< direction: unit
};

/// Motions of the object frame onto itself that leave the object unchanged: object_from_object.
struct Symmetries {
  std::vector<Rigid3> discrete{Rigid3{}};  ///< identity first
  std::optional<SymmetryAxis> axis;  ///< with an axis, `discrete` holds what is left modulo it (e.g. a flip)
  bool sphere = false;               ///< every rotation about the centre
};

/// One point of the visible contour with its direction: what an image would show as an edge.
struct ContourSample {
  Eigen::Vector3d p;        ///< object frame
  Eigen::Vector3d tangent;  ///< unit
  int feature = 0;          ///< feature it belongs to, see ObjectModel::featureCount()
  bool silhouette = false;  ///< background (or another part of the object far behind) on one side
  int inner_side =
      0;  ///< silhouette: +1 / -1 when the object lies on the side of +/- (tangent x view ray); 0 else
};

class RayScene;      // mesh/ray_scene.h
class ContourIndex;  // what visibleContour prepares once per model

struct ObjectModel {
  std::string name;
  Mesh mesh;  ///< welded
  std::vector<Surface> surfaces;
  std::vector<int> surface_of_triangle;
  std::vector<ModelEdge> edges;
  std::vector<ModelCircle> circles;
  std::vector<ModelCorner> corners;
  Symmetries symmetries;
  Eigen::AlignedBox3d bounds;
  double diameter = 0;            ///< largest distance between two vertices
  bool closed = true;             ///< the mesh has no rim
  double tessellation_error = 0;  ///< how far the triangles stay from the true curved surfaces, about [m]
  std::vector<std::string> warnings;
  std::shared_ptr<const RayScene> rays;
  std::shared_ptr<const ContourIndex> contour_index;

  Eigen::Vector3d centre() const { return bounds.center(); }
  /// Features of the contour: edges first, then circles, then one silhouette per curved surface.
  int featureCount() const { return int(edges.size() + circles.size() + surfaces.size()); }
  int featureOfEdge(int edge) const { return edge; }
  int featureOfCircle(int circle) const { return int(edges.size()) + circle; }
  int featureOfSilhouette(int surface) const { return int(edges.size() + circles.size()) + surface; }
};

}  // namespace monocular_eye_hand
