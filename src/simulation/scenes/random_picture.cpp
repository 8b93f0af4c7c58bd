#include "monocular_eye_hand/simulation/scenes/random_picture.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/random.h"
#include "monocular_eye_hand/geometry/require.h"
#include "monocular_eye_hand/simulation/scenes/random_scene.h"

namespace monocular_eye_hand {
namespace {

Camera drawCamera(Generator* random, const RandomPictureOptions& options) {
  const double scale = options.width / 640.0, jitter = options.principal_jitter * scale;
  Camera camera;
  camera.width = options.width;
  camera.height = options.height;
  camera.fx = camera.fy = options.width * random->uniform(options.min_focal, options.max_focal);
  camera.cx = 0.5 * (options.width - 1) + random->uniform(-jitter, jitter);
  camera.cy = 0.5 * (options.height - 1) + random->uniform(-jitter, jitter);
  return camera;
}

RenderOptions drawSensor(Generator* random, const RandomPictureOptions& options) {
  RenderOptions render;
  render.samples = options.samples;
  render.edge_samples = std::max(options.samples, options.edge_samples);
  render.seed = random->bits();
  render.mean = random->uniform(0.3, 0.5);
  if (options.scene.level != SceneLevel::kEasy) {  // blur and noise hide the difference
    render.samples = std::max(1, options.samples - 1);
    render.edge_samples = std::max(render.samples, render.edge_samples - 1);
  }

  switch (options.scene.level) {
    case SceneLevel::kEasy:
      render.blur_sigma = 0.35;
      render.noise_sigma = 1;
      break;
    case SceneLevel::kMedium:
      render.blur_sigma = 0.5;
      render.noise_sigma = 2;
      break;
    case SceneLevel::kHard:
      render.blur_sigma = random->uniform(0.6, 1.1);
      render.noise_sigma = 3.5;
      break;
  }

  return render;
}

/// What cameras do besides: gamma, dark corners, over-exposure, sharpening.
void drawProcessing(Generator* random, RenderOptions* render) {
  const double grey = random->uniform(0.25, 0.6);  // wanted mean of the coded image
  render->gamma = random->integer(0, 2) == 0 ? 1.0 : random->uniform(1.0, 2.2);
  render->mean = std::pow(grey, render->gamma);
  if (random->integer(0, 1) == 1) render->vignetting = random->uniform(0, 0.45);
  render->saturated = 0.005 * std::pow(30, random->uniform(0, 1));
  if (random->integer(0, 3) == 0) render->sharpening = random->uniform(0.2, 1.0);
}

}  // namespace

ImageSize drawSize(const std::vector<ImageSize>& sizes, uint32_t seed) {
  double sum = 0;
  for (const ImageSize& size : sizes) {
    if (size.width < 1 || size.height < 1 || !(size.weight > 0))
      throw BadInput("image sizes: width, height and weight must be positive");
    sum += size.weight;
  }
  if (sizes.empty()) throw BadInput("image sizes: the list is empty");

  Generator random(seed);
  double left = random.uniform(0, sum);
  for (const ImageSize& size : sizes)
    if ((left -= size.weight) < 0) return size;
  return sizes.back();
}

void RandomPictureOptions::check() const {
  scene.check();
  require(width >= 32, "width", width, "at least 32 px");
  require(height >= 32, "height", height, "at least 32 px");
  require(min_focal > 0.1, "min_focal", min_focal, "above 0.1 (of the width)");
  require(max_focal >= min_focal, "max_focal", max_focal, "at least min_focal");
  require(principal_jitter >= 0, "principal_jitter", principal_jitter, ">= 0 px");
}

RandomPicture randomPicture(const std::vector<NamedMesh>& models, uint32_t seed,
                            const RandomPictureOptions& options) {
  options.check();
  Generator random(mixBits(seed, 0xca3eu));
  RandomPicture picture;
  picture.camera = drawCamera(&random, options);
  picture.render = drawSensor(&random, options);
  if (options.scene.appearance == Appearance::kMixed) drawProcessing(&random, &picture.render);
  RandomSceneOptions scene = options.scene;
  scene.size.focal_length = picture.camera.fx;
  scene.size.width = picture.camera.width;
  picture.scene = randomScene(models, seed, scene);
  return picture;
}

}  // namespace monocular_eye_hand
