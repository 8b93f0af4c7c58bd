#include "monocular_eye_hand/eye_hand/object_map.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "map_world.h"
#include "monocular_eye_hand/model/interior.h"
#include "monocular_eye_hand/options/options.h"
#include "support/pose_matchers.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace map_world;
using testing::HasSubstr;

const Eigen::Vector3d kTarget(0.45, 0, 0);
const Eigen::Vector3d kLeft = kTarget + Eigen::Vector3d(0, 0.2, 0.5),
                      kRight = kTarget + Eigen::Vector3d(0, -0.2, 0.5),
                      kFar = kTarget + Eigen::Vector3d(-0.2, 0, 0.6),
                      kNear = kTarget + Eigen::Vector3d(0.1, 0.1, 0.45);

/// A bridge that recognition trusts so much.
ObjectView bridgeAt(double stamp, const Eigen::Vector3d& eye, const Rigid3& base_from_bridge,
                    double probability) {
  ObjectView v = view(stamp, eye, kTarget, {{kBridge, base_from_bridge}});
  v.objects[0].probability = probability;
  return v;
}

TEST(ObjectMap, TwoOfANameKeepTheirNumbers) {
  ObjectMap map(&models());
  const Rigid3 a = upright(0.40, 0.06), b = upright(0.50, -0.06, 1), c = upright(0.45, 0.0);
  ViewReport report = map.add(view(1, kLeft, kTarget, {{kBridge, a}, {kBridge, b}, {kFlange, c}}));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kNew);
  EXPECT_EQ(report.decisions[1].number, 1);
  EXPECT_EQ(report.decisions[2].number, 0);
  report = map.add(view(2, kRight, kTarget, {{kFlange, c}, {kBridge, b}, {kBridge, a}}));
  EXPECT_EQ(report.decisions[0].number, 0);
  EXPECT_EQ(report.decisions[1].number, 1);
  EXPECT_EQ(report.decisions[2].number, 0);
  for (const ViewDecision& d : report.decisions) EXPECT_EQ(d.outcome, ViewOutcome::kMerged) << d.reason;
  ASSERT_EQ(map.objects().size(), 3u);
  EXPECT_EQ(map.objects()[0].name, "bridge");
  EXPECT_EQ(map.objects()[2].name, "flange");
  EXPECT_NEAR((map.objects()[1].base_from_object.translation - b.translation).norm(), 0, 1e-9);
}

TEST(ObjectMap, TheSamePlaceAgainIsNoNewKnowledge) {
  ObjectMap map(&models());
  map.add(view(1, kLeft, kTarget, {{kBridge, upright(0.45, 0)}}));
  const Matrix6d before = map.objects()[0].covariance;
  const ViewReport report = map.add(view(2, kLeft, kTarget, {{kBridge, upright(0.4505, 0)}}));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kSeenAgain);
  EXPECT_EQ(map.objects()[0].covariance, before);
  EXPECT_EQ(map.objects()[0].views, 1);
  EXPECT_EQ(map.objects()[0].last_stamp, 2);
}

TEST(ObjectMap, EnoughViewsAreEnough) {
  ObjectMapOptions options;
  options.max_views = 2;
  ObjectMap map(&models(), options);
  for (const auto& [stamp, eye] : {std::pair(1, kLeft), std::pair(2, kRight), std::pair(3, kFar)})
    map.add(view(stamp, eye, kTarget, {{kBridge, upright(0.45, 0)}}));
  EXPECT_EQ(map.objects().at(0).views, 2);
  EXPECT_EQ(map.objects().at(0).last_stamp, 3);
}

