#pragma once

namespace monocular_eye_hand {

/// For nodes that stop an arm before their topics go away: SIGINT, SIGTERM, `rosnode kill` and a second node
/// of the same name only ask such a node to end. It looks, does what it must, and calls ros::shutdown().
namespace ending {

void takeRequests();  ///< those that come from the master; after ros::init(), before the first NodeHandle
void takeSignals();   ///< until then they end the process; give ros::init() NoSigintHandler
void ask();
bool asked();

}  // namespace ending
}  // namespace monocular_eye_hand
