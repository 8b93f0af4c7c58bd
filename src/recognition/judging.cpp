#include "recognition/judging.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"
#include "recognition/alignment.h"
#include "recognition/decision.h"
#include "recognition/search_trace.h"
#include "recognition/shared_work.h"
#include "recognition/support.h"
#include "recognition/verification.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSamePose = 4.0;                     // poses this near in the image are one [px]
constexpr double kSameStart = 2.0;                    // a start this near to a candidate leads there [px]
constexpr double kSameEnd = 1.5;                      // an aligned pose this near to a candidate is it [px]
const std::vector<double> kProposalRanges{2.5, 1.5};  // a proposed pose is taken to be near its edges [px]
constexpr double kCarriedOn = 0.3;    // of the hypotheses that lie near edges, so many are aligned to the end
constexpr double kMinEvidence = 6.0;  // of an aligned pose, else it is not looked at further [nats]

struct AlignedHypothesis {
  Hypothesis hypothesis;
  Eigen::Vector2d centre;  // of the object, in the image [uv_rect px]
};

// Moved onto the edges; nothing when it cannot be, or little speaks for it there.
std::optional<AlignedHypothesis> alignedHypothesis(const SearchTask& task, const SearchModel& model,
                                                   Hypothesis h, const std::vector<double>& ranges) {
  const SearchImage& image = task.image;
  const std::optional<ViewedPose> moved = alignCoarsely(model, image, {h.camera_from_object, h.view}, ranges);
  if (!moved) return std::nullopt;

  const auto& [pose, view] = *moved;
  const CoarseScore score = scorePose(model.coarse(view), pose, image.camera, image.map);
  if (score.evidence < float(kMinEvidence) || score.in_frame < task.options.min_in_frame) return std::nullopt;
  h.camera_from_object = pose;
  h.view = view;
  h.evidence = score.evidence;
  return AlignedHypothesis{h, image.camera.project(pose * model.model().centre())};
}

// The most telling first.
std::vector<AlignedHypothesis> alignedWithin(const std::vector<double>& ranges, const SearchTask& task,
                                             const SearchModel& model,
                                             const std::vector<Hypothesis>& hypotheses, WorkBudget* budget) {
  std::vector<std::optional<AlignedHypothesis>> moved(hypotheses.size());
  atOnce(int(hypotheses.size()), budget, [&](int i, WorkBudget* part) {
    if (part->outOfTime()) return;
    moved[size_t(i)] = alignedHypothesis(task, model, hypotheses[size_t(i)], ranges);
  });

  std::vector<AlignedHypothesis> aligned;
  for (const std::optional<AlignedHypothesis>& one : moved)
    if (one) aligned.push_back(*one);
  std::stable_sort(aligned.begin(), aligned.end(), [](const auto& a, const auto& b) {
    return a.hypothesis.evidence > b.hypothesis.evidence;
  });
  return aligned;
}

// What two rounds have moved tells which of them are worth the others.
std::vector<AlignedHypothesis> alignHypotheses(const SearchTask& task, const SearchModel& model,
                                               const std::vector<Hypothesis>& hypotheses,
                                               WorkBudget* budget) {
  const std::vector<AlignedHypothesis> moved = alignedWithin(kWideRanges, task, model, hypotheses, budget);
  const size_t max_count =
      std::max(size_t(task.options.verified_per_object), size_t(kCarriedOn * double(moved.size())));
  std::vector<Hypothesis> carried_on;
  for (size_t i = 0; i < std::min(max_count, moved.size()); ++i) carried_on.push_back(moved[i].hypothesis);
  return alignedWithin(kNarrowRanges, task, model, carried_on, budget);
}

// The first of those that came to the same pose.
std::vector<AlignedHypothesis> distinctPoses(const SearchTask& task, const SearchModel& model,
                                             const std::vector<AlignedHypothesis>& aligned) {
  std::vector<AlignedHypothesis> kept;
  for (const AlignedHypothesis& a : aligned) {
    if (int(kept.size()) >= task.options.verified_per_object) break;
    const auto same = [&](const AlignedHypothesis& k) {
      return (k.centre - a.centre).norm() < 2 * kSamePose &&
             model.poseDistance(task.image.camera, k.hypothesis.camera_from_object,
                                a.hypothesis.camera_from_object) < kSamePose;
    };
    if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(a);
  }
  return kept;
}

// The candidates that a start may lead to: those known before, and those from starts before it.
class Known {
 public:
  Known(const SearchTask& task, const std::vector<Candidate>& before, const std::vector<Judged>& judged)
      : task_(task), before_(before), judged_(judged) {}

  // Whether the pose is nearer to one of them than so many pixels.
  bool contains(int object, const Rigid3& pose, double distance) const {
    const auto same = [&](const Candidate& candidate) {
      return candidate.object == object &&
             task_.models[size_t(object)].poseDistance(task_.image.camera, candidate.pose.camera_from_object,
                                                       pose) < distance;
    };
    return std::any_of(before_.begin(), before_.end(), same) ||
           std::any_of(judged_.begin(), judged_.end(),
                       [&](const Judged& j) { return j.candidate && same(*j.candidate); });
  }

 private:
  const SearchTask& task_;
  const std::vector<Candidate>& before_;
  const std::vector<Judged>& judged_;
};

