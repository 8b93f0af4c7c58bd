#pragma once

namespace monocular_eye_hand {

/// Weights of the evidence terms in the log-odds that a candidate is right. They were fitted by logistic
/// regression on candidates from rendered training scenes (benchmark/fit_decision.py); see docs/pipeline.md.
struct DecisionWeights {
  double bias = -18.66;
  double log_sum = 0.148;
  double mean = 1.681;
  double hit_ratio = -2.441;
  double silhouette_hits = -1.194;
  double crease_hits = 0.389;
  double log_groups = -0.645;
  double unsupported = -5.443;
  double unsupported_length = -4.326;
  double continuation = -3.997;
  double overhang = -6.987;
  double interior = -2.007;
  double solidity = -2.066;
  double log_faces = 3.949;
  double log_size = 3.104;
  double log_contrast = -0.075;
  double in_frame = 7.275;
  double rms = -3.634;

  template <class Visitor>
  void visit(Visitor&& v) {
    v("bias", bias);
    v("log_sum", log_sum);
    v("mean", mean);
    v("hit_ratio", hit_ratio);
    v("silhouette_hits", silhouette_hits);
    v("crease_hits", crease_hits);
    v("log_groups", log_groups);
    v("unsupported", unsupported);
    v("unsupported_length", unsupported_length);
    v("continuation", continuation);
    v("overhang", overhang);
    v("interior", interior);
    v("solidity", solidity);
    v("log_faces", log_faces);
    v("log_size", log_size);
    v("log_contrast", log_contrast);
    v("in_frame", in_frame);
    v("rms", rms);
  }
};

}  // namespace monocular_eye_hand
