#include "monocular_eye_hand/task/clear_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

std::string label(const MappedObject& object) { return fmt::format("{} {}", object.name, object.number); }

std::string twoDigits(double value) { return fmt::format("{:.2f}", value); }

}  // namespace

ClearFrameTask::ClearFrameTask(const ModelBase* models, TaskWorld* world, const ClearFrameOptions& options,
                               std::function<bool()> cancelled,
                               std::function<void(const TaskFeedback&)> feedback)
    : models_(models),
      world_(world),
      options_(options),
      cancelled_(std::move(cancelled)),
      feedback_(std::move(feedback)) {
  options.check();
  if (options.frame.empty()) return;
  frame_ = models->indexOf(options.frame);
  if (frame_ < 0)
    throw BadInput("frame = \"" + options.frame + "\" is not in the model base (" + models->names() + ")");
}

TaskResult ClearFrameTask::run() {
  while (step()) continue;
  return result_;
}

bool ClearFrameTask::step() {
  if (stage_ == TaskStage::kDone) return false;
  if (cancelled_ && cancelled_()) {
    finish(TaskOutcome::kCancelled, "cancelled before the stage " + toString(stage_));
    return false;
  }

  try {
    switch (stage_) {
      case TaskStage::kLook:
        lookAround();
        break;
      case TaskStage::kChoose:
        choose();
        break;
      case TaskStage::kConfirm:
        confirm();
        break;
      case TaskStage::kPick:
        pick();
        break;
      case TaskStage::kVerify:
        verify();
        break;
      case TaskStage::kCarry:
        carry();
        break;
      case TaskStage::kDone:
        break;
    }
  } catch (const std::exception& e) {
    finish(TaskOutcome::kFault, "stage " + toString(stage_) + ": " + e.what());
  }
  return stage_ != TaskStage::kDone;
}

void ClearFrameTask::lookAround() {
  if (searching_) return search();
  if (overview_ == 0 && failed_looks_ == 0) {
    if (result_.rounds == options_.max_rounds) return finishRound();
    ++result_.rounds;
  }
  TaskView view;
  view.overview = overview_;
  view.search = frame_pose_.has_value();  // from nearer, once it is known where it stands
  view.direction = direction_ + overview_;
  const int views = result_.rounds == 1 ? options_.overviews : options_.overviews_again;
  reportProgress(fmt::format("overview {} of {}", overview_ + 1, views));
  TaskLook seen;
  if (!look(view, &seen)) return;
  if (++overview_ < views) return;
  if (frame_ >= 0 && !frame_pose_)
    return finish(TaskOutcome::kNoFrame, "no " + options_.frame + " was found");
  stage_ = TaskStage::kChoose;
}

void ClearFrameTask::search() {
  TaskView view;
  view.overview = -1;
  view.direction = ++direction_;
  const std::optional<Key> missed = missedObject();
  if (missed) {
    view.near = true;
    view.object = entry(*missed).object;
    reportProgress("a look from near for " + label(view.object) + ", which later views missed");
  } else {
    view.search = true;
    reportProgress(fmt::format("nothing known is left; search {} of {}", searches_ + 1, options_.searches));
  }

  TaskLook seen;
  if (!look(view, &seen)) return;
  if (missed)
    ++progress_.at(*missed).sought;
  else
    ++searches_;
  searching_ = false;
  stage_ = TaskStage::kChoose;
}

bool ClearFrameTask::look(const TaskView& view, TaskLook* seen) {
  *seen = world_->look(view);
  if (cancelled_ && cancelled_()) {
    finish(TaskOutcome::kCancelled, "cancelled while looking");
    return false;
  }

  if (!seen->done) {
    if (++failed_looks_ < options_.look_attempts) {
      reportProgress("the look failed (" + seen->reason + "); again");
      world_->wait(std::ldexp(options_.retry_wait, failed_looks_ - 1));
    } else {
      finish(TaskOutcome::kFault,
             (failed_looks_ == 1 ? std::string("the look failed: ")
                                 : fmt::format("{} looks failed in a row: ", failed_looks_)) +
                 seen->reason);
    }
    return false;
  }

  failed_looks_ = 0;
  last_look_ = seen->stamp;
  learn(*seen);
  for (auto& [key, progress] : progress_) {
    if (view.near && key != Key(view.object.object, view.object.number)) continue;  // it may not be in view
    progress.unseen = known(key) && known(key)->last_stamp >= seen->stamp ? 0 : progress.unseen + 1;
  }
  return true;
}

