#pragma once
#include "p3p_problems.h"

namespace monocular_eye_hand {

/// The perspective tetrahedron as Wong et al. solve it (2.3.3-2.3.4): the quartic of Fischler & Bolles (CACM
/// 24, 1981, appendix A), its real roots by Grant and Hitchins' method, the pose by objectFromCamera().
/// `polish`: each root's legs are taken to rounding by Newton's method on the three cosine laws (Wong et al.,
/// eqs. 3-5) first.
std::vector<Rigid3> paperP3P(const P3PProblem& problem, bool polish);

}  // namespace monocular_eye_hand
