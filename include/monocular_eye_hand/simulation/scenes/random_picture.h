#pragma once
#include <cstdint>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/simulation/render/rendered_image.h"
#include "monocular_eye_hand/simulation/scenes/random_scene_options.h"

namespace monocular_eye_hand {

// Pictures in mass, to train and to test with: scene, camera and sensor are all drawn.

struct ImageSize {
  int width = 640, height = 480;  ///< [px]
  double weight = 1;              ///< how often it is drawn, relative to the others
};
/// One of them by its weight. Throws BadInput when there is none or a size or weight is not positive.
ImageSize drawSize(const std::vector<ImageSize>& sizes, uint32_t seed);

struct RandomPictureOptions {
  RandomSceneOptions scene;  ///< its part size's focal length and width follow the drawn camera
  int width = 640, height = 480;
  double min_focal = 0.9, max_focal = 1.6;  ///< focal length as a share of the width
  double principal_jitter = 6;              ///< principal point from the middle, of 640 px of width [px]
  int samples = 2;                          ///< RenderOptions::samples; one less but in easy scenes
  int edge_samples = 4;                     ///< RenderOptions::edge_samples; one less but in easy scenes

  void check() const;  ///< throws BadInput naming field, value and rule
};

/// Everything that renderScene() takes.
struct RandomPicture {
  Scene scene;
  Camera camera;
  RenderOptions render;  ///< blur and noise as the level says
};

/// Same arguments, same picture. Throws BadInput as randomScene() does.
RandomPicture randomPicture(const std::vector<NamedMesh>& models, uint32_t seed,
                            const RandomPictureOptions& options = {});

}  // namespace monocular_eye_hand
