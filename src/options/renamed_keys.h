#pragma once
#include <array>

namespace monocular_eye_hand {

/// A key of an earlier version and what it is called now. It is refused with its new name wherever that is
/// known.
struct RenamedKey {
  const char* before;
  const char* now;
};

inline constexpr std::array<RenamedKey, 15> kRenamedKeys{{
    {"branches", "configurations"},              // eye_hand: grasp
    {"max_tf_turn", "max_tf_rotation"},          // eye_hand
    {"max_turn", "max_rotation"},                // planner: cartesian
    {"min_turn", "min_rotation"},                // eye_hand: map
    {"most", "max_candidates"},                  // eye_hand: grasp
    {"most", "max_grasps"},                      // eye_hand: sampling
    {"most", "max_views"},                       // task: views
    {"most_rounds", "max_rounds"},               // task: clear_frame
    {"most_views", "max_views"},                 // eye_hand: map
    {"near_turn", "near_azimuth_step"},          // task: views
    {"nearest", "min_distance"},                 // task: views
    {"overview_turn", "overview_azimuth_step"},  // task: views
    {"parallel", "max_face_angle"},              // eye_hand: sampling
    {"turn_deviation", "rotation_deviation"},    // planner: cartesian
    {"turns", "rotation_steps"},                 // eye_hand: grasp; given grasps of a model base
}};

}  // namespace monocular_eye_hand
