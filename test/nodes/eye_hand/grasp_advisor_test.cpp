#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/eye_hand/grasp_advisor.h"
#include "nodes/eye_hand/grasp_arrows.h"
#include "nodes/eye_hand/setup.h"

namespace monocular_eye_hand {
namespace {

using Response = GraspTargets::Response;
using testing::HasSubstr;
using visualization_msgs::Marker;

constexpr double kTable = 0.3;  // [m]

EyeHandParameters someParameters() {
  EyeHandParameters parameters;
  parameters.objects = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/objects.yaml";
  parameters.urdf = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/urdf/puma560.urdf";
  parameters.table_height = kTable;
  return parameters;
}

class Advisor : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    parameters_ = new EyeHandParameters(someParameters());
    models_ = new ModelBase(loadShapes(parameters_->objects));
    arm_ = new Puma560(parameters_->arm);
    advisor_ =
        new GraspAdvisor(*models_, *parameters_, *arm_, loadSameArm(*parameters_, *arm_).tool0_from_tcp);
  }
  static void TearDownTestSuite() {
    delete advisor_;
    delete arm_;
    delete models_;
    delete parameters_;
  }

  // The map after one view of these, each with the same sigma of its pose.
  struct Placed {
    std::string name;
    double x, y, yaw;
  };
  static KnownObjects known(const std::vector<Placed>& placed, double sigma = 1e-4) {
    SharedMap map(*models_, parameters_->map, "base_link");
    ObjectView view;
    view.stamp = 100;
    view.camera.width = 640;
    view.camera.height = 480;
    view.camera.fx = view.camera.fy = 600;
    view.camera.cx = 320;
    view.camera.cy = 240;
    view.hand = handPose(*arm_, ready().joints);
    const Rigid3 camera_from_base = view.hand.base_from_tool0.inverse();
    for (const Placed& one : placed) {
      SeenObject seen;
      seen.object = models_->indexOf(one.name);
      seen.camera_from_object = camera_from_base * Rigid3{expSO3({0, 0, one.yaw}), {one.x, one.y, kTable}};
      seen.covariance.diagonal().setConstant(sigma * sigma);
      view.objects.push_back(seen);
    }
    EXPECT_EQ(map.add(view, ros::Time(100)).report.refused, "");
    return map.known();
  }
  static ArmNow ready() {
    ArmNow arm;
    arm.joints << 0, 0.9, -2.6, 0, -1.44, 0;
    return arm;
  }
  static Response ask(const KnownObjects& known, const std::string& name, int instance = -1,
                      const ArmNow& arm = ready()) {
    GraspTargets::Request request;
    request.name = name;
    request.instance = instance;
    return advisor_->answer(request, known, arm);
  }

  static EyeHandParameters* parameters_;
  static ModelBase* models_;
  static Puma560* arm_;
  static GraspAdvisor* advisor_;
};
EyeHandParameters* Advisor::parameters_;
ModelBase* Advisor::models_;
Puma560* Advisor::arm_;
GraspAdvisor* Advisor::advisor_;

TEST_F(Advisor, Found) {
  const Response found = ask(known({{"bridge", 0.6, -0.1, 0.3}}), "bridge");
  ASSERT_EQ(found.status, Response::FOUND) << found.text;
  ASSERT_FALSE(found.targets.empty());
  for (const GraspTarget& target : found.targets) {
    EXPECT_TRUE(target.feasible);
    EXPECT_EQ(target.header.stamp, ros::Time(100));
    EXPECT_GT(target.grasp.position.z, kTable);
  }
}

TEST_F(Advisor, AnyInstanceIsTheOneWithTheBestGrasp) {
  const KnownObjects two = known({{"bridge", 0.6, -0.1, 0.3}, {"bridge", 0.55, 0.25, 1.2}});
  const Response first = ask(two, "bridge", 0), second = ask(two, "bridge", 1), any = ask(two, "bridge");
  ASSERT_EQ(first.status, Response::FOUND) << first.text;
  ASSERT_EQ(second.status, Response::FOUND) << second.text;
  const Response& better = first.targets[0].quality >= second.targets[0].quality ? first : second;
  EXPECT_EQ(any.targets, better.targets);
  EXPECT_EQ(any.text, better.text);
}

