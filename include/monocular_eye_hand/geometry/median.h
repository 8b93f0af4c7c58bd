#pragma once
#include <algorithm>
#include <vector>

namespace monocular_eye_hand {

/// The upper median of the values, which it leaves in another order; 0 of none.
template <class Value>
double median(std::vector<Value>* values) {
  if (values->empty()) return 0;
  const auto middle = values->begin() + std::ptrdiff_t(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  return double(*middle);
}

}  // namespace monocular_eye_hand
