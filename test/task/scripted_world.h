#pragma once
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "monocular_eye_hand/task/clear_frame.h"

namespace monocular_eye_hand::scripted {

enum { kBridge, kGrenade, kFrame };

/// Models that the task needs: names and boxes.
inline ModelBase models() {
  ModelBase base;
  for (const char* name : {"bridge", "grenade", "frame"}) {
    KnownObject object;
    object.model.name = name;
    object.model.bounds.extend(Eigen::Vector3d(-0.03, -0.03, 0));
    object.model.bounds.extend(Eigen::Vector3d(0.03, 0.03, 0.06));
    base.objects.push_back(object);
  }
  base.objects[kFrame].model.bounds =
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.15, -0.11, 0), Eigen::Vector3d(0.15, 0.11, 0.025));
  base.objects[kFrame].handling.obstacle = true;
  base.objects[kFrame].handling.grasp = false;
  return base;
}
inline const ModelBase kModels = models();

inline Rigid3 at(double x, double y) { return {Eigen::Matrix3d::Identity(), {x, y, 0}}; }

/// A world whose objects are truth, with a script for what goes wrong. Counts every motion.
class World : public TaskWorld {
 public:
  struct Thing {
    MappedObject object;
    bool there = true;
    int misses_left = 2;  // looks until the map forgets it
    std::string refused;  // no grasp: why
    int uncertain = 0;    // near looks until its pose is sure enough
    bool hidden_from_near = false;
    bool contradicted = false;
    std::vector<ActionResult> picks;  // answers in turn, then done
    bool blocked_by_others = false;
  };

  World() { put(kFrame, 0, at(0.5, 0)); }
  Thing& put(int object, int number, const Rigid3& pose) {
    things.emplace_back();
    Thing& thing = things.back();
    thing.object.object = object;
    thing.object.number = number;
    thing.object.name = models().objects[size_t(object)].model.name;
    thing.object.base_from_object = pose;
    thing.object.probability = 0.95;
    return thing;
  }
  Thing& thing(int object, int number) {
    return *std::find_if(things.begin(), things.end(), [&](const Thing& t) {
      return t.object.object == object && t.object.number == number;
    });
  }

  TaskLook look(const TaskView& view) override {
    log.push_back(view.near           ? "near " + view.object.name + std::to_string(view.approach)
                  : view.overview < 0 ? "search"
                                      : "overview " + std::to_string(view.overview));
    if (before_look) before_look(view);
    TaskLook seen;
    if (!silent.empty()) {
      seen.reason = silent;
      if (silent_looks > 0 && --silent_looks == 0) silent.clear();
      return seen;
    }
    seen.done = true;
    seen.stamp = ++clock;

    for (Thing& t : things) {
      const bool wanted =
          view.near && t.object.object == view.object.object && t.object.number == view.object.number;
      const bool shown = t.there && !(wanted && t.hidden_from_near);
      if (wanted && shown && t.uncertain > 0) --t.uncertain;
      t.object.outliers = wanted && t.contradicted ? 1 : 0;
      if (shown && t.object.outliers == 0) t.object.last_stamp = seen.stamp;
      if (!t.there && t.misses_left-- <= 0) continue;
      seen.objects.push_back(t.object);
    }
    return seen;
  }

  TaskGrasps graspTargets(const MappedObject& object) override {
    Thing& t = thing(object.object, object.number);
    TaskGrasps grasps{object, {}};
    grasps.object.base_from_object = grasps.object.base_from_object * planned_from_map;
    GraspPlan& plan = grasps.plan;
    plan.reason = t.refused;
    if (t.blocked_by_others && std::count_if(things.begin(), things.end(), [](const Thing& o) {
                                 return o.there && o.object.object != kFrame;
                               }) > 1)
      plan.reason = "meets an obstacle";
    if (t.uncertain > 0) {
      plan.too_uncertain = true;
      plan.reason = "3 sigma need 9 mm, the gripper leaves 5 mm";
    }

    if (!plan.reason.empty()) return grasps;
    for (int k = 0; k < 3; ++k) {
      GraspCandidate c;
      c.free = 0.01;
      c.needed = clearance_fits ? 0.002 : 0.02;
      c.quality = 0.9 - 0.1 * k - 0.05 * object.object;
      c.source = "grasp " + std::to_string(k);
      plan.candidates.push_back(c);
    }
    return grasps;
  }

  ActionResult pick(const PlannedGrasp& planned) override {
    const MappedObject& object = planned.object;
    log.push_back("pick " + object.name + std::to_string(object.number) + " by " + planned.grasp.source);
    picked.push_back(planned);
    Thing& t = thing(object.object, object.number);
    ActionResult result{ActionOutcome::kDone, ""};
    if (!t.picks.empty()) {
      result = t.picks.front();
      t.picks.erase(t.picks.begin());
    }
    if (result.outcome != ActionOutcome::kUnreachable && result.outcome != ActionOutcome::kInCollision)
      ++motions;
    if (result.done() && !t.there) result = {ActionOutcome::kGraspLost, "the fingers closed on nothing"};
    if (result.done()) holding = true;
    return result;
  }

  TaskGrip grip() override { return {grip_answers, holding && !slips, holding ? "40 mm" : "0 mm"}; }

  ActionResult carry(const MappedObject& object, int place) override {
    log.push_back("carry " + object.name + std::to_string(object.number) + " to " + std::to_string(place));
    ++motions;
    if (!carries.empty()) {
      const ActionResult result = carries.front();
      carries.erase(carries.begin());
      if (result.outcome == ActionOutcome::kGraspLost) holding = false;
      if (!result.done()) return result;
    }
    holding = false;
    Thing& t = thing(object.object, object.number);
    t.there = false;
    t.misses_left = 0;
    return {ActionOutcome::kDone, ""};
  }

  ActionResult open() override {
    log.push_back("open");
    holding = slips = false;
    return opens;
  }

  std::vector<Thing> things;
  std::vector<std::string> log;
  std::vector<PlannedGrasp> picked;  // all that pick() was asked for
  Rigid3 planned_from_map;           // the map has moved on by so much since the grasps were planned
  std::vector<ActionResult> carries;
  ActionResult opens{ActionOutcome::kDone, ""};
  std::function<void(const TaskView&)> before_look;
  std::string silent;
  int silent_looks = 0;
  bool grip_answers = true, holding = false, slips = false, clearance_fits = true;
  int motions = 0;
  double clock = 0;
};

inline const TaskObject& object(const TaskResult& result, int model, int number) {
  return *std::find_if(result.objects.begin(), result.objects.end(), [&](const TaskObject& o) {
    return o.object.object == model && o.object.number == number;
  });
}

}  // namespace monocular_eye_hand::scripted
