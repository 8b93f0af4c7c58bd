#include "monocular_eye_hand/io/file_path.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "io/package_folder.h"
#include "io/starts_with.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

bool isNameSign(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string variable(const std::string& name) {
  const char* value = name.empty() ? nullptr : std::getenv(name.c_str());
  if (!value)
    throw BadInput("the environment variable \"" + name.substr(0, 40) +
                   "\" is not set: set it, or give a path");
  return value;
}

/// What stands between `begin` and the closing sign; moves past it.
std::string upTo(char closing, const std::string& text, size_t begin, size_t* at) {
  const size_t end = text.find(closing, begin);
  if (end == std::string::npos) throw BadInput(std::string("a \"") + closing + "\" is missing");
  *at = end + 1;
  return text.substr(begin, end - begin);
}

/// $(find NAME) and $(env NAME), as launch files write them.
std::string substitution(const std::string& words) {
  const size_t space = words.find(' ');
  const std::string what = words.substr(0, space);
  const std::string name = space == std::string::npos ? "" : words.substr(space + 1);
  if (what == "find") return packageFolder(name);
  if (what == "env" || what == "optenv") return variable(name);
  throw BadInput("$(" + words.substr(0, 40) + ") is not known; known: $(find PACKAGE), $(env VARIABLE)");
}

std::string withVariables(const std::string& text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    if (text[at] != '$' || at + 1 == text.size()) {
      out += text[at++];
    } else if (text[at + 1] == '{') {
      out += variable(upTo('}', text, at + 2, &at));
    } else if (text[at + 1] == '(') {
      out += substitution(upTo(')', text, at + 2, &at));
    } else {
      size_t end = at + 1;
      while (end < text.size() && isNameSign(text[end])) ++end;
      out += variable(text.substr(at + 1, end - at - 1));
      at = end;
    }
  }
  return out;
}

/// ~ and ~USER at the start.
std::string withHome(const std::string& path) {
  if (path.empty() || path[0] != '~') return path;
  const size_t slash = std::min(path.find('/'), path.size());
  const std::string user = path.substr(1, slash - 1);
  const char* home = user.empty() ? std::getenv("HOME") : nullptr;
  if (!home) {
    const passwd* entry = user.empty() ? getpwuid(getuid()) : getpwnam(user.c_str());
    home = entry ? entry->pw_dir : nullptr;
  }
  if (!home) throw BadInput("there is no home folder of \"" + user.substr(0, 40) + "\": give a path");
  return home + path.substr(slash);
}

/// A URL's %20 and the like.
std::string decoded(const std::string& url) {
  std::string out;
  for (size_t k = 0; k < url.size(); ++k) {
    const bool code = url[k] == '%' && k + 2 < url.size() &&
                      std::isxdigit(static_cast<unsigned char>(url[k + 1])) != 0 &&
                      std::isxdigit(static_cast<unsigned char>(url[k + 2])) != 0;
    if (!code) {
      out += url[k];
      continue;
    }
    out += char(std::stoi(url.substr(k + 1, 2), nullptr, 16));
    k += 2;
  }
  return out;
}

std::string ofPackage(const std::string& rest) {
  const size_t slash = rest.find('/');
  if (slash == std::string::npos || slash + 1 == rest.size())
    throw BadInput("after the package a file must follow: package://NAME/folder/file");
  return packageFolder(rest.substr(0, slash)) + rest.substr(slash);
}

std::string ofFileUrl(std::string rest) {
  if (startsWith(rest, "localhost/")) rest.erase(0, 9);
  if (startsWith(rest, "~") || startsWith(rest, "$")) return withHome(withVariables(rest));
  if (rest.empty() || rest[0] != '/')
    throw BadInput("a file:// URL needs an absolute path, with three slashes: file:///folder/part.stl");
  return decoded(rest);
}

/// The scheme of a URL ("http"); "" of a plain path.
std::string schemeOf(const std::string& name) {
  const size_t end = name.find("://");
  if (end == std::string::npos || end == 0) return "";
  for (size_t k = 0; k < end; ++k) {
    if (!isNameSign(name[k]) && name[k] != '+' && name[k] != '-') return "";
  }
  return name.substr(0, end);
}

std::string resolved(const std::string& name, const std::string& folder) {
  const std::string scheme = schemeOf(name);
  const std::string rest = scheme.empty() ? "" : name.substr(scheme.size() + 3);
  if (scheme == "package") return ofPackage(withVariables(rest));
  if (scheme == "file") return ofFileUrl(rest);
  if (!scheme.empty())
    throw BadInput(scheme + ":// is not supported; known: package://, file://, ~, $VARIABLE and plain paths");
  const fs::path path = withHome(withVariables(name));
  return path.is_absolute() || folder.empty() ? path.string() : (fs::path(folder) / path).string();
}

/// A file or folder, or a pattern of files in a folder that is there.
bool isThere(const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) return true;
  const bool pattern = path.filename().string().find('%') != std::string::npos;
  return pattern && fs::is_directory(path.parent_path(), ignored);
}

}  // namespace

std::string resolvedPath(const std::string& name, const std::string& folder) {
  const fs::path plain =
      folder.empty() || fs::path(name).is_absolute() ? fs::path(name) : fs::path(folder) / name;
  std::error_code ignored;
  if (!name.empty() && fs::exists(plain, ignored)) return plain.string();
  try {
    return resolved(name, folder);
  } catch (const BadInput& e) {
    throw BadInput(name + ": " + e.what());
  }
}

std::string pathParameter(const std::string& parameter, const std::string& path) {
  const bool plain = path.find("://") == std::string::npos && path.find('$') == std::string::npos;
  if (path.empty() || !plain || path[0] == '/' || path[0] == '~' || isThere(path)) return path;
  std::error_code ignored;
  const std::string here = fs::current_path(ignored).string();
  const char* shell = std::getenv("PWD");
  if (shell && isThere(fs::path(shell) / path)) return (fs::path(shell) / path).string();
  std::string folders = here;
  if (shell && shell != here) folders += ", nor in " + std::string(shell);
  throw BadInput(fmt::format("{0}: there is no {1} in {2}: give the whole path, as {0}:=$PWD/{1}", parameter,
                             path, folders));
}

}  // namespace monocular_eye_hand
