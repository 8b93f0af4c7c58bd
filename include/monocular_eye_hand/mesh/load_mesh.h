#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

/// Metres per unit: "m", "cm", "mm", "inch". Throws BadInput naming the known ones.
double metresPerUnit(const std::string& unit);

/// A mesh in metres with what was ignored or put right on reading it.
struct LoadedMesh {
  Mesh mesh;
  std::vector<std::string> warnings;  ///< without the path; also a unit of the file's own that is another
};

/// Reads STL, OBJ, PLY or DAE, told apart by content, then by the end of the name. Throws BadInput that names
/// what the file really is, or what is damaged and where, and what to do.
LoadedMesh readMesh(const std::string& path, const std::string& unit);
/// The whole file. Throws BadInput when it is missing, a folder, empty or larger than 1 GB.
std::string meshFileBytes(const std::string& path);

/// The mesh alone; its warnings are dropped.
Mesh loadMesh(const std::string& path, const std::string& unit);

}  // namespace monocular_eye_hand
