#include <algorithm>
#include <cmath>
#include <numeric>

#include "monocular_eye_hand/features/ellipse_fitting.h"
#include "monocular_eye_hand/features/joining.h"
#include "monocular_eye_hand/features/line_fitting.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxJointFits = 24;  // per seed, so that a wall of arcs stays affordable
constexpr int kFitPoints = 240;

// Index of arcs by the cell of their middle point.
class ArcGrid {
 public:
  ArcGrid(const std::vector<EdgePoint>& points, const std::vector<EllipticArc>& arcs) {
    low_ = Eigen::Vector2f::Constant(1e9f);
    Eigen::Vector2f high = -low_;
    for (const EllipticArc& a : arcs) {
      const Eigen::Vector2f m = points[a.first + a.count / 2].uv;
      low_ = low_.cwiseMin(m);
      high = high.cwiseMax(m);
    }
    if (arcs.empty()) return;
    cell_ = std::max(32.f, (high - low_).maxCoeff() / 64);
    cols_ = int((high.x() - low_.x()) / cell_) + 1;
    rows_ = int((high.y() - low_.y()) / cell_) + 1;
    cells_.resize(size_t(cols_) * rows_);
    for (int i = 0; i < int(arcs.size()); ++i) {
      const Eigen::Vector2f m = points[arcs[i].first + arcs[i].count / 2].uv;
      cells_[size_t((m.y() - low_.y()) / cell_) * cols_ + size_t((m.x() - low_.x()) / cell_)].push_back(i);
    }
  }
  template <class Use>
  void inBox(double u0, double v0, double u1, double v1, const Use& use) const {
    const auto cell = [&](double v, float low, int n) {
      return int(std::min(double(n - 1), std::max(0.0, std::floor((v - low) / cell_))));
    };
    const int x0 = cell(u0, low_.x(), cols_), x1 = cell(u1, low_.x(), cols_);
    const int y0 = cell(v0, low_.y(), rows_), y1 = cell(v1, low_.y(), rows_);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (int i : cells_[size_t(y) * cols_ + x]) use(i);
  }

 private:
  Eigen::Vector2f low_;
  float cell_ = 32;
  int cols_ = 0, rows_ = 0;
  std::vector<std::vector<int>> cells_;
};

class ArcJoiner {
 public:
  ArcJoiner(const std::vector<EdgePoint>& points, const std::vector<EllipticArc>& arcs,
            double correlation_length, const FeatureOptions& options)
      : points_(points),
        arcs_(arcs),
        correlation_length_(correlation_length),
        options_(options),
        grid_(points, arcs),
        used_(arcs.size(), 0) {}

