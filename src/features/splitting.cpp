#include "monocular_eye_hand/features/splitting.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

// Index of the point farthest from the chord between the two ends, and its distance.
std::pair<int, double> farthest(const std::vector<EdgePoint>& points, int begin, int last) {
  const Eigen::Vector2f a = points[begin].uv, chord = points[last].uv - a;
  const float length = chord.norm();
  const bool point_like = length < 1e-3f;
  const Eigen::Vector2f n =
      point_like ? Eigen::Vector2f(0, 0) : Eigen::Vector2f(-chord.y(), chord.x()) / length;
  int best = begin;
  float most = -1;
  for (int i = begin + 1; i < last; ++i) {
    const Eigen::Vector2f d = points[i].uv - a;
    const float distance = point_like ? d.norm() : std::fabs(n.dot(d));
    if (distance > most) most = distance, best = i;
  }
  return {best, most};
}

// Moves break b to the place between its neighbours where the two lines beside it fit best.
int bestBreak(const LineSums& sums, int begin, int b, int end) {
  constexpr int kReach = 5, kShortest = 3;
  int best = b;
  double least = sums.chi2(begin, b) + sums.chi2(b, end);
  for (int k = std::max(begin + kShortest, b - kReach); k <= std::min(end - kShortest, b + kReach); ++k) {
    const double cost = sums.chi2(begin, k) + sums.chi2(k, end);
    if (cost < least) least = cost, best = k;
  }
  return best;
}

}  // namespace

double splitTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options) {
  double sum = 0;
  const int stride = std::max(1, range.count / 32);
  int used = 0;
  for (int i = 0; i < range.count; i += stride, ++used) sum += fitSigma(points[range.first + i]);
  return std::min(std::max(4 * sum / used, 0.45), options.split_tolerance);
}

std::vector<int> polygonBreaks(const std::vector<EdgePoint>& points, const LineSums& sums, PointRange range,
                               double tolerance) {
  std::vector<int> breaks{range.first};
  std::vector<std::pair<int, int>> todo{{range.first, range.first + range.count - 1}};
  while (!todo.empty()) {  // depth first, left part on top: breaks come out in order
    const auto [begin, last] = todo.back();
    todo.pop_back();
    const auto [middle, distance] = farthest(points, begin, last);
    if (distance > tolerance) {
      todo.push_back({middle, last});
      todo.push_back({begin, middle});
    } else {
      breaks.push_back(last);
    }
  }
  breaks.back() = range.first + range.count;
  for (int round = 0; round < 2; ++round)
    for (size_t i = 1; i + 1 < breaks.size(); ++i)
      breaks[i] = bestBreak(sums, breaks[i - 1], breaks[i], breaks[i + 1]);
  return breaks;
}

void mergeBreaks(const std::vector<EdgePoint>& points, const LineSums& sums, double correlation_length,
                 double tolerance, std::vector<int>* breaks) {
  // A break costs a description of about two numbers and a place: 12 nats; chi2 counts neighbouring points as
  // independent, so it is divided by the correlation length.
  const double break_cost = 2 * 12 * correlation_length;
  constexpr double kUnseenRms = 0.25;  // px: a bend that no use of the line would notice
  bool changed = true;
  while (changed && breaks->size() > 2) {
    changed = false;
    double best = 0;
    size_t where = 0;
    for (size_t i = 1; i + 1 < breaks->size(); ++i) {
      const int begin = (*breaks)[i - 1], middle = (*breaks)[i], end = (*breaks)[i + 1];
      const LineFit whole = sums.fit(begin, end);
      const double rise = whole.chi2 - sums.chi2(begin, middle) - sums.chi2(middle, end);
      if (!(rise < break_cost || whole.rms() < kUnseenRms)) continue;
      // A short hook at the end of a long line hardly moves its chi2: look at the distances themselves.
      double most = 0;
      const int from = middle - begin < end - middle ? begin : middle;
      const int to = middle - begin < end - middle ? middle : end;
      for (int k = from; k < to; ++k) most = std::max(most, std::fabs(whole.distance(points[k])));
      if (most > tolerance) continue;
      const double gain = break_cost - rise;
      if (where == 0 || gain > best) best = gain, where = i;
    }
    if (where > 0) {
      breaks->erase(breaks->begin() + where);
      changed = true;
    }
  }
}

void rotateClosedTraces(LinkedEdges* edges) {
  constexpr int kArm = 4;
  for (const EdgeTrace& trace : edges->traces) {
    if (!trace.closed || trace.count < 3 * kArm) continue;
    const auto at = [&](int i) -> const EdgePoint& {
      return edges->points[trace.first + (i % trace.count + trace.count) % trace.count];
    };
    int sharpest = 0;
    float least = 2;
    for (int i = 0; i < trace.count; ++i) {
      const float turn = at(i - kArm).normal.dot(at(i + kArm).normal);
      if (turn < least) least = turn, sharpest = i;
    }
    const auto begin = edges->points.begin() + trace.first;
    std::rotate(begin, begin + sharpest, begin + trace.count);
  }
}

}  // namespace monocular_eye_hand
