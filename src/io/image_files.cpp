#include "monocular_eye_hand/io/image_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

bool digit(char c) { return c >= '0' && c <= '9'; }

// The name as a sequence that sorts as people expect: every run of digits is preceded by its length.
std::string sortKey(const std::string& name) {
  std::string key;
  for (size_t i = 0; i < name.size();) {
    if (!digit(name[i])) {
      key += name[i++];
      continue;
    }
    size_t begin = i;
    while (i < name.size() && digit(name[i])) ++i;
    while (begin + 1 < i && name[begin] == '0') ++begin;
    key += '0';
    key += char(std::min<size_t>(i - begin, 120));
    key += name.substr(begin, i - begin);
  }
  return key;
}

// "img_%04d.png" taken apart; it comes from a user and never reaches printf.
struct Pattern {
  std::string before, after;
  size_t digits = 1;  // at least so many, with zeros in front

  bool matches(const std::string& name) const {
    if (name.size() < before.size() + digits + after.size()) return false;
    if (name.compare(0, before.size(), before) != 0) return false;
    if (name.compare(name.size() - after.size(), after.size(), after) != 0) return false;
    const std::string number = name.substr(before.size(), name.size() - before.size() - after.size());
    return std::all_of(number.begin(), number.end(), digit) && (number.size() == digits || number[0] != '0');
  }
};

std::optional<Pattern> parsePattern(const std::string& name) {
  const size_t percent = name.find('%');
  if (percent == std::string::npos) return std::nullopt;
  size_t end = percent + 1;
  while (end < name.size() && digit(name[end])) ++end;
  const std::string width = name.substr(percent + 1, end - percent - 1);
  if (end == name.size() || name[end] != 'd' || name.find('%', end) != std::string::npos || width.size() > 3)
    throw BadInput("'" + name + "': a pattern has one %d or %0Nd, as img_%04d.png");
  Pattern pattern;
  pattern.before = name.substr(0, percent);
  pattern.after = name.substr(end + 1);
  if (!width.empty()) pattern.digits = size_t(std::max(1, std::stoi(width)));
  return pattern;
}

template <class Wanted>
std::vector<std::string> filesIn(const fs::path& folder, const Wanted& wanted) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (wanted(name)) names.push_back(name);
  }
  if (error) throw BadInput(folder.string() + ": the folder cannot be read: " + error.message());
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    const std::string key_a = sortKey(a), key_b = sortKey(b);
    return key_a != key_b ? key_a < key_b : a < b;
  });
  for (std::string& name : names) name = (folder / name).string();
  return names;
}

}  // namespace

bool isImageFile(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known :
       {".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".pnm", ".tif", ".tiff", ".webp"})
    if (extension == known) return true;
  return false;
}

std::vector<std::string> imageFiles(const std::string& argument) {
  const fs::path path(argument);
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const auto files = filesIn(path, [](const std::string& name) { return isImageFile(name); });
    if (files.empty()) throw BadInput(argument + ": the folder holds no image");
    return files;
  }
  if (fs::exists(path, error)) return {argument};
  const std::optional<Pattern> pattern = parsePattern(path.filename().string());
  if (!pattern) return {argument};
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  auto files = filesIn(folder, [&](const std::string& name) { return pattern->matches(name); });
  if (files.empty()) throw BadInput(argument + ": no file matches");
  return files;
}

}  // namespace monocular_eye_hand
