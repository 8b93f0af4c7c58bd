#pragma once
#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// A pose without any zero or symmetry.
inline Rigid3 somePose(double x = 0.12) { return {expSO3({0.4, -1.1, 0.7}), {x, -0.34, 0.56}}; }

/// A covariance whose transpose or another order is another one.
inline Matrix6d someCovariance() {
  Matrix6d root = Matrix6d::Identity() * 0.01;
  root(1, 0) = 0.002;
  root(5, 2) = -0.003;
  return root * root.transpose();
}

inline ModelBase twoObjects() {
  ModelBase models;
  models.objects.resize(2);
  models.objects[0].model.name = "bridge";
  models.objects[1].model.name = "frame";
  return models;
}

}  // namespace monocular_eye_hand
