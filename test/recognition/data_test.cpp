// Data sets with ground truth, from the folder that MONOCULAR_EYE_HAND_DATA names.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/scores.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "monocular_eye_hand/model/model_base.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

struct Share {
  const char* name;
  const char* dataset;  ///< below MONOCULAR_EYE_HAND_DATA
  const char* split;
  int scene;
  int every;            ///< of the scene's images, every so many
  double found, right;  ///< least shares
};

class DataSet : public testing::TestWithParam<Share> {};

Recognizer recognizerOf(const BopModels& models) {
  std::vector<ObjectEntry> entries;
  for (const auto& [id, model] : models)
    entries.push_back({model.name, std::filesystem::absolute(model.mesh_path).string(), "mm", {}});
  return {compileModels(entries, ModelDepth::kViews, {}, cacheFolder())};
}

// Of a report that is the pose of this true object; the turn about a free axis is left out.
void addSquare(const ObjectModel& model, const ObjectEstimate& report, const Rigid3& truth,
               std::vector<double>* squares) {
  const Rigid3 near = nearestEqualPose(model, report.camera_from_object, truth);
  const Vector6d error = difference(truth, near);
  if (error.head<3>().norm() > 0.2 * model.diameter || error.tail<3>().norm() > 0.2) return;
  squares->push_back(error.dot(report.covariance.ldlt().solve(error)) / (model.symmetries.axis ? 5 : 6));
}

TEST_P(DataSet, EnoughIsFoundAndWhatIsReportedIsRight) {
  const Share& share = GetParam();
  const char* root = std::getenv("MONOCULAR_EYE_HAND_DATA");
  if (!root) GTEST_SKIP() << "set MONOCULAR_EYE_HAND_DATA to the folder with workcell/ and real/";
  const std::string folder = std::string(root) + "/" + share.dataset;
  const BopModels models = loadBopModels(folder + "/models");
  BopSplit split = loadBopSplit(folder, share.split, {share.scene});
  std::vector<BopImage> some;
  for (size_t i = 0; i < split.images.size(); i += size_t(share.every)) some.push_back(split.images[i]);
  split.images = some;
  ASSERT_GE(split.images.size(), 4u);

  const Recognizer recognizer = recognizerOf(models);
  std::vector<int> ids;
  for (const auto& entry : models) ids.push_back(entry.first);
  std::vector<BopResult> rows;
  std::vector<double> squares;  // errors in units of the covariance, per degree of freedom
  for (const BopImage& image : split.images) {
    const cv::Mat grey = loadBopImage(image);
    const RecognitionResult result = recognizer.recognize(grey, bopCamera(image, grey.cols, grey.rows));
    for (const ObjectEstimate& o : result.objects) {
      for (const GroundTruth& truth : image.truth)
        if (truth.object == ids.at(size_t(o.object)))
          addSquare(recognizer.models().objects[size_t(o.object)].model, o, truth.camera_from_object,
                    &squares);
      rows.push_back({image.scene, image.id, ids.at(size_t(o.object)), o.probability, o.camera_from_object});
    }
  }

  const auto summaries = summarize(split, models, rows, {});
  ASSERT_EQ(summaries.size(), 1u);
  ASSERT_GT(summaries[0].wanted, 0);
  EXPECT_GE(summaries[0].foundShare(), share.found) << summaryLine(summaries[0]);
  EXPECT_GE(summaries[0].rightShare(), share.right) << summaryLine(summaries[0]);

  ASSERT_GE(squares.size(), 4u);
  std::nth_element(squares.begin(), squares.begin() + squares.size() / 2, squares.end());
  const double median = squares[squares.size() / 2];
  std::cout << share.name << ": " << summaryLine(summaries[0]) << ", median normalised squared error "
            << median << "\n";
  EXPECT_GT(median, 0.9 / 100) << "covariances are ten times too wide";
  EXPECT_LT(median, 0.9 * 100) << "covariances are ten times too narrow";
}

INSTANTIATE_TEST_SUITE_P(Shared, DataSet,
                         testing::Values(Share{"easy", "workcell", "dev", 1, 5, 0.8, 0.85},
                                         Share{"medium", "workcell", "dev", 2, 5, 0.7, 0.85},
                                         Share{"hard", "workcell", "dev", 3, 5, 0.45, 0.75},
                                         Share{"cabinet", "real/cabinet", "test", 1, 6, 0.99, 0.99},
                                         Share{"cube", "real/cube", "test", 1, 6, 0.99, 0.99}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace monocular_eye_hand
