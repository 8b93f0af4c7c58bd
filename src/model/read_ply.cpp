#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "mesh_readers.h"
#include "monocular_eye_hand/geometry/error.h"
#include "text_scanner.h"

namespace monocular_eye_hand {
namespace {

struct Type {
  const char* name;
  const char* alias;
  int size;
  char kind;  // 'i' signed, 'u' unsigned, 'f' floating point
};
constexpr Type kTypes[] = {{"char", "int8", 1, 'i'},     {"uchar", "uint8", 1, 'u'},
                           {"short", "int16", 2, 'i'},   {"ushort", "uint16", 2, 'u'},
                           {"int", "int32", 4, 'i'},     {"uint", "uint32", 4, 'u'},
                           {"float", "float32", 4, 'f'}, {"double", "float64", 8, 'f'}};

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* count = nullptr;  // set for a list
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

enum class Format { kAscii, kLittle, kBig };

/// Header of the file and where its data start.
struct Header {
  Format format = Format::kAscii;
  bool has_format = false;
  std::vector<Element> elements;
};

class PlyReader {
 public:
  PlyReader(const std::string& bytes, const std::string& file)
      : bytes_(bytes), file_(file), scan_(bytes, 0, file) {}

  Mesh read() {
    readHeader();
    at_ = scan_.position();
    bool vertices = false, faces = false;
    for (const Element& element : header_.elements) {
      checkCount(element);
      if (element.name == "vertex") vertices = true;
      if (element.name == "face") {
        if (!vertices)
          fail("the faces stand before the vertices, which this reader does not take: export it again");
        faces = true;
      }
      readElement(element);
    }
    if (!vertices) fail("the header names no element \"vertex\"");
    if (!faces) fail("the header names no element \"face\": a point cloud is no CAD model");
    const bool at_end = header_.format == Format::kAscii ? scan_.atEnd() : at_ == bytes_.size();
    if (!at_end)
      fail("data follow after the last element; the counts in the header are wrong: export it again");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw BadInput(file_ + ": " + problem); }

  const Type* typeNamed(const std::string& name) const {
    for (const Type& type : kTypes) {
      if (name == type.name || name == type.alias) return &type;
    }
    scan_.fail("unknown type \"" + name.substr(0, 24) + "\" in the PLY header");
  }

  void readHeader() {
    if (scan_.line() != "ply") fail("the file does not start with the line \"ply\": it is no PLY file");
    for (;;) {
      if (scan_.remaining() == 0)
        scan_.fail("the file ends inside the PLY header; it was cut off: export it again");
      const size_t before = scan_.position();
      const std::string line = scan_.line();
      // A header line must be complete: a cut "end_header" must not pass.
      if (scan_.remaining() == 0 && bytes_[bytes_.size() - 1] != '\n') {
        scan_.fail("the file ends inside the PLY header; it was cut off: export it again");
      }
      if (scan_.position() - before > 4096) scan_.fail("a line of the PLY header is longer than 4096 bytes");
      if (headerLine(line)) break;
    }
    if (!header_.has_format) fail("the PLY header has no \"format\" line");
  }

  /// True at end_header.
  bool headerLine(const std::string& line) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "end_header") return true;
    if (key == "comment" || key == "obj_info" || key.empty()) return false;
    if (key == "format") {
      formatLine(words);
    } else if (key == "element") {
      Element element;
      if (!(words >> element.name >> element.count) || element.count < 0) {
        scan_.fail("an \"element\" line needs a name and a count that is not negative");
      }
      header_.elements.push_back(element);
    } else if (key == "property") {
      propertyLine(words);
    } else {
      scan_.fail("unknown PLY header line \"" + key.substr(0, 24) + "\"");
    }
    return false;
  }

  void formatLine(std::istringstream& words) {
    std::string name, version;
    words >> name >> version;
    header_.has_format = true;
    if (name == "ascii") {
      header_.format = Format::kAscii;
    } else if (name == "binary_little_endian") {
      header_.format = Format::kLittle;
    } else if (name == "binary_big_endian") {
      header_.format = Format::kBig;
    } else {
      scan_.fail("unknown PLY format \"" + name.substr(0, 24) +
                 "\"; known: ascii, binary_little_endian, binary_big_endian");
    }
    if (version != "1.0") scan_.fail("PLY version \"" + version.substr(0, 24) + "\" is not 1.0");
  }

