#include "recognition/explained_features.h"

#include <algorithm>

namespace monocular_eye_hand {
namespace {

constexpr double kExplainedShare = 0.7;  // of a feature's points explained: it is explained
constexpr int kAnswersFor = 3;           // edge points to either side that a claimed one answers for

int explainedCount(int first, int count, const std::vector<char>& explained) {
  return int(std::count(explained.begin() + first, explained.begin() + first + count, 1));
}

}  // namespace

std::vector<char> explainedPoints(const FeatureSet& features, const std::vector<int>& claimed) {
  std::vector<char> is_claimed(features.points.size(), 0);
  for (const int point : claimed) is_claimed[size_t(point)] = 1;

  std::vector<char> explained = is_claimed;
  for (const EdgeTrace& trace : features.traces) {
    const int last = trace.first + trace.count - 1;
    for (int i = trace.first; i <= last; ++i)
      if (is_claimed[size_t(i)])
        for (int k = std::max(trace.first, i - kAnswersFor); k <= std::min(last, i + kAnswersFor); ++k)
          explained[size_t(k)] = 1;
  }
  return explained;
}

bool isExplained(const LineSegment& segment, const std::vector<char>& explained) {
  return explainedCount(segment.first, segment.count, explained) >= kExplainedShare * segment.count;
}

bool isExplained(const FeatureSet& features, const DetectedEllipse& ellipse,
                 const std::vector<char>& explained) {
  int points = 0;
  int count = 0;
  for (const int index : features.arcsOf(ellipse)) {
    const EllipticArc& arc = features.arcs[size_t(index)];
    points += arc.count;
    count += explainedCount(arc.first, arc.count, explained);
  }
  return points > 0 && count >= kExplainedShare * points;
}

}  // namespace monocular_eye_hand
