#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <sstream>
#include <system_error>

#include "mesh/assimp_answer.h"
#include "mesh/child_process.h"
#include "mesh/mesh_readers.h"
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

/// The text without its libraries of materials, which the part does not need: assimp would look for them in
/// the working folder, and sort the triangles in another way when it finds them.
std::string withoutMaterials(const std::string& obj) {
  const std::string word = "mtllib";
  std::string out;
  out.reserve(obj.size());
  for (size_t at = 0; at < obj.size();) {
    const size_t end = std::min(obj.find('\n', at), obj.size() - 1) + 1;
    const bool names_one = obj.compare(at, word.size(), word) == 0;
    out += names_one ? "#" : "";
    at += names_one ? word.size() : 0;
    out.append(obj, at, end - at);
    at = end;
  }
  return out;
}

bool isWholeNumber(const std::string& word) {
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
        if (tag == "float_array" ? !isReal(word) : !isWholeNumber(word))
          throw BadInput(file + ": a list <" + tag + "> holds \"" + word.substr(0, 24) +
                         "\", which is no number: the file is damaged, export it again");
      }
    }
  }
}

/// assimp runs in a process of its own, the program assimp_reader: what crashes it, never returns from it or
/// eats the memory is then a file that is refused, not the end of a node. A program rather than a fork,
/// because a node has threads whose locks a fork would copy in any state. There is no second way, in this
/// process: it would be taken where nobody knows that the first one is missing.
std::string readerProgram() {
  static const char kHere = 0;
  const std::string library = fileOf(&kHere);
  const size_t slash = library.rfind('/');
  return (slash == std::string::npos ? "" : library.substr(0, slash + 1)) +
         "monocular_eye_hand/assimp_reader";
}

ChildResult runReader(const std::string& text, const std::string& file, const std::string& extension,
                      const AssimpLimits& limits) {
  const std::string program = readerProgram();
  try {
    return runChild(program, {extension, std::to_string(limits.seconds), std::to_string(limits.megabytes)},
                    text);
  } catch (const std::system_error& e) {
    throw BadInput(file + ": the program " + program + ", which reads OBJ and DAE, cannot be started (" +
                   e.code().message() + "): install the package whole, or export the part as STL");
  }
}

/// A whole answer counts, however the process ended.
bool isWhole(const std::string& output, AssimpAnswerHead* head) {
  if (output.size() < sizeof *head) return false;
  std::memcpy(head, output.data(), sizeof *head);
  if (std::memcmp(head->magic, kAssimpMagic, sizeof head->magic) != 0) return false;
  const uint64_t rest = output.size() - sizeof *head;
  if (head->outcome == AssimpOutcome::kRefused) return head->text == rest;
  return head->vertices <= rest / sizeof(Eigen::Vector3d) &&
         head->triangles == (rest - head->vertices * sizeof(Eigen::Vector3d)) / sizeof(std::array<int, 3>);
}

Mesh meshIn(const std::string& output, const AssimpAnswerHead& head, const std::string& file) {
  Mesh mesh;
  mesh.vertices.resize(head.vertices);
  mesh.triangles.resize(head.triangles);
  const char* at = output.data() + sizeof head;
  for (Eigen::Vector3d& v : mesh.vertices) {
    std::memcpy(v.data(), at, sizeof v);
    at += sizeof v;
  }
  for (std::array<int, 3>& triangle : mesh.triangles) {
    std::memcpy(triangle.data(), at, sizeof triangle);
    at += sizeof triangle;
    for (const int index : triangle) {
      if (index < 0 || uint64_t(index) >= head.vertices)
        throw BadInput(file + ": a face names a vertex that is missing");
    }
  }
  return mesh;
}

}  // namespace

std::string assimpProblem(int status, const AssimpLimits& limits) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const std::string cure = "it is damaged or far too large: export it as STL";
  if (signal == SIGXCPU || signal == SIGALRM)
    return "reading the file takes longer than " + std::to_string(limits.seconds) + " s; " + cure;
  if (signal == SIGKILL || (WIFEXITED(status) && WEXITSTATUS(status) == kAssimpNoMemory))
    return "reading the file takes more memory than there is (at most " + std::to_string(limits.megabytes) +
           " MB are allowed); " + cure;
  if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP)
    return "reading the file was interrupted; try again";
  const std::string how =
      signal != 0 ? "signal " + std::to_string(signal) : "exit code " + std::to_string(WEXITSTATUS(status));
  return "the file crashes the reader of OBJ and DAE (assimp, " + how + "): export it as STL";
}

ReadMesh readByAssimp(const std::string& bytes, const std::string& file, const std::string& extension,
                      const AssimpLimits& limits) {
  const bool collada = extension == "dae";
  const std::string text = collada ? withoutUnit(bytes) : withLineFeeds(bytes);
  if (collada) requireNumbers(text, file);
  const ChildResult child = runReader(collada ? text : withoutMaterials(text), file, extension, limits);
  AssimpAnswerHead head;
  if (!isWhole(child.output, &head)) throw BadInput(file + ": " + assimpProblem(child.status, limits));
  if (head.outcome == AssimpOutcome::kRefused) throw BadInput(file + ": " + child.output.substr(sizeof head));

  ReadMesh out;
  out.metres_per_unit = collada ? colladaUnit(bytes) : unitNamedIn(commentsOf(text));
  out.mesh = meshIn(child.output, head, file);
  return out;
}

}  // namespace monocular_eye_hand
