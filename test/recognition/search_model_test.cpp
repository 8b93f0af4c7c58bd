#include "recognition/search_model.h"

#include <Eigen/Geometry>
#include <random>

#include "support/random.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

const SearchModel& searchModel(const std::string& name) {
  static std::map<std::string, SearchModel> models;
  auto it = models.find(name);
  if (it == models.end())
    it = models.emplace(name, SearchModel(shippedModels().objects.at(size_t(shippedModels().indexOf(name)))))
             .first;
  return it->second;
}

const char* const kParts[] = {"bridge", "grenade", "frame", "flange", "bracket"};

Rigid3 randomPose(std::mt19937* random) {
  const Eigen::Matrix3d rotation = randomRotation(*random);
  const double x = uniform(*random, -0.15, 0.15), y = uniform(*random, -0.15, 0.15);
  return {rotation, {x, y, uniform(*random, 0.5, 1.5)}};
}

Rigid3 turned(const SymmetryAxis& axis, double angle) {
  Rigid3 turn;
  turn.rotation = Eigen::AngleAxisd(angle, axis.direction).toRotationMatrix();
  turn.translation = axis.point - turn.rotation * axis.point;
  return turn;
}

// Every equal copy of a pose: by the discrete symmetries, and by some angles about an axis.
std::vector<Rigid3> copies(const ObjectModel& model, const Rigid3& pose) {
  std::vector<Rigid3> all;
  for (const Rigid3& s : model.symmetries.discrete) {
    if (!model.symmetries.axis)
      all.push_back(pose * s);
    else
      for (double angle : {0.0, 0.7, 2.5, -1.9})
        all.push_back(pose * s * turned(*model.symmetries.axis, angle));
  }
  return all;
}

// The camera at `eye` (from the centre, object frame) looks at the centre.
Rigid3 seenFrom(const SearchModel& model, const Eigen::Vector3d& eye) {
  Rigid3 pose;
  pose.rotation =
      Eigen::Quaterniond::FromTwoVectors(-eye, Eigen::Vector3d::UnitZ()).normalized().toRotationMatrix();
  pose.translation = Eigen::Vector3d(0, 0, eye.norm()) - pose.rotation * model.model().centre();
  return pose;
}

TEST(SearchModel, AGroupingShowsWhereverASampledViewSeesItOrAnEqualCopy) {
  for (const char* part : kParts) {
    const SearchModel& model = searchModel(part);
    const std::vector<Rigid3>& symmetries = model.model().symmetries.discrete;
    for (size_t g = 0; g < model.groupings().size(); ++g)
      for (const SeenFrom& from : model.groupings()[g].seen) {
        const SampledView& view = model.object().views.views[size_t(from.view)];
        const Eigen::Vector3d eye =
            symmetries[size_t(from.symmetry)].rotation.transpose() * view.direction * view.distance;
        ASSERT_TRUE(model.shows(g, seenFrom(model, eye))) << part << ", grouping " << g;
      }
  }
}

TEST(SearchModel, TheCornersOfAFaceDoNotShowFromBehind) {
  int faces = 0;
  for (const char* part : {"bridge", "grenade", "bracket"}) {
    const SearchModel& model = searchModel(part);
    for (size_t g = 0; g < model.groupings().size(); ++g) {
      const ModelGrouping& quad = model.groupings()[g];
      if (quad.kind != GroupingKind::kQuad) continue;
      const Eigen::Vector3d normal =
          (quad.points[1] - quad.points[0]).cross(quad.points[2] - quad.points[1]).normalized();
      const bool front = model.shows(g, seenFrom(model, normal)),
                 back = model.shows(g, seenFrom(model, -normal));
      EXPECT_FALSE(front && back) << part << ", grouping " << g;
      faces += front != back;
    }
  }
  EXPECT_GE(faces, 10);
}

