// The program that reads OBJ and DAE: assimp in a process of its own, see read_by_assimp.cpp.
//   assimp_reader KIND SECONDS MEGABYTES <mesh >answer      standard input must be a file, KIND is obj or dae
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "mesh/assimp_answer.h"

namespace monocular_eye_hand {
namespace {

struct Triangles {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

[[noreturn]] void giveUp(const char* why) {
  std::fprintf(stderr, "assimp_reader: %s\n", why);
  _exit(2);
}

void limit(int resource, rlim_t soft, rlim_t hard) {
  rlimit now;
  // The limits of the one who started this may be tighter.
  if (getrlimit(resource, &now) == 0 && now.rlim_max != RLIM_INFINITY && now.rlim_max < hard)
    hard = now.rlim_max;
  const rlimit wanted{soft < hard ? soft : hard, hard};
  if (setrlimit(resource, &wanted) != 0) giveUp("the limits cannot be set");
}

/// The system ends this process when it takes more.
void limitMyself(unsigned seconds, size_t megabytes) {
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, seconds, seconds + 1);
  alarm(10 * seconds);  // a file that names another one, a pipe for instance, may wait for ever
#ifdef __SANITIZE_ADDRESS__
  (void)megabytes;  // the address sanitizer reserves terabytes of addresses
#else
  limit(RLIMIT_AS, megabytes << 20, megabytes << 20);
#endif
  std::set_new_handler([] { _exit(kAssimpNoMemory); });
}

/// Returns the reason of a refusal, "" when all triangles are there.
std::string append(const aiMesh& part, Triangles* out) {
  const auto first = uint32_t(out->vertices.size());
  for (unsigned k = 0; k < part.mNumVertices; ++k) {
    const aiVector3D& v = part.mVertices[k];
    out->vertices.push_back({v.x, v.y, v.z});
  }
  for (unsigned k = 0; k < part.mNumFaces; ++k) {
    const aiFace& face = part.mFaces[k];
    if (face.mNumIndices != 3) continue;
    std::array<uint32_t, 3> triangle;
    for (int c = 0; c < 3; ++c) {
      if (face.mIndices[c] >= part.mNumVertices) return "a face names a vertex that is missing";
      triangle[c] = first + face.mIndices[c];
    }
    out->triangles.push_back(triangle);
  }
  return "";
}

std::string read(const char* bytes, size_t size, const char* kind, Triangles* out) {
  Assimp::Importer importer;
  // The object frame is the file's frame in the unit the user states: no turning of "up", no scaling.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFileFromMemory(
      bytes, size, aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_SortByPType, kind);
  std::string refused = scene ? "" : std::string(importer.GetErrorString()) + "; export it again";
  for (unsigned m = 0; scene && refused.empty() && m < scene->mNumMeshes; ++m)
    refused = append(*scene->mMeshes[m], out);
  // Nobody needs the scene any more, and taking apart one that is damaged may crash.
  importer.GetOrphanedScene();
  return refused;
}

void write(const void* data, size_t size) {
  if (size > 0 && std::fwrite(data, 1, size, stdout) != size) giveUp("the answer cannot be written");
}

void answer(const std::string& refused, const Triangles& mesh) {
  AssimpAnswerHead head{};
  std::memcpy(head.magic, kAssimpMagic, sizeof head.magic);
  head.outcome = refused.empty() ? AssimpOutcome::kRead : AssimpOutcome::kRefused;
  head.vertices = refused.empty() ? mesh.vertices.size() : 0;
  head.triangles = refused.empty() ? mesh.triangles.size() : 0;
  head.text = refused.size();
  write(&head, sizeof head);
  write(mesh.vertices.data(), head.vertices * sizeof mesh.vertices[0]);
  write(mesh.triangles.data(), head.triangles * sizeof mesh.triangles[0]);
  write(refused.data(), refused.size());
}

int run(const char* kind) {
  struct stat info;
  if (fstat(STDIN_FILENO, &info) != 0 || info.st_size <= 0) giveUp("standard input is no file with a mesh");
  const auto size = size_t(info.st_size);
  void* bytes = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, STDIN_FILENO, 0);
  if (bytes == MAP_FAILED) return kAssimpNoMemory;

  Triangles mesh;
  const std::string refused = read(static_cast<const char*>(bytes), size, kind, &mesh);
  answer(refused, mesh);
  return std::fflush(stdout) == 0 ? 0 : 2;
}

}  // namespace
}  // namespace monocular_eye_hand

int main(int argc, char** argv) {
  const int seconds = argc == 4 ? std::atoi(argv[2]) : 0, megabytes = argc == 4 ? std::atoi(argv[3]) : 0;
  if (seconds < 1 || megabytes < 1) {
    std::fprintf(stderr,
                 "usage: assimp_reader KIND SECONDS MEGABYTES <mesh >answer\n"
                 "The package starts this to read OBJ and DAE; to look at such a file use model_check.\n");
    return 2;
  }
  monocular_eye_hand::limitMyself(unsigned(seconds), size_t(megabytes));
  _exit(monocular_eye_hand::run(argv[1]));
}
