#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "mesh/mesh_readers.h"
#include "mesh/text_scanner.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_content.h"
#include "monocular_eye_hand/mesh/topology.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kHeader = 84, kFacet = 50;  // binary STL: 80 bytes of text, a count, 50 bytes per triangle
constexpr uint32_t kUnknownCount = 0xffffffff;

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

class BinaryStl {
 public:
  BinaryStl(const std::string& bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  ReadMesh read() {
    out_.metres_per_unit = unitNamedIn(bytes_.substr(0, 80));
    size_t at = readSolid(0);
    // Several files one behind the other, as `cat` makes them.
    while (at < bytes_.size() && isWhole(at)) {
      warn("another solid stands behind the first one and was read, too");
      at = readSolid(at);
    }
    if (at < bytes_.size())
      warn(counted(bytes_.size() - at, "byte", "bytes") + " behind the triangles ignored");
    return std::move(out_);
  }

 private:
  void warn(const std::string& text) { out_.warnings.push_back(text); }
  size_t countAt(size_t begin) const { return littleEndian32(bytes_.data() + begin + 80); }
  const char* facet(size_t begin, size_t k) const { return bytes_.data() + begin + kHeader + k * kFacet; }

  bool isWhole(size_t begin) const {
    const size_t left = bytes_.size() - begin;
    return left >= kHeader && countAt(begin) > 0 && countAt(begin) <= (left - kHeader) / kFacet;
  }

  /// Returns where the bytes behind it begin.
  size_t readSolid(size_t begin) {
    const size_t said = countAt(begin), body = bytes_.size() - begin - kHeader, fit = body / kFacet;
    const bool unknown = said == 0 || said == kUnknownCount;  // what programs leave that write it last
    if (!unknown && said > fit) requireClosed(begin, said, fit, body % kFacet == 0);

    const bool more = !unknown && said < fit && body % kFacet == 0 && areFacets(begin, said, fit);
    const size_t count = unknown || said > fit || more ? fit : said;
    if (count != said)
      warn("the count says " + std::to_string(said) + " triangles, but the file holds " +
           std::to_string(count) + ", which were read");
    append(begin, count);
    return begin + kHeader + count * kFacet;
  }

  /// Fewer triangles than the count says: either the count is wrong, or the rest was cut off.
  void requireClosed(size_t begin, size_t said, size_t fit, bool whole) const {
    BinaryStl all(bytes_, file_);
    if (whole && fit > 0) all.append(begin, fit);
    if (isClosed(all.out_.mesh)) return;
    throw BadInput(file_ + ": a binary STL that says " + std::to_string(said) + " triangles must have " +
                   std::to_string(kHeader + kFacet * said) + " bytes, but the file has " +
                   std::to_string(bytes_.size()) + "; it is damaged or cut off: export it again");
  }

  /// True when the bytes behind the counted triangles look like more of them: as large, with an area.
  bool areFacets(size_t begin, size_t said, size_t fit) const {
    Eigen::AlignedBox3d box;
    for (size_t k = 0; k < said; ++k) {
      for (int c = 0; c < 3; ++c) box.extend(corner(facet(begin, k), c));
    }
    const double reach = 2 * box.diagonal().norm();
    for (size_t k = said; k < fit; ++k) {
      const Eigen::Vector3d a = corner(facet(begin, k), 0), b = corner(facet(begin, k), 1),
                            c = corner(facet(begin, k), 2);
      const bool area = (b - a).cross(c - a).norm() > 0;
      if (!area || !(box.exteriorDistance(a) + box.exteriorDistance(b) + box.exteriorDistance(c) < reach))
        return false;
    }
    return true;
  }

  static Eigen::Vector3d corner(const char* facet, int c) {
    const char* v = facet + 12 + 12 * c;
    return {littleEndianFloat(v), littleEndianFloat(v + 4), littleEndianFloat(v + 8)};
  }

  void append(size_t begin, size_t count) {
    Mesh& mesh = out_.mesh;
    mesh.vertices.reserve(mesh.vertices.size() + 3 * count);
    mesh.triangles.reserve(mesh.triangles.size() + count);
    for (size_t k = 0; k < count; ++k) {
      const int i = int(mesh.vertices.size());
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d p = corner(facet(begin, k), c);
        if (!p.allFinite())
          throw BadInput(file_ + ": triangle " + std::to_string(k) +
                         " has a corner that is not a finite number: repair the mesh or export it again");
        mesh.vertices.push_back(p);
      }
      mesh.triangles.push_back({i, i + 1, i + 2});
    }
  }

