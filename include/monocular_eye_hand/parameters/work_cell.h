#pragma once
#include <string>

#include "monocular_eye_hand/arm/puma560.h"
#include "monocular_eye_hand/simulation/cell/options.h"

namespace monocular_eye_hand {

/// Parameters of the node work_cell; `cell` holds the keys of config/cell.yaml. Defaults stand here and
/// nowhere else.
struct WorkCellParameters {
  std::string objects;          ///< model base: path of a YAML as config/objects.yaml; required
  std::string urdf;             ///< path of the arm's URDF; required
  double real_time_factor = 1;  ///< cell seconds per second; 0: as fast as computed while arm or gripper move
  double joint_rate = 100;      ///< of joint_states, gripper/state and /clock [Hz, cell time]
  double camera_rate = 10;      ///< [Hz, cell time]
  bool images_in_motion = true;  ///< false: no image while something moves; saves time in long runs
  double truth_rate = 10;        ///< [Hz, cell time]
  int camera_threads = 0;        ///< 0: as many as the machine has cores
  Puma560Options arm;
  CellOptions cell;

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("objects", objects);
    v("urdf", urdf);
    v("real_time_factor", real_time_factor);
    v("joint_rate", joint_rate);
    v("camera_rate", camera_rate);
    v("images_in_motion", images_in_motion);
    v("truth_rate", truth_rate);
    v("camera_threads", camera_threads);
    v("arm", arm);
    v("cell", cell);
  }
};

}  // namespace monocular_eye_hand
