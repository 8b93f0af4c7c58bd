#include "monocular_eye_hand/report/explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/report/result_drawing.h"
#include "report/html.h"
#include "support/camera.h"
#include "support/read_file.h"

using namespace monocular_eye_hand;
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

namespace {

Camera camera() { return centredCamera(640, 480, 700); }
cv::Mat greyImage() { return cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)); }

ModelBase boxBase(const std::string& name) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? 0.06 : -0.06, i & 2 ? 0.02 : -0.02, i & 4 ? 0.05 : 0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  ModelBase models;
  models.objects.push_back({buildModel(name, mesh), {}});
  return models;
}

ObjectEstimate candidate(double x, Decision decision, const std::string& reason) {
  ObjectEstimate object;
  object.object = 0;
  object.name = "box";
  object.camera_from_object = {expSO3({1.9, 0.25, -0.3}), {x, 0.02, 0.5}};
  object.probability = 0.93;
  object.decision = decision;
  object.reason = reason;
  object.evidence = {{"edge support", 0.87}, {"false <alarm>", 0.1}};
  return object;
}

RecognitionResult someResult() {
  RecognitionResult result;
  result.features.camera = camera();
  LineSegment segment;
  segment.p = {100, 100};
  segment.q = {300, 200};
  result.features.segments = {segment};
  Grouping edge;
  edge.segments = {0};
  edge.points = {segment.p, segment.q};
  result.groupings = {edge};
  result.objects = {candidate(-0.1, Decision::kAccepted, "explains 9 of 9 edges"),
                    candidate(0.1, Decision::kAmbiguous, "two poses are \"equal\" & likely")};
  result.rejected = {candidate(0, Decision::kRejected, "<script>alert(1)</script>")};
  result.stages = {{"features", 0.0123, {{"segments", 1}}}};
  return result;
}

class Explain : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = (fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name())
                  .string();
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string folder_;
};

}  // namespace

TEST_F(Explain, PageShowsEveryStageAndEveryPictureExists) {
  const std::string page = writeExplanation(folder_, greyImage(), camera(), boxBase("box"), someResult());
  const std::string html = readFile(page);
  std::set<std::string> pictures;
  const std::regex source("(?:src|href)=\"([^\"#]+)\"");
  for (std::sregex_iterator it(html.begin(), html.end(), source), end; it != end; ++it) {
    const std::string file = (*it)[1];
    EXPECT_TRUE(fs::exists(fs::path(folder_) / file)) << file;
    EXPECT_EQ(file.find(':'), std::string::npos) << "nothing is fetched from elsewhere: " << file;
    pictures.insert(file);
  }

  for (const char* file :
       {"image.png", "traces.png", "segments.png", "ellipses.png", "line_groups.png", "groupings_0.png",
        "object_0.png", "object_1.png", "rejected_0.png", "result.png"}) {
    EXPECT_TRUE(pictures.count(file)) << file;
    const cv::Mat picture = cv::imread((fs::path(folder_) / file).string());
    EXPECT_EQ(picture.cols, 1280) << file;
  }
  for (const char* text : {"explains 9 of 9 edges", "12.3 ms", "1 segments", "edge support", "0.87",
                           "accepted", "ambiguous", "rejected"})
    EXPECT_THAT(html, HasSubstr(text));
}

