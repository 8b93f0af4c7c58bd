#include <algorithm>
#include <cmath>
#include <map>

#include "monocular_eye_hand/geometry/median.h"
#include "recognition/drawing_terms.h"

namespace monocular_eye_hand {
namespace {

constexpr int kLinked = 12;  // edge points apart along a trace that two neighbouring samples may answer to

constexpr size_t kSparse = 8;  // of the edge points around, one in so many is looked at

}  // namespace

void coherenceTerms(const SearchImage& image, Candidate* candidate) {
  struct Polarity {
    int positive = 0, count = 0;
  };
  std::map<int, Polarity> polarity;
  std::vector<float> gradients, blurs;
  double slant = 0, jitter = 0;
  int hits = 0, pairs = 0, linked = 0, run = 0, longest = 0, inside = 0;
  const SeenSample* before = nullptr;
  double offset_before = 0;
  for (const SeenSample& s : candidate->contour) {
    if (!s.inside) continue;
    ++inside;
    const bool neighbours = before && before->feature == s.feature;
    before = &s;
    if (!neighbours) run = 0;
    if (s.edge_point < 0) {
      run = 0;
      before = nullptr;
      continue;
    }
    ++hits;
    const EdgePoint& point = image.raster.point(s.edge_point);
    const Eigen::Vector2d normal = s.normal();
    const double across = normal.dot(point.normal.cast<double>());
    slant += 1 - std::abs(across);
    Polarity& sign = polarity[s.feature];
    sign.positive += across > 0;
    ++sign.count;
    gradients.push_back(point.gradient);
    blurs.push_back(point.blur);
    const double offset = normal.dot(point.uv.cast<double>() - s.uv);
    ++run;
    if (neighbours) {
      ++pairs;
      const SeenSample& other = *(&s - 1);
      const bool same =
          image.trace_of_point[size_t(other.edge_point)] == image.trace_of_point[size_t(s.edge_point)] &&
          std::abs(other.edge_point - s.edge_point) <= kLinked;
      if (same) {
        ++linked;
        jitter += (offset - offset_before) * (offset - offset_before);
      } else {
        run = 1;
      }
    }
    offset_before = offset;
    longest = std::max(longest, run);
  }

  EvidenceTerms& terms = candidate->terms;
  terms.claimed_ratio = hits ? double(candidate->claimed.size()) / hits : 0;
  terms.slant = hits ? slant / hits : 0;
  terms.linked = pairs ? double(linked) / pairs : 0;
  terms.jitter = linked ? std::sqrt(jitter / linked) : 1;
  terms.run = inside ? double(longest) / inside : 0;
  int agreeing = 0;
  for (const auto& [feature, sign] : polarity)
    agreeing += std::max(sign.positive, sign.count - sign.positive);
  terms.polarity = hits ? double(agreeing) / hits : 0;
  terms.blur = median(&blurs);

  // The edges of the neighbourhood: the drawing's box, a quarter of its size wider; some of them tell enough.
  const cv::Rect& box = candidate->bounding_box;
  const float margin = 0.25f * float(std::max(box.width, box.height));
  const float left = float(box.x) - margin, right = float(box.br().x) + margin;
  const float top = float(box.y) - margin, bottom = float(box.br().y) + margin;
  std::vector<float> around;
  for (size_t i = 0; i < image.features.points.size(); i += kSparse) {
    const EdgePoint& p = image.features.points[i];
    if (p.uv.x() > left && p.uv.x() < right && p.uv.y() > top && p.uv.y() < bottom)
      around.push_back(p.gradient);
  }
  terms.rel_contrast =
      around.empty() || gradients.empty() ? 1 : median(&gradients) / std::max(0.1, median(&around));
}

}  // namespace monocular_eye_hand
