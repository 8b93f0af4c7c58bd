#pragma once
#include <opencv2/core.hpp>
#include <random>
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/geometry/ellipse.h"

namespace monocular_eye_hand {

using Corners = std::vector<Eigen::Vector2d>;

/// 640 x 480: up to four convex polygons of three to five corners apart from each other, at least 25 grey
/// levels off the ground, blurred by 0.8 px, with Gaussian noise.
struct PolygonImage {
  cv::Mat grey;
  std::vector<Corners> polygons;
};
/// 60 images, the same for the same arguments. OpenCV's filling paints the pixels of the outline too, so at 8
/// samples per pixel its shapes are wider than told by about 1/16 px on each side; `exact` fills by area.
std::vector<PolygonImage> polygonSet(double noise, bool exact);

/// 640 x 480: ellipses of semi-axes 12 to 80 px, some hidden in part, beside rectangles and lines; blurred by
/// 0.7 px, with Gaussian noise.
struct EllipseImage {
  cv::Mat grey;
  std::vector<Ellipse> ellipses;
  double occlusion = 0;  ///< hidden share of the eccentric angles
  double noise = 0;
};
/// 300 images: occlusion 0, 0.1 .. 0.5, noise 2 and 8, 25 images each.
std::vector<EllipseImage> ellipseSet();

/// Paints a convex or other polygon by area: each pixel mixes with `grey` by the share that the polygon
/// covers (Sutherland and Hodgman's clipping of the polygon to the pixel).
void fillByArea(const Corners& corners, double grey, cv::Mat* image);
/// Blurs a CV_32F image, adds noise and rounds to 8 bits.
cv::Mat photograph(const cv::Mat& image, double blur, double noise, std::mt19937_64* random);

/// A data set found by MONOCULAR_EYE_HAND_DATA; empty without it.
struct BenchDataset {
  std::string name, split;
  BopModels models;
  BopSplit images;
};
std::vector<BenchDataset> benchDatasets();

}  // namespace monocular_eye_hand
