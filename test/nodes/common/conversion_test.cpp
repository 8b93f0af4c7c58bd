#include <gtest/gtest.h>
#include <tf2/LinearMath/Transform.h>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "nodes/common/conversion.h"

namespace monocular_eye_hand {
namespace {

Rigid3 somePose() { return {expSO3({0.4, -1.1, 0.7}), {0.12, -0.34, 0.56}}; }

tf2::Transform toTf(const geometry_msgs::Pose& pose) {
  return tf2::Transform(
      tf2::Quaternion(pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w),
      tf2::Vector3(pose.position.x, pose.position.y, pose.position.z));
}

ModelBase oneObject() {
  ModelBase models;
  KnownObject known;
  known.model.name = "bridge";
  models.objects.push_back(known);
  known.model.name = "frame";
  models.objects.push_back(known);
  return models;
}

// camera_from_object maps a point of the object to the camera as tf's transform of the same pose does.
TEST(Conversion, PoseMapsPointsAsTfDoes) {
  const Rigid3 camera_from_object = somePose();
  const tf2::Transform tf = toTf(toPose(camera_from_object));
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-4, 0.5, 9)}) {
    const tf2::Vector3 q = tf * tf2::Vector3(p.x(), p.y(), p.z());
    const Eigen::Vector3d expected = camera_from_object * p;
    EXPECT_NEAR((Eigen::Vector3d(q.x(), q.y(), q.z()) - expected).norm(), 0, 1e-12);
  }
}

// Products and inverses too: neighbours cancel in the same order.
TEST(Conversion, ProductsAsTf) {
  const Rigid3 base_from_camera{expSO3({-0.2, 0.9, 2.0}), {1, 2, 3}}, camera_from_object = somePose();
  const tf2::Transform tf = toTf(toPose(base_from_camera)) * toTf(toPose(camera_from_object)).inverse();
  const Rigid3 expected = base_from_camera * camera_from_object.inverse();
  const tf2::Vector3 t = tf.getOrigin();
  EXPECT_NEAR((Eigen::Vector3d(t.x(), t.y(), t.z()) - expected.translation).norm(), 0, 1e-12);
  for (int row = 0; row < 3; ++row)
    for (int col = 0; col < 3; ++col)
      EXPECT_NEAR(tf.getBasis()[row][col], expected.rotation(row, col), 1e-12);
}

TEST(Conversion, PoseThereAndBack) {
  const Rigid3 pose = somePose();
  EXPECT_NEAR(difference(pose, fromPose(toPose(pose))).norm(), 0, 1e-12);
  geometry_msgs::Pose longer = toPose(pose);  // a quaternion that is not of unit length
  longer.orientation.x *= 3;
  longer.orientation.y *= 3;
  longer.orientation.z *= 3;
  longer.orientation.w *= 3;
  EXPECT_NEAR(difference(pose, fromPose(longer)).norm(), 0, 1e-12);
}

TEST(Conversion, TransformIsThePose) {
  std_msgs::Header header;
  header.frame_id = "camera_optical";
  header.stamp = ros::Time(12, 34);
  const geometry_msgs::TransformStamped transform = toTransform(header, "bridge_0", somePose());
  const geometry_msgs::Pose pose = toPose(somePose());
  EXPECT_EQ(transform.header.frame_id, "camera_optical");
  EXPECT_EQ(transform.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(transform.child_frame_id, "bridge_0");
  EXPECT_EQ(transform.transform.translation.x, pose.position.x);
  EXPECT_EQ(transform.transform.translation.y, pose.position.y);
  EXPECT_EQ(transform.transform.translation.z, pose.position.z);
  EXPECT_EQ(transform.transform.rotation, pose.orientation);
}

// geometry_msgs/PoseWithCovariance: row-major, x, y, z, rotation about x, y, z, fixed axes. A pose moved by d
// as the core means it is the pose rotated about the fixed axes of the header's frame as tf means it.
TEST(Conversion, CovarianceOrderAndAxes) {
  Matrix6d covariance;
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) covariance(row, col) = 10 * row + col;
  const geometry_msgs::PoseWithCovariance pose = toPose(somePose(), covariance);
  for (size_t row = 0; row < 6; ++row)
    for (size_t col = 0; col < 6; ++col) EXPECT_EQ(pose.covariance[row * 6 + col], double(10 * row + col));

  const tf2::Vector3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    Vector6d d = Vector6d::Zero();
    d[axis] = 0.05;
    d[3 + axis] = 0.3;
    const tf2::Transform moved = toTf(toPose(perturbed(somePose(), d)));
    const tf2::Transform before = toTf(toPose(somePose()));
    const tf2::Transform expected(tf2::Quaternion(axes[axis], 0.3) * before.getRotation(),
                                  before.getOrigin() + 0.05 * axes[axis]);
    EXPECT_NEAR((moved.getOrigin() - expected.getOrigin()).length(), 0, 1e-12);
    EXPECT_NEAR(moved.getRotation().angleShortestPath(expected.getRotation()), 0, 1e-6);
  }
}

