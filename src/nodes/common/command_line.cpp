#include "nodes/common/command_line.h"

#include <ros/init.h>

#include <iostream>
#include <sstream>
#include <vector>

namespace monocular_eye_hand {
namespace {

void addLine(const char* head, const std::string& text, std::string* all) {
  if (!text.empty()) *all += std::string(head) + text + "\n";
}

std::string indented(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) out += "  " + line + "\n";
  return out;
}

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

}  // namespace

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

}  // namespace monocular_eye_hand