TEST(ObjectMap, AnOutlierIsLeftOutAndAMovedObjectFollowed) {
  ObjectMap map(&models());
  const Rigid3 there = upright(0.45, 0), pushed = upright(0.46, 0.01, 0.2);
  map.add(view(1, kLeft, kTarget, {{kBridge, there}}));
  map.add(view(2, kRight, kTarget, {{kBridge, there}}));
  ViewReport report = map.add(view(3, kFar, kTarget, {{kBridge, pushed}}));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kOutlier);
  EXPECT_GT(report.decisions[0].chi_square, 30);
  EXPECT_THAT(report.decisions[0].reason, HasSubstr("above the gate of 30"));
  EXPECT_EQ(map.objects()[0].outliers, 1);
  EXPECT_THAT(there, PoseNear(map.objects()[0].base_from_object, 1e-06, 6e-08));

  report = map.add(view(4, kNear, kTarget, {{kBridge, there}}));  // a single one is forgotten again
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kMerged);
  EXPECT_EQ(map.objects()[0].outliers, 0);
  map.add(view(5, kFar, kTarget, {{kBridge, pushed}}));
  report = map.add(view(6, kRight, kTarget, {{kBridge, pushed}}));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kRestarted);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].number, 0);
  EXPECT_EQ(map.objects()[0].views, 1);
  EXPECT_THAT(pushed, PoseNear(map.objects()[0].base_from_object, 1e-06, 6e-08));
}

TEST(ObjectMap, ADoubtfulPoseGivesWayToASureOneAtOnce) {
  const Rigid3 doubtful = upright(0.45, 0), sure = upright(0.46, 0.01, 0.2);
  ObjectMap map(&models());
  map.add(bridgeAt(1, kLeft, doubtful, 0.7));
  EXPECT_EQ(map.add(bridgeAt(2, kRight, sure, 0.6)).decisions[0].outcome, ViewOutcome::kOutlier)
      << "still more doubtful";
  map.clear();

  map.add(bridgeAt(1, kLeft, doubtful, 0.7));
  const ViewReport report = map.add(bridgeAt(2, kRight, sure, 0.99));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kRestarted);
  EXPECT_THAT(report.decisions[0].reason, HasSubstr("more than what spoke for the old one"));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].number, 0);
  EXPECT_EQ(map.objects()[0].outliers, 0);
  EXPECT_EQ(map.objects()[0].last_stamp, 2);
  EXPECT_THAT(sure, PoseNear(map.objects()[0].base_from_object, 1e-06, 6e-08));
}

TEST(ObjectMap, APoseThatSeveralViewsAgreeOnYieldsToNoSingleView) {
  ObjectMap map(&models());
  map.add(bridgeAt(1, kLeft, upright(0.45, 0), 0.97));
  map.add(bridgeAt(2, kRight, upright(0.45, 0), 0.97));
  EXPECT_EQ(map.add(bridgeAt(3, kFar, upright(0.46, 0.01, 0.2), 0.99)).decisions[0].outcome,
            ViewOutcome::kOutlier);
}

TEST(ObjectMap, WhatEveryViewDoubtsIsBelievedWhenTheyAgree) {
  ObjectMap map(&models());
  const Rigid3 there = upright(0.45, 0);
  ViewReport report = map.add(bridgeAt(1, kLeft, there, 0.35));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kDoubtful);
  EXPECT_EQ(report.decisions[0].number, -1);
  EXPECT_TRUE(map.objects().empty());
  report = map.add(bridgeAt(2, kLeft, there, 0.35));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kDoubtful) << "the same place errs in the same way";
  EXPECT_TRUE(map.objects().empty());

  report = map.add(bridgeAt(3, kRight, there, 0.45));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kNew);
  EXPECT_THAT(report.decisions[0].reason, HasSubstr("2 views together make it likely"));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].number, 0) << "a doubt takes no number";
  EXPECT_EQ(map.objects()[0].views, 2);
  const double odds = 0.35 / 0.65 * 0.45 / 0.55 * 4;  // agreement_odds
  EXPECT_NEAR(map.objects()[0].probability, odds / (1 + odds), 1e-9);
}

TEST(ObjectMap, DoubtsThatDisagreeOrAreMissedStayDoubts) {
  ObjectMap map(&models());
  for (int k = 0; k < 4; ++k)
    map.add(bridgeAt(k, k % 2 ? kLeft : kRight, upright(0.45 + (k % 2 ? 0.012 : -0.012), 0, 0.3 * k), 0.45));
  EXPECT_TRUE(map.objects().empty());
  map.clear();

  map.add(bridgeAt(1, kLeft, upright(0.45, 0), 0.45));
  map.add(view(2, kFar, kTarget, {}));
  map.add(bridgeAt(3, kRight, upright(0.45, 0), 0.45));
  EXPECT_TRUE(map.objects().empty()) << "one of three views did not show it";
}

