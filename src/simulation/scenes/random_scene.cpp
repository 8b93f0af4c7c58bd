#include "monocular_eye_hand/simulation/scenes/random_scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/random.h"
#include "monocular_eye_hand/mesh/stable_poses.h"
#include "simulation/scenes/appearance.h"
#include "simulation/scenes/clutter.h"
#include "simulation/scenes/footprint.h"
#include "simulation/scenes/random_draws.h"
#include "simulation/scenes/settling.h"

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

/// About the largest distance between two vertices [m].
double diameterOf(const NamedMesh& model) {
  if (!model.mesh) throw BadInput("random scene: model '" + model.name + "' has no mesh");
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : model.mesh->vertices) box.extend(p);
  double radius = 0;
  for (const Eigen::Vector3d& p : model.mesh->vertices) radius = std::max(radius, (p - box.center()).norm());
  return 2 * radius;
}

/// What of the arrangement depends on the parts' size and on the camera.
struct Layout {
  std::vector<int> models;   // the parts are drawn from these
  std::vector<int> foreign;  // and the foreign ones from these of RandomSceneOptions::foreign
  double scale = 1;          // of everything around the parts
  double distance = 0;       // eye to the middle; 0: to be drawn
  double spread = 0;         // of the parts [m]
  double target_shift = 0.03;
};

std::vector<int> similarModels(const std::vector<NamedMesh>& models, double diameter, double ratio) {
  std::vector<int> out;
  for (size_t k = 0; k < models.size(); ++k) {
    const double relative = diameterOf(models[k]) / diameter;
    if (relative <= ratio && relative >= 1 / ratio) out.push_back(int(k));
  }
  return out;
}

std::vector<int> allModels(const std::vector<NamedMesh>& models) {
  std::vector<int> out;
  for (size_t k = 0; k < models.size(); ++k) out.push_back(int(k));
  return out;
}

Layout drawLayout(Generator* random, const std::vector<NamedMesh>& models, const RandomSceneOptions& options,
                  const LevelRule& rule) {
  constexpr double kUsualDiameter = 0.1;  // that the levels' lengths are meant for [m]
  Layout layout;
  layout.spread = rule.spread;
  const PartSize& size = options.size;
  const std::vector<NamedMesh>& references = models.empty() ? options.foreign : models;
  if (size.focal_length <= 0 || references.empty()) {
    layout.models = allModels(models);
    layout.foreign = allModels(options.foreign);
    return layout;
  }

  const double diameter = diameterOf(references[size_t(random->integer(0, int(references.size()) - 1))]);
  layout.models = similarModels(models, diameter, size.ratio);
  layout.foreign = similarModels(options.foreign, diameter, 1.5 * size.ratio);
  layout.scale = diameter / kUsualDiameter;

  const double share = random->uniform(0, 1);  // small and large alike: uniform in the logarithm
  const double pixels =
      size.min_pixels * std::pow(size.max_pixels / size.min_pixels, share) * size.width / 640.0;
  layout.distance = size.focal_length * diameter / pixels;
  const double half_view = 0.5 * diameter * size.width / pixels;
  layout.spread = std::min(rule.spread * layout.scale, std::max(0.3 * diameter, half_view - 0.6 * diameter));
  layout.target_shift = std::min(0.03 * layout.scale, 0.15 * half_view);
  return layout;
}

void aimCamera(Generator* random, const RandomSceneOptions& options, const LevelRule& rule,
               const Layout& layout, Scene* scene) {
  const double degree = M_PI / 180, shift = layout.target_shift;
  const double y = random->uniform(-shift, shift), x = random->uniform(-shift, shift);
  const double roll = random->uniform(-25, 25) * degree;
  const double drawn = random->uniform(options.min_distance, options.max_distance);
  const double elevation = random->uniform(rule.min_elevation, rule.max_elevation) * degree;
  const double azimuth = random->uniform(0, 2 * M_PI);
  const double distance = layout.distance > 0 ? layout.distance : drawn;
  scene->world_from_camera = lookFrom(azimuth, elevation, distance, {x, y, 0.03 * layout.scale}, roll);
}

void scaleSurroundings(double scale, double distance, Scene* scene) {
  for (Light& light : scene->lights) {
    light.position *= scale;
    light.radius *= scale;
    light.intensity *= scale * scale;  // the irradiance at the parts stays
  }
  const double table = std::max(scale, distance / 0.85);
  scene->table.half_width *= table;
  scene->table.half_depth *= table;
  scene->table.material.texture.scale *= scale;
}

/// What a pixel covers in the middle of the table [m].
double pixelSize(const RandomSceneOptions& options, const Layout& layout, const Scene& scene) {
  constexpr double kUsualFocal = 700;  // [px]
  const double distance = layout.distance > 0 ? layout.distance : scene.world_from_camera.translation.norm();
  return distance / (options.size.focal_length > 0 ? options.size.focal_length : kUsualFocal);
}

/// Large things behind the parts, as they stand about on a table.
void addBystanders(Generator* random, const Layout& layout, Scene* scene) {
  const int count = random->integer(0, 3);
  for (int k = 0; k < count; ++k) {
    ClutterPiece piece = simplePiece(random, layout.scale * random->uniform(2, 4));
    Eigen::Vector2d away = -scene->world_from_camera.translation.head<2>().normalized();
    away = Eigen::Rotation2Dd(random->uniform(-0.9, 0.9)) * away;
    const double reach = layout.spread + layout.scale * random->uniform(0.25, 0.6);
    const Rigid3 place{expSO3({0, 0, random->uniform(0, 2 * M_PI)}), {reach * away.x(), reach * away.y(), 0}};
    piece.object.world_from_object = place * piece.table_from_object;
    scene->objects.push_back(piece.object);
  }
}

