// Equal poses: reported once, named, and near the last frame's.
#include "monocular_eye_hand/geometry/covariance.h"
#include "support/pose_matchers.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

Rigid3 turnedAboutZ(double angle, const Eigen::Vector3d& point = Eigen::Vector3d::Zero()) {
  Rigid3 turn;
  turn.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  turn.translation = point - turn.rotation * point;
  return turn;
}

ObjectEstimate theOnly(const std::string& picture_name, const RecognitionRequest& request = {}) {
  const Picture picture = shippedPicture("golden/" + picture_name);
  const RecognitionResult result = shippedRecognizer().recognize(picture.grey, picture.camera, request);
  EXPECT_EQ(result.objects.size(), 1u) << listed(result);
  if (result.objects.empty()) return {};
  EXPECT_EQ(result.objects[0].name, picture_name);
  return result.objects[0];
}

TEST(EqualPoses, EachObjectIsReportedOnceAndSaysHowManyPosesAreEqual) {
  for (const auto& [name, count] : {std::pair{"bridge", 2}, {"frame", 4}}) {
    const ObjectEstimate object = theOnly(name);
    EXPECT_THAT(object.symmetry, HasSubstr(std::to_string(count) + " equal poses"));
    EXPECT_FALSE(object.free_axis);
    EXPECT_EQ(object.decision, Decision::kAccepted) << "an equal pose is no alternative: " << object.reason;
    // Alternatives are other poses, not equal ones.
    for (const Alternative& other : object.alternatives) {
      if (other.object != object.object) continue;
      const PoseError error =
          poseError(shippedModel(name), testCamera(), other.camera_from_object, object.camera_from_object);
      EXPECT_GT(error.image, 5);
    }
  }
  EXPECT_EQ(theOnly("grenade").symmetry, "");
}

TEST(EqualPoses, OfTheEqualOnesTheOneNearestToTheLastFrameIsReported) {
  for (const char* name : {"bridge", "frame"}) {
    const ObjectEstimate first = theOnly(name);
    for (const Rigid3& s : shippedModel(name).symmetries.discrete) {
      RecognitionRequest request;
      request.previous = {first};
      // Last frame: an equal pose, a little turned and moved.
      Vector6d step;
      step << 0.004, -0.003, 0.005, 0.05, -0.04, 0.06;
      request.previous[0].camera_from_object = perturbed(first.camera_from_object * s, step);
      const Rigid3 reported = theOnly(name, request).camera_from_object;
      EXPECT_LT(angleBetween(reported.rotation, first.camera_from_object.rotation * s.rotation), 1e-3);
      EXPECT_LT((reported.translation - (first.camera_from_object * s).translation).norm(), 1e-3);
    }
  }
}

TEST(EqualPoses, AnotherObjectOrOneFarAwayDoesNotChoose) {
  const ObjectEstimate first = theOnly("bridge");
  const Rigid3 other_way = first.camera_from_object * shippedModel("bridge").symmetries.discrete[1];
  RecognitionRequest request;
  request.previous = {first};
  request.previous[0].camera_from_object = other_way;
  request.previous[0].camera_from_object.translation.x() += 0.5;
  EXPECT_EQ(theOnly("bridge", request).camera_from_object.rotation, first.camera_from_object.rotation);
  request.previous[0].camera_from_object = other_way;
  request.previous[0].object = shippedModels().indexOf("frame");
  EXPECT_EQ(theOnly("bridge", request).camera_from_object.rotation, first.camera_from_object.rotation);
}

TEST(FreeAxis, IsNamedAndItsAngleIsUnknown) {
  const ObjectEstimate flange = theOnly("flange");
  EXPECT_TRUE(flange.free_axis);
  EXPECT_THAT(flange.symmetry, HasSubstr("free about the axis"));
  const SymmetryAxis& axis = shippedModel("flange").symmetries.axis.value();
  const Eigen::Vector3d free = flange.camera_from_object.rotation * axis.direction;
  const Eigen::Vector3d tilt = free.unitOrthogonal();
  const Eigen::Matrix3d rotation = flange.covariance.bottomRightCorner<3, 3>();
  const double about = std::sqrt(free.dot(rotation * free)), across = std::sqrt(tilt.dot(rotation * tilt));
  EXPECT_GT(about, 1) << "[rad]";
  EXPECT_LT(across, 0.03) << "the direction of the axis itself is seen";
}

TEST(FreeAxis, TheAngleOfTheLastFrameIsKept) {
  const ObjectEstimate first = theOnly("flange");
  const SymmetryAxis& axis = shippedModel("flange").symmetries.axis.value();

  for (double angle : {0.5, 2.0, -1.3, 3.1}) {
    RecognitionRequest request;
    request.previous = {first};
    const Rigid3 last = first.camera_from_object * turnedAboutZ(angle, axis.point);
    request.previous[0].camera_from_object = last;
    const ObjectEstimate again = theOnly("flange", request);
    const Rigid3& reported = again.camera_from_object;
    EXPECT_LT(angleBetween(reported.rotation, last.rotation), 1e-7) << angle;
    EXPECT_LT((reported.translation - last.translation).norm(), 1e-9) << angle;
    // The same image, as sure of the point that both origins turn about.
    const auto sigma = [&](const ObjectEstimate& o) {
      const Eigen::Vector3d arm = o.camera_from_object.rotation * axis.point;
      return propagate(adjointOfTranslation(arm), o.covariance).diagonal().head<3>().cwiseSqrt().eval();
    };
    EXPECT_LT((sigma(again) - sigma(first)).norm(), 1e-6 * sigma(first).norm()) << angle;
  }
}

TEST(NearestEqualPose, IsEqualAndTheNearest) {
  Rigid3 pose;
  pose.rotation = expSO3({0.3, -0.8, 1.1});
  pose.translation = {0.02, -0.05, 0.7};
  for (const char* name : {"bridge", "grenade", "frame", "bracket"}) {
    const ObjectModel& model = shippedModel(name);
    for (const Rigid3& s : model.symmetries.discrete) {
      Vector6d step;
      step << 0.01, 0, -0.01, 0.1, 0.2, -0.1;
      const Rigid3 wanted = perturbed(pose * s, step);
      EXPECT_THAT(pose * s, PoseNear(nearestEqualPose(model, pose, wanted), 1e-06, 6e-08)) << name;
    }
  }
  const ObjectModel& flange = shippedModel("flange");
  const Rigid3 wanted = pose * turnedAboutZ(1.234);
  EXPECT_LT(angleBetween(nearestEqualPose(flange, pose, wanted).rotation, wanted.rotation), 1e-6);
}

TEST(DescribeSymmetry, InWords) {
  Symmetries symmetries;
  EXPECT_EQ(describeSymmetry(symmetries), "");
  symmetries.discrete.push_back(turnedAboutZ(M_PI));
  EXPECT_EQ(describeSymmetry(symmetries), "2 equal poses");
  symmetries.axis = SymmetryAxis{{0, 0.25, 0}, {0, 0, 1}};
  EXPECT_EQ(describeSymmetry(symmetries),
            "free about the axis (0, 0, 1) through (0, 0.25, 0) m, 2 equal poses");
  symmetries.sphere = true;
  EXPECT_THAT(describeSymmetry(symmetries), HasSubstr("every orientation"));
}

}  // namespace
}  // namespace monocular_eye_hand
