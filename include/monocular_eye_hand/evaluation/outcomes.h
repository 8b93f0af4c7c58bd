#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/error_meter.h"
#include "monocular_eye_hand/evaluation/results.h"

namespace monocular_eye_hand {

constexpr double kRightError = 10;       ///< a pose is right when its MSPD is below this [px]
constexpr double kWantedVisible = 0.5;   ///< an instance this visible is wanted (`found`)
constexpr double kCountedVisible = 0.1;  ///< ... counts in AR
constexpr PoseErrors kNoMatch{std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};

/// What became of a true instance.
struct TruthOutcome {
  int scene = 0, image = 0;
  int index = 0;   ///< BopImage::truth
  int object = 0;  ///< BopModel::id
  Rigid3 camera_from_object;
  double visible = 1;              ///< share of its silhouette
  double distance = 0;             ///< from the camera to the middle of its bounding box [m]
  double size = 0;                 ///< image of its diameter at that distance [px of the data set]
  Eigen::Vector3d towards_camera;  ///< from that middle; unit, object frame
  int row = -1;                    ///< the result matched to it, smallest MSPD first; -1: none
  PoseErrors errors = kNoMatch;    ///< of that result

  bool wanted() const { return visible >= kWantedVisible; }
  bool counted() const { return visible >= kCountedVisible; }
  bool found() const { return errors.mspd < kRightError; }
  /// Mean of BOP's recalls over all thresholds of MSSD and MSPD.
  double recall() const;
};

/// What a row of the results is.
struct RowOutcome {
  int row = 0;  ///< in the results
  int scene = 0, image = 0, object = 0;
  double score = 0;
  Rigid3 camera_from_object;
  int nearest = -1;              ///< BopImage::truth: of its object, within two diameters; -1: none
  PoseErrors errors = kNoMatch;  ///< to that

  bool right() const { return errors.mspd < kRightError; }
};

struct RunOutcomes {
  std::vector<TruthOutcome> truths;  ///< all of the split, in its order
  std::vector<RowOutcome> rows;      ///< image by image in the split's order, best score first
};

/// Matches results and truth one-to-one, image by image, the smallest MSPD first; rows farther than two
/// diameters from an instance do not match it. Continuous symmetries are taken in steps of 0.05. Results of
/// images that are not in the split are left out. Throws BadInput on an object that is not known.
RunOutcomes judgeRun(const BopSplit& split, const BopModels& models, const std::vector<BopResult>& results);

/// A pose that recognition judged, in the terms of the data set.
struct JudgedPose {
  enum Fate {
    kReported,    ///< accepted or ambiguous
    kRejected,    ///< too improbable
    kSuppressed,  ///< another one explains the same part of the image better
  };
  int scene = 0, image = 0, object = 0;
  Rigid3 camera_from_object;
  double probability = 0;
  Fate fate = kRejected;
  int suppressed_by = -1;  ///< index in the list of all poses; -1: not suppressed, or not known
  std::string against;     ///< for people: what spoke against it, or which better explanation suppressed it
  std::string strongest_against;  ///< the term most against it, without its value; "": none is, or not known
  std::map<std::string, double> evidence;  ///< terms of the decision by name

  // Filled by measure():
  int nearest = -1;              ///< BopImage::truth of its object with the smallest MSPD; -1: none
  double visible = 0;            ///< how much of that is seen
  PoseErrors errors = kNoMatch;  ///< to that
  bool right() const { return errors.mspd < kRightError; }
};

/// The poses with their distance from the truth.
std::vector<JudgedPose> measured(std::vector<JudgedPose> poses, const BopSplit& split,
                                 const BopModels& models);

}  // namespace monocular_eye_hand