TEST(ObjectMap, ADoubtHidesAndMovesNothing) {
  ObjectMap map(&models());
  const Rigid3 there = upright(0.45, 0);
  map.add(bridgeAt(1, kLeft, there, 0.95));
  const ViewReport report = map.add(bridgeAt(2, kRight, upright(0.46, 0.01, 0.2), 0.45));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kRefused);
  EXPECT_THAT(report.decisions[0].reason, HasSubstr("recognition doubts it"));
  EXPECT_EQ(map.objects().at(0).outliers, 0);

  map.add(bridgeAt(3, kFar, there, 0.2));  // one that agrees adds to it, and confirms nothing by itself
  EXPECT_EQ(map.objects().at(0).last_stamp, 1);
  EXPECT_EQ(map.objects()[0].views, 2);
  EXPECT_EQ(map.objects()[0].probability, 0.95);
}

TEST(ObjectMap, DoubtsInOnePlaceAgreeThatSomethingIsThere) {
  ObjectMap map(&models());
  const Rigid3 likely = upright(0.45, 0), turned = upright(0.45, 0, 1);
  map.add(bridgeAt(1, kLeft, turned, 0.4));
  EXPECT_EQ(map.add(bridgeAt(2, kRight, likely, 0.45)).decisions[0].outcome, ViewOutcome::kNew);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_THAT(likely, PoseNear(map.objects()[0].base_from_object, 1e-06, 6e-08)) << "the likelier of the two";
  EXPECT_EQ(map.objects()[0].views, 1) << "no view agrees with the pose";
  EXPECT_GT(map.objects()[0].probability, 0.5);
  EXPECT_LT(map.objects()[0].probability, 0.8);

  // The first sure view says how it lies.
  EXPECT_EQ(map.add(bridgeAt(3, kFar, turned, 0.6)).decisions[0].outcome, ViewOutcome::kRestarted);
  EXPECT_THAT(turned, PoseNear(map.objects().at(0).base_from_object, 1e-06, 6e-08));
  EXPECT_EQ(map.objects()[0].number, 0);
}

TEST(ObjectMap, ASureViewEndsADoubt) {
  ObjectMap map(&models());
  map.add(bridgeAt(1, kLeft, upright(0.46, 0.01, 0.2), 0.45));
  const ViewReport report = map.add(bridgeAt(2, kRight, upright(0.45, 0), 0.9));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kNew);
  EXPECT_EQ(report.decisions[0].number, 0);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].views, 1);
  EXPECT_EQ(map.objects()[0].probability, 0.9);
}

TEST(ObjectMap, APlaceThatNeverShowedItSoDoesNotMoveItAlone) {
  ObjectMap map(&models());
  const Rigid3 there = upright(0.45, 0), wrong = upright(0.46, 0.01, 0.2);
  map.add(view(1, kLeft, kTarget, {{kBridge, there}}));
  for (int k = 0; k < 4; ++k) {
    const ViewReport report = map.add(view(2 + k, kRight, kTarget, {{kBridge, wrong}}));
    EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kOutlier);
    EXPECT_EQ(map.objects().at(0).outliers, 1);
  }
  map.add(view(10, kFar, kTarget, {{kBridge, there}}));
  // From where it was seen before, every view that shows it elsewhere says that it was moved.
  EXPECT_EQ(map.add(view(11, kLeft, kTarget, {{kBridge, wrong}})).decisions[0].outcome,
            ViewOutcome::kOutlier);
  EXPECT_EQ(map.add(view(12, kLeft, kTarget, {{kBridge, wrong}})).decisions[0].outcome,
            ViewOutcome::kRestarted);
}

TEST(ObjectMap, OutliersThatContradictEachOtherDoNotMoveIt) {
  ObjectMap map(&models());
  map.add(view(1, kLeft, kTarget, {{kBridge, upright(0.45, 0)}}));
  for (int k = 0; k < 6; ++k) {
    const Rigid3 elsewhere = upright(0.45 + (k % 2 ? 0.012 : -0.012), 0, k % 2 ? 0.3 : -0.3);
    const ViewReport report = map.add(view(2 + k, kRight, kTarget, {{kBridge, elsewhere}}));
    EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kOutlier);
  }
  EXPECT_EQ(map.objects().at(0).base_from_object.translation.x(), 0.45);
}

