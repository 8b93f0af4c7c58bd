#include <Eigen/Geometry>
#include <algorithm>

#include "monocular_eye_hand/drawing/overlays.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/contour.h"

namespace monocular_eye_hand {
namespace {

constexpr double kNear = 1e-3;  // nothing nearer than this before the lens is drawn [m]

void strokes(Canvas* canvas, const std::vector<ContourSample>& contour, const Rigid3& camera_from_object,
             double step, const Colour& colour, int width) {
  for (const ContourSample& sample : contour) {
    const Eigen::Vector3d p = camera_from_object * (sample.p - 0.5 * step * sample.tangent);
    const Eigen::Vector3d q = camera_from_object * (sample.p + 0.5 * step * sample.tangent);
    if (p.z() < kNear || q.z() < kNear) continue;
    canvas->line(canvas->camera().project(p), canvas->camera().project(q), colour, width);
  }
}

void drawAxes(Canvas* canvas, const Rigid3& camera_from_object, double length, int width) {
  const Colour colours[] = {{60, 60, 255}, {60, 220, 60}, {255, 120, 40}};
  const Eigen::Vector3d origin = camera_from_object.translation;
  if (origin.z() < kNear) return;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d tip = origin + length * camera_from_object.rotation.col(k);
    if (tip.z() < kNear) continue;
    canvas->arrow(canvas->camera().project(origin), canvas->camera().project(tip), colours[k], width);
  }
}

std::vector<ContourSample> drawnContour(const Canvas& canvas, const ObjectModel& model,
                                        const Rigid3& camera_from_object, double* step) {
  if (!camera_from_object.isFinite())
    throw BadInput("drawing: the pose of '" + model.name + "' is not finite");
  // About two picture pixels between samples: short enough for the smallest circle to look round.
  const double depth = std::max((camera_from_object * model.centre()).z(), 0.05);
  ContourOptions options;
  options.step = std::clamp(2.0 * depth / (canvas.camera().fx * canvas.scale()), model.diameter / 2000,
                            model.diameter / 60);
  *step = options.step;
  return visibleContour(model, camera_from_object.inverse().translation, options);
}

// Above the contour's highest point.
void writeLabel(Canvas* canvas, const std::vector<ContourSample>& contour, const Rigid3& camera_from_object,
                const ObjectStyle& style) {
  if (style.label.empty()) return;
  Eigen::Vector2d top(1e9, 1e9);
  for (const ContourSample& sample : contour) {
    const Eigen::Vector3d p = camera_from_object * sample.p;
    if (p.z() < kNear) continue;
    const Eigen::Vector2d uv = canvas->camera().project(p);
    if (uv.y() < top.y()) top = uv;
  }
  if (top.x() < 1e8) canvas->label(top - Eigen::Vector2d(0, 4), style.label, style.colour);
}

}  // namespace

void drawObject(Canvas* canvas, const ObjectModel& model, const Rigid3& camera_from_object,
                const ObjectStyle& style) {
  double step = 0;
  const std::vector<ContourSample> contour = drawnContour(*canvas, model, camera_from_object, &step);
  strokes(canvas, contour, camera_from_object, 1.2 * step, {0, 0, 0}, style.width + 2);
  strokes(canvas, contour, camera_from_object, 1.2 * step, style.colour, style.width);
  if (style.axes) drawAxes(canvas, camera_from_object, model.diameter / 3, std::max(2, style.width));
  writeLabel(canvas, contour, camera_from_object, style);
}

void drawObjectLabel(Canvas* canvas, const ObjectModel& model, const Rigid3& camera_from_object,
                     const ObjectStyle& style) {
  double step = 0;
  writeLabel(canvas, drawnContour(*canvas, model, camera_from_object, &step), camera_from_object, style);
}

}  // namespace monocular_eye_hand