  void propertyLine(std::istringstream& words) {
    if (header_.elements.empty()) scan_.fail("a \"property\" line stands before the first \"element\" line");
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      std::string count;
      words >> count >> type;
      property.count = typeNamed(count);
      if (property.count->kind == 'f') scan_.fail("the count of a list must be an integer type");
    }
    property.type = typeNamed(type);
    if (!(words >> property.name)) scan_.fail("a \"property\" line has no name");
    header_.elements.back().properties.push_back(property);
  }

  /// A count that cannot fit into what is left of the file is refused before anything is allocated.
  void checkCount(const Element& element) const {
    size_t least = 0;  // bytes per entry at least
    for (const Property& p : element.properties) {
      least += header_.format == Format::kAscii ? 2 : size_t(p.count ? p.count->size : p.type->size);
    }
    const size_t left = header_.format == Format::kAscii ? scan_.remaining() + 1 : bytes_.size() - at_;
    if (element.count > 0 && (least == 0 || size_t(element.count) > left / least)) {
      fail("the header says " + std::to_string(element.count) + " of element \"" +
           element.name.substr(0, 24) + "\", but only " + std::to_string(left) +
           " bytes are left; the file is damaged or cut off: export it again");
    }
    if (element.count > 200000000) fail("more than 200 million of one element: reduce the mesh");
  }

  void readElement(const Element& element) {
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    int coordinate_of[3] = {-1, -1, -1}, corners_of = -1;
    for (size_t k = 0; k < element.properties.size(); ++k) {
      const Property& p = element.properties[k];
      for (int c = 0; c < 3; ++c) {
        if (is_vertex && !p.count && p.name == std::string(1, char('x' + c))) coordinate_of[c] = int(k);
      }
      if (is_face && p.count && (p.name == "vertex_indices" || p.name == "vertex_index")) corners_of = int(k);
    }
    for (int c = 0; c < 3; ++c) {
      if (is_vertex && coordinate_of[c] < 0) {
        fail(std::string("the vertices have no property \"") + char('x' + c) + "\"");
      }
    }
    if (is_face && corners_of < 0)
      fail("the faces have no list property \"vertex_indices\" or \"vertex_index\"");
    if (is_face && element.properties[corners_of].type->kind == 'f')
      fail("the vertex indices are not integers");
    std::vector<double> list;
    for (long long n = 0; n < element.count; ++n) {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      for (size_t k = 0; k < element.properties.size(); ++k) {
        const Property& p = element.properties[k];
        if (p.count) {
          readList(p, &list);
          if (int(k) == corners_of) addFace(list, n);
          continue;
        }
        const bool wanted =
            int(k) == coordinate_of[0] || int(k) == coordinate_of[1] || int(k) == coordinate_of[2];
        const double v = value(*p.type, wanted ? "a coordinate" : "a property");
        for (int c = 0; c < 3; ++c) {
          if (int(k) == coordinate_of[c]) point[c] = v;
        }
      }
      if (!is_vertex) continue;
      if (!point.allFinite()) {
        fail("vertex " + std::to_string(n) + " is not a finite number: repair the mesh or export it again");
      }
      mesh_.vertices.push_back(point);
    }
  }

  void readList(const Property& p, std::vector<double>* list) {
    const double count = value(*p.count, "the length of a list");
    const size_t least = header_.format == Format::kAscii ? 2 : size_t(p.type->size);
    const size_t left = header_.format == Format::kAscii ? scan_.remaining() + 1 : bytes_.size() - at_;
    if (count < 0 || size_t(count) > left / least) {
      fail("a list says " + std::to_string((long long)(count)) +
           " entries, more than the rest of the file holds; it is damaged or cut off: export it again");
    }
    list->clear();
    for (size_t k = 0; k < size_t(count); ++k) list->push_back(value(*p.type, "a list entry"));
  }

  void addFace(const std::vector<double>& list, long long face) {
    if (list.size() < 3) {
      fail("face " + std::to_string(face) + " has " + std::to_string(list.size()) +
           " corners, fewer than three");
    }
    std::vector<int> polygon;
    for (const double index : list) {
      if (index < 0 || index >= double(mesh_.vertices.size())) {
        fail("face " + std::to_string(face) + " names vertex " + std::to_string((long long)(index)) +
             ", but the file has vertices 0 to " + std::to_string((long long)(mesh_.vertices.size()) - 1) +
             ": the file is damaged, export it again");
      }
      polygon.push_back(int(index));
    }
    appendPolygon(mesh_.vertices, polygon, &mesh_.triangles);
  }

  double value(const Type& type, const char* what) {
    if (header_.format == Format::kAscii) {
      return type.kind == 'f' ? scan_.number(what) : double(scan_.integer(what));
    }
    if (bytes_.size() - at_ < size_t(type.size)) {
      fail(std::string("the file ends where ") + what + " should stand; it was cut off: export it again");
    }
    uint64_t bits = 0;
    for (int k = 0; k < type.size; ++k) {
      const int byte = header_.format == Format::kLittle ? type.size - 1 - k : k;
      bits = bits << 8 | uint64_t(static_cast<unsigned char>(bytes_[at_ + byte]));
    }
    at_ += type.size;
    return fromBits(type, bits);
  }

  static double fromBits(const Type& type, uint64_t bits) {
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
  size_t at_ = 0;
  Header header_;
  Mesh mesh_;
};

}  // namespace

Mesh readPly(const std::string& bytes, const std::string& file) { return PlyReader(bytes, file).read(); }

}  // namespace monocular_eye_hand