TEST(ObjectMap, WhatShouldHaveBeenSeenIsForgotten) {
  ObjectMap map(&models());
  const Rigid3 a = upright(0.40, 0.08), b = upright(0.50, -0.08);
  map.add(view(1, kLeft, kTarget, {{kBridge, a}, {kBridge, b}}));
  ViewReport report = map.add(view(2, kRight, kTarget, {{kBridge, a}}));
  EXPECT_TRUE(report.forgotten.empty());
  EXPECT_EQ(map.objects()[1].misses, 1);
  for (const auto& [stamp, eye] : {std::pair(3, kNear), std::pair(4, kLeft), std::pair(5, kFar)})
    EXPECT_TRUE(map.add(view(stamp, eye, kTarget, {{kBridge, a}})).forgotten.empty());
  report = map.add(view(6, kTarget + Eigen::Vector3d(0, 0, 0.5), kTarget, {{kBridge, a}}));
  ASSERT_EQ(report.forgotten.size(), 1u);
  EXPECT_EQ(report.forgotten[0].number, 1);
  ASSERT_EQ(map.objects().size(), 1u);
  // Its number is not given to another one.
  report = map.add(view(7, kNear, kTarget, {{kBridge, a}, {kBridge, b}}));
  EXPECT_EQ(report.decisions[1].number, 2);
}

TEST(ObjectMap, APlaceThatNeverShowedItMissesItOnce) {
  ObjectMap map(&models());
  const Rigid3 there = upright(0.45, 0);
  map.add(view(1, kLeft, kTarget, {{kBridge, there}}));
  for (int k = 0; k < 6; ++k) map.add(view(2 + k, kRight, kTarget, {}));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].misses, 1);
  for (int k = 0; k < 3; ++k) map.add(view(10 + k, kLeft, kTarget, {}));  // it was seen from here: it is gone
  EXPECT_EQ(map.objects().at(0).misses, 4);
  map.add(view(20, kFar, kTarget, {{kBridge, there}}));
  EXPECT_EQ(map.objects()[0].misses, 0);
  map.add(view(21, kRight, kTarget, {}));
  EXPECT_EQ(map.objects()[0].misses, 1);
}

TEST(ObjectMap, WhatCouldNotBeSeenIsKept) {
  ObjectMapOptions options;
  options.expected_nearest = 0.25;
  ObjectMap map(&models(), options);
  const Rigid3 a = upright(0.45, 0);
  map.add(view(1, kLeft, kTarget, {{kBridge, a}}));
  for (int k = 0; k < 4; ++k)  // out of the image
    map.add(view(2 + k, kTarget + Eigen::Vector3d(0.8, 0, 0.3), kTarget + Eigen::Vector3d(0.8, 0, 0), {}));

  EXPECT_EQ(map.objects().at(0).misses, 0);
  map.add(view(10, kTarget + Eigen::Vector3d(0, 0, 9), kTarget, {}));  // too small
  EXPECT_EQ(map.objects().at(0).misses, 0);
  map.add(view(10.5, kTarget + Eigen::Vector3d(0, 0, 0.2), kTarget, {}));  // nearer than recognition looks
  EXPECT_EQ(map.objects().at(0).misses, 0);
  ObjectView broken_off = view(11, kRight, kTarget, {});
  broken_off.complete = false;
  map.add(broken_off);
  EXPECT_EQ(map.objects().at(0).misses, 0);
  map.add(view(12, kRight, kTarget, {}));
  EXPECT_EQ(map.objects().at(0).misses, 1);
}

TEST(ObjectMap, WhatAnotherObjectHidesIsKept) {
  // A low camera looks along y: the second bridge stands before the first.
  const Rigid3 back = upright(0.45, 0.06), front = upright(0.45, -0.06);
  const Eigen::Vector3d above(0.45, 0, 0.6), low(0.45, -0.5, 0.015);
  for (const bool hidden : {true, false}) {
    ObjectMap map(&models());
    std::vector<std::pair<int, Rigid3>> first{{kBridge, back}}, second;
    if (hidden) {
      first.push_back({kBridge, front});
      second.push_back({kBridge, front});
    }
    map.add(view(1, above, kTarget, first));
    ASSERT_EQ(map.objects().size(), first.size());
    map.add(view(2, low, {0.45, 0, 0.015}, second));
    EXPECT_EQ(map.objects().at(0).misses, hidden ? 0 : 1);
  }
}

