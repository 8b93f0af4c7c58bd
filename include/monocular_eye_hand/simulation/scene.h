#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/geometry/look_at.h"
#include "monocular_eye_hand/geometry/rigid3.h"
#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/model/object_model.h"
#include "monocular_eye_hand/simulation/finish.h"

namespace monocular_eye_hand {

// The synthetic world that tests, demo and benchmarks share. World frame: metres, z up, the table's top is z
// = 0.

/// Solid procedural texture: a factor 1 +- amplitude on the albedo, a function of the point in the object's
/// frame.
struct Texture {
  enum class Kind { kPlain, kNoise, kChecker, kWood, kBricks };
  Kind kind = Kind::kPlain;
  double scale = 0.02;     ///< size of one check, brick or blotch; distance of the wood's rings [m]
  double amplitude = 0.2;  ///< 0..1
  uint32_t seed = 0;
};

/// Grey Lambert surface with a Blinn-Phong highlight.
struct Material {
  double albedo = 0.6;    ///< diffuse reflectance, 0..1
  double specular = 0.1;  ///< strength of the highlight, 0..1
  double shininess = 40;  ///< Blinn exponent
  Texture texture;
  std::shared_ptr<const Finish> finish{};  ///< prints, gloss, rounded edges...; null: none of them
};

/// Something that stands in the scene: a known part or clutter.
struct SceneObject {
  std::string name;
  int model = -1;  ///< index in the list of models the scene was made from (ModelBase::objects); -1: clutter
  std::shared_ptr<const Mesh> mesh;
  Rigid3 world_from_object;
  Material material;
};

/// Disc light that faces the world's origin: hard shadows with radius 0, soft ones else.
struct Light {
  Eigen::Vector3d position = {0.4, -0.5, 1.2};  ///< world [m]
  double radius = 0.15;                         ///< [m]
  double intensity = 1.0;  ///< irradiance at 1 m, perpendicular; falls with the square of the distance
};

struct Table {
  bool present = true;
  double half_width = 0.9, half_depth = 0.7;  ///< along x and y [m]
  Material material{0.45, 0.05, 20, {}};
};

/// What a mirroring surface sees where it reflects no object: brighter towards the sky, with lamps, windows
/// and dark corners.
struct Environment {
  struct Panel {
    Eigen::Vector3d direction = {0, 0, 1};       ///< its middle, world
    double half_width = 0.2, half_height = 0.2;  ///< at distance 1
    double softness = 0.05;                      ///< of its border, at distance 1
    double radiance = 1;
  };
  double low = 0.1, high = 0.4;  ///< radiance straight down and straight up
  std::vector<Panel> panels;     ///< later ones stand before earlier ones
};

struct Scene {
  std::vector<SceneObject> objects;
  Table table;
  std::vector<Light> lights;
  double ambient = 0.35;     ///< irradiance from everywhere
  double sky = 0;            ///< share of it that comes from above: 1: none from below
  double background = 0.15;  ///< radiance where a ray meets nothing
  Environment environment{};
  Rigid3 world_from_camera;

  Rigid3 cameraFromObject(int object) const {
    return world_from_camera.inverse() * objects[object].world_from_object;
  }
};

/// A mesh with its name: what a scene is made of.
struct NamedMesh {
  std::string name;
  std::shared_ptr<const Mesh> mesh;
};
std::vector<NamedMesh> namedMeshes(const ModelBase& models);

/// Closed meshes centred on their base: z from 0 to the height. `size`: along x, y, z [m].
Mesh boxMesh(const Eigen::Vector3d& size);
Mesh cylinderMesh(double radius, double height, int segments = 64);
Mesh coneMesh(double base_radius, double top_radius, double height, int segments = 64);
Mesh sphereMesh(double radius, int rings = 24);
/// One-sided sheet in z = 0, facing +z.
Mesh quadMesh(double width, double depth);

}  // namespace monocular_eye_hand
