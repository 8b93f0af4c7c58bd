#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/pose/circle_pose.h"
#include "recognition/pair_poses.h"

namespace monocular_eye_hand {
namespace {

constexpr int kRolls = 60;            // steps of the rotation about the circle's axis
constexpr double kSmallEllipse = 30;  // semi-axis below which the tilt is uncertain [px]
constexpr double kCentreError = 10;   // largest image error of the second circle's centre [px]
constexpr double kLineError = 8;      // largest distance of a model edge's end from its line [px]
constexpr double kShared = 0.5;       // of the shorter of an edge and its segment that lies beside the other
constexpr double kOpens = 0.3;        // share of an outward normal from which a surface opens to that side
constexpr double kSideways = 3;  // radii off the axis from where two fifths of an outer wall's rim are seen
constexpr double kLongBaseline =
    0.5;                           // centres this far apart, in radii, tell the axis better than one ellipse
constexpr double kNoLever = 1e-9;  // an edge this near to the axis tells no roll [m]
constexpr double kSameAxis = 0.5;  // farthest such an axis may be from the one ellipse's [rad]

// About a circle's axis.
struct AxisRotation {
  double cosine = 1, sine = 0;
};

struct AxisRotations {
  int count = 0;
  std::array<AxisRotation, 2> rotation;
};

// Small ellipses fix the tilt badly: neighbours with another short axis and direction are tried as well.
std::vector<Ellipse> variants(const Ellipse& seen) {
  std::vector<Ellipse> all{seen};
  if (seen.a > kSmallEllipse) return all;
  for (double db : {-1.5, 1.5}) {
    Ellipse e = seen;
    e.b = std::min(e.b + db, e.a);
    if (e.b > 1.5) all.push_back(e);
  }
  for (double rotation : {-0.12, 0.12}) {
    Ellipse e = seen;
    e.angle += rotation;
    all.push_back(e);
  }
  return all;
}

// Rotations that are tried where nothing tells the rotation about the axis.
const std::vector<AxisRotation>& allRotations() {
  static const std::vector<AxisRotation> kAll = [] {
    std::vector<AxisRotation> all;
    all.reserve(kRolls);
    for (int k = 0; k < kRolls; ++k)
      all.push_back({std::cos(2 * M_PI * k / kRolls), std::sin(2 * M_PI * k / kRolls)});
    return all;
  }();
  return kAll;
}

// Poses with the circle's centre at `centre` and its axis along `normal`, that differ by the rotation about
// it.
class PosesOfCircle {
 public:
  PosesOfCircle(const ModelCircle& circle, const Eigen::Vector3d& centre, const Eigen::Vector3d& normal)
      : circle_(circle),
        centre_(centre),
        normal_(normal),
        u_(normal.unitOrthogonal()),
        v_(normal.cross(u_)) {}

  const Eigen::Vector3d& centre() const { return centre_; }
  const Eigen::Vector3d& normal() const { return normal_; }
  /// Where the circle's x and y axes lie before the rotation.
  const Eigen::Vector3d& u() const { return u_; }
  const Eigen::Vector3d& v() const { return v_; }

  Rigid3 rotatedBy(const AxisRotation& rotation) const {
    const auto& [c, s] = rotation;
    Eigen::Matrix3d in_object, in_camera;
    in_object << circle_.x_axis, circle_.axis.cross(circle_.x_axis), circle_.axis;
    in_camera << c * u_ + s * v_, c * v_ - s * u_, normal_;
    Rigid3 pose;
    pose.rotation = in_camera * in_object.transpose();
    pose.translation = centre_ - pose.rotation * circle_.centre;
    return pose;
  }
  // Of a point given along the circle's x, y and axis.
  Eigen::Vector3d rotatedBy(const AxisRotation& rotation, const Eigen::Vector3d& place) const {
    const double x = rotation.cosine * place.x() - rotation.sine * place.y();
    const double y = rotation.sine * place.x() + rotation.cosine * place.y();
    return centre_ + x * u_ + y * v_ + place.z() * normal_;
  }

