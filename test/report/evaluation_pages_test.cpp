#include "monocular_eye_hand/report/evaluation_pages.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <sstream>

#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "support/camera.h"
#include "support/read_file.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

Mesh boxMesh() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? 0.06 : -0.06, i & 2 ? 0.02 : -0.02, i & 4 ? 0.05 : 0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Rigid3 pose(double x) { return {expSO3({1.9, 0.25, -0.3}), {x, 0.02, 0.5}}; }

// What is wrong with the nesting of the tags; "" = nothing.
std::string nestingFault(const std::string& html) {
  const std::regex tag("<(/?)([a-zA-Z0-9]+)([^<>]*)>");
  std::vector<std::string> open;
  for (std::sregex_iterator it(html.begin(), html.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2], rest = (*it)[3];
    if (name == "meta" || name == "img" || (!rest.empty() && rest.back() == '/')) continue;
    if ((*it)[1].length() == 0) {
      open.push_back(name);
      continue;
    }
    if (open.empty() || open.back() != name)
      return "</" + name + "> closes " + (open.empty() ? "" : open.back());
    open.pop_back();
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

// Two images of a box; the first one's is found, the second one's is missed: its candidate was rejected, and
// a pose on nothing was reported.
class EvaluationPages : public testing::Test {
 protected:
  EvaluationPages() {
    folder_ = (fs::path(testing::TempDir()) /
               (std::string("pages_") + testing::UnitTest::GetInstance()->current_test_info()->name()))
                  .string();
    fs::remove_all(folder_);
    BopModel model;
    model.id = 4;
    model.name = "<b>\"box\" & co</b>";
    model.vertices = boxMesh().vertices;
    model.diameter = 0.14;
    models_[4] = model;
    known_.objects.push_back({buildModel("box", boxMesh()), {}});
    split_.width = 640;

    for (int id = 0; id < 2; ++id) {
      BopImage image;
      image.scene = 1;
      image.id = id;
      image.intrinsics << 700, 0, 319.5, 0, 700, 239.5, 0, 0, 1;
      image.truth.push_back({4, pose(0), 1.0});
      split_.images.push_back(image);
    }

    results_ = {{1, 0, 4, 0.9, pose(0), 0.5}, {1, 1, 4, 0.7, pose(0.15), 0.5}};
    judged_ = {judged(0, 0.9, pose(0), JudgedPose::kReported),
               judged(1, 0.7, pose(0.15), JudgedPose::kReported),
               judged(1, 0.3, pose(0.002), JudgedPose::kRejected)};
  }
  ~EvaluationPages() override { fs::remove_all(folder_); }

  static JudgedPose judged(int image, double probability, const Rigid3& at, JudgedPose::Fate fate) {
    JudgedPose made;
    made.scene = 1;
    made.image = image;
    made.object = 4;
    made.probability = probability;
    made.camera_from_object = at;
    made.fate = fate;
    made.against = fate == JudgedPose::kRejected ? "edges <run> on 0.3 (usually 0)" : "";
    made.strongest_against = fate == JudgedPose::kRejected ? "edges <run> on" : "";
    made.evidence = {{"edge <support>", 0.875}};
    return made;
  }
  EvaluatedRun run() const {
    return {"Evaluation of <nothing>",
            {"2 images & more"},
            split_,
            models_,
            known_,
            judgeRun(split_, models_, results_),
            {{{1, 0}, 0.25}, {{1, 1}, 0.75}},
            measured(judged_, split_, models_),
            traced_,
            {},
            load_};
  }
  static CameraImage image() {
    return {cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)), centredCamera(640, 480, 700)};
  }
  // Every file that the page names exists and lies beside it.
  std::vector<std::string> pictures(const std::string& html) const {
    std::vector<std::string> files;
    const std::regex source("<img src=\"([^\"]+)\"");
    for (std::sregex_iterator it(html.begin(), html.end(), source), end; it != end; ++it) {
      files.push_back((*it)[1]);
      EXPECT_TRUE(fs::exists(fs::path(folder_) / files.back())) << files.back();
    }
    return files;
  }

  std::string folder_;
  BopModels models_;
  BopSplit split_;
  ModelBase known_;
  std::vector<BopResult> results_;
  std::vector<JudgedPose> judged_;
  std::vector<TracedTruth> traced_;
  std::function<CameraImage(const BopImage&)> load_ = [](const BopImage&) { return image(); };
};

TEST_F(EvaluationPages, TheReportIsWellFormedAndShowsEverything) {
  const std::string html = readFile(writeEvaluationPage(folder_, run()));
  EXPECT_EQ(nestingFault(html), "");
  EXPECT_THAT(pictures(html), testing::ElementsAre("missed_0.jpg", "wrong_0.jpg"));
  for (const char* text : {"50 % (1/2)", "9\u201391 %", "0.50 s", "by visible share", "by size in the image",
                           "by distance", "Share right over probability", "Precision over recall",
                           "was rejected (p 0.30)", "on clutter", "0.875"})
    EXPECT_THAT(html, HasSubstr(text));
  const cv::Mat picture = cv::imread((fs::path(folder_) / "missed_0.jpg").string());
  EXPECT_EQ(picture.size(), cv::Size(960, 360));
}

