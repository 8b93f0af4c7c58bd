#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

/// A picture that ships with the package.
struct DemoScene {
  std::string file;  ///< without extension
  Scene scene;
  bool distorted = false;  ///< taken through the wide-angle lens
};

/// The pictures of data/demo: figure 9 of Wong et al. (two bridges and a grenade), and others for a first
/// look.
std::vector<DemoScene> demoScenes(const std::vector<NamedMesh>& models);
/// The pictures of data/golden: each model alone, a distorted one, an occluded one, one with nothing known.
std::vector<DemoScene> goldenScenes(const std::vector<NamedMesh>& models);

}  // namespace monocular_eye_hand
