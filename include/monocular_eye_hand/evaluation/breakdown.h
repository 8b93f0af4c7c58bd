#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/outcomes.h"
#include "monocular_eye_hand/evaluation/statistics.h"

namespace monocular_eye_hand {

/// What was found and what was right in a part of a run: a scene, an object, everything.
struct GroupScore {
  std::string name;
  int images = 0;
  Share found;             ///< of the wanted instances
  Share right;             ///< of the rows
  int counted = 0;         ///< instances that AR is a mean of
  double ar = 0;           ///< NaN without any
  double median_time = 0;  ///< [s] of its images; NaN when none has a time
  int wrong() const { return right.whole - right.part; }
};

/// One per scene of the split, ascending: "scene 3".
std::vector<GroupScore> scoresByScene(const BopSplit& split, const RunOutcomes& run, const ImageTimes& times);
/// One per model, in the order of their ids; its images are those that show it.
std::vector<GroupScore> scoresByPart(const BopSplit& split, const BopModels& models, const RunOutcomes& run,
                                     const ImageTimes& times);
GroupScore scoreOfAll(const BopSplit& split, const RunOutcomes& run, const ImageTimes& times);

/// Instances of like conditions, and how many of them were found.
struct RecallBin {
  std::string label;  ///< "50-70", without the unit
  Share found;
};

/// By visible share [%], of all instances (wanted or not).
std::vector<RecallBin> recallByVisibility(const RunOutcomes& run);
/// By the image of the diameter [px], of the wanted instances; bins grow by half.
std::vector<RecallBin> recallBySize(const RunOutcomes& run);
/// By distance [m], of the wanted instances; at most eight bins of a round width.
std::vector<RecallBin> recallByDistance(const RunOutcomes& run);
/// By the side of the part (+x ... -z of its frame) that faces the camera most, of its wanted instances.
std::vector<RecallBin> recallBySide(const RunOutcomes& run, int object);

/// One step down the list of candidates.
struct PrecisionRecallPoint {
  double score = 0;      ///< candidates of at least this
  double precision = 0;  ///< ... that are right
  double recall = 0;     ///< wanted instances that they hit
};

/// Over the candidates that were reported or rejected, from the highest probability down; equal ones are one
/// point. Empty without a wanted instance or without candidates.
std::vector<PrecisionRecallPoint> precisionRecall(const std::vector<JudgedPose>& judged,
                                                  const RunOutcomes& run);
/// The probabilities of the candidates that were reported or rejected.
std::vector<Prediction> predictions(const std::vector<JudgedPose>& judged);

/// A wanted instance that one of two runs found.
struct ChangedObject {
  TruthOutcome a, b;
};

/// Two runs over one split.
struct RunComparison {
  struct Group {
    GroupScore a, b;
    PairedCounts found;  ///< of the wanted instances
  };
  std::vector<Group> scenes;
  Group all;
  std::vector<ChangedObject> changed;
};
/// Throws BadInput when the outcomes are not of the same split.
RunComparison compareRuns(const BopSplit& split, const RunOutcomes& a, const ImageTimes& times_a,
                          const RunOutcomes& b, const ImageTimes& times_b);

}  // namespace monocular_eye_hand
