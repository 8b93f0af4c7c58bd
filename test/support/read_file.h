#pragma once
#include <fstream>
#include <sstream>
#include <string>

namespace monocular_eye_hand {

/// All bytes of a file; none when it cannot be read.
inline std::string readFile(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace monocular_eye_hand
