#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/mesh/mesh.h"

namespace monocular_eye_hand {

// Readers of untrusted mesh files. `bytes` is the whole file, `file` its name for messages. All throw
// BadInput naming the file, what is wrong, and where.

/// A mesh in the file's own unit and frame, with what the reader ignored or put right.
struct ReadMesh {
  Mesh mesh;
  std::vector<std::string> warnings;
  double metres_per_unit = 0;  ///< as the file states it; 0: it states none
};

/// "1 byte", "92 bytes".
std::string counted(size_t count, const std::string& one, const std::string& many);

ReadMesh readStl(const std::string& bytes, const std::string& file);  ///< ascii or binary, told apart by size
ReadMesh readPly(const std::string& bytes, const std::string& file);  ///< ascii, binary of both byte orders

/// What the process that runs assimp may take.
struct AssimpLimits {
  int seconds = 60;      ///< of the processor
  int megabytes = 4096;  ///< of addresses; not under the address sanitizer
};
ReadMesh readByAssimp(const std::string& bytes, const std::string& file, const std::string& extension,
                      const AssimpLimits& limits = {});  ///< OBJ, DAE
/// Why a process of this wait status gave no answer, and what to do.
std::string assimpProblem(int status, const AssimpLimits& limits);

/// True when the bytes are a binary STL whose count of triangles is that of its size.
bool isExactBinaryStl(const std::string& bytes);

/// Appends a polygon as triangles: ear clipping in its plane, so that concave polygons stay inside their
/// outline.
void appendPolygon(const std::vector<Eigen::Vector3d>& vertices, const std::vector<int>& polygon,
                   std::vector<std::array<int, 3>>* triangles);

/// Metres of the unit that a text names beside the word "unit" ("units: mm", "File units = inches"); 0 when
/// it names none.
double unitNamedIn(const std::string& text);

/// Metres of a COLLADA file's <unit meter="...">; 0 when it states none.
double colladaUnit(const std::string& bytes);

}  // namespace monocular_eye_hand
