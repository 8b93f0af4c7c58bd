#pragma once
#include <vector>

namespace monocular_eye_hand {

/// How an edge point appearances that answers a contour sample.
struct EdgeAppearance {
  double blur = 0;   ///< standard deviation of the edge's profile [px]
  double angle = 0;  ///< angle between the edge and the contour [rad], any sign
};

/// Tells clean steps of brightness from edges whose place is doubtful. All clean steps of a picture share the
/// blur of its lens and detector; an edge with a wider or narrower profile is something else in part: two
/// edges as one, the penumbra of a shadow, a shading; and it lies beside its model edge. So does an edge that
/// runs across the contour.
class EdgeProfiles {
 public:
  /// From all edge points of a part; what most of them share is the blur of a clean step.
  explicit EdgeProfiles(const std::vector<EdgeAppearance>& appearances);
  /// Standard deviation [px] to expect of the offset of an edge from its model edge, the error that all of
  /// its points have in common.
  double expectedOffset(const std::vector<EdgeAppearance>& edge) const;
  /// The blur of a clean step [px].
  double cleanBlur() const { return clean_blur_; }

 private:
  double clean_blur_ = 0, half_width_ = 0;  // middle and half width of the narrowest interval of most of them
};

}  // namespace monocular_eye_hand
