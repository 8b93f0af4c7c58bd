#include "tools/bop_output.h"

#include <iostream>
#include <sstream>
#include <tuple>

#include "monocular_eye_hand/evaluation/write_dataset.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "monocular_eye_hand/simulation/render/truth.h"
#include "monocular_eye_hand/simulation/scenes/random_picture.h"

namespace monocular_eye_hand {
namespace {

// Far enough apart that no two images of a corpus share a seed.
constexpr unsigned kSeedsPerRun = 100000007u, kSeedsPerScene = 10007u;

// Splits of one seed must not share pictures.
unsigned firstSeed(const BopRequest& request) {
  unsigned seed = request.seed * kSeedsPerRun + unsigned(request.scene) * kSeedsPerScene;
  for (const char c : request.split) seed = seed * 1000003u + unsigned(c);
  return seed;
}

std::vector<BopPart> buildParts(const std::string& yaml) {
  ModelBase models = loadModels(yaml, ModelDepth::kShape);
  std::vector<std::string> names;
  for (const KnownObject& object : models.objects) names.push_back(object.model.name);
  const std::vector<int> ids = bopIds(names);

  std::vector<BopPart> parts;
  for (size_t k = 0; k < ids.size(); ++k) parts.push_back({ids[k], std::move(models.objects[k].model)});
  return parts;
}

std::vector<NamedMesh> meshesOf(const std::vector<BopPart>& parts) {
  std::vector<NamedMesh> meshes;
  for (const BopPart& part : parts)
    meshes.push_back({part.model.name, std::make_shared<Mesh>(part.model.mesh)});
  return meshes;
}

std::vector<NamedMesh> readDistractors(const std::string& yaml) {
  std::vector<NamedMesh> meshes;
  if (yaml.empty()) return meshes;
  for (const ObjectEntry& entry : readObjectEntries(yaml))
    meshes.push_back({entry.name, std::make_shared<Mesh>(loadMesh(entry.mesh, entry.unit))});
  return meshes;
}

ImageSize parseSize(const std::string& text) {
  ImageSize size;
  char by = 0, colon = 0;
  std::istringstream in(text);
  in >> size.width >> by >> size.height;
  if (in && !in.eof()) in >> colon >> size.weight;
  const bool weighted = colon == ':' || colon == 0;
  if (in.fail() || by != 'x' || !weighted || in.peek() != std::char_traits<char>::eof())
    throw BadInput("--sizes: '" + text + "' is not WIDTHxHEIGHT or WIDTHxHEIGHT:WEIGHT");
  return size;
}

std::vector<ImageSize> parseSizes(const std::string& list) {
  std::vector<ImageSize> sizes;
  std::istringstream in(list);
  std::string item;
  while (std::getline(in, item, ',')) sizes.push_back(parseSize(item));
  return sizes;
}

SceneLevel levelOfImage(const BopRequest& request, int image) {
  if (request.level == "easy") return SceneLevel::kEasy;
  if (request.level == "medium") return SceneLevel::kMedium;
  if (request.level == "hard") return SceneLevel::kHard;
  static const SceneLevel kMixed[] = {SceneLevel::kEasy, SceneLevel::kMedium, SceneLevel::kHard};
  return kMixed[image % 3];
}

WrittenImage truthWithCounts(int id, const RandomPicture& picture, const RenderedImage& rendered,
                             const std::vector<BopPart>& parts) {
  WrittenImage out;
  out.id = id;
  out.camera = picture.camera;
  out.camera_from_world = picture.scene.world_from_camera.inverse();
  for (size_t k = 0; k < picture.scene.objects.size(); ++k) {
    const int model = picture.scene.objects[k].model;
    const Visibility& seen = rendered.objects[k];
    if (model < 0 || seen.pixels_alone == 0) continue;
    const GroundTruth truth{parts[size_t(model)].id, picture.scene.cameraFromObject(int(k)), seen.fraction};
    out.truth.push_back({truth, seen.box_visible, seen.pixels_alone, seen.pixels_visible});
  }
  return out;
}

}  // namespace

void renderBopScene(const BopRequest& request) {
  const std::vector<BopPart> parts = buildParts(request.objects);
  const std::vector<NamedMesh> meshes = meshesOf(parts);
  const unsigned first_seed = firstSeed(request);
  const ImageSize size = drawSize(parseSizes(request.sizes), first_seed);

  RandomPictureOptions options;
  options.scene.foreign = readDistractors(request.distractors);
  options.scene.appearance = request.mixed_appearance ? Appearance::kMixed : Appearance::kPlain;
  options.width = size.width;
  options.height = size.height;
  options.samples = request.samples;
  options.edge_samples = request.edge_samples;

  writeBopModels(request.dataset, parts);
  std::tie(options.scene.size.min_pixels, options.scene.size.max_pixels) = request.part_pixels;
  BopSceneWriter writer(request.dataset, request.split, request.scene);
  for (int image = 0; image < request.count; ++image) {
    options.scene.level = levelOfImage(request, image);
    options.scene.piled = options.scene.level == SceneLevel::kHard ? request.piled : 0;
    const RandomPicture picture = randomPicture(meshes, first_seed + unsigned(image), options);
    const RenderedImage rendered = renderScene(picture.scene, picture.camera, picture.render);
    writer.add(truthWithCounts(image, picture, rendered, parts), rendered.grey);
    if (image == 0) writeBopCamera(request.dataset, picture.camera);
  }
  writer.finish();
  std::cout << request.dataset << ": " << request.count << " images in scene " << request.scene << " of "
            << request.split << "\n";
}

}  // namespace monocular_eye_hand
