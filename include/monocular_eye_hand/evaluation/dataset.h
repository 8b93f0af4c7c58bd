#pragma once
#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

// The BOP data set format (thodan/bop_toolkit, docs/bop_datasets_format.md). Its files are in millimetres,
// this code in metres.

/// An object's symmetries as models_info.json states them.
struct BopSymmetries {
  std::vector<Rigid3>
      discrete;  ///< object_from_object; the identity is not listed. Not always exact rotations
  std::vector<SymmetryAxis> continuous;
  bool any() const { return !discrete.empty() || !continuous.empty(); }
};

struct BopModel {
  int id = 0;
  std::string name;       ///< "name" of models_info.json, else obj_<id>
  std::string mesh_path;  ///< obj_NNNNNN.ply
  double diameter = 0;    ///< [m]
  BopSymmetries symmetries;
  std::vector<Eigen::Vector3d> vertices;  ///< [m]
};
using BopModels = std::map<int, BopModel>;  ///< by object id

struct GroundTruth {
  int object = 0;  ///< BopModel::id
  Rigid3 camera_from_object;
  double visible = 1;  ///< visible share of its silhouette (visib_fract); 1 without scene_gt_info.json
};

struct BopImage {
  int scene = 0;
  int id = 0;
  std::string path;  ///< "" when the image file is missing
  Eigen::Matrix3d intrinsics = Eigen::Matrix3d::Identity();
  std::optional<Rigid3>
      camera_from_world;  ///< cam_R_w2c, cam_t_w2c of scene_camera.json, where they are there
  std::vector<GroundTruth> truth;
};

/// A split: its images by (scene, image id).
struct BopSplit {
  std::vector<BopImage> images;  ///< ascending by scene and id
  int width = 0;  ///< of the data set's images, from camera.json, else from the first image [px]
  const BopImage* find(int scene, int id) const;
};

/// How many instances of an object an image's task asks for.
struct BopTarget {
  int scene = 0, image = 0, object = 0, count = 0;
};

/// Reads models_info.json and the meshes it names. Throws BadInput.
BopModels loadBopModels(const std::string& models_dir);
/// Reads `split` of the data set: scene_camera.json, scene_gt.json, scene_gt_info.json (if there) and finds
/// the images in gray/ or rgb/. `scenes` and `images` restrict it where they are not empty. Throws BadInput.
BopSplit loadBopSplit(const std::string& dataset_dir, const std::string& split,
                      const std::vector<int>& scenes = {}, const std::vector<int>& images = {});
/// Reads a target list of the BOP'19 form (with object ids and counts). Throws BadInput.
std::vector<BopTarget> loadBopTargets(const std::string& path);
/// The targets of a split without a list: every instance with visib_fract >= min_visible.
std::vector<BopTarget> visibleTargets(const BopSplit& split, double min_visible = 0.1);
/// The image as 8-bit grey. Throws BadInput naming the file when it is missing or unreadable.
cv::Mat loadBopImage(const BopImage& image);
/// The pinhole camera of an image. Throws BadInput on skew or an implausible matrix.
Camera bopCamera(const BopImage& image, int width, int height);

}  // namespace monocular_eye_hand
