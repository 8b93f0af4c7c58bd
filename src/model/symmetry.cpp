#include "symmetry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "closest_point.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSurfaceSamples = 1500;
constexpr size_t kMostVertices = 3000;  // of the mesh, used as samples besides
constexpr double kTwinShare = 0.12;     // a rotation that moves less of the surface makes a twin
constexpr size_t kLargestGroup = 120;
constexpr double kSameTurn = 0.06;  // rotations closer than this are one: half of a 60-fold turn [rad]

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

class Finder {
 public:
  Finder(const ObjectModel& model, double tolerance)
      : model_(model), tolerance_(tolerance + 1.2 * model.tessellation_error), closest_(model.mesh) {
    sampleSurface();
    collectMarks();
  }

  SymmetryResult find() {
    if (isSphere()) {
      out_.symmetries.sphere = true;
      return std::move(out_);
    }
    if (findAxis()) return std::move(out_);
    std::vector<Rigid3> group{Rigid3{}};
    for (const Eigen::Matrix3d& r : candidates()) {
      const Rigid3 motion = about(r);
      if (contains(group, motion)) continue;
      if (holds(motion)) {
        group.push_back(motion);
      } else {
        noteTwin(motion);
      }
    }
    for (const Rigid3& motion : twinCandidates()) {
      if (!contains(group, motion)) noteTwin(motion);
    }
    out_.symmetries.discrete = closed(std::move(group));
    std::stable_sort(out_.twins.begin(), out_.twins.end(),
                     [](const NearSymmetry& a, const NearSymmetry& b) { return a.differing < b.differing; });
    return std::move(out_);
  }

 private:
  Rigid3 about(const Eigen::Matrix3d& r) const { return {r, centroid_ - r * centroid_}; }

  void sampleSurface() {
    std::vector<double> until;
    double area = 0;
    centroid_.setZero();
    for (const auto& t : model_.mesh.triangles) {
      const Eigen::Vector3d a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
      const double share = 0.5 * (b - a).cross(c - a).norm();
      area += share;
      until.push_back(area);
      centroid_ += share * (a + b + c) / 3;
      // Second moment of a triangle about the origin, exactly.
      const Eigen::Vector3d m = (a + b + c) / 3;
      moment_ +=
          share / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + 9 * m * m.transpose());
    }
    centroid_ /= area;
    moment_ = (moment_ / area - centroid_ * centroid_.transpose()).eval();
    const size_t stride = 1 + model_.mesh.vertices.size() / kMostVertices;
    for (size_t v = 0; v < model_.mesh.vertices.size(); v += stride)
      samples_.push_back(model_.mesh.vertices[v]);
    first_area_sample_ = samples_.size();
    for (int k = 0; k < kSurfaceSamples; ++k) {
      const double at = (k + 0.5) / kSurfaceSamples * area;
      const size_t t = size_t(std::lower_bound(until.begin(), until.end(), at) - until.begin());
      const auto& tri = model_.mesh.triangles[std::min(t, until.size() - 1)];
      double u = radicalInverse(unsigned(k + 1), 2), v = radicalInverse(unsigned(k + 1), 3);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      samples_.push_back(vertex(tri[0]) + u * (vertex(tri[1]) - vertex(tri[0])) +
                         v * (vertex(tri[2]) - vertex(tri[0])));
    }
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

  bool holds(const Rigid3& motion) const {
    const Rigid3 back = motion.inverse();
    for (const Eigen::Vector3d& p : samples_) {
      if (closest_.distance(motion * p, 2 * tolerance_) > tolerance_) return false;
      if (closest_.distance(back * p, 2 * tolerance_) > tolerance_) return false;
    }
    return true;
  }

  bool isSphere() const {
    double low = 1e300, high = 0;
    for (const Eigen::Vector3d& p : samples_) {
      const double r = (p - centroid_).norm();
      low = std::min(low, r);
      high = std::max(high, r);
    }
    return high - low < tolerance_;
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
      bool all = true;
      // Angles without a common measure: no discrete group passes them all.
      for (const double angle : {0.4142, 1.0, 1.6180, 2.2361, 2.7183}) {
        all = all && holds(about(Eigen::AngleAxisd(angle, axis).toRotationMatrix()));
      }
      if (!all) continue;
      Eigen::Index largest;
      axis.cwiseAbs().maxCoeff(&largest);
      const Eigen::Vector3d direction = axis[largest] < 0 ? Eigen::Vector3d(-axis) : axis;
      out_.symmetries.axis = SymmetryAxis{centroid_ - direction * direction.dot(centroid_), direction};
      const Rigid3 flip = about(Eigen::AngleAxisd(kPi, direction.unitOrthogonal()).toRotationMatrix());
      if (holds(flip)) out_.symmetries.discrete.push_back(flip);
      return true;
    }
    return false;
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
        out.push_back(Eigen::AngleAxisd(2 * kPi / fold, axis).toRotationMatrix());
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

  static double apart(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    return Eigen::AngleAxisd(a.transpose() * b).angle();
  }

  static bool contains(const std::vector<Rigid3>& group, const Rigid3& motion) {
    return std::any_of(group.begin(), group.end(),
                       [&](const Rigid3& g) { return apart(g.rotation, motion.rotation) < kSameTurn; });
  }

  /// Products of symmetries are symmetries: adds those that no candidate named, in a repeatable order.
  std::vector<Rigid3> closed(std::vector<Rigid3> group) const {
    for (size_t i = 0; i < group.size() && group.size() < kLargestGroup; ++i) {
      for (size_t j = 0; j <= i && group.size() < kLargestGroup; ++j) {
        for (const Rigid3& product : {group[i] * group[j], group[j] * group[i]}) {
          if (!contains(group, product) && holds(about(product.rotation)))
            group.push_back(about(product.rotation));
        }
      }
    }
    for (Rigid3& g : group) g = tidy(g);
    std::stable_sort(group.begin() + 1, group.end(), [](const Rigid3& a, const Rigid3& b) {
      const double ta = a.rotation.trace(), tb = b.rotation.trace();
      if (std::abs(ta - tb) > 1e-6) return ta > tb;
      for (int k = 0; k < 9; ++k) {
        const double d = a.rotation(k / 3, k % 3) - b.rotation(k / 3, k % 3);
        if (std::abs(d) > 1e-6) return d > 0;
      }
      return false;
    });
    return group;
  }

  /// The angle of a group's member is a simple fraction of a turn: takes the noise of the features out of it.
  Rigid3 tidy(const Rigid3& g) const {
    const Eigen::AngleAxisd turn(g.rotation);
    if (turn.angle() < 1e-9) return {};
    for (int fold = 2; fold <= 60; ++fold) {
      for (int k = 1; 2 * k <= fold; ++k) {
        const double angle = 2 * kPi * k / fold;
        if (std::abs(turn.angle() - angle) < 1e-3)
          return about(Eigen::AngleAxisd(angle, turn.axis()).toRotationMatrix());
      }
    }
    return g;
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
      if (apart(t.motion.rotation, motion.rotation) < kSameTurn) return;
    }
    out_.twins.push_back({motion, double(off) / double(count)});
  }

  const ObjectModel& model_;
  double tolerance_;
  ClosestPoint closest_;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moment_ = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Vector3d> samples_;
  size_t first_area_sample_ = 0;
  std::vector<Mark> marks_;
  SymmetryResult out_;
};

}  // namespace

SymmetryResult findSymmetries(const ObjectModel& model, double tolerance) {
  return Finder(model, tolerance).find();
}

}  // namespace monocular_eye_hand