// Far enough from each other to be two, and yet in one place.
const Rigid3 kThere = upright(0.45, 0), kInto = upright(0.45, 0.028, 0.5);

TEST(ObjectMap, OfTwoInOnePlaceTheOneWithMoreViewsIsTold) {
  ObjectMap map(&models());
  map.add(view(1, kLeft, kTarget, {{kBridge, kThere}}));
  map.add(view(2, kRight, kTarget, {{kBridge, kThere}}));
  ViewReport report = map.add(view(3, kFar, kTarget, {{kBridge, kThere}, {kBridge, kInto}}));
  EXPECT_EQ(report.decisions[1].outcome, ViewOutcome::kNew);
  EXPECT_THAT(report.decisions[1].reason, HasSubstr("not told, since bridge 0 is there"));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].number, 0);
  // It hides nothing and is hidden by nothing, and is forgotten as anything that is not there.
  map.add(view(4, kNear, kTarget, {{kBridge, kThere}}));
  report = map.add(view(5, kLeft, kTarget, {{kBridge, kThere}}));
  EXPECT_TRUE(report.forgotten.empty());  // who was never told is not told to be gone
  EXPECT_TRUE(map.forget(kBridge, 0));
  EXPECT_TRUE(map.objects().empty());
}

TEST(ObjectMap, AWrongSightingYieldsWhenTheRightOneIsSeenMore) {
  ObjectMap map(&models());
  map.add(view(1, kLeft, kTarget, {{kBracket, kInto}}));
  ASSERT_EQ(map.objects().size(), 1u);
  map.add(view(2, kRight, kTarget, {{kBridge, kThere}}));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].object, kBridge);
  map.add(view(3, kFar, kTarget, {{kBridge, kThere}}));
  map.add(view(4, kNear, kTarget, {{kBracket, kInto}}));  // once more wrong
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].object, kBridge);
}

TEST(ObjectMap, WhatYieldedToACarriedObjectGoesWithIt) {
  ObjectMap map(&models());
  map.add(view(1, kLeft, kTarget, {{kBridge, kThere}}));
  map.add(view(2, kRight, kTarget, {{kBridge, kThere}, {kBridge, kInto}}));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_TRUE(map.forget(kBridge, 0));
  EXPECT_TRUE(map.objects().empty());
  map.add(view(3, kFar, kTarget, {{kBridge, kInto}}));  // and comes back when it is there
  EXPECT_EQ(map.objects().size(), 1u);
}

TEST(ObjectMap, AnObstacleYieldsToNoPart) {
  ModelBase base = models();
  base.objects[kFrame].handling.obstacle = true;
  ObjectMap map(&base);
  const Rigid3 frame = upright(0.45, 0);
  const Eigen::Vector3d in_frame = innerPoints(base.objects[kFrame].model, 0.003).front(),
                        in_bridge = innerPoints(base.objects[kBridge].model, 0.003).front();
  Rigid3 in_the_wall = frame;
  in_the_wall.translation += in_frame - in_bridge;
  for (const auto& [stamp, eye] : {std::pair(1, kLeft), std::pair(2, kRight)})
    map.add(view(stamp, eye, kTarget, {{kBridge, in_the_wall}}));
  ASSERT_EQ(map.objects().size(), 1u);
  map.add(view(3, kFar, kTarget, {{kBridge, in_the_wall}, {kFrame, frame}}));
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_EQ(map.objects()[0].object, kFrame);
}

TEST(ObjectMap, ABadlyLocatedObstacleIsNoSecondOne) {
  ModelBase base = models();
  base.objects[kFrame].handling.obstacle = true;
  const Eigen::Vector3d sides = base.objects[kFrame].model.bounds.sizes();
  ObjectMap map(&base);
  const Rigid3 frame = upright(0.45, 0, 0.3), off = upright(0.45 + 0.2 * sides.x(), 0, 0.3);
  map.add(view(1, kLeft, kTarget, {{kFrame, off}}));
  ViewReport report = map.add(view(2, kRight, kTarget, {{kFrame, frame}}));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kOutlier);
  EXPECT_EQ(map.objects().size(), 1u);
  report = map.add(view(3, kFar, kTarget, {{kFrame, frame}}));
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kRestarted);
  ASSERT_EQ(map.objects().size(), 1u);
  EXPECT_THAT(frame, PoseNear(map.objects()[0].base_from_object, 1e-06, 6e-08));
  map.add(view(4, kNear, kTarget, {{kFrame, frame}, {kFrame, upright(0.45 + 1.5 * sides.x(), 0, 0.3)}}));
  EXPECT_EQ(map.objects().size(), 2u);
}

