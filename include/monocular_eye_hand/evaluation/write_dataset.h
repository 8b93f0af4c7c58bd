#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/evaluation/dataset.h"

namespace monocular_eye_hand {

// Writes what dataset.h reads. Everything throws BadInput naming the file that cannot be written.

/// A part of a data set that is to be written. `model` is in metres, the files in millimetres.
struct BopPart {
  int id = 0;  ///< BopModel::id, from 1 on
  ObjectModel model;
};

/// An object id per name: the number that every name ends with (obj_000012: 12) when all do and no two are
/// the same, else 1, 2, 3...
std::vector<int> bopIds(const std::vector<std::string>& names);

/// As models_info.json states them: the identity is left out. The format has no ball; one gets the three axes
/// of its frame.
BopSymmetries bopSymmetries(const ObjectModel& model);

/// Writes models/models_info.json and models/obj_NNNNNN.ply of the data set. Files that are there must hold
/// the same: BadInput else, since the truth that refers to them would become wrong.
void writeBopModels(const std::string& dataset_dir, const std::vector<BopPart>& parts);

/// Writes camera.json unless there is one: MSPD's thresholds refer to its width.
void writeBopCamera(const std::string& dataset_dir, const Camera& camera);

/// A truth with the counts of scene_gt_info.json.
struct WrittenTruth {
  GroundTruth truth;
  cv::Rect box_visible;  ///< [px]
  int pixels_all = 0;    ///< of the whole silhouette, as if nothing stood before it
  int pixels_visible = 0;
};

/// An image's camera (pinhole) and truth.
struct WrittenImage {
  int id = 0;
  Camera camera;
  std::vector<WrittenTruth> truth;
  std::optional<Rigid3> camera_from_world = std::nullopt;
};

/// One scene folder of a split: the images one by one, the truth of all of them at the end.
class BopSceneWriter {
 public:
  BopSceneWriter(const std::string& dataset_dir, const std::string& split, int scene);

  /// Writes gray/NNNNNN.png. Throws BadInput on a distorted camera (the format has none) and on an image of
  /// another size than the camera's.
  void add(const WrittenImage& image, const cv::Mat& grey);

  /// Writes scene_camera.json, scene_gt.json and scene_gt_info.json, and the scene's targets (visible to 10 %
  /// or more) into SPLIT_targets_bop19.json of the data set, where other scenes' targets stay.
  void finish() const;

 private:
  void writeTargets() const;

  std::string dataset_dir_, split_, scene_dir_;
  int scene_;
  std::vector<WrittenImage> images_;
};

}  // namespace monocular_eye_hand
