#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/task/world.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else.
struct ClearFrameOptions {
  std::string frame = "frame";  ///< name of the object to be cleared; "": the whole table
  double frame_margin = 0.02;   ///< an object counts as inside up to so far outside the frame's border [m]
  int overviews = 3;            ///< views of the whole frame in the first round
  int overviews_again = 1;      ///< the same in every further round
  int searches = 4;             ///< nearer views of the frame before it counts as cleared
  int look_attempts = 3;        ///< a view that fails so often in a row ends the task
  double retry_wait = 2;        ///< before it is tried again; twice as long before every further time [s]
  int doubtful_looks = 2;       ///< looks in a row that did not show what one view alone showed: a doubt
  int doubtful_misses = 2;      ///< views in a row that did not show an object: it does not count any more
  int confirm_views = 2;        ///< an object that so many views agree on ...
  double confirm_probability = 0.8;  ///< ... and make so likely is picked without a near look
  int near_looks = 3;                ///< per object and round, until its pose is sure enough
  int confirm_attempts = 2;          ///< near looks that do not show an object before it is given up
  int blocked_rounds = 2;  ///< rounds in which it cannot be grasped or reached before it is given up
  int pick_attempts = 3;   ///< lost grasps of one object before it is given up
  int candidates = 6;      ///< grasps handed to the planner per attempt
  int max_rounds = 40;     ///< looks around the frame in all

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("frame", frame);
    v("frame_margin", frame_margin);
    v("overviews", overviews);
    v("overviews_again", overviews_again);
    v("searches", searches);
    v("doubtful_misses", doubtful_misses);
    v("look_attempts", look_attempts);
    v("retry_wait", retry_wait);
    v("doubtful_looks", doubtful_looks);
    v("confirm_views", confirm_views);
    v("confirm_probability", confirm_probability);
    v("near_looks", near_looks);
    v("confirm_attempts", confirm_attempts);
    v("blocked_rounds", blocked_rounds);
    v("pick_attempts", pick_attempts);
    v("candidates", candidates);
    v("max_rounds", max_rounds);
  }
};

enum class TaskStage { kLook, kChoose, kConfirm, kPick, kVerify, kCarry, kDone };
std::string toString(TaskStage stage);

enum class TaskOutcome {
  kCleared,    ///< nothing known is left in the frame; what one view alone showed is told as a doubt
  kLeftovers,  ///< something is, each with its reason
  kNoFrame,    ///< the frame was not found
  kCancelled,
  kFault  ///< camera, recognition, eye-hand, planner or gripper does not answer
};
std::string toString(TaskOutcome outcome);

enum class ObjectOutcome {
  kWaiting,  ///< its turn did not come
  kCarried,
  kGone,     ///< was there and is not any more, by no doing of the task
  kLeft,     ///< given up, see the reason
  kHeld,     ///< still in the gripper
  kDropped,  ///< lost on the way
  kDoubt     ///< one view showed it and no later look did: most likely it was never there
};
std::string toString(ObjectOutcome outcome);

struct TaskObject {
  MappedObject object;  ///< as last known
  ObjectOutcome outcome = ObjectOutcome::kWaiting;
  std::string reason;
  int picks = 0;       ///< attempts that moved the gripper to it
  int near_looks = 0;  ///< in all
};

struct TaskFeedback {
  TaskStage stage = TaskStage::kLook;
  std::string object;  ///< "bridge 0"; "" when it concerns none
  int round = 0;
  int carried = 0, left = 0;  ///< left: known in the frame and not given up
  std::string text;           ///< for people
};

struct TaskResult {
  TaskOutcome outcome = TaskOutcome::kFault;
  std::string reason;
  std::vector<TaskObject> objects;  ///< every object ever seen in the frame, in the order of appearance
  int rounds = 0;
};

/// Clears the frame: look, choose, confirm from near, pick, verify, carry, look again, until no known object
/// is left in the frame. A plain state machine: no threads, no clock; every retry is bounded.
///
/// Nothing is picked that the last look did not show, on which fewer than confirm_views views agree and no
/// near look, or whose pose is too uncertain for the gripper: then it looks from nearer, and in the end says
/// why not.
class ClearFrameTask {
 public:
  /// Keeps the pointers. `cancelled` is asked before every stage. Throws BadInput on an option out of range
  /// and when `options.frame` is not in the model base.
  ClearFrameTask(const ModelBase* models, TaskWorld* world, const ClearFrameOptions& options = {},
                 std::function<bool()> cancelled = {},
                 std::function<void(const TaskFeedback&)> feedback = {});

  /// One stage; false when the task is done. An exception of the world ends the task as a fault.
  bool step();
  TaskResult run();  ///< step() until done

  TaskStage stage() const { return stage_; }
  const TaskResult& result() const { return result_; }

 private:
  using Key = std::pair<int, int>;  // object, number
  struct Progress {
    size_t index = 0;  // result_.objects
    int near_looks = 0, unconfirmed = 0;
    int sought = 0;       // near looks for it since it is gone
    int reopened = 0;     // times that a look showed it surely after it was given up unconfirmed
    int unseen = 0;       // looks in a row that did not show it
    std::string blocked;  // why there is no grasp as things stand: other objects may be in the way
    int blocked_rounds = 0;
    int set_aside = 0;  // the round in which the others go first, since no grasp of it has a path
  };
  void lookAround();
  void search();
  void choose();
  void confirm();
  void judgeNearLook(const Key& key, double stamp);
  void doubted();
  bool confirmed(const MappedObject& object) const;  // by views that agree
  bool sure(const Key& key);
  GraspPlan prepareGrasps(const MappedObject& object);  // fills candidates_
  void pick();
  void setAside(const Key& key, const std::string& reason);
  void verify();
  void carry();

  bool look(const TaskView& view, TaskLook* seen);
  void learn(const TaskLook& seen);
  bool shownAfterAll(const Progress& progress, double stamp) const;
  std::optional<Key> missedObject() const;
  void learnFrame();
  bool inFrame(const MappedObject& object) const;
  const MappedObject* known(const Key& key) const;
  std::vector<Key> waiting() const;
  TaskObject& entry(const Key& key) { return result_.objects[progress_.at(key).index]; }
  void giveUp(const Key& key, const std::string& reason);
  bool inDoubt(const TaskObject& object) const;
  void settleDoubts();
  void lostGrasp(const std::string& reason);
  void stopped(const ActionResult& result);
  bool opened();
  void startRound();
  void finish(TaskOutcome outcome, const std::string& reason);
  void finishRound();
  void reportProgress(const std::string& text);

  const ModelBase* models_;
  TaskWorld* world_;
  ClearFrameOptions options_;
  std::function<bool()> cancelled_;
  std::function<void(const TaskFeedback&)> feedback_;
  int frame_ = -1;  // ModelBase::objects

  TaskStage stage_ = TaskStage::kLook;
  TaskResult result_;
  std::vector<MappedObject> map_;
  std::optional<MappedObject> frame_pose_;
  std::map<Key, Progress> progress_;
  std::optional<Key> chosen_;
  std::vector<PlannedGrasp> candidates_;
  int overview_ = 0, failed_looks_ = 0, carried_ = 0;
  int searches_ = 0;        // since something was carried out
  bool searching_ = false;  // the next look is one
  int doubts_ = 0;          // near looks of this round that showed something else
  int direction_ = 0;       // goes on when a direction has shown something wrong
  double last_look_ = -1;   // its stamp [s]
};

}  // namespace monocular_eye_hand
