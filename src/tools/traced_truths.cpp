#include "tools/traced_truths.h"

#include <algorithm>

#include "monocular_eye_hand/evaluation/outcomes.h"

namespace monocular_eye_hand {

std::vector<int> wantedTruths(const BopImage& image, const std::vector<int>& bop_objects) {
  std::vector<int> wanted;
  for (size_t k = 0; k < image.truth.size(); ++k) {
    const GroundTruth& truth = image.truth[k];
    const bool known = std::count(bop_objects.begin(), bop_objects.end(), truth.object) > 0;
    if (known && truth.visible >= kWantedVisible) wanted.push_back(int(k));
  }
  return wanted;
}

std::vector<PoseProposal> posesToTrace(const BopImage& image, const std::vector<int>& truths,
                                       const std::vector<int>& bop_objects) {
  std::vector<PoseProposal> poses;
  for (const int k : truths) {
    const GroundTruth& truth = image.truth.at(size_t(k));
    const auto object = std::find(bop_objects.begin(), bop_objects.end(), truth.object);
    poses.push_back({int(object - bop_objects.begin()), truth.camera_from_object});
  }
  return poses;
}

std::vector<TracedTruth> tracedTruths(const std::vector<PoseTrace>& traces, const BopImage& image,
                                      const std::vector<int>& truths, double scale) {
  std::vector<TracedTruth> all;
  for (size_t i = 0; i < traces.size(); ++i) {
    TracedTruth traced;
    traced.scene = image.scene;
    traced.image = image.id;
    traced.truth = truths.at(i);
    traced.groupings = traces[i].groupings;
    traced.generated = traces[i].generated / scale;
    traced.taken = traces[i].taken / scale;
    traced.aligned = traces[i].aligned / scale;
    traced.verified = traces[i].verified / scale;
    traced.recorded = traces[i].recorded / scale;
    all.push_back(traced);
  }
  return all;
}

}  // namespace monocular_eye_hand
