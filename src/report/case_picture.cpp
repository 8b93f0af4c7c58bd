#include "report/case_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace monocular_eye_hand {
namespace {

constexpr int kPanelWidth = 480, kPanelHeight = 360;  // of one crop in the picture
constexpr double kMargin = 0.3;                       // around the outlines, of their size
constexpr double kSmallestCrop = 100;                 // [raw px]
constexpr double kFar = 1e4;                          // no box reaches beyond [px]

constexpr size_t kManyEdges = 60;  // of a model that is drawn with thin lines

using Box = Eigen::AlignedBox2d;

// Of the vertices in front of the camera; raw pixels.
Box boxOf(const Outline& outline, const Camera& camera) {
  Box box;
  for (const Eigen::Vector3d& x : outline.model->mesh.vertices) {
    const Eigen::Vector3d p = outline.camera_from_object * x;
    if (!(p.z() > 1e-3)) continue;
    const Eigen::Vector2d uv = camera.distort(camera.project(p));
    if (uv.allFinite() && uv.cwiseAbs().maxCoeff() < kFar) box.extend(uv);
  }
  return box;
}

Box grown(const Box& box, double share) {
  const Eigen::Vector2d more = Eigen::Vector2d::Constant(share * box.sizes().maxCoeff());
  return {box.min() - more, box.max() + more};
}

// The box with a margin, in the panel's proportions, moved and cut into the image.
cv::Rect cropAround(const Box& box, cv::Size image) {
  const cv::Rect whole({0, 0}, image);
  if (box.isEmpty()) return whole;
  const Box wide = grown(box, kMargin);
  const double proportion = double(kPanelWidth) / kPanelHeight;
  double width = std::max({wide.sizes().x(), wide.sizes().y() * proportion, kSmallestCrop});
  width = std::min({width, double(image.width), image.height * proportion});
  const double height = width / proportion;
  const Eigen::Vector2d middle = wide.center();
  const double x = std::clamp(middle.x() - width / 2, 0.0, image.width - width);
  const double y = std::clamp(middle.y() - height / 2, 0.0, image.height - height);
  return cv::Rect(int(x), int(y), int(width), int(height)) & whole;
}

cv::Mat panel(const cv::Mat& picture) {
  cv::Mat resized;
  const bool smaller = picture.cols > kPanelWidth;
  cv::resize(picture, resized, {kPanelWidth, kPanelHeight}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_CUBIC);
  return resized;
}

}  // namespace

cv::Mat casePicture(const CameraImage& image, const std::vector<Outline>& outlines) {
  Box box;
  if (!outlines.empty()) box = boxOf(outlines.front(), image.camera);
  const Box near = box.isEmpty() ? box : grown(box, 1);
  for (size_t k = 1; k < outlines.size(); ++k) {
    const Box other = boxOf(outlines[k], image.camera);
    if (!other.isEmpty() && !near.isEmpty() && near.contains(other)) box.extend(other);
  }
  const cv::Rect crop = cropAround(box, image.grey.size());

  // Drawn at the size that it is shown in, so that lines keep their width.
  const int scale = std::clamp((kPanelWidth + crop.width - 1) / crop.width, 1, 8);
  const PictureSize size{scale * image.grey.cols, std::numeric_limits<int>::max()};  // cut to a part
  Canvas canvas(image.grey, image.camera, 0.85, size);
  const cv::Rect drawn(crop.x * canvas.scale(), crop.y * canvas.scale(), crop.width * canvas.scale(),
                       crop.height * canvas.scale());
  for (size_t k = outlines.size(); k-- > 0;) {
    ObjectStyle style;
    style.colour = outlines[k].colour;
    style.width = outlines[k].model->edges.size() > kManyEdges ? 1 : 2;
    style.axes = false;
    drawObject(&canvas, *outlines[k].model, outlines[k].camera_from_object, style);
  }

  cv::Mat plain, both;
  cv::cvtColor(image.grey(crop), plain, cv::COLOR_GRAY2BGR);
  cv::hconcat(panel(plain), panel(canvas.picture()(drawn)), both);
  return both;
}

}  // namespace monocular_eye_hand