/// Let down onto the others at a random place, lying flat or leaning a little.
void pile(Generator* random, double spread, SceneObject* object, const std::vector<SceneObject>& others) {
  const bool leaning = random->integer(0, 1) == 1;
  const double tilt = leaning ? random->uniform(3, 25) * M_PI / 180 : 0;
  const double axis = random->uniform(0, 2 * M_PI);
  const Rigid3 tilted{expSO3(tilt * Eigen::Vector3d(std::cos(axis), std::sin(axis), 0)), {0, 0, 0}};
  const Rigid3 placed{expSO3({0, 0, random->uniform(0, 2 * M_PI)}),
                      {random->uniform(-spread, spread), random->uniform(-spread, spread), 10}};
  object->world_from_object = placed * tilted * object->world_from_object;
  std::vector<const SceneObject*> below;
  for (const SceneObject& other : others) below.push_back(&other);
  object->world_from_object.translation.z() -= dropHeight(*object, below);
}

SceneObject drawPart(Generator* random, const std::vector<NamedMesh>& models,
                     const std::vector<int>& choice) {
  const int model = choice[size_t(random->integer(0, int(choice.size()) - 1))];
  const NamedMesh& named = models[size_t(model)];
  if (!named.mesh) throw BadInput("random scene: model '" + named.name + "' has no mesh");
  return {named.name, model, named.mesh, {}, randomMaterial(random)};
}

}  // namespace

void RandomSceneOptions::check() const {
  const auto refuse = [](const std::string& field, double value, const std::string& rule) {
    throw BadInput(fmt::format("random scene options: {} = {:g} {}", field, value, rule));
  };
  if (parts < -1 || parts > 1000) refuse("parts", parts, "must be -1..1000");
  if (clutter < -1 || clutter > 1000) refuse("clutter", clutter, "must be -1..1000");
  if (!(min_distance > 0.05)) refuse("min_distance", min_distance, "must be above 0.05 m");
  if (!(max_distance >= min_distance)) refuse("max_distance", max_distance, "must be at least min_distance");
  if (!(size.focal_length >= 0))
    refuse("size.focal_length", size.focal_length, "must be >= 0 px (0: unused)");
  if (size.width < 1) refuse("size.width", size.width, "must be positive");
  if (!(size.min_pixels > 1)) refuse("size.min_pixels", size.min_pixels, "must be above 1");
  if (!(size.max_pixels >= size.min_pixels))
    refuse("size.max_pixels", size.max_pixels, "must be at least size.min_pixels");
  if (!(size.ratio >= 1)) refuse("size.ratio", size.ratio, "must be at least 1");
  if (max_foreign < 0 || max_foreign > 1000) refuse("max_foreign", max_foreign, "must be 0..1000");
  if (!(piled >= 0 && piled <= 1)) refuse("piled", piled, "must be 0..1");
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
  const Layout layout = drawLayout(&random, models, options, rule);
  Placer placer(&random, layout.spread, rule.gap * layout.scale);

  std::vector<SceneObject> to_pile;
  for (int k = 0; k < parts; ++k) {
    SceneObject object = drawPart(&random, models, layout.models);
    if (options.level == SceneLevel::kEasy) standOut(&object.material, scene.table.material.albedo);
    const Rigid3 resting = drawPose(stablePoses(*object.mesh), &random);
    if (options.piled > 0 && k > 0 && random.uniform(0, 1) < options.piled) {
      object.world_from_object = resting;
      to_pile.push_back(object);
    } else if (placer.place(&object, resting)) {
      scene.objects.push_back(object);
    }
  }
  const int foreign = layout.foreign.empty() ? 0 : random.integer(0, options.max_foreign);
  for (int k = 0; k < foreign; ++k) {
    SceneObject object = drawPart(&random, options.foreign, layout.foreign);
    object.model = -1;
    if (placer.place(&object, drawPose(stablePoses(*object.mesh), &random))) scene.objects.push_back(object);
  }

  const bool mixed = options.appearance == Appearance::kMixed;
  Generator looks(mixBits(seed, 0x100c5u));  // of its own: the arrangement stays that of the plain scene
  for (int k = 0; k < clutter; ++k) {
    const bool workshop = mixed && looks.integer(0, 3) > 0;
    const ClutterPiece simple = simplePiece(&random, layout.scale);
    ClutterPiece piece = workshop ? workshopPiece(&looks, layout.scale) : simple;
    if (placer.place(&piece.object, piece.table_from_object)) scene.objects.push_back(piece.object);
  }
  for (SceneObject& object : to_pile) {
    pile(&random, layout.spread, &object, scene.objects);
    scene.objects.push_back(object);
  }

  addLights(&random, &scene);
  aimCamera(&random, options, rule, layout, &scene);
  if (mixed) {
    addBystanders(&looks, layout, &scene);
    dressLights(&looks, &scene);
  }
  scaleSurroundings(layout.scale, layout.distance, &scene);
  if (mixed) dressObjects(&looks, {layout.scale, pixelSize(options, layout, scene)}, &scene);
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
