// What of a drawn contour a camera can tell apart.
#include "recognition/resolved_contour.h"

#include "model/build_model.h"
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
  return a.feature != b.feature && std::abs(a.direction.dot(b.direction)) > 0.9 && across < 2.5 && along < 3;
}

TEST(ResolvedContour, OfAThickPlateIsAllOfIt) {
  const Plate plate(0.03);
  EXPECT_EQ(plate.resolved.size(), plate.drawn.size());
}

TEST(ResolvedContour, OfAThinPlateHasOneRim) {
  const Plate plate(0.001);
  EXPECT_LT(plate.resolved.size(), 0.85 * plate.drawn.size());
  EXPECT_GT(plate.resolved.size(), 0.5 * plate.drawn.size());
  for (const SeenSample& a : plate.resolved)
    for (const SeenSample& b : plate.resolved) EXPECT_FALSE(besideEachOther(a, b));
}

TEST(ResolvedContour, KeepsTheOutline) {
  const Plate plate(0.001);
  const auto outline = [](const std::vector<SeenSample>& contour) {
    return std::count_if(contour.begin(), contour.end(), [](const SeenSample& s) { return s.silhouette; });
  };
  EXPECT_EQ(outline(plate.resolved), outline(plate.drawn));
}

// Lines of different features, so many pixels apart.
std::vector<SeenSample> lines(int count, double apart) {
  std::vector<SeenSample> contour;
  for (int line = 0; line < count; ++line)
    for (int k = 0; k < 20; ++k) {
      SeenSample s;
      s.p_in_object = {4.0 * k, apart * line, 0};
      s.uv = {100 + 4.0 * k, 100 + apart * line};
      s.direction = {1, 0};
      s.feature = line;
      contour.push_back(s);
    }
  return contour;
}

TEST(CrowdedRings, AreTheInnerOnesOfMany) {
  ObjectModel rings;
  rings.circles.resize(7);
  const std::vector<SeenSample> contour = lines(7, 4);
  const std::vector<char> crowded = crowdedRings(rings, contour);
  for (size_t i = 0; i < contour.size(); ++i)
    EXPECT_EQ(crowded[i] != 0, contour[i].feature >= 2 && contour[i].feature <= 4) << contour[i].feature;
}

TEST(CrowdedRings, AreNoFewRingsNorRingsFarApartNorStraightEdges) {
  ObjectModel rings, edges;
  rings.circles.resize(9);
  edges.edges.resize(9);
  for (const std::vector<SeenSample>& contour : {lines(4, 4), lines(7, 6), lines(3, 2), lines(9, 20)})
    for (char flag : crowdedRings(rings, contour)) EXPECT_FALSE(flag);
  for (char flag : crowdedRings(edges, lines(7, 4))) EXPECT_FALSE(flag);
}

}  // namespace
}  // namespace monocular_eye_hand