void ClearFrameTask::choose() {
  chosen_.reset();
  double best = -1;
  std::optional<Key> uncertain;
  std::vector<Key> blocked;

  for (const Key& key : waiting()) {
    Progress& progress = progress_[key];
    if (progress.set_aside == result_.rounds) {
      blocked.push_back(key);
      continue;
    }
    const GraspPlan plan = world_->graspTargets(*known(key)).plan;
    if (!plan.candidates.empty()) {
      progress.blocked.clear();
      if (plan.candidates.front().quality > best) {
        best = plan.candidates.front().quality;
        chosen_ = key;
      }
    } else {
      progress.blocked = plan.reason.empty() ? "no grasp, and no reason was given" : plan.reason;
      if (!plan.too_uncertain) {
        blocked.push_back(key);
      } else if (progress.near_looks >= options_.near_looks) {
        giveUp(key, fmt::format("{} looks from near, and still: {}", progress.near_looks, plan.reason));
      } else if (!uncertain) {
        uncertain = key;
      }
    }
  }

  if (!chosen_) chosen_ = uncertain;
  if (chosen_) {
    reportProgress(best >= 0 ? "a grasp of quality " + twoDigits(best)
                             : "its pose is too uncertain: " + progress_[*chosen_].blocked);
    stage_ = TaskStage::kConfirm;
    return;
  }

  // What blocks them may have been seen wrongly; when it stays, nothing changes any more by itself.
  for (const Key& key : blocked)
    if (++progress_.at(key).blocked_rounds >= options_.blocked_rounds) giveUp(key, progress_.at(key).blocked);
  if (waiting().empty()) {
    searching_ = searches_ < options_.searches || missedObject();
    if (!searching_) return finishRound();
    stage_ = TaskStage::kLook;
    return;
  }
  reportProgress("looks again: " + progress_.at(waiting().front()).blocked);
  ++direction_;
  startRound();
}

void ClearFrameTask::setAside(const Key& key, const std::string& reason) {
  progress_.at(key).blocked = reason;
  progress_.at(key).set_aside = result_.rounds;
  stage_ = TaskStage::kChoose;
}

void ClearFrameTask::confirm() {
  const Key key = *chosen_;
  Progress& progress = progress_[key];
  const MappedObject* object = known(key);
  if (!object) return startRound();
  if (sure(key)) {
    prepareGrasps(*object);
    if (!candidates_.empty()) {
      stage_ = TaskStage::kPick;
      return;
    }
  }

  TaskView view;
  view.overview = -1;
  view.near = true;
  view.object = *object;
  view.approach = progress.near_looks;
  view.direction = direction_ + progress.near_looks;
  reportProgress("a look from near");
  TaskLook seen;
  if (!look(view, &seen)) return;
  ++progress.near_looks;
  ++entry(key).near_looks;
  judgeNearLook(key, seen.stamp);
}

void ClearFrameTask::judgeNearLook(const Key& key, double stamp) {
  Progress& progress = progress_[key];
  const MappedObject* object = known(key);
  if (!object) return doubted();  // learn() noted that it is gone
  std::string doubt;
  if (object->outliers > 0)
    doubt = "a look from near contradicted its pose";
  else if (object->last_stamp < stamp)
    doubt = "a look from near did not show it";
  else if (!inFrame(*object))
    doubt = "it is not in the frame any more";
  if (!doubt.empty()) {
    reportProgress(doubt);
    if (++progress.unconfirmed >= options_.confirm_attempts) giveUp(key, doubt);
    return doubted();
  }

  progress.unconfirmed = 0;
  progress.blocked.clear();
  const GraspPlan plan = prepareGrasps(*object);
  if (!candidates_.empty()) {
    stage_ = TaskStage::kPick;
    return;
  }
  progress.blocked = !plan.reason.empty() ? plan.reason : "no grasp leaves room for the pose's uncertainty";
  if (plan.too_uncertain && progress.near_looks < options_.near_looks) {
    reportProgress("still too uncertain: " + progress.blocked);
    return;  // once more, nearer
  }
  if (!plan.too_uncertain) return setAside(key, progress.blocked);
  giveUp(key, fmt::format("{} looks from near, and still: {}", progress.near_looks, progress.blocked));
  stage_ = TaskStage::kChoose;
}

// What one direction shows wrongly another may show right. The near look may have shown something else there:
// that is looked at first.
void ClearFrameTask::doubted() {
  ++direction_;
  if (waiting().empty() || ++doubts_ > options_.near_looks) return startRound();
  chosen_.reset();
  stage_ = TaskStage::kChoose;
}

