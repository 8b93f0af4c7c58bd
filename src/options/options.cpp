#include "monocular_eye_hand/options/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <numeric>
#include <sstream>

#include "options/renamed_keys.h"

namespace monocular_eye_hand {
namespace options_detail {
namespace {

[[noreturn]] void wrongType(const OptionTree& tree, const std::string& key, const std::string& expected) {
  throw BadInput((key.empty() ? "the options are " : "'" + key + "' is ") + tree.describe() + "; " +
                 expected + " is expected");
}

const std::string& requireScalar(const OptionTree& tree, const std::string& key,
                                 const std::string& expected) {
  if (tree.kind != OptionTree::Kind::kScalar) wrongType(tree, key, expected);
  return tree.scalar;
}

// The whole text as one number, whatever the user's locale.
template <class T>
bool parseNumber(const std::string& text, T* value) {
  if (text.empty() || std::isspace(static_cast<unsigned char>(text[0]))) return false;
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  return bool(in >> *value) && in.peek() == std::istringstream::traits_type::eof();
}

size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t(0));
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t change = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row.back();
}

bool contains(const std::vector<std::string>& known, const std::string& key) {
  return std::find(known.begin(), known.end(), key) != known.end();
}

/// What a key of an earlier version is called now; nullptr for a key that was not renamed here.
const char* newName(const std::string& key, const std::vector<std::string>& known) {
  for (const RenamedKey& renamed : kRenamedKeys)
    if (key == renamed.before && contains(known, renamed.now)) return renamed.now;
  return nullptr;
}

/// The known key that is most like this one, nullptr when none is.
const std::string* nearestKey(const std::string& key, const std::vector<std::string>& known) {
  size_t min_distance = 1 + key.size() / 2;  // a match that changes more than half is no match
  const std::string* nearest = nullptr;
  for (const std::string& name : known) {
    const bool part = name.find(key) != std::string::npos;  // an abbreviation of it
    const size_t distance = part ? 1 : editDistance(key, name);
    if (distance < min_distance) {
      min_distance = distance;
      nearest = &name;
    }
  }
  return nearest;
}

}  // namespace

void read(const OptionTree& tree, const std::string& key, bool& field) {
  const std::string& text = requireScalar(tree, key, "true or false");
  for (const char* yes : {"true", "True", "TRUE", "yes", "Yes", "YES", "y", "Y", "on", "On", "ON", "1"})
    if (text == yes) {
      field = true;
      return;
    }
  for (const char* no : {"false", "False", "FALSE", "no", "No", "NO", "n", "N", "off", "Off", "OFF", "0"})
    if (text == no) {
      field = false;
      return;
    }
  wrongType(tree, key, "true or false");
}

void read(const OptionTree& tree, const std::string& key, int& field) {
  int value = 0;
  if (!parseNumber(requireScalar(tree, key, "an integer"), &value)) wrongType(tree, key, "an integer");
  field = value;
}

void read(const OptionTree& tree, const std::string& key, double& field) {
  double value = 0;
  if (!parseNumber(requireScalar(tree, key, "a finite number"), &value) || !std::isfinite(value))
    wrongType(tree, key, "a finite number");
  field = value;
}

void read(const OptionTree& tree, const std::string& key, std::string& field) {
  field = requireScalar(tree, key, "a text");
}

void requireList(const OptionTree& tree, const std::string& key) {
  if (tree.kind != OptionTree::Kind::kList) wrongType(tree, key, "a list");
}

void requireLength(const OptionTree& tree, const std::string& key, size_t length) {
  if (tree.kind != OptionTree::Kind::kList || tree.list.size() != length)
    wrongType(tree, key, fmt::format("a list of {}", length));
}

void requireMap(const OptionTree& tree, const std::string& key) {
  if (tree.kind != OptionTree::Kind::kMap && tree.kind != OptionTree::Kind::kNull)
    wrongType(tree, key, "a map");
}

void requireKnown(const OptionTree& tree, const std::string& key, const std::vector<std::string>& known) {
  for (const auto& entry : tree.map) {
    if (contains(known, entry.first)) continue;
    const std::string name = join(key, entry.first);
    if (const char* now = newName(entry.first, known))
      throw BadInput(fmt::format("'{}' is now called '{}'", name, join(key, now)));

    std::string message = fmt::format("unknown key '{}'", name);
    if (const std::string* nearest = nearestKey(entry.first, known))
      message += fmt::format("; did you mean '{}'?", join(key, *nearest));
    throw BadInput(fmt::format("{} Known here: {}", message, fmt::join(known, ", ")));
  }
}

std::string join(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

std::string index(const std::string& key, size_t i) { return fmt::format("{}[{}]", key, i); }

OptionTree write(bool field) { return OptionTree::ofScalar(field ? "true" : "false"); }
OptionTree write(int field) { return OptionTree::ofScalar(std::to_string(field)); }

OptionTree write(double field) {
  // The shortest text that reads back to the same number, always one that YAML takes for a float.
  std::string text;
  for (int precision = 1; precision <= std::numeric_limits<double>::max_digits10; ++precision) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(precision);
    out << field;
    text = out.str();
    double back = 0;
    if (parseNumber(text, &back) && back == field) break;
  }
  const size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos && text.find_first_not_of("0123456789-+e") == std::string::npos)
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  return OptionTree::ofScalar(text);
}

OptionTree write(const std::string& field) { return OptionTree::ofScalar(field, true); }

}  // namespace options_detail
}  // namespace monocular_eye_hand
