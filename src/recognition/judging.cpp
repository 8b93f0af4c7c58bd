#include "recognition/judging.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"
#include "recognition/alignment.h"
#include "recognition/decision.h"
#include "recognition/search_trace.h"
#include "recognition/support.h"
#include "recognition/verification.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSamePose = 4.0;                     // poses this near in the image are one [px]
constexpr double kSameStart = 2.0;                    // a start this near to a candidate leads there [px]
constexpr double kSameEnd = 1.5;                      // an aligned pose this near to a candidate is it [px]
const std::vector<double> kProposalRanges{2.5, 1.5};  // a proposed pose is taken to be near its edges [px]
constexpr double kMinEvidence = 6.0;  // of an aligned pose, else it is not looked at further [nats]

struct AlignedHypothesis {
  Hypothesis hypothesis;
  Eigen::Vector2d centre;  // of the object, in the image [uv_rect px]
};

// Moved onto the edges, the most telling first.
std::vector<AlignedHypothesis> alignHypotheses(const SearchTask& task, const SearchModel& model,
                                               const std::vector<Hypothesis>& hypotheses,
                                               WorkBudget* budget) {
  const SearchImage& image = task.image;
  std::vector<AlignedHypothesis> aligned;
  for (Hypothesis h : hypotheses) {
    if (budget->outOfTime()) break;
    const std::optional<ViewedPose> moved = alignCoarsely(model, image, {h.camera_from_object, h.view});
    if (!moved) continue;

    const auto& [pose, view] = *moved;
    const CoarseScore score = scorePose(model, view, pose, image.camera, image.map);
    if (score.evidence < float(kMinEvidence) || score.in_frame < task.options.min_in_frame) continue;
    h.camera_from_object = pose;
    h.view = view;
    h.evidence = score.evidence;
    aligned.push_back({h, image.camera.project(pose * model.model().centre())});
  }
  std::stable_sort(aligned.begin(), aligned.end(), [](const auto& a, const auto& b) {
    return a.hypothesis.evidence > b.hypothesis.evidence;
  });
  return aligned;
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

bool isKnown(const SearchTask& task, int object, const Rigid3& camera_from_object,
             const std::vector<Candidate>& known, double distance) {
  return std::any_of(known.begin(), known.end(), [&](const Candidate& candidate) {
    return candidate.object == object &&
           task.models[object].poseDistance(task.image.camera, candidate.pose.camera_from_object,
                                            camera_from_object) < distance;
  });
}

}  // namespace

std::optional<Candidate> alignedCandidate(const SearchTask& task, int object, const Rigid3& start,
                                          const std::vector<double>& ranges,
                                          const std::vector<Candidate>& known) {
  const SearchModel& model = task.models[object];
  Candidate candidate;
  candidate.object = object;
  candidate.pose = alignFinely(model, task.image, start, ranges, kFineStep);
  if (!candidate.pose.well_posed) return std::nullopt;

  candidate.pose.camera_from_object = model.canonical(candidate.pose.camera_from_object, &candidate.view);
  const Rigid3& pose = candidate.pose.camera_from_object;
  const double distance = (pose * model.model().centre()).norm();
  if (distance < task.options.nearest(model.model().diameter) || distance > task.options.max_distance)
    return std::nullopt;
  if (!model.seenFromOutside(pose) || isKnown(task, object, pose, known, kSameEnd)) return std::nullopt;
  return candidate;
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
                                       std::vector<Candidate> known, WorkBudget* budget, StageLog* log) {
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

  log->timed("verification", [&](StageReport* report) {
    for (const AlignedHypothesis& a : distinctPoses(task, model, aligned)) {
      if (isKnown(task, object, a.hypothesis.camera_from_object, known, kSameStart)) continue;
      if (budget->outOfTime()) break;
      std::optional<Candidate> candidate =
          alignedCandidate(task, object, a.hypothesis.camera_from_object, kFineRanges, known);
      report->counts["verified"] += candidate.has_value();
      if (!candidate) continue;

      note(task, SearchStage::kVerified, object, candidate->pose.camera_from_object);
      candidate->kind = a.hypothesis.kind;
      if (!bearsOut(task, &*candidate)) continue;
      note(task, SearchStage::kRecorded, object, candidate->pose.camera_from_object);
      known.push_back(std::move(*candidate));
    }
  });
  return known;
}

std::vector<Candidate> judgeProposals(const SearchTask& task, const std::vector<PoseProposal>& proposals,
                                      StageLog* log) {
  return log->timed("verification", [&](StageReport* report) {
    std::vector<Candidate> candidates;
    for (const PoseProposal& proposal : proposals) {
      if (proposal.object < 0 || proposal.object >= int(task.models.size()))
        throw BadInput("a pose is proposed for object " + std::to_string(proposal.object) +
                       ", the model base has " + std::to_string(task.models.size()));
      std::optional<Candidate> candidate =
          alignedCandidate(task, proposal.object, proposal.camera_from_object, kProposalRanges, candidates);
      report->counts["verified"] += candidate.has_value();
      if (candidate && bearsOut(task, &*candidate)) candidates.push_back(std::move(*candidate));
    }
    return candidates;
  });
}

}  // namespace monocular_eye_hand
