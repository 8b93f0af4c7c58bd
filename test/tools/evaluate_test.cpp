#include <gmock/gmock.h>

#include <cmath>
#include <iomanip>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/results.h"
#include "monocular_eye_hand/evaluation/scores.h"
#include "tool_world.h"

namespace monocular_eye_hand {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Evaluate : public ToolWorld {
 protected:
  // Scene 1: a bridge from two sides; scene 4: nothing.
  Evaluate() {
    const std::string models = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/models/";
    std::filesystem::create_directories(folder_ / "set/models");
    std::filesystem::copy_file(models + "bridge.ply", path("set/models/obj_000001.ply"));
    std::filesystem::copy_file(models + "bracket.ply", path("set/models/obj_000003.ply"));
    write("set/models/models_info.json",
          R"({"1": {"name": "bridge", "diameter": 140,
   "symmetries_discrete": [[-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]]}, "3": {"diameter": 120}})");
    const std::string k = R"({"cam_K": [700, 0, 319.5, 0, 700, 239.5, 0, 0, 1], "depth_scale": 1})";
    const Rigid3 first = renderBridge("set/dev/000001/gray/000000.png", 0.6);
    const Rigid3 second = renderBridge("set/dev/000001/gray/000001.png", 1.1);
    write("set/dev/000001/scene_camera.json", "{\"0\": " + k + ", \"1\": " + k + "}");
    write("set/dev/000001/scene_gt.json",
          "{\"0\": [" + truthJson(first) + "], \"1\": [" + truthJson(second) + "]}");
    save("set/dev/000004/gray/000000.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(120)));
    write("set/dev/000004/scene_camera.json", "{\"0\": " + k + "}");
    write("set/dev/000004/scene_gt.json", "{\"0\": []}");
  }

  static std::string truthJson(const Rigid3& pose) {
    std::ostringstream out;
    out << std::setprecision(17) << R"({"obj_id": 1, "cam_R_m2c": [)";
    for (int i = 0; i < 9; ++i) out << (i ? ", " : "") << pose.rotation(i / 3, i % 3);
    const Eigen::Vector3d t = pose.translation * 1e3;
    out << R"(], "cam_t_m2c": [)" << t.x() << ", " << t.y() << ", " << t.z() << "]}";
    return out.str();
  }

  ProgramResult evaluate(const std::string& arguments) const {
    return run(EVALUATE_PROGRAM, "--dataset set --split dev --out r.csv " + arguments);
  }
};

TEST_F(Evaluate, ResultsTimesAndTheScoresOfWhatItWrote) {
  const ProgramResult result = evaluate("");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = readBopResults(path("r.csv"));
  const ImageTimes times = readImageTimes(path("r.times.csv"));
  EXPECT_EQ(times.size(), 3u) << "an image without a row has a time too";
  for (const BopResult& row : rows) {
    EXPECT_EQ(row.time, times.at({row.scene, row.image}));
    EXPECT_THAT(row.score, AllOf(testing::Gt(0), testing::Le(1)));
  }
  const BopSplit split = loadBopSplit(path("set"), "dev");
  const BopModels models = loadBopModels(path("set/models"));
  const auto summaries = summarize(split, models, rows, times);
  for (const SceneSummary& summary : summaries) EXPECT_THAT(result.out, HasSubstr(summaryLine(summary)));
  EXPECT_EQ(summaries[0].found, 2) << result.out;

  char ar[50];
  std::snprintf(ar, sizeof ar, "AR_MSPD %.6f", scoreBop(split, models, rows).ar_mspd);
  EXPECT_THAT(result.out, HasSubstr(ar));
  EXPECT_THAT(result.err, HasSubstr("[3/3] scene 4 image 0"));
}

TEST_F(Evaluate, AllAddsTheRejectedAndDumpTellsOfEveryCandidate) {
  ASSERT_EQ(evaluate("--scenes 1 --images 0").code, 0);
  const size_t published = readBopResults(path("r.csv")).size();
  ASSERT_EQ(evaluate("--scenes 1 --images 0 --all --dump d.csv").code, 0);
  const size_t all = readBopResults(path("r.csv")).size();
  EXPECT_GE(all, published);
  std::istringstream dump(readText(path("d.csv")));
  std::string header, line;
  std::getline(dump, header);
  EXPECT_THAT(header,
              testing::StartsWith("scene_id,im_id,obj_id,name,decision,probability,plausibility,reliability,"
                                  "gt_id,mspd_px,mssd_d,visib,"));

  const auto columns = std::count(header.begin(), header.end(), ',');
  EXPECT_THAT(header, HasSubstr(",candidate,fate,suppressed_by,conflicts,kind,rank_score,contests,r11,"));
  size_t chosen = 0;
  bool near = false;
  for (size_t lines = 0; std::getline(dump, line); ++lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
    EXPECT_THAT(line, HasSubstr("," + std::to_string(lines) + ","));
    chosen += line.find(",suppressed,") == std::string::npos;
    double mspd = 0;
    if (std::sscanf(line.c_str(), "1,0,1,bridge,%*[a-z],%*f,%*f,%*f,0,%lf", &mspd) == 1) near |= mspd < 3;
  }

  EXPECT_EQ(chosen, all);
  EXPECT_TRUE(near) << readText(path("d.csv"));
}

