#include "monocular_eye_hand/recognition/recognizer.h"

#include <fmt/format.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <iterator>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"
#include "recognition/best_four_poses.h"
#include "recognition/fine_pose.h"
#include "recognition/finer_levels.h"
#include "recognition/first_look.h"
#include "recognition/judging.h"
#include "recognition/nearby_poses.h"
#include "recognition/object_search.h"
#include "recognition/occlusion.h"
#include "recognition/reporting.h"
#include "recognition/search_trace.h"
#include "recognition/settle_contests.h"
#include "recognition/shared_work.h"
#include "recognition/support.h"
#include "recognition/twins.h"

namespace monocular_eye_hand {
namespace {

using tbb::task_arena;

// Indices of the objects to look for; `only`: name of the one wanted, "" for all.
std::vector<int> wantedObjects(const ModelBase& base, const std::string& only) {
  if (!only.empty()) {
    const int object = base.indexOf(only);
    if (object < 0) throw BadInput("unknown object '" + only + "'; known: " + base.names());
    return {object};
  }
  std::vector<int> all(base.objects.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void checkImage(const cv::Mat& grey, const Camera& camera) {
  if (grey.empty()) throw BadInput("the image is empty");
  if (grey.type() != CV_8UC1) throw BadInput("the image must be 8-bit grey (CV_8UC1)");
  if (grey.cols != camera.width || grey.rows != camera.height)
    throw BadInput(fmt::format("the image is {} x {} but the camera is calibrated for {} x {}", grey.cols,
                               grey.rows, camera.width, camera.height));
}

bool anyAccepted(const std::vector<Candidate>& candidates, const RecognitionOptions& options) {
  const std::vector<Standing> all = standings(candidates, options.decision);
  return std::any_of(all.begin(), all.end(), [&](const Standing& standing) {
    return standing.probability >= options.accept_probability;
  });
}

int threadsOf(const RecognitionOptions& options) {
  return options.threads > 0 ? options.threads : std::max(1, int(std::thread::hardware_concurrency()) - 1);
}

// Wong et al., 2.2, steps 2 to 6. `one_is_enough`: the search ends with the first accepted candidate.
std::vector<Candidate> search(const SearchTask& all, std::vector<Candidate> known, bool one_is_enough,
                              WorkBudget* budget, StageLog* log) {
  FirstLook first = lookFirst(all, budget, log);
  const SearchTask task = all.forModels(first.promising);
  std::move(first.candidates.begin(), first.candidates.end(), std::back_inserter(known));

  // Steps 2 to 5: an unmatched pair makes a hypothesis, its characteristic view is laid on the image,
  // evaluated, and verified; what the image bears out is recorded as a candidate.
  SearchState found = searchGroupings(task, std::move(known), budget, log);
  if (one_is_enough && anyAccepted(found.candidates, task.options)) return std::move(found.candidates);

  // Step 6: again from step 2, with single edges, until all groupings have been used; the search for one
  // object ends when it has a plausible and reliable match.
  const std::vector<Explanation> chosen = chooseExplanations(found.candidates);
  return searchEdges(task, std::move(found), chosen, budget, log).candidates;
}

SearchOutcome decided(const SearchTask& task, Explained all, const cv::Mat& grey, const Camera& camera,
                      const std::vector<ObjectEstimate>& previous, StageLog* log) {
  SearchOutcome outcome;
  outcome.candidates = std::move(all.candidates);
  outcome.chosen = std::move(all.chosen);
  outcome.verdicts = decide(task, outcome.candidates, outcome.chosen, log);
  outcome.poses =
      keepEqualPoses(task, outcome.candidates, outcome.chosen,
                     refineChosen(task, outcome.candidates, outcome.chosen, grey, camera, log), previous);
  return outcome;
}

}  // namespace

struct Recognizer::Impl {
  ModelBase base;
  RecognitionOptions options;
  std::vector<SearchModel> models;
  std::once_flag rests_known;
  std::vector<std::vector<Eigen::Vector3d>> up_at_rest;  // made when a support plane is first given

  Impl(ModelBase models_known, RecognitionOptions options_given)
      : base(std::move(models_known)), options(std::move(options_given)) {
    std::vector<std::optional<SearchModel>> made(base.objects.size());
    task_arena arena(threadsOf(options));
    arena.execute(
        [&] { atOnce(int(made.size()), [&](int i) { made[size_t(i)].emplace(base.objects[size_t(i)]); }); });
    for (std::optional<SearchModel>& model : made) models.push_back(std::move(*model));
  }

  RecognitionResult recognize(const cv::Mat& grey, const Camera& camera, const RecognitionRequest& request);

  std::optional<Support> supportOf(const RecognitionRequest& request) {
    if (!request.support) return std::nullopt;
    request.support->check();
    std::call_once(rests_known, [this] {
      for (const SearchModel& model : models) up_at_rest.push_back(directionsUpAtRest(model.model()));
    });
    return Support{*request.support, up_at_rest, options.rest_log_odds};
  }
};

Recognizer::Recognizer(ModelBase models, RecognitionOptions options) {
  options.check();
  if (models.objects.empty()) throw BadInput("the model base is empty: name at least one object");
  impl_ = std::make_unique<Impl>(std::move(models), std::move(options));
}

Recognizer::~Recognizer() = default;
const ModelBase& Recognizer::models() const { return impl_->base; }
const RecognitionOptions& Recognizer::options() const { return impl_->options; }

RecognitionResult Recognizer::recognize(const cv::Mat& grey, const Camera& camera,
                                        const RecognitionRequest& request) const {
  // A trace listens to one thread only.
  task_arena arena(request.traced.empty() ? threadsOf(impl_->options) : 1);
  return arena.execute([&] { return impl_->recognize(grey, camera, request); });
}

RecognitionResult Recognizer::Impl::recognize(const cv::Mat& grey, const Camera& camera,
                                              const RecognitionRequest& request) {
  camera.check();
  const std::vector<int> wanted = wantedObjects(base, request.only);
  RecognitionOptions asked = options;
  asked.decision = amongModels(std::move(asked.decision), int(wanted.size()));
  checkImage(grey, camera);
  WorkBudget budget(options.budget, options.time_limit);
  StageLog log;

  // The steps of Wong et al., 2.2. Step 1: groupings of the image; those of the models are at hand, and the
  // pairs of both are the branches of the search tree.
  const int reduction = searchReduction(camera.width, options.search_width);
  SearchImage image = lookAtImage(grey, camera, reduction, base, options, &log);
  std::optional<SearchTrace> trace;
  if (!request.traced.empty() && !request.proposals)
    trace.emplace(image, models, request.traced, double(camera.width) / image.camera.width);
  const std::optional<Support> support = supportOf(request);
  const Support* known_support = support ? &*support : nullptr;
  const SearchTask searching{image, models, wanted, asked, trace ? &*trace : nullptr, known_support};

  // Steps 2 to 6, or the poses that are given instead.
  const bool one_is_enough = !request.only.empty();
  const SearchLevel search_level = [&](const SearchTask& level, std::vector<Candidate> known) {
    return search(level, std::move(known), one_is_enough, &budget, &log);
  };
  std::vector<Candidate> candidates =
      request.proposals ? judgeProposals(searching, *request.proposals, &log) : search_level(searching, {});

  // What follows sees the image at the size that resolves the contours best, where parts that the smaller one
  // may have shown too small are searched for, too.
  const bool done = request.proposals || (one_is_enough && anyAccepted(candidates, asked));
  std::optional<ImageLevel> finer =
      lookFiner(searching, base, candidates, grey, camera, done ? SearchLevel() : search_level, &log);
  if (finer) candidates = std::move(finer->candidates);
  const SearchTask task = searching.in(finer ? finer->image : image);

  // What may lie a little better, what is easily taken for one another, and what hides behind another.
  candidates = tryNearbyPoses(task, std::move(candidates), &log);
  candidates = addTwins(task, explained(std::move(candidates)), &log);
  candidates = excuseHidden(task, explained(std::move(candidates)), &log);

  // 2.4: the pose is calculated again from the best four, and fine-tuned by all features that are redundant.
  candidates = recalculateBestFour(task, explained(std::move(candidates)), &log);

  // What is right stands out among the other poses of its object; of poses that are nearly alike, what they
  // draw differently tells.
  candidates = weighAmongOthers(std::move(candidates), asked.decision);
  candidates = settleContests(task, explained(std::move(candidates)), &log);
  const SearchOutcome outcome =
      decided(task, explained(std::move(candidates)), grey, camera, request.previous, &log);

  // Step 7: output.
  RecognitionResult result = reportObjects(task, outcome, double(camera.width) / task.image.camera.width);
  if (request.judged) result.judged = listJudged(task, outcome);
  if (trace) result.traces = trace->traces();
  result.truncated = budget.cutByTime();
  result.budget_spent = budget.cutByWork();
  if (result.objects.empty()) result.reason = whyNothing(task, outcome, result);
  result.stages = log.stages();
  result.features = std::move(image.features);
  result.groupings = std::move(image.groupings);
  return result;
}

}  // namespace monocular_eye_hand
