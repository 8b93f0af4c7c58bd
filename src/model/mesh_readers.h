#pragma once
#include <string>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

// Readers of untrusted mesh files. `bytes` is the whole file, `file` its name for messages. Vertices come
// back in the file's own unit and frame. All throw BadInput naming the file, what is wrong, and where.

/// The whole file. Throws BadInput when it is missing, a folder, empty or larger than 1 GB.
std::string readFileBytes(const std::string& path);

Mesh readStl(const std::string& bytes, const std::string& file);  ///< ascii or binary, told apart by size
Mesh readPly(const std::string& bytes, const std::string& file);  ///< ascii, binary of both byte orders
Mesh readByAssimp(const std::string& bytes, const std::string& file,
                  const std::string& extension);  ///< OBJ, DAE

/// Appends a polygon as triangles: ear clipping in its plane, so that concave polygons stay inside their
/// outline.
void appendPolygon(const std::vector<Eigen::Vector3d>& vertices, const std::vector<int>& polygon,
                   std::vector<std::array<int, 3>>* triangles);

}  // namespace monocular_eye_hand
