#include <cmath>
#include <map>

#include "monocular_eye_hand/geometry/median.h"
#include "recognition/drawing_terms.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPrecise = 0.5;       // an edge this near answers a sample precisely [px]
constexpr double kParallel = 0.98;     // ... and so parallel to the drawn line: |cos| of the angle between
constexpr double kFeatureShare = 0.5;  // of a feature's samples answered precisely: so is the feature
constexpr int kMinSamples = 3;         // samples of a feature that is looked at

struct Tally {
  int samples = 0, precise = 0;
};

}  // namespace

void precisionTerms(const SearchImage& image, Candidate* candidate) {
  std::map<int, Tally> features;
  std::vector<double> offsets;
  for (const SeenSample& s : candidate->contour) {
    if (!s.inside) continue;
    Tally& feature = features[s.feature];
    ++feature.samples;
    if (s.edge_point < 0) continue;

    const EdgePoint& point = image.raster.point(s.edge_point);
    const Eigen::Vector2d normal = s.normal();
    const double offset = std::abs(normal.dot(point.uv.cast<double>() - s.uv));
    const double parallel = std::abs(normal.dot(point.normal.cast<double>()));
    offsets.push_back(offset);
    feature.precise += offset <= kPrecise && parallel >= kParallel;
  }

  EvidenceTerms& terms = candidate->terms;
  terms.offset = offsets.empty() ? kHitRange : median(&offsets);
  for (const auto& [index, feature] : features)
    terms.precise_features +=
        feature.samples >= kMinSamples && feature.precise >= kFeatureShare * feature.samples;
}

}  // namespace monocular_eye_hand
