#include "monocular_eye_hand/arm/puma560.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "monocular_eye_hand/options/options.h"
#include "random_arm.h"
#include "support/allocation_count.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

/// As turns count: q and q + 2 pi are one angle, but not one joint value.
double largestDifference(const JointVector& a, const JointVector& b) { return (a - b).cwiseAbs().maxCoeff(); }

TEST(Puma560, LinksEndInTool0) {
  Random random(1);
  const Puma560 arm;
  for (int k = 0; k < 200; ++k) {
    const JointVector q = randomJoints(random, arm.options());
    const auto links = arm.baseFromLinks(q);
    const Rigid3 tool = arm.baseFromTool0(q);
    EXPECT_LT((links[6].translation - tool.translation).norm(), 1e-14);
    EXPECT_LT(rotationError(links[6].rotation, tool.rotation), 2e-15);
    EXPECT_EQ(links[0].translation.z(), arm.options().shoulder_height);
    // The wrist centre is common to frames 4 and 5, d6 behind the flange.
    EXPECT_LT((links[4].translation - links[5].translation).norm(), 1e-15);
    EXPECT_NEAR((links[6].translation - links[5].translation).norm(), arm.options().d6, 1e-15);
  }
}

TEST(Puma560, JacobianIsTheDerivative) {
  Random random(2);
  const Puma560 arm;
  const double h = 1e-6;
  for (int k = 0; k < 100; ++k) {
    const JointVector q = randomJoints(random, arm.options());
    const Matrix6d jacobian = arm.jacobian(q);
    for (int i = 0; i < 6; ++i) {
      JointVector ahead = q, behind = q;
      ahead[i] += h;
      behind[i] -= h;
      const Vector6d d = difference(arm.baseFromTool0(behind), arm.baseFromTool0(ahead)) / (2 * h);
      EXPECT_LT((jacobian.col(i) - d).cwiseAbs().maxCoeff(), 2e-9) << "joint " << i + 1;
    }
  }
}

TEST(Puma560, SingularityIsTheDeterminant) {
  Random random(3);
  const Puma560 arm;
  for (int k = 0; k < 200; ++k) {
    const JointVector q = randomJoints(random, arm.options());
    const Singularity s = arm.singularity(q);
    EXPECT_NEAR(s.determinant, arm.jacobian(q).determinant(), 1e-14);
    EXPECT_NEAR(std::abs(s.determinant), arm.options().a2 * s.shoulder * s.elbow * s.wrist, 1e-15);
  }
  JointVector stretched = JointVector::Zero();
  stretched[2] = -std::atan2(arm.options().d4, arm.options().a3);
  EXPECT_LT(arm.singularity(stretched).elbow, 1e-15);
}

TEST(Puma560, InverseFindsTheJointsItCameFromWithTheirConfiguration) {
  Random random(4);
  const Puma560 arm;
  ArmSolutions found;
  std::set<std::string> seen;
  for (int k = 0; k < 2000; ++k) {
    const JointVector q = randomJoints(random, arm.options());
    const Singularity s = arm.singularity(q);
    if (s.shoulder < 0.01 || s.elbow < 0.01 || s.wrist < 0.05) continue;
    arm.inverse(arm.baseFromTool0(q), JointVector::Zero(), &found);
    int same = 0;
    for (const ArmSolution& solution : found) {
      EXPECT_EQ(toString(arm.configuration(solution.joints)), toString(solution.configuration));
      EXPECT_TRUE(arm.withinLimits(solution.joints));
      seen.insert(toString(solution.configuration));
      if (largestDifference(solution.joints, q) < 1e-9) ++same;
    }
    EXPECT_EQ(same, 1) << q.transpose();
    for (int i = 0; i < found.size(); ++i)
      for (int j = 0; j < i; ++j) EXPECT_GT(largestDifference(found[i].joints, found[j].joints), 1e-6);
  }

  EXPECT_EQ(seen.size(), 8u);
}

TEST(Puma560, EveryTurnInsideTheLimits) {
  Puma560Options options;
  for (int i : {0, 3, 5}) {
    options.joints[size_t(i)].lower = -2 * M_PI;
    options.joints[size_t(i)].upper = 2 * M_PI;
  }
  const Puma560 arm(options);
  JointVector q;
  q << 0.3, 0.4, -0.9, 0.5, 0.6, -0.7;
  ArmSolutions found;
  arm.inverse(arm.baseFromTool0(q), q, &found);
  int turns = 0;
  for (const ArmSolution& solution : found) turns += solution.configuration == arm.configuration(q);
  EXPECT_EQ(turns, 2 * 2 * 2);

  // At an angle of zero each of the three joints has three turns, two of them on the limits.
  q << 0, 0.4, -0.9, 0, 0.6, 0;
  arm.inverse(arm.baseFromTool0(q), q, &found);
  turns = 0;
  for (const ArmSolution& solution : found) turns += solution.configuration == arm.configuration(q);
  EXPECT_EQ(turns, 3 * 3 * 3);
}

TEST(Puma560, InverseAllocatesNothing) {
  const Puma560 arm;
  ArmSolutions found;
  JointVector q;
  q << 0.3, 0.4, -0.9, 0.5, 0.6, -0.7;
  const Rigid3 pose = arm.baseFromTool0(q);
  const long before = allocationCount();
  arm.inverse(pose, q, &found);
  const long after = allocationCount();
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(after, before);
  EXPECT_GT(std::string(64, ' ').size(), 0u);
  EXPECT_GT(allocationCount(), after);  // the count does count
}

