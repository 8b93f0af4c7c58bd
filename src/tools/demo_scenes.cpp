#include "tools/demo_scenes.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/stable_poses.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDegree = M_PI / 180;

SceneObject part(const std::vector<NamedMesh>& models, const std::string& name, double x, double y,
                 double yaw, double albedo) {
  for (size_t k = 0; k < models.size(); ++k)
    if (models[k].name == name)
      return {
          name, int(k), models[k].mesh, {expSO3({0, 0, yaw * kDegree}), {x, y, 0}}, {albedo, 0.10, 35, {}}};
  throw BadInput("--set demo and golden show the parts of config/objects.yaml, and this model base has no '" +
                 name + "': leave --set out for random scenes of its own parts");
}

/// The same part in another of its resting poses: number `pose` of the most stable ones.
SceneObject tipped(SceneObject object, size_t pose) {
  const std::vector<StablePose> poses = stablePoses(*object.mesh);
  object.world_from_object =
      object.world_from_object * poses[std::min(pose, poses.size() - 1)].table_from_object;
  return object;
}

SceneObject clutter(Mesh mesh, double x, double y, double yaw, const Material& material) {
  return {"clutter",
          -1,
          std::make_shared<Mesh>(std::move(mesh)),
          {expSO3({0, 0, yaw * kDegree}), {x, y, 0}},
          material};
}

Scene workbench(double albedo, const Texture& texture) {
  Scene scene;
  scene.table.material = {albedo, 0.03, 15, texture};
  scene.lights = {{{-0.55, -0.35, 1.05}, 0.16, 0.85}, {{0.75, 0.25, 1.1}, 0.30, 0.35}};
  scene.ambient = 0.38;
  scene.background = 0.10;
  return scene;
}

Scene twoBridgesAndGrenade(const std::vector<NamedMesh>& models) {
  Scene scene = workbench(0.30, {Texture::Kind::kWood, 0.018, 0.22, 3});
  scene.objects = {part(models, "bridge", -0.095, 0.030, 28, 0.74),
                   part(models, "bridge", 0.105, 0.045, -38, 0.70),
                   part(models, "grenade", 0.005, -0.060, 12, 0.62)};
  scene.world_from_camera = lookFrom(-88 * kDegree, 40 * kDegree, 0.60, {0.0, 0.01, 0.02}, 2 * kDegree);
  return scene;
}

Scene frameAndFlange(const std::vector<NamedMesh>& models) {
  Scene scene = workbench(0.42, {Texture::Kind::kBricks, 0.06, 0.30, 5});
  scene.objects = {part(models, "frame", 0.0, 0.03, 8, 0.68),
                   part(models, "flange", -0.045, 0.02, 0, 0.30),
                   part(models, "bracket", 0.06, 0.045, 200, 0.78),
                   part(models, "bridge", 0.045, -0.135, -12, 0.20),
                   clutter(boxMesh({0.05, 0.035, 0.045}), -0.13, -0.12, 20,
                           {0.65, 0.05, 20, {Texture::Kind::kChecker, 0.012, 0.5, 2}}),
                   clutter(cylinderMesh(0.022, 0.07), -0.055, -0.135, 0, {0.55, 0.2, 60, {}}),
                   clutter(sphereMesh(0.024), 0.165, -0.12, 0, {0.35, 0.25, 80, {}}),
                   clutter(coneMesh(0.028, 0.010, 0.06), 0.205, 0.02, 0,
                           {0.5, 0.08, 30, {Texture::Kind::kNoise, 0.01, 0.4, 9}})};
  scene.world_from_camera = lookFrom(-75 * kDegree, 48 * kDegree, 0.68, {0.01, -0.02, 0.01}, -4 * kDegree);
  return scene;
}

