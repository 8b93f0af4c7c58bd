#include <cmath>

#include "monocular_eye_hand/pose/circle_pose.h"
#include "monocular_eye_hand/recognition/hypotheses.h"

namespace monocular_eye_hand {
namespace {

constexpr int kRolls = 60;  // steps of the roll about the circle's axis

// Small ellipses fix the tilt badly: neighbours with another short axis and direction are tried as well.
std::vector<Ellipse> variants(const Ellipse& seen) {
  std::vector<Ellipse> all{seen};
  if (seen.a > 30) return all;
  for (double db : {-1.5, 1.5}) {
    Ellipse e = seen;
    e.b = std::min(e.b + db, e.a);
    if (e.b > 1.5) all.push_back(e);
  }
  for (double turn : {-0.12, 0.12}) {
    Ellipse e = seen;
    e.angle += turn;
    all.push_back(e);
  }
  return all;
}

// object -> camera rotation that takes the circle's frame (x_axis, axis) to (x, normal).
Eigen::Matrix3d alignAxes(const ModelCircle& circle, const Eigen::Vector3d& normal, double roll) {
  Eigen::Matrix3d in_object, in_camera;
  in_object << circle.x_axis, circle.axis.cross(circle.x_axis), circle.axis;
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const Eigen::Vector3d x = std::cos(roll) * u + std::sin(roll) * v;
  in_camera << x, normal.cross(x), normal;
  return in_camera * in_object.transpose();
}

}  // namespace

void hypothesesFromEllipses(const SearchContext& context, int /*object*/, const SearchModel& model,
                            HypothesisPool* pool, WorkBudget* budget) {
  const bool turned = model.model().symmetries.axis.has_value();
  for (const DetectedEllipse& detected : context.features.ellipses)
    for (const Ellipse& ellipse : variants(detected.ellipse))
      for (const ModelCircle& circle : model.model().circles) {
        const CirclePoses circles = circlePoses(ellipse, context.camera, circle.radius);
        for (int i = 0; i < circles.count; ++i) {
          const CirclePose& seen = circles.pose[i];
          // A rim of a planar face is seen from the face's side or, as an outline, from behind.
          for (double side : {1.0, -1.0}) {
            const int rolls = turned ? 1 : kRolls;
            for (int k = 0; k < rolls; ++k) {
              if (budget->spent()) return;
              Rigid3 pose;
              pose.rotation = alignAxes(circle, side * seen.normal, 2 * M_PI * k / kRolls);
              pose.translation = seen.centre - pose.rotation * circle.centre;
              pool->offer(pose, GroupingKind::kEllipse, context.map, budget);
            }
          }
        }
      }
}

}  // namespace monocular_eye_hand
