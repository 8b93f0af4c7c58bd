#include "recognition/image_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "recognition/alignment.h"
#include "recognition/constellation.h"
#include "recognition/reporting.h"
#include "recognition/verification.h"

namespace monocular_eye_hand {
namespace {

const std::vector<double> kFineRanges{6.0, 4.0, 2.5, 1.5};  // [px]
constexpr double kFineStep = 4.0;                           // contour samples of the fine alignment [px]
constexpr double kSamePose = 4.0;                           // poses this near in the image are one [px]
constexpr double kSameStart = 2.0;            // a start this near to a candidate leads there [px]
constexpr double kSameEnd = 1.5;              // an aligned pose this near to a candidate is it [px]
constexpr float kMinAligned = 6.0f;           // nats after coarse alignment
constexpr double kWorthRecalculating = 0.05;  // probability from which a candidate may still be reported
constexpr double kExplainedShare = 0.7;       // of a segment's points claimed: it is explained
constexpr double kSurelyRight = 0.9;          // only such objects explain features away during the search

double gradientNoise(const FeatureSet& features) {
  if (features.points.empty()) return 1;
  std::vector<float> g;
  g.reserve(features.points.size());
  for (const EdgePoint& p : features.points) g.push_back(p.gradient);
  std::nth_element(g.begin(), g.begin() + g.size() / 10, g.end());
  return g[g.size() / 10];
}

}  // namespace

ImageSearch::ImageSearch(const ModelBase& base, const std::vector<SearchModel>& models,
                         const RecognitionOptions& options, const cv::Mat& grey, const Camera& camera,
                         int only)
    : base_(base),
      models_(models),
      options_(options),
      image_(grey),
      full_camera_(camera),
      only_(only),
      budget_(options.budget, options.time_limit) {
  if (grey.empty()) throw BadInput("the image is empty");
  if (grey.type() != CV_8UC1) throw BadInput("the image must be 8-bit grey (CV_8UC1)");
  if (grey.cols != camera.width || grey.rows != camera.height)
    throw BadInput("the image is " + std::to_string(grey.cols) + " x " + std::to_string(grey.rows) +
                   " but the camera is calibrated for " + std::to_string(camera.width) + " x " +
                   std::to_string(camera.height));
  double scale = 1;
  while (camera.width * scale > options.search_width) scale /= 2;
  camera_ = scale == 1 ? camera : camera.resized(scale);
  if (scale == 1)
    grey_ = grey;
  else
    cv::resize(grey, grey_, {camera_.width, camera_.height}, 0, 0, cv::INTER_AREA);
}

void ImageSearch::timed(const char* stage, const std::function<void(StageReport*)>& work) {
  const auto begin = std::chrono::steady_clock::now();
  StageReport report;
  report.name = stage;
  work(&report);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result_.stages.push_back(report);
}

void ImageSearch::lookAtImage() {
  timed("features", [&](StageReport* report) {
    result_.features = detectFeatures(grey_, camera_, options_.features);
    report->counts = {{"edge points", double(result_.features.points.size())},
                      {"traces", double(result_.features.traces.size())},
                      {"segments", double(result_.features.segments.size())},
                      {"ellipses", double(result_.features.ellipses.size())}};
  });
  timed("grouping", [&](StageReport* report) {
    result_.groupings = groupFeatures(result_.features, base_, options_.grouping);
    for (const Grouping& g : result_.groupings) ++report->counts[name(g.kind)];
  });
  timed("evidence map", [&](StageReport*) {
    domain_ = rectDomain(camera_);
    rect_grey_ = rectifiedGrey(grey_, camera_, domain_);
    map_ = std::make_unique<EvidenceMap>(result_.features, domain_);
    raster_ = std::make_unique<EdgeRaster>(result_.features, domain_);
    context_.emplace(VerificationContext{camera_, domain_, result_.features, *map_, *raster_, rect_grey_,
                                         gradientNoise(result_.features)});
  });
}

int ImageSearch::wantedFrom(int first) const {
  int count = 0;
  for (int i = first; i < int(models_.size()); ++i) count += wanted(i);
  return count;
}

void ImageSearch::searchGroupings() {
  const SearchContext context{camera_, result_.features, result_.groupings, *map_, options_};
  const int rounds_after = wantedFrom(0);  // every object has its part of the second round
  for (int i = 0; i < int(models_.size()); ++i) {
    if (!wanted(i)) continue;
    budget_.allow(wantedFrom(i) + rounds_after);
    timed("hypotheses from groupings", [&](StageReport* report) {
      const long long before = budget_.scored();
      hypothesesFromGroupings(context, i, models_[i], &pools_[i], &budget_);
      report->counts["scored"] = double(budget_.scored() - before);
    });
    judgeHypotheses(i, options_.refined_per_object / 2);
  }
}

void ImageSearch::searchEdges() {
  const SearchContext context{camera_, result_.features, result_.groupings, *map_, options_};
  const std::vector<char> usable = unexplainedSegments();
  for (int i = 0; i < int(models_.size()); ++i) {
    if (!wanted(i)) continue;
    budget_.allow(wantedFrom(i));
    timed("hypotheses from edges", [&](StageReport* report) {
      const long long before = budget_.scored();
      hypothesesFromEdges(context, models_[i], usable, &pools_[i], &budget_);
      report->counts["scored"] = double(budget_.scored() - before);
    });
    judgeHypotheses(i, options_.refined_per_object);
  }
}

void ImageSearch::judgeHypotheses(int object, int count) {
  std::vector<AlignedHypothesis> aligned;
  timed("coarse alignment", [&](StageReport* report) {
    const std::vector<Hypothesis> hypotheses = pools_[object].take(count);
    aligned = alignHypotheses(models_[object], hypotheses);
    report->counts = {{"hypotheses", double(hypotheses.size())}, {"aligned", double(aligned.size())}};
  });
  timed("verification", [&](StageReport* report) {
    for (const AlignedHypothesis& a : distinctPlaces(models_[object], aligned)) {
      if (knownCandidate(object, a.hypothesis.camera_from_object, kSameStart)) continue;
      if (budget_.outOfTime()) break;
      report->counts["verified"] += judge(object, a.hypothesis);
    }
  });
}

std::vector<ImageSearch::AlignedHypothesis> ImageSearch::alignHypotheses(
    const SearchModel& model, const std::vector<Hypothesis>& hypotheses) {
  std::vector<AlignedHypothesis> aligned;
  for (Hypothesis h : hypotheses) {
    if (budget_.outOfTime()) break;
    if (!alignCoarsely(model, camera_, *raster_, &h.camera_from_object, &h.view)) continue;
    const CoarseScore score = scorePose(model, h.view, h.camera_from_object, camera_, *map_);
    if (score.evidence < kMinAligned || score.in_frame < options_.min_in_frame) continue;
    h.evidence = score.evidence;
    aligned.push_back({h, camera_.project(h.camera_from_object * model.model().centre())});
  }
  std::stable_sort(aligned.begin(), aligned.end(), [](const auto& a, const auto& b) {
    return a.hypothesis.evidence > b.hypothesis.evidence;
  });
  return aligned;
}

std::vector<ImageSearch::AlignedHypothesis> ImageSearch::distinctPlaces(
    const SearchModel& model, const std::vector<AlignedHypothesis>& aligned) const {
  std::vector<AlignedHypothesis> kept;
  for (const AlignedHypothesis& a : aligned) {
    if (int(kept.size()) >= options_.verified_per_object) break;
    const auto same = [&](const AlignedHypothesis& k) {
      return (k.centre - a.centre).norm() < 2 * kSamePose &&
             model.poseDistance(camera_, k.hypothesis.camera_from_object, a.hypothesis.camera_from_object) <
                 kSamePose;
    };
    if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(a);
  }
  return kept;
}

bool ImageSearch::knownCandidate(int object, const Rigid3& camera_from_object, double distance) const {
  return std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& c) {
    return c.object == object &&
           models_[object].poseDistance(camera_, c.pose.camera_from_object, camera_from_object) < distance;
  });
}

