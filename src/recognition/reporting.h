#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"
#include "recognition/candidate.h"
#include "recognition/decision.h"
#include "recognition/fine_pose.h"
#include "recognition/search_task.h"
#include "recognition/verdict.h"

namespace monocular_eye_hand {

/// What search and decision came to: all that is reported, nothing of which reporting changes.
struct SearchOutcome {
  std::vector<Candidate> candidates;
  std::vector<Explanation> chosen;
  std::vector<Verdict> verdicts;  ///< one per explanation
  std::vector<FinePose> poses;    ///< one per explanation
};

/// The explanations as accepted, ambiguous and rejected objects, the likeliest first. `scale`: of the full
/// image over the search image.
RecognitionResult reportObjects(const SearchTask& task, const SearchOutcome& outcome, double scale);

/// All candidates, and why they won or lost: RecognitionResult::judged.
std::vector<JudgedCandidate> listJudged(const SearchTask& task, const SearchOutcome& outcome);

/// For people: why there is no object in the result, which must say what the limits cut.
std::string whyNothing(const SearchTask& task, const SearchOutcome& outcome, const RecognitionResult& result);

/// For people: "", "2 equal poses", "free about the axis (0, 0, 1) through (0, 0, 0) m".
std::string describeSymmetry(const Symmetries& symmetries);

}  // namespace monocular_eye_hand
