#pragma once
#include <functional>
#include <string>
#include <vector>

#include "monocular_eye_hand/model/characteristic_views.h"
#include "monocular_eye_hand/model/known_object.h"

namespace monocular_eye_hand {

/// Reads the list of objects of config/objects.yaml: `objects: [{name, mesh, unit, grasp, obstacle, grasps,
/// ...overrides}]`. Unknown keys, double names and missing files are BadInput.
std::vector<ObjectEntry> readObjectEntries(const std::string& yaml_path);

/// Takes a line of what is being done, before each step that may take long.
using CompileProgress = std::function<void(const std::string&)>;

/// How much of a model is compiled; each holds what those before it hold.
enum class ModelDepth {
  kMesh,   ///< name, mesh (repaired, welded), bounds, diameter: for what only collides or is drawn
  kShape,  ///< surfaces, edges, circles, corners, symmetries: for what is held, located or grasped
  kViews   ///< the view sphere: for recognition
};

/// Builds and compiles the entries, using the cache folder ("" = $XDG_CACHE_HOME or ~/.cache,
/// monocular_eye_hand/; "none" = no cache). A stale or damaged cache file is rebuilt where views are wanted;
/// for shapes the symmetries are taken from it. Throws BadInput; a noisy scan is refused within seconds where
/// more than its mesh is wanted.
ModelBase compileModels(const std::vector<ObjectEntry>& entries, ModelDepth depth,
                        const ViewOptions& views = {}, const std::string& cache_dir = "",
                        const CompileProgress& progress = {});
/// The one door to the CAD files of a list of objects.
ModelBase loadModels(const std::string& yaml_path, ModelDepth depth, const ViewOptions& views = {},
                     const std::string& cache_dir = "", const CompileProgress& progress = {});

}  // namespace monocular_eye_hand
