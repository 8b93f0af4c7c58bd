#include <fmt/format.h>

// What the task knows of the frame and of what lies in it.
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand {

void ClearFrameTask::learn(const TaskLook& seen) {
  map_.clear();
  for (const MappedObject& object : seen.objects)
    if (object.misses < options_.doubtful_misses) map_.push_back(object);
  learnFrame();

  for (const MappedObject& object : map_) {
    if (object.object < 0 || object.object >= int(models_->objects.size()))
      throw BadInput(fmt::format("object {} is not in the model base", object.object));
    const Key key{object.object, object.number};
    if (progress_.count(key)) {
      Progress& progress = progress_[key];
      TaskObject& entry = result_.objects[progress.index];
      entry.object = object;
      const bool lies_again = entry.outcome == ObjectOutcome::kDropped && object.last_stamp >= seen.stamp &&
                              inFrame(object) && entry.picks < options_.pick_attempts;
      const bool shown_after_all = shownAfterAll(progress, seen.stamp);
      if (shown_after_all) {
        progress.unconfirmed = 0;
        ++progress.reopened;
      }
      if (entry.outcome == ObjectOutcome::kGone || lies_again || shown_after_all) {
        entry.outcome = ObjectOutcome::kWaiting;
        entry.reason.clear();
      }
    } else if (inFrame(object)) {
      progress_[key].index = result_.objects.size();
      result_.objects.emplace_back();
      result_.objects.back().object = object;
    }
  }

  for (const auto& [key, progress] : progress_) {
    TaskObject& entry = result_.objects[progress.index];
    const bool there = entry.outcome == ObjectOutcome::kWaiting || entry.outcome == ObjectOutcome::kLeft;
    if (!there || known(key)) continue;
    entry.outcome = ObjectOutcome::kGone;
    entry.reason = "it is not seen any more where it was";
  }
}

/// Given up since near looks did not show it so, and this look shows it surely.
bool ClearFrameTask::shownAfterAll(const Progress& progress, double stamp) const {
  const TaskObject& entry = result_.objects[progress.index];
  return entry.outcome == ObjectOutcome::kLeft && progress.unconfirmed >= options_.confirm_attempts &&
         progress.reopened < options_.confirm_attempts && entry.object.last_stamp >= stamp &&
         entry.object.outliers == 0 && entry.object.probability >= options_.confirm_probability;
}

/// One that a view showed surely and those after it did not, without any doing of the task: views miss
/// things.
std::optional<ClearFrameTask::Key> ClearFrameTask::missedObject() const {
  for (const auto& [key, progress] : progress_) {
    const TaskObject& entry = result_.objects[progress.index];
    if (entry.outcome == ObjectOutcome::kGone && entry.picks == 0 &&
        progress.sought < options_.confirm_attempts &&
        entry.object.probability >= options_.confirm_probability && inFrame(entry.object))
      return key;
  }
  return std::nullopt;
}

void ClearFrameTask::learnFrame() {
  // The one that was taken first, as long as it is known; a second one is not swapped for it.
  const MappedObject* found = nullptr;
  for (const MappedObject& object : map_) {
    if (object.object != frame_) continue;
    if (!found || (frame_pose_ && object.number == frame_pose_->number)) found = &object;
  }
  if (found) frame_pose_ = *found;
}

bool ClearFrameTask::inFrame(const MappedObject& object) const {
  if (object.object == frame_ || models_->objects[size_t(object.object)].handling.obstacle) return false;
  if (frame_ < 0) return true;
  if (!frame_pose_) return false;
  const Eigen::AlignedBox3d& bounds = models_->objects[size_t(frame_)].model.bounds;
  const Rigid3 frame_from_base = frame_pose_->base_from_object.inverse();
  const Eigen::Vector3d centre =
      frame_from_base * (object.base_from_object * models_->objects[size_t(object.object)].model.centre());
  // Height does not matter: the box is judged from above.
  int up = 0;
  frame_from_base.rotation.col(2).cwiseAbs().maxCoeff(&up);
  for (int k = 0; k < 3; ++k)
    if (k != up && (centre[k] < bounds.min()[k] - options_.frame_margin ||
                    centre[k] > bounds.max()[k] + options_.frame_margin))
      return false;
  return true;
}

const MappedObject* ClearFrameTask::known(const Key& key) const {
  for (const MappedObject& object : map_)
    if (Key(object.object, object.number) == key) return &object;
  return nullptr;
}

std::vector<ClearFrameTask::Key> ClearFrameTask::waiting() const {
  std::vector<Key> keys;
  for (const auto& [key, progress] : progress_) {
    const MappedObject* object = known(key);
    if (result_.objects[progress.index].outcome == ObjectOutcome::kWaiting && object && inFrame(*object))
      keys.push_back(key);
  }
  return keys;
}

}  // namespace monocular_eye_hand
