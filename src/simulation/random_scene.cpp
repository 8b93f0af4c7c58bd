#include "monocular_eye_hand/simulation/random_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "footprint.h"
#include "monocular_eye_hand/geometry/error.h"
#include "random.h"
#include "random_look.h"

namespace monocular_eye_hand {
namespace {

struct LevelRule {
  int min_parts, max_parts, min_clutter, max_clutter;
  double spread;                        // objects stand within +- spread of the middle [m]
  double gap;                           // least distance between two [m]
  double texture;                       // amplitude of the table's texture
  double min_elevation, max_elevation;  // of the camera [degrees]
};

LevelRule ruleOf(SceneLevel level) {
  switch (level) {
    case SceneLevel::kEasy:
      return {1, 3, 0, 0, 0.15, 0.020, 0.0, 32, 78};
    case SceneLevel::kMedium:
      return {3, 5, 1, 3, 0.18, 0.008, 0.3, 28, 75};
    case SceneLevel::kHard:
      break;
  }
  return {4, 7, 4, 8, 0.17, 0.002, 0.5, 25, 65};
}

SceneObject randomPiece(Generator* random) {
  SceneObject piece;
  piece.name = "clutter";
  const double s = random->uniform(0.015, 0.045);
  switch (random->integer(0, 4)) {
    case 0:
      piece.mesh = std::make_shared<Mesh>(
          boxMesh({2 * s, 2 * s * random->uniform(0.4, 1.5), 2 * s * random->uniform(0.4, 1.5)}));
      break;
    case 1:
      piece.mesh = std::make_shared<Mesh>(cylinderMesh(s, s * random->uniform(0.5, 4)));
      break;
    case 2:
      piece.mesh =
          std::make_shared<Mesh>(coneMesh(s, s * random->uniform(0.2, 0.8), s * random->uniform(1, 3)));
      break;
    case 3:
      piece.mesh = std::make_shared<Mesh>(sphereMesh(s));
      break;
    default: {
      // A printed sheet: thin enough to count as flat, thick enough to be above the table.
      piece.mesh = std::make_shared<Mesh>(boxMesh({3 * s, 4 * s, 0.0005}));
      break;
    }
  }
  piece.material = randomMaterial(random);
  if (random->integer(0, 2) > 0) piece.material.texture = randomTexture(random, 0.6);
  return piece;
}

/// Finds a free place on the table; false when there is none.
class Placer {
 public:
  Placer(Generator* random, double spread, double gap) : random_(random), spread_(spread), gap_(gap) {}
  bool place(SceneObject* object, const Rigid3& table_from_object) {
    for (int attempt = 0; attempt < 60; ++attempt) {
      Rigid3 turned{expSO3({0, 0, random_->uniform(0, 2 * M_PI)}),
                    {random_->uniform(-spread_, spread_), random_->uniform(-spread_, spread_), 0}};
      object->world_from_object = turned * table_from_object;
      const Footprint grown = footprint(*object, gap_);
      const auto hits = [&](const Footprint& other) { return sharedCells(grown, other) > 0; };
      if (std::any_of(taken_.begin(), taken_.end(), hits)) continue;
      taken_.push_back(footprint(*object));
      return true;
    }
    return false;
  }

 private:
  Generator* random_;
  double spread_, gap_;
  std::vector<Footprint> taken_;
};

void aimCamera(Generator* random, const RandomSceneOptions& options, const LevelRule& rule, Scene* scene) {
  const double degree = M_PI / 180;
  const Eigen::Vector3d target(random->uniform(-0.03, 0.03), random->uniform(-0.03, 0.03), 0.03);
  scene->world_from_camera = lookFrom(
      random->uniform(0, 2 * M_PI), random->uniform(rule.min_elevation, rule.max_elevation) * degree,
      random->uniform(options.min_distance, options.max_distance), target, random->uniform(-25, 25) * degree);
}

}  // namespace

void RandomSceneOptions::check() const {
  const auto refuse = [](const std::string& field, double value, const std::string& rule) {
    throw BadInput("random scene options: " + field + " = " + std::to_string(value) + " " + rule);
  };
  if (parts < -1 || parts > 1000) refuse("parts", parts, "must be -1..1000");
  if (clutter < -1 || clutter > 1000) refuse("clutter", clutter, "must be -1..1000");
  if (!(min_distance > 0.05)) refuse("min_distance", min_distance, "must be above 0.05 m");
  if (!(max_distance >= min_distance)) refuse("max_distance", max_distance, "must be at least min_distance");
}

Scene randomScene(const std::vector<NamedMesh>& models, uint32_t seed, const RandomSceneOptions& options) {
  options.check();
  const LevelRule rule = ruleOf(options.level);
  Generator random(seed);
  const int parts = options.parts >= 0 ? options.parts : random.integer(rule.min_parts, rule.max_parts);
  const int clutter =
      options.clutter >= 0 ? options.clutter : random.integer(rule.min_clutter, rule.max_clutter);
  if (parts > 0 && models.empty()) throw BadInput("random scene: no models to choose the parts from");
  Scene scene;
  scene.table.material = randomMaterial(&random);
  scene.table.material.specular *= 0.1;
  scene.table.material.texture = randomTexture(&random, rule.texture);
  Placer placer(&random, rule.spread, rule.gap);
  for (int k = 0; k < parts; ++k) {
    const int model = random.integer(0, int(models.size()) - 1);
    if (!models[model].mesh) throw BadInput("random scene: model '" + models[model].name + "' has no mesh");
    SceneObject object{models[model].name, model, models[model].mesh, {}, randomMaterial(&random)};
    if (options.level == SceneLevel::kEasy) standOut(&object.material, scene.table.material.albedo);
    if (placer.place(&object, drawPose(stablePoses(*object.mesh), &random))) scene.objects.push_back(object);
  }
  for (int k = 0; k < clutter; ++k) {
    SceneObject piece = randomPiece(&random);
    if (placer.place(&piece, Rigid3{})) scene.objects.push_back(piece);
  }
  addLights(&random, &scene);
  aimCamera(&random, options, rule, &scene);
  return scene;
}

Scene randomScene(const std::vector<NamedMesh>& models, uint32_t seed, SceneLevel level) {
  RandomSceneOptions options;
  options.level = level;
  return randomScene(models, seed, options);
}

Scene randomClutter(uint32_t seed, int pieces) {
  RandomSceneOptions options;
  options.level = SceneLevel::kMedium;
  options.parts = 0;
  options.clutter = pieces;
  return randomScene({}, seed, options);
}

}  // namespace monocular_eye_hand
