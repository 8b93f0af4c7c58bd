#pragma once
#include "p3p_problems.h"

namespace monocular_eye_hand {

/// cv::solveP3P with SOLVEPNP_AP3P (Ke & Roumeliotis, CVPR 2017) as a caller uses it: normalised image points
/// and the identity as camera matrix in, rotation vectors and translations out.
class Ap3pPeer {
 public:
  Ap3pPeer();
  Ap3pPeer(const Ap3pPeer&) = delete;
  Ap3pPeer& operator=(const Ap3pPeer&) = delete;
  ~Ap3pPeer();
  int solve(const P3PProblem& problem);
  /// The poses of the last call as transforms; untimed.
  std::vector<Rigid3> poses() const;

 private:
  struct Buffers;
  Buffers* buffers_;
};

}  // namespace monocular_eye_hand
