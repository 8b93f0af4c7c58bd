// Our scores against two independent programs, on random results for the work cell's dev split.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>

#include "monocular_eye_hand/evaluation/results.h"
#include "monocular_eye_hand/evaluation/scores.h"
#include "small_dataset.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * (double(engine_()) / 4294967296.0); }
  bool chance(double p) { return uniform(0, 1) < p; }
  int below(int n) { return int(uniform(0, n)); }
  Eigen::Vector3d vector() {
    const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

// Truths moved by a little or a lot, some as their symmetric twins, some twice, some as another object; equal
// scores; images without rows.
std::vector<BopResult> randomResults(const BopSplit& split, const BopModels& models, unsigned seed,
                                     ImageTimes* times) {
  Random random(seed);
  std::vector<BopResult> results;
  for (const BopImage& image : split.images) {
    const double seconds = random.uniform(0.1, 2);
    if (random.chance(0.8)) (*times)[{image.scene, image.id}] = seconds;
    if (random.chance(0.1)) continue;
    for (const GroundTruth& truth : image.truth)
      for (int copy = 0; copy < 3 && random.chance(copy == 0 ? 0.9 : 0.3); ++copy) {
        const BopModel& model = models.at(truth.object);
        BopResult row;
        row.scene = image.scene;
        row.image = image.id;
        row.object = truth.object;
        row.score = random.below(20) / 20.0;
        row.time = seconds;

        const double size = std::exp(random.uniform(std::log(1e-3), std::log(0.3)));
        Rigid3 pose = truth.camera_from_object;
        if (!model.symmetries.discrete.empty() && random.chance(0.5))
          pose =
              pose * model.symmetries.discrete[size_t(random.below(int(model.symmetries.discrete.size())))];
        if (!model.symmetries.continuous.empty())
          pose.rotation *= expSO3(model.symmetries.continuous[0].direction * random.uniform(-3, 3));
        pose.rotation = nearestRotation(expSO3(random.vector() * size) * pose.rotation);
        pose.translation += random.vector() * size * 0.3;
        if (random.chance(0.05)) pose.translation += random.vector() * 0.5;

        row.camera_from_object = pose;
        if (random.chance(0.15)) row.object = 1 + random.below(int(models.size()));
        results.push_back(row);
      }
  }
  return results;
}

class Reference : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("MONOCULAR_EYE_HAND_DATA");
    if (!data) GTEST_SKIP() << "MONOCULAR_EYE_HAND_DATA is not set: no data set to compare on";
    tools_ = fs::path(data) / ".." / "tools";
    dataset_ = (fs::path(data) / "workcell").string();
    for (const fs::path& needed :
         {tools_ / "summary.py", tools_ / "eval_pose.py", fs::path(dataset_) / "dev"})
      if (!fs::exists(needed)) GTEST_SKIP() << needed << " does not exist";
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0)
      GTEST_SKIP() << "/usr/bin/python3 has no numpy";
    split_ = loadBopSplit(dataset_, "dev");
    models_ = loadBopModels(dataset_ + "/models");
  }

  // Writes random results, keeps what the file says.
  void makeResults(unsigned seed) {
    ImageTimes times;
    writeBopResults(csv(), randomResults(split_, models_, seed, &times));
    writeImageTimes(imageTimesPath(csv()), times);
    results_ = readBopResults(csv());
    times_ = readImageTimes(imageTimesPath(csv()));
    ASSERT_GT(results_.size(), 100u);
  }

  std::string csv() const { return folder_.path("r.csv"); }

  std::string python(const std::string& arguments) {
    const std::string command = "PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 " + arguments;
    FILE* pipe = popen(command.c_str(), "r");
    std::string output;
    std::array<char, 4096> buffer;
    for (size_t n; pipe && (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      output.append(buffer.data(), n);
    EXPECT_EQ(pipe ? pclose(pipe) : -1, 0) << command << "\n" << output;
    return output;
  }

  void compareBopScores(const std::string& target_arguments, const std::vector<BopTarget>& targets) {
    const std::string json_path = folder_.path("scores.json");
    python((tools_ / "eval_pose.py").string() + " --quiet --dataset " + dataset_ +
           " --split dev --models models" + target_arguments + " --results " + csv() + " --json " +
           json_path);
    const nlohmann::json theirs = nlohmann::json::parse(std::ifstream(json_path));
    const BopScores ours = scoreBop(split_, models_, results_, targets);
    const std::pair<const char*, double> values[] = {{"AR_MSSD", ours.ar_mssd},
                                                     {"AR_MSPD", ours.ar_mspd},
                                                     {"AR_2", ours.ar()},
                                                     {"mAP_MSSD", ours.map_mssd},
                                                     {"mAP_MSPD", ours.map_mspd},
                                                     {"mAP_MSSD_strict", ours.map_mssd_strict},
                                                     {"mAP", ours.map()},
                                                     {"mAP_MSPD_strict", ours.map_mspd_strict},
                                                     {"mAP_strict", ours.mapStrict()}};
    for (const auto& [name, value] : values) {
      EXPECT_NEAR(value, theirs.at(name).get<double>(), 1e-6) << name;
      EXPECT_GT(value, 0.05) << name << ": results this poor compare nothing";
      EXPECT_LT(value, 0.95) << name << ": results this good compare nothing";
    }

    EXPECT_EQ(ours.images, theirs.at("n_images").get<int>());
    EXPECT_EQ(ours.targets, theirs.at("n_targets").get<int>());
    EXPECT_EQ(ours.estimates, theirs.at("n_estimates").get<int>());
  }

  fs::path tools_;
  std::string dataset_;
  TempFolder folder_;
  BopSplit split_;
  BopModels models_;
  std::vector<BopResult> results_;
  ImageTimes times_;
};

TEST_F(Reference, BopScoresOfVisibleTargets) {
  makeResults(1);
  compareBopScores("", {});
}

TEST_F(Reference, BopScoresOfATargetList) {
  makeResults(2);
  compareBopScores(" --targets dev_targets_bop19.json", loadBopTargets(dataset_ + "/dev_targets_bop19.json"));
}

TEST_F(Reference, SummaryPerScene) {
  makeResults(3);
  const std::string program = (tools_ / "summary.py").string();
  const std::string arguments = dataset_ + " dev " + csv();
  const auto scenes = summarize(split_, models_, results_, times_);
  std::string printed;
  for (const SceneSummary& scene : scenes) printed += summaryLine(scene) + "\n";
  EXPECT_EQ(python(program + " " + arguments), printed + summaryFigure(scenes) + "\n");

  // The same program, printing all digits.
  const std::string precise =
      "-c 'import sys; p = sys.argv[1]; sys.argv = sys.argv[1:]; s = open(p).read(); "
      "exec(compile(s.replace(\":.3f\", \":.17g\"), p, \"exec\"), {\"__name__\": \"__main__\", \"__file__\": "
      "p})' ";
  std::istringstream lines(python(precise + program + " " + arguments));
  for (const SceneSummary& scene : scenes) {
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    double found = 0, right = 0, ar = 0, time = 0;
    ASSERT_EQ(
        std::sscanf(line.c_str(), "scene %*d: found %lf (%*d/%*d) right %lf (%*d/%*d) AR %lf median %lf s",
                    &found, &right, &ar, &time),
        4)
        << line;
    EXPECT_NEAR(scene.foundShare(), found, 1e-6);
    EXPECT_NEAR(scene.rightShare(), right, 1e-6);
    EXPECT_NEAR(scene.ar, ar, 1e-6);
    EXPECT_NEAR(scene.median_time, time, 1e-6);
    EXPECT_GT(scene.found, 0);
    EXPECT_LT(scene.found, scene.wanted);
  }
}

}  // namespace
}  // namespace monocular_eye_hand
