#pragma once
#include <cmath>
#include <cstdint>

namespace monocular_eye_hand {

// Seeded numbers that are the same with every standard library (std distributions are not).

inline uint32_t mixBits(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}
inline uint32_t mixBits(uint32_t a, uint32_t b) { return mixBits(a + 0x9e3779b9u * (b + 1)); }
/// 0 <= value < 1.
inline double unitInterval(uint32_t bits) { return (bits >> 8) * (1.0 / 16777216.0); }

class Generator {
 public:
  explicit Generator(uint32_t seed) : state_(mixBits(seed, 0x51ed27u)) {}
  uint32_t bits() { return mixBits(state_, ++count_); }
  double uniform(double low, double high) { return low + (high - low) * unitInterval(bits()); }
  /// low <= value <= high.
  int integer(int low, int high) { return low + int(unitInterval(bits()) * (high - low + 1)); }
  double gaussian() {
    const double u = 1 - unitInterval(bits()), v = unitInterval(bits());
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
  }

 private:
  uint32_t state_, count_ = 0;
};

}  // namespace monocular_eye_hand
