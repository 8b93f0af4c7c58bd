#include "recognition/twins.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "monocular_eye_hand/model/equal_poses.h"
#include "recognition/alignment.h"
#include "recognition/judging.h"

namespace monocular_eye_hand {
namespace {

constexpr double kWorthTwins =
    0.1;                          // probability from which a candidate may still be reported, or its twin be
constexpr double kFlat = 0.5;     // thickness over the next larger extent of a part that tilts either way
constexpr double kMinTilt = 0.1;  // a smaller one is none [rad]

// The pose whose flat side is tilted the other way: its image is nearly the same from far away.
std::optional<Rigid3> tiltedBack(const ObjectModel& model, const Rigid3& pose) {
  const Eigen::Vector3d extent = model.bounds.sizes();
  Eigen::Index thinnest;
  extent.minCoeff(&thinnest);
  const double next = std::min(extent[(thinnest + 1) % 3], extent[(thinnest + 2) % 3]);
  if (extent[thinnest] > kFlat * next) return std::nullopt;

  const Eigen::Vector3d centre = pose * model.centre();
  const Eigen::Vector3d view = centre.normalized(), normal = pose.rotation.col(thinnest);
  const Eigen::Vector3d axis = normal.cross(view);
  const double sine = axis.norm();
  if (sine < std::sin(kMinTilt)) return std::nullopt;
  const double tilt = std::asin(std::min(1.0, sine));
  const double side = normal.dot(view) > 0 ? 1 : -1;
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(2 * side * tilt, axis / sine).toRotationMatrix();
  return rotationAbout(centre, rotation) * pose;
}

std::vector<Rigid3> twinPoses(const SearchModel& model, const Rigid3& pose) {
  std::vector<Rigid3> twins;
  for (const Rigid3& motion : model.boxRotations()) twins.push_back(pose * motion);
  if (const std::optional<Rigid3> back = tiltedBack(model.model(), pose)) twins.push_back(*back);
  return twins;
}

}  // namespace

std::vector<Candidate> addTwins(const SearchTask& task, Explained all, StageLog* log) {
  std::vector<Candidate>& candidates = all.candidates;
  return log->timed("twins", [&](StageReport* report) {
    std::vector<Start> starts;
    for (const Explanation& explanation : all.chosen) {
      const Candidate& candidate = candidates[explanation.candidate];
      if (candidate.probability < kWorthTwins) continue;
      for (const Rigid3& twin : twinPoses(task.models[candidate.object], candidate.pose.camera_from_object))
        starts.push_back({candidate.object, twin});
    }

    WorkBudget no_limit;
    std::vector<Candidate> twins =
        borneOut(judgeStarts(task, starts, kFineRanges, candidates, 0, &no_limit), report);
    std::move(twins.begin(), twins.end(), std::back_inserter(candidates));
    return std::move(candidates);
  });
}

}  // namespace monocular_eye_hand
