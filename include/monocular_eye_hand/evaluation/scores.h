#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/results.h"

namespace monocular_eye_hand {

/// What a user of the node sees, per scene.
struct SceneSummary {
  int scene = 0;
  int wanted = 0;  ///< ground-truth instances with visib_fract >= 0.5
  int found = 0;   ///< ... matched one-to-one (smallest error first) by a row with MSPD < 10 px
  int rows = 0;
  int right = 0;  ///< rows within 10 px MSPD of some instance of their object
  double ar =
      0;  ///< mean over instances with visib_fract >= 0.1 of the recalls over all thresholds, same matching
  double median_time = 0;  ///< seconds per image; NaN when no image has a time

  double foundShare() const { return wanted > 0 ? double(found) / wanted : 0; }
  double rightShare() const { return rows > 0 ? double(right) / rows : 0; }
};

/// Seconds of the split's images that have a time: of `times`, else of their rows.
ImageTimes timesOfImages(const BopSplit& split, const std::vector<BopResult>& results,
                         const ImageTimes& times);

/// The summaries of the split's scenes, ascending. Continuous symmetries are taken in steps of 0.05; rows
/// farther than two diameters from an instance do not match it. Throws BadInput on a result of an object that
/// is not known.
std::vector<SceneSummary> summarize(const BopSplit& split, const BopModels& models,
                                    const std::vector<BopResult>& results, const ImageTimes& times);
/// "scene 1: found 0.942 (49/52) right 0.980 (49/50) AR 0.938 median 0.940 s"
std::string summaryLine(const SceneSummary& summary);
/// "found/right/AR/time 1: 0.94/0.98/0.94/0.94s | 2: ..."
std::string summaryFigure(const std::vector<SceneSummary>& summaries);

/// BOP's scores, of MSSD and MSPD (VSD needs depth images). NaN where there is nothing to score.
struct BopScores {
  int images = 0, targets = 0, estimates = 0;
  double ar_mssd = 0, ar_mspd = 0;  ///< 6D localization (BOP'19): mean recall over the thresholds
  double ar() const { return (ar_mssd + ar_mspd) / 2; }
  double map_mssd = 0, map_mspd = 0;                ///< 6D detection (BOP'24)
  double map_mssd_strict = 0, map_mspd_strict = 0;  ///< objects absent from an image count as false positives
  double map() const { return (map_mssd + map_mspd) / 2; }
  double mapStrict() const { return (map_mssd_strict + map_mspd_strict) / 2; }
};

/// 6D localization: the `count` best-scored estimates against the `count` most visible instances of every
/// target; 6D detection: the 100 best estimates of each image, instances visible by less than 10 % and
/// estimates that match them left out, precision interpolated at 101 points. Matching is greedy by score,
/// errors strictly below the threshold. `targets` empty: visibleTargets(split), and every image of the split
/// that has results.
BopScores scoreBop(const BopSplit& split, const BopModels& models, const std::vector<BopResult>& results,
                   const std::vector<BopTarget>& targets = {});

}  // namespace monocular_eye_hand
