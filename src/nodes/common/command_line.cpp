#include "nodes/common/command_line.h"

#include <ros/init.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <vector>

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

void addLine(const char* head, const std::string& text, std::string* all) {
  if (!text.empty()) *all += std::string(head) + text + "\n";
}

std::string indented(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) out += "  " + line + "\n";
  return out;
}

/// A file or folder, or a pattern of files in a folder that is there.
bool found(const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) return true;
  const bool pattern = path.filename().string().find('%') != std::string::npos;
  return pattern && fs::is_directory(path.parent_path(), ignored);
}

}  // namespace

std::string helpText(const NodeHelp& help, const OptionTree& parameters) {
  std::string text = "Node " + help.name + ": " + help.job + "\n\n";
  addLine("Usual start:  roslaunch monocular_eye_hand ", help.launch, &text);
  text +=
      "By hand:      rosrun monocular_eye_hand " + help.name + " _PARAMETER:=VALUE TOPIC:=OTHER_TOPIC\n\n";
  addLine("Subscribed:   ", help.subscribed, &text);
  addLine("Published:    ", help.published, &text);
  addLine("Offered:      ", help.offered, &text);
  text += "\nParameters and their defaults, explained in docs/nodes.md";
  text += (help.config.empty() ? "" : " and " + help.config) + ":\n";
  return text + indented(toYaml(parameters));
}

std::optional<int> exitAtCommandLine(int argc, char** argv, const NodeHelp& help,
                                     const OptionTree& parameters) {
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  if (arguments.size() < 2) return std::nullopt;

  const std::string& first = arguments[1];
  if (first == "--help" || first == "-h") {
    std::cout << helpText(help, parameters);
    return 0;
  }

  std::cerr << help.name << ": '" << first
            << "' is no argument of a node: parameters are given as _NAME:=VALUE; --help lists them\n";
  return 1;
}

std::string pathParameter(const std::string& parameter, const std::string& path) {
  const bool plain = path.find("://") == std::string::npos && path.find('$') == std::string::npos;
  if (path.empty() || !plain || path[0] == '/' || path[0] == '~' || found(path)) return path;
  std::error_code ignored;
  const std::string here = fs::current_path(ignored).string();
  const char* shell = std::getenv("PWD");
  if (shell && found(fs::path(shell) / path)) return (fs::path(shell) / path).string();
  std::string folders = here;
  if (shell && shell != here) folders += ", nor in " + std::string(shell);
  throw BadInput(parameter + ": there is no " + path + " in " + folders + ": give the whole path, as " +
                 parameter + ":=$PWD/" + path);
}

}  // namespace monocular_eye_hand