TEST_F(EvaluationPages, EveryTextIsEscapedAndNothingIsFetched) {
  std::optional<OtherRun> other = OtherRun{"<i>other</i>.csv", judgeRun(split_, models_, {}), {}};
  writeMissesPage(folder_ + "/misses", run());
  for (const std::string& path :
       {writeEvaluationPage(folder_, run(), other), folder_ + "/misses/index.html"}) {
    const std::string html = readFile(path);
    EXPECT_EQ(nestingFault(html), "") << path;
    EXPECT_THAT(html, HasSubstr("&lt;b&gt;&quot;box&quot; &amp; co&lt;/b&gt;"));
    EXPECT_THAT(html, HasSubstr("edges &lt;run&gt; on"));
    for (const char* raw :
         {"<b>", "<i>", "<run>", "<support>", "<nothing>", "<script", "src=\"http", "href=\"http"})
      EXPECT_THAT(html, Not(HasSubstr(raw))) << path;
  }
}

TEST_F(EvaluationPages, AComparisonListsWhatChanged) {
  std::optional<OtherRun> other =
      OtherRun{"other.csv", judgeRun(split_, models_, {{1, 1, 4, 0.9, pose(0), 0.5}}), {}};
  const std::string html = readFile(writeEvaluationPage(folder_, run(), other));
  EXPECT_THAT(html, HasSubstr("This run against other.csv"));
  EXPECT_THAT(html, HasSubstr("<td>this run</td><td>0.0 px</td><td>none</td>"));
  EXPECT_THAT(html, HasSubstr("<td>the other</td>"));
  EXPECT_THAT(html, HasSubstr("<td>1.000</td>")) << "one each: no difference";
}

TEST_F(EvaluationPages, TheMissesBeginWithTheCauses) {
  const std::string html = readFile(writeMissesPage(folder_, run()));
  EXPECT_EQ(nestingFault(html), "");
  EXPECT_THAT(html, HasSubstr("<td>1</td><td>100 %</td><td>rejected: edges &lt;run&gt; on</td>"));
  EXPECT_THAT(html, HasSubstr("<td>1</td><td>100 %</td><td>on clutter</td>"));
  EXPECT_EQ(pictures(html).size(), 2u);
}

TEST_F(EvaluationPages, AMissedObjectSaysHowNearTheSearchCame) {
  judged_.clear();
  TracedTruth traced;
  traced.scene = 1;
  traced.image = 1;
  traced.groupings = 7;
  traced.generated = 12;
  traced.taken = 14;
  traced.aligned = 3;
  traced_ = {traced};
  const std::string html = readFile(writeMissesPage(folder_, run()));
  EXPECT_EQ(nestingFault(html), "");
  EXPECT_THAT(html, HasSubstr("<td>aligned, not verified</td>"));
  EXPECT_THAT(html,
              HasSubstr("groupings of its own 7; nearest generated 12.0 px, taken 14.0 px, aligned 3.0 px, "
                        "verified none, recorded none."));
}

TEST_F(EvaluationPages, AnObjectBeyondALimitIsToldAsSuch) {
  EvaluatedRun limited = run();
  limited.limits.min_distance = 0.6;
  EXPECT_THAT(readFile(writeMissesPage(folder_, limited)),
              HasSubstr("nearer than min_distance: 0.492 m of 0.6 m"));
  // The box is moved until its middle lies on the image's border.
  split_.images[1].truth[0].camera_from_object = pose(0.23);
  EvaluatedRun half = run();
  half.limits.min_in_frame = 0.8;
  EXPECT_THAT(readFile(writeMissesPage(folder_, half)), HasSubstr("less in the frame than min_in_frame"));
}

TEST_F(EvaluationPages, AMissingPictureIsTold) {
  load_ = [](const BopImage& image) -> CameraImage {
    throw BadInput("image " + std::to_string(image.id) + ": no image file");
  };
  const std::string html = readFile(writeEvaluationPage(folder_, run()));
  EXPECT_EQ(nestingFault(html), "");
  EXPECT_THAT(html, HasSubstr("No picture: image 1: no image file"));
  EXPECT_TRUE(pictures(html).empty());
}

TEST_F(EvaluationPages, TheNumberOfPicturesIsLimited) {
  EvaluationPageOptions options;
  options.cases = 0;
  const std::string html = readFile(writeEvaluationPage(folder_, run(), {}, options));
  EXPECT_TRUE(pictures(html).empty());
  EXPECT_THAT(html, HasSubstr("1 wanted instances were missed; the first 0 are shown"));
  options.cases = -1;
  EXPECT_THROW(writeEvaluationPage(folder_, run(), {}, options), BadInput);
  EXPECT_THROW(writeEvaluationPage("/proc/not_writable", run()), BadInput);
  EXPECT_THROW(writeMissesPage("/proc/not_writable", run()), BadInput);
}

TEST_F(EvaluationPages, ARunThatFoundNothing) {
  results_.clear();
  judged_.clear();
  const std::string html = readFile(writeEvaluationPage(folder_, run()));
  EXPECT_EQ(nestingFault(html), "");
  EXPECT_THAT(html, HasSubstr("No candidate was judged."));
  EXPECT_THAT(html, HasSubstr("No candidate of it was judged."));
}

TEST_F(EvaluationPages, ThroughALensTheContoursLieWhereTheLensShowsThem) {
  load_ = [](const BopImage&) {
    CameraImage seen = image();
    const double k[] = {-0.28, 0.08, 0, 0};
    setDistortion(&seen.camera, "plumb_bob", k, 4);
    return seen;
  };
  EXPECT_EQ(pictures(readFile(writeEvaluationPage(folder_, run()))).size(), 2u);
}

}  // namespace
}  // namespace monocular_eye_hand
