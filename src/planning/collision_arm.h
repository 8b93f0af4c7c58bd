#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/mesh/solid.h"

namespace monocular_eye_hand {

/// A link with what makes testing it fast.
struct CollisionLink {
  std::string name;
  int parent = -1, joint = -1;
  Rigid3 parent_from_joint;
  double finger = 0;
  Eigen::Vector3d axis;
  bool about_z = false;
  bool fixed = true;  ///< never moves
  std::vector<Solid> solids;
  Rigid3 link_from_box;  ///< box around the solids, in the link's axes
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  double radius = 0;  ///< of the sphere about that box's centre
};

/// The arm of a CollisionWorld: poses of the links, and which of them are tested against each other.
class CollisionArm {
 public:
  explicit CollisionArm(const ArmDescription& arm);

  const std::vector<CollisionLink>& links() const { return links_; }
  const std::vector<std::pair<int, int>>& selfPairs() const { return self_pairs_; }
  /// base_from_links, parents first.
  void place(const JointVector& joints, double gripper_width, std::vector<Rigid3>* poses) const;
  Rigid3 baseFromTcp(const std::vector<Rigid3>& poses) const { return poses[tool0_] * tool0_from_tcp_; }
  double widthMax() const { return width_max_; }
  /// How far from the axis of each arm joint the arm's farthest point can be, and gripper_tcp [m].
  const std::array<double, 6>& reach() const { return reach_; }
  const std::array<double, 6>& tcpReach() const { return tcp_reach_; }

 private:
  void findReach();
  void findSelfPairs();

  std::vector<CollisionLink> links_;
  std::vector<std::pair<int, int>> self_pairs_;
  int tool0_ = 0;
  Rigid3 tool0_from_tcp_;
  double width_max_ = 0;
  std::array<double, 6> reach_{}, tcp_reach_{};
};

inline OrientedBox boxOf(const CollisionLink& link, const Rigid3& base_from_link, double padding) {
  return {base_from_link.rotation, base_from_link * link.link_from_box.translation,
          link.half.array() + padding};
}

}  // namespace monocular_eye_hand
