#include "p3p_peer.h"

#include <opencv2/calib3d.hpp>

namespace monocular_eye_hand {

struct Ap3pPeer::Buffers {
  std::vector<cv::Point3d> points{3};
  std::vector<cv::Point2d> image{3};
  std::vector<cv::Mat> rotations, translations;
  const cv::Matx33d intrinsics = cv::Matx33d::eye();
};

Ap3pPeer::Ap3pPeer() : buffers_(new Buffers) { cv::setNumThreads(1); }
Ap3pPeer::~Ap3pPeer() { delete buffers_; }

int Ap3pPeer::solve(const P3PProblem& p) {
  for (int i = 0; i < 3; ++i) {
    buffers_->points[size_t(i)] = {p.points(0, i), p.points(1, i), p.points(2, i)};
    buffers_->image[size_t(i)] = {p.bearings(0, i) / p.bearings(2, i), p.bearings(1, i) / p.bearings(2, i)};
  }
  buffers_->rotations.clear();
  buffers_->translations.clear();
  return cv::solveP3P(buffers_->points, buffers_->image, buffers_->intrinsics, cv::noArray(),
                      buffers_->rotations, buffers_->translations, cv::SOLVEPNP_AP3P);
}

std::vector<Rigid3> Ap3pPeer::poses() const {
  std::vector<Rigid3> poses(buffers_->rotations.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    cv::Matx33d r;
    cv::Rodrigues(buffers_->rotations[i], r);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) poses[i].rotation(a, b) = r(a, b);
      poses[i].translation[a] = buffers_->translations[i].at<double>(a);
    }
  }
  return poses;
}

}  // namespace monocular_eye_hand
