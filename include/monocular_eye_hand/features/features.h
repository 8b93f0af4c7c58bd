#pragma once
#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/ellipse.h"

namespace monocular_eye_hand {

// All coordinates here are rectified pixels (uv_rect): lens distortion is removed from the features, never
// from the image.

/// One sub-pixel edge point.
struct EdgePoint {
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  Eigen::Vector2f normal = Eigen::Vector2f::UnitX();  ///< unit, from dark to bright
  float gradient = 0;                                 ///< magnitude [grey levels per raw pixel]
  float sigma = 0;                                    ///< standard deviation along the normal [px]
  float blur = 0;  ///< standard deviation of the edge's profile, detector's smoothing included [px]
};

/// A run of neighbouring edge points: points[first .. first + count).
struct EdgeTrace {
  int first = 0;
  int count = 0;
  bool closed = false;
};

/// A straight piece. Seen from p towards q the bright side is on the left-hand normal
/// n = (q - p) rotated by -90 degrees in (u right, v down) coordinates, i.e. n = (d.y, -d.x).
struct LineSegment {
  Eigen::Vector2d p, q;
  double sigma_offset = 0;          ///< standard deviation of the line's offset at its middle [px]
  double sigma_angle = 0;           ///< standard deviation of its direction [rad]
  double sigma_p = 0, sigma_q = 0;  ///< standard deviation of the end points along the line [px]
  double contrast = 0;              ///< mean gradient magnitude of its points [grey levels per pixel]
  int trace = -1;                   ///< the trace it was split from; -1 for one joined across a gap
  int first = 0, count = 0;         ///< its points in FeatureSet::points (of its longest piece when joined)
  int first_piece = 0, piece_count = 0;  ///< what it joins across explained gaps, see FeatureSet::piecesOf()

  bool joined() const { return piece_count > 0; }
  Eigen::Vector2d direction() const { return (q - p).normalized(); }
  double length() const { return (q - p).norm(); }
};

/// A curved piece of one trace: points[first .. first + count) lie on `ellipse`.
struct EllipticArc {
  Ellipse ellipse;
  double start = 0, sweep = 0;  ///< eccentric angles [rad]; sweep in (-2 pi, 2 pi)
  double rms = 0;               ///< point-to-ellipse distance [px]
  int trace = -1, first = 0, count = 0;
};

/// Arcs that lie on one ellipse, fitted together.
struct DetectedEllipse {
  Ellipse ellipse;
  Eigen::Matrix<double, 5, 5> covariance;  ///< of (centre u, centre v, a, b, angle) [px, rad]
  double coverage = 0;                     ///< share of the circumference that has edge points, 0..1
  double rms = 0;                          ///< [px]
  bool bright_inside = false;
  int first_arc = 0, arc_count = 0;  ///< see FeatureSet::arcsOf()
};

/// A run of indices that belongs to another vector.
class IndexRange {
 public:
  IndexRange(const std::vector<int>& all, int first, int count)
      : begin_(all.data() + first), end_(begin_ + count) {}
  const int* begin() const { return begin_; }
  const int* end() const { return end_; }
  bool empty() const { return begin_ == end_; }
  size_t size() const { return size_t(end_ - begin_); }

 private:
  const int *begin_, *end_;
};

/// What figures 3 and 4 of Wong et al. split an image into.
struct FeatureSet {
  Camera camera;                  ///< of the image the features come from
  std::vector<EdgePoint> points;  ///< trace after trace
  std::vector<EdgeTrace> traces;
  std::vector<LineSegment> segments;  ///< plain ones first, then joined ones
  std::vector<int> joined_pieces;     ///< indices of plain segments, joined segment after joined segment
  std::vector<EllipticArc> arcs;
  std::vector<DetectedEllipse> ellipses;
  std::vector<int> ellipse_arcs;  ///< indices of arcs, ellipse after ellipse

  /// The plain segments that a joined segment of this set joins, in order along it; none for a plain one.
  IndexRange piecesOf(const LineSegment& s) const { return {joined_pieces, s.first_piece, s.piece_count}; }
  /// The arcs that lie on an ellipse of this set.
  IndexRange arcsOf(const DetectedEllipse& e) const { return {ellipse_arcs, e.first_arc, e.arc_count}; }
};

/// Defaults stand here and nowhere else.
struct FeatureOptions {
  double smoothing_sigma = 1.0;  ///< Gaussian before differentiation [px]
  double gradient_threshold =
      2.0;  ///< weakest gradient of an edge point [grey levels per px]; raised with the noise
  double noise_factor = 3.0;        ///< weakest gradient in multiples of the image's gradient noise
  int min_trace_points = 8;         ///< shorter traces are dropped
  double min_segment_length = 8.0;  ///< [px]
  double split_tolerance = 1.0;     ///< largest departure of a trace point from its piece [px]
  double join_gap_ratio = 0.4;  ///< longest gap bridged between collinear pieces, as a share of their length
  double min_arc_sweep = 0.35;  ///< shortest arc kept [rad]
  double min_ellipse_axis = 3.0;      ///< smallest semi-axis [px]
  double min_ellipse_coverage = 0.3;  ///< smallest covered share of the circumference

  /// Calls v(name, field) for every field.
  template <class Visitor>
  void visit(Visitor&& v) {
    v("smoothing_sigma", smoothing_sigma);
    v("gradient_threshold", gradient_threshold);
    v("noise_factor", noise_factor);
    v("min_trace_points", min_trace_points);
    v("min_segment_length", min_segment_length);
    v("split_tolerance", split_tolerance);
    v("join_gap_ratio", join_gap_ratio);
    v("min_arc_sweep", min_arc_sweep);
    v("min_ellipse_axis", min_ellipse_axis);
    v("min_ellipse_coverage", min_ellipse_coverage);
  }
  void check() const;  ///< throws BadInput naming field, value and rule
};

/// Detects edge traces, segments, arcs and ellipses in images, one after the other. Its buffers and those of
/// the set it fills are used again: on images like those it has seen it allocates no memory.
/// One detector serves one thread.
class FeatureDetector {
 public:
  /// Throws BadInput when FeatureOptions::check() does.
  explicit FeatureDetector(const FeatureOptions& options = {});
  FeatureDetector(FeatureDetector&& other) noexcept;
  FeatureDetector& operator=(FeatureDetector&& other) noexcept;
  ~FeatureDetector();

  /// Replaces what `out` holds by the features of an 8-bit single-channel image.
  /// Throws BadInput when the image is empty, of another type, or of another size than the camera says; `out`
  /// is as it was then.
  void detect(const cv::Mat& grey, const Camera& camera, FeatureSet* out);

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

/// Detects edge traces, segments, arcs and ellipses in an 8-bit single-channel image; a FeatureDetector is
/// faster for many images.
/// Throws BadInput when the image is empty, of another type, or of another size than the camera says.
FeatureSet detectFeatures(const cv::Mat& grey, const Camera& camera, const FeatureOptions& options = {});

}  // namespace monocular_eye_hand
