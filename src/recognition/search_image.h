#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/pose/circle_pose.h"
#include "monocular_eye_hand/recognition/options.h"
#include "recognition/edge_raster.h"
#include "recognition/evidence.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// One image at one size and all that is seen in it. It grows in the order of the functions below; what has
/// not been looked at yet is empty. Can be moved but not copied: the raster refers to the features' points.
struct SearchImage {
  Camera camera;  ///< of this size
  cv::Mat grey;   ///< of this size, as taken
  RectDomain domain;
  FeatureSet features;
  EdgeRaster raster;  ///< of features.points, on the domain

  std::vector<Grouping> groupings;        ///< withGroupings
  std::vector<CirclePoses> unit_circles;  ///< withGroupings; unitCircles

  EvidenceMap map;                  ///< withEvidence; on the domain
  cv::Mat rect_grey;                ///< withEvidence; rectified, on the domain
  double noise = 1;                 ///< withEvidence; gradient noise [grey levels per px]
  double grey_noise = 1;            ///< withEvidence; standard deviation of the image noise [grey levels]
  std::vector<int> trace_of_point;  ///< withEvidence; features.traces by features.points
};

/// The circles of radius 1 m that look like the ellipses, one by one: those of other radii differ in their
/// distance alone.
std::vector<CirclePoses> unitCircles(const FeatureSet& features, const Camera& camera);

/// What an alignment looks at: features and where their edge points lie. `grey`: CV_8UC1 of the camera's
/// size.
SearchImage withFeatures(const cv::Mat& grey, const Camera& camera, const FeatureOptions& options);
/// ... and what hypotheses begin with.
SearchImage withGroupings(SearchImage image, const ModelBase& base, const GroupingOptions& options);
/// ... and what poses are scored and verified by.
SearchImage withEvidence(SearchImage image);

/// An image of this width is searched in so many times fewer columns and rows: at most search_width [px].
int searchReduction(int width, int search_width);

/// The image in so many times fewer columns and rows, with all of the above. `grey`: CV_8UC1 of the camera's
/// size.
SearchImage lookAtImage(const cv::Mat& grey, const Camera& camera, int reduction, const ModelBase& base,
                        const RecognitionOptions& options, StageLog* log);

}  // namespace monocular_eye_hand
