#include "recognition/full_size.h"

#include <algorithm>
#include <utility>

#include "recognition/alignment.h"
#include "recognition/judging.h"

namespace monocular_eye_hand {
namespace {

constexpr int kRivals = 4;           // of each chosen candidate looked at in full
constexpr size_t kMostJudged = 100;  // candidates looked at in full
constexpr size_t kCompared = 10;     // of the best candidates tell which size resolves the contours better
constexpr double kMuchLess = 0.85;   // of the hits: the full image is too blurred

// The chosen candidates with their first rivals, the best ranks first.
std::vector<int> worthAFullLook(const std::vector<Candidate>& candidates,
                                const std::vector<Explanation>& chosen) {
  std::vector<int> worth;
  for (const Explanation& explanation : chosen) {
    worth.push_back(explanation.candidate);
    const size_t rivals = std::min<size_t>(kRivals, explanation.rivals.size());
    worth.insert(worth.end(), explanation.rivals.begin(), explanation.rivals.begin() + long(rivals));
  }

  std::stable_sort(worth.begin(), worth.end(), [&](int a, int b) {
    return rankScore(candidates[size_t(a)]) > rankScore(candidates[size_t(b)]);
  });
  if (worth.size() > kMostJudged) worth.resize(kMostJudged);
  return worth;
}

// How well the best candidates' contours are seen.
double resolved(const std::vector<Candidate>& candidates) {
  std::vector<size_t> order(candidates.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return candidates[a].probability > candidates[b].probability; });
  double sum = 0;
  const size_t count = std::min(kCompared, order.size());
  for (size_t k = 0; k < count; ++k) sum += candidates[order[k]].terms.hit_ratio;
  return count ? sum / double(count) : 0;
}

}  // namespace

std::optional<FullSize> judgeInFull(const SearchTask& task, const ModelBase& base,
                                    const std::vector<Candidate>& candidates,
                                    const std::vector<Explanation>& chosen, const cv::Mat& grey,
                                    const Camera& camera, StageLog* log) {
  const double scale = double(camera.width) / task.image.camera.width;
  if (!(scale > 1) || chosen.empty()) return std::nullopt;

  return log->timed("full size", [&](StageReport* report) -> std::optional<FullSize> {
    FullSize full;
    full.image = withEvidence(
        withGroupings(withFeatures(grey, camera, task.options.features), base, task.options.grouping));
    report->counts["edge points"] = double(full.image.features.points.size());

    const SearchTask in_full{full.image, task.models, task.wanted, task.options};
    std::vector<Candidate> before;
    for (int index : worthAFullLook(candidates, chosen)) {
      const Candidate& small = candidates[size_t(index)];
      std::optional<Candidate> candidate = alignedCandidate(
          in_full, small.object, small.pose.camera_from_object, {1.5 * scale, scale, 1.5}, full.candidates);
      report->counts["verified"] += candidate.has_value();
      if (!candidate || !bearsOut(in_full, &*candidate)) continue;
      candidate->kind = small.kind;
      full.candidates.push_back(std::move(*candidate));
      before.push_back(small);
    }
    if (resolved(full.candidates) < kMuchLess * resolved(before)) return std::nullopt;
    return full;
  });
}

}  // namespace monocular_eye_hand