TEST(Conversion, MessageCarriesEveryField) {
  ObjectEstimate object;
  object.object = 0;
  object.name = "bridge";
  object.camera_from_object = somePose();
  object.covariance = Matrix6d::Identity() * 0.5;
  object.plausibility = 0.1;
  object.reliability = 0.2;
  object.probability = 0.3;
  object.decision = Decision::kAmbiguous;
  object.alternatives.push_back({1, Rigid3{}, 0.25});
  object.matched_features = 4;
  object.expected_features = 5;
  object.bounding_box = cv::Rect(-10, 20, 50, 60);
  object.symmetry = "2 equal poses";
  object.free_axis = true;
  object.reason = "why";

  std_msgs::Header header;
  header.frame_id = "camera";
  const RecognizedObject message = toMessage(header, object, 3, oneObject());

  EXPECT_EQ(message.header.frame_id, "camera");
  EXPECT_EQ(message.name, "bridge");
  EXPECT_EQ(message.instance, 3);
  EXPECT_EQ(message.pose.pose, toPose(somePose()));
  EXPECT_EQ(message.pose.covariance[7], 0.5);
  EXPECT_EQ(message.plausibility, 0.1);
  EXPECT_EQ(message.reliability, 0.2);
  EXPECT_EQ(message.probability, 0.3);
  EXPECT_EQ(message.decision, RecognizedObject::AMBIGUOUS);
  ASSERT_EQ(message.alternatives.size(), 1u);
  EXPECT_EQ(message.alternatives[0].name, "frame");
  EXPECT_EQ(message.alternatives[0].probability, 0.25);
  EXPECT_EQ(message.matched_features, 4);
  EXPECT_EQ(message.expected_features, 5);
  EXPECT_EQ(message.bounding_box.x_offset, 0u);  // clipped: the message has no negative pixels
  EXPECT_EQ(message.bounding_box.width, 40u);
  EXPECT_EQ(message.bounding_box.y_offset, 20u);
  EXPECT_EQ(message.bounding_box.height, 60u);
  EXPECT_EQ(message.symmetry, "2 equal poses");
  EXPECT_TRUE(message.free_axis);
  EXPECT_EQ(message.reason, "why");
}

TEST(Conversion, DecisionsKeepTheirMeaning) {
  ObjectEstimate object;
  object.object = 0;
  const auto decision = [&](Decision value) {
    object.decision = value;
    return toMessage(std_msgs::Header(), object, 0, oneObject()).decision;
  };
  EXPECT_EQ(decision(Decision::kAccepted), RecognizedObject::ACCEPTED);
  EXPECT_EQ(decision(Decision::kAmbiguous), RecognizedObject::AMBIGUOUS);
  EXPECT_EQ(decision(Decision::kRejected), RecognizedObject::REJECTED);
}

TEST(ObjectFrame, PrefixNameAndNumber) {
  EXPECT_EQ(objectFrame("", "bridge", 0), "bridge_0");
  EXPECT_EQ(objectFrame("left/", "hand grenade (old)", 12), "left/hand_grenade__old__12");
}

}  // namespace
}  // namespace monocular_eye_hand
