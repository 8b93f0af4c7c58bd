#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

std::vector<NamedMesh> namedMeshes(const ModelBase& models) {
  std::vector<NamedMesh> out;
  for (const KnownObject& object : models.objects)
    out.push_back({object.model.name, std::make_shared<Mesh>(object.model.mesh)});
  return out;
}

}  // namespace monocular_eye_hand
