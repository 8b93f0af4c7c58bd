#include "monocular_eye_hand/simulation/cell/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "simulation/cell/random.h"
#include "simulation/scenes/settling.h"

namespace monocular_eye_hand {
namespace {

constexpr double kResting = 0.001;  // less far from the table than this, a pose means "on it" [m]

double lowestVertex(const SceneObject& object) {
  double z = 1e9;
  for (const Eigen::Vector3d& p : object.mesh->vertices) z = std::min(z, (object.world_from_object * p).z());
  return z;
}

void checkModels(const std::vector<NamedMesh>& models) {
  for (const NamedMesh& model : models)
    if (!model.mesh || model.mesh->triangles.empty())
      throw BadInput("work cell: model '" + model.name + "' has no mesh");
}

SceneObject placed(const CellObject& wanted, const std::vector<NamedMesh>& models, const std::string& where) {
  const auto known = std::find_if(models.begin(), models.end(),
                                  [&](const NamedMesh& model) { return model.name == wanted.name; });
  if (known == models.end()) {
    std::string names;
    for (const NamedMesh& model : models) names += (names.empty() ? "" : ", ") + model.name;
    throw BadInput(where + ".name = " + wanted.name + " is not in the model base (" + names + ")");
  }
  SceneObject object{wanted.name, int(known - models.begin()), known->mesh, wanted.pose.transform(),
                     wanted.material.material()};
  const double z = lowestVertex(object);
  if (z < -kResting)
    throw BadInput(fmt::format("{}.pose: '{}' sinks {:.1f} mm into the table; raise pose.z", where,
                               wanted.name, -z * 1000));
  return object;
}

}  // namespace

CellScene makeCellScene(const CellOptions& options, const std::vector<NamedMesh>& models) {
  options.check();
  checkModels(models);

  CellScene cell;
  cell.options = options;
  cell.base_from_table = options.table.pose.transform();
  cell.camera = options.camera.camera();

  Scene& scene = cell.scene;
  scene.table.half_width = options.table.length / 2;
  scene.table.half_depth = options.table.width / 2;
  scene.table.material = options.table.material.material();
  scene.ambient = options.ambient;
  scene.background = options.background;
  for (const CellLight& light : options.lights)
    scene.lights.push_back({{light.x, light.y, light.z}, light.radius, light.intensity});

  if (options.random.seed >= 0) {
    arrangeAtRandom(models, &cell);
    return cell;
  }

  for (size_t k = 0; k < options.objects.size(); ++k) {
    SceneObject object = placed(options.objects[k], models, fmt::format("objects[{}]", k));
    if (const double z = lowestVertex(object); z < kResting) {
      object.world_from_object.translation.z() -= z;
    } else {
      std::vector<const SceneObject*> others;
      for (const SceneObject& other : scene.objects) others.push_back(&other);
      object.world_from_object = settle(object, others, scene.table, -options.table.pose.z).world_from_object;
    }
    scene.objects.push_back(std::move(object));
    cell.fixed.push_back(options.objects[k].fixed);
  }
  return cell;
}

}  // namespace monocular_eye_hand
