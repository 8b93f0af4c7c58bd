#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "mesh/mesh_readers.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_content.h"
#include "monocular_eye_hand/io/plain_number.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMaxBytes = size_t(1) << 30;
constexpr double kFarthest = 1e6;  // of a vertex from the origin [m]

std::string extensionOf(const std::string& path) {
  const size_t dot = path.find_last_of("./");
  std::string extension = dot == std::string::npos || path[dot] == '/' ? "" : path.substr(dot + 1);
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool isKnown(const std::string& kind) {
  return kind == "stl" || kind == "ply" || kind == "obj" || kind == "dae";
}

std::string firstWord(const std::string& text) {
  std::istringstream in(text.substr(0, 200));
  std::string word;
  in >> word;
  for (char& c : word) c = char(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

/// True for text that has a vertex line and a face line of an OBJ.
bool looksLikeObj(const std::string& text) {
  bool vertex = false;
  for (size_t at = 0; at < text.size();) {
    vertex = vertex || text.compare(at, 2, "v ") == 0;
    if (vertex && text.compare(at, 2, "f ") == 0) return true;
    const size_t end = text.find_first_of("\r\n", at);
    at = end == std::string::npos ? text.size() : end + 1;
  }
  return false;
}

/// The kind that the content shows; "" when it shows none.
std::string kindShown(const std::string& bytes) {
  if (isExactBinaryStl(bytes)) return "stl";
  const std::string word = firstWord(bytes);
  if (word == "ply") return "ply";
  if (looksBinary(bytes)) return "";
  if (word == "solid" || word == "facet") return "stl";
  if (bytes.substr(0, 4096).find("<COLLADA") != std::string::npos) return "dae";
  return looksLikeObj(bytes) ? "obj" : "";
}

ReadMesh readAs(const std::string& kind, const std::string& bytes, const std::string& path) {
  if (kind == "stl") return readStl(bytes, path);
  if (kind == "ply") return readPly(bytes, path);
  return readByAssimp(bytes, path, kind);
}

ReadMesh read(std::string bytes, const std::string& path) {
  const std::string extension = extensionOf(path);
  std::vector<std::string> warnings;
  // A binary STL may begin with any text.
  if (!isExactBinaryStl(bytes)) {
    const std::string foreign = foreignContent(bytes);
    if (!foreign.empty()) throw BadInput(path + ": this is " + foreign);
    PlainText plain = plainText(std::move(bytes));
    bytes = std::move(plain.text);
    warnings = std::move(plain.warnings);
    const bool returns_alone =
        !looksBinary(bytes) && bytes.find('\n') == std::string::npos && bytes.find('\r') != std::string::npos;
    if (returns_alone) warnings.push_back("its lines end in carriage returns alone");
  }
  const std::string shown = kindShown(bytes);
  const std::string kind = shown.empty() ? extension : shown;
  if (!isKnown(kind))
    throw BadInput(path + ": unknown kind of mesh \"" + extension +
                   "\"; known: stl, ply, obj, dae. Export it as STL");
  if (kind != extension)
    warnings.push_back("the file is named ." + extension + " but its content is that of ." + kind +
                       ": it was read as that");

  ReadMesh out = readAs(kind, bytes, path);
  out.warnings.insert(out.warnings.begin(), warnings.begin(), warnings.end());
  if (out.mesh.triangles.empty())
    throw BadInput(path + ": the mesh has no triangles" +
                   (out.mesh.vertices.empty() ? "" : ", it is a point cloud") +
                   "; export the part's solid as STL");
  return out;
}

std::string unitText(double metres) {
  for (const char* name : {"m", "cm", "mm", "inch"}) {
    if (std::abs(metresPerUnit(name) / metres - 1) < 1e-3) return std::string(name);
  }
  return plainNumber(metres) + " m";
}

/// What the file says about its unit against what the user says.
void compareUnits(const std::string& stated, ReadMesh* read) {
  const double metres = metresPerUnit(stated), of_file = read->metres_per_unit;
  if (of_file <= 0 || std::abs(of_file / metres - 1) < 1e-3) return;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : read->mesh.vertices) box.extend(v);
  const double largest = box.sizes().maxCoeff();
  read->warnings.push_back("the file says that its unit is " + unitText(of_file) +
                           ", but the stated unit is " + stated + ", which counts: the part is " +
                           plainNumber(1000 * metres * largest) + " mm long, by the file's own unit " +
                           plainNumber(1000 * of_file * largest) + " mm");
}

void scale(double metres, const std::string& path, Mesh* mesh) {
  for (Eigen::Vector3d& v : mesh->vertices) {
    v *= metres;
    if (!v.allFinite() || v.cwiseAbs().maxCoeff() > kFarthest)
      throw BadInput(path +
                     ": a vertex lies more than 1000 km from the origin or is not finite; repair the mesh");
  }
}

}  // namespace

std::string meshFileBytes(const std::string& path) { return readFileBytes(path, "a mesh file", kMaxBytes); }

LoadedMesh readMesh(const std::string& path, const std::string& unit) {
  const double metres = metresPerUnit(unit);
  ReadMesh file = read(meshFileBytes(path), path);
  compareUnits(unit, &file);
  scale(metres, path, &file.mesh);
  return {std::move(file.mesh), std::move(file.warnings)};
}

Mesh loadMesh(const std::string& path, const std::string& unit) { return readMesh(path, unit).mesh; }

}  // namespace monocular_eye_hand
