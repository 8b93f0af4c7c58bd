#include "monocular_eye_hand/tracking/object_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"

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

TEST(ObjectTracker, CountFromZeroPerName) {
  ObjectTracker tracker(twoObjects(), {});
  EXPECT_THAT(tracker.update({at(0), at(0.5), at(0, 1)}, 1), ElementsAre(0, 1, 0));
}

TEST(ObjectTracker, StayWhenTheOrderChanges) {
  ObjectTracker tracker(twoObjects(), {});
  tracker.update({at(0), at(0.2)}, 1);
  EXPECT_THAT(tracker.update({at(0.21), at(0.01)}, 1.1), ElementsAre(1, 0));
  EXPECT_THAT(tracker.update({at(0.22), at(0.02), at(0.9)}, 1.2), ElementsAre(1, 0, 2));
}

TEST(ObjectTracker, NearestPairsFirst) {
  ObjectTracker tracker(twoObjects(), {});
  tracker.update({at(0), at(0.06)}, 1);
  // 0.04 is in reach of both numbers, 0.1 of number 1 only.
  EXPECT_THAT(tracker.update({at(0.04), at(0.1)}, 1.1), ElementsAre(1, 2));
  EXPECT_THAT(tracker.update({at(0.04), at(0.1), at(0)}, 1.2), ElementsAre(1, 2, 0));
}

TEST(ObjectTracker, SurviveAMissedImageAndEndAfterAWhile) {
  ObjectTrackerOptions options;
  options.forget_after = 2;
  ObjectTracker tracker(twoObjects(), options);
  tracker.update({at(0), at(0.5)}, 1);
  EXPECT_THAT(tracker.update({at(0.5)}, 2), ElementsAre(1));
  EXPECT_THAT(tracker.update({at(0.01), at(0.5)}, 2.5), ElementsAre(0, 1));
  EXPECT_THAT(tracker.update({at(0.5)}, 4), ElementsAre(1));
  EXPECT_THAT(tracker.update({at(0.5)}, 5), ElementsAre(1));
  EXPECT_THAT(tracker.update({at(0.9)}, 5.1), ElementsAre(0)) << "number 0 is free again";
}

TEST(ObjectTracker, ReachGrowsWithTime) {
  ObjectTrackerOptions options;
  options.speed = 0.5;
  ObjectTracker tracker(twoObjects(), options);
  tracker.update({at(0)}, 1);
  EXPECT_THAT(tracker.update({at(0.14)}, 1.2), ElementsAre(0)) << "0.05 + 0.5 * 0.2 = 0.15";
  EXPECT_THAT(tracker.update({at(0.30)}, 1.4), ElementsAre(1));
}

// A cube turned onto itself has its frame in another corner, its centre where it was.
TEST(ObjectTracker, CentresAreCompared) {
  ObjectTrackerOptions options;
  options.speed = 0;
  ObjectTracker tracker(twoObjects(), options);
  ObjectEstimate cube = at(0, 1);
  tracker.update({cube}, 1);
  const Eigen::Vector3d centre = cube.camera_from_object * Eigen::Vector3d(0.05, 0.05, 0.05);
  cube.camera_from_object.rotation = expSO3({0, 0, M_PI});
  cube.camera_from_object.translation += centre - cube.camera_from_object * Eigen::Vector3d(0.05, 0.05, 0.05);
  EXPECT_GT((cube.camera_from_object.translation - at(0, 1).camera_from_object.translation).norm(), 0.1);
  EXPECT_THAT(tracker.update({cube}, 1.1), ElementsAre(0));
}

TEST(ObjectTracker, TimeThatJumpsBackStartsAfresh) {
  ObjectTracker tracker(twoObjects(), {});
  tracker.update({at(0), at(0.5)}, 100);
  EXPECT_THAT(tracker.update({at(0.5)}, 10), ElementsAre(0));
  EXPECT_TRUE(tracker.previous(5).empty());
}

TEST(ObjectTracker, PreviousAreTheLastSeen) {
  ObjectTracker tracker(twoObjects(), {});
  EXPECT_TRUE(tracker.previous(0).empty());
  tracker.update({at(0), at(0.5)}, 1);
  tracker.update({at(0.02)}, 1.5);
  const auto previous = tracker.previous(1.6);
  ASSERT_EQ(previous.size(), 2u);
  EXPECT_EQ(previous[0].camera_from_object.translation.x(), 0.02);
  EXPECT_EQ(previous[1].camera_from_object.translation.x(), 0.5);
  EXPECT_EQ(tracker.previous(3.2).size(), 1u);
  EXPECT_TRUE(tracker.previous(30).empty());
}

TEST(ObjectTracker, OptionsAreChecked) {
  ObjectTrackerOptions options;
  options.forget_after = -1;
  EXPECT_THROW(ObjectTracker(twoObjects(), options), BadInput);
  options = {};
  options.speed = -0.1;
  EXPECT_THROW(options.check(), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
