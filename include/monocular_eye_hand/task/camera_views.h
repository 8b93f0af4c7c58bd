#pragma once
#include <array>
#include <optional>
#include <vector>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/task/world.h"

namespace monocular_eye_hand {

/// From where the task looks. Defaults stand here and nowhere else.
struct CameraViewOptions {
  double overview_distance = 0.55;     ///< camera to the middle of the frame until it is found [m]
  double overview_elevation = 1.15;    ///< above the horizon [rad]
  double overview_azimuth_step = 0.9;  ///< azimuth from one overview to the next [rad]
  double search_distance = 0.42;       ///< the same once it is known, and in a search [m]
  double search_elevation = 0.9;       ///< above the horizon [rad]
  double near_distance = 0.36;         ///< camera to the object at the first near look [m]
  double near_step = 0.05;             ///< so much nearer with every further one [m]
  double min_distance = 0.28;          ///< but never nearer than this [m]
  double near_elevation = 1.0;         ///< above the horizon [rad]
  double near_azimuth_step = 1.3;      ///< azimuth from one near look to the next [rad]
  int max_views = 24;                  ///< poses handed to the planner

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("overview_distance", overview_distance);
    v("overview_elevation", overview_elevation);
    v("overview_azimuth_step", overview_azimuth_step);
    v("search_distance", search_distance);
    v("search_elevation", search_elevation);
    v("near_distance", near_distance);
    v("near_step", near_step);
    v("min_distance", min_distance);
    v("near_elevation", near_elevation);
    v("near_azimuth_step", near_azimuth_step);
    v("max_views", max_views);
  }
};

/// What a view looks at [m, base]: the middle of its object when it is a near one, else that of the frame as
/// it is known, else `centre`.
Eigen::Vector3d lookTarget(const TaskView& view, const std::optional<MappedObject>& frame,
                           const std::array<double, 3>& centre, const ModelBase& models);

/// Camera poses (base_from_camera) from which to look at `target` (base frame [m]), the best first: near the
/// desired direction, and there soonest reached from `current`. All are within reach of the arm; empty when
/// none is. The directions of successive overviews alternate about that of the robot itself, those of near
/// looks go round the object, so that several views cross.
std::vector<Rigid3> cameraViews(const TaskView& view, const Eigen::Vector3d& target, const Puma560& arm,
                                const Rigid3& tool0_from_camera, const JointVector& current,
                                const CameraViewOptions& options = {});

}  // namespace monocular_eye_hand
