#include "recognition/finer_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "recognition/alignment.h"
#include "recognition/decision.h"
#include "recognition/focal_length.h"
#include "recognition/judging.h"

namespace monocular_eye_hand {
namespace {

constexpr int kRivals = 4;          // of each chosen candidate looked at again
constexpr size_t kMaxJudged = 100;  // candidates looked at again
constexpr size_t kCompared = 10;    // of the best candidates tell which size resolves the contours better
constexpr double kLikely = 0;       // log-odds, at either size: what is wrong at both tells nothing
constexpr double kClear = 3;        // log-odds: surer is no better resolved
constexpr double kResolvedDiameter = 400;  // of a part's diameter: larger images tell no more [px]
constexpr double kSmall = 1.25;            // times min_size: parts smaller than that are searched for again

// The chosen candidates with their first rivals, the best ranks first.
std::vector<int> worthAnotherLook(const std::vector<Candidate>& candidates,
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
  if (worth.size() > kMaxJudged) worth.resize(kMaxJudged);
  return worth;
}

// What the smaller and the larger image say for a candidate [log-odds].
struct Said {
  double smaller, larger;
};

double clearlyFor(const Candidate& candidate, const DecisionWeights& weights) {
  return std::clamp(ownLogOdds(candidate, weights), -kClear, kClear);
}

// Whether the larger image says no less for the best candidates. One that is blurred, or was enlarged, says
// less: its edges are fainter and lie farther off, in its pixels.
bool largerSaysNoLess(std::vector<Said> said) {
  const auto best = [](const Said& s) { return std::max(s.smaller, s.larger); };
  said.erase(std::remove_if(said.begin(), said.end(), [&](const Said& s) { return best(s) < kLikely; }),
             said.end());
  std::stable_sort(said.begin(), said.end(), [&](const Said& a, const Said& b) { return best(a) > best(b); });
  if (said.size() > kCompared) said.resize(kCompared);

  double gain = 0;
  for (const Said& s : said) gain += s.larger - s.smaller;
  return gain >= 0;
}

// Whether the likely candidates show less than a larger image would: their mean size, by their probability.
bool unresolved(const SearchTask& task, const std::vector<Candidate>& candidates,
                const std::vector<Explanation>& chosen) {
  double logs = 0, weights = 0;
  for (const Explanation& explanation : chosen) {
    const Candidate& candidate = candidates[size_t(explanation.candidate)];
    const ObjectModel& model = task.models[size_t(candidate.object)].model();
    const double distance = (candidate.pose.camera_from_object * model.centre()).norm();
    const double size = model.diameter * focalLength(task.image.camera) / distance;
    logs += candidate.probability * std::log(size);
    weights += candidate.probability;
  }
  return weights > 0 && logs / weights < std::log(kResolvedDiameter);
}

// The models whose parts the task's image may show smaller than `size` [px].
std::vector<int> maySeemSmaller(const SearchTask& task, double size) {
  std::vector<int> small;
  for (int object : task.wanted) {
    const double diameter = task.models[size_t(object)].model().diameter;
    if (diameter * focalLength(task.image.camera) / task.options.max_distance < size) small.push_back(object);
  }
  return small;
}

// One level finer, or nothing when it says less.
struct Descent {
  const SearchTask& task;  // of the smaller image
  const std::vector<Candidate>& candidates;
  const std::vector<Explanation>& chosen;
  const std::vector<int>& small;  // models that are searched for again
  const SearchLevel& search;

  std::optional<ImageLevel> into(SearchImage larger, StageLog* log) const {
    ImageLevel level;
    level.image = std::move(larger);
    const double scale = double(level.image.camera.width) / task.image.camera.width;
    std::vector<Said> said;
    const SearchTask again = task.in(level.image);
    level.candidates = log->timed(
        "larger image", [&](StageReport* report) { return judgedAgain(again, scale, &said, report); });

    if (!small.empty()) {
      SearchTask searching = again.forModels(small);
      searching.largest_size = kSmall * scale * task.options.min_size;
      const size_t known = level.candidates.size();
      level.candidates = search(searching, std::move(level.candidates));
      for (size_t i = known; i < level.candidates.size(); ++i)
        said.push_back({-kClear, clearlyFor(level.candidates[i], task.options.decision)});
    }
    if (!largerSaysNoLess(std::move(said))) return std::nullopt;
    return level;
  }

 private:
  std::vector<Candidate> judgedAgain(const SearchTask& again, double scale, std::vector<Said>* said,
                                     StageReport* report) const {
    const std::vector<int> worth = worthAnotherLook(candidates, chosen);
    std::vector<Start> starts;
    for (int index : worth) {
      const Candidate& small = candidates[size_t(index)];
      starts.push_back({small.object, small.pose.camera_from_object, small.kind});
    }
    WorkBudget no_limit;
    std::vector<Judged> judged = judgeStarts(again, starts, {1.5 * scale, scale, 1.5}, {}, 0, &no_limit);

    const DecisionWeights& weights = task.options.decision;
    for (size_t i = 0; i < judged.size(); ++i) {
      if (!judged[i].aligned) continue;
      const std::optional<Candidate>& larger = judged[i].candidate;
      said->push_back({clearlyFor(candidates[size_t(worth[i])], weights),
                       larger ? clearlyFor(*larger, weights) : -kClear});
    }
    return borneOut(std::move(judged), report);
  }
};

}  // namespace

std::optional<ImageLevel> lookFiner(const SearchTask& task, const ModelBase& base,
                                    const std::vector<Candidate>& candidates, const cv::Mat& grey,
                                    const Camera& camera, const SearchLevel& search, StageLog* log) {
  std::optional<ImageLevel> finest;
  const int first = searchReduction(camera.width, task.options.search_width) / 2;
  for (int reduction = first; reduction >= 1; reduction /= 2) {
    const SearchTask from = task.in(finest ? finest->image : task.image);
    const std::vector<Candidate>& known = finest ? finest->candidates : candidates;
    const std::vector<Explanation> chosen = chooseExplanations(known);
    const std::vector<int> small = search ? maySeemSmaller(from, task.options.min_size) : std::vector<int>();
    if (small.empty() && !unresolved(from, known, chosen)) break;

    SearchImage larger = lookAtImage(grey, camera, reduction, base, task.options, log);
    std::optional<ImageLevel> next = Descent{from, known, chosen, small, search}.into(std::move(larger), log);
    if (!next) break;
    finest = std::move(next);
  }
  return finest;
}

}  // namespace monocular_eye_hand
