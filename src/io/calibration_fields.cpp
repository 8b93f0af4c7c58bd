#include "io/calibration_fields.h"

#include <fmt/format.h>

#include <locale.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxListDepth = 4;     // levels of lists inside a field
constexpr size_t kMaxNumbers = 100;  // of one field

std::string simplified(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const char low = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    if ((low >= 'a' && low <= 'z') || (low >= '0' && low <= '9')) out += low;
  }
  return out;
}

/// Words from strangers go into messages: keep them short and printable.
std::string quoted(const std::string& word) {
  std::string out = "\"";
  for (const char c : word.substr(0, 24)) out += c >= 32 && c < 127 ? c : '?';
  return out + (word.size() > 24 ? "...\"" : "\"");
}

double parsed(const std::string& word, const std::string& field) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string text = word.compare(0, 1, ".") == 0 && word.size() == 4 && std::isalpha(word[1]) != 0
                               ? word.substr(1)  // YAML's .nan and .inf
                               : word;
  char* end = nullptr;
  const double value = strtod_l(text.c_str(), &end, c_locale);
  if (text.empty() || end != text.c_str() + text.size())
    throw BadInput("'" + field + "' holds " + quoted(word) + ", which is no number (1.5, 1.5e-3)");
  if (!std::isfinite(value)) throw BadInput("'" + field + "' holds a value that is not finite");
  return value;
}

void collect(const YAML::Node& node, const std::string& field, int depth, std::vector<double>* out) {
  if (node.IsScalar()) {
    if (out->size() >= kMaxNumbers) throw BadInput("'" + field + "' holds more than 100 numbers");
    out->push_back(parsed(node.Scalar(), field));
  } else if (node.IsSequence() && depth < kMaxListDepth) {
    for (const YAML::Node& item : node) collect(item, field, depth + 1, out);
  } else if (!node.IsNull()) {
    throw BadInput("'" + field + "' is no list of numbers");
  }
}

bool namesCamera(const YAML::Node& map) {
  for (const auto& pair : map) {
    const std::string name = simplified(pair.first.IsScalar() ? pair.first.Scalar() : "");
    for (const char* wanted : {"cameramatrix", "intrinsics", "k", "intrinsicmatrix", "fx", "camerafx"}) {
      if (name == wanted) return true;
    }
  }
  return false;
}

}  // namespace

CalibrationFields::CalibrationFields(const YAML::Node& tree) {
  std::string cameras;
  int count = 0;
  for (const auto& pair : tree) {
    if (!pair.second.IsMap() || !namesCamera(pair.second)) continue;
    camera_ = pair.first.Scalar();
    cameras += (cameras.empty() ? "" : ", ") + camera_;
    ++count;
  }
  if (count > 1)
    throw BadInput("it holds several cameras (" + cameras.substr(0, 60) +
                   "): write the one that is meant to a file of its own");
  add(tree);
  if (has({"m1", "cameramatrix1", "k1matrix"}) && has({"m2", "cameramatrix2"}))
    throw BadInput(
        "it holds a stereo pair: write the matrix and distortion of one camera to a file of its own");
}

void CalibrationFields::add(const YAML::Node& map) {
  for (const auto& pair : map) {
    if (!pair.first.IsScalar()) continue;
    const std::string name = simplified(pair.first.Scalar());
    fields_.emplace(name, Field{pair.first.Scalar(), pair.second});
  }
  for (const auto& pair : map) {
    if (!pair.first.IsScalar() || !pair.second.IsMap() || pair.second["data"]) continue;
    const std::string name = simplified(pair.first.Scalar());
    // Their width and height are not the image's.
    if (name == "header" || name == "roi") continue;
    add(pair.second);
  }
}

const CalibrationFields::Field* CalibrationFields::find(std::initializer_list<const char*> names) const {
  for (const char* name : names) {
    const auto found = fields_.find(name);
    if (found != fields_.end() && found->second.node.IsDefined()) return &found->second;
  }
  return nullptr;
}

std::optional<std::vector<double>> CalibrationFields::numbers(
    std::initializer_list<const char*> names) const {
  const Field* field = find(names);
  if (!field) return std::nullopt;
  const bool matrix = field->node.IsMap();
  if (matrix && !field->node["data"]) throw BadInput("'" + field->name + "' with 'data' is missing");

  std::vector<double> out;
  collect(matrix ? YAML::Node(field->node["data"]) : field->node, field->name, 0, &out);
  return out;
}

std::optional<double> CalibrationFields::number(std::initializer_list<const char*> names) const {
  const auto list = numbers(names);
  if (!list) return std::nullopt;
  if (list->size() != 1)
    throw BadInput(fmt::format("'{}' holds {} numbers, one expected", find(names)->name, list->size()));
  return list->front();
}

std::string CalibrationFields::text(std::initializer_list<const char*> names) const {
  const Field* field = find(names);
  return field && field->node.IsScalar() ? field->node.Scalar() : "";
}

}  // namespace monocular_eye_hand