TEST_F(Evaluate, RestrictedToScenesImagesAndTargets) {
  EXPECT_THAT(evaluate("--scenes 4").out, AllOf(HasSubstr("scene 4:"), testing::Not(HasSubstr("scene 1:"))));
  EXPECT_EQ(readImageTimes(path("r.times.csv")).size(), 1u);
  write("set/t.json", R"([{"scene_id": 1, "im_id": 1, "obj_id": 1, "inst_count": 1}])");
  EXPECT_THAT(evaluate("--targets t.json").out, HasSubstr("BOP, 1 images, 1 targets"));
  EXPECT_EQ(readImageTimes(path("r.times.csv")).size(), 1u);
}

TEST_F(Evaluate, ThroughALensAndEnlargedThePosesStay) {
  const ProgramResult result =
      evaluate("--scenes 1 --images 0 --warp -0.28,0.08,0.001,-0.0005,0 --scale 1.5");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("found 1.000 (1/1)"));
}

TEST_F(Evaluate, ReportComparisonAndMissesArePages) {
  write("other.csv", "scene_id,im_id,obj_id,score,R,t,time\n");
  const ProgramResult result =
      evaluate("--scenes 1,4 --images 0 --report pages --compare other.csv --misses why --cases 3");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("report: pages/index.html"), HasSubstr("misses: why/index.html")));
  const std::string report = readText(path("pages/index.html")), misses = readText(path("why/index.html"));
  EXPECT_THAT(report, HasSubstr("Evaluation of set dev"));
  EXPECT_THAT(report, HasSubstr("<td>scene 1</td><td>1</td><td>100 % (1/1)</td>"));
  EXPECT_THAT(report, HasSubstr("<td>scene 4</td><td>1</td>")) << "without a part there is nothing to find";
  EXPECT_THAT(report, HasSubstr("<td>this run</td>")) << "the other run has found nothing";
  EXPECT_THAT(misses, HasSubstr("0 wanted instances"));
}

TEST_F(Evaluate, MissesSayHowNearTheSearchCameUnlessPosesWereGiven) {
  const std::string strict = "--scenes 1 --images 0 --misses why --set accept_probability=0.999999 ";
  ASSERT_EQ(evaluate(strict + "--dump d.csv").code, 0);
  EXPECT_THAT(readText(path("why/index.html")), HasSubstr("In the search: groupings of its own "));
  ASSERT_EQ(evaluate(strict + "--proposals d.csv").code, 0);
  EXPECT_THAT(readText(path("why/index.html")),
              AllOf(HasSubstr("rejected"), testing::Not(HasSubstr("In the search"))));
}

TEST_F(Evaluate, BadInputIsToldBeforeTheWork) {
  const auto refusal = [&](const std::string& arguments) {
    const ProgramResult result = run(EVALUATE_PROGRAM, arguments);
    EXPECT_EQ(result.code, 1) << arguments;
    return result.err;
  };

  EXPECT_THAT(refusal("--dataset none --split dev --out r.csv"), HasSubstr("none"));
  EXPECT_THAT(refusal("--dataset set --split test --out r.csv"), HasSubstr("test: no such folder"));
  EXPECT_THAT(refusal("--dataset set --split dev --out no/where/r.csv"),
              HasSubstr("r.csv: cannot be written"));
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --scenes 9"), HasSubstr("no scene 9"));
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --scale 0"), HasSubstr("--scale"));
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --report p --cases -1"),
              HasSubstr("cases = -1"));
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --report p --misses p/."),
              HasSubstr("--misses"));
  write("no.csv", "1,2\n");
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --compare no.csv"), HasSubstr("--report"));
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --report p --compare no.csv"),
              HasSubstr("no.csv:1:"));
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --set min_distence=1"),
              HasSubstr("'min_distance'?"));
  EXPECT_THAT(refusal("--dataset set --split dev --out r.csv --models set"), HasSubstr("models_info.json"));
}

}  // namespace
}  // namespace monocular_eye_hand
