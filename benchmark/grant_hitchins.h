#pragma once
#include <complex>
#include <vector>

namespace monocular_eye_hand {

/// All roots of c[0] + c[1] z + .. + c[n] z^n with real coefficients, n of them when the leading one is not
/// 0, the smallest first; a real root has the imaginary part 0. Grant & Hitchins, J. Inst. Maths Applics 8,
/// 1971, and The Computer Journal 18(3), 1975: damped Newton steps on |P|^2 that end at Adams' bound of the
/// rounding of P, then composite deflation. The method that Wong et al. name (2.3.3), as plain as there:
/// nothing is polished.
std::vector<std::complex<double>> grantHitchinsRoots(std::vector<double> coefficients);

}  // namespace monocular_eye_hand
