#include "monocular_eye_hand/report/result_drawing.h"

#include <fmt/format.h>

#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

const ObjectModel& modelOf(const ModelBase& models, const ObjectEstimate& object) {
  if (object.object < 0 || object.object >= int(models.objects.size()))
    throw BadInput(fmt::format(
        "drawing: '{}' is object {} of a model base with {}: draw with the model base that recognised it",
        object.name, object.object, models.objects.size()));
  return models.objects[object.object].model;
}

ObjectStyle styleOf(const ObjectEstimate& object) {
  ObjectStyle style;
  style.colour = decisionColour(object.decision);
  style.axes = object.decision != Decision::kRejected;
  style.label = objectLabel(object);
  return style;
}

void drawLines(Canvas* canvas, const ModelBase& models, const ObjectEstimate& object) {
  ObjectStyle style = styleOf(object);
  style.label.clear();
  drawObject(canvas, modelOf(models, object), object.camera_from_object, style);
}

void drawLabel(Canvas* canvas, const ModelBase& models, const ObjectEstimate& object) {
  drawObjectLabel(canvas, modelOf(models, object), object.camera_from_object, styleOf(object));
}

}  // namespace

Colour decisionColour(Decision decision) {
  switch (decision) {
    case Decision::kAccepted:
      return {80, 230, 90};
    case Decision::kAmbiguous:
      return {40, 190, 255};
    case Decision::kRejected:
      break;
  }
  return {90, 90, 250};
}

std::string objectLabel(const ObjectEstimate& object) {
  return fmt::format("{} {:.2f}", object.name, object.probability);
}

cv::Mat drawResult(const cv::Mat& grey, const Camera& camera, const ModelBase& models,
                   const RecognitionResult& result, bool with_rejected, const PictureSize& size) {
  Canvas canvas(grey, camera, 0.85, size);
  std::vector<const ObjectEstimate*> shown;  // best last: on top
  if (with_rejected)
    for (const ObjectEstimate& object : result.rejected) shown.push_back(&object);
  std::reverse(shown.begin(), shown.end());
  for (size_t k = result.objects.size(); k-- > 0;) shown.push_back(&result.objects[k]);
  for (const ObjectEstimate* object : shown) drawLines(&canvas, models, *object);
  for (const ObjectEstimate* object : shown) drawLabel(&canvas, models, *object);
  if (result.objects.empty()) canvas.caption(result.reason.empty() ? "nothing found" : result.reason);
  return canvas.picture();
}

cv::Mat drawCandidate(const cv::Mat& grey, const Camera& camera, const ModelBase& models,
                      const ObjectEstimate& candidate) {
  Canvas canvas(grey, camera, 0.8);
  drawObject(&canvas, modelOf(models, candidate), candidate.camera_from_object, styleOf(candidate));
  return canvas.picture();
}

std::vector<cv::Mat> drawBackProjections(const cv::Mat& grey, const Camera& camera, const ModelBase& models,
                                         const RecognitionResult& result) {
  std::vector<cv::Mat> pictures;
  for (const ObjectEstimate& object : result.objects)
    pictures.push_back(drawCandidate(grey, camera, models, object));
  return pictures;
}

}  // namespace monocular_eye_hand
