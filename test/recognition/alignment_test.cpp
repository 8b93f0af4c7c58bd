#include "recognition/alignment.h"

#include <random>

#include "support/pose_matchers.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

// What an alignment needs of one shipped picture of one part.
class Alignment : public testing::TestWithParam<const char*> {
 protected:
  Alignment()
      : picture_(shippedPicture(std::string("golden/") + GetParam())),
        model_(shippedModels().objects.at(size_t(shippedModels().indexOf(GetParam())))),
        image_(withFeatures(picture_.grey, picture_.camera, {})),
        truth_(picture_.truth.at(0).camera_from_object) {}

  // A turn of `angle` rad about a random axis through the centre, `pixels` sideways, `share` of the distance.
  Rigid3 perturbedTruth(double angle, double pixels, double share, std::mt19937* random) const {
    std::normal_distribution<double> normal;
    const auto sign = [&] { return normal(*random) < 0 ? -1.0 : 1.0; };
    const Eigen::Vector3d axis =
        Eigen::Vector3d(normal(*random), normal(*random), normal(*random)).normalized();
    const double way = M_PI * normal(*random);
    const Eigen::Vector3d centre = truth_ * model_.model().centre();
    const double metres = pixels * centre.z() / picture_.camera.fx;
    const Eigen::Vector3d moved =
        (1 + sign() * share) * (centre + metres * Eigen::Vector3d(std::cos(way), std::sin(way), 0));
    Rigid3 pose;
    pose.rotation = expSO3(angle * axis) * truth_.rotation;
    pose.translation = moved - pose.rotation * model_.model().centre();
    return pose;
  }
  double imageError(const Rigid3& pose) const {
    return poseError(model_.model(), picture_.camera, pose, truth_).image;
  }

  Picture picture_;
  SearchModel model_;
  SearchImage image_;
  Rigid3 truth_;
};

TEST_P(Alignment, CoarseThenFineFindsBackFrom4Degrees4PxAnd4Percent) {
  std::mt19937 random(7);
  const int tries = 20;
  // Of the frame, 270 px wide, that would move points by twice the reach of the association.
  const double amount = std::string(GetParam()) == "frame" ? 0.6 : 1;
  int coarse = 0, fine = 0;
  for (int i = 0; i < tries; ++i) {
    ViewedPose start;
    start.camera_from_object =
        model_.canonical(perturbedTruth(0.07 * amount, 4 * amount, 0.04 * amount, &random), &start.view);
    std::optional<ViewedPose> moved = alignCoarsely(model_, image_, start, kWideRanges);
    if (moved) moved = alignCoarsely(model_, image_, *moved, kNarrowRanges);
    if (!moved) continue;
    coarse += imageError(moved->camera_from_object) < 5;
    const RefinedPose refined =
        alignFinely(model_, image_, moved->camera_from_object, kFineRanges, kFineStep);
    fine += refined.well_posed && imageError(refined.camera_from_object) < 1.5;
  }

  EXPECT_GE(coarse, 18);
  EXPECT_GE(fine, 18);
}

TEST_P(Alignment, FineAloneIsExactFromNearbyAndKnowsItsCertainty) {
  std::mt19937 random(8);
  for (int i = 0; i < 5; ++i) {
    const RefinedPose refined =
        alignFinely(model_, image_, perturbedTruth(0.01, 1, 0.01, &random), kFineRanges, kFineStep);
    ASSERT_TRUE(refined.well_posed);
    EXPECT_LT(imageError(refined.camera_from_object), 1.0);
    EXPECT_LT(refined.rms, 0.6);
    EXPECT_GT(refined.inliers, 20);
    const Matrix6d& c = refined.covariance;
    EXPECT_TRUE(c.allFinite());
    EXPECT_LT((c - c.transpose()).norm(), 1e-9 * c.norm());
    EXPECT_GT(c.diagonal().minCoeff(), 0);
    EXPECT_LT(c(0, 0), c(2, 2)) << "depth is the least certain direction";
    EXPECT_LT(std::sqrt(c(0, 0)), 1e-3);
  }
}

TEST_P(Alignment, WhereThereIsNoEdgeItFailsAndSaysSo) {
  const SearchImage empty =
      withFeatures(cv::Mat(picture_.grey.size(), CV_8UC1, cv::Scalar(90)), picture_.camera, {});
  ASSERT_TRUE(empty.features.points.empty());
  ViewedPose start;
  start.camera_from_object = model_.canonical(truth_, &start.view);
  EXPECT_FALSE(alignCoarsely(model_, empty, start, kWideRanges));
  const RefinedPose refined = alignFinely(model_, empty, truth_, kFineRanges, kFineStep);
  EXPECT_FALSE(refined.well_posed);
  EXPECT_THAT(truth_, PoseNear(refined.camera_from_object, 1e-09, 6e-11)) << "the start comes back";
}

TEST_P(Alignment, TheProjectedContourLiesOnTheImageEdges) {
  const std::vector<SeenSample> contour =
      projectContour(model_.model(), truth_, picture_.camera, image_.domain, 4.0);
  ASSERT_GT(contour.size(), 50u);
  int on_edge = 0, outline = 0;
  for (const SeenSample& s : contour) {
    ASSERT_LT((s.uv - picture_.camera.project(truth_ * s.p_in_object)).norm(), 1e-9);
    ASSERT_NEAR(s.direction.norm(), 1, 1e-9);
    ASSERT_EQ(s.inside, image_.domain.contains(s.uv.x(), s.uv.y()));
    ASSERT_GE(s.feature, 0);
    ASSERT_LT(s.feature, model_.model().featureCount());
    ASSERT_EQ(s.edge_point, -1) << "matching comes later";
    outline += s.silhouette;
    on_edge += image_.raster.find(s.uv, {-s.direction.y(), s.direction.x()}, 2) >= 0;
  }

  EXPECT_GT(outline, 10);
  EXPECT_GT(on_edge, 0.8 * double(contour.size()));
  const auto coarse = projectContour(model_.model(), truth_, picture_.camera, image_.domain, 8.0);
  EXPECT_NEAR(double(contour.size()) / double(coarse.size()), 2, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Golden, Alignment,
                         testing::Values("bridge", "grenade", "frame", "flange", "bracket"),
                         [](const auto& info) { return std::string(info.param); });

TEST(ProjectedContour, TellsHowFarARoundedEdgeMayLieFromItsMiddle) {
  ObjectModel model = shippedModels().objects.at(0).model;
  const Picture picture = shippedPicture("golden/" + model.name);
  const Rigid3 pose = picture.truth.at(0).camera_from_object;
  const RectDomain domain = withFeatures(picture.grey, picture.camera, {}).domain;
  ASSERT_FALSE(model.edges.empty());
  for (ModelEdge& edge : model.edges) edge.rounding = 1e-3;

  int of_edges = 0;
  for (const SeenSample& s : projectContour(model, pose, picture.camera, domain, 2)) {
    if (s.feature >= int(model.edges.size())) {
      EXPECT_EQ(s.rounding, 0);
      continue;
    }
    ++of_edges;
    const double half_chord = 1e-3 * std::sin(model.edges[size_t(s.feature)].dihedral / 2);
    const double pixels_per_metre = picture.camera.fx / (pose * s.p_in_object).z();
    EXPECT_NEAR(s.rounding, half_chord * pixels_per_metre / std::sqrt(3.0), 0.02 * s.rounding);
  }
  EXPECT_GT(of_edges, 20);
}

}  // namespace
}  // namespace monocular_eye_hand