bool ImageSearch::judge(int object, const Hypothesis& hypothesis) {
  const SearchModel& model = models_[object];
  Candidate candidate;
  candidate.object = object;
  candidate.kind = hypothesis.kind;
  candidate.pose =
      alignFinely(model, camera_, domain_, *raster_, hypothesis.camera_from_object, kFineRanges, kFineStep);
  if (!candidate.pose.well_posed) return false;
  candidate.pose.camera_from_object = model.canonical(candidate.pose.camera_from_object, &candidate.view);
  const Rigid3& pose = candidate.pose.camera_from_object;
  const double distance = (pose * model.model().centre()).norm();
  if (distance < options_.min_distance || distance > options_.max_distance) return false;
  if (!model.seenFromOutside(pose) || knownCandidate(object, pose, kSameEnd)) return false;
  verify(model, *context_, &candidate);
  if (candidate.terms.in_frame < options_.min_in_frame || candidate.terms.sum < kMinAligned) return true;
  candidate.probability = probability(candidate.terms, options_.decision);
  candidates_.push_back(std::move(candidate));
  return true;
}

std::vector<char> ImageSearch::unexplainedSegments() const {
  std::vector<char> claimed(result_.features.points.size(), 0);
  for (const Explanation& e : chooseExplanations(candidates_)) {
    const Candidate& c = candidates_[e.candidate];
    if (c.probability < kSurelyRight) continue;
    for (int p : c.claimed) claimed[p] = 1;
  }
  // A contour sample answers for the points up to half a step to either side of it.
  std::vector<char> spread = claimed;
  for (const EdgeTrace& trace : result_.features.traces)
    for (int i = trace.first; i < trace.first + trace.count; ++i)
      if (claimed[i])
        for (int k = std::max(trace.first, i - 3); k <= std::min(trace.first + trace.count - 1, i + 3); ++k)
          spread[k] = 1;
  std::vector<char> usable;
  for (const LineSegment& segment : result_.features.segments) {
    int explained = 0;
    for (int i = segment.first; i < segment.first + segment.count; ++i) explained += spread[i];
    usable.push_back(explained < kExplainedShare * segment.count);
  }
  return usable;
}

