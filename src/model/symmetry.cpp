#include "model/symmetry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/symmetry_group.h"
#include "model/tessellation.h"
#include "monocular_eye_hand/mesh/closest_point.h"

namespace monocular_eye_hand {
namespace {

constexpr int kSurfaceSamples = 1500;
constexpr size_t kMaxVertices = 3000;  // of the mesh, used as samples besides
constexpr double kTwinShare = 0.12;    // a rotation that moves less of the surface makes a twin
constexpr size_t kLargestGroup = 120;
constexpr int kFineSamples = 6000;          // of the surface, for what passed the first ones
constexpr size_t kMaxFineVertices = 20000;  // of the mesh, besides
constexpr double kFineSlack = 1.25;         // between samples the surface may lie a little farther off
constexpr double kMaxOfAxis = 1e-2;         // allowance of a body of revolution, as a share of the diameter
constexpr int kFewestSegments = 24;         // of a body of revolution without any circle or cylinder

double radicalInverse(unsigned n, unsigned base) {
  double value = 0, place = 1.0 / base;
  for (; n > 0; n /= base, place /= base) value += (n % base) * place;
  return value;
}

/// A point that a symmetry must map to a point of the same kind.
struct Mark {
  Eigen::Vector3d p;  // relative to the centroid
  int kind;           // 0 corner, 1 edge middle, 2 circle, 3 vertex
  double size;        // edge length or circle radius [m]
};

class SymmetryFinder {
 public:
  SymmetryFinder(const ObjectModel& model, double tolerance)
      : model_(model), tolerance_(tolerance), closest_(model.mesh), round_(model) {
    measure();
    samples_ = sampled(kSurfaceSamples, kMaxVertices);
    first_area_sample_ = samples_.size() - kSurfaceSamples;
    tolerances_ = tolerancesAt(samples_);
    collectMarks();
  }

  SymmetryResult find() {
    if (isSphere()) {
      out_.symmetries.sphere = true;
      return std::move(out_);
    }
    if (findAxis()) return std::move(out_);
    findGroup();
    return std::move(out_);
  }

 private:
  Rigid3 about(const Eigen::Matrix3d& r) const { return {r, centroid_ - r * centroid_}; }

  /// Centroid and second moment of the surface, exactly.
  void measure() {
    double area = 0;
    centroid_.setZero();
    for (const auto& t : model_.mesh.triangles) {
      const Eigen::Vector3d a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
      const double share = 0.5 * (b - a).cross(c - a).norm();
      area += share;
      until_.push_back(area);
      centroid_ += share * (a + b + c) / 3;
      const Eigen::Vector3d m = (a + b + c) / 3;
      moment_ +=
          share / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + 9 * m * m.transpose());
    }
    centroid_ /= area;
    moment_ = (moment_ / area - centroid_ * centroid_.transpose()).eval();
  }

  /// Vertices, at most so many, then `count` points spread evenly over the surface.
  std::vector<Eigen::Vector3d> sampled(int count, size_t max_vertices) const {
    std::vector<Eigen::Vector3d> out;
    const size_t stride = 1 + model_.mesh.vertices.size() / max_vertices;
    for (size_t v = 0; v < model_.mesh.vertices.size(); v += stride) out.push_back(model_.mesh.vertices[v]);
    for (int k = 0; k < count; ++k) {
      const double at = (k + 0.5) / count * until_.back();
      const size_t t = size_t(std::lower_bound(until_.begin(), until_.end(), at) - until_.begin());
      const auto& tri = model_.mesh.triangles[std::min(t, until_.size() - 1)];
      double u = radicalInverse(unsigned(k + 1), 2), v = radicalInverse(unsigned(k + 1), 3);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      out.push_back(vertex(tri[0]) + u * (vertex(tri[1]) - vertex(tri[0])) +
                    v * (vertex(tri[2]) - vertex(tri[0])));
    }
    return out;
  }

  std::vector<double> tolerancesAt(const std::vector<Eigen::Vector3d>& points) const {
    std::vector<double> out;
    for (const Eigen::Vector3d& p : points) out.push_back(tolerance_ + round_.allowanceAt(p));
    return out;
  }

