#pragma once
#include <memory>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/simulation/cell/work_cell.h"
#include "monocular_eye_hand/simulation/render/rendered_image.h"

namespace monocular_eye_hand {

constexpr int kArmId = -3;  ///< in CellImage::ids, beside kTableId and kNothingId

struct CellImage {
  cv::Mat grey;     ///< CV_8UC1, raw (distorted) pixels
  cv::Mat ids;      ///< CV_16SC1: object at the pixel's centre (CellScene::scene.objects); kTableId, kArmId,
                    ///< kNothingId
  cv::Mat depth;    ///< CV_32FC1: z in the camera frame at the pixel's centre [m]; 0 where nothing is hit
  double time = 0;  ///< stamp: cell time of the exposure [s]
  Rigid3 base_from_camera;  ///< at the stamp
  double exposure = 0;      ///< the one used
};

/// The wrist camera of a cell: the look of renderScene at a small part of its time. The geometry is prepared
/// once; a frame only places it. One ray per pixel, sixteen where surfaces meet. One shadow ray per pixel and
/// light, four where a shadow ends sharply; neighbours on the same surface share them (interleaved sampling:
/// A. Keller and W. Heidrich, EGWR 2001). The same cell state and options give the same image whatever the
/// number of threads. The shutter is infinitely short: no motion blur.
class CellCamera {
 public:
  /// For cells made of this cell's scene and arm. `threads`: 0 takes as many as the machine has cores. Throws
  /// BadInput when threads is negative.
  explicit CellCamera(const WorkCell& cell, int threads = 0);
  ~CellCamera();
  CellCamera(CellCamera&&) noexcept;

  const Camera& camera() const;
  /// An exposure of the cell as it stands now.
  CellImage capture(const WorkCell& cell);
  /// The grey image alone. A cell of which nothing to be seen has changed is not rendered again: its image
  /// would be the same. Good until the next call.
  const cv::Mat& grey(const WorkCell& cell);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace monocular_eye_hand
