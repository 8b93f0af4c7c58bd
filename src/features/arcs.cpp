#include <algorithm>
#include <cmath>

#include "features/splitting.h"

namespace monocular_eye_hand {
namespace {

constexpr int kArcFitPoints = 20, kSettleFitPoints = 64, kFinalFitPoints = 160;

// A piece of the polygon that approximates a trace.
struct Chord {
  int begin, end;
  double length;
  double angle;  // direction [rad]
  double chi2;   // of the points about their line
};

double wrap(double angle) { return angle - 2 * M_PI * std::floor(angle / (2 * M_PI) + 0.5); }

}  // namespace

class ArcFinder::Search {
 public:
  explicit Search(const FeatureOptions& options) : options_(options) {}

  void run(const LinkedEdges& edges, double correlation_length, TracePolygons* polygons,
           std::vector<EllipticArc>* out) {
    edges_ = &edges;
    correlation_length_ = correlation_length;
    polygons->clear();
    out->clear();
    for (int t = 0; t < int(edges.traces.size()); ++t) add(t, polygons, out);
  }

 private:
  void add(int trace, TracePolygons* polygons, std::vector<EllipticArc>* out) {
    const EdgeTrace& t = edges_->traces[trace];
    const PointRange range{t.first, t.count};
    sums_.assign(edges_->points, t.first, t.count);
    if (sums_.chi2(t.first, t.first + t.count) < 2.0 * t.count) return;  // plainly straight
    tolerance_ = splitTolerance(edges_->points, range, options_);
    splitter_.split(edges_->points, sums_, range, tolerance_, &breaks_);
    polygons->add(trace, breaks_);
    makeChords();
    found_.clear();
    for (size_t i = 0; i + 1 < chords_.size();) {
      const size_t end = runEnd(i);
      tryRun(i, end, 0);
      i = std::max(end - 1, i + 1);
    }
    finish(trace, range, out);
  }

  void makeChords() {
    chords_.clear();
    turned_.clear();
    for (size_t i = 0; i + 1 < breaks_.size(); ++i) {
      const Eigen::Vector2f d =
          edges_->points[std::max(breaks_[i], breaks_[i + 1] - 1)].uv - edges_->points[breaks_[i]].uv;
      chords_.push_back({breaks_[i], breaks_[i + 1], d.norm(), std::atan2(d.y(), d.x()),
                         sums_.chi2(breaks_[i], breaks_[i + 1])});
      turned_.push_back(i == 0 ? 0 : turned_.back() + wrap(chords_[i].angle - chords_[i - 1].angle));
    }
  }

  // A polygon within t of a smooth curve turns by about l^2 / (8 t) R per chord: turn times length is at most
  // 8 t.
  bool smooth(const Chord& a, const Chord& b) const {
    const double turn = std::fabs(wrap(b.angle - a.angle)), mean = 0.5 * (a.length + b.length);
    return turn < 1.6 && turn * mean < 16 * tolerance_ + 2;
  }

  // One past the last chord of the run from i on that turns one way without a corner.
  size_t runEnd(size_t i) const {
    double sign = 0;
    size_t end = i + 1;
    for (; end < chords_.size(); ++end) {
      const double turn = wrap(chords_[end].angle - chords_[end - 1].angle);
      if (!smooth(chords_[end - 1], chords_[end])) break;
      if (sign * turn < 0) break;
      sign = turn < 0 ? -1 : 1;
    }
    return end;
  }

  // An ellipse for a run and what it has to reach to stand for it: fewer nats than the polygon.
  struct Trial {
    EllipseFit fit;
    FitGoal goal;
    double misfit() const { return fit.chi2 / fit.count; }
  };
  Trial fit(size_t begin, size_t end) {
    const PointRange range{chords_[begin].begin, chords_[end - 1].end - chords_[begin].begin};
    fit_points_.assign(edges_->points, &range, 1, kArcFitPoints);
    const double used = double(fit_points_.count()) / range.count;
    Trial trial;
    trial.goal.rms = std::max(0.3, 0.5 * tolerance_);
    trial.goal.chi2 = 2 * correlation_length_ * used * (polygonCost(begin, end) - kArcCost);
    trial.fit = fitEllipseDirect(fit_points_);
    if (trial.fit.valid) trial.fit = refineEllipse(fit_points_, trial.fit.ellipse, 3, trial.goal);
    return trial;
  }

  bool believable(const Trial& trial) const {
    return trial.fit.valid && trial.fit.ellipse.b >= 0.7 * options_.min_ellipse_axis &&
           trial.fit.rms <= trial.goal.rms && trial.fit.chi2 < trial.goal.chi2;
  }

  // Minimum description length [nats] of the straight pieces, chi2 / 2 plus about six per number; an arc has
  // to be shorter.
  static constexpr double kArcCost = 30.0, kChordCost = 12.0;
  double polygonCost(size_t begin, size_t end) const {
    double lines = 0;
    for (size_t i = begin; i < end; ++i) lines += chords_[i].chi2;
    return 0.5 * lines / correlation_length_ + kChordCost * double(end - begin);
  }

  // Enough points and pieces (of 4000 runs of two none became an arc), a turn between the middles of the end
  // chords that leaves a chance of the least sweep, and a polygon that an arc without residuals would beat.
  bool worthTrying(size_t begin, size_t end) const {
    return end - begin >= 3 && chords_[end - 1].end - chords_[begin].begin >= 8 &&
           std::fabs(turned_[end - 1] - turned_[begin]) > 0.6 * options_.min_arc_sweep &&
           kArcCost < polygonCost(begin, end);
  }

