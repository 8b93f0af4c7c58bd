#pragma once
#include <string>
#include <vector>

#include "support/random.h"

namespace monocular_eye_hand {

/// Three object points (columns) and their unit bearings under the pose `truth` (camera_from_object). No
/// noise but rounding unless its set says so.
struct P3PProblem {
  Eigen::Matrix3d points, bearings;
  Rigid3 truth;
};

struct P3PSet {
  std::string name;
  int count;  ///< how many problems the accuracy is counted on
  P3PProblem (*draw)(Random& random, double parameter);
  double parameter;
  double noise = 0;  ///< standard deviation added to each coordinate of the bearings
};

/// The sets of problems on which three-point solvers are compared:
///   general              70 degrees of view, each point 0.5-10 away
///   far<D>               any triangle D times its longest side away
///   box_corner           a right angle of a box, 4-30 m away, sides 0.3-1 m
///   symmetric            equilateral or isosceles triangles seen along their mirror plane, exactly
///   collinear<h>         base 1, altitude h
///   danger<e>            the lens off the cylinder over the triangle's circle by the share e of its radius
/// and some of them with noise.
const std::vector<P3PSet>& p3pSets();
std::vector<P3PProblem> drawProblems(const P3PSet& set, int count);
const P3PSet& p3pSet(const std::string& name);

/// max(|R - R_true|_F, |t - t_true| / |t_true|).
double poseError(const Rigid3& pose, const Rigid3& truth);

}  // namespace monocular_eye_hand
