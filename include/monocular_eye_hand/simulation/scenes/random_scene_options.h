#pragma once
#include <vector>

#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

enum class SceneLevel {
  kEasy,    ///< 1-3 parts, plain table
  kMedium,  ///< 3-5 parts, textured table, 1-3 pieces of clutter
  kHard     ///< 4-7 parts close together, 4-8 pieces of clutter, strong textures, low views
};

enum class Appearance {
  kPlain,  ///< albedo, highlight and procedural textures
  kMixed  ///< half of the parts plain; prints, wear, rounded edges, gloss, translucency, a workshop's clutter
};

/// Places the camera so that the parts appear in a drawn size, and scales what surrounds them (spread,
/// clutter, lights, table) to their size. The parts of one scene are of similar size then.
struct PartSize {
  double focal_length = 0;  ///< of the camera that will look [px]; 0: the distance is drawn instead
  int width = 640;          ///< of its image [px]
  double min_pixels = 75, max_pixels = 300;  ///< diameter of a reference part in a 640 px wide image
  double ratio = 1.5;  ///< of two diameters: no part is larger or smaller than the reference by more
};

struct RandomSceneOptions {
  SceneLevel level = SceneLevel::kEasy;
  int parts = -1;                                   ///< exactly so many; -1: as the level says
  int clutter = -1;                                 ///< exactly so many; -1: as the level says
  double min_distance = 0.42, max_distance = 0.85;  ///< eye to the middle of the table [m]
  PartSize size;                   ///< with a focal length it replaces min_distance and max_distance
  std::vector<NamedMesh> foreign;  ///< parts that are not to be found: they stand in the scene as clutter
  int max_foreign = 3;             ///< at most so many of them
  Appearance appearance = Appearance::kPlain;
  double piled = 0;  ///< chance of a part to lie on or lean against others instead of standing free

  void check() const;  ///< throws BadInput naming field, value and rule
};

}  // namespace monocular_eye_hand
