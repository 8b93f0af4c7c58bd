#include "recognition/nearby_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "monocular_eye_hand/model/equal_poses.h"
#include "recognition/alignment.h"
#include "recognition/judging.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDoubtfulFrom = 0.02,
                 kDoubtfulTo = 0.95;  // probabilities between which a candidate is doubtful
constexpr size_t kMaxTried = 10;      // doubtful candidates of an image
constexpr size_t kSides = 8;
constexpr double kTilt = 8 * M_PI / 180;
constexpr double kGain = 0.15;  // of probability, for which a candidate gives way

// Indices of the doubtful candidates, the likeliest first.
std::vector<size_t> doubtful(const std::vector<Candidate>& candidates) {
  std::vector<size_t> order;
  for (size_t i = 0; i < candidates.size(); ++i)
    if (candidates[i].probability >= kDoubtfulFrom && candidates[i].probability <= kDoubtfulTo)
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return candidates[a].probability > candidates[b].probability; });
  if (order.size() > kMaxTried) order.resize(kMaxTried);
  return order;
}

// The pose tilted about the part's centre to one of kSides sides.
Rigid3 tilted(const Rigid3& pose, const Eigen::Vector3d& centre_in_object, size_t side) {
  const Eigen::Vector3d centre = pose * centre_in_object;
  const Eigen::Vector3d view = centre.normalized(), x = view.unitOrthogonal(), y = view.cross(x);
  const double angle = 2 * M_PI * double(side) / double(kSides);
  const Eigen::Vector3d axis = std::cos(angle) * x + std::sin(angle) * y;
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(kTilt, axis).toRotationMatrix();
  return rotationAbout(centre, rotation) * pose;
}

// The most probable of so many, if it is more probable than that.
std::optional<Candidate> bestAbove(double probability, const Judged* first, size_t count) {
  const Candidate* best = nullptr;
  for (const Judged* judged = first; judged != first + count; ++judged) {
    if (!judged->candidate || judged->candidate->probability <= probability) continue;
    probability = judged->candidate->probability;
    best = &*judged->candidate;
  }
  return best ? std::optional<Candidate>(*best) : std::nullopt;
}

}  // namespace

std::vector<Candidate> tryNearbyPoses(const SearchTask& task, std::vector<Candidate> candidates,
                                      StageLog* log) {
  return log->timed("nearby poses", [&](StageReport* report) {
    const std::vector<size_t> tried = doubtful(candidates);
    std::vector<Start> starts;
    for (size_t i : tried) {
      const Candidate& candidate = candidates[i];
      const Eigen::Vector3d centre = task.models[size_t(candidate.object)].model().centre();
      for (size_t side = 0; side < kSides; ++side)
        starts.push_back(
            {candidate.object, tilted(candidate.pose.camera_from_object, centre, side), candidate.kind});
    }

    WorkBudget no_limit;
    const std::vector<Judged> judged = judgeStarts(task, starts, kFineRanges, candidates, 0, &no_limit);
    int better = 0;
    for (size_t k = 0; k < tried.size(); ++k) {
      Candidate& own = candidates[tried[k]];
      std::optional<Candidate> best = bestAbove(own.probability + kGain, &judged[kSides * k], kSides);
      if (!best) continue;
      own = std::move(*best);
      ++better;
    }

    report->counts = {{"doubtful", double(tried.size())}, {"better", double(better)}};
    return std::move(candidates);
  });
}

}  // namespace monocular_eye_hand
