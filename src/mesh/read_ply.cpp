#include <cmath>
#include <cstdint>
#include <cstring>

#include "mesh/mesh_readers.h"
#include "mesh/ply_header.h"
#include "mesh/text_scanner.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/topology.h"

namespace monocular_eye_hand {
namespace {

constexpr long long kMaxOfOne = 200000000;

/// Numbers of the data, one after the other, whatever the format.
class PlyData {
 public:
  PlyData(const std::string& bytes, const std::string& file)
      : bytes_(bytes), file_(file), scan_(bytes, 0, file) {}

  PlyHeader readHeader() {
    PlyHeader header = readPlyHeader(bytes_, file_, &scan_);
    format_ = header.format;
    at_ = scan_.position();
    return header;
  }

  [[noreturn]] void fail(const std::string& problem) const { throw BadInput(file_ + ": " + problem); }

  bool isAscii() const { return format_ == PlyFormat::kAscii; }
  bool atEnd() { return isAscii() ? scan_.atEnd() : at_ == bytes_.size(); }
  size_t left() const { return isAscii() ? scan_.remaining() : bytes_.size() - at_; }
  size_t minSize(const PlyType& type) const { return isAscii() ? 2 : size_t(type.size); }
  /// How many numbers of at least so many bytes may follow; the last of a text has no line end.
  size_t room(size_t min_size) const { return (left() + (isAscii() ? 1 : 0)) / min_size; }

  /// Where the next number stands, and back to there.
  size_t position() const { return isAscii() ? scan_.position() : at_; }
  void moveTo(size_t position) { isAscii() ? scan_.moveTo(position) : void(at_ = position); }

  double number(const PlyType& type, const char* what) {
    if (isAscii()) return type.kind == 'f' ? scan_.anyNumber(what) : double(scan_.integer(what));
    if (left() < size_t(type.size))
      fail(std::string("the file ends where ") + what + " should stand; it was cut off: export it again");
    uint64_t bits = 0;
    for (int k = 0; k < type.size; ++k) {
      const int byte = format_ == PlyFormat::kLittleEndian ? type.size - 1 - k : k;
      bits = bits << 8 | uint64_t(static_cast<unsigned char>(bytes_[at_ + byte]));
    }
    at_ += type.size;
    return fromBits(type, bits);
  }

  std::vector<double> list(const PlyProperty& p) {
    const double count = number(*p.count, "the length of a list");
    if (count < 0 || size_t(count) > room(minSize(*p.type)))
      fail("a list says " + std::to_string((long long)(count)) +
           " entries, more than the rest of the file holds; it is damaged or cut off: export it again");
    std::vector<double> out;
    for (size_t k = 0; k < size_t(count); ++k) out.push_back(number(*p.type, "a list entry"));
    return out;
  }

 private:
  static double fromBits(const PlyType& type, uint64_t bits) {
    if (type.kind == 'u') return double(bits);
    if (type.kind == 'i') {
      const uint64_t sign = uint64_t(1) << (8 * type.size - 1);
      return double(int64_t(bits ^ sign) - int64_t(sign));
    }
    if (type.size == 8) {
      double v;
      std::memcpy(&v, &bits, sizeof v);
      return v;
    }
    const uint32_t low = uint32_t(bits);
    float v;
    std::memcpy(&v, &low, sizeof v);
    return v;
  }

  const std::string& bytes_;
  const std::string& file_;
  TextScanner scan_;
  PlyFormat format_ = PlyFormat::kAscii;
  size_t at_ = 0;
};

/// Which properties of an element the mesh is made of, as indices; -1 where there is none.
struct Columns {
  int coordinate[3] = {-1, -1, -1};
  int corners = -1;
};

class PlyReader {
 public:
  PlyReader(const std::string& bytes, const std::string& file) : data_(bytes, file) {}

