#include "recognition/search_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "monocular_eye_hand/geometry/error.h"
#include "recognition/explained_features.h"
#include "recognition/verification.h"

namespace monocular_eye_hand {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

// Perspective lets the object's centre move somewhat farther in the image than the corners whose distance is
// measured.
constexpr double kCentreOverCorners = 2.0;

// Number of image groupings all of whose features answer the contour that is drawn under the pose.
int ownGroupings(const SearchModel& model, const SearchImage& image, const Rigid3& camera_from_object) {
  Candidate drawn;
  drawn.pose.camera_from_object = model.canonical(camera_from_object, &drawn.view);
  drawContour(model, image, &drawn);

  const FeatureSet& features = image.features;
  const std::vector<char> explained = explainedPoints(features, drawn.claimed);
  const auto own_segment = [&](int s) { return isExplained(features.segments[size_t(s)], explained); };
  const auto own_ellipse = [&](int e) {
    return isExplained(features, features.ellipses[size_t(e)], explained);
  };

  return int(std::count_if(image.groupings.begin(), image.groupings.end(), [&](const Grouping& grouping) {
    return std::all_of(grouping.segments.begin(), grouping.segments.end(), own_segment) &&
           std::all_of(grouping.ellipses.begin(), grouping.ellipses.end(), own_ellipse);
  }));
}

}  // namespace

SearchTrace::SearchTrace(const SearchImage& image, const std::vector<SearchModel>& models,
                         const std::vector<PoseProposal>& poses, double scale)
    : image_(image), models_(models), scale_(scale) {
  for (const PoseProposal& pose : poses) traced_.push_back(traced(pose));
}

SearchTrace::Traced SearchTrace::traced(const PoseProposal& pose) const {
  if (pose.object < 0 || pose.object >= int(models_.size()))
    throw BadInput(
        fmt::format("a pose of object {} is traced, the model base has {}", pose.object, models_.size()));
  const ObjectModel& model = models_[size_t(pose.object)].model();
  const Rigid3& camera_from_object = pose.camera_from_object;
  const Camera& camera = image_.camera;
  if (!camera_from_object.isFinite() || !((camera_from_object * model.centre()).z() > 0))
    throw BadInput("a pose of " + model.name + " is traced that is not in front of the camera");

  Traced traced;
  traced.pose = pose;
  traced.nearest.fill(kNone);
  traced.centre = camera.project(camera_from_object * model.centre());
  for (const Rigid3& symmetry : model.symmetries.discrete) {
    const Eigen::Vector2d equal = camera.project(camera_from_object * symmetry * model.centre());
    traced.spread = std::max(traced.spread, (equal - traced.centre).norm());
  }
  return traced;
}

void SearchTrace::note(SearchStage stage, int object, const Rigid3& camera_from_object) {
  const SearchModel& model = models_[size_t(object)];
  const Eigen::Vector3d centre = camera_from_object * model.model().centre();
  if (!(centre.z() > 0)) return;

  const Eigen::Vector2d uv = image_.camera.project(centre);
  for (Traced& traced : traced_) {
    if (traced.pose.object != object) continue;
    // Most poses lie elsewhere, and to measure the distance takes long.
    double& nearest = traced.nearest[size_t(stage)];
    if ((uv - traced.centre).norm() > kCentreOverCorners * nearest + traced.spread) continue;

    const double distance =
        model.poseDistance(image_.camera, traced.pose.camera_from_object, camera_from_object);
    if (distance < std::min(nearest, std::numeric_limits<double>::max())) nearest = distance;
  }
}

std::vector<PoseTrace> SearchTrace::traces() const {
  std::vector<PoseTrace> traces;
  for (const Traced& traced : traced_) {
    const auto nearest = [&](SearchStage stage) { return scale_ * traced.nearest[size_t(stage)]; };
    PoseTrace trace;
    trace.groupings =
        ownGroupings(models_[size_t(traced.pose.object)], image_, traced.pose.camera_from_object);
    trace.generated = nearest(SearchStage::kGenerated);
    trace.taken = nearest(SearchStage::kTaken);
    trace.aligned = nearest(SearchStage::kAligned);
    trace.verified = nearest(SearchStage::kVerified);
    trace.recorded = nearest(SearchStage::kRecorded);
    traces.push_back(trace);
  }
  return traces;
}

}  // namespace monocular_eye_hand
