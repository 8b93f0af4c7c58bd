// The arm against numbers from outside this package: Corke's toolbox prints the named poses; the random ones
// were computed once, apart from this code, and checked against his ikine6s.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "random_arm.h"

namespace monocular_eye_hand {
namespace {

using nlohmann::json;

constexpr double kDigits = 2e-12;  // of the file
constexpr double kAngle = 1e-10;   // of joints far enough from singularities

JointVector joints(const json& values) {
  JointVector q;
  for (int i = 0; i < 6; ++i) q[i] = values.at(size_t(i));
  return q;
}

Rigid3 pose(const json& rows) {
  Rigid3 p;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) p.rotation(r, c) = rows.at(size_t(r)).at(size_t(c));
    p.translation[r] = rows.at(size_t(r)).at(3);
  }
  return p;
}

Puma560 wristArm() {
  Puma560Options options;
  options.shoulder_height = options.d6 = 0;
  return Puma560(options);
}

ArmConfiguration configuration(const json& solution) {
  return {solution.at("arm") == "r" ? Shoulder::kRight : Shoulder::kLeft,
          solution.at("elbow") == "u" ? Elbow::kUp : Elbow::kDown,
          solution.at("sign_q5") == 1 ? Wrist::kPositive : Wrist::kNegative};
}

void checkForward(const Puma560& arm, const json& vector) {
  const Rigid3 expected = pose(vector.at("T")), actual = arm.baseFromTool0(joints(vector.at("q")));
  EXPECT_LT((actual.translation - expected.translation).norm(), kDigits);
  EXPECT_LT(rotationError(actual.rotation, expected.rotation), kDigits);
}

void checkJacobian(const Puma560& arm, const json& vector) {
  const Matrix6d actual = arm.jacobian(joints(vector.at("q")));
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(actual(r, c), double(vector.at("jacob0").at(size_t(r)).at(size_t(c))), kDigits);
}

/// Every variant of the file is found once with its configuration, and nothing else.
void checkInverse(const Puma560& arm, const json& vector) {
  ArmSolutions found;
  arm.inverse(arm.baseFromTool0(joints(vector.at("q"))), JointVector::Zero(), &found);
  int expected = 0;
  for (const json& solution : vector.at("solutions"))
    for (const json& variant : solution.at("in_limit_variants")) {
      ++expected;
      int same = 0;
      for (const ArmSolution& s : found)
        same += s.configuration == configuration(solution) &&
                (s.joints - joints(variant)).cwiseAbs().maxCoeff() < kAngle;
      EXPECT_EQ(same, 1) << variant;
    }
  EXPECT_EQ(found.size(), expected);
}

/// All eight configurations, limits or not: each joint may turn once around.
void checkConfigurations(const json& vector) {
  Puma560Options options;
  options.shoulder_height = options.d6 = 0;
  for (JointLimit& limit : options.joints) {
    limit.lower = -M_PI;
    limit.upper = M_PI - 1e-8;
  }
  const Puma560 arm(options);
  ArmSolutions found;
  arm.inverse(arm.baseFromTool0(joints(vector.at("q"))), JointVector::Zero(), &found);
  EXPECT_EQ(found.size(), 8);
  for (const json& solution : vector.at("solutions")) {
    int same = 0;
    for (const ArmSolution& s : found)
      same += s.configuration == configuration(solution) &&
              (s.joints - joints(solution.at("q"))).cwiseAbs().maxCoeff() < kAngle;
    EXPECT_EQ(same, 1) << solution.at("q");
  }
}

void checkAll(const std::string& path, size_t at_least) {
  std::ifstream file(path);
  ASSERT_TRUE(file) << path;
  const json data = json::parse(file);
  const Puma560 arm = wristArm();
  EXPECT_EQ(data.at("named").size(), 4u);
  for (const auto& named : data.at("named").items()) {
    SCOPED_TRACE(named.key());
    checkForward(arm, named.value());
  }

  EXPECT_GE(data.at("vectors").size(), at_least);
  for (size_t i = 0; i < data.at("vectors").size(); ++i) {
    SCOPED_TRACE("vector " + std::to_string(i));
    const json& vector = data.at("vectors").at(i);
    checkForward(arm, vector);
    checkJacobian(arm, vector);
    checkInverse(arm, vector);
    checkConfigurations(vector);
  }
}

TEST(Puma560Vectors, OfThisPackage) {
  checkAll(MONOCULAR_EYE_HAND_SOURCE_DIR "/test/arm/puma560_vectors.json", 6);
}

TEST(Puma560Vectors, All) {
  const char* data = std::getenv("MONOCULAR_EYE_HAND_DATA");
  if (!data) GTEST_SKIP() << "MONOCULAR_EYE_HAND_DATA is not set";
  const std::string path = std::string(data) + "/../facts/puma560_vectors.json";
  if (!std::ifstream(path)) GTEST_SKIP() << path << " is not there";
  checkAll(path, 30);
}

TEST(Puma560Vectors, PedestalAndFlange) {
  const Puma560
      arm;  // the toolbox: fkine(qn) = (0.5963, -0.15005, 0.65748) with pedestal; the hand points to +x
  JointVector qn = JointVector::Zero();
  qn[1] = M_PI / 4;
  qn[2] = M_PI;
  qn[4] = M_PI / 4;
  const Eigen::Vector3d expected(0.596303148575 + 0.05625, -0.15005, -0.014354267658 + 0.67183);
  EXPECT_LT((arm.baseFromTool0(qn).translation - expected).norm(), kDigits);
}

}  // namespace
}  // namespace monocular_eye_hand
