#include "recognition/search_image.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "monocular_eye_hand/features/gradient.h"

namespace monocular_eye_hand {
namespace {

double gradientNoise(const FeatureSet& features) {
  if (features.points.empty()) return 1;

  std::vector<float> gradients;
  gradients.reserve(features.points.size());
  for (const EdgePoint& point : features.points) gradients.push_back(point.gradient);

  const auto tenth = gradients.begin() + gradients.size() / 10;
  std::nth_element(gradients.begin(), tenth, gradients.end());
  return *tenth;
}

std::vector<int> traceOfPoint(const FeatureSet& features) {
  std::vector<int> trace(features.points.size(), -1);
  for (size_t t = 0; t < features.traces.size(); ++t)
    for (int i = 0; i < features.traces[t].count; ++i)
      trace[size_t(features.traces[t].first) + size_t(i)] = int(t);
  return trace;
}

struct GreyImage {
  cv::Mat grey;
  Camera camera;
};

GreyImage reduced(const cv::Mat& grey, const Camera& camera, int reduction) {
  if (reduction == 1) return {grey, camera};

  GreyImage small;
  small.camera = camera.resized(1.0 / reduction);
  cv::resize(grey, small.grey, {small.camera.width, small.camera.height}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

SearchImage withFeatures(const cv::Mat& grey, const Camera& camera, const FeatureOptions& options) {
  SearchImage image;
  image.camera = camera;
  image.grey = grey;
  image.domain = rectDomain(camera);
  image.features = detectFeatures(grey, camera, options);
  image.raster = EdgeRaster(image.features, image.domain);
  return image;
}

std::vector<CirclePoses> unitCircles(const FeatureSet& features, const Camera& camera) {
  std::vector<CirclePoses> circles;
  for (const DetectedEllipse& seen : features.ellipses)
    circles.push_back(circlePoses(seen.ellipse, camera, 1));
  return circles;
}

SearchImage withGroupings(SearchImage image, const ModelBase& base, const GroupingOptions& options) {
  image.groupings = groupFeatures(image.features, base, options);
  image.unit_circles = unitCircles(image.features, image.camera);
  return image;
}

SearchImage withEvidence(SearchImage image) {
  image.map = EvidenceMap(image.features, image.domain);
  image.rect_grey = rectifiedGrey(image.grey, image.camera, image.domain);
  image.noise = gradientNoise(image.features);
  image.grey_noise = imageNoise(image.grey);
  image.trace_of_point = traceOfPoint(image.features);
  return image;
}

int searchReduction(int width, int search_width) { return (width + search_width - 1) / search_width; }

SearchImage lookAtImage(const cv::Mat& grey, const Camera& camera, int reduction, const ModelBase& base,
                        const RecognitionOptions& options, StageLog* log) {
  SearchImage image = log->timed("features", [&](StageReport* report) {
    const GreyImage small = reduced(grey, camera, reduction);
    SearchImage seen = withFeatures(small.grey, small.camera, options.features);
    report->counts = {{"edge points", double(seen.features.points.size())},
                      {"traces", double(seen.features.traces.size())},
                      {"segments", double(seen.features.segments.size())},
                      {"ellipses", double(seen.features.ellipses.size())}};
    return seen;
  });

  image = log->timed("grouping", [&](StageReport* report) {
    SearchImage grouped = withGroupings(std::move(image), base, options.grouping);
    for (const Grouping& grouping : grouped.groupings) ++report->counts[toString(grouping.kind)];
    return grouped;
  });

  return log->timed("evidence map", [&](StageReport*) { return withEvidence(std::move(image)); });
}

}  // namespace monocular_eye_hand
