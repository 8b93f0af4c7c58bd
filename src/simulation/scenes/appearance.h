#pragma once
#include "monocular_eye_hand/geometry/random.h"
#include "monocular_eye_hand/simulation/scene.h"
#include "simulation/scenes/clutter.h"

namespace monocular_eye_hand {

// The appearance of real scenes, drawn at random: what Appearance::kMixed adds to plain materials.

struct AppearanceScale {
  double lengths = 1;     ///< of the scene, as RandomSceneOptions scales it
  double pixel = 0.0005;  ///< what a pixel covers on the parts [m]
};

/// Parts (half of them stay plain), clutter and table: prints, wear, rounded edges, gloss, translucency.
void dressObjects(Generator* random, const AppearanceScale& scale, Scene* scene);
/// Light from the side, low light, diffuse light; surroundings that glossy things mirror.
void dressLights(Generator* random, Scene* scene);

}  // namespace monocular_eye_hand
