#pragma once
#include <chrono>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "monocular_eye_hand/recognition/decision.h"
#include "monocular_eye_hand/recognition/hypotheses.h"
#include "monocular_eye_hand/recognition/recognizer.h"

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
  bool outOfTime() const;
  void lookAtImage();      // features, groupings, evidence
  void searchGroupings();  // first round: points and ellipses
  void searchEdges();      // second round: single edges with the view sphere
  void judgeHypotheses(int object, int count);
  std::vector<char> unexplainedSegments() const;
  bool found() const;
  void recalculateChosen();  // seed 2.4: best four of the constellation
  void refineInFull();       // when the image was searched at a lower resolution
  void timed(const char* stage, const std::function<void(StageReport*)>& work);

  const ModelBase& base_;
  const std::vector<SearchModel>& models_;
  const RecognitionOptions& options_;
  const cv::Mat& image_;
  const Camera& full_camera_;
  const int only_;
  const std::chrono::steady_clock::time_point start_;

  Camera camera_;  // of the search image
  cv::Mat grey_;   // the search image
  RectDomain domain_;
  cv::Mat rect_grey_;
  std::unique_ptr<EvidenceMap> map_;
  std::unique_ptr<EdgeRaster> raster_;
  std::vector<HypothesisPool> pools_;
  std::vector<Candidate> candidates_;
  WorkBudget budget_;
  RecognitionResult result_;
};

}  // namespace monocular_eye_hand
