#pragma once
#include <vector>

namespace monocular_eye_hand {

/// So many of so many.
struct Share {
  int part = 0, whole = 0;
  double value() const { return whole > 0 ? double(part) / whole : 0; }
};

struct Interval {
  double low = 0, high = 1;
};

/// Where the true share lies with 95 % confidence (Wilson 1927); 0..1 when nothing was counted. Throws
/// BadInput unless 0 <= part <= whole.
Interval wilson95(const Share& share);

/// NaN of no values.
double median(std::vector<double> values);

/// Things that two runs did or did not manage, counted in pairs.
struct PairedCounts {
  int both = 0, only_a = 0, only_b = 0, neither = 0;
  void add(bool a, bool b);
  /// Probability that two equally good runs differ by this much or more: McNemar's test, exact and two-sided.
  double chance() const;
};

/// A probability that was claimed, and how it came out.
struct Prediction {
  double probability = 0;
  bool right = false;
};

/// Predictions of neighbouring probabilities.
struct ReliabilityBin {
  Share right;
  double mean_probability = 0;
};

/// At most `bins` bins of equal count (to one), ascending; none is empty. Throws BadInput on bins < 1.
std::vector<ReliabilityBin> reliabilityBins(std::vector<Prediction> predictions, int bins = 10);

/// Expected calibration error: |mean probability - share right|, averaged over the predictions. NaN of none.
double calibrationError(const std::vector<ReliabilityBin>& bins);

}  // namespace monocular_eye_hand