Scene nothingKnown() {
  Scene scene = workbench(0.38, {Texture::Kind::kNoise, 0.03, 0.35, 11});
  scene.objects = {clutter(boxMesh({0.09, 0.05, 0.035}), -0.08, 0.02, 33, {0.66, 0.08, 30, {}}),
                   clutter(boxMesh({0.04, 0.04, 0.075}), 0.06, 0.06, -15,
                           {0.25, 0.05, 20, {Texture::Kind::kWood, 0.008, 0.4, 4}}),
                   clutter(cylinderMesh(0.032, 0.055), 0.05, -0.05, 0, {0.75, 0.15, 50, {}}),
                   clutter(sphereMesh(0.028), -0.03, -0.075, 0, {0.45, 0.3, 90, {}}),
                   clutter(coneMesh(0.035, 0.008, 0.08), -0.01, 0.10, 0, {0.6, 0.1, 30, {}}),
                   clutter(boxMesh({0.13, 0.09, 0.0006}), -0.14, -0.06, 12,
                           {0.7, 0.02, 10, {Texture::Kind::kBricks, 0.02, 0.7, 8}})};
  scene.world_from_camera = lookFrom(-100 * kDegree, 42 * kDegree, 0.6, {0, 0.0, 0.02}, 3 * kDegree);
  return scene;
}

Scene occludedParts(const std::vector<NamedMesh>& models) {
  Scene scene = workbench(0.55, {Texture::Kind::kNoise, 0.02, 0.25, 21});
  scene.objects = {tipped(part(models, "bracket", -0.075, 0.045, 75, 0.25), 1),
                   part(models, "grenade", 0.01, -0.015, 47, 0.22),
                   part(models, "bridge", 0.035, 0.065, 14, 0.82),
                   tipped(part(models, "bridge", 0.125, -0.03, 65, 0.15), 1),
                   clutter(boxMesh({0.05, 0.03, 0.05}), -0.07, -0.05, -30,
                           {0.7, 0.05, 20, {Texture::Kind::kChecker, 0.01, 0.5, 6}}),
                   clutter(cylinderMesh(0.02, 0.06), 0.095, 0.02, 0, {0.4, 0.2, 60, {}})};
  scene.world_from_camera = lookFrom(-95 * kDegree, 37 * kDegree, 0.58, {0.015, 0.01, 0.025}, 5 * kDegree);
  return scene;
}

Scene alone(const std::vector<NamedMesh>& models, size_t model) {
  // Different greys, tables and directions, the same for every run.
  static const double kAlbedo[] = {0.78, 0.22, 0.70, 0.60, 0.80}, kTable[] = {0.35, 0.62, 0.28, 0.25, 0.40};
  static const double kAzimuth[] = {-60, -115, -75, -40, -140}, kElevation[] = {38, 33, 50, 42, 45};
  const size_t k = model % 5;
  Scene scene = workbench(kTable[k], {Texture::Kind::kNoise, 0.015, 0.06, uint32_t(31 + model)});
  scene.objects = {part(models, models[model].name, 0, 0, 17.0 * double(model + 1), kAlbedo[k])};
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : models[model].mesh->vertices) box.extend(p);
  const double distance = std::max(0.42, 2.6 * box.diagonal().norm());
  const Eigen::Vector3d target = scene.objects[0].world_from_object * box.center();
  scene.world_from_camera = lookFrom(kAzimuth[k] * kDegree, kElevation[k] * kDegree, distance,
                                     target + Eigen::Vector3d(0.01, -0.008, 0), 6 * kDegree);
  return scene;
}

}  // namespace

std::vector<DemoScene> demoScenes(const std::vector<NamedMesh>& models) {
  return {{"two_bridges_and_grenade", twoBridgesAndGrenade(models)},
          {"frame_and_flange", frameAndFlange(models)},
          {"nothing_known", nothingKnown()}};
}

std::vector<DemoScene> goldenScenes(const std::vector<NamedMesh>& models) {
  std::vector<DemoScene> scenes;
  for (size_t k = 0; k < models.size(); ++k) scenes.push_back({models[k].name, alone(models, k)});
  scenes.push_back({"occluded", occludedParts(models)});
  scenes.push_back({"distorted", twoBridgesAndGrenade(models), true});
  return scenes;
}

}  // namespace monocular_eye_hand
