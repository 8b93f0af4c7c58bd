#include <algorithm>
#include <array>
#include <cmath>

#include "recognition/drawing_terms.h"

namespace monocular_eye_hand {
namespace {

constexpr std::array<double, 2> kShifts{11, 19};  // [px]
constexpr int kDirections = 6;
constexpr int kMaxSamples = 120;  // looked at per shift

}  // namespace

void chanceTerms(const SearchImage& image, Candidate* candidate) {
  const std::vector<SeenSample>& contour = candidate->contour;
  const size_t stride = 1 + contour.size() / kMaxSamples;
  double max_share = 0, sum = 0, sum_inner = 0, evidence = -1e9;
  int shifts = 0, shared = 0, hits_of_all = 0;
  for (double reach : kShifts)
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * M_PI * (k + (reach > 15 ? 0.5 : 0.0)) / kDirections;
      const Eigen::Vector2d shift(reach * std::cos(angle), reach * std::sin(angle));
      int looked = 0, hits = 0, inner = 0, inner_hits = 0;
      double nats = 0;
      for (size_t i = 0; i < contour.size(); i += stride) {
        const SeenSample& s = contour[i];
        const Eigen::Vector2d uv = s.uv + shift;
        if (!image.domain.contains(uv.x(), uv.y())) continue;
        ++looked;
        const int found = image.raster.find(uv, s.normal(), kHitRange);
        hits += found >= 0;
        if (!s.outline) {
          ++inner;
          inner_hits += found >= 0;
        }
        if (found >= 0) {
          ++hits_of_all;
          shared += std::binary_search(candidate->claimed.begin(), candidate->claimed.end(), found);
        }
        const int8_t value = image.map.at(uv, s.direction);
        if (value != kOutside) nats += value / double(kEvidenceUnit);
      }

      if (looked < 10) continue;
      ++shifts;
      max_share = std::max(max_share, double(hits) / looked);
      sum += double(hits) / looked;
      evidence = std::max(evidence, nats / looked);
      if (inner >= 4) {
        sum_inner += double(inner_hits) / inner;
      }
    }

  EvidenceTerms& terms = candidate->terms;
  terms.chance = max_share;
  terms.chance_mean = shifts ? sum / shifts : 0;
  terms.chance_inner = shifts ? sum_inner / shifts : 0;
  terms.excess = shifts ? terms.mean - evidence : terms.mean;
  terms.repeated = hits_of_all ? double(shared) / hits_of_all : 0;
}

}  // namespace monocular_eye_hand
