#pragma once
#include <string>

#include "monocular_eye_hand/offline/options.h"

namespace monocular_eye_hand {

/// Where the options of a task without ROS stand; "": the package's own file.
struct OfflineFiles {
  std::string config;   ///< folder with recognizer.yaml, eye_hand.yaml, planner.yaml and task.yaml
  std::string objects;  ///< model base; "": objects.yaml in `config`
  std::string cell;     ///< work cell; "": cell.yaml in `config`
  std::string urdf;     ///< arm with gripper and camera
};

/// Reads the files of the nodes, whole, as they do; what only a node needs is left out.
OfflineOptions readOfflineFiles(const OfflineFiles& files);
/// The model base that these say.
std::string objectsFile(const OfflineFiles& files);

}  // namespace monocular_eye_hand
