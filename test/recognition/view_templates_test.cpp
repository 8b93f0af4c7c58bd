// What a model offers as base edges of view templates.
#include "recognition/view_templates.h"

#include <algorithm>

#include "../mesh/shapes.h"
#include "recognition/search_model.h"
#include "verified.h"

namespace monocular_eye_hand {
namespace {

// Lengths of a part's base edges over all views of the farthest level [m].
std::vector<double> baseLengths(const Mesh& mesh) {
  const KnownObject object = known("part", mesh);
  const SearchModel model(object);
  std::vector<double> lengths;
  for (const ViewTemplate& one : model.levels().back().templates) lengths.push_back(one.length);
  return lengths;
}

TEST(ViewTemplates, OfABoxAreItsEdges) {
  const std::vector<double> lengths = baseLengths(boxMesh({0.08, 0.06, 0.04}));
  ASSERT_FALSE(lengths.empty());
  EXPECT_TRUE(std::is_sorted(lengths.begin(), lengths.end()));
  EXPECT_NEAR(lengths.back(), 0.08, 0.004) << "the longest edge, seen across";
  EXPECT_GE(lengths.front(), 0.1 * std::sqrt(0.08 * 0.08 + 0.06 * 0.06 + 0.04 * 0.04) - 1e-9);
}

TEST(ViewTemplates, OfACylinderAreTheLimbsOfItsWall) {
  const std::vector<double> lengths = baseLengths(cylinderMesh(0.02, 0.08));
  ASSERT_FALSE(lengths.empty()) << "it has no straight edge";
  EXPECT_NEAR(lengths.back(), 0.08, 0.006);
}

// A screw whose thread is rings of crest and root.
Mesh screw(double radius, double shank, double head) {
  constexpr double kPitch = 0.00125;
  shapes::Outline profile{{0, 0}};
  for (double z = 0; z < shank - kPitch; z += kPitch) {
    profile.emplace_back(0.85 * radius, z);
    profile.emplace_back(radius, z + 0.5 * kPitch);
  }
  profile.insert(profile.end(),
                 {{radius, shank}, {2 * radius, shank}, {2 * radius, shank + head}, {0, shank + head}});
  return shapes::revolved(profile, 36);
}

TEST(ViewTemplates, OfAScrewAreTheSidesOfItsShank) {
  const double radius = 0.004, shank = 0.045;
  const std::vector<double> lengths = baseLengths(screw(radius, shank, 0.006));
  const auto beside = std::count_if(lengths.begin(), lengths.end(),
                                    [&](double length) { return std::abs(length - shank) < 0.1 * shank; });
  EXPECT_GE(beside, 2) << "in the view from the side";
}

TEST(ViewTemplates, ABallHasNone) { EXPECT_TRUE(baseLengths(sphereMesh(0.03, 80)).empty()); }

}  // namespace
}  // namespace monocular_eye_hand
