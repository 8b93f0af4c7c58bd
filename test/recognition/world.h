#pragma once
#include <gmock/gmock.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "evaluation/pose_error.h"
#include "monocular_eye_hand/io/camera_file.h"
#include "monocular_eye_hand/io/grey_image.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/recognition/recognizer.h"
#include "monocular_eye_hand/simulation/render/truth.h"
#include "recognition/reporting.h"
#include "support/camera.h"

namespace monocular_eye_hand {

inline std::string sourcePath(const std::string& relative) {
  return std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/" + relative;
}

inline std::string cacheFolder() { return testing::TempDir() + "/recognition_test_cache"; }

/// The five parts of config/objects.yaml, compiled once per program.
inline const ModelBase& shippedModels() {
  static const ModelBase models =
      loadModels(sourcePath("config/objects.yaml"), ModelDepth::kViews, {}, cacheFolder());
  return models;
}

/// A model base with some of the shipped parts, in the order named.
inline ModelBase someModels(const std::vector<std::string>& names) {
  ModelBase models;
  for (const std::string& name : names)
    models.objects.push_back(shippedModels().objects.at(size_t(shippedModels().indexOf(name))));
  return models;
}

inline const Recognizer& shippedRecognizer() {
  static const Recognizer recognizer(shippedModels());
  return recognizer;
}

inline const ObjectModel& shippedModel(const std::string& name) {
  return shippedModels().objects.at(size_t(shippedModels().indexOf(name))).model;
}

/// An image with its camera and what is in it.
struct Picture {
  cv::Mat grey;
  Camera camera;
  std::vector<TruthObject> truth;
};

/// `path` below data/ without ".png", e.g. "golden/bridge".
inline Picture shippedPicture(const std::string& path) {
  const std::string folder = path.substr(0, path.find('/')), name = path.substr(path.find('/') + 1);
  Picture picture;
  picture.grey = loadGreyImage(sourcePath("data/" + path + ".png"));
  picture.camera = loadCamera(
      sourcePath("data/" + folder + (name == "distorted" ? "/camera_distorted.yaml" : "/camera.yaml")));
  picture.truth = readTruth(sourcePath("data/" + path + ".truth.json"));
  return picture;
}

/// Largest projection distance of the model's vertices [px] and surface distance as a share of the diameter,
/// both modulo the symmetries of the model.
struct PoseError {
  double image = 0, surface = 0;
  double rotation = 0;     ///< [rad]
  double translation = 0;  ///< of the object's centre [m]
};

inline PoseError poseError(const ObjectModel& model, const Camera& camera, const Rigid3& estimate,
                           const Rigid3& truth) {
  BopSymmetries symmetries;
  symmetries.discrete.assign(model.symmetries.discrete.begin() + 1, model.symmetries.discrete.end());
  if (model.symmetries.axis) symmetries.continuous.push_back(*model.symmetries.axis);
  const std::vector<Rigid3> equal = discretized(symmetries);
  PoseError error;
  error.image = mspd(estimate, truth, camera.intrinsics(), model.mesh.vertices, equal);
  error.surface = mssd(estimate, truth, model.mesh.vertices, equal) / model.diameter;
  const Rigid3 near = nearestEqualPose(model, estimate, truth);
  error.rotation = angleBetween(near.rotation, truth.rotation);
  error.translation = (near * model.centre() - truth * model.centre()).norm();
  return error;
}

inline std::string listed(const RecognitionResult& result) {
  std::string text;
  for (const ObjectEstimate& o : result.objects) {
    const Eigen::Vector3d& t = o.camera_from_object.translation;
    text += "  " + o.name + " at (" + std::to_string(t.x()) + ", " + std::to_string(t.y()) + ", " +
            std::to_string(t.z()) + "), probability " + std::to_string(o.probability) + ", " + o.reason +
            "\n";
  }
  return text.empty() ? "  nothing: " + result.reason + "\n" : text;
}

/// A rendered scene: objects on a plain table, one light.
inline Scene plainScene(std::vector<SceneObject> objects, const Rigid3& world_from_camera) {
  Scene scene;
  scene.objects = std::move(objects);
  scene.lights = {Light{}};
  scene.world_from_camera = world_from_camera;
  return scene;
}

inline SceneObject standing(const std::string& name, const Mesh& mesh,
                            const Rigid3& world_from_object = Rigid3{}) {
  SceneObject object;
  object.name = name;
  object.model = 0;
  object.mesh = std::make_shared<Mesh>(mesh);
  object.world_from_object = world_from_object;
  return object;
}

inline Camera testCamera() { return centredCamera(640, 480, 700); }

}  // namespace monocular_eye_hand
