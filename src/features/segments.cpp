#include <algorithm>
#include <cmath>

#include "features/splitting.h"

namespace monocular_eye_hand {
namespace {

// Blur rounds a corner over about twice its standard deviation; those points say nothing about the lines.
constexpr double kCornerTrim = 2.0;  // in standard deviations of the edge profile
constexpr double kFarCorner = 5.0;   // px: a corner farther from the break than this is not one

struct Piece {
  int begin = 0, end = 0;  // points of the piece
  LineFit line;
  bool corner_before = false, corner_after = false;  // another piece of the trace follows without a gap
};

// Fits a piece without its rounded ends.
void fitPiece(const std::vector<EdgePoint>& points, const LineSums& sums, Piece* piece) {
  const int count = piece->end - piece->begin;
  const auto trim = [&](const EdgePoint& end, bool corner) {
    const int max_trim = count / 4;
    return std::min(max_trim, corner ? int(std::lround(kCornerTrim * end.blur)) : 1);
  };
  const int head = trim(points[piece->begin], piece->corner_before);
  const int tail = trim(points[piece->end - 1], piece->corner_after);
  piece->line = sums.fit(piece->begin + head, piece->end - tail);
  const Eigen::Vector2d along = (points[piece->end - 1].uv - points[piece->begin].uv).cast<double>();
  if (piece->line.direction.dot(along) < 0) piece->line.direction = -piece->line.direction;
}

// Uncertainty of a line's offset and angle; residuals larger than predicted raise it.
void setUncertainty(const LineFit& line, double spacing, double correlation_length, int count,
                    LineSegment* s) {
  const double correlated = std::max(1.0, correlation_length / spacing);
  const double excess = (line.chi2 + 2) / (std::max(0, count - 2) + 2);
  s->sigma_offset = std::sqrt(correlated * excess / line.weight);
  s->sigma_angle = std::sqrt(correlated * excess / std::max(line.spread, 1e-9));
}

struct Corner {
  bool valid = false;
  Eigen::Vector2d at;
  double sine = 0;
};
Corner intersect(const LineFit& a, const LineFit& b, const Eigen::Vector2d& near) {
  Corner corner;
  corner.sine = a.direction.x() * b.direction.y() - a.direction.y() * b.direction.x();
  if (std::fabs(corner.sine) < 0.2) return corner;
  const Eigen::Vector2d d = b.centre - a.centre;
  const double t = (d.x() * b.direction.y() - d.y() * b.direction.x()) / corner.sine;
  corner.at = a.centre + t * a.direction;
  corner.valid = (corner.at - near).norm() < kFarCorner;
  return corner;
}

}  // namespace

class SegmentFinder::Search {
 public:
  explicit Search(const FeatureOptions& options) : options_(options) {}

  void run(const LinkedEdges& edges, const std::vector<PointRange>& taken, double correlation_length,
           TracePolygons* polygons, std::vector<LineSegment>* out) {
    edges_ = &edges;
    correlation_length_ = correlation_length;
    polygons_ = polygons;
    out_ = out;
    out->clear();

    size_t next = 0;  // first taken range that may touch the trace
    for (int t = 0; t < int(edges.traces.size()); ++t) {
      const EdgeTrace& trace = edges.traces[t];
      const int end = trace.first + trace.count;
      int from = trace.first;
      bool whole = true;
      const auto add_up_to = [&](int to) {
        if (to - from >= 4) add(t, {from, to - from}, trace.closed && whole);
      };
      for (; next < taken.size() && taken[next].first < end; ++next) {
        whole = false;
        add_up_to(taken[next].first);
        from = std::max(from, taken[next].first + taken[next].count);
      }
      if (from < end) add_up_to(end);
    }
  }

