#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "mesh_readers.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_content.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kCommentBytes = 4096;  // at the start of an OBJ, where exporters state the unit

/// The text without its <unit>: assimp would scale by it, and misreads "0,001". The stated unit counts.
std::string withoutUnit(std::string text) {
  const size_t begin = text.find("<unit");
  const size_t end = begin == std::string::npos ? begin : text.find('>', begin);
  if (end == std::string::npos) return text;
  const bool closed = text[end - 1] == '/';
  return text.replace(begin, end + 1 - begin, closed ? "<unit meter=\"1\"/>" : "<unit meter=\"1\">");
}

std::string commentsOf(const std::string& obj) {
  std::string out;
  for (size_t at = 0; at < std::min(obj.size(), kCommentBytes);) {
    const size_t end = std::min(obj.find('\n', at), obj.size());
    if (obj[at] == '#') out += obj.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return out;
}

void append(const aiMesh& part, const std::string& file, Mesh* mesh) {
  const int first = int(mesh->vertices.size());
  for (unsigned k = 0; k < part.mNumVertices; ++k) {
    const aiVector3D& v = part.mVertices[k];
    mesh->vertices.emplace_back(v.x, v.y, v.z);
  }
  for (unsigned k = 0; k < part.mNumFaces; ++k) {
    const aiFace& face = part.mFaces[k];
    if (face.mNumIndices != 3) continue;
    std::array<int, 3> triangle;
    for (int c = 0; c < 3; ++c) {
      if (face.mIndices[c] >= part.mNumVertices)
        throw BadInput(file + ": a face names a vertex that is missing");
      triangle[c] = first + int(face.mIndices[c]);
    }
    mesh->triangles.push_back(triangle);
  }
}

}  // namespace

ReadMesh readByAssimp(const std::string& bytes, const std::string& file, const std::string& extension) {
  const bool collada = extension == "dae";
  const std::string text = collada ? withoutUnit(bytes) : withLineFeeds(bytes);
  Assimp::Importer importer;
  // The object frame is the file's frame in the unit the user states: no turning of "up", no scaling.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFileFromMemory(
      text.data(), text.size(),
      aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType, extension.c_str());
  if (!scene) throw BadInput(file + ": " + importer.GetErrorString() + "; export it again");

  ReadMesh out;
  out.metres_per_unit = collada ? colladaUnit(bytes) : unitNamedIn(commentsOf(text));
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) append(*scene->mMeshes[m], file, &out.mesh);
  return out;
}

}  // namespace monocular_eye_hand
