#include "monocular_eye_hand/arm/load_arm_description.h"

#include <fmt/format.h>

#include <cmath>

#include "arm/urdf_model.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using Eigen::Vector3d;

const char* typeName(int type) {
  switch (type) {
    case urdf::Joint::REVOLUTE:
      return "revolute";
    case urdf::Joint::CONTINUOUS:
      return "continuous";
    case urdf::Joint::PRISMATIC:
      return "prismatic";
    case urdf::Joint::FLOATING:
      return "floating";
    case urdf::Joint::PLANAR:
      return "planar";
    case urdf::Joint::FIXED:
      return "fixed";
    default:
      return "of unknown type";
  }
}

/// 0 to 5 for joint1 to joint6, else -1.
int armJoint(const std::string& name) {
  return name.size() == 6 && name.compare(0, 5, "joint") == 0 && name[5] >= '1' && name[5] <= '6'
             ? name[5] - '1'
             : -1;
}

class Loader {
 public:
  explicit Loader(const std::string& path) : path_(path), model_(readUrdf(path)) {}

  ArmDescription load() {
    if (model_->getRoot()->name != "base_link")
      throw BadInput("the root link is '" + model_->getRoot()->name + "', it must be base_link");
    add(*model_->getRoot(), -1);
    for (const char* name : {"tool0", "gripper_tcp", "camera_optical_frame"}) arm_.link(name);
    checkChain();
    const std::vector<Rigid3> poses = arm_.baseFromLinks(JointVector::Zero(), 0);
    const Rigid3 tool0_from_base = poses[size_t(arm_.link("tool0"))].inverse();
    arm_.tool0_from_tcp = tool0_from_base * poses[size_t(fixedToTool("gripper_tcp"))];
    arm_.tool0_from_camera = tool0_from_base * poses[size_t(fixedToTool("camera_optical_frame"))];
    readFingers(poses);
    return std::move(arm_);
  }

 private:
  void add(const urdf::Link& link, int parent) {
    ArmLink out;
    out.name = link.name;
    out.parent = parent;
    if (link.parent_joint) readJoint(*link.parent_joint, &out);
    try {
      readShapes(link, path_, &out);
    } catch (const BadInput& e) {
      throw BadInput("link " + link.name + ": " + e.what());
    }
    const int index = int(arm_.links.size());
    arm_.links.push_back(std::move(out));
    for (const auto& child : link.child_links) add(*child, index);
  }

  void readJoint(const urdf::Joint& joint, ArmLink* out) {
    out->parent_from_joint = toRigid(joint.parent_to_joint_origin_transform);
    const Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
    const int number = armJoint(joint.name);
    if (number >= 0) {
      requireType(joint, urdf::Joint::REVOLUTE);
      out->joint = number;
    } else if (joint.type == urdf::Joint::PRISMATIC) {
      fingers_.push_back({&joint, int(arm_.links.size())});
    } else if (joint.type != urdf::Joint::FIXED) {
      throw BadInput("joint " + joint.name + " is " + typeName(joint.type) +
                     "; only joint1 to joint6 and two prismatic finger joints may move");
    }
    if (joint.type == urdf::Joint::FIXED) return;
    if (!(axis.norm() > 1e-9)) throw BadInput("joint " + joint.name + " has no axis");
    out->axis = axis.normalized();
  }

  void requireType(const urdf::Joint& joint, int type) const {
    if (joint.type != type)
      throw BadInput("joint " + joint.name + " is " + typeName(joint.type) + ", it must be " +
                     typeName(type));
  }

  /// joint1 to joint6 in this order between base_link and tool0, each once.
  void checkChain() const {
    int expected = 5;
    for (int i = arm_.link("tool0"); i >= 0; i = arm_.links[size_t(i)].parent) {
      const ArmLink& link = arm_.links[size_t(i)];
      if (isFinger(i)) throw BadInput("tool0 hangs from a finger");
      if (link.joint < 0) continue;
      if (link.joint != expected)
        throw BadInput(fmt::format("between base_link and tool0, joint{} stands where joint{} must be",
                                   link.joint + 1, expected + 1));
      --expected;
    }
    if (expected >= 0)
      throw BadInput(fmt::format("joint{} is missing between base_link and tool0", expected + 1));
  }

