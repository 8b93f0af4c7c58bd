#pragma once
#include <ros/spinner.h>

#include <functional>
#include <string>
#include <vector>

#include "nodes/common/command_line.h"
#include "nodes/common/node_watch.h"

namespace monocular_eye_hand {

/// What a node asks of its main.
struct NodeSetup {
  NodeHelp help;
  /// Keys below the node's name that libraries keep there (a plugin's settings below an image topic).
  std::vector<std::string> foreign_parameters;
  /// SIGINT, SIGTERM, `rosnode kill` and a second node of the same name only ask the node to end, which does
  /// so by runUntilAsked(): an arm that moves is stopped before the topics go away.
  bool ends_when_asked = false;
};

/// All of main() but what the node does: command line, ROS, parameters, errors. Returns the exit code.
/// `defaults`: of the parameters, for --help. `work` gets those that are set; it returns when the node ends.
int runNode(int argc, char** argv, const NodeSetup& setup, const OptionTree& defaults,
            const std::function<void(const OptionTree&, const NodeWatch&)>& work);

template <class Parameters>
int runNode(int argc, char** argv, const NodeSetup& setup,
            const std::function<void(Parameters&, const NodeWatch&)>& work) {
  const auto read_and_work = [&work](const OptionTree& tree, const NodeWatch& watch) {
    Parameters parameters;
    readOptions(tree, &parameters);
    work(parameters, watch);
  };
  return runNode(argc, argv, setup, writeOptions(Parameters()), read_and_work);
}

/// The life of a node with `ends_when_asked`: it logs that it is ready, with `what` it is ready for, and
/// takes callbacks until it is asked to end; then `stop`, and only then the topics go.
void runUntilAsked(ros::AsyncSpinner* spinner, const std::string& what, const std::function<void()>& stop);

}  // namespace monocular_eye_hand