  ReadMesh read() {
    const PlyHeader header = data_.readHeader();
    out_.metres_per_unit = unitNamedIn(header.comments);
    if (header.returns_alone && !data_.isAscii()) warn("its header's lines end in carriage returns alone");
    bool vertices = false, faces = false;
    for (const PlyElement& element : header.elements) {
      vertices = vertices || element.name == "vertex";
      faces = faces || isOfFaces(element);
    }
    if (!vertices) data_.fail("the header names no element \"vertex\"");
    if (!faces)
      data_.fail(
          "the header names no element \"face\": a point cloud is no CAD model; export the part's solid");

    for (const PlyElement& element : header.elements) {
      readElement(element, &element == &header.elements.back());
    }
    if (!data_.atEnd()) warn(counted(data_.left(), "byte", "bytes") + " behind the last element ignored");
    makeTriangles();
    dropUnusedVertices();
    return std::move(out_);
  }

 private:
  static bool isOfFaces(const PlyElement& e) { return e.name == "face" || e.name == "tristrips"; }
  void warn(const std::string& text) { out_.warnings.push_back(text); }

  Columns columnsOf(const PlyElement& element) const {
    Columns out;
    const bool is_vertex = element.name == "vertex", of_faces = isOfFaces(element);
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& p = element.properties[k];
      for (int c = 0; c < 3; ++c) {
        if (is_vertex && !p.count && p.name == std::string(1, char('x' + c))) out.coordinate[c] = int(k);
      }
      if (of_faces && p.count && (p.name == "vertex_indices" || p.name == "vertex_index"))
        out.corners = int(k);
    }

    for (int c = 0; c < 3; ++c) {
      if (is_vertex && out.coordinate[c] < 0)
        data_.fail(std::string("the vertices have no property \"") + char('x' + c) + "\"");
    }
    if (of_faces && out.corners < 0)
      data_.fail("the faces have no list property \"vertex_indices\" or \"vertex_index\"");
    if (of_faces && element.properties[size_t(out.corners)].type->kind == 'f')
      data_.fail("the vertex indices are not integers");
    return out;
  }

  /// A count that cannot fit into what is left of the file is refused before anything is allocated.
  bool fits(const PlyElement& element) const {
    size_t min_size = 0;  // bytes per entry
    for (const PlyProperty& p : element.properties) min_size += data_.minSize(p.count ? *p.count : *p.type);
    if (element.count > kMaxOfOne) return false;
    return element.count == 0 || (min_size > 0 && size_t(element.count) <= data_.room(min_size));
  }

  void readElement(const PlyElement& element, bool last) {
    const Columns columns = columnsOf(element);
    const bool may_be_wrong = last && isOfFaces(element);  // the count; the end of the file tells
    if (!fits(element) && !may_be_wrong) {
      data_.fail("the header says " + std::to_string(element.count) + " of element \"" +
                 element.name.substr(0, 24) + "\", but only " + std::to_string(data_.left()) +
                 " bytes are left; the file is damaged or cut off: export it again");
    }
    long long n = 0;
    for (; n < element.count; ++n) {
      if (may_be_wrong && data_.atEnd()) break;
      readEntry(element, columns);
    }
    if (n < element.count) {
      acceptFewer(element, n);
    } else if (may_be_wrong) {
      readMore(element, columns);
    }
  }

  /// The file ends behind a whole face: only a closed mesh shows that no face is missing.
  void acceptFewer(const PlyElement& element, long long read) {
    PlyReader trial(*this);
    trial.makeTriangles();
    if (!isClosed(trial.out_.mesh))
      data_.fail("the header says " + std::to_string(element.count) + " of element \"" + element.name +
                 "\", but the file ends after " + std::to_string(read) +
                 "; it is damaged or cut off: export it again");
    warn("the header says " + std::to_string(element.count) + " of element \"" + element.name +
         "\", but the file holds " + std::to_string(read) + ", which were read");
  }

  /// More faces than the header says, if all that follows are faces.
  void readMore(const PlyElement& element, const Columns& columns) {
    const size_t begin = data_.position(), faces = corners_.size();
    long long more = 0;

    try {
      for (; !data_.atEnd(); ++more) {
        readEntry(element, columns);
        for (const double index : corners_.back()) {
          if (!isVertex(index) && !(isStrip(corners_.size() - 1) && index == -1))
            throw BadInput("this is no face");
        }
        if (corners_.back().size() < 3) throw BadInput("this is no face");
      }
    } catch (const BadInput&) {
      corners_.resize(faces);
      strips_.resize(faces);
      data_.moveTo(begin);
      return;
    }

    if (more > 0)
      warn("the header says " + std::to_string(element.count) + " of element \"" + element.name + "\", but " +
           std::to_string(more) + " more follow, which were read, too");
  }

