#include <cmath>
#include <cstdint>
#include <cstring>

#include "mesh_readers.h"
#include "monocular_eye_hand/geometry/error.h"
#include "text_scanner.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kHeader = 84, kFacet = 50;  // binary STL: 80 bytes of text, a count, 50 bytes per triangle

uint32_t littleEndian32(const char* p) {
  const auto* b = reinterpret_cast<const unsigned char*>(p);
  return uint32_t(b[0]) | uint32_t(b[1]) << 8 | uint32_t(b[2]) << 16 | uint32_t(b[3]) << 24;
}

float littleEndianFloat(const char* p) {
  const uint32_t bits = littleEndian32(p);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::string lower(std::string s) {
  for (char& c : s) c = (c >= 'A' && c <= 'Z') ? char(c - 'A' + 'a') : c;
  return s;
}

Mesh readBinary(const std::string& bytes, const std::string& file, size_t count) {
  Mesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (size_t k = 0; k < count; ++k) {
    const char* facet = bytes.data() + kHeader + k * kFacet;
    for (int c = 0; c < 3; ++c) {
      const char* v = facet + 12 + 12 * c;
      const Eigen::Vector3d p(littleEndianFloat(v), littleEndianFloat(v + 4), littleEndianFloat(v + 8));
      if (!p.allFinite()) {
        throw BadInput(file + ": triangle " + std::to_string(k) +
                       " has a corner that is not a finite number: repair the mesh or export it again");
      }
      mesh.vertices.push_back(p);
    }
    const int i = int(3 * k);
    mesh.triangles.push_back({i, i + 1, i + 2});
  }
  return mesh;
}

class AsciiStl {
 public:
  AsciiStl(const std::string& bytes, const std::string& file) : scan_(bytes, 0, file) {}

  Mesh read() {
    while (!scan_.atEnd()) {
      expect("solid");
      scan_.line();  // the solid's name
      readSolid();
    }
    return std::move(mesh_);
  }

 private:
  void readSolid() {
    for (;;) {
      const std::string word = lower(scan_.word());
      if (word == "endsolid") {
        scan_.line();
        return;
      }
      if (word != "facet") unexpected(word, "facet or endsolid");
      readFacet();
    }
  }

  void readFacet() {
    expect("normal");
    // The normal is recomputed from the corners; many exporters write nan for degenerate triangles.
    for (int k = 0; k < 3; ++k) {
      if (scan_.word().empty()) unexpected("", "the facet's normal");
    }
    expect("outer");
    expect("loop");
    const int first = int(mesh_.vertices.size());
    for (int k = 0; k < 3; ++k) {
      expect("vertex");
      const double x = scan_.number("a vertex's x"), y = scan_.number("a vertex's y"),
                   z = scan_.number("a vertex's z");
      mesh_.vertices.emplace_back(x, y, z);
    }
    expect("endloop");
    expect("endfacet");
    mesh_.triangles.push_back({first, first + 1, first + 2});
  }

  void expect(const char* keyword) {
    const std::string word = lower(scan_.word());
    if (word != keyword) unexpected(word, keyword);
  }

  [[noreturn]] void unexpected(const std::string& word, const std::string& wanted) {
    if (word.empty())
      scan_.fail("the file ends where " + wanted + " should stand; it was cut off: export it again");
    scan_.fail("found \"" + word.substr(0, 24) + "\" where " + wanted +
               " should stand; this is no valid ascii STL");
  }

  TextScanner scan_;
  Mesh mesh_;
};

/// Ascii files start with "solid", but so do many binary ones: binary bytes near the start decide.
bool looksAscii(const std::string& bytes) {
  TextScanner scan(bytes, 0, "");
  if (lower(scan.word()) != "solid") return false;
  const size_t end = std::min<size_t>(bytes.size(), 1024);
  for (size_t k = 0; k < end; ++k) {
    if (bytes[k] == '\0') return false;
  }
  return true;
}

}  // namespace

Mesh readStl(const std::string& bytes, const std::string& file) {
  const size_t count = bytes.size() >= kHeader ? littleEndian32(bytes.data() + 80) : 0;
  const bool size_fits = bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * count;
  if (!size_fits && looksAscii(bytes)) return AsciiStl(bytes, file).read();
  if (bytes.size() < kHeader) {
    throw BadInput(file + ": " + std::to_string(bytes.size()) +
                   " bytes are too few for an STL file; it was cut off: export it again");
  }
  if (!size_fits) {
    throw BadInput(file + ": a binary STL that says " + std::to_string(count) + " triangles must have " +
                   std::to_string(kHeader + kFacet * count) + " bytes, but the file has " +
                   std::to_string(bytes.size()) + "; it is damaged or cut off: export it again");
  }
  return readBinary(bytes, file, count);
}

}  // namespace monocular_eye_hand
