#pragma once
#include <string>
#include <vector>

#include "mesh/text_scanner.h"

namespace monocular_eye_hand {

/// A number type of PLY.
struct PlyType {
  const char* name;
  const char* alias;
  int size;   ///< [bytes]
  char kind;  ///< 'i' signed, 'u' unsigned, 'f' floating point
};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count = nullptr;  ///< set for a list
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::string comments;        ///< one a line
  bool returns_alone = false;  ///< its lines end in carriage returns without line feeds
};

/// Reads the header and leaves the scanner at the first byte of the data. Lines may end in a line feed, a
/// carriage return or both. Throws BadInput naming file and line.
PlyHeader readPlyHeader(const std::string& bytes, const std::string& file, TextScanner* scan);

}  // namespace monocular_eye_hand
