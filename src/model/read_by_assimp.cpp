#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <sstream>

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

bool isWhole(const std::string& word) {
  const size_t first = word[0] == '-' ? 1 : 0;
  return first < word.size() && word.find_first_not_of("0123456789", first) == std::string::npos;
}

bool isReal(const std::string& word) {
  if (word.find_first_not_of("0123456789+-.eE") == std::string::npos)
    return word.find_first_of("0123456789") != std::string::npos;
  std::string low;
  for (const char c : word) low += char(std::tolower(static_cast<unsigned char>(c)));
  return low == "nan" || low == "inf" || low == "-inf";
}

/// assimp never returns from a list of indices that holds another word than a number.
void requireNumbers(const std::string& collada, const std::string& file) {
  for (const std::string tag : {"p", "v", "h", "vcount", "float_array", "int_array"}) {
    for (size_t at = collada.find("<" + tag); at != std::string::npos; at = collada.find("<" + tag, at + 1)) {
      const size_t after = at + 1 + tag.size(), begin = collada.find('>', at);
      if (begin == std::string::npos) break;
      if (after != begin && collada[after] != ' ') continue;  // a longer name
      const size_t end = std::min(collada.find('<', begin), collada.size());
      std::istringstream words(collada.substr(begin + 1, end - begin - 1));
      for (std::string word; words >> word;) {
        if (tag == "float_array" ? !isReal(word) : !isWhole(word))
          throw BadInput(file + ": a list <" + tag + "> holds \"" + word.substr(0, 24) +
                         "\", which is no number: the file is damaged, export it again");
      }
    }
  }
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
  if (collada) requireNumbers(text, file);
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
