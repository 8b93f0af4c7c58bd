#include <algorithm>
#include <cmath>
#include <numeric>

#include "features/arc_grid.h"
#include "features/ellipse_fitting.h"
#include "features/joining.h"
#include "features/line_fitting.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxJointFits = 24;  // per seed, so that a wall of arcs stays affordable
constexpr int kFitPoints = 240;

// Length of arc per eccentric angle [px/rad].
double arcPerAngle(const Ellipse& e, double cosine, double sine) {
  return std::sqrt(e.a * e.a * sine * sine + e.b * e.b * cosine * cosine);
}

struct UnitCircle {  // the middles of equal steps
  static constexpr int kBins = 64;
  double cosine[kBins], sine[kBins];
  UnitCircle() {
    for (int b = 0; b < kBins; ++b) {
      const double t = 2 * M_PI * (b + 0.5) / kBins;
      cosine[b] = std::cos(t);
      sine[b] = std::sin(t);
    }
  }
};

}  // namespace

class ArcJoiner::Joining {
 public:
  explicit Joining(const FeatureOptions& options) : options_(options) {}

  void run(const std::vector<EdgePoint>& points, const std::vector<EllipticArc>& arcs,
           double correlation_length, std::vector<DetectedEllipse>* ellipses,
           std::vector<int>* ellipse_arcs) {
    points_ = &points;
    arcs_ = &arcs;
    correlation_length_ = correlation_length;
    ellipses_ = ellipses;
    ellipse_arcs_ = ellipse_arcs;
    ellipses->clear();
    ellipse_arcs->clear();
    grid_.assign(points, arcs);
    used_.assign(arcs.size(), 0);
    sortSeeds();
    for (int seed : seeds_)
      if (!used_[seed]) grow(seed);
  }

 private:
  const EllipticArc& arc(int i) const { return (*arcs_)[i]; }
  const EdgePoint& point(int i) const { return (*points_)[i]; }

  void sortSeeds() {  // strongest first
    seeds_.resize(arcs_->size());
    std::iota(seeds_.begin(), seeds_.end(), 0);
    const auto strength = [&](int i) { return std::fabs(arc(i).sweep) * std::sqrt(double(arc(i).count)); };
    std::sort(seeds_.begin(), seeds_.end(),
              [&](int i, int j) { return strength(i) != strength(j) ? strength(i) > strength(j) : i < j; });
  }

