#include "simulation/scenes/footprint.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace monocular_eye_hand {

Footprint footprint(const SceneObject& object, double grow) {
  std::vector<cv::Point> cells;
  for (const Eigen::Vector3d& p : object.mesh->vertices) {
    const Eigen::Vector3d q = object.world_from_object * p / kCell;
    cells.emplace_back(int(std::lround(q.x())), int(std::lround(q.y())));
  }

  const int margin = int(std::ceil(grow / kCell));
  const cv::Rect box = cv::boundingRect(cells);
  Footprint out{cv::Mat1b(box.height + 2 * margin, box.width + 2 * margin, uchar(0)),
                cv::Point(box.x - margin, box.y - margin)};

  for (const auto& triangle : object.mesh->triangles) {
    const cv::Point corners[3] = {cells[triangle[0]] - out.corner, cells[triangle[1]] - out.corner,
                                  cells[triangle[2]] - out.corner};
    cv::fillConvexPoly(out.mask, corners, 3, cv::Scalar(255));
  }

  if (margin > 0)
    cv::dilate(out.mask, out.mask,
               cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * margin + 1, 2 * margin + 1)));
  return out;
}

int sharedCells(const Footprint& a, const Footprint& b) {
  const cv::Rect box_a(a.corner, a.mask.size()), box_b(b.corner, b.mask.size());
  const cv::Rect both = box_a & box_b;
  if (both.empty()) return 0;
  return cv::countNonZero(a.mask(both - box_a.tl()) & b.mask(both - box_b.tl()));
}

double footprintOverlap(const SceneObject& a, const SceneObject& b) {
  const Footprint fa = footprint(a), fb = footprint(b);
  const int min_area = std::min(cv::countNonZero(fa.mask), cv::countNonZero(fb.mask));
  return min_area > 0 ? double(sharedCells(fa, fb)) / min_area : 0;
}

}  // namespace monocular_eye_hand
