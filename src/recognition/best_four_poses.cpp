#include "recognition/best_four_poses.h"

#include <optional>
#include <utility>

#include "monocular_eye_hand/pose/refine.h"
#include "recognition/alignment.h"
#include "recognition/constellation.h"
#include "recognition/judging.h"
#include "recognition/verification.h"

namespace monocular_eye_hand {
namespace {

constexpr double kWorthRecalculating = 0.05;  // probability from which a candidate may still be reported
const std::vector<double> kRanges{2.5, 1.5};  // of the alignment after the best four [px]

// The candidate under the pose that the best four of the matches fix; nothing when they fix none.
std::optional<Candidate> recalculated(const SearchTask& task, const Candidate& candidate,
                                      const std::vector<PointMatch>& matches) {
  const SearchModel& model = task.models[candidate.object];
  const RefinedPose four = poseFromBestFour(matches, candidate.pose.camera_from_object, task.image.camera);
  if (!four.well_posed) return std::nullopt;

  Candidate again = candidate;
  again.pose = alignFinely(model, task.image, four.camera_from_object, kRanges, kFineStep);
  if (!again.pose.well_posed) return std::nullopt;

  again.pose.camera_from_object = model.canonical(again.pose.camera_from_object, &again.view);
  verify(model, task.image, &again);
  weighAlone(task, &again);
  return again;
}

}  // namespace

std::vector<Candidate> recalculateBestFour(const SearchTask& task, Explained all, StageLog* log) {
  std::vector<Candidate>& candidates = all.candidates;
  log->timed("best four", [&](StageReport* report) {
    const std::vector<ImageCorner> corners = imageCorners(task.image.groupings);
    for (const Explanation& explanation : all.chosen) {
      Candidate& candidate = candidates[explanation.candidate];
      if (candidate.probability < kWorthRecalculating) continue;
      const std::vector<PointMatch> matches = growConstellation(
          task.models[candidate.object], candidate, task.image.camera, task.image.features, corners);
      candidate.matched_corners = int(matches.size());
      report->counts["corners"] += double(matches.size());
      if (matches.size() < 4) continue;

      std::optional<Candidate> again = recalculated(task, candidate, matches);
      if (!again || again->terms.sum <= candidate.terms.sum || again->probability < candidate.probability)
        continue;
      candidate = std::move(*again);
      ++report->counts["improved"];
    }
  });
  return std::move(candidates);
}

}  // namespace monocular_eye_hand
