#include "io/package_folder.h"

#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxFolderDepth = 4;     // folders below an entry of ROS_PACKAGE_PATH
constexpr size_t kMaxFolders = 20000;  // looked into, so that "/" as an entry does not take forever

std::vector<std::string> foldersOf(const char* variable) {
  std::vector<std::string> out;
  const char* value = std::getenv(variable);
  std::istringstream in(value ? value : "");
  for (std::string folder; std::getline(in, folder, ':');) {
    if (!folder.empty()) out.push_back(folder);
  }
  return out;
}

/// The text of <name> in a package.xml; "" without one.
std::string nameIn(const fs::path& manifest) {
  std::ifstream in(manifest);
  std::stringstream text;
  text << in.rdbuf();
  const std::string xml = text.str();
  const size_t begin = xml.find("<name>"), end = xml.find("</name>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
  std::istringstream words(xml.substr(begin + 6, end - begin - 6));
  std::string name;
  words >> name;
  return name;
}

bool isPackage(const fs::path& folder, const std::string& package) {
  std::error_code ignored;
  if (fs::is_regular_file(folder / "package.xml", ignored)) return nameIn(folder / "package.xml") == package;
  return fs::is_regular_file(folder / "manifest.xml", ignored) && folder.filename() == package;
}

/// As rospack searches: a package holds no other packages.
std::string foundBelow(const fs::path& folder, const std::string& package, int depth, size_t* looked_into) {
  std::error_code error;
  if (isPackage(folder, package)) return folder.string();
  if (depth == 0 || ++*looked_into > kMaxFolders || fs::exists(folder / "CATKIN_IGNORE", error)) return "";
  if (depth < kMaxFolderDepth && fs::is_regular_file(folder / "package.xml", error)) return "";

  std::vector<fs::path> below;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->is_directory(error) && it->path().filename().string()[0] != '.') below.push_back(it->path());
  }
  std::sort(below.begin(), below.end());
  for (const fs::path& next : below) {
    const std::string found = foundBelow(next, package, depth - 1, looked_into);
    if (!found.empty()) return found;
  }
  return "";
}

/// What `rospack find` prints; "" when there is no rospack or it knows no such package.
std::string askedOfRospack(const std::string& package) {
  FILE* pipe = popen(("rospack find " + package + " 2>/dev/null").c_str(), "r");
  if (!pipe) return "";
  std::string out;
  char part[512];
  while (std::fgets(part, sizeof part, pipe)) out += part;
  const bool good = pclose(pipe) == 0;
  while (!out.empty() && out.back() == '\n') out.pop_back();
  return good ? out : "";
}

}  // namespace

std::string packageFolder(const std::string& package) {
  const bool plain = !package.empty() && std::all_of(package.begin(), package.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  });
  if (!plain) throw BadInput("\"" + package.substr(0, 40) + "\" is no name of a ROS package");

  size_t looked_into = 0;
  for (const std::string& folder : foldersOf("ROS_PACKAGE_PATH")) {
    const std::string found = foundBelow(folder, package, kMaxFolderDepth, &looked_into);
    if (!found.empty()) return found;
  }
  for (const char* variable : {"CMAKE_PREFIX_PATH", "AMENT_PREFIX_PATH"}) {
    for (const std::string& prefix : foldersOf(variable)) {
      const fs::path share = fs::path(prefix) / "share" / package;
      if (isPackage(share, package)) return share.string();
    }
  }
  const std::string asked = askedOfRospack(package);
  if (!asked.empty()) return asked;
  throw BadInput("there is no ROS package \"" + package +
                 "\" on ROS_PACKAGE_PATH: source the workspace's setup.bash, or give a path");
}

}  // namespace monocular_eye_hand
