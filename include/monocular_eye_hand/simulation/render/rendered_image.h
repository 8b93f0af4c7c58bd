#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else.
struct RenderOptions {
  int samples = 2;       ///< stratified samples per pixel along each axis (2: four per pixel)
  int edge_samples = 4;  ///< the same where samples or neighbours differ; >= samples
  bool shadows = true;
  bool ambient_occlusion =
      false;  ///< darkens the ambient light near contacts; needs samples >= 5 to look smooth
  double occlusion_range = 0.15;  ///< what is farther takes no ambient light away [m]
  double blur_sigma = 0.35;       ///< Gaussian of the lens, before the sensor [px]
  double noise_sigma = 1.5;       ///< sensor noise at black [grey levels]
  double shot_noise = 0.01;       ///< its variance grows by this per grey level
  double exposure = 0;       ///< grey = 255 (exposure * radiance)^(1 / gamma); 0: chosen so that the mean is
                             ///< `mean` and hardly anything saturates
  double mean = 0.42;        ///< of the linear image when the exposure is chosen, 0..1
  double saturated = 0.005;  ///< share of the pixels that a chosen exposure may let saturate, or nearly so
  double gamma = 1.0;
  double vignetting = 0;  ///< light that the image's corners lack, as a share
  double sharpening = 0;  ///< as cameras do it: strength of an unsharp mask of 1 px, before the noise
  uint32_t seed = 1;

  void check() const;  ///< throws BadInput naming field, value and rule
};

/// How much of an object the image shows (BOP's scene_gt_info).
struct Visibility {
  int pixels_visible = 0;  ///< pixels whose centre shows the object
  int pixels_alone = 0;    ///< ... if nothing stood before it; beyond the image's border in rectified pixels
  double fraction = 0;     ///< pixels_visible / pixels_alone
  cv::Rect box_visible;    ///< raw pixels
};

struct RenderedImage {
  cv::Mat grey;   ///< CV_8UC1, raw (distorted) pixels
  cv::Mat ids;    ///< CV_16SC1: Scene::objects index at the pixel's centre; kTableId, kNothingId
  cv::Mat depth;  ///< CV_32FC1: z in the camera frame at the pixel's centre [m]; 0 where nothing is hit
  std::vector<Visibility> objects;  ///< one per Scene::objects
  double exposure = 0;              ///< the one used
};
constexpr int kTableId = -1;
constexpr int kNothingId = -2;

}  // namespace monocular_eye_hand
