#pragma once
#include <optional>
#include <string>

#include "monocular_eye_hand/options/options.h"

namespace monocular_eye_hand {

/// What --help says of a node.
struct NodeHelp {
  std::string name, job;
  std::string subscribed, published, offered;  ///< topics in and out; services and actions
  std::string launch;                          ///< launch file with the arguments of an example
  std::string config;                          ///< file that explains the parameters; "": docs/nodes.md
};

/// The text of --help; `parameters`: the node's, with their defaults.
std::string helpText(const NodeHelp& help, const OptionTree& parameters);

/// For the first line of main: the code with which the program is to end after --help (0), or after an
/// argument that is none of ROS (1); the text was printed. None: it goes on.
std::optional<int> exitAtCommandLine(int argc, char** argv, const NodeHelp& help,
                                     const OptionTree& parameters);

/// The path that a parameter means. Nodes of a launch file run in a folder of ROS; the shell's own one is
/// still in $PWD, so a relative path that is not found here is looked for there. URLs, ~ and $VARIABLE are
/// left as they are, "" too. Throws BadInput naming the parameter and both folders when neither has it.
std::string pathParameter(const std::string& parameter, const std::string& path);

}  // namespace monocular_eye_hand
