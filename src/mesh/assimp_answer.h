#pragma once
#include <cstdint>

namespace monocular_eye_hand {

// What the program assimp_reader writes, in this machine's byte order: this head; then of a mesh that was
// read its vertices (three doubles each) and its triangles (three indices each), of one that was refused the
// reason.

enum class AssimpOutcome : uint32_t { kRead = 1, kRefused = 2 };

struct AssimpAnswerHead {
  char magic[8];
  AssimpOutcome outcome;
  uint32_t reserved;
  uint64_t vertices, triangles;  ///< kRead
  uint64_t text;                 ///< kRefused: bytes of the reason
};

constexpr char kAssimpMagic[] = "MEHMESH";  // with its end 8 bytes
constexpr int kAssimpNoMemory = 3;          // exit code: more memory was asked for than is allowed

}  // namespace monocular_eye_hand