TEST(SearchModel, ACanonicalPoseIsEqualAndItsViewIsNearTheEye) {
  std::mt19937 random(1);
  for (const char* part : kParts) {
    const SearchModel& model = searchModel(part);
    const ViewSphere& sphere = model.object().views;
    for (int i = 0; i < 200; ++i) {
      const Rigid3 pose = randomPose(&random);
      int view = -1;
      const Rigid3 canonical = model.canonical(pose, &view);
      ASSERT_LT(model.poseDistance(testCamera(), canonical, pose), 1e-3) << part;
      ASSERT_GE(view, 0);
      ASSERT_LT(view, int(sphere.views.size()));
      const Eigen::Vector3d eye = canonical.inverse().translation - model.model().centre();
      const double angle = std::acos(std::min(1.0, eye.normalized().dot(sphere.views[view].direction)));
      // 0.75 of the spacing (0.21 rad) covers the sphere; a cell of the look-up adds its half diagonal.
      ASSERT_LT(angle, 0.75 * ViewOptions{}.spacing + 0.06) << part;
      for (double other : sphere.distances)
        ASSERT_LE(std::abs(1 / eye.norm() - 1 / sphere.views[view].distance),
                  std::abs(1 / eye.norm() - 1 / other) + 1e-12)
            << part;
    }
  }
}

TEST(SearchModel, TheCameraIsOutsideTheHullAndEveryPointInFront) {
  const SearchModel& model = searchModel("frame");  // 300 x 220 x 25 mm
  const Eigen::Vector3d centre = model.model().centre();
  const auto seenAt = [&](const Eigen::Vector3d& centre_in_camera, double turn) {
    Rigid3 pose;
    pose.rotation = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX()).toRotationMatrix();
    pose.translation = centre_in_camera - pose.rotation * centre;
    return model.seenFromOutside(pose);
  };
  EXPECT_TRUE(seenAt({0, 0, 0.5}, 0.4));
  EXPECT_TRUE(seenAt({0, 0, 0.05}, 0)) << "near, but before it";
  EXPECT_FALSE(seenAt({0, 0, 0.01}, 0)) << "the eye is within the hull";
  EXPECT_FALSE(seenAt({0, 0, 0.1}, M_PI / 2)) << "on edge, a part of it is behind the camera";
  EXPECT_FALSE(seenAt({0, 0, -0.5}, 0)) << "behind the camera";
}

TEST(SearchModel, EqualPosesHaveOneCanonicalPose) {
  std::mt19937 random(2);
  for (const char* part : kParts) {
    const SearchModel& model = searchModel(part);
    int same = 0, total = 0;
    for (int i = 0; i < 100; ++i) {
      const Rigid3 pose = randomPose(&random);
      int view = -1;
      const Rigid3 canonical = model.canonical(pose, &view);
      for (const Rigid3& copy : copies(model.model(), pose)) {
        int other_view = -1;
        const Rigid3 other = model.canonical(copy, &other_view);
        ++total;
        same += difference(canonical, other).norm() < 1e-3;
      }
    }
    // At the border of the fundamental domain either side may be chosen.
    EXPECT_GE(same, 0.9 * total) << part;
  }
}

TEST(SearchModel, CanonicalIsStable) {
  std::mt19937 random(3);
  for (const char* part : kParts)
    for (int i = 0; i < 50; ++i) {
      int first = -1, second = -1;
      const Rigid3 once = searchModel(part).canonical(randomPose(&random), &first);
      const Rigid3 twice = searchModel(part).canonical(once, &second);
      ASSERT_LT(searchModel(part).poseDistance(testCamera(), once, twice), 1e-3);
      ASSERT_EQ(searchModel(part).object().views.views[first].distance,
                searchModel(part).object().views.views[second].distance);
    }
}

TEST(PoseDistance, IsZeroBetweenSymmetricCopiesAndOnlyThere) {
  std::mt19937 random(4);
  for (const char* part : kParts) {
    const SearchModel& model = searchModel(part);
    for (int i = 0; i < 20; ++i) {
      const Rigid3 pose = randomPose(&random);
      for (const Rigid3& copy : copies(model.model(), pose)) {
        // The symmetries of a mesh are found to within a share of a thousandth of its size.
        ASSERT_LT(model.poseDistance(testCamera(), pose, copy), 0.05) << part;
        ASSERT_LT(model.poseDistance(testCamera(), copy, pose), 0.05) << part;
      }
      Rigid3 quarter;  // no part has a quarter turn about x
      quarter.rotation = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
      ASSERT_GT(model.poseDistance(testCamera(), pose, pose * quarter), 5) << part;
    }
  }
}

