#include "monocular_eye_hand/evaluation/causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kNearMissError = 20;  // MSPD up to which a wrong pose is nearly right [px]
constexpr double kNearMissShare =
    0.25;                           // ... and up to this share of the object's image: small ones turn in it
constexpr double kSitsOn = 0.5;     // share of an outline on another that makes it sit there
constexpr double kSamePlace = 0.5;  // intersection over union of two outlines in one place

bool nearlyRight(double mspd, double size) { return mspd < kNearMissError && mspd < kNearMissShare * size; }

using Hull = std::vector<cv::Point2f>;

Hull projectedHull(const BopModel& model, const Rigid3& camera_from_object,
                   const Eigen::Matrix3d& intrinsics) {
  Hull points, hull;
  for (const Eigen::Vector3d& x : model.vertices) {
    const Eigen::Vector3d p = camera_from_object * x;
    if (!(p.z() > 1e-3)) continue;
    const Eigen::Vector3d uv = intrinsics * p / p.z();
    points.emplace_back(float(uv.x()), float(uv.y()));
  }
  if (points.size() >= 3) cv::convexHull(points, hull);
  return hull;
}

double area(const Hull& hull) { return hull.size() < 3 ? 0 : cv::contourArea(hull); }

double commonArea(const Hull& a, const Hull& b) {
  if (area(a) <= 0 || area(b) <= 0) return 0;
  Hull common;
  return cv::intersectConvexConvex(a, b, common);
}

std::string limitOf(const TruthOutcome& truth, const SearchLimits& limits, const InFrame& in_frame) {
  if (truth.distance < limits.min_distance)
    return fmt::format("nearer than min_distance: {:.3g} m of {:.3g} m", truth.distance, limits.min_distance);
  if (truth.distance > limits.max_distance)
    return fmt::format("farther than max_distance: {:.3g} m of {:.3g} m", truth.distance,
                       limits.max_distance);
  const double size = truth.size * limits.searched_scale;
  if (size < limits.min_size)
    return fmt::format("smaller than min_size: {:.3g} px in the searched image of {:.3g} px", size,
                       limits.min_size);
  const double inside = in_frame ? in_frame(truth) : 1;
  if (inside < limits.min_in_frame)
    return fmt::format("less in the frame than min_in_frame: {:.2g} of its contour of {:.2g}", inside,
                       limits.min_in_frame);
  return "";
}

std::string suppressor(const std::vector<JudgedPose>& judged, int index) {
  const JudgedPose& pose = judged[size_t(index)];
  if (pose.suppressed_by < 0) return "";
  const JudgedPose& by = judged.at(size_t(pose.suppressed_by));
  return std::string(" by a ") + (by.right() ? "right" : "wrong") + " pose of " +
         (by.object == pose.object ? "its object" : "another object") +
         (by.fate == JudgedPose::kRejected ? " that was itself rejected" : "");
}

bool nearlyRightJudged(const MissedObject& missed, const std::vector<JudgedPose>& judged) {
  return missed.nearest >= 0 && nearlyRight(judged[size_t(missed.nearest)].errors.mspd, missed.truth.size);
}

// What was judged of an instance of which nothing right was.
std::string judgedInstead(const MissedObject& missed, const std::vector<JudgedPose>& judged) {
  if (nearlyRightJudged(missed, judged)) return ", one nearly right";
  if (missed.turned) return ", one in its place in a wrong orientation";
  return missed.lost.stage == LostAt::kNotJudged ? ", none in its place" : "";
}

std::string causeOf(const MissedObject& missed, const std::vector<JudgedPose>& judged,
                    const SearchLimits& limits) {
  if (!missed.limit.empty()) return "limit of the search: " + missed.limit.substr(0, missed.limit.find(':'));
  const LostAt& lost = missed.lost;
  std::string cause = toString(lost.stage);
  if (lost.stage <= LostAt::kNotJudged) return cause + judgedInstead(missed, judged);

  const JudgedPose& pose = judged[size_t(missed.nearest)];
  if (lost.stage == LostAt::kRejected && !pose.strongest_against.empty())
    cause += ": " + pose.strongest_against;
  if (lost.stage == LostAt::kSuppressed) {
    const bool improbable = pose.probability < limits.accept_probability;
    cause += suppressor(judged, missed.nearest) + (improbable ? ", too improbable anyway" : "");
  }
  return cause;
}

