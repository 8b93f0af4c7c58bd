#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/simulation/cell/scene.h"
#include "monocular_eye_hand/simulation/cell/work_cell.h"

// The default cell with the shipped arm and parts, and a hand to drive it.
namespace monocular_eye_hand {

inline std::string sourcePath(const std::string& path) {
  return std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/" + path;
}

inline std::vector<NamedMesh> partMeshes() {
  std::vector<NamedMesh> models;
  for (const char* name : {"bridge", "grenade", "frame", "flange", "bracket"})
    models.push_back(
        {name, std::make_shared<Mesh>(loadMesh(sourcePath("models/" + std::string(name) + ".ply"), "mm"))});
  return models;
}

inline ArmDescription pumaDescription() { return loadArmDescription(sourcePath("urdf/puma560.urdf")); }

/// Joints that look at the frame from 0.5 m, a little aslant.
inline std::array<double, 6> lookJoints() { return {-0.032, 1.200, -3.1205, 0.277, -1.242, 1.446}; }

inline WorkCell makeCell(const CellOptions& options) {
  return WorkCell(makeCellScene(options, partMeshes()), pumaDescription());
}

/// tcp above (x, y) in the table's frame with its tip `z` over the table, z down, pads closing along `yaw`.
inline Rigid3 tableFromTcp(double x, double y, double z, double yaw) {
  Rigid3 pose;
  const Eigen::Vector3d closing(std::cos(yaw), std::sin(yaw), 0), down(0, 0, -1);
  pose.rotation << closing.cross(down), closing, down;
  pose.translation = {x, y, z};
  return pose;
}

/// Joints nearest to the present ones that put the tcp there.
inline JointVector jointsFor(const WorkCell& cell, const Rigid3& table_from_tcp) {
  const Rigid3 base_from_tool =
      cell.scene().base_from_table * table_from_tcp * cell.arm().tool0_from_tcp.inverse();
  ArmSolutions solutions;
  Puma560().inverse(base_from_tool, cell.joints(), &solutions);
  if (solutions.empty()) throw BadInput("test: the pose is out of reach");
  JointVector best = solutions[0].joints;
  for (const ArmSolution& solution : solutions)
    if ((solution.joints - cell.joints()).norm() < (best - cell.joints()).norm()) best = solution.joints;
  return best;
}

/// A smooth motion from rest to rest, slow enough for every joint.
inline void moveTo(WorkCell* cell, const JointVector& joints) {
  const double time = std::max(0.05, 1.6 * (joints - cell->joints()).cwiseAbs().maxCoeff());
  CellPathPoint goal;
  goal.time = time;
  goal.positions = joints;
  goal.velocities.assign(6, 0.0);
  cell->commandArm({goal});
  cell->advance(time + 0.02);
}

/// Straight to a tcp pose: in steps short enough that the path is nearly a line.
inline void moveStraight(WorkCell* cell, const Rigid3& from, const Rigid3& to, int steps = 8) {
  for (int k = 1; k <= steps; ++k) {
    Rigid3 between = to;
    between.translation = from.translation + (to.translation - from.translation) * k / steps;
    moveTo(cell, jointsFor(*cell, between));
  }
}

inline void closeGripper(WorkCell* cell, double width) {
  cell->commandGripper(width);
  cell->advance(1.0);
}

inline int countOf(const WorkCell& cell, CellEvent::Kind kind) {
  int count = 0;
  for (const CellEvent& event : cell.events()) count += event.kind == kind;
  return count;
}

inline std::string eventsOf(const WorkCell& cell) {
  std::string out;
  for (const CellEvent& e : cell.events())
    out += std::to_string(e.time) + " " + toString(e.kind) + " " + e.first + " " + e.second + " " + e.text +
           "\n";
  return out;
}

}  // namespace monocular_eye_hand
