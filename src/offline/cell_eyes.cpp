#include "offline/cell_eyes.h"

#include "monocular_eye_hand/grasp/known_cell.h"
#include "offline/cell_robot.h"
#include "offline/wall_clock.h"

namespace monocular_eye_hand {
namespace {

constexpr int kCameraThreads = 1;

/// Rejected ones, too: the map weighs what several views say of them.
std::vector<SeenObject> seenObjects(const RecognitionResult& result) {
  std::vector<SeenObject> objects;
  for (const std::vector<ObjectEstimate>* estimates : {&result.objects, &result.rejected})
    for (const ObjectEstimate& estimate : *estimates)
      objects.push_back(
          {estimate.object, estimate.camera_from_object, estimate.covariance, estimate.probability});
  return objects;
}

}  // namespace

CellEyes::CellEyes(const WorkCell& cell, const Recognizer& recognizer, const Puma560& arm,
                   const OfflineOptions& options)
    : cell_(cell),
      recognizer_(recognizer),
      arm_(arm),
      options_(options),
      camera_(cell, kCameraThreads),
      tracker_(recognizer.models(), options.instances),
      map_(&recognizer.models(), options.grasping.map) {}

AddedView CellEyes::look(const TaskView& view, const std::function<void(const CellLook&)>& looked) {
  const double begin = wallSeconds();
  const CellImage image = camera_.capture(cell_);
  const double rendered = wallSeconds();
  const RecognitionResult result = recognise(image);
  recognition_ += wallSeconds() - rendered;
  rendering_ += rendered - begin;
  ++looks_;

  if (looked) looked({view, image.grey, camera_.camera(), result});
  return map_.add(viewOf(image, result));
}

RecognitionResult CellEyes::recognise(const CellImage& image) {
  RecognitionRequest request;
  request.support = supportPlane(image.base_from_camera.inverse(), tableHeight(), options_.support_tolerance);
  request.previous = tracker_.previous(image.time);
  RecognitionResult result = recognizer_.recognize(image.grey, camera_.camera(), request);
  tracker_.update(result.objects, image.time);
  return result;
}

ObjectView CellEyes::viewOf(const CellImage& image, const RecognitionResult& result) const {
  const ArmDescription& arm = cell_.arm();
  const GripperReading gripper = gripperOf(cell_);

  ObjectView view;
  view.stamp = image.time;
  view.hand = handPose(arm_, cell_.joints());
  view.hand_eye.tool0_from_camera = arm.tool0_from_camera;
  view.camera = camera_.camera();
  view.known =
      knownCell(options_.grasping, tableHeight(), view.hand.base_from_tool0 * arm.tool0_from_tcp, gripper);
  // What the hand holds, of whatever shape, hides much.
  view.complete = !result.truncated && !result.budget_spent && !gripper.holds(options_.grasping.held_width);
  view.objects = seenObjects(result);
  return view;
}

void CellEyes::forget(const MappedObject& object) { map_.forget(object.object, object.number, cell_.time()); }

}  // namespace monocular_eye_hand
