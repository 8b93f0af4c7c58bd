#pragma once
#include <string>

namespace monocular_eye_hand {

// Defaults of the planner stand here and nowhere else. check() throws BadInput naming field, value and rule.

/// How a free path in joint space is searched.
struct PathOptions {
  int budget = 60000;        ///< joint vectors tested for one path before it is given up
  double resolution = 0.06;  ///< step along an edge while searching [rad], Euclidean over the six joints
  double range = 2.4;        ///< longest edge of the tree [rad]
  int shortcuts = 40;        ///< tries to shorten the path
  int seed = 1;              ///< of every random choice

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("budget", budget);
    v("resolution", resolution);
    v("range", range);
    v("shortcuts", shortcuts);
    v("seed", seed);
  }
};

/// How a straight line of gripper_tcp becomes joint vectors.
struct CartesianOptions {
  double deviation = 2e-4;           ///< of gripper_tcp from the straight line between two joint vectors [m]
  double rotation_deviation = 2e-3;  ///< of its orientation [rad]
  double max_step = 0.03;            ///< between two joint vectors [m]
  double max_rotation = 0.15;        ///< between two joint vectors [rad]
  double joint_jump = 0.35;          ///< a joint that turns further within one step has jumped [rad]
  double min_singularity =
      2e-2;  ///< least |sin q5| and, in metres, distance from shoulder and elbow singularity

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("deviation", deviation);
    v("rotation_deviation", rotation_deviation);
    v("max_step", max_step);
    v("max_rotation", max_rotation);
    v("joint_jump", joint_jump);
    v("min_singularity", min_singularity);
  }
};

/// How a path becomes a trajectory.
struct TimingOptions {
  double speed = 1.0;         ///< share of the joints' speed limits, (0, 1]
  double acceleration = 1.0;  ///< share of their acceleration limits, (0, 1]
  double tool_speed = 0.5;    ///< of gripper_tcp [m/s]
  double corner = 0.03;       ///< a corner may be cut by so much [rad], Euclidean over the six joints

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("speed", speed);
    v("acceleration", acceleration);
    v("tool_speed", tool_speed);
    v("corner", corner);
  }
};

/// Everything planPick() can be told.
struct PlanningOptions {
  double padding = 0.003;        ///< the arm keeps so far from everything on free paths [m]
  double near_padding = 0.0005;  ///< the same on the straight lines to and from an object [m]
  double near_speed = 0.2;       ///< of gripper_tcp on those lines [m/s]
  int candidates = 24;           ///< joint solutions tried per pose, cheapest first
  PathOptions path;
  CartesianOptions cartesian;
  TimingOptions timing;

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("padding", padding);
    v("near_padding", near_padding);
    v("near_speed", near_speed);
    v("candidates", candidates);
    v("path", path);
    v("cartesian", cartesian);
    v("timing", timing);
  }
};

}  // namespace monocular_eye_hand
