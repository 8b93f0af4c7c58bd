#pragma once
#include <string>
#include <vector>

namespace monocular_eye_hand::fuzz {

/// A file that its loader reads, before it is damaged.
struct SeedFile {
  std::string extension;
  std::string bytes;
};

std::vector<SeedFile> meshSeeds();         ///< STL, PLY, OBJ, DAE in all their forms, in millimetres
std::vector<SeedFile> calibrationSeeds();  ///< one of every kind that readCameraFile tells apart
/// Lists of objects whose meshes are box.stl in the folder of the list.
std::vector<SeedFile> objectListSeeds();
std::vector<SeedFile> optionSeeds();  ///< YAML of FuzzedOptions and of anything else

}  // namespace monocular_eye_hand::fuzz