 private:
  void add(int trace, PointRange range, bool closed) {
    const std::vector<EdgePoint>& points = edges_->points;
    sums_.assign(points, range.first, range.count);
    const bool whole = range.count == edges_->traces[trace].count;
    if (!whole || !polygons_->take(trace, &breaks_))
      splitter_.split(points, sums_, range, splitTolerance(points, range, options_), &breaks_);
    splitter_.merge(points, sums_, correlation_length_, mergeTolerance(points, range, options_), &breaks_);
    fitPieces(closed);
    for (size_t i = 0; i < pieces_.size(); ++i) addPiece(trace, range, closed, i);
  }

  void fitPieces(bool closed) {
    pieces_.clear();
    const size_t n = breaks_.size() - 1;
    for (size_t i = 0; i < n; ++i) {
      Piece piece{breaks_[i], breaks_[i + 1], {}, closed || i > 0, closed || i + 1 < n};
      if (piece.end - piece.begin < 4) continue;
      fitPiece(edges_->points, sums_, &piece);
      pieces_.push_back(piece);
    }
  }

  // The piece that touches piece i before (step -1) or after (step 1) it; null when there is none.
  const Piece* neighbour(PointRange range, bool closed, size_t i, int step) const {
    const size_t n = pieces_.size();
    const bool wraps = step < 0 ? i == 0 : i + 1 == n;
    if (n < 2 || (wraps && !closed)) return nullptr;
    const Piece &piece = pieces_[i], &other = pieces_[(i + n + step) % n];
    int gap = step < 0 ? piece.begin - other.end : other.begin - piece.end;
    if (wraps) gap += range.count;
    return gap <= 4 ? &other : nullptr;  // a short blunt piece may lie between
  }

  // End point of a piece: the corner with its neighbour, or the last point's foot.
  Eigen::Vector2d endPoint(const Piece& piece, const Piece* other, const EdgePoint& last,
                           const LineSegment& s, double* sigma) const {
    const Eigen::Vector2d point = last.uv.cast<double>();
    if (other) {
      const Corner corner = intersect(piece.line, other->line, point);
      if (corner.valid) {
        const double aside = std::sqrt(correlation_length_ / other->line.weight);
        *sigma = std::hypot(aside, s.sigma_offset) / std::fabs(corner.sine) + 0.1;
        return corner.at;
      }
    }
    *sigma = 1.0;
    return piece.line.centre + piece.line.direction * piece.line.direction.dot(point - piece.line.centre);
  }

  void addPiece(int trace, PointRange range, bool closed, size_t i) const {
    const Piece& piece = pieces_[i];
    const EdgePoint &head = edges_->points[piece.begin], &tail = edges_->points[piece.end - 1];
    const int count = piece.end - piece.begin;
    LineSegment s;
    const double spacing = (tail.uv - head.uv).norm() / std::max(1, count - 1);
    setUncertainty(piece.line, std::max(0.3, spacing), correlation_length_, count, &s);
    s.p = endPoint(piece, neighbour(range, closed, i, -1), head, s, &s.sigma_p);
    s.q = endPoint(piece, neighbour(range, closed, i, 1), tail, s, &s.sigma_q);
    if ((s.q - s.p).dot(piece.line.direction) < options_.min_segment_length) return;
    s.trace = trace;
    s.first = piece.begin;
    s.count = count;
    for (int k = piece.begin; k < piece.end; ++k) s.contrast += edges_->points[k].gradient;
    s.contrast /= count;
    out_->push_back(s);
  }

  const FeatureOptions options_;
  const LinkedEdges* edges_ = nullptr;
  double correlation_length_ = 1;
  TracePolygons* polygons_ = nullptr;
  std::vector<LineSegment>* out_ = nullptr;
  LineSums sums_;
  PolygonSplitter splitter_;
  std::vector<int> breaks_;
  std::vector<Piece> pieces_;
};

SegmentFinder::SegmentFinder(const FeatureOptions& options) : search_(std::make_unique<Search>(options)) {}
SegmentFinder::~SegmentFinder() = default;
void SegmentFinder::find(const LinkedEdges& edges, const std::vector<PointRange>& taken,
                         double correlation_length, TracePolygons* polygons, std::vector<LineSegment>* out) {
  search_->run(edges, taken, correlation_length, polygons, out);
}

}  // namespace monocular_eye_hand