  void readEntry(const PlyElement& element, const Columns& columns) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& p = element.properties[k];
      if (p.count) {
        std::vector<double> list = data_.list(p);
        if (int(k) != columns.corners) continue;
        corners_.push_back(std::move(list));
        strips_.push_back(element.name == "tristrips");
        continue;
      }
      const double value = data_.number(*p.type, "a property");
      for (int c = 0; c < 3; ++c) {
        if (int(k) == columns.coordinate[c]) point[c] = value;
      }
    }
    if (element.name == "vertex") out_.mesh.vertices.push_back(point);
  }

  bool isVertex(double index) const { return index >= 0 && index < double(out_.mesh.vertices.size()); }
  bool isStrip(size_t face) const { return strips_[face] != 0; }

  int vertexAt(double index, size_t face) const {
    const size_t count = out_.mesh.vertices.size();
    const std::string named =
        "face " + std::to_string(face) + " names vertex " + std::to_string((long long)(index));
    if (!isVertex(index))
      data_.fail(named + ", but the file has vertices 0 to " + std::to_string((long long)(count)-1) +
                 ": the file is damaged, export it again");
    if (!out_.mesh.vertices[size_t(index)].allFinite())
      data_.fail(named + ", which is not a finite number: repair the mesh or export it again");
    return int(index);
  }

  void makeTriangles() {
    size_t lines = 0, of_strips = 0;
    for (size_t f = 0; f < corners_.size(); ++f) {
      if (isStrip(f)) {
        const size_t before = out_.mesh.triangles.size();
        addStrips(corners_[f], f);
        of_strips += out_.mesh.triangles.size() - before;
        continue;
      }

      std::vector<int> polygon;
      for (const double index : corners_[f]) polygon.push_back(vertexAt(index, f));
      if (polygon.size() < 3) {
        ++lines;
      } else {
        appendPolygon(out_.mesh.vertices, polygon, &out_.mesh.triangles);
      }
    }

    if (of_strips > 0) warn("triangle strips read as " + counted(of_strips, "triangle", "triangles"));
    if (lines > 0) warn(counted(lines, "face", "faces") + " of fewer than three corners ignored");
  }

  /// A list of strips, each ended by -1: every corner makes a triangle with the two before it, and every
  /// second one runs the other way round.
  void addStrips(const std::vector<double>& list, size_t face) {
    std::vector<int> strip;
    for (const double index : list) {
      if (index == -1) {
        strip.clear();
        continue;
      }
      strip.push_back(vertexAt(index, face));
      const size_t n = strip.size();
      if (n < 3) continue;
      const int a = strip[n - 3], b = strip[n - 2], c = strip[n - 1];
      // A repeated corner turns the strip and makes no triangle.
      if (a == b || b == c || c == a) continue;
      out_.mesh.triangles.push_back(n % 2 == 1 ? std::array<int, 3>{a, b, c} : std::array<int, 3>{b, a, c});
    }
  }

  /// Vertices that are no finite numbers and that no face names, as scanners leave them.
  void dropUnusedVertices() {
    Mesh& mesh = out_.mesh;
    std::vector<int> renumbered(mesh.vertices.size());
    std::vector<Eigen::Vector3d> kept;
    for (size_t k = 0; k < mesh.vertices.size(); ++k) {
      renumbered[k] = int(kept.size());
      if (mesh.vertices[k].allFinite()) kept.push_back(mesh.vertices[k]);
    }
    const size_t dropped = mesh.vertices.size() - kept.size();
    if (dropped == 0) return;

    for (auto& triangle : mesh.triangles) {
      for (int& v : triangle) v = renumbered[size_t(v)];
    }
    mesh.vertices = std::move(kept);
    warn(counted(dropped, "vertex", "vertices") + " of no face ignored, not finite numbers");
  }

  PlyData data_;
  std::vector<std::vector<double>> corners_;  // of every face, or a list of strips
  std::vector<char> strips_;                  // whether that entry is a list of strips
  ReadMesh out_;
};

}  // namespace

ReadMesh readPly(const std::string& bytes, const std::string& file) { return PlyReader(bytes, file).read(); }

}  // namespace monocular_eye_hand
