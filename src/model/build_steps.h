#pragma once
#include "model/symmetry.h"
#include "monocular_eye_hand/mesh/repair_mesh.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

// buildModel in steps, so that the slow one can come from the cache.

/// A model of which only the mesh and its size are known.
struct RepairedModel {
  ObjectModel model;
  RepairedMesh found;  ///< its mesh stands in the model
};
RepairedModel repairedModel(const std::string& name, const Mesh& mesh, const ModelOptions& options);
/// Everything but the symmetries.
ObjectModel buildShape(const std::string& name, const Mesh& mesh, const ModelOptions& options);
SymmetryResult symmetriesOf(const ObjectModel& model, const ModelOptions& options);
/// Enters the symmetries and the warning about near symmetries.
void setSymmetries(const SymmetryResult& found, ObjectModel* model);
/// "180 deg about (0, 0, 1)".
std::string turnText(const Rigid3& motion);

}  // namespace monocular_eye_hand
