#pragma once
#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/pose/refine.h"

namespace monocular_eye_hand {

/// A visible contour sample in the image, and the edge point that answers it.
struct SeenSample {
  Eigen::Vector3d p_in_object;
  Eigen::Vector2d uv, direction;  ///< rectified pixels; direction: unit
  int group = 0;
  int edge_point = -1;  ///< FeatureSet::points, -1: none within range
  bool inside = false;  ///< inside the image
  bool silhouette = false;
};

/// What the image says about one refined pose: for it, and against it. Every term is a plain number that the
/// decision weighs; names are those of ObjectEstimate::evidence.
struct EvidenceTerms {
  double sum = 0;                 ///< log-likelihood ratio of the visible contour [nats], one sample per 5 px
  double mean = 0;                ///< ... per sample
  double hit_ratio = 0;           ///< share of the contour inside the image with an edge within 2 px
  double in_frame = 0;            ///< share of the contour inside the image
  double contour_length = 0;      ///< visible contour inside the image [px]
  double groups = 0;              ///< visible model features (edges, circles, silhouettes)
  double unsupported = 0;         ///< share of them with hardly any edge under them
  double unsupported_length = 0;  ///< ... weighted by their length
  double silhouette_hits = 0;     ///< hit ratio of the outline alone
  double crease_hits = 0;         ///< ... of the inner edges alone (of the outline where there are none)
  double overhang = 0;      ///< share of the length of the image segments it uses that it does not explain
  double continuation = 0;  ///< share of edge ends past which an image edge runs straight on
  double ends = 0;          ///< edge ends that were tested for it
  double interior = 0;      ///< share of face pixels with an edge that the model does not explain
  double off_face = 0;      ///< share of face pixels that depart from a smooth shading of their face
  double faces = 0;         ///< visible faces
  double solidity = 0;      ///< drawn area over the area of the drawing's convex hull
  double size = 0;          ///< square root of the drawn area [px]
  double contrast = 0;      ///< median gradient of the answering edge points, relative to the image's noise
  double rms = 0;           ///< back-projection error of the answered samples [px]

  std::map<std::string, double> named() const;
};

/// A pose that has been refined and looked at.
struct Candidate {
  int object = 0;
  GroupingKind kind = GroupingKind::kEdge;
  RefinedPose pose;
  int view = 0;
  EvidenceTerms terms;
  std::vector<SeenSample> contour;
  std::vector<int> claimed;  ///< edge points that answer it, ascending
  std::vector<int> covered;  ///< cells of kCoverCell px that its faces cover, ascending
  int matched_groups = 0;
  int matched_corners = 0;  ///< size of its constellation, see growConstellation
  cv::Rect bounding_box;
  double probability = 0;
};

constexpr int kCoverCell = 8;  ///< side of the cells that measure overlap [px]

}  // namespace monocular_eye_hand