  // Whether a good part of the rim can show: it does from where one of its surfaces opens to, and from behind
  // where the part inside it is seen far enough from the side. The wall of a hole is hidden from behind.
  bool rimShows() const {
    if (circle_.surface[1] < 0) return true;
    const double axial = -centre_.dot(normal_);  // of the eye [m]
    const double radial = std::sqrt(std::max(0.0, centre_.squaredNorm() - axial * axial));
    const auto shows = [&](const Eigen::Vector2d& outward) {
      return outward.y() * axial > kOpens * std::abs(axial) ||
             (outward.x() > kOpens && radial > kSideways * circle_.radius);
    };
    return shows(circle_.normal[0]) || shows(circle_.normal[1]);
  }

 private:
  const ModelCircle& circle_;
  Eigen::Vector3d centre_, normal_, u_, v_;
};

void offerRotations(const ObjectModel& model, const PosesOfCircle& circle, std::vector<Rigid3>* poses) {
  if (!circle.rimShows()) return;
  if (model.symmetries.axis) {
    poses->push_back(circle.rotatedBy(allRotations().front()));
    return;
  }
  for (const AxisRotation& rotation : allRotations()) poses->push_back(circle.rotatedBy(rotation));
}

// Whether an object with its circle there may be at one of the distances.
bool within(const DistanceRange& range, const ObjectModel& model, const ModelCircle& circle,
            const Eigen::Vector3d& centre) {
  const double distance = centre.norm();
  const double apart = (circle.centre - model.centre()).norm();
  return distance > range.nearest - apart && distance < range.farthest + apart;
}

// The axis through `centre` on which the second centre, `offset` [m] farther, is seen at `uv`; of the two
// that which is nearer to `axis`. Returns `axis` when there is none near it.
Eigen::Vector3d axisThroughCentres(const Camera& camera, const Eigen::Vector3d& centre,
                                   const Eigen::Vector2d& uv, double offset, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d ray = camera.ray(uv).normalized();
  const double along = ray.dot(centre);
  const double rest = offset * offset - (centre.squaredNorm() - along * along);
  if (rest < 0) return axis;
  Eigen::Vector3d best = axis;
  double nearest = std::cos(kSameAxis);
  for (double sign : {1.0, -1.0}) {
    const Eigen::Vector3d candidate = ((along + sign * std::sqrt(rest)) * ray - centre) / offset;
    if (candidate.dot(axis) > nearest) {
      nearest = candidate.dot(axis);
      best = candidate.normalized();
    }
  }
  return best;
}

// A point along a circle's x, y and axis [m].
Eigen::Vector3d placeAbout(const ModelCircle& circle, const Eigen::Vector3d& point) {
  const Eigen::Vector3d r = point - circle.centre;
  return {r.dot(circle.x_axis), r.dot(circle.axis.cross(circle.x_axis)), r.dot(circle.axis)};
}

// Rotations about the circle's axis that bring a point (placeAbout) into the plane of the eye and the image
// line: plane . (centre + z normal + (x u + y v) cos + (x v - y u) sin) = 0, with cos^2 + sin^2 = 1.
AxisRotations rotationsOntoLine(const Eigen::Vector3d& plane, const PosesOfCircle& circle,
                                const Eigen::Vector3d& place) {
  const double pu = plane.dot(circle.u()), pv = plane.dot(circle.v());
  const double a = place.x() * pu + place.y() * pv, b = place.x() * pv - place.y() * pu;
  const double c = plane.dot(circle.centre() + place.z() * circle.normal());
  const double squared = a * a + b * b;
  if (squared <= kNoLever * kNoLever || c * c > squared) return {};
  const double along = -c / squared;
  const double across = std::sqrt(std::max(0.0, squared - c * c)) / squared;
  return {
      2,
      {{{a * along - b * across, b * along + a * across}, {a * along + b * across, b * along - a * across}}}};
}

// Whether an edge between two points (camera frame) may be the segment: on its line, the same way round, and
// side by side with it.
bool liesOnSegment(const Camera& camera, const Grouping& seen, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& q) {
  if (p.z() <= 0 || q.z() <= 0) return false;
  const Eigen::Vector2d along = seen.points[1] - seen.points[0];
  const double length = along.norm();
  const auto placed = [&](const Eigen::Vector3d& end) -> Eigen::Vector2d {  // along and beside the segment
    const Eigen::Vector2d d = camera.project(end) - seen.points[0];
    return {along.dot(d) / length, (along.x() * d.y() - along.y() * d.x()) / length};
  };
  const Eigen::Vector2d first = placed(p);
  if (std::abs(first.y()) >= kLineError) return false;
  const Eigen::Vector2d last = placed(q);
  if (std::abs(last.y()) >= kLineError || last.x() <= first.x()) return false;
  const double shared = std::min(last.x(), length) - std::max(first.x(), 0.0);
  return shared >= kShared * std::min(last.x() - first.x(), length);
}

}  // namespace

void posesOfEllipse(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                    const GroupingPair& pair, std::vector<Rigid3>* poses) {
  const ModelCircle& circle = model.circles[pair.known.circles[pair.order.ellipses[0]]];
  for (const Ellipse& seen : variants(image.features.ellipses[pair.seen.ellipses[0]].ellipse)) {
    const CirclePoses solutions = circlePoses(seen, image.camera, circle.radius);
    for (int i = 0; i < solutions.count && within(range, model, circle, solutions.pose[0].centre); ++i)
      for (double side : {1.0, -1.0})  // a rim is seen from its face's side or, as an outline, from behind
        offerRotations(model, {circle, solutions.pose[i].centre, side * solutions.pose[i].normal}, poses);
  }
}

void posesOfEllipsePair(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                        const GroupingPair& pair, std::vector<Rigid3>* poses) {
  // The larger ellipse is the better known one.
  const auto ellipse = [&](int i) -> const Ellipse& {
    return image.features.ellipses[pair.seen.ellipses[i]].ellipse;
  };
  const int first = ellipse(0).a >= ellipse(1).a ? 0 : 1;

  const ModelCircle& circle = model.circles[pair.known.circles[pair.order.ellipses[first]]];
  const ModelCircle& other = model.circles[pair.known.circles[pair.order.ellipses[1 - first]]];
  const double offset = circle.axis.dot(other.centre - circle.centre);
  const Eigen::Vector2d seen = ellipse(1 - first).centre;
  const CirclePoses& solutions = image.unit_circles[size_t(pair.seen.ellipses[first])];

  for (int i = 0; i < solutions.count; ++i)
    for (double side : {1.0, -1.0}) {
      const Eigen::Vector3d centre = circle.radius * solutions.pose[i].centre;
      if (!within(range, model, circle, centre)) continue;
      Eigen::Vector3d axis = side * solutions.pose[i].normal;
      if (std::abs(offset) > kLongBaseline * circle.radius)
        axis = axisThroughCentres(image.camera, centre, seen, offset, axis);
      const Eigen::Vector3d second = centre + offset * axis;
      if (second.z() <= 0 || (image.camera.project(second) - seen).norm() > kCentreError) continue;
      offerRotations(model, {circle, centre, axis}, poses);
    }
}

void posesOfEllipseLine(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                        const GroupingPair& pair, std::vector<Rigid3>* poses) {
  const auto& [seen, known, order] = pair;
  const Camera& camera = image.camera;
  const ModelCircle& circle = model.circles[known.circles[order.ellipses[0]]];
  const Eigen::Vector3d first = placeAbout(circle, known.points[order.points[0]]);
  const Eigen::Vector3d last = placeAbout(circle, known.points[order.points[1]]);
  // The end that is farther from the axis tells the rotation better.
  const Eigen::Vector3d& lever = first.head<2>().squaredNorm() > last.head<2>().squaredNorm() ? first : last;
  const CirclePoses& solutions = image.unit_circles[size_t(seen.ellipses[0])];
  const Eigen::Vector3d plane = camera.ray(seen.points[0]).cross(camera.ray(seen.points[1])).normalized();

  for (int i = 0; i < solutions.count; ++i) {
    const Eigen::Vector3d centre = circle.radius * solutions.pose[i].centre;
    if (!within(range, model, circle, centre)) continue;
    for (double side : {1.0, -1.0}) {
      const PosesOfCircle about_axis(circle, centre, side * solutions.pose[i].normal);
      if (!about_axis.rimShows()) continue;
      const AxisRotations onto = rotationsOntoLine(plane, about_axis, lever);
      for (int k = 0; k < onto.count; ++k) {
        const AxisRotation& rotation = onto.rotation[size_t(k)];
        if (liesOnSegment(camera, seen, about_axis.rotatedBy(rotation, first),
                          about_axis.rotatedBy(rotation, last)))
          poses->push_back(about_axis.rotatedBy(rotation));
      }
    }
  }
}

}  // namespace monocular_eye_hand