  const std::string& bytes_;
  const std::string& file_;
  ReadMesh out_;
};

class AsciiStl {
 public:
  AsciiStl(const std::string& bytes, const std::string& file) : scan_(bytes, 0, file) {}

  ReadMesh read() {
    while (!scan_.atEnd()) {
      const size_t before = scan_.position();
      const std::string word = lower(scan_.word());
      if (word == "solid") {
        const std::string name = scan_.line();
        if (out_.metres_per_unit == 0) out_.metres_per_unit = unitNamedIn(name);
        readSolid();
      } else if (word == "facet") {
        out_.warnings.push_back("a line \"solid\" is missing");
        scan_.moveTo(before);
        readSolid();
      } else if (before == 0 || out_.mesh.triangles.empty()) {
        unexpected(word, "solid");
      } else {
        const size_t ignored = scan_.remaining() + word.size();
        out_.warnings.push_back(counted(ignored, "byte", "bytes") + " behind endsolid ignored");
        break;
      }
    }

    if (other_lines_ > 0)
      out_.warnings.push_back(counted(other_lines_, "line that is", "lines that are") +
                              " no part of STL ignored");
    return std::move(out_);
  }

 private:
  void readSolid() {
    for (;;) {
      if (scan_.atEnd() && !out_.mesh.triangles.empty()) {
        out_.warnings.push_back(
            "endsolid is missing at the end: if faces are missing, the file was cut off; export it again");
        return;
      }

      const std::string word = lower(scan_.word());
      if (word == "endsolid" || (word == "end" && lower(scan_.word()) == "solid")) {
        scan_.line();
        return;
      }
      if (word == "color" || word[0] == '#') {
        ++other_lines_;
        scan_.line();
        continue;
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

    std::vector<int> polygon;
    std::string word = lower(scan_.word());
    for (; word == "vertex"; word = lower(scan_.word())) {
      const double x = scan_.number("a vertex's x"), y = scan_.number("a vertex's y"),
                   z = scan_.number("a vertex's z");
      polygon.push_back(int(out_.mesh.vertices.size()));
      out_.mesh.vertices.emplace_back(x, y, z);
    }

    if (polygon.size() < 3) unexpected(word, "vertex");
    expectEnd(word, "loop");
    expectEnd(lower(scan_.word()), "facet");
    appendPolygon(out_.mesh.vertices, polygon, &out_.mesh.triangles);
  }

  void expect(const char* keyword) {
    const std::string word = lower(scan_.word());
    if (word != keyword) unexpected(word, keyword);
  }

  /// "endloop" or "end loop".
  void expectEnd(const std::string& word, const std::string& what) {
    if (word == "end" + what) return;
    if (word != "end" || lower(scan_.word()) != what) unexpected(word, "end" + what);
  }

  [[noreturn]] void unexpected(const std::string& word, const std::string& wanted) {
    if (word.empty())
      scan_.fail("the file ends where " + wanted + " should stand; it was cut off: export it again");
    scan_.fail("found \"" + word.substr(0, 24) + "\" where " + wanted +
               " should stand; this is no valid ascii STL");
  }

  TextScanner scan_;
  ReadMesh out_;
  size_t other_lines_ = 0;
};

/// Ascii files start with "solid", but so do many binary ones: binary bytes near the start decide.
bool isText(const std::string& bytes) {
  const size_t last = bytes.find_last_not_of('\0');  // some programs fill the last block with zeros
  return !looksBinary(bytes.substr(0, std::min<size_t>(last + 1, 1024)));
}

}  // namespace

bool isExactBinaryStl(const std::string& bytes) {
  if (bytes.size() <= kHeader) return false;
  return bytes.size() == kHeader + kFacet * size_t(littleEndian32(bytes.data() + 80));
}

ReadMesh readStl(const std::string& bytes, const std::string& file) {
  if (!isExactBinaryStl(bytes) && isText(bytes)) return AsciiStl(bytes, file).read();
  if (bytes.size() < kHeader)
    throw BadInput(file + ": " + std::to_string(bytes.size()) +
                   " bytes are too few for a binary STL; it was cut off: export it again");
  return BinaryStl(bytes, file).read();
}

}  // namespace monocular_eye_hand
