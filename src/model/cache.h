#pragma once
#include <string>

#include "model/symmetry.h"
#include "monocular_eye_hand/model/characteristic_views.h"

namespace monocular_eye_hand {

/// What is slow to compile about one object.
struct CompiledParts {
  SymmetryResult symmetries;
  ViewSphere views;
};

/// Folder of the cache: `wanted` unless it is ""; then $XDG_CACHE_HOME or ~/.cache, monocular_eye_hand/.
/// Returns "" when there is none ("none", or no home).
std::string cacheFolder(const std::string& wanted);

/// Name that changes with the mesh's bytes and every option.
std::string cacheName(const std::string& mesh_bytes, const std::string& options_text);

/// False when the file is missing, damaged or of another format.
bool readCache(const std::string& path, CompiledParts* parts);
/// Writes to a temporary file and renames it: readers never see half a file. False when the folder cannot be
/// written, which costs only time.
bool writeCache(const std::string& folder, const std::string& name, const CompiledParts& parts);

}  // namespace monocular_eye_hand