TEST(PoseDistance, IsTheLargestShiftInTheImage) {
  Rigid3 pose, moved;
  pose.translation = {0, 0, 1};
  moved.translation = {0.01, 0, 1};
  const SearchModel& model = searchModel("bracket");  // in front of the camera: depth 1 m plus its height
  const double nearest = 1 + model.model().bounds.min().z();
  EXPECT_NEAR(model.poseDistance(testCamera(), pose, moved), 700 * 0.01 / nearest, 1e-6);
  moved.translation = {0, 0, -1};
  EXPECT_GT(model.poseDistance(testCamera(), pose, moved), 1e6) << "behind the camera";
}

class OnPicture : public testing::TestWithParam<const char*> {
 protected:
  OnPicture()
      : picture_(shippedPicture(std::string("golden/") + GetParam())),
        domain_(rectDomain(picture_.camera)),
        map_(detectFeatures(picture_.grey, picture_.camera), domain_),
        truth_(picture_.truth.at(0).camera_from_object) {}

  CoarseScore score(const Rigid3& pose) const {
    int view = 0;
    const SearchModel& model = searchModel(GetParam());
    const Rigid3 canonical = model.canonical(pose, &view);
    return scorePose(model.coarse(view), canonical, picture_.camera, map_);
  }
  // Moved in the image by (du, dv) px, its distance times `stretch`, turned about its centre.
  Rigid3 moved(double du, double dv, double stretch, const Eigen::Vector3d& turn) const {
    const Eigen::Vector3d centre = truth_ * shippedModel(GetParam()).centre();
    const Eigen::Vector3d shift(du * centre.z() / picture_.camera.fx, dv * centre.z() / picture_.camera.fy,
                                0);
    Rigid3 pose;
    pose.rotation = expSO3(turn) * truth_.rotation;
    pose.translation = stretch * (centre + shift) - pose.rotation * shippedModel(GetParam()).centre();
    return pose;
  }

  Picture picture_;
  RectDomain domain_;
  EvidenceMap map_;
  Rigid3 truth_;
};

TEST_P(OnPicture, TheTruePoseScoresFarAbovePerturbedOnes) {
  const CoarseScore truth = score(truth_);
  EXPECT_GT(truth.evidence, 25);
  EXPECT_NEAR(truth.in_frame, 1, 1e-6);
  for (double sign : {-1.0, 1.0}) {
    EXPECT_LT(score(moved(sign * 14, 0, 1, {0, 0, 0})).evidence, 0.5 * truth.evidence);
    EXPECT_LT(score(moved(0, sign * 14, 1, {0, 0, 0})).evidence, 0.5 * truth.evidence);
    EXPECT_LT(score(moved(0, 0, 1, {0, 0, sign * 0.35})).evidence, 0.6 * truth.evidence);
    EXPECT_LT(score(moved(0, 0, 1 + sign * 0.2, {0, 0, 0})).evidence, 0.5 * truth.evidence);
  }
}

TEST_P(OnPicture, WhatLiesBeyondTheImageSaysNothing) {
  // The image ends at the object's centre.
  RectDomain cut = domain_;
  cut.width = int(picture_.camera.project(truth_ * shippedModel(GetParam()).centre()).x());
  int view = 0;
  const SearchModel& model = searchModel(GetParam());
  const Rigid3 canonical = model.canonical(truth_, &view);
  const CoarseScore half = scorePose(model.coarse(view), canonical, picture_.camera,
                                     EvidenceMap(detectFeatures(picture_.grey, picture_.camera), cut));
  EXPECT_GT(half.in_frame, 0.25);
  EXPECT_LT(half.in_frame, 0.75);
  EXPECT_GT(half.evidence, 5);
  EXPECT_LT(half.evidence, score(truth_).evidence);
  const CoarseScore beyond = score(moved(-800, 0, 1, {0, 0, 0}));
  EXPECT_EQ(beyond.in_frame, 0);
  EXPECT_LE(beyond.evidence, 0);
}

INSTANTIATE_TEST_SUITE_P(Golden, OnPicture, testing::ValuesIn(kParts),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace monocular_eye_hand