  std::vector<DetectedEllipse> run() {
    std::vector<int> order(arcs_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto strength = [&](int i) {
      return std::fabs(arcs_[i].sweep) * std::sqrt(double(arcs_[i].count));
    };
    std::sort(order.begin(), order.end(),
              [&](int i, int j) { return strength(i) != strength(j) ? strength(i) > strength(j) : i < j; });
    std::vector<DetectedEllipse> out;
    for (int seed : order)
      if (!used_[seed]) grow(seed, &out);
    return out;
  }

 private:
  std::vector<PointRange> ranges(const std::vector<int>& group) const {
    std::vector<PointRange> r;
    for (int i : group) r.push_back({arcs_[i].first, arcs_[i].count});
    return r;
  }

  bool brightInside(const Ellipse& e, int arc) const {
    double votes = 0;
    const EllipseFrame frame(e);
    for (int k = 1; k <= 3; ++k) {
      const EdgePoint& p = points_[arcs_[arc].first + arcs_[arc].count * k / 4];
      votes += frame.distanceTo(p.uv.cast<double>()).normal.dot(p.normal.cast<double>());
    }
    return votes < 0;
  }

  // A fit with the covariance of correlated neighbours and residuals as large as they are.
  struct GroupFit : EllipseFit {
    Eigen::Matrix<double, 5, 5> covariance;
  };

  // Do the ends and the middle of an arc lie on the ellipse, as far as its covariance can tell, facing the
  // same way?
  bool compatible(const GroupFit& fit, bool bright_inside, int arc) const {
    const EllipseFrame frame(fit.ellipse);
    for (int k = 0; k <= 4; ++k) {
      const EdgePoint& p =
          points_[arcs_[arc].first + std::min(arcs_[arc].count - 1, arcs_[arc].count * k / 4)];
      const Eigen::Vector2d uv = p.uv.cast<double>();
      const EllipseDistance d = frame.distanceTo(uv);
      const Eigen::Matrix<double, 1, 5> j = frame.distanceJacobian(uv);
      const double predicted = std::sqrt(std::max(0.0, (j * fit.covariance * j.transpose())(0, 0)));
      const double limit = std::min(4 * predicted + 4 * fitSigma(p) + 0.3, 0.2 * fit.ellipse.b + 1.0);
      if (std::fabs(d.distance) > limit) return false;
      const double facing = d.normal.dot(p.normal.cast<double>()) * (bright_inside ? -1 : 1);
      if (facing < 0.85) return false;
    }
    return true;
  }

  GroupFit fitGroup(const std::vector<int>& group, const Ellipse& start) {
    int total = 0;
    for (int i : group) total += arcs_[i].count;
    fit_points_.assign(points_, ranges(group), kFitPoints);
    GroupFit fit;
    static_cast<EllipseFit&>(fit) = refineEllipse(fit_points_, start, 10);
    if (!fit.valid) return fit;
    // The points' variances are known as well as so many residuals tell them.
    constexpr double kKnown = 60;
    const double excess = (fit.chi2 + kKnown) / (std::max(0, fit.count - 5) + kKnown);
    const double points_per_used = double(total) / fit.count;
    fit.covariance = covarianceOf(fit) * excess * std::max(1.0, correlation_length_) / points_per_used;
    return fit;
  }

  bool fits(const EllipseFit& fit) const { return fit.valid && fit.rms < 0.5 && fit.chi2 < 12.0 * fit.count; }

  void grow(int seed, std::vector<DetectedEllipse>* out) {
    if (std::fabs(arcs_[seed].sweep) < 0.8) return;
    std::vector<int> group{seed};
    GroupFit fit = fitGroup(group, arcs_[seed].ellipse);
    if (!fits(fit)) return;
    const bool bright = brightInside(fit.ellipse, seed);
    int tries = 0;
    for (bool changed = true; changed && tries < kMaxJointFits;) {
      changed = false;
      std::vector<int> candidates;
      const double reach = 1.2 * fit.ellipse.a + 4;
      const Eigen::Vector2d c = fit.ellipse.centre;
      grid_.inBox(c.x() - reach, c.y() - reach, c.x() + reach, c.y() + reach, [&](int i) {
        if (used_[i] || std::find(group.begin(), group.end(), i) != group.end()) return;
        if (compatible(fit, bright, i)) candidates.push_back(i);
      });
      std::sort(candidates.begin(), candidates.end(), [&](int i, int j) {
        return arcs_[i].count != arcs_[j].count ? arcs_[i].count > arcs_[j].count : i < j;
      });
      for (int i : candidates) {
        if (++tries > kMaxJointFits) break;
        std::vector<int> larger = group;
        larger.push_back(i);
        const GroupFit joint = fitGroup(larger, fit.ellipse);
        if (!fits(joint) || joint.chi2 / joint.count > 2.0 + 1.5 * fit.chi2 / fit.count) continue;
        if (!compatible(joint, bright, i)) continue;
        group = larger;
        fit = joint;
        changed = true;
      }
    }
    DetectedEllipse ellipse;
    if (!describe(group, fit, bright, &ellipse)) return;
    for (int i : group) used_[i] = 1;
    out->push_back(ellipse);
  }

  // Share of the circumference, in 64 equal steps of arc length, that has points of the group.
  double coverage(const std::vector<int>& group, const Ellipse& e) const {
    constexpr int kBins = 64;
    bool hit[kBins] = {};
    const EllipseFrame frame(e);
    for (int i : group) {
      const int n = arcs_[i].count;
      for (int k = 0; k < n; ++k) {
        const Eigen::Vector2d uv = points_[arcs_[i].first + k].uv.cast<double>();
        // Mark the stretch that one point stands for, so that small ellipses fill their bins.
        const double t = frame.eccentricAngle(uv);
        const double speed = std::hypot(e.a * std::sin(t), e.b * std::cos(t));
        const double half = 0.6 / std::max(1e-6, speed);
        const int from = int(std::floor((t - half) / (2 * M_PI) * kBins));
        const int to = int(std::floor((t + half) / (2 * M_PI) * kBins));
        for (int b = from; b <= to; ++b) hit[((b % kBins) + kBins) % kBins] = true;
      }
    }
    double all = 0, covered = 0;
    for (int b = 0; b < kBins; ++b) {
      const double t = 2 * M_PI * (b + 0.5) / kBins, speed = std::hypot(e.a * std::sin(t), e.b * std::cos(t));
      all += speed;
      if (hit[b]) covered += speed;
    }
    return covered / all;
  }

  bool describe(const std::vector<int>& group, const GroupFit& fit, bool bright, DetectedEllipse* out) const {
    const Ellipse& e = fit.ellipse;
    if (e.b < options_.min_ellipse_axis || e.b < 0.08 * e.a) return false;
    out->coverage = coverage(group, e);
    if (out->coverage < options_.min_ellipse_coverage) return false;
    // What the points do not determine is no ellipse: the axes must be known to a share of themselves.
    const Eigen::Matrix<double, 5, 1> sigma = fit.covariance.diagonal().cwiseSqrt();
    if (sigma[2] > 0.12 * e.a || sigma[3] > 0.12 * e.b + 0.2) return false;
    out->ellipse = e;
    out->covariance = fit.covariance;
    out->rms = fit.rms;
    out->bright_inside = bright;
    out->arcs = group;
    return true;
  }

  const std::vector<EdgePoint>& points_;
  const std::vector<EllipticArc>& arcs_;
  const double correlation_length_;
  const FeatureOptions& options_;
  const ArcGrid grid_;
  FitPoints fit_points_;
  std::vector<char> used_;
};

}  // namespace

std::vector<DetectedEllipse> joinArcs(const std::vector<EdgePoint>& points,
                                      const std::vector<EllipticArc>& arcs, double correlation_length,
                                      const FeatureOptions& options) {
  return ArcJoiner(points, arcs, correlation_length, options).run();
}

}  // namespace monocular_eye_hand