bool ClearFrameTask::confirmed(const MappedObject& object) const {
  return object.views >= options_.confirm_views && object.probability >= options_.confirm_probability;
}

// Several views agree on it, the last look among them, and no grasp of it was lost.
bool ClearFrameTask::sure(const Key& key) {
  const MappedObject* object = known(key);
  return object && confirmed(*object) && object->outliers == 0 && object->last_stamp >= last_look_ &&
         inFrame(*object) && entry(key).picks == 0;
}

GraspPlan ClearFrameTask::prepareGrasps(const MappedObject& object) {
  const TaskGrasps grasps = world_->graspTargets(object);

  std::vector<GraspCandidate> with_room;
  for (const GraspCandidate& c : grasps.plan.candidates)
    if (c.clearance() >= 0) with_room.push_back(c);

  candidates_.clear();
  for (const GraspCandidate& c : variedFirst(with_room, options_.candidates))
    candidates_.push_back({grasps.object, c});
  return grasps.plan;
}

void ClearFrameTask::pick() {
  const Key key = *chosen_;
  std::string why;

  for (size_t k = 0; k < candidates_.size(); ++k) {
    reportProgress(fmt::format("grasp {} of {}, {}", k + 1, candidates_.size(), candidates_[k].grasp.source));
    const ActionResult result = world_->pick(candidates_[k]);
    switch (result.outcome) {
      case ActionOutcome::kDone:
        ++entry(key).picks;
        entry(key).outcome = ObjectOutcome::kHeld;
        stage_ = TaskStage::kVerify;
        return;
      case ActionOutcome::kGraspLost:
        ++entry(key).picks;
        return lostGrasp(result.reason);
      case ActionOutcome::kCancelled:
      case ActionOutcome::kFault:
        return stopped(result);
      case ActionOutcome::kUnreachable:
      case ActionOutcome::kInCollision:
        why = toString(result.outcome) + ": " + result.reason;
    }
    if (cancelled_ && cancelled_()) return finish(TaskOutcome::kCancelled, "cancelled while picking");
  }

  setAside(key, fmt::format("none of {} grasps has a path; the last one: {}", candidates_.size(), why));
}

// Cancelled or broken in the middle of a motion: only asks what the gripper holds.
void ClearFrameTask::stopped(const ActionResult& result) {
  const TaskGrip grip = world_->grip();
  TaskObject& object = entry(*chosen_);
  if (grip.known && grip.holding) {
    object.outcome = ObjectOutcome::kHeld;
  } else if (grip.known && object.outcome == ObjectOutcome::kHeld) {
    object.outcome = ObjectOutcome::kDropped;
    object.reason = "the gripper had let it go when it was stopped";
  }
  const bool cancelled = result.outcome == ActionOutcome::kCancelled;
  finish(cancelled ? TaskOutcome::kCancelled : TaskOutcome::kFault,
         toString(stage_) + " of " + label(entry(*chosen_).object) + ": " + result.reason);
}

void ClearFrameTask::verify() {
  const TaskGrip grip = world_->grip();
  if (!grip.known) return finish(TaskOutcome::kFault, "the gripper does not answer: " + grip.reason);
  if (!grip.holding) return lostGrasp("after lifting the gripper is empty: " + grip.reason);
  reportProgress("the gripper holds it: " + grip.reason);
  stage_ = TaskStage::kCarry;
}

void ClearFrameTask::lostGrasp(const std::string& reason) {
  const Key key = *chosen_;
  entry(key).outcome = ObjectOutcome::kWaiting;
  reportProgress("lost: " + reason);
  if (!opened()) return;
  if (entry(key).picks >= options_.pick_attempts)
    giveUp(key, fmt::format("{} grasps lost; the last one: {}", entry(key).picks, reason));
  startRound();
}

void ClearFrameTask::carry() {
  const Key key = *chosen_;
  reportProgress(fmt::format("to the drop zone, place {}", carried_));
  const MappedObject object = entry(key).object;
  const ActionResult result = world_->carry(object, carried_);

  if (result.done()) {
    ++carried_;
    entry(key).outcome = ObjectOutcome::kCarried;
    searches_ = 0;
    for (auto& [other, progress] : progress_) {
      // What stood in its way, or before it, may do so no more.
      progress.blocked_rounds = progress.sought = 0;
      TaskObject& left = result_.objects[progress.index];
      if (left.outcome == ObjectOutcome::kLeft && left.picks < options_.pick_attempts) {
        left.outcome = ObjectOutcome::kWaiting;
        left.reason.clear();
        Progress again;
        again.index = progress.index;
        again.unseen = progress.unseen;
        progress = again;
      }
    }
    return startRound();
  }

  if (result.outcome == ActionOutcome::kGraspLost) {
    entry(key).outcome = ObjectOutcome::kDropped;
    entry(key).reason = "on the way to the drop zone: " + result.reason;
    if (opened()) startRound();
    return;
  }
  stopped(result);
}

