#include "mesh/ply_header.h"

#include <sstream>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr PlyType kTypes[] = {{"char", "int8", 1, 'i'},     {"uchar", "uint8", 1, 'u'},
                              {"short", "int16", 2, 'i'},   {"ushort", "uint16", 2, 'u'},
                              {"int", "int32", 4, 'i'},     {"uint", "uint32", 4, 'u'},
                              {"float", "float32", 4, 'f'}, {"double", "float64", 8, 'f'}};
constexpr size_t kLongestLine = 4096;

class HeaderReader {
 public:
  HeaderReader(const std::string& bytes, const std::string& file, TextScanner* scan)
      : bytes_(bytes), file_(file), scan_(*scan) {}

  PlyHeader read() {
    if (scan_.line() != "ply")
      throw BadInput(file_ + ": the file does not start with the line \"ply\": it is no PLY file");

    // With carriage returns alone, a line feed behind the header is the first byte of the data.
    header_.returns_alone = scan_.position() > 0 && bytes_[scan_.position() - 1] == '\r';
    for (;;) {
      const size_t before = scan_.position();
      const std::string line = scan_.line();
      // A header line must be complete: a cut "end_header" must not pass.
      const char last = bytes_[bytes_.size() - 1];
      if (scan_.remaining() == 0 && (before == bytes_.size() || (last != '\n' && last != '\r')))
        scan_.fail("the file ends inside the PLY header; it was cut off: export it again");
      if (scan_.position() - before > kLongestLine)
        scan_.fail("a line of the PLY header is longer than 4096 bytes");

      if (headerLine(line)) {
        if (header_.returns_alone && bytes_[scan_.position() - 1] == '\n') scan_.moveTo(scan_.position() - 1);
        break;
      }
    }

    if (!has_format_) throw BadInput(file_ + ": the PLY header has no \"format\" line");
    return std::move(header_);
  }

 private:
  const PlyType* typeNamed(const std::string& name) const {
    for (const PlyType& type : kTypes) {
      if (name == type.name || name == type.alias) return &type;
    }
    scan_.fail("unknown type \"" + name.substr(0, 24) + "\" in the PLY header");
  }

  /// True at end_header.
  bool headerLine(const std::string& line) {
    std::istringstream words(line);
    std::string key;
    words >> key;

    if (key == "end_header") return true;
    if (key == "comment" || key == "obj_info" || key.empty()) {
      header_.comments += line + "\n";
      return false;
    }

    if (key == "format") {
      formatLine(words);
    } else if (key == "element") {
      PlyElement element;
      if (!(words >> element.name >> element.count) || element.count < 0)
        scan_.fail("an \"element\" line needs a name and a count that is not negative");
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
    has_format_ = true;
    if (name == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      scan_.fail("unknown PLY format \"" + name.substr(0, 24) +
                 "\"; known: ascii, binary_little_endian, binary_big_endian");
    }
    if (version != "1.0") scan_.fail("PLY version \"" + version.substr(0, 24) + "\" is not 1.0");
  }

  void propertyLine(std::istringstream& words) {
    if (header_.elements.empty()) scan_.fail("a \"property\" line stands before the first \"element\" line");
    PlyProperty property;
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

  const std::string& bytes_;
  const std::string& file_;
  TextScanner& scan_;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

PlyHeader readPlyHeader(const std::string& bytes, const std::string& file, TextScanner* scan) {
  return HeaderReader(bytes, file, scan).read();
}

}  // namespace monocular_eye_hand
