#include "simulation/scenes/appearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "simulation/scenes/print_placing.h"
#include "simulation/scenes/random_draws.h"

namespace monocular_eye_hand {
namespace {

bool chance(Generator* random, double share) { return random->uniform(0, 1) < share; }

// "clutter" has a material of its own, "clutter KIND" waits for one; foreign parts are no clutter.
bool isClutter(const SceneObject& object) { return object.model < 0 && object.name.rfind("clutter", 0) == 0; }

double logUniform(Generator* random, double low, double high) {
  return low * std::pow(high / low, random->uniform(0, 1));
}

double diameterOf(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  return box.diagonal().norm();
}

/// A material with its finish, before prints, which depend on the mesh.
struct Surface {
  Material material;
  Finish finish;
  bool printed = false;
  PrintPlan plan = PrintPlan::kMarked;
};

Surface paintedOrPaper(Generator* random) {
  Surface surface;
  surface.material = randomMaterial(random);
  surface.material.specular *= 0.5;
  if (chance(random, 0.4)) {
    surface.finish.gloss = random->uniform(0.02, 0.06);
    surface.finish.roughness = random->uniform(0.01, 0.15);
  }
  return surface;
}

Surface metal(Generator* random) {
  Surface surface;
  surface.material.albedo = random->uniform(0.08, 0.4);
  surface.material.specular = random->uniform(0.2, 0.6);
  surface.material.shininess = logUniform(random, 20, 200);
  surface.finish.gloss = random->uniform(0.25, 0.75);
  surface.finish.roughness = logUniform(random, 0.02, 0.25);
  if (chance(random, 0.4)) {
    surface.finish.brushed = random->uniform(0.1, 0.5);
    surface.finish.brush_axis = Eigen::Vector3d::Unit(random->integer(0, 2));
    surface.finish.roughness = logUniform(random, 0.02, 0.08);
  }
  return surface;
}

Surface glossyPlastic(Generator* random) {
  Surface surface;
  surface.material.albedo = random->uniform(0.05, 0.85);
  surface.material.specular = random->uniform(0.1, 0.4);
  surface.material.shininess = logUniform(random, 40, 300);
  surface.finish.gloss = random->uniform(0.03, 0.08);
  surface.finish.roughness = logUniform(random, 0.005, 0.08);
  return surface;
}

Surface veryDark(Generator* random) {
  Surface surface = glossyPlastic(random);
  surface.material.albedo = random->uniform(0.02, 0.08);
  surface.material.specular *= 0.5;
  return surface;
}

Surface veryBright(Generator* random) {
  Surface surface = paintedOrPaper(random);
  surface.material.albedo = random->uniform(0.8, 0.93);
  return surface;
}

Surface translucent(Generator* random) {
  Surface surface = glossyPlastic(random);
  surface.material.albedo = random->uniform(0.5, 0.9);
  surface.finish.translucency = random->uniform(0.25, 0.85);
  surface.finish.layer_loss = random->uniform(0.05, 0.25);
  return surface;
}

Surface drawSurface(Generator* random) {
  const double kind = random->uniform(0, 1);
  Surface surface;
  if (kind < 0.34)
    surface = paintedOrPaper(random);
  else if (kind < 0.58)
    surface = metal(random);
  else if (kind < 0.73)
    surface = glossyPlastic(random);
  else if (kind < 0.82)
    surface = veryDark(random);
  else if (kind < 0.90)
    surface = veryBright(random);
  else
    surface = translucent(random);

  const bool bare = surface.finish.gloss > 0.2 || surface.finish.translucency > 0;
  surface.printed = chance(random, bare ? 0.4 : 0.75);
  const double plan = random->uniform(0, 1);
  surface.plan = plan < 0.45 ? PrintPlan::kMarked : plan < 0.8 ? PrintPlan::kPackaging : PrintPlan::kWorn;
  if (bare && surface.plan == PrintPlan::kPackaging) surface.plan = PrintPlan::kWorn;

  if (chance(random, 0.8)) surface.finish.edge_radius = logUniform(random, 0.0001, 0.001);
  if (chance(random, 0.3)) {
    surface.finish.wear = random->uniform(-0.3, 0.8);
    surface.finish.wear_width = logUniform(random, 0.0004, 0.003);
  }
  return surface;
}

Material materialFor(const Mesh& mesh, Surface surface, const AppearanceScale& scale, Generator* random) {
  const double size = diameterOf(mesh);
  surface.finish.edge_radius = std::min(surface.finish.edge_radius, 0.015 * size);
  surface.finish.wear_width = std::min(surface.finish.wear_width, 0.03 * size);
  if (surface.printed)
    surface.finish.prints =
        drawPrints(mesh, surface.plan, 0.6 * scale.pixel, surface.material.albedo, random);
  surface.material.finish = std::make_shared<Finish>(std::move(surface.finish));
  return surface.material;
}

// Parts of one kind look alike in a scene more often than not, and so do parts of different kinds.
void dressParts(Generator* random, const AppearanceScale& scale, Scene* scene) {
  const bool one_material = chance(random, 0.5), alike = chance(random, 0.7);
  const Surface common = drawSurface(random);
  const bool common_plain = chance(random, 0.5);
  std::map<int, Material> known;
  for (SceneObject& object : scene->objects) {
    if (isClutter(object)) continue;
    const bool plain = one_material ? common_plain : chance(random, 0.5);
    const Surface surface = one_material ? common : drawSurface(random);
    if (plain) continue;
    const int kind = object.model;
    if (alike && kind >= 0 && known.count(kind)) {
      object.material = known[kind];
      continue;
    }
    object.material = materialFor(*object.mesh, surface, scale, random);
    if (kind >= 0) known[kind] = object.material;
  }
}

bool regular(const Texture& texture) {
  return texture.kind == Texture::Kind::kChecker || texture.kind == Texture::Kind::kBricks;
}

void dressClutter(Generator* random, const AppearanceScale& scale, SceneObject* object) {
  const bool has_material = object->name == "clutter";
  if (has_material && chance(random, regular(object->material.texture) ? 0.2 : 0.5)) return;
  Surface surface = drawSurface(random);
  const bool cable = object->name == "clutter cable", ruler = object->name == "clutter ruler";
  if (cable) surface = chance(random, 0.7) ? veryDark(random) : glossyPlastic(random);
  if (ruler) surface = chance(random, 0.5) ? metal(random) : veryBright(random);
  surface.finish.edge_radius *= scale.lengths;
  surface.printed = surface.printed && !cable;
  object->material = materialFor(*object->mesh, surface, scale, random);
  if (!ruler) return;
  const PlanarFaces found = planarFaces(*object->mesh, 0.2);
  Finish finish = *object->material.finish;
  for (const PlanarFace& face : found.faces)
    finish.prints.push_back(makePrint(Art::kRuler, face.object_from_face, face.width, face.height,
                                      0.6 * scale.pixel, object->material.albedo, random));
  object->material.finish = std::make_shared<Finish>(std::move(finish));
}

Rigid3 lyingAnywhere(Generator* random, double spread) {
  return {expSO3({0, 0, random->uniform(0, 2 * M_PI)}),
          {random->uniform(-spread, spread), random->uniform(-spread, spread), 0}};
}

// Few tables have a regular pattern of strong contrast.
void calmDown(Generator* random, Texture* texture) {
  if (!regular(*texture)) texture->amplitude *= random->uniform(0.2, 1);
  if (!regular(*texture) || chance(random, 0.25)) return;
  texture->amplitude *= random->uniform(0.2, 0.8);
  const double kind = random->uniform(0, 1);
  texture->kind = kind < 0.4   ? Texture::Kind::kPlain
                  : kind < 0.7 ? Texture::Kind::kNoise
                               : Texture::Kind::kWood;
}

void dressTable(Generator* random, const AppearanceScale& scale, Scene* scene) {
  calmDown(random, &scene->table.material.texture);
  if (chance(random, 0.4)) return;
  Finish finish;
  Material& material = scene->table.material;
  if (chance(random, 0.35)) {
    finish.gloss = random->uniform(0.02, 0.12);
    finish.roughness = logUniform(random, 0.03, 0.25);
  }

  const double texel = 0.7 * scale.pixel, s = scale.lengths;
  if (chance(random, 0.2))
    finish.prints.push_back(makePrint(Art::kGrid, lyingAnywhere(random, 0.05 * s),
                                      s * random->uniform(0.3, 0.8), s * random->uniform(0.3, 0.6), texel,
                                      material.albedo, random));
  if (chance(random, 0.25))
    finish.prints.push_back(makePrint(Art::kStains, lyingAnywhere(random, 0.1 * s), 0.5 * s, 0.4 * s, texel,
                                      material.albedo, random));

  const int papers = chance(random, 0.45) ? random->integer(1, 3) : 0;
  static const Art kPapers[] = {Art::kPage,      Art::kPage,     Art::kLabel,
                                Art::kPatchwork, Art::kBoxFront, Art::kTag};
  for (int k = 0; k < papers; ++k) {
    const double width = s * random->uniform(0.08, 0.3);
    finish.prints.push_back(makePrint(kPapers[random->integer(0, 5)], lyingAnywhere(random, 0.2 * s), width,
                                      width * random->uniform(0.6, 1.41), texel, material.albedo, random));
  }

  if (chance(random, 0.1)) {  // a board of tags around the parts
    const double step = s * random->uniform(0.07, 0.12);
    const Rigid3 board = lyingAnywhere(random, 0.03 * s);
    for (int k = 0; k < 20; ++k) {
      const int side = k / 5;
      const double along = (k % 5 - 2.5) * step;
      const Rigid3 turn{expSO3({0, 0, side * M_PI / 2}), {0, 0, 0}},
          place{Eigen::Matrix3d::Identity(), {along, -2.5 * step, 0}};
      finish.prints.push_back(
          makePrint(Art::kTag, board * turn * place, 0.8 * step, 0.8 * step, texel, material.albedo, random));
    }
  }

  material.finish = std::make_shared<Finish>(std::move(finish));
}

Eigen::Vector3d direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

void lightFromTheSide(Generator* random, Scene* scene) {
  scene->ambient = random->uniform(0.08, 0.3);
  Light light;
  light.position = random->uniform(0.8, 1.6) *
                   direction(random->uniform(0, 2 * M_PI), random->uniform(10, 28) * M_PI / 180);
  light.radius = logUniform(random, 0.01, 0.2);
  light.intensity = random->uniform(0.8, 2.5);
  scene->lights = {light};
}

void diffuseLight(Generator* random, Scene* scene) {
  scene->ambient = random->uniform(0.5, 1.0);
  for (Light& light : scene->lights) {
    light.radius = random->uniform(0.3, 0.7);
    light.intensity *= random->uniform(0.1, 0.5);
  }
}

void dressSurroundings(Generator* random, Scene* scene) {
  Environment& around = scene->environment;
  around.low = random->uniform(0.02, 0.3);
  around.high = random->uniform(0.1, 0.8);
  const int panels = random->integer(1, 6);
  for (int k = 0; k < panels; ++k) {
    Environment::Panel panel;
    panel.direction = direction(random->uniform(0, 2 * M_PI), random->uniform(-5, 88) * M_PI / 180);
    panel.half_width = logUniform(random, 0.05, 0.8);
    panel.half_height = logUniform(random, 0.05, 0.8);
    panel.softness = random->uniform(0.01, 0.15);
    panel.radiance = chance(random, 0.3) ? 0.02 : logUniform(random, 0.4, 5);
    around.panels.push_back(panel);
  }
}

}  // namespace

void dressObjects(Generator* random, const AppearanceScale& scale, Scene* scene) {
  dressParts(random, scale, scene);
  for (SceneObject& object : scene->objects)
    if (isClutter(object)) dressClutter(random, scale, &object);
  dressTable(random, scale, scene);
}

void dressLights(Generator* random, Scene* scene) {
  const double kind = random->uniform(0, 1);
  if (kind < 0.2)
    lightFromTheSide(random, scene);
  else if (kind < 0.4)
    diffuseLight(random, scene);
  if (chance(random, 0.6)) scene->sky = random->uniform(0.2, 0.9);
  dressSurroundings(random, scene);
}

}  // namespace monocular_eye_hand