TEST_F(Explain, TextIsEscaped) {
  const std::string html =
      readFile(writeExplanation(folder_, greyImage(), camera(), boxBase("box"), someResult()));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_THAT(html, HasSubstr("false &lt;alarm&gt;"));
  EXPECT_EQ(escapeHtml("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
  EXPECT_EQ(escapeHtml("\xC3\xA9 \xE2\x82\xAC"), "\xC3\xA9 \xE2\x82\xAC");            // UTF-8 passes
  EXPECT_EQ(escapeHtml("a\xFF\x01z\xC3"), "a\xEF\xBF\xBD\xEF\xBF\xBDz\xEF\xBF\xBD");  // what is not does not
  EXPECT_EQ(escapeHtml("\xC0\xBC"), "\xEF\xBF\xBD\xEF\xBF\xBD");                      // overlong '<'
}

TEST_F(Explain, NothingFoundSaysWhy) {
  RecognitionResult result;
  result.features.camera = camera();
  result.reason = "no segment is longer than 8 px";
  result.truncated = true;
  const std::string html = readFile(writeExplanation(folder_, greyImage(), camera(), boxBase("box"), result));
  EXPECT_THAT(html, HasSubstr("Nothing found. no segment is longer than 8 px"));
  EXPECT_THAT(html, HasSubstr("time limit"));
}

TEST_F(Explain, LimitsRejectedAndRefusesBadInput) {
  RecognitionResult result = someResult();
  for (int k = 0; k < 5; ++k) result.rejected.push_back(candidate(0.01 * k, Decision::kRejected, "weak"));
  ExplanationOptions options;
  options.rejected = 2;
  writeExplanation(folder_, greyImage(), camera(), boxBase("box"), result, options);
  EXPECT_TRUE(fs::exists(fs::path(folder_) / "rejected_1.png"));
  EXPECT_FALSE(fs::exists(fs::path(folder_) / "rejected_2.png"));
  options.rejected = -1;
  EXPECT_THROW(writeExplanation(folder_, greyImage(), camera(), boxBase("box"), result, options), BadInput);
  EXPECT_THROW(writeExplanation("/proc/not_writable", greyImage(), camera(), boxBase("box"), result),
               BadInput);
  EXPECT_THROW(writeExplanation(folder_, cv::Mat(100, 100, CV_8UC1), camera(), boxBase("box"), result),
               BadInput);
}

TEST_F(Explain, FeaturesAtTheSizeThatWasSearchedObjectsInFull) {
  const Camera full = camera().resized(2);
  cv::Mat image(full.height, full.width, CV_8UC1, cv::Scalar(90));
  const RecognitionResult result = someResult();  // features of 640 x 480
  const std::string html = readFile(writeExplanation(folder_, image, full, boxBase("box"), result));
  EXPECT_THAT(html, HasSubstr("1280 x 960 px was searched at 640 x 480 px"));
  // The segment from (100, 100) to (300, 200) lies in the picture where it lies in the image: at twice that.
  const cv::Mat segments = cv::imread((fs::path(folder_) / "segments.png").string());
  ASSERT_EQ(segments.size(), cv::Size(1280, 960));
  const cv::Vec3b middle = segments.at<cv::Vec3b>(301, 401), beside = segments.at<cv::Vec3b>(330, 401);
  EXPECT_GT(middle[2], 200) << "yellow";
  EXPECT_LT(beside[2], 120);
  // The same pose, drawn by the camera of the full image.
  const cv::Mat shown = cv::imread((fs::path(folder_) / "object_0.png").string());
  EXPECT_EQ(cv::norm(shown, drawCandidate(image, full, boxBase("box"), result.objects[0]), cv::NORM_INF), 0);
}

TEST_F(Explain, StagesOfOneNameAreOneRow) {
  RecognitionResult result = someResult();
  result.stages.push_back({"verification", 0.5, {{"verified", 1000}}});
  result.stages.push_back({"verification", 0.25, {{"verified", 234}}});
  const std::string html = readFile(writeExplanation(folder_, greyImage(), camera(), boxBase("box"), result));
  EXPECT_THAT(html, HasSubstr("<td>verification</td><td>750.0 ms</td><td>1,234 verified</td>"));
}

TEST_F(Explain, FiguresOfThePaper) {
  RecognitionResult result = someResult();
  result.objects[1].name = "a/b c";
  const auto names = [&] {
    std::vector<std::string> found;
    for (const std::string& path : writeFigures(folder_, greyImage(), camera(), boxBase("box"), result)) {
      EXPECT_FALSE(cv::imread(path).empty()) << path;
      found.push_back(fs::path(path).filename().string());
    }
    return found;
  };
  EXPECT_THAT(names(),
              testing::ElementsAre("figure_09_scene.png", "figure_10a_line_groups.png",
                                   "figure_10b_ellipses.png", "figure_11a_box.png", "figure_11b_a_b_c.png"));
  result.objects.clear();  // nothing of the earlier call is left
  EXPECT_EQ(names().size(), 3u);
  EXPECT_FALSE(fs::exists(fs::path(folder_) / "figure_11a_box.png"));
  EXPECT_THROW(writeFigures("/proc/not_writable", greyImage(), camera(), boxBase("box"), result), BadInput);
}

TEST(ResultDrawing, ColoursByDecisionAndOnePicturePerObject) {
  const ModelBase models = boxBase("box");
  const RecognitionResult result = someResult();
  const auto shows = [](const cv::Mat& picture, const Colour& colour) {
    cv::Mat mask;
    cv::inRange(picture, colour, colour, mask);
    return cv::countNonZero(mask) > 100;
  };
  const cv::Mat all = drawResult(greyImage(), camera(), models, result);
  EXPECT_TRUE(shows(all, decisionColour(Decision::kAccepted)));
  EXPECT_TRUE(shows(all, decisionColour(Decision::kAmbiguous)));
  EXPECT_FALSE(shows(all, decisionColour(Decision::kRejected)));
  EXPECT_TRUE(
      shows(drawResult(greyImage(), camera(), models, result, true), decisionColour(Decision::kRejected)));

  const std::vector<cv::Mat> single = drawBackProjections(greyImage(), camera(), models, result);
  ASSERT_EQ(single.size(), 2u);
  EXPECT_TRUE(shows(single[0], decisionColour(Decision::kAccepted)));
  EXPECT_FALSE(shows(single[0], decisionColour(Decision::kAmbiguous)));
  EXPECT_EQ(objectLabel(result.objects[0]), "box 0.93");
  RecognitionResult strange = result;
  strange.objects[0].object = 7;
  EXPECT_THROW(drawResult(greyImage(), camera(), models, strange), BadInput);
}
