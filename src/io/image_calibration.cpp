#include "monocular_eye_hand/io/image_calibration.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace monocular_eye_hand {
namespace {

template <class Numbers>
void requireFinite(const Numbers& numbers, const char* field) {
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (std::isfinite(numbers[i])) continue;
    std::ostringstream text;
    text << field << "[" << i << "] = " << numbers[i] << " is not finite: calibrate the camera again";
    throw BadCameraInfo(text.str());
  }
}

template <class Numbers>
bool allZero(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double value) { return value == 0; });
}

std::string size(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

PixelWindow windowOf(const ImageCalibration& calibration, ImageKind kind) {
  PixelWindow w;
  w.bin_x = std::max(1, calibration.binning_x);
  w.bin_y = std::max(1, calibration.binning_y);
  w.width = calibration.width;
  w.height = calibration.height;
  const ImageCalibration::Region& roi = calibration.region;
  if (roi.width == 0 && roi.height == 0) return w;  // REP-104: all zero means the whole image
  if (kind == ImageKind::kRectified && roi.do_rectify)
    throw BadCameraInfo(
        "roi.do_rectify gives the rectified image a region of its own, which is not supported: "
        "use image_raw, or publish the full image");
  w.x = roi.x;
  w.y = roi.y;
  w.width = roi.width;
  w.height = roi.height;
  return w;
}

// The full-resolution camera, before binning and region of interest.
Camera fullCamera(const ImageCalibration& calibration, ImageKind kind) {
  Camera camera;
  camera.width = calibration.width;
  camera.height = calibration.height;

  if (kind == ImageKind::kRectified) {
    if (allZero(calibration.p))
      throw BadCameraInfo(
          "P is all zero: image_rect needs the projection matrix; calibrate the camera, or use "
          "image_raw (rectified: false)");
    if (calibration.p[3] != 0 || calibration.p[7] != 0)
      throw BadCameraInfo(
          "P[3] or P[7] is not zero: this is the second camera of a stereo pair, whose rectified "
          "frame is not its own; use its image_raw, or the first camera");
    camera.fx = calibration.p[0];
    camera.cx = calibration.p[2];
    camera.fy = calibration.p[5];
    camera.cy = calibration.p[6];
  } else {
    if (allZero(calibration.k))
      throw BadCameraInfo(
          "K is all zero, which means uncalibrated: calibrate the camera (camera_calibration) or "
          "give its driver the calibration file");
    camera.fx = calibration.k[0];
    camera.cx = calibration.k[2];
    camera.fy = calibration.k[4];
    camera.cy = calibration.k[5];
    setDistortion(&camera, calibration.distortion_model, calibration.d.data(), calibration.d.size());
  }

  camera.check();
  return camera;
}

}  // namespace

Camera cameraOf(const ImageCalibration& calibration, ImageKind kind, int width, int height) {
  if (calibration.width == 0 || calibration.height == 0)
    throw BadCameraInfo("width or height is zero: the driver publishes no calibration");
  requireFinite(calibration.k, "K");
  requireFinite(calibration.d, "D");
  requireFinite(calibration.r, "R");
  requireFinite(calibration.p, "P");

  const PixelWindow window = windowOf(calibration, kind);
  if (window.width / window.bin_x != width || window.height / window.bin_y != height) {
    std::string expected = size(window.width / window.bin_x, window.height / window.bin_y);
    if (window.bin_x != 1 || window.bin_y != 1)
      expected +=
          " (binned " + size(window.bin_x, window.bin_y) + " from " + size(window.width, window.height) + ")";
    throw BadCameraInfo("the image is " + size(width, height) + " but camera_info describes " + expected +
                        ": use the calibration of this image size");
  }

  try {
    return fullCamera(calibration, kind).seenThrough(window);
  } catch (const BadCameraInfo&) {
    throw;
  } catch (const BadInput& e) {
    throw BadCameraInfo(e.what());
  }
}

Camera cameraOf(const ImageCalibration& calibration, ImageKind kind) {
  const PixelWindow window = windowOf(calibration, kind);
  return cameraOf(calibration, kind, window.width / window.bin_x, window.height / window.bin_y);
}

ImageCalibration calibrationOf(const Camera& camera) {
  ImageCalibration calibration;
  calibration.width = camera.width;
  calibration.height = camera.height;
  calibration.distortion_model = distortionName(camera);
  calibration.d.assign(camera.d.begin(), camera.d.begin() + distortionCount(camera));
  calibration.k = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  calibration.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  calibration.p = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return calibration;
}

ImageCalibration calibrationOf(const CameraFile& file) {
  ImageCalibration calibration = calibrationOf(file.camera);
  if (file.rectification) calibration.r = *file.rectification;
  if (file.projection) calibration.p = *file.projection;
  return calibration;
}

}  // namespace monocular_eye_hand
