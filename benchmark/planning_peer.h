#pragma once
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace monocular_eye_hand {

/// The boxes both planners see. Frames: -1 the base at the shoulder, i the i-th DH frame after joint i + 1.
struct BenchBox {
  int frame;
  Eigen::Vector3d centre, size;
};
const std::vector<BenchBox>& armBoxes();
const std::vector<BenchBox>& worldBoxes();

constexpr std::array<double, 6> kAlpha{{M_PI / 2, 0, -M_PI / 2, M_PI / 2, -M_PI / 2, 0}};
constexpr std::array<double, 6> kA{{0, 0.4318, 0.0203, 0, 0, 0}};
constexpr std::array<double, 6> kD{{0, 0, 0.15005, 0.4318, 0, 0}};

using BenchJoints = std::array<double, 6>;
/// After the i-th joint's turn: z along d, x along a.
Eigen::Isometry3d dhOffset(int i);
std::array<Eigen::Isometry3d, 6> dhFrames(const BenchJoints& q);

/// Whether no box of the arm touches the world (fcl::collide behind an AABB test), nor hand the base.
bool peerValid(const BenchJoints& q);
/// Of the process: OMPL's timer is a thread, whose waking up on a loaded machine is no part of the
/// comparison.
double cpuSeconds();
struct PeerTimes {
  bool found = false;
  double plan = 0, simplify = 0;  ///< CPU time [s]
  double length = 0;              ///< [rad]
};
/// og::SimpleSetup with RRTConnect and its defaults, then simplifySolution().
PeerTimes peerPlan(const BenchJoints& start, const BenchJoints& goal, const BenchJoints& low,
                   const BenchJoints& high);

}  // namespace monocular_eye_hand
