#include "monocular_eye_hand/io/plain_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {

std::string plainNumber(double value) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const double size = std::abs(value);
  const int before = size >= 1 ? int(std::floor(std::log10(size))) + 1 : 0;
  const int zeros = size > 0 && size < 1 ? int(std::floor(-std::log10(size))) : 0;
  const int decimals = std::clamp(3 - before + zeros, 0, 12);

  std::string out = fmt::format("{:.{}f}", value, decimals);
  if (out.find('.') == std::string::npos) return out;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

}  // namespace monocular_eye_hand