TEST_F(Advisor, EveryAnswer) {
  const KnownObjects bridge = known({{"bridge", 0.6, -0.1, 0.3}, {"frame", 0.6, 0.3, 0}});
  const auto expect = [](const Response& response, uint8_t status, const std::string& text) {
    EXPECT_EQ(int(response.status), int(status)) << response.text;
    EXPECT_THAT(response.text, HasSubstr(text));
    EXPECT_TRUE(response.targets.empty());
  };
  expect(ask(bridge, "spoon"), Response::UNKNOWN_NAME, "'spoon'; known: bridge");
  expect(ask(bridge, ""), Response::UNKNOWN_NAME, "''");
  expect(ask(bridge, "frame"), Response::NO_GRASP, "frame is an obstacle");
  expect(ask(bridge, "grenade"), Response::NOT_KNOWN, "no grenade is known; known now: bridge 0, frame 0");
  expect(ask(bridge, "bridge", 1), Response::NOT_KNOWN, "no bridge 1 is known");
  expect(ask(known({}), "bridge"), Response::NOT_KNOWN, "nothing is known now");
  expect(ask(known({{"bridge", 0.6, 1.5, 0}}), "bridge"), Response::NO_GRASP, "bridge 0: ");
  expect(ask(known({{"bridge", 0.6, -0.1, 0.3}}, 0.01), "bridge"), Response::TOO_UNCERTAIN, "bridge 0: ");
  expect(ask(KnownObjects(), "bridge"), Response::NOT_READY, "no view was received yet");
  KnownObjects refused;
  refused.refused = "the camera hangs loose";
  expect(ask(refused, "bridge"), Response::NOT_READY, "the last one: the camera hangs loose");
  ArmNow lost;
  lost.problem = "no joint states";
  expect(ask(bridge, "bridge", -1, lost), Response::NOT_READY, "no joint states");
}

// Also an object that is never grasped, and another one of the same name, are in the way.
TEST_F(Advisor, OtherObjectsAreObstacles) {
  const KnownObjects alone = known({{"bridge", 0.6, -0.1, 0}});
  const KnownObjects crowded = known({{"bridge", 0.6, -0.1, 0},
                                      {"bridge", 0.6, -0.145, 0},
                                      {"bridge", 0.6, -0.055, 0},
                                      {"bridge", 0.725, -0.1, 0},
                                      {"bridge", 0.475, -0.1, 0}});
  const Response free = ask(alone, "bridge", 0), blocked = ask(crowded, "bridge", 0);
  ASSERT_EQ(free.status, Response::FOUND) << free.text;
  EXPECT_LT(blocked.targets.size(), free.targets.size());
}

TEST_F(Advisor, BestOfEachThatMayBeGrasped) {
  const KnownObjects objects =
      known({{"bridge", 0.6, -0.1, 0.3}, {"frame", 0.3, 0.5, 0}, {"grenade", 0.6, 1.5, 0}});
  const GraspTargetArray best = advisor_->best(objects, ready());
  EXPECT_EQ(best.header.stamp, ros::Time(100));
  EXPECT_EQ(best.header.frame_id, "base_link");
  ASSERT_EQ(best.targets.size(), 2u);  // not the frame
  EXPECT_EQ(best.targets[0], ask(objects, "bridge").targets.at(0));
  EXPECT_EQ(best.targets[1].name, "grenade");
  EXPECT_FALSE(best.targets[1].feasible);
  EXPECT_NE(best.targets[1].reason, "");
  ArmNow lost;
  lost.problem = "no joint states";
  for (const GraspTarget& target : advisor_->best(objects, lost).targets) {
    EXPECT_FALSE(target.feasible);
    EXPECT_EQ(target.reason, "no joint states");
  }
}