  bool brightInside(const Ellipse& e, int i) const {
    double votes = 0;
    const EllipseFrame frame(e);
    for (int k = 1; k <= 3; ++k) {
      const EdgePoint& p = point(arc(i).first + arc(i).count * k / 4);
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
  bool compatible(const GroupFit& fit, bool bright_inside, int i) const {
    const EllipseFrame frame(fit.ellipse);
    for (int k = 0; k <= 4; ++k) {
      const EdgePoint& p = point(arc(i).first + std::min(arc(i).count - 1, arc(i).count * k / 4));
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

  GroupFit fitGroup(const Ellipse& start) {
    int total = 0;
    ranges_.clear();
    for (int i : group_) {
      ranges_.push_back({arc(i).first, arc(i).count});
      total += arc(i).count;
    }
    fit_points_.assign(*points_, ranges_, kFitPoints);
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

  void grow(int seed) {
    if (std::fabs(arc(seed).sweep) < 0.8) return;
    group_.assign(1, seed);
    GroupFit fit = fitGroup(arc(seed).ellipse);
    if (!fits(fit)) return;

    const bool bright = brightInside(fit.ellipse, seed);
    int tries = 0;
    for (bool changed = true; changed && tries < kMaxJointFits;) {
      changed = false;
      findCandidates(fit, bright);
      for (int i : candidates_) {
        if (++tries > kMaxJointFits) break;
        if (take(i, bright, &fit)) changed = true;
      }
    }

    DetectedEllipse ellipse;
    if (!describe(fit, bright, &ellipse)) return;
    for (int i : group_) used_[i] = 1;
    ellipse.first_arc = int(ellipse_arcs_->size());
    ellipse.arc_count = int(group_.size());
    ellipse_arcs_->insert(ellipse_arcs_->end(), group_.begin(), group_.end());
    ellipses_->push_back(ellipse);
  }

  // Unused arcs that may belong to the group, longest first.
  void findCandidates(const GroupFit& fit, bool bright) {
    candidates_.clear();
    const double reach = 1.2 * fit.ellipse.a + 4;
    const Eigen::Vector2d c = fit.ellipse.centre;
    grid_.inBox(c.x() - reach, c.y() - reach, c.x() + reach, c.y() + reach, [&](int i) {
      if (used_[i] || std::find(group_.begin(), group_.end(), i) != group_.end()) return;
      if (compatible(fit, bright, i)) candidates_.push_back(i);
    });
    std::sort(candidates_.begin(), candidates_.end(), [&](int i, int j) {
      return arc(i).count != arc(j).count ? arc(i).count > arc(j).count : i < j;
    });
  }

  // Adds an arc to the group if both lie on one ellipse.
  bool take(int i, bool bright, GroupFit* fit) {
    group_.push_back(i);
    const GroupFit joint = fitGroup(fit->ellipse);
    const bool one = fits(joint) && joint.chi2 / joint.count <= 2.0 + 1.5 * fit->chi2 / fit->count &&
                     compatible(joint, bright, i);
    if (one)
      *fit = joint;
    else
      group_.pop_back();
    return one;
  }

  // Share of the circumference, in 64 equal steps of the eccentric angle, that has points of the group.
  double coverage(const Ellipse& e) const {
    static const UnitCircle circle;
    constexpr int kBins = UnitCircle::kBins;
    bool hit[kBins] = {};
    const EllipseFrame frame(e);
    for (int i : group_) {
      const int n = arc(i).count;
      for (int k = 0; k < n; ++k) {
        const Eigen::Vector2d on_circle =
            frame.onUnitCircle(point(arc(i).first + k).uv.cast<double>()).normalized();
        const double t = std::atan2(on_circle.y(), on_circle.x());
        // Mark the stretch that one point stands for, so that small ellipses fill their bins.
        const double half = 0.6 / std::max(1e-6, arcPerAngle(e, on_circle.x(), on_circle.y()));
        const int from = int(std::floor((t - half) / (2 * M_PI) * kBins));
        const int to = int(std::floor((t + half) / (2 * M_PI) * kBins));
        for (int b = from; b <= to; ++b) hit[((b % kBins) + kBins) % kBins] = true;
      }
    }

    double all = 0, covered = 0;
    for (int b = 0; b < kBins; ++b) {
      const double length = arcPerAngle(e, circle.cosine[b], circle.sine[b]);
      all += length;
      if (hit[b]) covered += length;
    }
    return covered / all;
  }

  bool describe(const GroupFit& fit, bool bright, DetectedEllipse* out) const {
    const Ellipse& e = fit.ellipse;
    if (e.b < options_.min_ellipse_axis || e.b < 0.08 * e.a) return false;
    // What the points do not determine is no ellipse: the axes must be known to a share of themselves.
    const Eigen::Matrix<double, 5, 1> sigma = fit.covariance.diagonal().cwiseSqrt();
    if (sigma[2] > 0.12 * e.a || sigma[3] > 0.12 * e.b + 0.2) return false;
    out->coverage = coverage(e);
    if (out->coverage < options_.min_ellipse_coverage) return false;
    out->ellipse = e;
    out->covariance = fit.covariance;
    out->rms = fit.rms;
    out->bright_inside = bright;
    return true;
  }

  const FeatureOptions options_;
  const std::vector<EdgePoint>* points_ = nullptr;
  const std::vector<EllipticArc>* arcs_ = nullptr;
  double correlation_length_ = 1;
  std::vector<DetectedEllipse>* ellipses_ = nullptr;
  std::vector<int>* ellipse_arcs_ = nullptr;
  ArcGrid grid_;
  FitPoints fit_points_;
  std::vector<char> used_;  // per arc
  std::vector<int> seeds_, group_, candidates_;
  std::vector<PointRange> ranges_;  // of the group
};

ArcJoiner::ArcJoiner(const FeatureOptions& options) : joining_(std::make_unique<Joining>(options)) {}
ArcJoiner::~ArcJoiner() = default;
void ArcJoiner::join(const std::vector<EdgePoint>& points, const std::vector<EllipticArc>& arcs,
                     double correlation_length, std::vector<DetectedEllipse>* ellipses,
                     std::vector<int>* ellipse_arcs) {
  joining_->run(points, arcs, correlation_length, ellipses, ellipse_arcs);
}

}  // namespace monocular_eye_hand