  const Eigen::Vector3d& vertex(int v) const { return model_.mesh.vertices[v]; }

  void collectMarks() {
    for (const ModelCorner& c : model_.corners) marks_.push_back({c.p - centroid_, 0, 0});
    for (const ModelEdge& e : model_.edges)
      marks_.push_back({0.5 * (e.p + e.q) - centroid_, 1, (e.q - e.p).norm()});
    for (const ModelCircle& c : model_.circles) {
      // An arc is marked at its middle, where it is unique; a full circle at its centre.
      const double middle = c.start + 0.5 * c.sweep;
      const Eigen::Vector3d out = std::cos(middle) * c.x_axis + std::sin(middle) * c.axis.cross(c.x_axis);
      marks_.push_back(
          {(c.full() ? c.centre : Eigen::Vector3d(c.centre + c.radius * out)) - centroid_, 2, c.radius});
    }
  }

  /// True when motion and inverse leave every point within its tolerance of the surface.
  bool keeps(const Rigid3& motion, const std::vector<Eigen::Vector3d>& points,
             const std::vector<double>& tolerances, double slack) const {
    const Rigid3 back = motion.inverse();
    for (size_t k = 0; k < points.size(); ++k) {
      const double limit = slack * tolerances[k];
      if (closest_.distance(motion * points[k], 2 * limit) > limit) return false;
      if (closest_.distance(back * points[k], 2 * limit) > limit) return false;
    }
    return true;
  }

  bool holds(const Rigid3& motion) const { return keeps(motion, samples_, tolerances_, 1.0); }

  /// The same with many more samples: a small feature must not hide between the first ones.
  bool holdsFinely(const Rigid3& motion) {
    if (fine_.empty()) {
      fine_ = sampled(kFineSamples, kMaxFineVertices);
      fine_tolerances_ = tolerancesAt(fine_);
    }
    return keeps(motion, fine_, fine_tolerances_, kFineSlack);
  }

  /// A sphere's vertices lie on it; its facets dip below it by two sagittas.
  bool isSphere() const {
    double low = 1e300, high = 0;
    for (size_t k = 0; k < first_area_sample_; ++k) {
      const double r = (samples_[k] - centroid_).norm();
      low = std::min(low, r);
      high = std::max(high, r);
    }
    if (high - low > tolerance_) return false;
    const double dip = tolerance_ + kMaxOfAxis * model_.diameter;
    return std::all_of(samples_.begin(), samples_.end(),
                       [&](const Eigen::Vector3d& p) { return high - (p - centroid_).norm() < dip; });
  }

