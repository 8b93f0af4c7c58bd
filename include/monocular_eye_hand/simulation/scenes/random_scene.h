#pragma once
#include <cstdint>
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"
#include "monocular_eye_hand/simulation/scenes/random_scene_options.h"

namespace monocular_eye_hand {

/// Parts (drawn from `models`, several of one kind possible) and clutter resting on the table side by side
/// without touching, random materials, lights and camera pose. A part that finds no room is left out. Throws
/// BadInput when parts are asked for and `models` is empty.
Scene randomScene(const std::vector<NamedMesh>& models, uint32_t seed,
                  const RandomSceneOptions& options = {});
Scene randomScene(const std::vector<NamedMesh>& models, uint32_t seed, SceneLevel level);
/// Only clutter: nothing to be found.
Scene randomClutter(uint32_t seed, int pieces = 8);

}  // namespace monocular_eye_hand
