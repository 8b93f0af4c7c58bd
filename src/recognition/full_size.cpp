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
constexpr double kLikely = 0;        // log-odds, at either size: what is wrong at both tells nothing
constexpr double kClear = 3;         // log-odds: surer is no better resolved

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

// What the small and the full image say for a candidate [log-odds].
struct Said {
  double small, full;
};

double clearlyFor(const Candidate& candidate, const DecisionWeights& weights) {
  return std::clamp(ownLogOdds(candidate, weights), -kClear, kClear);
}

// Whether the full image says no less for the best candidates. One that is blurred, or was enlarged, says
// less: its edges are fainter and lie farther off, in its pixels.
bool fullSaysNoLess(std::vector<Said> said) {
  const auto best = [](const Said& s) { return std::max(s.small, s.full); };
  said.erase(std::remove_if(said.begin(), said.end(), [&](const Said& s) { return best(s) < kLikely; }),
             said.end());
  std::stable_sort(said.begin(), said.end(), [&](const Said& a, const Said& b) { return best(a) > best(b); });
  if (said.size() > kCompared) said.resize(kCompared);

  double gain = 0;
  for (const Said& s : said) gain += s.full - s.small;
  return gain >= 0;
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

    const SearchTask in_full{full.image, task.models, task.wanted, task.options, nullptr, task.support};
    const std::vector<int> worth = worthAFullLook(candidates, chosen);
    std::vector<Start> starts;
    for (int index : worth) {
      const Candidate& small = candidates[size_t(index)];
      starts.push_back({small.object, small.pose.camera_from_object, small.kind});
    }
    WorkBudget no_limit;
    std::vector<Judged> judged = judgeStarts(in_full, starts, {1.5 * scale, scale, 1.5}, {}, 0, &no_limit);

    std::vector<Said> said;
    for (size_t i = 0; i < judged.size(); ++i) {
      if (!judged[i].aligned) continue;
      const std::optional<Candidate>& in_full_size = judged[i].candidate;
      said.push_back({clearlyFor(candidates[size_t(worth[i])], task.options.decision),
                      in_full_size ? clearlyFor(*in_full_size, task.options.decision) : -kClear});
    }
    full.candidates = borneOut(std::move(judged), report);
    if (!fullSaysNoLess(said)) return std::nullopt;
    return full;
  });
}

}  // namespace monocular_eye_hand