// The stage at which a right pose was lost.
LostAt::Stage stageOf(const JudgedPose& pose) {
  if (pose.fate == JudgedPose::kRejected) return LostAt::kRejected;
  return pose.fate == JudgedPose::kSuppressed ? LostAt::kSuppressed : LostAt::kFoundElsewhere;
}

using InstanceKey = std::array<int, 3>;  // scene, image, BopImage::truth

std::map<InstanceKey, std::vector<int>> posesByInstance(const std::vector<JudgedPose>& judged) {
  std::map<InstanceKey, std::vector<int>> table;
  for (size_t k = 0; k < judged.size(); ++k)
    if (judged[k].nearest >= 0)
      table[{judged[k].scene, judged[k].image, judged[k].nearest}].push_back(int(k));
  return table;
}

// Of the right poses the most probable one tells most of why an instance was lost, else the nearest one.
bool tellsMore(const JudgedPose& a, const JudgedPose& b) {
  if (a.right() != b.right()) return a.right();
  if (a.right()) return a.probability > b.probability;
  return a.errors.mspd < b.errors.mspd;
}

// The pose that tells most of why an instance was lost; -1: none.
int tellingPose(const std::vector<JudgedPose>& judged, const std::vector<int>& poses) {
  int best = -1;
  for (const int k : poses)
    if (best < 0 || tellsMore(judged[size_t(k)], judged[size_t(best)])) best = k;
  return best;
}

// `telling`: the pose that tells most; `traced`: how the search came near. Both may be nullptr.
LostAt lostAt(const JudgedPose* telling, const TracedTruth* traced, double size) {
  if (telling && telling->right()) return {stageOf(*telling), telling->errors.mspd, telling->against};

  LostAt lost;
  if (telling) lost = {LostAt::kNotJudged, telling->errors.mspd, telling->against};
  if (!traced) return lost;
  const LostAt in_search = lostInSearch(*traced, size);
  return {in_search.stage, in_search.nearest_px, lost.by};
}

const TracedTruth* traceOf(const TruthOutcome& truth, const std::vector<TracedTruth>& traced) {
  const auto found = std::find_if(traced.begin(), traced.end(), [&](const TracedTruth& one) {
    return one.scene == truth.scene && one.image == truth.image && one.truth == truth.index;
  });
  return found == traced.end() ? nullptr : &*found;
}

double overUnion(const Hull& a, const Hull& b) {
  const double common = commonArea(a, b), united = area(a) + area(b) - common;
  return united > 0 ? common / united : 0;
}

// Whether one of the poses has the instance's place and size in the image.
bool coverIt(const BopImage& image, const BopModel& model, const TruthOutcome& truth,
             const std::vector<JudgedPose>& judged, const std::vector<int>& poses) {
  const Hull hull = projectedHull(model, truth.camera_from_object, image.intrinsics);
  return std::any_of(poses.begin(), poses.end(), [&](int k) {
    const Rigid3& pose = judged[size_t(k)].camera_from_object;
    return overUnion(projectedHull(model, pose, image.intrinsics), hull) >= kSamePlace;
  });
}

// What a wrong row lies on: the truth that holds most of it.
WrongAccept placed(const BopImage& image, const BopModels& models, const RowOutcome& row) {
  WrongAccept wrong;
  wrong.row = row;
  const Hull hull = projectedHull(models.at(row.object), row.camera_from_object, image.intrinsics);
  const double own = area(hull);

  double best = 0;
  for (size_t k = 0; k < image.truth.size(); ++k) {
    const GroundTruth& truth = image.truth[k];
    const Hull other = projectedHull(models.at(truth.object), truth.camera_from_object, image.intrinsics);
    const double common = commonArea(hull, other);
    // Of two that hold it whole, it sits on the one that it resembles in place and size.
    if (own <= 0 || common < kSitsOn * own || overUnion(hull, other) <= best) continue;
    best = overUnion(hull, other);
    wrong.on = int(k);
    wrong.overlap = common / own;
    wrong.cause = WrongCause::kOtherObject;
    if (truth.object == row.object)
      wrong.cause = best >= kSamePlace ? WrongCause::kTwin : WrongCause::kMisplaced;
  }

  const BopModel& model = models.at(row.object);
  const double size = model.diameter * image.intrinsics(0, 0) / row.camera_from_object.translation.norm();
  if (nearlyRight(row.errors.mspd, size)) {
    wrong.cause = WrongCause::kNearMiss;
    wrong.on = row.nearest;
  }
  return wrong;
}