TEST(SharedMapTest, StampsAreKeptToTheNanosecond) {
  const EyeHandParameters parameters = someParameters();
  const ModelBase models = loadShapes(parameters.objects);
  SharedMap map(models, parameters.map, "base_link");
  ObjectView view;
  view.camera.width = 640;
  view.camera.height = 480;
  view.camera.fx = view.camera.fy = 600;
  view.camera.cx = 320;
  view.camera.cy = 240;
  SeenObject bridge, frame;
  bridge.object = models.indexOf("bridge");
  frame.object = models.indexOf("frame");
  bridge.covariance = frame.covariance = Matrix6d::Identity() * 1e-8;
  bridge.camera_from_object.translation = {0, 0, -1};  // behind the camera: never missed
  frame.camera_from_object.translation = {0.5, 0, -1};

  const ros::Time first(1700000000, 123456789), second(1700000001, 987654321);
  view.objects = {bridge, frame};
  view.stamp = first.toSec();
  map.add(view, first);
  view.objects = {frame};
  view.stamp = second.toSec();
  map.add(view, second);

  const KnownObjects known = map.known();
  ASSERT_EQ(known.messages.size(), 2u);
  EXPECT_EQ(known.messages[0].header.stamp, first);
  EXPECT_EQ(known.messages[1].header.stamp, second);
  EXPECT_EQ(known.stamp, second);
  EXPECT_NE(map.add(view, second).report.refused, "");
  EXPECT_NE(map.known().refused, "");

  const ros::Time forgotten(1700000003, 0), late(1700000002, 0);
  EXPECT_EQ(map.forget(bridge.object, 0, forgotten), 1);
  EXPECT_EQ(map.forget(bridge.object, 0, forgotten), 0);
  view.stamp = late.toSec();
  EXPECT_NE(map.add(view, late).report.refused, "") << "taken before it was carried away";
  view.stamp = second.toSec();
  EXPECT_EQ(map.forget(-1, -1, forgotten), 1);
  EXPECT_EQ(map.add(view, second).report.refused, "");  // stamps may start again

  map.clear();
  EXPECT_TRUE(map.known().stamp.isZero());
  EXPECT_TRUE(map.known().objects.empty());
}

TEST(GraspArrowsTest, AppearAndGo) {
  GraspTargetArray grasps;
  grasps.header.frame_id = "base_link";
  grasps.targets.resize(2);
  grasps.targets[0].name = "bridge";
  grasps.targets[0].instance = 4;
  grasps.targets[0].feasible = true;
  grasps.targets[0].pregrasp.position.z = 1;
  grasps.targets[0].grasp.position.z = 0.9;
  grasps.targets[1].name = "grenade";
  GraspArrows arrows;
  visualization_msgs::MarkerArray array = arrows.build(grasps);
  ASSERT_EQ(array.markers.size(), 1u);  // what cannot be grasped has none
  EXPECT_EQ(array.markers[0].type, Marker::ARROW);
  EXPECT_EQ(array.markers[0].ns, "bridge/grasp");
  EXPECT_EQ(array.markers[0].id, 4);
  EXPECT_EQ(array.markers[0].header.frame_id, "base_link");
  ASSERT_EQ(array.markers[0].points.size(), 2u);
  EXPECT_EQ(array.markers[0].points[0].z, 1);
  EXPECT_EQ(array.markers[0].points[1].z, 0.9);
  grasps.targets[0].feasible = false;
  array = arrows.build(grasps);
  ASSERT_EQ(array.markers.size(), 1u);
  EXPECT_EQ(array.markers[0].action, Marker::DELETE);
  EXPECT_EQ(array.markers[0].ns, "bridge/grasp");
  EXPECT_EQ(array.markers[0].id, 4);
  EXPECT_TRUE(arrows.build(grasps).markers.empty());
}

}  // namespace
}  // namespace monocular_eye_hand
