// What of a drawn contour a camera can tell apart.
#include "recognition/resolved_contour.h"

#include "recognition/alignment.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

// A plate that lies on a table, its contour drawn.
struct Plate {
  explicit Plate(double thickness) {
    object.model = buildModel("plate", boxMesh({0.08, 0.06, thickness}));
    const Rigid3 pose = lookFrom(-1.1, 0.75, 0.5, {0, 0, 0}).inverse();
    RectDomain domain;
    domain.width = testCamera().width;
    domain.height = testCamera().height;
    drawn = projectContour(object.model, pose, testCamera(), domain, 4);
    resolved = resolvedContour(object.model, drawn);
  }
  KnownObject object;
  std::vector<SeenSample> drawn, resolved;
};

bool besideEachOther(const SeenSample& a, const SeenSample& b) {
  const Eigen::Vector2d apart = b.uv - a.uv;
  const double along = std::abs(a.direction.dot(apart));
  const double across = std::sqrt(std::max(0.0, apart.squaredNorm() - along * along));
  return a.group != b.group && std::abs(a.direction.dot(b.direction)) > 0.9 && across < 2.5 && along < 3;
}

TEST(ResolvedContour, of_a_thick_plate_is_all_of_it) {
  const Plate plate(0.03);
  EXPECT_EQ(plate.resolved.size(), plate.drawn.size());
}

TEST(ResolvedContour, of_a_thin_plate_has_one_rim) {
  const Plate plate(0.001);
  EXPECT_LT(plate.resolved.size(), 0.85 * plate.drawn.size());
  EXPECT_GT(plate.resolved.size(), 0.5 * plate.drawn.size());
  for (const SeenSample& a : plate.resolved)
    for (const SeenSample& b : plate.resolved) EXPECT_FALSE(besideEachOther(a, b));
}

TEST(ResolvedContour, keeps_the_outline) {
  const Plate plate(0.001);
  const auto outline = [](const std::vector<SeenSample>& contour) {
    return std::count_if(contour.begin(), contour.end(), [](const SeenSample& s) { return s.silhouette; });
  };
  EXPECT_EQ(outline(plate.resolved), outline(plate.drawn));
}

}  // namespace
}  // namespace monocular_eye_hand