bool ClearFrameTask::opened() {
  const ActionResult result = world_->open();
  if (result.done()) return true;
  finish(result.outcome == ActionOutcome::kCancelled ? TaskOutcome::kCancelled : TaskOutcome::kFault,
         "the gripper does not open: " + result.reason);
  return false;
}

void ClearFrameTask::giveUp(const Key& key, const std::string& reason) {
  entry(key).outcome = ObjectOutcome::kLeft;
  entry(key).reason = reason;
}

void ClearFrameTask::startRound() {
  chosen_.reset();
  overview_ = doubts_ = 0;
  for (auto& [key, progress] : progress_) progress.near_looks = 0;
  stage_ = TaskStage::kLook;
}

/// Phantoms of recognition show in one view, or are doubtful in each: what is there is seen from several
/// sides.
bool ClearFrameTask::inDoubt(const TaskObject& object) const {
  if (object.outcome != ObjectOutcome::kLeft && object.outcome != ObjectOutcome::kWaiting) return false;
  const Progress& progress = progress_.at({object.object.object, object.object.number});
  return object.picks == 0 && !confirmed(object.object) && progress.unseen >= options_.doubtful_looks;
}

void ClearFrameTask::settleDoubts() {
  for (TaskObject& object : result_.objects) {
    if (!inDoubt(object)) continue;
    const int unseen = progress_.at({object.object.object, object.object.number}).unseen;
    const std::string why = object.reason.empty() ? "" : "; " + object.reason;
    object.outcome = ObjectOutcome::kDoubt;
    object.reason = fmt::format("{}, the {} looks after it did not{}",
                                object.object.views == 1 ? "one view showed it" : "no view showed it surely",
                                unseen, why);
  }
}

void ClearFrameTask::finishRound() {
  chosen_.reset();
  settleDoubts();
  int left = 0;
  std::string first, doubts;

  for (TaskObject& object : result_.objects) {
    const MappedObject* there = known({object.object.object, object.object.number});
    if (object.outcome == ObjectOutcome::kWaiting && there && !inFrame(*there)) {
      object.outcome = ObjectOutcome::kGone;
      object.reason = "it lies outside the frame now";
    }
    if (object.outcome == ObjectOutcome::kWaiting) {
      object.outcome = ObjectOutcome::kLeft;
      object.reason = fmt::format("the task ended after max_rounds = {}", options_.max_rounds);
    }
    if (object.outcome == ObjectOutcome::kDoubt)
      doubts += (doubts.empty() ? "; in doubt: " : ", ") + label(object.object) + " (" + object.reason + ")";
    if (object.outcome != ObjectOutcome::kLeft && object.outcome != ObjectOutcome::kDropped) continue;
    if (++left == 1) first = label(object.object) + ": " + object.reason;
  }

  if (left > 0)
    finish(TaskOutcome::kLeftovers,
           fmt::format("{} left in the frame or dropped; {}{}", left, first, doubts));
  else
    finish(TaskOutcome::kCleared,
           fmt::format("nothing known is left in the frame; {} carried out{}", carried_, doubts));
}

void ClearFrameTask::finish(TaskOutcome outcome, const std::string& reason) {
  result_.outcome = outcome;
  result_.reason = reason;
  for (TaskObject& object : result_.objects)
    if (object.outcome == ObjectOutcome::kHeld) object.reason = "still in the gripper: " + reason;
  stage_ = TaskStage::kDone;
  reportProgress(reason);
}

void ClearFrameTask::reportProgress(const std::string& text) {
  if (!feedback_) return;
  TaskFeedback feedback;
  feedback.stage = stage_;
  if (chosen_) feedback.object = label(result_.objects[progress_.at(*chosen_).index].object);
  feedback.round = result_.rounds;
  feedback.carried = carried_;
  feedback.left = int(waiting().size());
  feedback.text = text;
  feedback_(feedback);
}

}  // namespace monocular_eye_hand
