#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/instances.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;

// Two objects of 0.1 m: the frame of the first lies in its middle, that of the second in a corner.
ModelBase twoObjects() {
  ModelBase models;
  for (const char* name : {"bridge", "cube"}) {
    KnownObject known;
    known.model.name = name;
    known.model.diameter = 0.1;
    const Eigen::Vector3d low =
        std::string(name) == "cube" ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(-.05, -.05, -.05);
    known.model.bounds = Eigen::AlignedBox3d(low, low + Eigen::Vector3d::Constant(0.1));
    models.objects.push_back(known);
  }
  return models;
}

ObjectEstimate at(double x, int object = 0) {
  ObjectEstimate seen;
  seen.object = object;
  seen.name = object == 0 ? "bridge" : "cube";
  seen.camera_from_object.translation = {x, 0, 1};
  return seen;
}

TEST(Instances, CountFromZeroPerName) {
  Instances instances(twoObjects(), {});
  EXPECT_THAT(instances.assign({at(0), at(0.5), at(0, 1)}, 1), ElementsAre(0, 1, 0));
}

TEST(Instances, StayWhenTheOrderChanges) {
  Instances instances(twoObjects(), {});
  instances.assign({at(0), at(0.2)}, 1);
  EXPECT_THAT(instances.assign({at(0.21), at(0.01)}, 1.1), ElementsAre(1, 0));
  EXPECT_THAT(instances.assign({at(0.22), at(0.02), at(0.9)}, 1.2), ElementsAre(1, 0, 2));
}

TEST(Instances, NearestPairsFirst) {
  Instances instances(twoObjects(), {});
  instances.assign({at(0), at(0.06)}, 1);
  // 0.04 is in reach of both numbers, 0.1 of number 1 only.
  EXPECT_THAT(instances.assign({at(0.04), at(0.1)}, 1.1), ElementsAre(1, 2));
  EXPECT_THAT(instances.assign({at(0.04), at(0.1), at(0)}, 1.2), ElementsAre(1, 2, 0));
}

TEST(Instances, SurviveAMissedImageAndEndAfterAWhile) {
  InstanceOptions options;
  options.forget_after = 2;
  Instances instances(twoObjects(), options);
  instances.assign({at(0), at(0.5)}, 1);
  EXPECT_THAT(instances.assign({at(0.5)}, 2), ElementsAre(1));
  EXPECT_THAT(instances.assign({at(0.01), at(0.5)}, 2.5), ElementsAre(0, 1));
  EXPECT_THAT(instances.assign({at(0.5)}, 4), ElementsAre(1));
  EXPECT_THAT(instances.assign({at(0.5)}, 5), ElementsAre(1));
  EXPECT_THAT(instances.assign({at(0.9)}, 5.1), ElementsAre(0)) << "number 0 is free again";
}

TEST(Instances, ReachGrowsWithTime) {
  InstanceOptions options;
  options.speed = 0.5;
  Instances instances(twoObjects(), options);
  instances.assign({at(0)}, 1);
  EXPECT_THAT(instances.assign({at(0.14)}, 1.2), ElementsAre(0)) << "0.05 + 0.5 * 0.2 = 0.15";
  EXPECT_THAT(instances.assign({at(0.30)}, 1.4), ElementsAre(1));
}

// A cube turned onto itself has its frame in another corner, its centre where it was.
TEST(Instances, CentresAreCompared) {
  InstanceOptions options;
  options.speed = 0;
  Instances instances(twoObjects(), options);
  ObjectEstimate cube = at(0, 1);
  instances.assign({cube}, 1);
  const Eigen::Vector3d centre = cube.camera_from_object * Eigen::Vector3d(0.05, 0.05, 0.05);
  cube.camera_from_object.rotation = expSO3({0, 0, M_PI});
  cube.camera_from_object.translation += centre - cube.camera_from_object * Eigen::Vector3d(0.05, 0.05, 0.05);
  EXPECT_GT((cube.camera_from_object.translation - at(0, 1).camera_from_object.translation).norm(), 0.1);
  EXPECT_THAT(instances.assign({cube}, 1.1), ElementsAre(0));
}

TEST(Instances, TimeThatJumpsBackStartsAfresh) {
  Instances instances(twoObjects(), {});
  instances.assign({at(0), at(0.5)}, 100);
  EXPECT_THAT(instances.assign({at(0.5)}, 10), ElementsAre(0));
  EXPECT_TRUE(instances.previous(5).empty());
}

TEST(Instances, PreviousAreTheLastSeen) {
  Instances instances(twoObjects(), {});
  EXPECT_TRUE(instances.previous(0).empty());
  instances.assign({at(0), at(0.5)}, 1);
  instances.assign({at(0.02)}, 1.5);
  const auto previous = instances.previous(1.6);
  ASSERT_EQ(previous.size(), 2u);
  EXPECT_EQ(previous[0].camera_from_object.translation.x(), 0.02);
  EXPECT_EQ(previous[1].camera_from_object.translation.x(), 0.5);
  EXPECT_EQ(instances.previous(3.2).size(), 1u);
  EXPECT_TRUE(instances.previous(30).empty());
}

TEST(Instances, OptionsAreChecked) {
  InstanceOptions options;
  options.forget_after = -1;
  EXPECT_THROW(Instances(twoObjects(), options), BadInput);
  options = {};
  options.speed = -0.1;
  EXPECT_THROW(options.check(), BadInput);
}

TEST(ObjectFrame, PrefixNameAndNumber) {
  EXPECT_EQ(objectFrame("", "bridge", 0), "bridge_0");
  EXPECT_EQ(objectFrame("left/", "hand grenade (old)", 12), "left/hand_grenade__old__12");
}

}  // namespace
}  // namespace monocular_eye_hand