void ImageSearch::recalculateChosen() {
  timed("best four", [&](StageReport* report) {
    const std::vector<ImageCorner> corners = imageCorners(result_.groupings);
    for (const Explanation& e : chooseExplanations(candidates_)) {
      Candidate& candidate = candidates_[e.candidate];
      if (candidate.probability < kWorthRecalculating) continue;
      const SearchModel& model = models_[candidate.object];
      const std::vector<PointMatch> matches =
          growConstellation(model, candidate, camera_, result_.features, corners);
      candidate.matched_corners = int(matches.size());
      report->counts["corners"] += double(matches.size());
      if (matches.size() < 4) continue;
      const RefinedPose four = poseFromBestFour(matches, candidate.pose.camera_from_object, camera_);
      if (!four.well_posed) continue;
      Candidate again = candidate;
      again.pose =
          alignFinely(model, camera_, domain_, *raster_, four.camera_from_object, {2.5, 1.5}, kFineStep);
      if (!again.pose.well_posed) continue;
      again.pose.camera_from_object = model.canonical(again.pose.camera_from_object, &again.view);
      verify(model, *context_, &again);
      again.probability = probability(again.terms, options_.decision);
      if (again.terms.sum <= candidate.terms.sum || again.probability < candidate.probability) continue;
      candidate = std::move(again);
      ++report->counts["improved"];
    }
  });
}

// `scale`: of the full image over the search image.
void ImageSearch::refine(const RectDomain& domain, const EdgeRaster& raster, double scale,
                         ObjectEstimate* object) const {
  const SearchModel& model = models_[object->object];
  Rigid3 pose = object->camera_from_object;
  if (scale > 1) {
    const RefinedPose aligned =
        alignFinely(model, full_camera_, domain, raster, pose, {1.5 * scale, scale, 1.5}, kFineStep * scale);
    if (aligned.well_posed) pose = aligned.camera_from_object;
  }
  const RefinedPose refined =
      alignByFeatures(model, full_camera_, domain, raster, pose, kFineRanges.back(), kFineStep);
  const double moved =
      model.poseDistance(full_camera_, refined.camera_from_object, object->camera_from_object);
  if (!refined.well_posed || moved > 2 * kSamePose * scale) return;
  object->camera_from_object = refined.camera_from_object;
  object->covariance = refined.covariance;
}