  std::vector<Eigen::Vector3d> principalAxes() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moment_);
    return {eigen.eigenvectors().col(0), eigen.eigenvectors().col(1), eigen.eigenvectors().col(2)};
  }

  /// Lines through the centroid about which the object may look the same at every angle.
  std::vector<Eigen::Vector3d> axisCandidates() const {
    std::vector<Eigen::Vector3d> axes;
    const auto add = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& axis) {
      const Eigen::Vector3d off = point - centroid_;
      if ((off - axis * axis.dot(off)).norm() > tolerance_) return;
      for (const Eigen::Vector3d& a : axes) {
        if (a.cross(axis).norm() < 1e-3) return;
      }
      axes.push_back(axis);
    };

    // Fitted axes are more exact than principal ones: they stand first.
    for (const ModelCircle& c : model_.circles) {
      if (c.full()) add(c.centre, c.axis);
    }
    for (const Surface& s : model_.surfaces) {
      if (s.kind == Surface::Kind::kCylinder) add(s.point, s.axis);
    }
    for (const Eigen::Vector3d& a : principalAxes()) add(centroid_, a);
    return axes;
  }

  bool findAxis() {
    // Without a curved surface there is nothing to turn.
    if (model_.circles.empty() &&
        std::all_of(model_.surfaces.begin(), model_.surfaces.end(),
                    [](const Surface& s) { return s.kind == Surface::Kind::kPlane; })) {
      return false;
    }

    for (const Eigen::Vector3d& axis : axisCandidates()) {
      const std::vector<double> tolerances = revolvedTolerances(axis);
      // Angles without a common measure: no discrete group passes them all.
      const double angles[] = {0.4142, 1.0, 1.6180, 2.2361, 2.7183};
      const bool all = std::all_of(std::begin(angles), std::end(angles), [&](double angle) {
        return keeps(turned(angle, axis), samples_, tolerances, 1.0);
      });
      if (!all) continue;
      setAxis(axis, tolerances);
      return true;
    }
    return false;
  }

  Rigid3 turned(double angle, const Eigen::Vector3d& axis) const {
    return about(Eigen::AngleAxisd(angle, axis).toRotationMatrix());
  }

  void setAxis(const Eigen::Vector3d& axis, const std::vector<double>& tolerances) {
    Eigen::Index largest;
    axis.cwiseAbs().maxCoeff(&largest);
    const Eigen::Vector3d direction = axis[largest] < 0 ? Eigen::Vector3d(-axis) : axis;
    out_.symmetries.axis = SymmetryAxis{centroid_ - direction * direction.dot(centroid_), direction};
    const Rigid3 flip = turned(M_PI, direction.unitOrthogonal());
    if (keeps(flip, samples_, tolerances, 1.0)) out_.symmetries.discrete.push_back(flip);
  }

  /// Tolerances of a body of revolution whose circles are polygons: at the distance rho from the axis two of
  /// them differ by the sagitta of rho.
  std::vector<double> revolvedTolerances(const Eigen::Vector3d& axis) const {
    double segment = round_.segmentAbout({centroid_, axis}, 5 * tolerance_);
    if (segment == 0) segment = segmentOfRings(axis);
    std::vector<double> out;
    for (size_t k = 0; k < samples_.size(); ++k) {
      const double rho = (samples_[k] - centroid_).cross(axis).norm();
      const double allowance = std::min(1.2 * sagitta(rho, segment), kMaxOfAxis * model_.diameter);
      out.push_back(std::max(tolerances_[k], tolerance_ + allowance));
    }
    return out;
  }

  /// A vase without circle or cylinder is made of rings of vertices: the angle between two of them, 0 when
  /// there are no rings of many.
  double segmentOfRings(const Eigen::Vector3d& axis) const {
    for (int fold = kFewestSegments; fold <= 72; ++fold) {
      if (holds(turned(2 * M_PI / fold, axis))) return 2 * M_PI / fold;
    }
    return 0;
  }

  /// Candidates that hold make a group, the surest first; what does not fit into it is no symmetry.
  void findGroup() {
    std::vector<Eigen::Matrix3d> group{Eigen::Matrix3d::Identity()};
    const auto rotation_holds = [&](const Eigen::Matrix3d& r) { return holds(about(r)); };
    std::vector<Rigid3> others;
    std::vector<Eigen::Matrix3d> misfits;  // hold, but their products do not
    for (const Eigen::Matrix3d& r : candidates()) {
      if (indexOfTurn(group, r) >= 0) continue;
      const bool known = std::any_of(misfits.begin(), misfits.end(),
                                     [&](const Eigen::Matrix3d& m) { return (m - r).norm() < 1e-3; });
      if (!known && rotation_holds(r)) {
        if (grow(r, &group)) continue;
        misfits.push_back(r);
      }
      others.push_back(about(r));
    }
    keepFineGroup(&group);
    sortTurns(&group);
    out_.symmetries.discrete.clear();
    for (const Eigen::Matrix3d& r : group) out_.symmetries.discrete.push_back(about(r));

    for (const Rigid3& motion : twinCandidates()) others.push_back(motion);
    for (const Rigid3& motion : others) {
      if (indexOfTurn(group, motion.rotation) < 0) noteTwin(motion);
    }
    std::stable_sort(out_.twins.begin(), out_.twins.end(),
                     [](const NearSymmetry& a, const NearSymmetry& b) { return a.differing < b.differing; });
  }

  /// Takes the rotation, or the simple fraction of a turn that it nearly is, into the group.
  bool grow(const Eigen::Matrix3d& r, std::vector<Eigen::Matrix3d>* group) {
    const auto rotation_holds = [&](const Eigen::Matrix3d& turn) { return holds(about(turn)); };
    for (const Eigen::Matrix3d& turn : {tidy(r), r}) {
      if (!rotation_holds(turn) || !holdsFinely(about(turn))) continue;
      if (auto grown = grownGroup(*group, turn, rotation_holds, kLargestGroup)) {
        *group = std::move(*grown);
        return true;
      }
    }
    return false;
  }

  /// Products of rotations that hold finely may miss by the sum: then the elements that hold are grown anew,
  /// each from those before it.
  void keepFineGroup(std::vector<Eigen::Matrix3d>* group) {
    const auto finely = [&](const Eigen::Matrix3d& r) { return holdsFinely(about(r)); };
    if (std::all_of(group->begin() + 1, group->end(), finely)) return;
    std::vector<Eigen::Matrix3d> kept{Eigen::Matrix3d::Identity()};
    for (const Eigen::Matrix3d& r : *group) {
      if (indexOfTurn(kept, r) >= 0 || !finely(r)) continue;
      if (auto grown = grownGroup(kept, r, finely, kLargestGroup)) kept = std::move(*grown);
    }
    *group = std::move(kept);
  }

  /// Marks of the kind with the fewest members that do not lie on the centroid.
  std::vector<std::vector<Mark>> classes() const {
    std::vector<std::vector<Mark>> out;
    const auto sortIn = [&](const Mark& m) {
      if (m.p.norm() < 10 * tolerance_) return;
      for (auto& members : out) {
        const Mark& first = members.front();
        if (first.kind == m.kind && std::abs(first.size - m.size) < 2 * tolerance_ &&
            std::abs(first.p.norm() - m.p.norm()) < 2 * tolerance_) {
          members.push_back(m);
          return;
        }
      }
      out.push_back({m});
    };

    for (const Mark& m : marks_) sortIn(m);
    if (marks_.size() < 2 && model_.mesh.vertices.size() <= 20000) {
      for (const Eigen::Vector3d& v : model_.mesh.vertices) sortIn({v - centroid_, 3, 0});
    }

    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
    return out;
  }

  static Eigen::Matrix3d frame(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Eigen::Matrix3d f;
    f.col(0) = a.normalized();
    f.col(2) = a.cross(b).normalized();
    f.col(1) = f.col(2).cross(f.col(0));
    return f;
  }

  std::vector<Eigen::Matrix3d> candidates() const {
    std::vector<Eigen::Matrix3d> out;
    const std::vector<std::vector<Mark>> kinds = classes();
    const Mark *a = nullptr, *b = nullptr;
    const std::vector<Mark>*of_a = nullptr, *of_b = nullptr;
    for (const auto& kind : kinds) {
      for (const Mark& m : kind) {
        if (!a) {
          a = &m;
          of_a = &kind;
        } else if (!b && a->p.normalized().cross(m.p.normalized()).norm() > 0.2) {
          b = &m;
          of_b = &kind;
        }
      }
    }

    if (b && of_a->size() * of_b->size() <= 250000) {
      const double apart = (a->p - b->p).norm();
      const Eigen::Matrix3d from = frame(a->p, b->p);
      for (const Mark& a2 : *of_a) {
        for (const Mark& b2 : *of_b) {
          if (std::abs((a2.p - b2.p).norm() - apart) > 4 * tolerance_) continue;
          out.push_back(frame(a2.p, b2.p) * from.transpose());
        }
      }
    }

    for (const Eigen::Vector3d& axis : principalAxes()) {
      for (const int fold : {2, 3, 4, 6}) {
        out.push_back(Eigen::AngleAxisd(2 * M_PI / fold, axis).toRotationMatrix());
      }
    }
    return out;
  }

  /// Motions that map equal edges onto each other about the middle of all edges of that length. What spoils a
  /// symmetry also moves the centroid: the body's own edges still know where its middle is.
  std::vector<Rigid3> twinCandidates() const {
    std::vector<std::vector<Mark>> kinds;
    for (const Mark& m : marks_) {
      if (m.kind != 1) continue;
      auto same = std::find_if(kinds.begin(), kinds.end(), [&](const std::vector<Mark>& kind) {
        return std::abs(kind.front().size - m.size) < 2 * tolerance_;
      });
      if (same == kinds.end()) same = kinds.insert(kinds.end(), std::vector<Mark>{});
      same->push_back(m);
    }
    const auto total = [](const std::vector<Mark>& kind) { return kind.front().size * double(kind.size()); };
    std::stable_sort(kinds.begin(), kinds.end(),
                     [&](const auto& a, const auto& b) { return total(a) > total(b); });
    std::vector<Rigid3> out;
    for (size_t k = 0; k < std::min<size_t>(3, kinds.size()); ++k) {
      if (kinds[k].size() <= 60) appendPairMotions(kinds[k], &out);
    }
    return out;
  }

  void appendPairMotions(std::vector<Mark> marks, std::vector<Rigid3>* out) const {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Mark& m : marks) middle += m.p / double(marks.size());
    for (Mark& m : marks) m.p -= middle;
    const Eigen::Vector3d centre = centroid_ + middle, a = marks.front().p;

    const auto b = std::find_if(marks.begin(), marks.end(), [&](const Mark& m) {
      return a.cross(m.p).norm() > 0.2 * a.norm() * m.p.norm() && m.p.norm() > 10 * tolerance_;
    });
    if (b == marks.end() || a.norm() < 10 * tolerance_) return;

    const Eigen::Matrix3d from = frame(a, b->p);
    for (const Mark& a2 : marks) {
      if (std::abs(a2.p.norm() - a.norm()) > 2 * tolerance_) continue;
      for (const Mark& b2 : marks) {
        if (std::abs((a2.p - b2.p).norm() - (a - b->p).norm()) > 4 * tolerance_) continue;
        if (std::abs(b2.p.norm() - b->p.norm()) > 2 * tolerance_) continue;
        const Eigen::Matrix3d r = frame(a2.p, b2.p) * from.transpose();
        out->push_back({r, centre - r * centre});
      }
    }
  }

  /// The angle of a group's member is a simple fraction of a turn: takes the noise of the features out of it.
  static Eigen::Matrix3d tidy(const Eigen::Matrix3d& r) {
    const Eigen::AngleAxisd turn(r);
    for (int fold = 2; fold <= 60; ++fold) {
      for (int k = 1; 2 * k <= fold; ++k) {
        const double angle = 2 * M_PI * k / fold;
        if (std::abs(turn.angle() - angle) < 5e-3)
          return Eigen::AngleAxisd(angle, turn.axis()).toRotationMatrix();
      }
    }
    return r;
  }

  void noteTwin(const Rigid3& motion) {
    const Rigid3 back = motion.inverse();
    size_t off = 0;
    const size_t count = samples_.size() - first_area_sample_;
    for (size_t k = first_area_sample_; k < samples_.size(); ++k) {
      off += closest_.distance(motion * samples_[k], 2 * tolerance_) > tolerance_ ||
             closest_.distance(back * samples_[k], 2 * tolerance_) > tolerance_;
      if (double(off) > kTwinShare * double(count)) return;
    }
    for (const NearSymmetry& t : out_.twins) {
      if (indexOfTurn({t.motion.rotation}, motion.rotation) == 0) return;
    }
    out_.twins.push_back({motion, double(off) / double(count)});
  }

  const ObjectModel& model_;
  double tolerance_;
  ClosestPoint closest_;
  Tessellation round_;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moment_ = Eigen::Matrix3d::Zero();
  std::vector<double> until_;  // area of the triangles up to each [m^2]
  std::vector<Eigen::Vector3d> samples_, fine_;
  std::vector<double> tolerances_, fine_tolerances_;
  size_t first_area_sample_ = 0;
  std::vector<Mark> marks_;
  SymmetryResult out_;
};

}  // namespace

SymmetryResult findSymmetries(const ObjectModel& model, double tolerance) {
  return SymmetryFinder(model, tolerance).find();
}

}  // namespace monocular_eye_hand
