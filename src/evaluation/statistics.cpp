#include "monocular_eye_hand/evaluation/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

Interval wilson95(const Share& share) {
  if (share.part < 0 || share.part > share.whole)
    throw BadInput(fmt::format("a share of {} of {}: 0 <= part <= whole is needed", share.part, share.whole));
  if (share.whole == 0) return {};
  const double z = 1.959964, n = share.whole, p = share.value();
  const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n);
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void PairedCounts::add(bool a, bool b) {
  if (a)
    ++(b ? both : only_a);
  else
    ++(b ? only_b : neither);
}

double PairedCounts::chance() const {
  const int n = only_a + only_b, fewer = std::min(only_a, only_b);
  double tail = 0;
  for (int k = 0; k <= fewer; ++k)
    tail +=
        std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) - n * std::log(2.0));
  return std::min(1.0, 2 * tail);
}

std::vector<ReliabilityBin> reliabilityBins(std::vector<Prediction> predictions, int bins) {
  if (bins < 1) throw BadInput(fmt::format("reliability: bins = {} must be at least 1", bins));
  std::stable_sort(predictions.begin(), predictions.end(),
                   [](const Prediction& a, const Prediction& b) { return a.probability < b.probability; });
  const size_t count = predictions.size(), used = std::min(count, size_t(bins));
  std::vector<ReliabilityBin> result;
  for (size_t bin = 0; bin < used; ++bin) {
    const size_t first = bin * count / used, end = (bin + 1) * count / used;
    ReliabilityBin made;
    made.right.whole = int(end - first);
    for (size_t k = first; k < end; ++k) {
      made.right.part += predictions[k].right;
      made.mean_probability += predictions[k].probability / double(end - first);
    }
    result.push_back(made);
  }
  return result;
}

double calibrationError(const std::vector<ReliabilityBin>& bins) {
  double sum = 0, count = 0;
  for (const ReliabilityBin& bin : bins) {
    sum += bin.right.whole * std::abs(bin.mean_probability - bin.right.value());
    count += bin.right.whole;
  }
  return count > 0 ? sum / count : std::nan("");
}

}  // namespace monocular_eye_hand
