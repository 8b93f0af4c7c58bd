#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/rigid3.h"
#include "tool_world.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;
using testing::Not;

class Recognize : public ToolWorld {
 protected:
  ProgramResult recognize(const std::string& arguments) const {
    return run(RECOGNIZE_PROGRAM, "--objects objects.yaml --camera camera.yaml " + arguments);
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(readText(path(name))); }
};

// The bridge looks the same after half a turn about its z axis.
double poseError(const nlohmann::json& pose, const Rigid3& truth) {
  const std::vector<double> t = pose["translation"], q = pose["quaternion"];
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(q.at(3), q.at(0), q.at(1), q.at(2)).matrix();
  const Eigen::Matrix3d half_turn = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  const double angle =
      std::min(angleBetween(rotation, truth.rotation), angleBetween(rotation, truth.rotation * half_turn));
  return angle + (Eigen::Vector3d(t.at(0), t.at(1), t.at(2)) - truth.translation).norm();
}

TEST_F(Recognize, PoseInTableJsonAndPictures) {
  const Rigid3 truth = renderBridge("scene.png", 0.6);
  const ProgramResult result = recognize("--json r.json --overlay o.png --explain page scene.png");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("scene.png: 1 object in "));
  EXPECT_THAT(result.out, HasSubstr("bridge"));
  EXPECT_THAT(result.out, HasSubstr("accepted"));

  const nlohmann::json document = json("r.json");
  EXPECT_EQ(document["format"], "monocular_eye_hand recognition 1");
  const nlohmann::json image = document["images"].at(0);
  ASSERT_EQ(image["objects"].size(), 1u) << result.out;
  const nlohmann::json object = image["objects"][0];
  EXPECT_EQ(object["name"], "bridge");
  EXPECT_EQ(object["decision"], "accepted");
  EXPECT_LT(poseError(object["pose"], truth), 0.03);
  ASSERT_EQ(object["covariance"].size(), 36u);
  for (int i = 0; i < 6; ++i) EXPECT_GT(object["covariance"][size_t(7 * i)].get<double>(), 0);
  EXPECT_GT(object["probability"].get<double>(), 0.5);
  EXPECT_FALSE(image["stages"].empty());
  EXPECT_FALSE(image["truncated"].get<bool>());

  EXPECT_FALSE(cv::imread(path("o.png")).empty());
  EXPECT_THAT(readText(path("page/index.html")), HasSubstr("scene.png"));
}

TEST_F(Recognize, NothingFoundIsNoFailureAndHasAReason) {
  save("blank.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(120)));
  const ProgramResult result = recognize("--json - blank.png");
  EXPECT_EQ(result.code, 0) << result.err;
  const nlohmann::json image = nlohmann::json::parse(result.out)["images"].at(0);
  EXPECT_TRUE(image["objects"].empty());
  EXPECT_FALSE(image["reason"].get<std::string>().empty());
  EXPECT_THAT(recognize("blank.png").out, HasSubstr("nothing found: "));
}

TEST_F(Recognize, ABadImageIsNamedAndTheOthersAreProcessed) {
  renderBridge("in/img_2.png", 0.6);
  std::filesystem::copy_file(path("in/img_2.png"), path("in/img_10.png"));
  std::filesystem::resize_file(path("in/img_10.png"), 5000);
  save("in/img_3.png", cv::Mat(100, 100, CV_8UC1, cv::Scalar(120)));
  const ProgramResult result = recognize("--json r.json --overlay o.png in/img_%d.png missing.png");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("in/img_10.png: the file is cut off"));
  EXPECT_THAT(result.err, HasSubstr("missing.png: cannot be read"));
  const nlohmann::json images = json("r.json")["images"];
  ASSERT_EQ(images.size(), 4u);
  EXPECT_EQ(images[0]["image"], "in/img_2.png");
  EXPECT_EQ(images[0]["objects"].size(), 1u);
  EXPECT_TRUE(images[1].contains("error")) << "100 x 100 pixels with a camera of 640 x 480";
  EXPECT_TRUE(images[2].contains("error"));
  EXPECT_TRUE(images[3].contains("error"));
  EXPECT_TRUE(std::filesystem::exists(path("o_img_2.png")));
  EXPECT_FALSE(std::filesystem::exists(path("o_img_10.png")));
}

TEST_F(Recognize, SameImageAndWorkBudgetSameAnswer) {
  renderBridge("scene.png", 1.1);
  const auto answer = [&](const std::string& arguments) {
    EXPECT_EQ(recognize(arguments + " --json r.json scene.png").code, 0);
    return json("r.json")["images"][0]["objects"].dump();
  };
  EXPECT_EQ(answer("--budget 20000"), answer("--budget 20000"));
  EXPECT_EQ(answer("--only bridge"), answer("--only bridge"));
}