// The start moved onto the edges; nothing when it cannot be, or is not admissible there.
std::optional<Candidate> alignedCandidate(const SearchTask& task, const Start& start,
                                          const std::vector<double>& ranges) {
  const SearchModel& model = task.models[size_t(start.object)];
  Candidate candidate;
  candidate.object = start.object;
  candidate.kind = start.kind;
  candidate.pose = alignFinely(model, task.image, start.camera_from_object, ranges, kFineStep);
  if (!candidate.pose.well_posed) return std::nullopt;

  candidate.pose.camera_from_object = model.canonical(candidate.pose.camera_from_object, &candidate.view);
  const Rigid3& pose = candidate.pose.camera_from_object;
  const double distance = (pose * model.model().centre()).norm();
  if (distance < task.options.nearest(model.model().diameter) || distance > task.options.max_distance)
    return std::nullopt;
  if (!model.seenFromOutside(pose)) return std::nullopt;
  return candidate;
}

}  // namespace

std::vector<Judged> judgeStarts(const SearchTask& task, const std::vector<Start>& starts,
                                const std::vector<double>& ranges, const std::vector<Candidate>& known,
                                double same_start, WorkBudget* budget) {
  std::vector<Judged> judged;
  const Known so_far(task, known, judged);
  const auto begun = [&](const Start& start) {
    return so_far.contains(start.object, start.camera_from_object, same_start);
  };
  const auto ended = [&](const Candidate& candidate) {
    return so_far.contains(candidate.object, candidate.pose.camera_from_object, kSameEnd);
  };

  // As many at once as there are threads, on what is known before them; then in their order, on all.
  const size_t max_count = size_t(threadsHere());
  while (judged.size() < starts.size()) {
    const size_t first = judged.size();
    const int count = int(std::min(max_count, starts.size() - first));
    std::vector<std::optional<Candidate>> aligned(size_t(count), std::nullopt);
    std::vector<char> borne_out(size_t(count), 0);
    atOnce(count, budget, [&](int i, WorkBudget* part) {
      const Start& start = starts[first + size_t(i)];
      std::optional<Candidate>& candidate = aligned[size_t(i)];
      if (begun(start) || part->outOfTime()) return;
      candidate = alignedCandidate(task, start, ranges);
      if (candidate && ended(*candidate)) candidate.reset();
      if (candidate) borne_out[size_t(i)] = bearsOut(task, &*candidate);
    });

    for (int i = 0; i < count; ++i) {
      std::optional<Candidate>& candidate = aligned[size_t(i)];
      if (candidate && (begun(starts[first + size_t(i)]) || ended(*candidate))) candidate.reset();
      judged.push_back({candidate.has_value(), std::nullopt});
      if (!candidate) continue;
      note(task, SearchStage::kVerified, candidate->object, candidate->pose.camera_from_object);
      if (!borne_out[size_t(i)]) continue;
      note(task, SearchStage::kRecorded, candidate->object, candidate->pose.camera_from_object);
      judged.back().candidate = std::move(candidate);
    }
  }
  return judged;
}

void weighAlone(const SearchTask& task, Candidate* candidate) {
  const SearchModel& model = task.models[candidate->object];
  if (task.support)
    candidate->support = evidenceOfSupport(*task.support, candidate->object, model.model(), candidate->pose);
  candidate->probability = ownProbability(*candidate, task.options.decision);
}

bool bearsOut(const SearchTask& task, Candidate* candidate) {
  const SearchModel& model = task.models[candidate->object];
  drawContour(model, task.image, candidate);
  const EvidenceTerms& terms = candidate->terms;
  if (terms.in_frame < task.options.min_in_frame || terms.sum < kMinEvidence) return false;

  weighDrawing(model, task.image, candidate);
  weighAlone(task, candidate);
  return true;
}

std::vector<Candidate> judgeHypotheses(const SearchTask& task, int object, HypothesisPool* pool, int count,
                                       const std::vector<Candidate>& known, WorkBudget* budget,
                                       StageLog* log) {
  const SearchModel& model = task.models[object];
  const std::vector<AlignedHypothesis> aligned = log->timed("coarse alignment", [&](StageReport* report) {
    const std::vector<Hypothesis> hypotheses = pool->take(count);
    for (const Hypothesis& h : hypotheses) note(task, SearchStage::kTaken, object, h.camera_from_object);

    std::vector<AlignedHypothesis> moved = alignHypotheses(task, model, hypotheses, budget);
    for (const AlignedHypothesis& a : moved)
      note(task, SearchStage::kAligned, object, a.hypothesis.camera_from_object);
    report->counts = {{"hypotheses", double(hypotheses.size())}, {"aligned", double(moved.size())}};
    return moved;
  });

  return log->timed("verification", [&](StageReport* report) {
    std::vector<Start> starts;
    for (const AlignedHypothesis& a : distinctPoses(task, model, aligned))
      starts.push_back({object, a.hypothesis.camera_from_object, a.hypothesis.kind});
    return borneOut(judgeStarts(task, starts, kFineRanges, known, kSameStart, budget), report);
  });
}

std::vector<Candidate> judgeProposals(const SearchTask& task, const std::vector<PoseProposal>& proposals,
                                      StageLog* log) {
  return log->timed("verification", [&](StageReport* report) {
    std::vector<Start> starts;
    for (const PoseProposal& proposal : proposals) {
      if (proposal.object < 0 || proposal.object >= int(task.models.size()))
        throw BadInput(fmt::format("a pose is proposed for object {}, the model base has {}", proposal.object,
                                   task.models.size()));
      starts.push_back({proposal.object, proposal.camera_from_object});
    }
    WorkBudget no_limit;
    return borneOut(judgeStarts(task, starts, kProposalRanges, {}, 0, &no_limit), report);
  });
}

std::vector<Candidate> borneOut(std::vector<Judged> judged, StageReport* report) {
  std::vector<Candidate> candidates;
  for (Judged& one : judged) {
    report->counts["verified"] += one.aligned;
    if (one.candidate) candidates.push_back(std::move(*one.candidate));
  }
  return candidates;
}

}  // namespace monocular_eye_hand
