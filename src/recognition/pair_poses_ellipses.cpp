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
constexpr double kLongBaseline =
    0.5;                           // centres this far apart, in radii, tell the axis better than one ellipse
constexpr double kNoLever = 1e-9;  // an edge this near to the axis tells no roll [m]
constexpr double kSameAxis = 0.5;  // farthest such an axis may be from the one ellipse's [rad]

// Small ellipses fix the tilt badly: neighbours with another short axis and direction are tried as well.
std::vector<Ellipse> variants(const Ellipse& seen) {
  std::vector<Ellipse> all{seen};
  if (seen.a > kSmallEllipse) return all;
  for (double db : {-1.5, 1.5}) {
    Ellipse e = seen;
    e.b = std::min(e.b + db, e.a);
    if (e.b > 1.5) all.push_back(e);
  }
  for (double turn : {-0.12, 0.12}) {
    Ellipse e = seen;
    e.angle += turn;
    all.push_back(e);
  }
  return all;
}

// Poses with the circle's centre at `centre` and its axis along `normal`, that differ by the turn about it.
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
  /// Where the circle's x and y axes lie at roll 0.
  const Eigen::Vector3d& u() const { return u_; }
  const Eigen::Vector3d& v() const { return v_; }

  Rigid3 turnedBy(double roll) const {
    const double c = std::cos(roll), s = std::sin(roll);
    Eigen::Matrix3d in_object, in_camera;
    in_object << circle_.x_axis, circle_.axis.cross(circle_.x_axis), circle_.axis;
    in_camera << c * u_ + s * v_, c * v_ - s * u_, normal_;
    Rigid3 pose;
    pose.rotation = in_camera * in_object.transpose();
    pose.translation = centre_ - pose.rotation * circle_.centre;
    return pose;
  }

 private:
  const ModelCircle& circle_;
  Eigen::Vector3d centre_, normal_, u_, v_;
};

void turnAbout(const ObjectModel& model, const PosesOfCircle& circle, std::vector<Rigid3>* poses) {
  const int rolls = model.symmetries.axis ? 1 : kRolls;
  for (int k = 0; k < rolls; ++k) poses->push_back(circle.turnedBy(2 * M_PI * k / kRolls));
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
    if (candidate.dot(axis) > nearest) nearest = candidate.dot(axis), best = candidate.normalized();
  }
  return best;
}

// The end of an edge that is farther from a circle's axis, along the circle's x, y and axis [m].
Eigen::Vector3d fartherEnd(const ModelCircle& circle, const std::array<Eigen::Vector3d, 2>& edge) {
  const Eigen::Vector3d y_axis = circle.axis.cross(circle.x_axis);
  Eigen::Vector3d farther = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& end : edge) {
    const Eigen::Vector3d r = end - circle.centre;
    const Eigen::Vector3d place(r.dot(circle.x_axis), r.dot(y_axis), r.dot(circle.axis));
    if (place.head<2>().squaredNorm() > farther.head<2>().squaredNorm()) farther = place;
  }
  return farther;
}

// Turns about the circle's axis that bring the end of an edge (fartherEnd) into the plane of the eye and the
// image line: plane . (centre + z normal + (x u + y v) cos(roll) + (x v - y u) sin(roll)) = 0.
std::vector<double> rollsOntoLine(const Eigen::Vector3d& plane, const PosesOfCircle& circle,
                                  const Eigen::Vector3d& end) {
  const double pu = plane.dot(circle.u()), pv = plane.dot(circle.v());
  const double a = end.x() * pu + end.y() * pv, b = end.x() * pv - end.y() * pu;
  const double c = plane.dot(circle.centre() + end.z() * circle.normal()),
               amplitude = std::sqrt(a * a + b * b);
  if (amplitude <= kNoLever || std::abs(c) > amplitude) return {};
  const double middle = std::atan2(b, a), half = std::acos(-c / amplitude);
  return {middle + half, middle - half};
}

bool liesOnLine(const Camera& camera, const Grouping& seen, const Rigid3& pose,
                const std::array<Eigen::Vector3d, 2>& edge) {
  const Eigen::Vector3d p = pose * edge[0], q = pose * edge[1];
  if (p.z() <= 0 || q.z() <= 0) return false;
  const Eigen::Vector2d direction = (seen.points[1] - seen.points[0]).normalized();
  const Eigen::Vector2d u = camera.project(p), v = camera.project(q);
  const auto distance = [&](const Eigen::Vector2d& at) {
    const Eigen::Vector2d d = at - seen.points[0];
    return std::abs(direction.x() * d.y() - direction.y() * d.x());
  };
  return distance(u) < kLineError && distance(v) < kLineError && direction.dot(v - u) > 0;
}

}  // namespace

void posesOfEllipse(const SearchImage& image, const ObjectModel& model, const GroupingPair& pair,
                    std::vector<Rigid3>* poses) {
  const ModelCircle& circle = model.circles[pair.known.circles[pair.order.ellipses[0]]];
  for (const Ellipse& seen : variants(image.features.ellipses[pair.seen.ellipses[0]].ellipse)) {
    const CirclePoses solutions = circlePoses(seen, image.camera, circle.radius);
    for (int i = 0; i < solutions.count; ++i)
      for (double side : {1.0, -1.0})  // a rim is seen from its face's side or, as an outline, from behind
        turnAbout(model, {circle, solutions.pose[i].centre, side * solutions.pose[i].normal}, poses);
  }
}

void posesOfEllipsePair(const SearchImage& image, const ObjectModel& model, const GroupingPair& pair,
                        std::vector<Rigid3>* poses) {
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
      Eigen::Vector3d axis = side * solutions.pose[i].normal;
      if (std::abs(offset) > kLongBaseline * circle.radius)
        axis = axisThroughCentres(image.camera, centre, seen, offset, axis);
      const Eigen::Vector3d second = centre + offset * axis;
      if (second.z() <= 0 || (image.camera.project(second) - seen).norm() > kCentreError) continue;
      turnAbout(model, {circle, centre, axis}, poses);
    }
}

void posesOfEllipseLine(const SearchImage& image, const ObjectModel& model, const GroupingPair& pair,
                        std::vector<Rigid3>* poses) {
  const auto& [seen, known, order] = pair;
  const ModelCircle& circle = model.circles[known.circles[order.ellipses[0]]];
  const std::array<Eigen::Vector3d, 2> edge{known.points[order.points[0]], known.points[order.points[1]]};
  const CirclePoses& solutions = image.unit_circles[size_t(seen.ellipses[0])];
  const Eigen::Vector3d end = fartherEnd(circle, edge);
  const Camera& camera = image.camera;
  const Eigen::Vector3d plane = camera.ray(seen.points[0]).cross(camera.ray(seen.points[1])).normalized();

  for (int i = 0; i < solutions.count; ++i)
    for (double side : {1.0, -1.0}) {
      const PosesOfCircle turns(circle, circle.radius * solutions.pose[i].centre,
                                side * solutions.pose[i].normal);
      for (double roll : rollsOntoLine(plane, turns, end)) {
        const Rigid3 pose = turns.turnedBy(roll);
        if (liesOnLine(camera, seen, pose, edge)) poses->push_back(pose);
      }
    }
}

}  // namespace monocular_eye_hand
