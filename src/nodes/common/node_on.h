#pragma once
#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <string>

namespace monocular_eye_hand {

/// Names in `space` ("~": below the node's own name), whose callbacks wait in a queue of their own: who
/// serves it has its own threads.
inline ros::NodeHandle nodeOn(ros::CallbackQueue* queue, const std::string& space = "") {
  ros::NodeHandle node(space);
  node.setCallbackQueue(queue);
  return node;
}

}  // namespace monocular_eye_hand
