#include <sys/stat.h>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>

#include "mesh_readers.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/model_base.h"

namespace monocular_eye_hand {
namespace {

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}};

std::string extensionOf(const std::string& path) {
  const size_t dot = path.find_last_of("./");
  std::string extension = dot == std::string::npos || path[dot] == '/' ? "" : path.substr(dot + 1);
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Mesh read(const std::string& bytes, const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension == "stl") return readStl(bytes, path);
  if (extension == "ply") return readPly(bytes, path);
  if (extension == "obj" || extension == "dae") return readByAssimp(bytes, path, extension);
  throw BadInput(path + ": unknown kind of mesh \"" + extension +
                 "\"; known: stl, ply, obj, dae. Export it as STL");
}

bool leftOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x()) > 0;
}

/// The scale assimp applies to a COLLADA file: its <unit meter="...">. The stated unit is the one that
/// counts, so the caller takes it out again.
double colladaUnit(const std::string& bytes) {
  const size_t tag = bytes.find("<unit");
  if (tag == std::string::npos) return 1.0;
  const size_t end = bytes.find('>', tag), meter = bytes.find("meter=", tag);
  if (meter == std::string::npos || meter + 7 >= bytes.size() || meter > end) return 1.0;
  std::istringstream in(bytes.substr(meter + 7, 32));
  in.imbue(std::locale::classic());
  double value = 0;
  return (in >> value) && std::isfinite(value) && value > 0 ? value : 1.0;
}

}  // namespace

double metresPerUnit(const std::string& unit) {
  std::string known;
  for (const Unit& u : kUnits) {
    if (unit == u.name) return u.metres;
    known += (known.empty() ? "" : ", ") + std::string(u.name);
  }
  throw BadInput("unknown unit \"" + unit.substr(0, 24) + "\"; known: " + known);
}

std::string readFileBytes(const std::string& path) {
  struct stat info;
  if (stat(path.c_str(), &info) != 0) throw BadInput(path + ": there is no such file; check the path");
  if (S_ISDIR(info.st_mode)) throw BadInput(path + ": this is a folder, not a mesh file");
  if (info.st_size == 0) throw BadInput(path + ": the file is empty; export it again");
  if (info.st_size > (int64_t(1) << 30)) throw BadInput(path + ": larger than 1 GB; reduce the mesh first");
  std::ifstream in(path, std::ios::binary);
  std::string bytes(size_t(info.st_size), '\0');
  if (!in || !in.read(&bytes[0], std::streamsize(bytes.size()))) {
    throw BadInput(path + ": the file cannot be read; check its permissions");
  }
  return bytes;
}

void appendPolygon(const std::vector<Eigen::Vector3d>& vertices, const std::vector<int>& polygon,
                   std::vector<std::array<int, 3>>* triangles) {
  std::vector<int> left = polygon;
  constexpr size_t kLargest = 2000;  // ear clipping takes cubic time at worst
  if (left.size() > 3 && left.size() <= kLargest) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // Newell's method
    for (size_t k = 0; k < left.size(); ++k) {
      normal += vertices[left[k]].cross(vertices[left[(k + 1) % left.size()]]);
    }
    const Eigen::Vector3d n = normal.norm() > 0 ? normal.normalized() : Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d u = n.unitOrthogonal(), v = n.cross(u);
    const auto flat = [&](int i) { return Eigen::Vector2d(u.dot(vertices[i]), v.dot(vertices[i])); };
    while (left.size() > 3) {
      size_t ear = left.size();
      for (size_t k = 0; k < left.size() && ear == left.size(); ++k) {
        const int a = left[(k + left.size() - 1) % left.size()], b = left[k], c = left[(k + 1) % left.size()];
        const Eigen::Vector2d pa = flat(a), pb = flat(b), pc = flat(c);
        if (!leftOf(pa, pb, pc)) continue;
        const bool blocked = std::any_of(left.begin(), left.end(), [&](int i) {
          const Eigen::Vector2d p = flat(i);
          return i != a && i != b && i != c && leftOf(pa, pb, p) && leftOf(pb, pc, p) && leftOf(pc, pa, p);
        });
        if (!blocked) ear = k;
      }
      if (ear == left.size()) ear = 1;  // collinear or self-crossing: any cut is as good
      const size_t n_left = left.size();
      triangles->push_back({left[(ear + n_left - 1) % n_left], left[ear], left[(ear + 1) % n_left]});
      left.erase(left.begin() + long(ear));
    }
  }
  for (size_t k = 2; k < left.size(); ++k) triangles->push_back({left[0], left[k - 1], left[k]});
}

Mesh readByAssimp(const std::string& bytes, const std::string& file, const std::string& extension) {
  Assimp::Importer importer;
  // The object frame is the file's frame in the unit the user states: no turning of "up", no scaling.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFileFromMemory(
      bytes.data(), bytes.size(),
      aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType, extension.c_str());
  if (!scene) throw BadInput(file + ": " + importer.GetErrorString() + "; export it again");
  const double file_scale = extension == "dae" ? colladaUnit(bytes) : 1.0;
  Mesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const int first = int(mesh.vertices.size());
    for (unsigned k = 0; k < part.mNumVertices; ++k) {
      const aiVector3D& v = part.mVertices[k];
      mesh.vertices.push_back(Eigen::Vector3d(v.x, v.y, v.z) / file_scale);
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
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

Mesh loadMesh(const std::string& path, const std::string& unit) {
  const double scale = metresPerUnit(unit);
  Mesh mesh = read(readFileBytes(path), path);
  if (mesh.triangles.empty())
    throw BadInput(path + ": the mesh has no triangles; export the part's solid as STL");
  for (Eigen::Vector3d& v : mesh.vertices) {
    v *= scale;
    if (!v.allFinite() || v.cwiseAbs().maxCoeff() > 1e6) {
      throw BadInput(path +
                     ": a vertex lies more than 1000 km from the origin or is not finite; repair the mesh");
    }
  }
  return mesh;
}

}  // namespace monocular_eye_hand