TEST(Puma560, OutOfReachIsEmpty) {
  const Puma560 arm;
  ArmSolutions found;
  Rigid3 pose;
  pose.translation = {2, 0, 1};  // too far
  arm.inverse(pose, JointVector::Zero(), &found);
  EXPECT_TRUE(found.empty());
  pose.translation = {0.05, 0, 1};  // wrist centre nearer to axis 1 than d3
  arm.inverse(pose, JointVector::Zero(), &found);
  EXPECT_TRUE(found.empty());
  JointVector q = JointVector::Zero();
  q[4] = 1.8;  // beyond joint 5's limit, and its flip too
  q[3] = 0.1;
  arm.inverse(arm.baseFromTool0(q), JointVector::Zero(), &found);
  for (const ArmSolution& solution : found) EXPECT_NE(solution.configuration.shoulder, Shoulder::kRight);
}

TEST(Puma560, LimitsAreReached) {
  const Puma560 arm;
  ArmSolutions found;
  for (int corner = 0; corner < 64; ++corner) {
    JointVector q;
    for (int i = 0; i < 6; ++i) {
      const JointLimit& limit = arm.options().joints[size_t(i)];
      q[i] = corner >> i & 1 ? limit.upper : limit.lower;
    }
    EXPECT_TRUE(arm.withinLimits(q));
    arm.inverse(arm.baseFromTool0(q), JointVector::Zero(), &found);
    double nearest = 1;
    for (const ArmSolution& s : found) nearest = std::min(nearest, largestDifference(s.joints, q));
    EXPECT_LT(nearest, 1e-9) << corner;
    q[corner % 6] += (corner >> (corner % 6) & 1 ? 1 : -1) * 1e-6;
    EXPECT_FALSE(arm.withinLimits(q));
  }
}

TEST(Puma560, RefusesWhatIsNoPose) {
  const Puma560 arm;
  ArmSolutions found;
  const JointVector zero = JointVector::Zero();
  Rigid3 pose;
  pose.translation.x() = NAN;
  EXPECT_THAT(refusal([&] { arm.inverse(pose, zero, &found); }), HasSubstr("the pose is not finite"));
  pose = Rigid3();
  pose.rotation *= 1.001;
  EXPECT_THAT(refusal([&] { arm.inverse(pose, zero, &found); }), HasSubstr("no rotation"));
  pose.rotation = Eigen::Vector3d(1, 1, -1).asDiagonal();
  EXPECT_THAT(refusal([&] { arm.inverse(pose, zero, &found); }), HasSubstr("no rotation"));
  pose = Rigid3();
  const JointVector nan = JointVector::Constant(NAN);
  EXPECT_THAT(refusal([&] { arm.inverse(pose, nan, &found); }), HasSubstr("current joint angles"));
  EXPECT_FALSE(arm.withinLimits(nan));
}

TEST(Puma560, ConfigurationNames) {
  for (Shoulder shoulder : {Shoulder::kRight, Shoulder::kLeft})
    for (Elbow elbow : {Elbow::kUp, Elbow::kDown})
      for (Wrist wrist : {Wrist::kPositive, Wrist::kNegative}) {
        const ArmConfiguration configuration{shoulder, elbow, wrist};
        EXPECT_EQ(branchOf(toString(configuration)), configuration);
      }
  EXPECT_EQ(toString({Shoulder::kLeft, Elbow::kDown, Wrist::kNegative}), "left-down-negative");
  EXPECT_THAT(refusal([] { branchOf("lefty"); }), HasSubstr("'lefty' is no branch"));
}

TEST(Puma560Options, CheckNamesFieldValueAndRule) {
  const auto refusalAfter = [](auto&& change) {
    Puma560Options options;
    change(options);
    return refusal([&] { Puma560{options}; });
  };
  EXPECT_EQ(refusalAfter([](Puma560Options&) {}), kAccepted);
  EXPECT_THAT(refusalAfter([](auto& o) { o.d6 = -0.1; }), HasSubstr("d6 = -0.1 must be at least 0 m"));
  EXPECT_THAT(refusalAfter([](auto& o) { o.a2 = 0; }), HasSubstr("a2 = 0 must be at least 0.01 m"));
  EXPECT_THAT(refusalAfter([](auto& o) { o.d4 = NAN; }), HasSubstr("d4 = nan must be finite"));
  EXPECT_THAT(refusalAfter([](auto& o) { o.joints[2].upper = -5; }),
              HasSubstr("joints[2].upper = -5 must be above"));
  EXPECT_THAT(refusalAfter([](auto& o) { o.joints[5].upper = 13; }), HasSubstr("at most 2 turns"));
  EXPECT_THAT(refusalAfter([](auto& o) { o.joints[4].upper = 5; }), HasSubstr("less than one turn"));
  EXPECT_THAT(refusalAfter([](auto& o) { o.joints[0].velocity = 0; }), HasSubstr("joints[0].velocity"));
  EXPECT_THAT(refusalAfter([](auto& o) { o.joints[0].acceleration = -1; }),
              HasSubstr("joints[0].acceleration"));
}

TEST(Puma560Options, ReadsAndWritesTrees) {
  Puma560Options options;
  options.d3 = 0.149;
  options.joints[1].velocity = 0.7;
  Puma560Options read;
  readOptions(writeOptions(options), &read);
  EXPECT_EQ(read.d3, 0.149);
  EXPECT_EQ(read.joints[1].velocity, 0.7);
  EXPECT_EQ(read.joints[1].upper, options.joints[1].upper);
}

}  // namespace
}  // namespace monocular_eye_hand
