#pragma once
#include <vector>

#include "monocular_eye_hand/geometry/random.h"
#include "monocular_eye_hand/mesh/stable_poses.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

// What random scenes and random cells draw alike.

Texture randomTexture(Generator* random, double amplitude);
Material randomMaterial(Generator* random);
/// On a plain table a part of the same grey could not be seen at all.
void standOut(Material* material, double table_albedo);
/// table_from_object, likely ones more often.
const Rigid3& drawPose(const std::vector<StablePose>& poses, Generator* random);
/// One to three lights, ambient light, background.
void addLights(Generator* random, Scene* scene);

}  // namespace monocular_eye_hand
