#include "monocular_eye_hand/io/file_content.h"

#include <fmt/format.h>

#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <fstream>

#include "io/starts_with.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kLookedAt = 4096;  // bytes at the start that tell what a file is

struct Signature {
  const char* start;  // first bytes after blanks, letters in lower case
  const char* kind;
};

constexpr Signature kTextKinds[] = {
    {"version https://git-lfs",
     "a Git LFS pointer, not the file itself: run `git lfs pull` in its repository"},
    {"/annex/objects/", "a git-annex pointer, not the file itself: run `git annex get` in its repository"},
    {"iso-10303-21", "a STEP file: export the part from CAD as STL with a fine tolerance"},
    {"dbrep_drawableshape", "a BREP file of OpenCASCADE: export the part as STL"},
    {"cascade topology", "a BREP file of OpenCASCADE: export the part as STL"},
    {"#vrml", "a VRML file: export the part as STL"},
    {"#usda", "a USD file: export the part as STL"},
    {"# .pcd", "a point cloud (PCD), which has no faces: export the part's solid as STL"},
    {"<!doctype html", "a web page: download the file itself (on GitHub by its button \"Raw\")"},
    {"<html", "a web page: download the file itself (on GitHub by its button \"Raw\")"},
    {"<robot", "a URDF file, which only names meshes: give the mesh itself"},
    {"<sdf", "an SDF file, which only names meshes: give the mesh itself"},
    {"%pdf", "a PDF document"},
    {"{\\rtf", "a Rich Text document: save it as plain text"},
};

const Signature kBinaryKinds[] = {
    {"PK\x03\x04", "a ZIP archive (also 3MF, FreeCAD and office files): unpack it, or export as STL"},
    {"\x1f\x8b", "a gzip archive: unpack it first"},
    {"\xfd"
     "7zXZ",
     "an xz archive: unpack it first"},
    {"BZh", "a bzip2 archive: unpack it first"},
    {"7z\xbc\xaf", "a 7-Zip archive: unpack it first"},
    {"Rar!", "a RAR archive: unpack it first"},
    {"glTF", "a binary glTF file: export the part as STL"},
    {"BLENDER", "a Blender file: export the part as STL"},
    {"Kaydara FBX", "an FBX file: export the part as STL"},
    {"\x89PNG", "a PNG picture"},
    {"\xff\xd8\xff", "a JPEG picture"},
    {"\xd0\xcf\x11\xe0", "a SolidWorks or old office document: export the part as STL"},
    {"\x93NUMPY", "a NumPy array: write its numbers as YAML"},
    {"MATLAB 5.0", "a MATLAB file: write its numbers as YAML"},
    {"#ROSBAG", "a bag: take one message out of it with rostopic echo"},
};

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string startInLowerCase(const std::string& bytes) {
  size_t begin = startsWith(bytes, "\xef\xbb\xbf") ? 3 : 0;
  while (begin < bytes.size() && begin < kLookedAt && blank(bytes[begin])) ++begin;

  std::string start = bytes.substr(begin, 64);
  for (char& c : start) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return start;
}

/// The first line of an IGES file has an S in column 73 and the number 1 in the rest of its 80 columns.
bool isIges(const std::string& bytes) {
  if (bytes.size() < 80 || bytes[72] != 'S') return false;
  const std::string number = bytes.substr(73, 7);
  return number == "      1" || number == "0000001";
}

enum class Utf16 { kNo, kLittle, kBig };

/// Latin text in UTF-16 has a zero in every other byte.
Utf16 utf16Of(const std::string& bytes) {
  const size_t end = std::min<size_t>(bytes.size(), 256) & ~size_t(1);
  if (end < 4) return Utf16::kNo;
  size_t zeros[2] = {0, 0};
  for (size_t k = 0; k < end; ++k) zeros[k % 2] += bytes[k] == '\0';

  const size_t nearly_all = end / 2 - end / 20, few = end / 20;
  if (zeros[1] >= nearly_all && zeros[0] <= few) return Utf16::kLittle;
  if (zeros[0] >= nearly_all && zeros[1] <= few) return Utf16::kBig;
  return Utf16::kNo;
}

