#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/mesh/closest_point.h"
#include "monocular_eye_hand/model/known_object.h"
#include "recognition/coarse_score.h"
#include "recognition/view_templates.h"

namespace monocular_eye_hand {

/// How large a part looks from one side: of its convex hull, at the distance of its centre.
struct ViewExtent {
  double area = 0;    ///< [m^2]
  double length = 0;  ///< largest distance between two points [m]
};

/// A known object prepared for search.
class SearchModel {
 public:
  explicit SearchModel(const KnownObject& object);

  const KnownObject& object() const { return *object_; }
  const ObjectModel& model() const { return object_->model; }
  const std::vector<TemplateLevel>& levels() const { return levels_; }
  const std::vector<ModelGrouping>& groupings() const { return groupings_; }
  /// Contour samples of a view, ordered so that every prefix is spread over the whole contour.
  const std::vector<ViewSample>& samples(int view) const { return samples_[view]; }
  /// The same for the coarse score.
  const CoarseContour& coarse(int view) const { return coarse_[size_t(view)]; }
  /// Camera orientation of a view's templates: rows are the camera's axes in the object frame.
  const Eigen::Matrix3d& viewRotation(int view) const { return view_rotation_[view]; }

  /// Of all poses that the symmetry group makes equal, the one whose eye lies in the sampled part of the view
  /// sphere; *view is the sampled view nearest to it.
  Rigid3 canonical(const Rigid3& camera_from_object, int* view) const;

  /// Whether a grouping (its number) shows as a whole under a pose: from the eye's direction or one beside
  /// it.
  bool shows(size_t grouping, const Rigid3& camera_from_object) const;

  /// Wong et al., 2.3.1: the camera is outside the object's (bounding) hull and every point is in front of
  /// it.
  bool seenFromOutside(const Rigid3& camera_from_object) const;

  /// Largest image distance [px] between the model's extent points under two poses, modulo the symmetry
  /// group.
  double poseDistance(const Camera& camera, const Rigid3& a, const Rigid3& b) const;

  /// Whether no point of the part lies farther from its surface under the other pose than a camera can tell
  /// [px]: the two poses are one, whatever rotation is between them.
  bool coincide(const Camera& camera, const Rigid3& a, const Rigid3& b, double resolved) const;

  /// Rotations about the centre that lay the bounding box on itself and are no symmetries:
  /// object_from_object.
  const std::vector<Rigid3>& boxRotations() const { return box_rotations_; }

  /// How large the part looks under a pose, along the ray to its centre.
  ViewExtent extentSeenFrom(const Rigid3& camera_from_object) const;
  /// The largest area and length of all views.
  const ViewExtent& largestExtent() const { return largest_; }

 private:
  void buildLookup();
  void buildShown();
  void buildBoxRotations();
  void buildHull();
  ViewExtent extentAlong(const Eigen::Vector3d& direction) const;

  const KnownObject* object_;
  std::vector<ModelGrouping> groupings_;
  std::vector<std::vector<ViewSample>> samples_;
  std::vector<CoarseContour> coarse_;
  std::vector<Eigen::Matrix3d> view_rotation_;
  std::vector<TemplateLevel> levels_;
  struct Nearest {
    int16_t direction = 0;
    int16_t symmetry = 0;
  };
  std::vector<Nearest> lookup_;           ///< cube map of eye directions
  std::vector<std::vector<char>> shown_;  ///< of every grouping: by symmetry and direction of the lookup
  double meridian_ = 0;                   ///< azimuth of the sampled views about a free axis [rad]
  std::vector<Eigen::Vector3d> extent_;
  std::vector<Rigid3> box_rotations_;
  std::shared_ptr<const ClosestPoint> surface_;
  std::vector<Eigen::Vector3d> hull_;  ///< vertices that are outermost in some direction
  ViewExtent largest_;
};

}  // namespace monocular_eye_hand
