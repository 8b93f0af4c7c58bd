#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>

#include "mesh/mesh_readers.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand {
namespace {

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}};
constexpr Unit kSpellings[] = {{"mm", 0.001},
                               {"millimeter", 0.001},
                               {"millimeters", 0.001},
                               {"millimetre", 0.001},
                               {"millimetres", 0.001},
                               {"cm", 0.01},
                               {"centimeter", 0.01},
                               {"centimeters", 0.01},
                               {"centimetre", 0.01},
                               {"centimetres", 0.01},
                               {"m", 1.0},
                               {"meter", 1.0},
                               {"meters", 1.0},
                               {"metre", 1.0},
                               {"metres", 1.0},
                               {"inch", 0.0254},
                               {"inches", 0.0254},
                               {"in", 0.0254},
                               {"feet", 0.3048},
                               {"foot", 0.3048}};

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      words.back() += char(std::tolower(static_cast<unsigned char>(c)));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  return words;
}

/// The value of an attribute inside one tag; "" when it is missing.
std::string attribute(const std::string& tag, const std::string& name) {
  size_t at = tag.find(name);
  if (at == std::string::npos) return "";
  at = tag.find_first_of("\"'", at + name.size());
  if (at == std::string::npos) return "";
  const size_t end = tag.find(tag[at], at + 1);
  return end == std::string::npos ? "" : tag.substr(at + 1, end - at - 1);
}

}  // namespace

std::string counted(size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

double metresPerUnit(const std::string& unit) {
  std::string known;
  for (const Unit& u : kUnits) {
    if (unit == u.name) return u.metres;
    known += (known.empty() ? "" : ", ") + std::string(u.name);
  }
  throw BadInput("unknown unit \"" + unit.substr(0, 24) + "\"; known: " + known);
}

double unitNamedIn(const std::string& text) {
  const std::vector<std::string> words = wordsOf(text);
  for (size_t k = 0; k + 1 < words.size(); ++k) {
    if (words[k] != "unit" && words[k] != "units") continue;
    // "units are mm", "unit of length: mm".
    for (size_t n = k + 1; n < std::min(words.size(), k + 4); ++n) {
      for (const Unit& u : kSpellings) {
        if (words[n] == u.name) return u.metres;
      }
    }
  }
  return 0;
}

double colladaUnit(const std::string& bytes) {
  const size_t begin = bytes.find("<unit");
  if (begin == std::string::npos) return 0;
  const std::string tag = bytes.substr(begin, std::min<size_t>(bytes.find('>', begin) - begin, 400));
  std::string metres = attribute(tag, "meter=");
  if (metres.empty()) metres = attribute(tag, "meter ");
  // Some exporters write the number as their country does.
  std::replace(metres.begin(), metres.end(), ',', '.');

  std::istringstream in(metres);
  in.imbue(std::locale::classic());
  double value = 0;
  return (in >> value) && std::isfinite(value) && value > 0 ? value : 0;
}

}  // namespace monocular_eye_hand
