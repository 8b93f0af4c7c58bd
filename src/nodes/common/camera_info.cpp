#include "nodes/common/camera_info.h"

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

PixelWindow windowOf(const sensor_msgs::CameraInfo& info, ImageKind kind) {
  PixelWindow w;
  w.bin_x = std::max(1, int(info.binning_x));
  w.bin_y = std::max(1, int(info.binning_y));
  w.width = int(info.width);
  w.height = int(info.height);
  const sensor_msgs::RegionOfInterest& roi = info.roi;
  if (roi.width == 0 && roi.height == 0) return w;  // REP-104: all zero means the whole image
  if (kind == ImageKind::kRectified && roi.do_rectify)
    throw BadCameraInfo(
        "roi.do_rectify gives the rectified image a region of its own, which is not supported: "
        "use image_raw, or publish the full image");
  w.x = int(roi.x_offset);
  w.y = int(roi.y_offset);
  w.width = int(roi.width);
  w.height = int(roi.height);
  return w;
}

// The full-resolution camera, before binning and region of interest.
Camera fullCamera(const sensor_msgs::CameraInfo& info, ImageKind kind) {
  Camera camera;
  camera.width = int(info.width);
  camera.height = int(info.height);

  if (kind == ImageKind::kRectified) {
    if (allZero(info.P))
      throw BadCameraInfo(
          "P is all zero: image_rect needs the projection matrix; calibrate the camera, or use "
          "image_raw (rectified: false)");
    if (info.P[3] != 0 || info.P[7] != 0)
      throw BadCameraInfo(
          "P[3] or P[7] is not zero: this is the second camera of a stereo pair, whose rectified "
          "frame is not its own; use its image_raw, or the first camera");
    camera.fx = info.P[0];
    camera.cx = info.P[2];
    camera.fy = info.P[5];
    camera.cy = info.P[6];
  } else {
    if (allZero(info.K))
      throw BadCameraInfo(
          "K is all zero, which means uncalibrated: calibrate the camera (camera_calibration) or "
          "give its driver the calibration file");
    camera.fx = info.K[0];
    camera.cx = info.K[2];
    camera.fy = info.K[4];
    camera.cy = info.K[5];
    setDistortion(&camera, info.distortion_model, info.D.data(), info.D.size());
  }

  camera.check();
  return camera;
}

}  // namespace

Camera cameraFromInfo(const sensor_msgs::CameraInfo& info, ImageKind kind, int width, int height) {
  if (info.width == 0 || info.height == 0)
    throw BadCameraInfo("width or height is zero: the driver publishes no calibration");
  requireFinite(info.K, "K");
  requireFinite(info.D, "D");
  requireFinite(info.R, "R");
  requireFinite(info.P, "P");

  const PixelWindow window = windowOf(info, kind);
  if (window.width / window.bin_x != width || window.height / window.bin_y != height) {
    std::string expected = size(window.width / window.bin_x, window.height / window.bin_y);
    if (window.bin_x != 1 || window.bin_y != 1)
      expected +=
          " (binned " + size(window.bin_x, window.bin_y) + " from " + size(window.width, window.height) + ")";
    throw BadCameraInfo("the image is " + size(width, height) + " but camera_info describes " + expected +
                        ": use the calibration of this image size");
  }

  try {
    return fullCamera(info, kind).seenThrough(window);
  } catch (const BadCameraInfo&) {
    throw;
  } catch (const BadInput& e) {
    throw BadCameraInfo(e.what());
  }
}

Camera cameraFromInfo(const sensor_msgs::CameraInfo& info, ImageKind kind) {
  const PixelWindow window = windowOf(info, kind);
  return cameraFromInfo(info, kind, window.width / window.bin_x, window.height / window.bin_y);
}

sensor_msgs::CameraInfo toCameraInfo(const Camera& camera) {
  sensor_msgs::CameraInfo info;
  info.width = uint32_t(camera.width);
  info.height = uint32_t(camera.height);
  info.distortion_model = distortionName(camera);
  info.D.assign(camera.d.begin(), camera.d.begin() + distortionCount(camera));
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

sensor_msgs::CameraInfo toCameraInfo(const CameraFile& file) {
  sensor_msgs::CameraInfo info = toCameraInfo(file.camera);
  if (file.rectification) std::copy(file.rectification->begin(), file.rectification->end(), info.R.begin());
  if (file.projection) std::copy(file.projection->begin(), file.projection->end(), info.P.begin());
  return info;
}

}  // namespace monocular_eye_hand
