// What a model offers as rulers of flat templates.
#include "recognition/anchors.h"

#include <algorithm>

#include "recognition/search_model.h"
#include "verified.h"

namespace monocular_eye_hand {
namespace {

// Lengths of a part's anchors over all views of the farthest level [m].
std::vector<double> anchorLengths(const Mesh& mesh) {
  const KnownObject object = known("part", mesh);
  const SearchModel model(object);
  std::vector<double> lengths;
  for (const Anchor& anchor : model.levels().back().anchors) lengths.push_back(anchor.length);
  return lengths;
}

TEST(Anchors, of_a_box_are_its_edges) {
  const std::vector<double> lengths = anchorLengths(boxMesh({0.08, 0.06, 0.04}));
  ASSERT_FALSE(lengths.empty());
  EXPECT_TRUE(std::is_sorted(lengths.begin(), lengths.end()));
  EXPECT_NEAR(lengths.back(), 0.08, 0.004) << "the longest edge, seen across";
  EXPECT_GE(lengths.front(), 0.1 * std::sqrt(0.08 * 0.08 + 0.06 * 0.06 + 0.04 * 0.04) - 1e-9);
}

TEST(Anchors, of_a_cylinder_are_the_limbs_of_its_wall) {
  const std::vector<double> lengths = anchorLengths(cylinderMesh(0.02, 0.08));
  ASSERT_FALSE(lengths.empty()) << "it has no straight edge";
  EXPECT_NEAR(lengths.back(), 0.08, 0.006);
}

TEST(Anchors, a_ball_has_none) { EXPECT_TRUE(anchorLengths(sphereMesh(0.03, 80)).empty()); }

}  // namespace
}  // namespace monocular_eye_hand
