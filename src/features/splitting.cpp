#include "features/splitting.h"

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
  float max_distance = -1;
  for (int i = begin + 1; i < last; ++i) {
    const Eigen::Vector2f d = points[i].uv - a;
    const float distance = point_like ? d.norm() : std::fabs(n.dot(d));
    if (distance > max_distance) {
      max_distance = distance;
      best = i;
    }
  }
  return {best, max_distance};
}

// Of about 32 points of a run.
double meanSigma(const std::vector<EdgePoint>& points, PointRange range) {
  double sum = 0;
  const int stride = std::max(1, range.count / 32);
  int used = 0;
  for (int i = 0; i < range.count; i += stride, ++used) sum += fitSigma(points[range.first + i]);
  return sum / used;
}

// Moves break b to the place between its neighbours where the two lines beside it fit best.
int bestBreak(const LineSums& sums, int begin, int b, int end) {
  constexpr int kReach = 5, kShortest = 3;
  int best = b;
  double min_cost = sums.chi2(begin, b) + sums.chi2(b, end);
  for (int k = std::max(begin + kShortest, b - kReach); k <= std::min(end - kShortest, b + kReach); ++k) {
    const double cost = sums.chi2(begin, k) + sums.chi2(k, end);
    if (cost < min_cost) {
      min_cost = cost;
      best = k;
    }
  }
  return best;
}

}  // namespace

double splitTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options) {
  return std::min(std::max(4 * meanSigma(points, range), 0.45), options.split_tolerance);
}

double mergeTolerance(const std::vector<EdgePoint>& points, PointRange range, const FeatureOptions& options) {
  return std::max(5 * meanSigma(points, range), options.split_tolerance);
}

void PolygonSplitter::split(const std::vector<EdgePoint>& points, const LineSums& sums, PointRange range,
                            double tolerance, std::vector<int>* out) {
  std::vector<int>& breaks = *out;
  breaks.assign(1, range.first);
  todo_.assign(1, {range.first, range.first + range.count - 1});
  while (!todo_.empty()) {  // depth first, left part on top: breaks come out in order
    const auto [begin, last] = todo_.back();
    todo_.pop_back();
    const auto [middle, distance] = farthest(points, begin, last);
    if (distance > tolerance) {
      todo_.push_back({middle, last});
      todo_.push_back({begin, middle});
    } else {
      breaks.push_back(last);
    }
  }
  breaks.back() = range.first + range.count;

  // A break is looked at again when it or one beside it has moved.
  moved_.assign(breaks.size(), 0);
  for (size_t i = 1; i + 1 < breaks.size(); ++i) {
    const int best = bestBreak(sums, breaks[i - 1], breaks[i], breaks[i + 1]);
    moved_[i] = best != breaks[i];
    breaks[i] = best;
  }

  bool moved_before = false;
  for (size_t i = 1; i + 1 < breaks.size(); ++i) {
    if (!moved_before && !moved_[i] && !moved_[i + 1]) continue;
    const int best = bestBreak(sums, breaks[i - 1], breaks[i], breaks[i + 1]);
    moved_before = best != breaks[i];
    breaks[i] = best;
  }
}

namespace {

// Largest mean distance of four neighbouring points from a line: a hook shows, a single stray point does not.
double largestRunDistance(const std::vector<EdgePoint>& points, const LineFit& line, int from, int to) {
  constexpr int kRun = 4;
  double max_distance = 0;
  for (int k = from; k < to; k += kRun) {
    const int end = std::min(to, k + kRun);
    double sum = 0;
    for (int i = k; i < end; ++i) sum += line.distance(points[i]);
    if (end - k >= 2) max_distance = std::max(max_distance, std::fabs(sum) / (end - k));
  }
  return max_distance;
}

}  // namespace

void PolygonSplitter::merge(const std::vector<EdgePoint>& points, const LineSums& sums,
                            double correlation_length, double tolerance, std::vector<int>* breaks) {
  // A break costs a description of two numbers and a place, about six nats each; chi2 counts neighbouring
  // points as independent, so it is divided by the correlation length, and by its own excess over the
  // prediction.
  const double break_cost = 2 * 18 * correlation_length;
  constexpr double kUnseenRms2 = 0.25 * 0.25;  // px^2: a bend that no use of the line would notice
  constexpr double kNever = -1;

  // Gain of removing break i, kNever when it must stay.
  const auto gainAt = [&](size_t i) {
    const int begin = (*breaks)[i - 1], middle = (*breaks)[i], end = (*breaks)[i + 1];
    const double together = sums.chi2(begin, end);
    const double apart = sums.chi2(begin, middle) + sums.chi2(middle, end);
    const double excess = std::max(1.0, apart / std::max(1, end - begin - 4));
    const double rise = (together - apart) / excess;
    if (!(rise < break_cost || together < kUnseenRms2 * sums.weight(begin, end))) return kNever;
    const bool first_shorter = middle - begin < end - middle;
    const double max_distance = largestRunDistance(
        points, sums.fit(begin, end), first_shorter ? begin : middle, first_shorter ? middle : end);
    return max_distance > tolerance ? kNever : std::max(0.0, 1e6 - rise);
  };

  gains_.assign(breaks->size(), kNever);
  for (size_t i = 1; i + 1 < breaks->size(); ++i) gains_[i] = gainAt(i);
  while (breaks->size() > 2) {
    const size_t best = size_t(std::max_element(gains_.begin(), gains_.end()) - gains_.begin());
    if (gains_[best] < 0) break;
    breaks->erase(breaks->begin() + best);
    gains_.erase(gains_.begin() + best);
    if (best > 1) gains_[best - 1] = gainAt(best - 1);
    if (best + 1 < breaks->size()) gains_[best] = gainAt(best);
  }
}

void rotateClosedTraces(LinkedEdges* edges) {
  // The point farthest from the middle is a corner if there is one.
  for (const EdgeTrace& trace : edges->traces) {
    if (!trace.closed) continue;
    const auto begin = edges->points.begin() + trace.first, end = begin + trace.count;
    Eigen::Vector2f middle(0, 0);
    for (auto p = begin; p != end; ++p) middle += p->uv;
    middle /= float(trace.count);
    const auto farthest = std::max_element(begin, end, [&](const EdgePoint& p, const EdgePoint& q) {
      return (p.uv - middle).squaredNorm() < (q.uv - middle).squaredNorm();
    });
    std::rotate(begin, farthest, end);
  }
}

}  // namespace monocular_eye_hand
