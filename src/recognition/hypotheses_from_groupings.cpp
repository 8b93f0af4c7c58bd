#include <algorithm>
#include <array>
#include <cmath>

#include "recognition/focal_length.h"
#include "recognition/hypotheses.h"
#include "recognition/pair_poses.h"
#include "recognition/shared_work.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxPerKind = 100;  // best image groupings tried per kind
constexpr double kOffAxis = 1.5;  // so much larger a part may look at the border than in the middle

struct RankedGrouping {
  const Grouping* seen = nullptr;
  double rank = 0;
};

/// How many ways there are to lay the grouping over the model.
int correspondenceCount(const Grouping& seen, const SearchModel& model) {
  int ways = 0;
  for (const ModelGrouping& known : model.groupings())
    if (known.points.size() == seen.points.size()) ways += int(correspondences(seen, known).size());
  return ways;
}

/// Whether its points lie nearer to each other than `limit` [px].
bool isWithin(double limit, const Grouping& seen) {
  for (const Eigen::Vector2d& p : seen.points)
    for (const Eigen::Vector2d& q : seen.points)
      if ((p - q).squaredNorm() > limit * limit) return false;
  return true;
}

/// The image groupings that can come from the object, the most telling first: likely structure of one object
/// (weight) that fits the model in few ways (rarity).
std::vector<RankedGrouping> rankGroupings(const SearchImage& image, int object, const SearchModel& model,
                                          const DistanceRange& range) {
  const double focal = focalLength(image.camera);
  const double largest = kOffAxis * focal * model.model().diameter / range.nearest;
  std::vector<RankedGrouping> ranked;
  std::array<int, kGroupingKinds> tried{};
  for (const Grouping& seen : image.groupings) {  // best first within a kind
    if (!fixesPose(seen) || !isWithin(largest, seen)) continue;
    if (std::find(seen.candidates.begin(), seen.candidates.end(), object) == seen.candidates.end()) continue;
    const int ways = correspondenceCount(seen, model);
    if (ways == 0 || ++tried[size_t(seen.kind)] > kMaxPerKind) continue;
    ranked.push_back({&seen, seen.weight / ways});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const RankedGrouping& a, const RankedGrouping& b) { return a.rank > b.rank; });
  return ranked;
}

// The poses that lay the grouping over those of the model, and from which the camera sees that one.
void offerGrouping(const SearchImage& image, const RankedGrouping& ranked, const SearchModel& model,
                   const DistanceRange& range, HypothesisPool* pool, WorkBudget* budget) {
  const Grouping& seen = *ranked.seen;
  std::vector<Rigid3> poses;
  for (size_t k = 0; k < model.groupings().size(); ++k) {
    const ModelGrouping& known = model.groupings()[k];
    if (known.points.size() != seen.points.size()) continue;
    for (const Correspondence& order : correspondences(seen, known)) {
      if (budget->spent()) return;
      poses.clear();
      posesOfPair(image, model.model(), range, {seen, known, order}, &poses);
      for (const Rigid3& pose : poses)
        if (model.shows(k, pose)) pool->offer(pose, seen.kind, image.map, budget);
    }
  }
}

}  // namespace

void hypothesesFromGroupings(const SearchTask& task, int object, HypothesisPool* pool, WorkBudget* budget) {
  const SearchImage& image = task.image;
  const SearchModel& model = task.models[size_t(object)];
  const DistanceRange range = searchedDistances(task, model.model());
  const std::vector<RankedGrouping> ranked = rankGroupings(image, object, model, range);
  gather(pool, budget, [&](const WorkShare& share, WorkBudget* part, HypothesisPool* best) {
    for (size_t i = size_t(share.first); i < ranked.size(); i += size_t(share.step))
      offerGrouping(image, ranked[i], model, range, best, part);
  });
}

}  // namespace monocular_eye_hand
