#include "recognition/verification.h"

#include <set>

#include "model/build_model.h"
#include "monocular_eye_hand/pose/refine.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "recognition/constellation.h"
#include "verified.h"

namespace monocular_eye_hand {
namespace {

KnownObject knownBox(const std::string& name, const Eigen::Vector3d& size) {
  KnownObject object;
  object.model = buildModel(name, boxMesh(size));
  object.views = sampleViews(object.model, {});
  return object;
}

Rigid3 shifted(const Rigid3& pose, double du, double dv, const Camera& camera) {
  Rigid3 moved = pose;
  moved.translation += pose.translation.z() * Eigen::Vector3d(du / camera.fx, dv / camera.fy, 0);
  return moved;
}

class OnGolden : public testing::TestWithParam<const char*> {};

TEST_P(OnGolden, TheTruePoseIsBorneOutAndAShiftedOneIsNot) {
  const Picture picture = shippedPicture(std::string("golden/") + GetParam());
  const SearchImage image = looked(picture.grey, picture.camera);
  const SearchModel model(shippedModels().objects.at(size_t(shippedModels().indexOf(GetParam()))));
  const Rigid3 truth = picture.truth.at(0).camera_from_object;

  const Candidate right = verified(image, model, truth);
  const EvidenceTerms& t = right.terms;
  EXPECT_GT(t.hit_ratio, 0.85);
  EXPECT_GT(t.silhouette_hits, 0.75);
  EXPECT_GT(t.mean, 0.5);
  EXPECT_GT(t.sum, 30);
  EXPECT_NEAR(t.in_frame, 1, 1e-9);
  EXPECT_LT(t.unsupported, 0.3);
  EXPECT_LT(t.unsupported_length, 0.1);
  EXPECT_LT(t.continuation, 0.2);
  EXPECT_LT(t.overhang, 0.3);
  EXPECT_LT(t.rms, 0.8);
  EXPECT_GT(t.contour_length, 200);
  EXPECT_GE(t.faces, 2);
  EXPECT_GT(t.solidity, 0.2);
  EXPECT_LE(t.solidity, 1);
  EXPECT_EQ(right.matched_features, int(std::lround(t.groups * (1 - t.unsupported))));

  for (const auto& [du, dv] : {std::pair{15.0, 0.0}, {0.0, 15.0}, {-12.0, 12.0}}) {
    const EvidenceTerms wrong = verified(image, model, shifted(truth, du, dv, picture.camera)).terms;
    EXPECT_LT(wrong.hit_ratio, 0.6 * t.hit_ratio) << du << ", " << dv;
    EXPECT_LT(wrong.sum, 0.4 * t.sum) << du << ", " << dv;
    EXPECT_GT(wrong.unsupported, t.unsupported + 0.2) << du << ", " << dv;
    EXPECT_LT(fittedWeights().probability(decisionValues(wrong)), 0.2) << du << ", " << dv;
  }
  EXPECT_GT(fittedWeights().probability(decisionValues(t)), 0.5);
}

TEST_P(OnGolden, SaysWhichEdgePointsAndCellsItTakes) {
  const Picture picture = shippedPicture(std::string("golden/") + GetParam());
  const SearchImage image = looked(picture.grey, picture.camera);
  const SearchModel model(shippedModels().objects.at(size_t(shippedModels().indexOf(GetParam()))));
  const Candidate c = verified(image, model, picture.truth.at(0).camera_from_object);

  const auto strictlyAscending = [](const std::vector<int>& v) {
    return std::adjacent_find(v.begin(), v.end(), std::greater_equal<int>()) == v.end();
  };
  EXPECT_TRUE(strictlyAscending(c.claimed));
  EXPECT_TRUE(strictlyAscending(c.covered));

  std::set<int> answered;
  for (const SeenSample& s : c.contour) {
    if (s.edge_point < 0) continue;
    answered.insert(s.edge_point);
    ASSERT_LT((image.features.points.at(size_t(s.edge_point)).uv.cast<double>() - s.uv).norm(), 4);
  }
  EXPECT_EQ(c.claimed, std::vector<int>(answered.begin(), answered.end()));

  const cv::Rect truth = picture.truth.at(0).box_visible;
  EXPECT_NEAR(c.bounding_box.x, truth.x, 3);
  EXPECT_NEAR(c.bounding_box.y, truth.y, 3);
  EXPECT_NEAR(c.bounding_box.br().x, truth.br().x, 3);
  EXPECT_NEAR(c.bounding_box.br().y, truth.br().y, 3);

  const int cells_x = (image.domain.width + kCoverCell - 1) / kCoverCell;
  for (int cell : c.covered) {
    const cv::Rect area(cell % cells_x * kCoverCell, cell / cells_x * kCoverCell, kCoverCell, kCoverCell);
    ASSERT_GT((area & c.bounding_box).area(), 0);
  }
  const double drawn = double(c.covered.size()) * kCoverCell * kCoverCell;
  EXPECT_NEAR(c.terms.size * c.terms.size / drawn, 0.9, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Golden, OnGolden, testing::Values("bridge", "grenade", "frame", "flange", "bracket"),
                         [](const auto& info) { return std::string(info.param); });

// A bar on a table, and the same bar twice as long: a short box fits into either.
class Bars : public testing::Test {
 protected:
  Bars() : object_(knownBox("bar", {0.08, 0.04, 0.04})), model_(object_) {}

  Scene scene(double length, const Material& material) const {
    Rigid3 at;  // one end stays where it is
    at.translation = {(length - 0.08) / 2, 0, 0};
    SceneObject bar = standing("bar", boxMesh({length, 0.04, 0.04}), at);
    bar.material = material;
    Scene scene = plainScene({bar}, lookFrom(-1.1, 0.75, 0.5, {0.02, 0, 0.02}));
    scene.table.material = {0.2, 0.0, 20, {}};
    return scene;
  }
  Candidate lookAtBar(double length, const Material& material = {}) const {
    const Scene seen = scene(length, material);
    RenderOptions options;
    options.shadows = false;
    const SearchImage image = looked(renderScene(seen, testCamera(), options).grey, testCamera());
    return verified(image, model_, seen.world_from_camera.inverse());  // the short bar stands at the origin
  }

  KnownObject object_;
  SearchModel model_;
};

TEST_F(Bars, EdgesThatRunOnContradictTheShortBox) {
  const EvidenceTerms right = lookAtBar(0.08).terms, wrong = lookAtBar(0.16).terms;
  EXPECT_GT(right.hit_ratio, 0.9);
  EXPECT_LT(right.continuation, 0.05);
  EXPECT_GE(right.ends, 6);
  EXPECT_LT(right.overhang, 0.1);
  EXPECT_GT(wrong.continuation, 0.15);
  EXPECT_GT(wrong.overhang, right.overhang + 0.2);
  EXPECT_LT(fittedWeights().probability(decisionValues(wrong)),
            fittedWeights().probability(decisionValues(right)));
}

TEST_F(Bars, PatternedFacesCarryEdgesThatTheModelDoesNotExplain) {
  Material pattern;
  pattern.texture = {Texture::Kind::kChecker, 0.008, 0.6, 1};
  const EvidenceTerms plain = lookAtBar(0.08).terms, patterned = lookAtBar(0.08, pattern).terms;
  EXPECT_LT(plain.interior, 0.05);
  EXPECT_LT(plain.off_face, 0.05);
  EXPECT_GT(patterned.interior, 0.25);
  EXPECT_GT(patterned.off_face, 0.1);
  EXPECT_EQ(plain.faces, patterned.faces);
  EXPECT_NEAR(plain.faces, 3, 0);
  EXPECT_GT(plain.solidity, 0.9) << "a box fills its hull";
}

TEST_F(Bars, TermsHaveTheNamesOfTheEvidence) {
  const EvidenceTerms terms = lookAtBar(0.08).terms;
  const auto named = terms.named();
  EXPECT_EQ(named.at("sum"), terms.sum);
  EXPECT_EQ(named.at("hit_ratio"), terms.hit_ratio);
  EXPECT_EQ(named.at("overhang"), terms.overhang);
  EXPECT_EQ(named.at("rms"), terms.rms);
  EXPECT_EQ(named.size(), sizeof(EvidenceTerms) / sizeof(double)) << "a term has no name";
  for (const auto& [name, value] : named) EXPECT_TRUE(std::isfinite(value)) << name;
}

TEST_F(Bars, TheConstellationPairsEachVisibleCornerWithItsImage) {
  const Scene seen = scene(0.08, {});
  const SearchImage image = looked(renderScene(seen, testCamera()).grey, testCamera());
  const Rigid3 truth = seen.world_from_camera.inverse();
  ModelBase base;
  base.objects.push_back(object_);

  const std::vector<ImageCorner> corners = imageCorners(groupFeatures(image.features, base));
  const Candidate candidate = verified(image, model_, shifted(truth, 1, -1, testCamera()));
  const std::vector<PointMatch> matches =
      growConstellation(model_, candidate, testCamera(), image.features, corners);
  EXPECT_GE(matches.size(), 5u) << "of the seven visible corners";
  EXPECT_LE(matches.size(), 7u);

  std::set<std::pair<double, double>> image_corners;
  std::set<std::array<double, 3>> model_corners;
  for (const PointMatch& m : matches) {
    image_corners.insert({m.uv.x(), m.uv.y()});
    const Eigen::Vector3d world =
        seen.world_from_camera * (candidate.pose.camera_from_object * m.p_in_object);
    model_corners.insert({world.x(), world.y(), world.z()});
    // Where the corner truly is: the candidate is a pixel off.
    EXPECT_LT((testCamera().project(candidate.pose.camera_from_object * m.p_in_object) -
               Eigen::Vector2d(1, -1) - m.uv)
                  .norm(),
              1.5);
    EXPECT_GT(m.sigma, 0);
  }
  EXPECT_EQ(image_corners.size(), matches.size()) << "an image corner serves twice";
  EXPECT_EQ(model_corners.size(), matches.size()) << "a model corner is matched twice";

  const RefinedPose pose = poseFromBestFour(matches, candidate.pose.camera_from_object, testCamera());
  ASSERT_TRUE(pose.well_posed);
  EXPECT_LT(poseError(object_.model, testCamera(), pose.camera_from_object, truth).image, 2);
  const Candidate elsewhere = verified(image, model_, shifted(truth, 60, 0, testCamera()));
  EXPECT_LE(growConstellation(model_, elsewhere, testCamera(), image.features, corners).size(), 1u);
}

Grouping junction(const Eigen::Vector2d& corner, double sigma, int first, int second) {
  Grouping g;
  g.kind = GroupingKind::kJunction;
  g.points = {corner + Eigen::Vector2d(50, 0), corner, corner + Eigen::Vector2d(0, 50)};
  g.sigma = {1, sigma, 1};
  g.segments = {first, second};
  return g;
}

TEST(ImageCorners, NearOnesAreOneWithAllSegmentsAndTheMostCertainPlace) {
  const std::vector<ImageCorner> corners =
      imageCorners({junction({100, 100}, 1.2, 0, 1), junction({100.6, 100.3}, 0.4, 1, 2),
                    junction({110, 100}, 0.5, 3, 4)});
  ASSERT_EQ(corners.size(), 2u);
  EXPECT_EQ(corners[0].uv, Eigen::Vector2d(100.6, 100.3));
  EXPECT_EQ(corners[0].sigma, 0.4);
  EXPECT_THAT(corners[0].segments, testing::UnorderedElementsAre(0, 1, 2));
  EXPECT_THAT(corners[1].segments, testing::UnorderedElementsAre(3, 4));
  EXPECT_THAT(imageCorners({}), testing::IsEmpty());
}

}  // namespace
}  // namespace monocular_eye_hand