TEST_F(Recognize, BadInputIsTold) {
  save("blank.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(120)));
  const auto refusal = [&](const std::string& arguments) {
    const ProgramResult result = run(RECOGNIZE_PROGRAM, arguments);
    EXPECT_EQ(result.code, 1) << arguments;
    return result.err;
  };
  const std::string base = "--objects objects.yaml --camera camera.yaml ";
  EXPECT_THAT(refusal("--camera camera.yaml blank.png"), HasSubstr("--objects FILE is missing"));
  EXPECT_THAT(refusal("--objects objects.yaml blank.png"), HasSubstr("--camera FILE.yaml is missing"));
  EXPECT_THAT(refusal(base), HasSubstr("no image given"));
  EXPECT_THAT(refusal("--objects none.yaml --camera camera.yaml blank.png"), HasSubstr("none.yaml"));
  EXPECT_THAT(refusal("--objects objects.yaml --camera none.yaml blank.png"), HasSubstr("none.yaml"));

  const std::string unknown = refusal(base + "--only brigde blank.png");
  EXPECT_THAT(unknown, HasSubstr("brigde"));
  EXPECT_THAT(unknown, HasSubstr("bridge, bracket"));
  EXPECT_THAT(refusal(base + "--set features.smoothing=1 blank.png"),
              HasSubstr("'features.smoothing_sigma'?"));
  EXPECT_THAT(refusal(base + "--time-limit -1 blank.png"), HasSubstr("--time-limit"));
  for (const char* seconds : {"-1", "2", "1.5"})
    EXPECT_THAT(refusal(base + "--budget " + seconds + " blank.png"), HasSubstr("--time-limit")) << seconds;

  EXPECT_THAT(refusal(base + "--work 500 blank.png"), HasSubstr("--budget"));
  EXPECT_THAT(refusal(base + "--no-such-option blank.png"), HasSubstr("--no-such-option"));
  write("options.yaml", "budget: many\n");
  EXPECT_THAT(refusal(base + "--options options.yaml blank.png"), HasSubstr("'budget' is 'many'"));
}

// The image behind a setting is an image, wherever both stand.
TEST_F(Recognize, ASettingTakesOneWord) {
  save("blank.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(120)));
  save("other.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)));
  for (const char* arguments : {"--set budget=50 blank.png", "blank.png --set budget=50",
                                "--set budget=50 --set grouping.max_per_kind=9 blank.png",
                                "--set budget=50 blank.png --set grouping.max_per_kind=9"}) {
    const ProgramResult result = recognize(arguments);
    EXPECT_EQ(result.code, 0) << arguments << ": " << result.err;
    EXPECT_THAT(result.out, HasSubstr("blank.png: ")) << arguments;
  }
  const ProgramResult two = recognize("--set budget=50 blank.png other.png");
  EXPECT_EQ(two.code, 0) << two.err;
  EXPECT_THAT(two.out, HasSubstr("other.png: "));
}

TEST_F(Recognize, ResultsGoIntoNewFolders) {
  save("blank.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(120)));
  const ProgramResult result =
      recognize("--overlay page/overlay.png --explain page --json deep/er/r.json blank.png");
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* file : {"page/overlay.png", "page/index.html", "deep/er/r.json"})
    EXPECT_TRUE(std::filesystem::exists(path(file))) << file;
  const ProgramResult none = recognize("--overlay blank.png/overlay.png blank.png");
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("blank.png/overlay.png: "));
}

TEST_F(Recognize, ShowsTheOptionsItWouldUse) {
  write("options.yaml", "recognition:\n  max_distance: 3.25\n");
  const ProgramResult result = run(
      RECOGNIZE_PROGRAM, "--options options.yaml --set grouping.max_per_kind=77 --budget 500 --show-options");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("max_distance: 3.25\n"));
  EXPECT_THAT(result.out, HasSubstr("  max_per_kind: 77\n"));
  EXPECT_THAT(result.out, HasSubstr("\nbudget: 500\n"));
  // What it prints is a file that it reads.
  write("again.yaml", result.out);
  EXPECT_EQ(run(RECOGNIZE_PROGRAM, "--options again.yaml --show-options").out, result.out);
}

TEST_F(Recognize, TheShippedParametersAreTheDefaults) {
  const std::string shipped = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/recognizer.yaml";
  const ProgramResult result = run(RECOGNIZE_PROGRAM, "--options '" + shipped + "' --show-options");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, run(RECOGNIZE_PROGRAM, "--show-options").out);
}

}  // namespace
}  // namespace monocular_eye_hand