int judgedAs(const RowOutcome& row, const std::vector<JudgedPose>& judged) {
  for (size_t k = 0; k < judged.size(); ++k) {
    const JudgedPose& pose = judged[k];
    const bool same = pose.scene == row.scene && pose.image == row.image && pose.object == row.object &&
                      pose.fate == JudgedPose::kReported;
    const Eigen::Vector3d apart = pose.camera_from_object.translation - row.camera_from_object.translation;
    if (same && apart.norm() < 1e-6) return int(k);
  }
  return -1;
}

std::vector<CauseCount> sorted(const std::map<std::string, int>& counts) {
  std::vector<CauseCount> list;
  for (const auto& [cause, count] : counts) list.push_back({cause, count});
  std::stable_sort(list.begin(), list.end(),
                   [](const CauseCount& a, const CauseCount& b) { return a.count > b.count; });
  return list;
}

}  // namespace

std::string toString(WrongCause cause) {
  switch (cause) {
    case WrongCause::kNearMiss:
      return "nearly right";
    case WrongCause::kTwin:
      return "right place, wrong orientation";
    case WrongCause::kMisplaced:
      return "its object, misplaced";
    case WrongCause::kOtherObject:
      return "on another object";
    case WrongCause::kClutter:
      return "on clutter";
  }
  return "unknown";
}

std::vector<MissedObject> missedObjects(const BopSplit& split, const BopModels& models,
                                        const RunOutcomes& run, const std::vector<JudgedPose>& judged,
                                        const std::vector<TracedTruth>& traced, const SearchLimits& limits,
                                        const InFrame& in_frame) {
  auto poses = posesByInstance(judged);
  std::vector<MissedObject> all;
  for (const TruthOutcome& truth : run.truths) {
    if (!truth.wanted() || truth.found()) continue;
    const std::vector<int>& its = poses[{truth.scene, truth.image, truth.index}];
    MissedObject missed;
    missed.truth = truth;
    missed.limit = limitOf(truth, limits, in_frame);
    missed.nearest = tellingPose(judged, its);

    const JudgedPose* telling = missed.nearest < 0 ? nullptr : &judged[size_t(missed.nearest)];
    const TracedTruth* trace = traceOf(truth, traced);
    missed.lost = lostAt(telling, trace, truth.size);
    if (trace) missed.traced = *trace;
    if (missed.lost.stage <= LostAt::kNotJudged && !nearlyRightJudged(missed, judged))
      missed.turned =
          coverIt(*split.find(truth.scene, truth.image), models.at(truth.object), truth, judged, its);
    missed.cause = causeOf(missed, judged, limits);
    all.push_back(missed);
  }
  std::stable_sort(all.begin(), all.end(), [](const MissedObject& a, const MissedObject& b) {
    if (a.limit.empty() != b.limit.empty()) return a.limit.empty();
    if (a.truth.visible != b.truth.visible) return a.truth.visible > b.truth.visible;
    return a.truth.size > b.truth.size;
  });
  return all;
}

std::vector<WrongAccept> wrongAccepts(const BopSplit& split, const BopModels& models, const RunOutcomes& run,
                                      const std::vector<JudgedPose>& judged) {
  std::vector<WrongAccept> all;
  for (const RowOutcome& row : run.rows) {
    if (row.right()) continue;
    if (!models.count(row.object))
      throw BadInput(
          fmt::format("the results name object {}, which models_info.json does not list", row.object));
    WrongAccept wrong = placed(*split.find(row.scene, row.image), models, row);
    wrong.judged = judgedAs(row, judged);
    all.push_back(wrong);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const WrongAccept& a, const WrongAccept& b) { return a.row.score > b.row.score; });
  return all;
}

std::vector<CauseCount> causeCounts(const std::vector<MissedObject>& missed) {
  std::map<std::string, int> counts;
  for (const MissedObject& one : missed) ++counts[one.cause];
  return sorted(counts);
}

std::vector<CauseCount> causeCounts(const std::vector<WrongAccept>& wrong) {
  std::map<std::string, int> counts;
  for (const WrongAccept& one : wrong) ++counts[toString(one.cause)];
  return sorted(counts);
}

}  // namespace monocular_eye_hand