  // Accepts the run, or the longer part after dropping the end chord whose loss helps more, or its two
  // halves.
  void tryRun(size_t begin, size_t end, int depth) {
    if (!worthTrying(begin, end)) return;
    Trial whole = fit(begin, end);
    while (!believable(whole)) {
      if (end - begin > 8 && depth < 4) {
        const size_t middle = begin + (end - begin) / 2;
        tryRun(begin, middle, depth + 1);
        tryRun(middle, end, depth + 1);
        return;
      }
      if (end - begin < 4) return;
      const Trial head = fit(begin, end - 1), tail = fit(begin + 1, end);
      const bool drop_tail = !tail.fit.valid || (head.fit.valid && head.misfit() < tail.misfit());
      drop_tail ? --end : ++begin;
      whole = drop_tail ? head : tail;
      if (!worthTrying(begin, end)) return;
    }
    found_.push_back({chords_[begin].begin, chords_[end - 1].end, whole.fit});
  }

  struct Found {
    int begin, end;
    EllipseFit fit;
  };

  bool onEllipse(const EllipseFrame& ellipse, double rms, int i) const {
    const EdgePoint& p = edges_->points[i];
    const EllipseDistance d = ellipse.distanceTo(p.uv.cast<double>());
    const double limit = std::max(3 * fitSigma(p), 2 * rms) + 0.1;
    return std::fabs(d.distance) < limit && std::fabs(d.normal.dot(p.normal.cast<double>())) > 0.93;
  }

  // Fits an arc's points again; an ellipse that does not come out stays.
  void refit(Found* arc, int points, int iterations) {
    const PointRange range{arc->begin, arc->end - arc->begin};
    fit_points_.assign(edges_->points, &range, 1, points);
    const EllipseFit again = refineEllipse(fit_points_, arc->fit.ellipse, iterations);
    if (again.valid) arc->fit = again;
  }

  // Moves the ends of an arc to where the trace leaves its ellipse, and fits again.
  void settle(Found* arc, int low, int high) {
    for (int round = 0; round < 8; ++round) {  // each round may see a little farther
      refit(arc, kSettleFitPoints, 2);
      const int begin = arc->begin, end = arc->end;
      const EllipseFrame frame(arc->fit.ellipse);
      const auto on = [&](int i) { return onEllipse(frame, arc->fit.rms, i); };
      while (arc->end - arc->begin > 8 && !on(arc->begin)) ++arc->begin;
      while (arc->end - arc->begin > 8 && !on(arc->end - 1)) --arc->end;
      while (arc->begin > low && on(arc->begin - 1)) --arc->begin;
      while (arc->end < high && on(arc->end)) ++arc->end;
      if (begin == arc->begin && end == arc->end) break;
    }
    // Of shorter ones all points were used.
    if (arc->end - arc->begin > kSettleFitPoints) refit(arc, kFinalFitPoints, 6);
  }

  void finish(int trace, PointRange range, std::vector<EllipticArc>* out) {
    int low = range.first;
    for (size_t i = 0; i < found_.size(); ++i) {
      Found& arc = found_[i];
      arc.begin = std::max(arc.begin, low);
      if (arc.end - arc.begin < 8) continue;
      const int high = range.first + range.count;
      settle(&arc, low, high);
      // An arc that grew over the next one has explained it.
      const EllipticArc a = describe(arc, trace);
      if (std::fabs(a.sweep) < options_.min_arc_sweep || a.ellipse.b < options_.min_ellipse_axis) continue;
      low = arc.end;
      out->push_back(a);
    }
  }

  EllipticArc describe(const Found& arc, int trace) const {
    EllipticArc a;
    a.ellipse = arc.fit.ellipse;
    a.rms = arc.fit.rms;
    a.trace = trace;
    a.first = arc.begin;
    a.count = arc.end - arc.begin;

    const EllipseFrame frame(a.ellipse);
    a.start = frame.eccentricAngle(edges_->points[arc.begin].uv.cast<double>());
    double last = a.start;
    // The angle grows by at most the way over the minor axis: in strides below pi no turn is lost.
    const int stride = std::max(1, int(a.ellipse.b));
    for (int i = arc.begin; i + 1 < arc.end;) {
      i = std::min(i + stride, arc.end - 1);
      const double now = frame.eccentricAngle(edges_->points[i].uv.cast<double>());
      a.sweep += wrap(now - last);
      last = now;
    }

    const double whole = 2 * M_PI * (1 - 1e-9);
    a.sweep = std::min(whole, std::max(-whole, a.sweep));
    return a;
  }

  const FeatureOptions options_;
  const LinkedEdges* edges_ = nullptr;
  double correlation_length_ = 1;
  LineSums sums_;
  FitPoints fit_points_;
  PolygonSplitter splitter_;
  double tolerance_ = 0;
  std::vector<int> breaks_;
  std::vector<Chord> chords_;
  std::vector<double> turned_;  // direction of each chord, unwrapped
  std::vector<Found> found_;
};

ArcFinder::ArcFinder(const FeatureOptions& options) : search_(std::make_unique<Search>(options)) {}
ArcFinder::~ArcFinder() = default;
void ArcFinder::find(const LinkedEdges& edges, double correlation_length, TracePolygons* polygons,
                     std::vector<EllipticArc>* out) {
  search_->run(edges, correlation_length, polygons, out);
}

}  // namespace monocular_eye_hand