TEST(ObjectMap, RefusesWithReasons) {
  ObjectMap map(&models());
  ObjectView v = view(5, kLeft, kTarget, {{kBridge, upright(0.45, 0)}});
  v.objects[0].probability = 0.02;
  ViewReport report = map.add(v);
  EXPECT_EQ(report.decisions[0].outcome, ViewOutcome::kRefused);
  EXPECT_THAT(report.decisions[0].reason, HasSubstr("probability 0.02 is below doubtful_probability 0.1"));
  EXPECT_TRUE(map.objects().empty());
  report = map.add(view(5, kRight, kTarget, {{kBridge, upright(0.45, 0)}}));
  EXPECT_THAT(report.refused, HasSubstr("not newer"));
  EXPECT_TRUE(map.objects().empty());
  map.clear();
  EXPECT_TRUE(map.add(view(1, kRight, kTarget, {{kBridge, upright(0.45, 0)}})).refused.empty());
  EXPECT_TRUE(map.forget(kBridge, 0));
  EXPECT_FALSE(map.forget(kBridge, 0));
}

TEST(ObjectMap, SameViewsSameMap) {
  const auto run = [] {
    ObjectMap map(&models());
    for (int k = 0; k < 5; ++k)
      map.add(view(k, kTarget + Eigen::Vector3d(0.1 * std::cos(k), 0.1 * std::sin(k), 0.5), kTarget,
                   {{kBridge, upright(0.40 + 1e-4 * k, 0.08)}, {kFlange, upright(0.5, -0.05, k)}}));
    return map.objects();
  };
  const auto a = run(), b = run();
  ASSERT_EQ(a.size(), b.size());
  for (size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].base_from_object.translation, b[k].base_from_object.translation);
    EXPECT_EQ(a[k].covariance, b[k].covariance);
  }
}

TEST(ObjectMap, BadInputLeavesTheMapAlone) {
  ObjectMap map(&models());
  map.add(view(1, kLeft, kTarget, {{kBridge, upright(0.45, 0)}}));
  const auto refused = [&](const std::function<void(ObjectView*)>& spoil) {
    ObjectView v = view(2, kRight, kTarget, {{kBridge, upright(0.45, 0)}});
    spoil(&v);
    return refusal([&] { map.add(v); });
  };

  EXPECT_THAT(refused([](ObjectView* v) { v->objects[0].object = 9; }),
              HasSubstr("object 9 is not in the model base"));
  EXPECT_THAT(refused([](ObjectView* v) { v->objects[0].covariance(0, 0) = NAN; }),
              HasSubstr("covariance of bridge is not finite"));
  EXPECT_THAT(refused([](ObjectView* v) { v->objects[0].camera_from_object.rotation *= 2; }),
              HasSubstr("no rotation"));
  EXPECT_THAT(refused([](ObjectView* v) { v->objects[0].probability = 2; }), HasSubstr("between 0 and 1"));
  EXPECT_THAT(refused([](ObjectView* v) { v->stamp = NAN; }), HasSubstr("stamp"));
  EXPECT_THAT(refused([](ObjectView* v) { v->camera.width = 0; }), HasSubstr("width"));
  EXPECT_THAT(refused([](ObjectView* v) { v->hand.jacobian(0, 0) = NAN; }), HasSubstr("Jacobian"));
  EXPECT_EQ(map.objects().at(0).last_stamp, 1);
  ObjectMapOptions options;
  EXPECT_THAT(refusal([&] { readOptions(parseYaml("gate: 0"), &options); }),
              HasSubstr("gate = 0 must be positive"));
  EXPECT_THAT(refusal([&] { readOptions(parseYaml("arm: {position_sigma: -1}"), &options); }),
              HasSubstr("position_sigma"));
}

}  // namespace
}  // namespace monocular_eye_hand
