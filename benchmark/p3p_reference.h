#pragma once
#include "p3p_problems.h"

namespace monocular_eye_hand {

/// Number of poses with all points before the lens, in 113-bit arithmetic: Grunert's quartic as in Haralick
/// et al., IJCV 13, IJCV 13, 1994, its roots by Durand-Kerner. -1 when the count is not well defined: two
/// roots within 1e-6, a root at the edge of being positive, or a vanishing denominator.
int referenceCount(const P3PProblem& problem);

}  // namespace monocular_eye_hand
