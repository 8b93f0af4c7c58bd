#pragma once
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/recognition/object_estimate.h"
#include "recognition/decision.h"
#include "recognition/hypotheses.h"
#include "recognition/search_image.h"

namespace monocular_eye_hand {

/// The search of one image: the seed's steps 1 to 7. Used once.
class ImageSearch {
 public:
  /// `only`: index of the one object wanted, or -1.
  ImageSearch(const ModelBase& base, const std::vector<SearchModel>& models,
              const RecognitionOptions& options, const cv::Mat& grey, const Camera& camera, int only);
  RecognitionResult run(const std::vector<ObjectEstimate>& previous);

 private:
  bool wanted(int object) const { return only_ < 0 || only_ == object; }
  int wantedFrom(int first) const;  // objects that are wanted, from this one on
  void lookAtImage();               // features, groupings, evidence
  void searchGroupings();           // first round: points and ellipses
  void searchEdges();               // second round: single edges with the view sphere
  struct AlignedHypothesis {
    Hypothesis hypothesis;
    Eigen::Vector2d centre;  // of the object, in the image [uv_rect px]
  };
  void judgeHypotheses(int object, int count);
  std::vector<AlignedHypothesis> alignHypotheses(const SearchModel& model,
                                                 const std::vector<Hypothesis>& hypotheses);
  std::vector<AlignedHypothesis> distinctPlaces(const SearchModel& model,
                                                const std::vector<AlignedHypothesis>& aligned) const;
  bool knownCandidate(int object, const Rigid3& camera_from_object, double distance) const;
  bool judge(int object, const Hypothesis& hypothesis);  // true when it came to be verified
  std::vector<char> unexplainedSegments() const;
  bool found() const;
  std::string whyNothing() const;
  void recalculateChosen();  // seed 2.4: best four of the constellation
  void report();
  void refineReported();  // in full resolution, feature against feature
  void keepTurn(const std::vector<ObjectEstimate>& previous, ObjectEstimate* object) const;
  void refine(const RectDomain& domain, const EdgeRaster& raster, double scale, ObjectEstimate* object) const;
  void timed(const char* stage, const std::function<void(StageReport*)>& work);

  const ModelBase& base_;
  const std::vector<SearchModel>& models_;
  const RecognitionOptions& options_;
  const cv::Mat& image_;
  const Camera& full_camera_;
  const int only_;

  Camera camera_;  // of the search image
  cv::Mat grey_;   // the search image
  RectDomain domain_;
  cv::Mat rect_grey_;
  std::unique_ptr<EvidenceMap> map_;
  std::unique_ptr<EdgeRaster> raster_;
  std::optional<VerificationContext> context_;  // of the members above
  std::vector<HypothesisPool> pools_;
  std::vector<Candidate> candidates_;
  WorkBudget budget_;
  RecognitionResult result_;
};

}  // namespace monocular_eye_hand
