#pragma once
#include <memory>
#include <string>
#include <vector>

#include "monocular_eye_hand/arm/arm_description.h"

namespace monocular_eye_hand {

/// Two named things that touch, or how near they are.
struct CollisionPair {
  std::string first, second;  ///< a link of the arm or the carried object; another link or a world object
  double distance = 0;        ///< between them [m]; below 0: depth of penetration
};

/// Where the arm can be: its links, what it carries and what stands around it, all with names. Links of the
/// arm have the names of the ArmDescription; world objects take any other. Everything is in base_link.
///
/// Boxes against boxes are tested by the separating axes (Gottschalk 1996), the rest by FCL behind spheres
/// and boxes around links. A mesh is a solid when it is closed. Not thread safe; a copy is cheap and
/// independent.
class CollisionWorld {
 public:
  /// Links that one joint connects, that are rigidly connected, or that touch in each of a seeded set of
  /// configurations are never tested against each other. Throws BadInput on an arm without links or shapes of
  /// no size.
  explicit CollisionWorld(const ArmDescription& arm);
  ~CollisionWorld();
  CollisionWorld(const CollisionWorld& other);
  CollisionWorld& operator=(const CollisionWorld& other);

  /// Throw BadInput on a name in use, a size that is not positive, a pose that is not finite, a mesh without
  /// triangles or with broken ones.
  void addBox(const std::string& name, const Eigen::Vector3d& size, const Rigid3& base_from_box);
  void addMesh(const std::string& name, const Mesh& mesh, const Rigid3& base_from_mesh);
  /// These throw BadInput when there is no such world object.
  void remove(const std::string& name);
  void move(const std::string& name, const Rigid3& base_from_object);
  Rigid3 pose(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  ///< of the world objects, in the order they were added

  /// The gripper takes the object: from now on it moves with gripper_tcp. It may touch the fingers.
  void attach(const std::string& name, const Rigid3& tcp_from_object);
  /// The gripper leaves the carried object there.
  void detach(const Rigid3& base_from_object);
  const std::string& carried() const;  ///< "" when nothing is

  /// Opening between the finger pads [m]; held to what the gripper can do.
  void setGripperWidth(double width);
  /// The arm is tested as if it were bigger by so much, against the world, not against itself [m].
  void setPadding(double padding);
  double padding() const;
  /// The same for the carried object.
  void setCarriedPadding(double padding);
  double carriedPadding() const;

  /// Names of links or objects that may touch. Throws BadInput on an unknown name.
  void allow(const std::string& a, const std::string& b);
  void forbid(const std::string& a, const std::string& b);
  bool allowed(const std::string& a, const std::string& b) const;
  const std::vector<std::string>& fingers() const;  ///< links that slide with the gripper's width

  /// No two things touch that must not. The joints are not tested against limits.
  bool valid(const JointVector& joints) const;
  /// The first pair that touches in the order of links and objects (padding counts as touching), with an
  /// empty first name when there is none. `distance` is that of the true shapes.
  CollisionPair firstCollision(const JointVector& joints) const;
  /// The nearest pair of true shapes that must not touch, an object of the world or a carried one among them
  /// (links of the arm pass each other within millimetres); an empty name when none is nearer than `limit`
  /// [m]. Slow.
  CollisionPair clearance(const JointVector& joints, double limit = 0.1) const;

  /// No point of the arm or the carried object moves further than this when the joints turn by `delta` [m].
  double motionBound(const JointVector& delta) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monocular_eye_hand
