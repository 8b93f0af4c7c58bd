#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/outcomes.h"

namespace monocular_eye_hand {

/// A cube of 100 mm about the origin, no symmetry declared: at 1 m and f = 1000 px a shift of s mm across is
/// an MSPD of s / 0.95 px (its near face stands at 0.95 m).
inline BopModel cubeModel(int id, const std::string& name) {
  BopModel model;
  model.id = id;
  model.name = name;
  for (int i = 0; i < 8; ++i)
    model.vertices.emplace_back(i & 1 ? 0.05 : -0.05, i & 2 ? 0.05 : -0.05, i & 4 ? 0.05 : -0.05);
  model.diameter = 0.1 * std::sqrt(3.0);
  return model;
}

inline Rigid3 at(double x_mm, double y_mm, double z_mm) {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(x_mm, y_mm, z_mm) * 1e-3};
}

/// Objects 1 "block" and 2 "lid", both cubes of 100 mm. f = 1000 px.
struct MadeUpRun {
  MadeUpRun() {
    models[1] = cubeModel(1, "block");
    models[2] = cubeModel(2, "lid");
    split.width = 640;
  }

  BopImage& image(int scene, int id) {
    BopImage made;
    made.scene = scene;
    made.id = id;
    made.intrinsics << 1000, 0, 319.5, 0, 1000, 239.5, 0, 0, 1;
    split.images.push_back(made);
    return split.images.back();
  }
  static void truth(BopImage* image, int object, const Rigid3& pose, double visible = 1) {
    image->truth.push_back({object, pose, visible});
  }
  void row(int scene, int image, int object, double score, const Rigid3& pose) {
    results.push_back({scene, image, object, score, pose, 0.5});
  }
  void judge(int scene, int image, int object, double probability, const Rigid3& pose, JudgedPose::Fate fate,
             const std::string& against = "") {
    JudgedPose made;
    made.scene = scene;
    made.image = image;
    made.object = object;
    made.probability = probability;
    made.camera_from_object = pose;
    made.fate = fate;
    made.against = against;
    judged.push_back(made);
  }
  RunOutcomes outcomes() const { return judgeRun(split, models, results); }
  std::vector<JudgedPose> poses() const { return measured(judged, split, models); }

  BopModels models;
  BopSplit split;
  std::vector<BopResult> results;
  std::vector<JudgedPose> judged;
};

}  // namespace monocular_eye_hand