void appendUtf8(uint32_t code, std::string* out) {
  if (code < 0x80) {
    *out += char(code);
  } else if (code < 0x800) {
    *out += char(0xc0 | code >> 6);
    *out += char(0x80 | (code & 0x3f));
  } else {
    *out += char(0xe0 | code >> 12);
    *out += char(0x80 | (code >> 6 & 0x3f));
    *out += char(0x80 | (code & 0x3f));
  }
}

/// Characters outside the basic plane stand in names and comments only: each half becomes a question mark.
std::string fromUtf16(const std::string& bytes, bool little) {
  std::string out;
  for (size_t k = 0; k + 1 < bytes.size(); k += 2) {
    const auto first = static_cast<unsigned char>(bytes[k]),
               second = static_cast<unsigned char>(bytes[k + 1]);
    const uint32_t code = little ? uint32_t(second) << 8 | first : uint32_t(first) << 8 | second;
    if (code == 0xfeff && k == 0) continue;
    appendUtf8(code >= 0xd800 && code < 0xe000 ? uint32_t('?') : code, &out);
  }
  return out;
}

}  // namespace

std::string readFileBytes(const std::string& path, const std::string& kind, size_t max_bytes) {
  struct stat info;
  if (stat(path.c_str(), &info) != 0)
    throw BadInput(path + ": cannot be read, there is no such file; check the path");
  if (S_ISDIR(info.st_mode)) throw BadInput(path + ": this is a folder, not " + kind);
  if (!S_ISREG(info.st_mode)) throw BadInput(path + ": this is no plain file, so not " + kind);
  if (info.st_size == 0) throw BadInput(path + ": the file is empty; write it again");
  if (size_t(info.st_size) > max_bytes)
    throw BadInput(fmt::format("{}: larger than {} MB, so not {}", path, max_bytes >> 20, kind));

  std::ifstream in(path, std::ios::binary);
  std::string bytes(size_t(info.st_size), '\0');
  if (!in || !in.read(&bytes[0], std::streamsize(bytes.size())))
    throw BadInput(path + ": the file cannot be read; check its permissions");
  return bytes;
}

std::string foreignContent(const std::string& bytes) {
  for (const Signature& s : kBinaryKinds) {
    if (startsWith(bytes, s.start)) return s.kind;
  }
  const std::string start = startInLowerCase(bytes);
  for (const Signature& s : kTextKinds) {
    if (startsWith(start, s.start)) return s.kind;
  }
  if (isIges(bytes)) return "an IGES file: export the part from CAD as STL with a fine tolerance";
  return "";
}

bool looksBinary(const std::string& bytes) {
  const size_t end = std::min(bytes.size(), kLookedAt);
  return std::any_of(bytes.begin(), bytes.begin() + long(end), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 && !blank(c) && c != '\f' && c != '\v' && byte != 0x1a;
  });
}

PlainText plainText(std::string bytes) {
  PlainText out;
  const Utf16 wide = utf16Of(bytes);
  if (wide != Utf16::kNo) {
    out.text = fromUtf16(bytes, wide == Utf16::kLittle);
    out.warnings.push_back("the text is UTF-16 and was converted; save it as UTF-8");
    return out;
  }
  if (startsWith(bytes, "\xef\xbb\xbf")) {
    bytes.erase(0, 3);
    out.warnings.push_back("the byte order mark (3 bytes) at its start was ignored");
  }
  out.text = std::move(bytes);
  return out;
}

std::string withLineFeeds(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '\r') {
      out += text[k];
    } else if (k + 1 == text.size() || text[k + 1] != '\n') {
      out += '\n';
    }
  }
  return out;
}

}  // namespace monocular_eye_hand
