// The terms that compare a drawing with the image, each where it should and where it should not show.
#include "recognition/drawing_terms.h"

#include "monocular_eye_hand/simulation/render/render.h"
#include "verified.h"

namespace monocular_eye_hand {
namespace {

RenderOptions withoutShadows() {
  RenderOptions options;
  options.shadows = false;
  return options;
}

// A box that stands at the origin on a table, or its drawing where nothing stands.
class Box : public testing::Test {
 protected:
  Box() : object_(known("box", boxMesh({0.08, 0.06, 0.04}))), model_(object_) {}

  EvidenceTerms terms(bool there, const Texture& table = {}, double elevation = 0.75) const {
    Scene scene = plainScene({}, lookFrom(-1.1, elevation, 0.5, {0, 0, 0.02}));
    if (there) scene.objects.push_back(standing("box", boxMesh({0.08, 0.06, 0.04})));
    scene.table.material = {0.25, 0.0, 20, table};
    const SearchImage image = looked(renderScene(scene, testCamera(), withoutShadows()).grey, testCamera());
    return verified(image, model_, scene.world_from_camera.inverse()).terms;
  }

  const Texture checks_{Texture::Kind::kChecker, 0.02, 0.6, 1};
  KnownObject object_;
  SearchModel model_;
};

TEST_F(Box, ItsEdgesHangTogether) {
  const EvidenceTerms right = terms(true), chance = terms(false, checks_);
  EXPECT_GT(right.claimed_ratio, 0.9);
  EXPECT_GT(right.linked, 0.9);
  EXPECT_LT(right.jitter, 0.5);
  EXPECT_GT(right.polarity, 0.95);
  EXPECT_LT(right.slant, 0.02);
  EXPECT_LT(chance.linked, right.linked);
  EXPECT_GT(chance.jitter, right.jitter);
  EXPECT_GT(chance.slant, right.slant);
  EXPECT_LT(chance.run, right.run);
}

TEST_F(Box, LiesPreciselyOnItsEdgesAndByChanceOnOthers) {
  const EvidenceTerms right = terms(true), chance = terms(false, checks_), absent = terms(false);
  EXPECT_LT(right.offset, 0.3);
  EXPECT_GE(right.precise_features, 7);
  EXPECT_GT(chance.offset, right.offset + 0.3);
  EXPECT_LT(chance.precise_features, 3);
  EXPECT_EQ(absent.precise_features, 0);
}

TEST_F(Box, OneLightExplainsItsFacesAndNoPattern) {
  EXPECT_GT(terms(true).shading, 0.9);
  EXPECT_LT(terms(false, checks_).shading, 0.3);
}

TEST_F(Box, ThatIsNotThereIsMissedOnFlatGround) {
  const EvidenceTerms right = terms(true), absent = terms(false);
  EXPECT_LT(right.outline_bare, 0.05);
  EXPECT_GT(right.outline_hits, 0.9);
  EXPECT_GT(right.inner_found, 2);
  EXPECT_GT(absent.outline_bare, 0.9);
  EXPECT_GT(absent.inner_bare, 0.9);
  EXPECT_EQ(absent.inner_found, 0);
  EXPECT_EQ(absent.features_bare, 1);
}

TEST_F(Box, OfEdgesEverywhereTheDrawingIsAnsweredBesideItToo) {
  const EvidenceTerms plain = terms(true), checked = terms(false, checks_);
  EXPECT_LT(plain.chance_mean, 0.25);
  EXPECT_GT(checked.chance_mean, plain.chance_mean + 0.05);
  EXPECT_GT(plain.excess, checked.excess);
  EXPECT_GE(plain.chance, plain.chance_mean);
}

TEST_F(Box, ImageEdgesEndAtItsOutlineAndRunThroughAWrongOne) {
  const Texture bricks{Texture::Kind::kBricks, 0.03, 0.6, 1};
  const EvidenceTerms right = terms(true, bricks), wrong = terms(false, bricks);
  EXPECT_LT(right.crossed, 0.05);
  EXPECT_GT(wrong.crossed, right.crossed + 0.1);
  EXPECT_GT(wrong.through, right.through);
}

TEST_F(Box, ViewTermsTellHowMuchOfItThisSideShows) {
  const EvidenceTerms oblique = terms(true), low = terms(true, {}, 0.1);
  EXPECT_GT(oblique.view_area, low.view_area);
  EXPECT_LE(oblique.view_area, 1);
  EXPECT_GT(low.extent, 0.5);
  EXPECT_NEAR(oblique.diameter, object_.model.diameter / 0.5 * 700, 15);
}

TEST(Prints, StayWithinTheFaceAndAreToldFromEdgesThatRunThroughIt) {
  const KnownObject object = known("box", boxMesh({0.08, 0.06, 0.04}));
  const SearchModel model(object);
  Scene scene =
      plainScene({standing("box", boxMesh({0.08, 0.06, 0.04}))}, lookFrom(-1.1, 0.9, 0.5, {0, 0, 0.02}));
  scene.table.material = {0.25, 0.0, 20, {}};
  SceneObject label = standing("label", boxMesh({0.03, 0.02, 0.0003}));
  label.world_from_object.translation = {0, 0, 0.0401};
  label.material.albedo = 0.15;
  const Rigid3 pose = scene.world_from_camera.inverse();
  const EvidenceTerms plain =
      verified(looked(renderScene(scene, testCamera(), withoutShadows()).grey, testCamera()), model, pose)
          .terms;
  scene.objects.push_back(label);
  const EvidenceTerms printed =
      verified(looked(renderScene(scene, testCamera(), withoutShadows()).grey, testCamera()), model, pose)
          .terms;

  EXPECT_LT(plain.print, 0.01);
  EXPECT_GT(printed.print, 0.03);
  EXPECT_LT(printed.through, 0.01);
  EXPECT_NEAR(printed.print + printed.through, printed.interior, 1e-9);
}

TEST(InnerFeatures, AFrameDrawnOnAPlateMissesItsOpening) {
  const SearchModel frame(shippedModels().objects.at(size_t(shippedModels().indexOf("frame"))));
  const Eigen::Vector3d size = shippedModel("frame").bounds.sizes();
  const Rigid3 world_from_camera = lookFrom(-1.1, 0.9, 0.9, {0, 0, 0.02});
  const auto seen = [&](const Mesh& mesh) {
    Scene scene = plainScene({standing("part", mesh)}, world_from_camera);
    scene.table.material = {0.2, 0.0, 20, {}};
    const SearchImage image = looked(renderScene(scene, testCamera(), withoutShadows()).grey, testCamera());
    return verified(image, frame, world_from_camera.inverse()).terms;
  };
  const EvidenceTerms right = seen(shippedModel("frame").mesh), plate = seen(boxMesh(size));
  EXPECT_GT(plate.outline_hits, 0.4) << "its outer edges are the plate's";
  EXPECT_GT(plate.outline_bare, right.outline_bare + 0.15) << "the opening is an outline, too";
  EXPECT_GT(plate.features_bare, right.features_bare + 0.3);
  EXPECT_LT(fittedWeights().probability(decisionValues(plate)),
            fittedWeights().probability(decisionValues(right)));
}

}  // namespace
}  // namespace monocular_eye_hand
