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

/// For the first line of main: the code with which the program is to end after --help (0), or after an
/// argument that is none of ROS (1); the text was printed. None: it goes on. `parameters`: the node's, with
/// their defaults.
std::optional<int> exitAtCommandLine(int argc, char** argv, const NodeHelp& help,
                                     const OptionTree& parameters);

}  // namespace monocular_eye_hand