  bool isFinger(int link) const {
    for (const Finger& finger : fingers_)
      if (finger.link == link) return true;
    return false;
  }

  /// Nearest link upwards that a joint moves; -1 when none does.
  int carrier(int link) const {
    while (link >= 0 && arm_.links[size_t(link)].joint < 0 && !isFinger(link))
      link = arm_.links[size_t(link)].parent;
    return link;
  }

  int fixedToTool(const std::string& name) const {
    const int link = arm_.link(name);
    if (carrier(link) != carrier(arm_.link("tool0")))
      throw BadInput("link " + name + " is not fixed to tool0");
    return link;
  }

  void readFingers(const std::vector<Rigid3>& poses) {
    if (fingers_.size() != 2)
      throw BadInput(fmt::format("there are {} prismatic joints, the gripper needs two", fingers_.size()));

    const bool second_mimics = bool(fingers_[1].joint->mimic);
    const Finger& leader = fingers_[second_mimics ? 0 : 1];
    const Finger& follower = fingers_[second_mimics ? 1 : 0];
    const auto& mimic = follower.joint->mimic;
    if (!mimic || mimic->joint_name != leader.joint->name)
      throw BadInput("one of the joints " + leader.joint->name + " and " + follower.joint->name +
                     " must mimic the other");
    if (!(mimic->multiplier > 0) || mimic->offset != 0)
      throw BadInput("joint " + follower.joint->name +
                     " must mimic with a multiplier above 0 and the offset 0");
    if (!leader.joint->limits || leader.joint->limits->lower != 0 || !(leader.joint->limits->upper > 0))
      throw BadInput("joint " + leader.joint->name +
                     " must have the lower limit 0 (closed) and an upper one above 0");

    const double a = sideways(leader, poses), b = sideways(follower, poses);
    if (!(std::abs(std::abs(a) - 1) < 1e-6 && std::abs(a + b) < 1e-6))
      throw BadInput("the finger joints must open along y of gripper_tcp, in opposite directions");

    const double total = 1 + mimic->multiplier;
    arm_.links[size_t(leader.link)].finger = 1 / total;
    arm_.links[size_t(follower.link)].finger = mimic->multiplier / total;
    arm_.gripper_width_max = leader.joint->limits->upper * total;
  }

  struct Finger {
    const urdf::Joint* joint;
    int link;
  };

  /// Share of the finger's motion along y of gripper_tcp.
  double sideways(const Finger& finger, const std::vector<Rigid3>& poses) const {
    const Vector3d y = poses[size_t(arm_.link("gripper_tcp"))].rotation.col(1);
    return y.dot(poses[size_t(finger.link)].rotation * arm_.links[size_t(finger.link)].axis);
  }

  const std::string path_;
  const urdf::ModelInterfaceSharedPtr model_;
  ArmDescription arm_;
  std::vector<Finger> fingers_;
};

}  // namespace

ArmDescription loadArmDescription(const std::string& urdf_path) {
  try {
    return Loader(urdf_path).load();
  } catch (const BadInput& e) {
    const std::string what = e.what();
    throw BadInput(what.compare(0, urdf_path.size(), urdf_path) == 0 ? what : urdf_path + ": " + what);
  }
}

void requireSameArm(const ArmDescription& description, const Puma560& arm) {
  const int tool0 = description.link("tool0");
  for (int k = 0; k < 8; ++k) {
    JointVector q;
    for (int i = 0; i < 6; ++i) q[i] = 0.37 * (k * (i + 1) % 7);  // away from symmetric configurations
    const Vector6d d = difference(arm.baseFromTool0(q), description.baseFromLinks(q, 0)[size_t(tool0)]);
    if (!(d.cwiseAbs().maxCoeff() < 1e-6))
      throw BadInput(
          fmt::format("the URDF's tool0 is {:.2f} mm and {:.4f} rad from the arm's; make the lengths of the "
                      "URDF and the arm's options equal",
                      1e3 * d.head<3>().norm(), d.tail<3>().norm()));
  }
}

}  // namespace monocular_eye_hand
