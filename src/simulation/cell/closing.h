#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/simulation/cell/gripper.h"
#include "simulation/cell/collision.h"

namespace monocular_eye_hand {

/// What the gripper may touch.
struct CellBodies {
  std::vector<SceneObject>* objects;
  const std::vector<bool>* fixed;
  const std::vector<bool>* absent;  ///< in the air: not between the pads
  CellSolids* solids;
};

/// The gripper's opening over time, and what stops it.
class CellGripper {
 public:
  CellGripper(const GripperPads& pads, double width, double speed, double friction, double compliance)
      : pads_(pads),
        width_(width),
        target_(width),
        speed_(speed),
        friction_(friction),
        compliance_(compliance) {}

  void command(double width, double speed) {
    target_ = width;
    speed_ = speed;
  }

  struct Outcome {
    int grasped = -1, slipped = -1, released = -1;  ///< objects; what happened in this step
    std::string reason;                             ///< why `slipped` is not held
    int jammed = -1, against = -1;                  ///< a pushed object and what it met (CellSolids ids)
    bool pushed = false;                            ///< some object was moved
  };
  Outcome step(double dt, const Rigid3& world_from_tcp, const CellBodies& bodies);
  /// The object is between the pads no longer: they close on.
  void lose(int object);

  double width() const { return width_; }
  double velocity() const { return velocity_; }
  double target() const { return target_; }
  bool stalled() const { return stalled_by_ >= 0 || held_ >= 0; }
  int held() const { return held_; }
  const Rigid3& tcpFromHeld() const { return tcp_from_held_; }

 private:
  struct Stop {
    double width;
    std::string reason;  // not held because; empty: held
  };
  double close(double next, const Rigid3& world_from_tcp, const CellBodies& bodies, Outcome* outcome);
  Stop meet(int object, double next, const Rigid3& world_from_tcp, const CellBodies& bodies,
            Outcome* outcome);
  bool push(int object, double along_y, const Rigid3& world_from_tcp, const CellBodies& bodies,
            Outcome* outcome) const;

  GripperPads pads_;
  double width_, target_, speed_, friction_, compliance_;
  double velocity_ = 0;
  double open_ = 0;  // opened so far since the part was held
  int held_ = -1, stalled_by_ = -1;
  int compliant_to_ = -1;        // object to which the pads give way ...
  double compliance_shift_ = 0;  // ... as if it had moved so far along y [m]
  Rigid3 tcp_from_held_;
};

}  // namespace monocular_eye_hand
