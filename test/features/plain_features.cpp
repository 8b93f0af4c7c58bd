// Compiled, as the sources of the features beside it, without the clones for vector instructions and in a
// namespace of its own (see CMakeLists.txt).
#include "flat_features.h"

std::vector<double> plainFeatures(const cv::Mat& grey) { return monocular_eye_hand::flatFeatures(grey); }
