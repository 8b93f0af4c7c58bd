#pragma once
#include "monocular_eye_hand/eye_hand/chain.h"

namespace monocular_eye_hand {

/// Defaults stand here and nowhere else.
struct ObjectMapOptions {
  ArmErrorOptions arm;
  HandEyeErrorOptions hand_eye;       ///< used when the view brings no covariance of its own
  double min_probability = 0.5;       ///< what is less likely, by all its views together, is not published
  double doubtful_probability = 0.1;  ///< what recognition trusts less in a view is left out
  double agreement_odds =
      4;  ///< each further view that agrees multiplies the odds by this, each miss divides
  /// Sigma of what CAD and part differ by, each axis: added to every view's own part, and once more to the
  /// merged pose, where no number of views takes it away [m].
  double floor_position = 1e-4;
  double floor_rotation = 1e-3;  ///< the same about each axis [rad]
  double gate = 30;              ///< chi-square (6 degrees of freedom) beyond which a view is an outlier
  double same_place = 0.5;       ///< two of a name are one when their centres are nearer than this share of
                                 ///< the smallest side of the part's box: parts do not lie inside each other;
                                 ///< of obstacles, nearer along each side than this share of it
  double max_distance = 0.05;    ///< or nearer than this and inside the gate [m]
  int outliers_to_restart = 2;   ///< so many outliers in a row that agree, or fewer that are surer than all
                                 ///< that spoke for the known pose: the object starts afresh
  double min_motion = 0.01;      ///< views from nearer camera places share their errors [m] ...
  double min_rotation = 0.03;    ///< ... unless the camera turned by this [rad]: they are not averaged
  int max_views = 200;           ///< merged per object; more tell nothing new
  double overlap_depth = 0.004;  ///< two objects that reach into each other deeper are not both there [m]
  /// What reaches deeper than this, and known_sigmas of its pose, into table, walls or the hand is not there
  /// [m].
  double known_depth = 0.004;
  double known_sigmas = 3;
  int forget_after_misses = 5;  ///< views in a row that should have shown an object and did not
  double expected_share = 0.7;  ///< of an object must be in view and free for that ...
  double expected_size = 40;    ///< ... at this size in the image at least [px] ...
  double expected_border = 5;   ///< ... this far from the image's border [px] ...
  /// ... and its centre where recognition looks for objects (min_distance, max_distance of its options, none
  /// nearer than its diameter) [m].
  double expected_nearest = 0.05, expected_farthest = 2.5;

  void check() const;  ///< throws BadInput naming field, value and rule
  template <class Visitor>
  void visit(Visitor&& v) {
    v("arm", arm);
    v("hand_eye", hand_eye);
    v("min_probability", min_probability);
    v("doubtful_probability", doubtful_probability);
    v("agreement_odds", agreement_odds);

    v("floor_position", floor_position);
    v("floor_rotation", floor_rotation);
    v("gate", gate);
    v("same_place", same_place);
    v("max_distance", max_distance);

    v("outliers_to_restart", outliers_to_restart);
    v("min_motion", min_motion);
    v("min_rotation", min_rotation);
    v("max_views", max_views);
    v("overlap_depth", overlap_depth);
    v("forget_after_misses", forget_after_misses);
    v("known_depth", known_depth);
    v("known_sigmas", known_sigmas);

    v("expected_share", expected_share);
    v("expected_size", expected_size);
    v("expected_border", expected_border);
    v("expected_nearest", expected_nearest);
    v("expected_farthest", expected_farthest);
  }
};

}  // namespace monocular_eye_hand
