#include <algorithm>
#include <sstream>

#include "io/calibration_tree.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

std::string trimmedLower(const std::string& line) {
  const size_t begin = line.find_first_not_of(" \t"), end = line.find_last_not_of(" \t");
  if (begin == std::string::npos) return "";
  std::string out = line.substr(begin, end - begin + 1);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return out;
}

bool isNumberLine(const std::string& line) {
  return !line.empty() && line.find_first_not_of("0123456789+-.eE \tinfa,") == std::string::npos &&
         line.find_first_of("0123456789") != std::string::npos;
}

bool isComment(const std::string& line) { return line[0] == '#' || line[0] == ';'; }

/// "key: value" or "key = value" on one line, as some write it by hand.
size_t separatorOf(const std::string& line) { return line.find_first_of("=:"); }

}  // namespace

bool isOstIni(const std::string& text) {
  std::istringstream lines(text);
  bool section = false;
  for (std::string line; std::getline(lines, line);) {
    const std::string words = trimmedLower(line);
    if (!words.empty() && words.front() == '[' && words.back() == ']' && !isNumberLine(words)) section = true;
    if (section && words.compare(0, 13, "camera matrix") == 0) return true;
  }
  return false;
}

YAML::Node treeOfIni(const std::string& text) {
  YAML::Node tree;
  std::istringstream lines(text);
  std::string key;
  const auto begin = [&](const std::string& name) {
    key = name;
    if (key == "camera matrix" && tree[key])
      throw BadInput(
          "it holds two cameras: write the one that is meant (its [section] with [image]) to a "
          "file of its own");
  };
  const auto append = [&](std::string numbers) {
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    std::istringstream words(numbers);
    for (std::string word; words >> word;) tree[key].push_back(word);
  };

  for (std::string line; std::getline(lines, line);) {
    const std::string words = trimmedLower(line);
    if (words.empty() || isComment(words) || words.front() == '[') continue;
    const size_t separator = separatorOf(words);
    if (isNumberLine(words)) {
      if (!key.empty()) append(words);
    } else if (separator != std::string::npos) {
      begin(trimmedLower(words.substr(0, separator)));
      append(words.substr(separator + 1));
    } else {
      begin(words);
    }
  }
  return tree;
}

}  // namespace monocular_eye_hand