void ImageSearch::refineReported() {
  if (result_.objects.empty() && result_.rejected.empty()) return;
  const double scale = double(full_camera_.width) / camera_.width;
  timed("fine poses", [&](StageReport* report) {
    FeatureSet features;
    RectDomain domain = domain_;
    std::optional<EdgeRaster> full;
    if (scale > 1) {
      features = detectFeatures(image_, full_camera_, options_.features);
      domain = rectDomain(full_camera_);
      full.emplace(features, domain);
      report->counts = {{"edge points", double(features.points.size())}};
    }
    const EdgeRaster& raster = full ? *full : *raster_;
    for (std::vector<ObjectEstimate>* objects : {&result_.objects, &result_.rejected})
      for (ObjectEstimate& object : *objects) {
        refine(domain, raster, scale, &object);
        const cv::Rect& box = object.bounding_box;
        object.bounding_box =
            cv::Rect(int(box.x * scale), int(box.y * scale), int(box.width * scale), int(box.height * scale));
      }
  });
}

bool ImageSearch::found() const {
  for (const Explanation& e : chooseExplanations(candidates_))
    if (candidates_[e.candidate].probability >= options_.accept_probability) return true;
  return false;
}

std::string ImageSearch::whyNothing() const {
  std::string reason;
  if (result_.features.segments.empty() && result_.features.ellipses.empty())
    reason = "no straight edge and no ellipse in the image: too dark, blurred or empty";
  else if (candidates_.empty())
    reason = "no pose of a known object agrees with the edges of the image";
  else if (!result_.rejected.empty())
    reason = "best candidate is " + result_.rejected.front().name + ": " + result_.rejected.front().reason;
  if (result_.budget_spent)
    reason += "; the budget of " + std::to_string(options_.budget) +
              " hypotheses was spent before all groupings were used";
  if (result_.truncated) reason += "; the time limit cut the search";
  return reason;
}

void ImageSearch::report() {
  timed("decision", [&](StageReport* report) {
    for (const Explanation& e : chooseExplanations(candidates_)) {
      ObjectEstimate object =
          reportObject(models_, candidates_, e, options_, camera_, result_.groupings, result_.features);
      (object.decision == Decision::kRejected ? result_.rejected : result_.objects)
          .push_back(std::move(object));
    }
    const auto likelier = [](const ObjectEstimate& a, const ObjectEstimate& b) {
      return a.probability > b.probability;
    };
    std::stable_sort(result_.objects.begin(), result_.objects.end(), likelier);
    std::stable_sort(result_.rejected.begin(), result_.rejected.end(), likelier);
    report->counts = {{"found", double(result_.objects.size())},
                      {"rejected", double(result_.rejected.size())}};
  });
}

// Of the poses that a part's symmetry makes equal, the one nearest to where it was.
void ImageSearch::keepTurn(const std::vector<ObjectEstimate>& previous, ObjectEstimate* object) const {
  const ObjectModel& model = models_[object->object].model();
  Rigid3& pose = object->camera_from_object;
  const auto old = std::find_if(previous.begin(), previous.end(), [&](const ObjectEstimate& o) {
    return o.object == object->object &&
           (o.camera_from_object.translation - pose.translation).norm() < model.diameter;
  });
  if (old == previous.end()) return;
  const Rigid3 equal = nearestEqualPose(model, pose, old->camera_from_object);
  object->covariance = carried(motionAtOffset(equal.translation - pose.translation), object->covariance);
  pose = equal;
}

RecognitionResult ImageSearch::run(const std::vector<ObjectEstimate>& previous) {
  lookAtImage();
  for (const SearchModel& model : models_) pools_.emplace_back(camera_, model, options_);
  searchGroupings();
  if (only_ < 0 || !found()) searchEdges();
  result_.truncated = budget_.cutByTime();
  result_.budget_spent = budget_.cutByWork();
  recalculateChosen();

  report();
  refineReported();
  for (std::vector<ObjectEstimate>* objects : {&result_.objects, &result_.rejected})
    for (ObjectEstimate& object : *objects) keepTurn(previous, &object);
  if (result_.objects.empty()) result_.reason = whyNothing();
  return std::move(result_);
}

}  // namespace monocular_eye_hand
