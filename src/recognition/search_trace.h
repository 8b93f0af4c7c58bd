#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"
#include "recognition/search_task.h"

namespace monocular_eye_hand {

/// The stages that a pose passes in the search, in their order; PoseTrace says what they are.
enum class SearchStage { kGenerated, kTaken, kAligned, kVerified, kRecorded };
constexpr int kSearchStages = 5;

/// Notes how near the search comes to poses that are known. It listens only: the search does not depend on
/// it.
class SearchTrace {
 public:
  /// Refers to the image and the models. `scale`: of the full image over the search image. Throws BadInput on
  /// an object that is not known.
  SearchTrace(const SearchImage& image, const std::vector<SearchModel>& models,
              const std::vector<PoseProposal>& poses, double scale);

  /// A pose of an object has come to a stage.
  void note(SearchStage stage, int object, const Rigid3& camera_from_object);

  /// What was noted of each pose, in their order.
  std::vector<PoseTrace> traces() const;

 private:
  struct Traced {
    PoseProposal pose;
    Eigen::Vector2d centre;  // of the object in the image [uv_rect px]
    double spread = 0;       // largest distance from there to the centre under an equal pose [px]
    std::array<double, kSearchStages> nearest;  // [px of the search image]
  };
  Traced traced(const PoseProposal& pose) const;

  const SearchImage& image_;
  const std::vector<SearchModel>& models_;
  double scale_;
  std::vector<Traced> traced_;
};

/// Notes a pose when somebody traces the search.
inline void note(const SearchTask& task, SearchStage stage, int object, const Rigid3& camera_from_object) {
  if (task.trace) task.trace->note(stage, object, camera_from_object);
}

}  // namespace monocular_eye_hand
