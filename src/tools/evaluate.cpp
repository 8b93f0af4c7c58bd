#include <fmt/format.h>

// Runs the recogniser over a data set of the BOP format, writes BOP results and prints the scores.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <opencv2/core.hpp>
#include <optional>
#include <set>

#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/evaluation/lens.h"
#include "monocular_eye_hand/evaluation/results.h"
#include "monocular_eye_hand/evaluation/scores.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/recognition/recognizer.h"
#include "monocular_eye_hand/report/evaluation_pages.h"
#include "tools/candidate_dump.h"
#include "tools/judged_poses.h"
#include "tools/support.h"
#include "tools/traced_truths.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string dataset, split, models, targets, options, decision, out, dump, proposals, report, misses,
      compare;
  std::vector<std::string> settings;
  std::vector<int> scenes, images;
  std::vector<double> warp;
  double scale = 1;
  bool all = false, support = false;
  EvaluationPageOptions page;
  bool pages() const { return !report.empty() || !misses.empty(); }
};

// The models of the data set as a model base: objects in the order of their ids.
ModelBase modelBase(const BopModels& models) {
  std::vector<ObjectEntry> entries;
  for (const auto& entry : models) {
    ObjectEntry object;
    object.name = entry.second.name;
    object.mesh = fs::absolute(entry.second.mesh_path).string();
    object.unit = "mm";
    entries.push_back(object);
  }
  return compileModels(entries, ModelDepth::kViews);
}

std::vector<int> objectIds(const BopModels& models) {
  std::vector<int> ids;
  for (const auto& entry : models) ids.push_back(entry.first);
  return ids;
}

// Turns the images of a data set into what the recogniser is to see.
class ImageSource {
 public:
  explicit ImageSource(const Arguments& args) : args_(args) {}
  CameraImage load(const BopImage& image) {
    CameraImage input;
    input.grey = loadBopImage(image);
    input.camera = bopCamera(image, input.grey.cols, input.grey.rows);
    if (!args_.warp.empty()) {
      setDistortion(&input.camera, "plumb_bob", args_.warp.data(), args_.warp.size());
      input.grey = warp_.apply(input.grey, input.camera);
    }
    return args_.scale == 1 ? input : resized(input, args_.scale);
  }

 private:
  const Arguments& args_;
  LensWarp warp_;
};

struct Run {
  std::vector<BopResult> results;
  std::vector<BopResult> reported;  // without the rejected ones that --all adds
  std::vector<JudgedPose> judged;   // for the pages
  std::vector<TracedTruth> traced;  // for the misses
  ImageTimes times;
};

// What the node would publish of one image, as BOP results: one row per object, by its best pose.
void addRows(const std::vector<ObjectEstimate>& objects, const std::vector<int>& ids, const BopImage& image,
             double seconds, std::vector<BopResult>* rows) {
  for (const ObjectEstimate& object : objects)
    rows->push_back({image.scene, image.id, ids.at(size_t(object.object)), object.probability,
                     object.camera_from_object, seconds});
}

std::vector<PoseProposal> truePoses(const BopImage& image, const std::vector<int>& ids) {
  std::vector<PoseProposal> poses;
  for (const GroundTruth& truth : image.truth) {
    const auto id = std::find(ids.begin(), ids.end(), truth.object);
    if (id != ids.end()) poses.push_back({int(id - ids.begin()), truth.camera_from_object});
  }
  return poses;
}

// The plane z = 0 of the world, as the image's camera sees it.
std::optional<SupportPlane> supportPlane(const Arguments& args, const BopImage& image) {
  if (!args.support) return std::nullopt;
  if (!image.camera_from_world)
    throw BadInput(
        fmt::format("--support: scene {}, image {} has no cam_R_w2c and cam_t_w2c in scene_camera.json",
                    image.scene, image.id));
  SupportPlane plane;
  plane.normal = image.camera_from_world->rotation.col(2).normalized();
  plane.offset = plane.normal.dot(image.camera_from_world->translation);
  return plane;
}

Run recognizeAll(const Arguments& args, const BopSplit& split, const BopModels& models,
                 const Recognizer& recognizer, CandidateDump* dump) {
  const std::vector<int> ids = objectIds(models);
  ImageSource source(args);
  Progress progress(split.images.size());
  RecognitionRequest request;
  request.judged = dump || args.pages();
  const bool truths_proposed = args.proposals == "truth";
  const DumpedPoses dumped =
      args.proposals.empty() || truths_proposed ? DumpedPoses() : DumpedPoses(args.proposals);

  Run run;
  for (const BopImage& image : split.images) {
    if (!args.proposals.empty())
      request.proposals = truths_proposed ? truePoses(image, ids) : dumped.of(image, ids);
    const std::vector<int> truths = args.misses.empty() ? std::vector<int>() : wantedTruths(image, ids);
    request.traced = posesToTrace(image, truths, ids);
    request.support = supportPlane(args, image);

    const CameraImage input = source.load(image);
    const auto start = std::chrono::steady_clock::now();
    const RecognitionResult result = recognizer.recognize(input.grey, input.camera, request);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    run.times[{image.scene, image.id}] = seconds;
    addRows(result.objects, ids, image, seconds, &run.results);
    addRows(result.objects, ids, image, seconds, &run.reported);
    if (args.all) addRows(result.rejected, ids, image, seconds, &run.results);
    if (dump) dump->add(image, result.judged, ids);
    for (JudgedPose& pose : judgedPoses(result, ids, image, int(run.judged.size())))
      run.judged.push_back(std::move(pose));
    for (const TracedTruth& traced : tracedTruths(result.traces, image, truths, args.scale))
      run.traced.push_back(traced);

    progress.step(fmt::format("scene {} image {}: {} objects in {:.3f} s", image.scene, image.id,
                              result.objects.size(), seconds));
  }
  return run;
}

std::vector<BopTarget> loadTargets(const Arguments& args, const BopSplit& split) {
  if (args.targets.empty()) return {};
  const fs::path beside_data = fs::path(args.dataset) / args.targets;
  const auto all = loadBopTargets(fs::exists(beside_data) ? beside_data.string() : args.targets);
  // A run restricted to scenes or images is scored on their targets.
  const bool restricted = !args.scenes.empty() || !args.images.empty();
  std::vector<BopTarget> targets;
  for (const BopTarget& target : all)
    if (!restricted || split.find(target.scene, target.image)) targets.push_back(target);
  if (targets.empty()) throw BadInput(args.targets + ": no target in the chosen scenes and images");
  return targets;
}

// With a target list only its images are looked at, as BOP asks.
void keepImagesOf(const std::vector<BopTarget>& targets, BopSplit* split) {
  if (targets.empty()) return;
  std::set<std::pair<int, int>> keys;
  for (const BopTarget& target : targets) {
    keys.emplace(target.scene, target.image);
    if (!split->find(target.scene, target.image))
      throw BadInput(fmt::format("the targets name scene {}, image {}, which the split does not have",
                                 target.scene, target.image));
  }
  std::vector<BopImage> kept;
  for (BopImage& image : split->images)
    if (keys.count({image.scene, image.id})) kept.push_back(std::move(image));
  split->images = std::move(kept);
}

void printScores(const BopSplit& split, const BopModels& models, const Run& run,
                 const std::vector<BopTarget>& targets) {
  const auto summaries = summarize(split, models, run.results, run.times);
  for (const SceneSummary& summary : summaries) std::cout << summaryLine(summary) << "\n";
  std::cout << summaryFigure(summaries) << "\n";
  const BopScores s = scoreBop(split, models, run.results, targets);
  std::printf("BOP, %d images, %d targets, %d estimates:\n", s.images, s.targets, s.estimates);
  std::printf("  AR  %.6f (AR_MSSD %.6f, AR_MSPD %.6f)\n", s.ar(), s.ar_mssd, s.ar_mspd);
  std::printf("  AP  %.6f (mAP_MSSD %.6f, mAP_MSPD %.6f)\n", s.map(), s.map_mssd, s.map_mspd);
  std::printf(
      "  AP  %.6f (mAP_MSSD %.6f, mAP_MSPD %.6f) with objects absent from an image as false positives\n",
      s.mapStrict(), s.map_mssd_strict, s.map_mspd_strict);
}

std::vector<std::string> notesOf(const Arguments& args, const BopSplit& split) {
  std::string text = fmt::format("{} images of {}, split {}. Recognition with the default options",
                                 split.images.size(), args.dataset, args.split);
  if (!args.options.empty()) text += ", then those of " + args.options;
  for (const std::string& setting : args.settings) text += ", " + setting;
  text += ".";
  if (args.scale != 1) text += fmt::format(" Images resized by {:g}.", args.scale);
  if (!args.warp.empty()) text += " Images seen through a lens (--warp).";
  return {text};
}

void writePages(const Arguments& args, const BopSplit& split, const BopModels& models,
                const Recognizer& recognizer, const Run& run) {
  ImageSource source(args);
  EvaluatedRun evaluated{
      "Evaluation of " + fs::path(args.dataset).lexically_normal().filename().string() + " " + args.split,
      notesOf(args, split),
      split,
      models,
      recognizer.models(),
      judgeRun(split, models, run.reported),
      run.times,
      measured(run.judged, split, models),
      run.traced,
      searchLimits(recognizer.options(), args.scale),
      [&](const BopImage& image) { return source.load(image); }};

  if (!args.report.empty()) {
    std::optional<OtherRun> other;
    if (!args.compare.empty()) {
      const std::vector<BopResult> results = readBopResults(args.compare);
      ImageTimes times;
      if (fs::exists(imageTimesPath(args.compare))) times = readImageTimes(imageTimesPath(args.compare));
      other = OtherRun{args.compare, judgeRun(split, models, results), timesOfImages(split, results, times)};
    }
    std::cout << "report: " << writeEvaluationPage(args.report, evaluated, other, args.page) << "\n";
  }
  if (!args.misses.empty()) std::cout << "misses: " << writeMissesPage(args.misses, evaluated) << "\n";
}

void check(const Arguments& args) {
  if (!(args.scale > 0)) throw BadInput(fmt::format("--scale {:g} must be positive", args.scale));
  if (!args.compare.empty() && args.report.empty())
    throw BadInput("--compare is shown in the report: give --report DIR too");
  const auto folder = [](const std::string& path) { return (fs::path(path) / "").lexically_normal(); };
  if (!args.report.empty() && folder(args.report) == folder(args.misses))
    throw BadInput("--report and --misses need folders of their own");
  if (!args.compare.empty()) readBopResults(args.compare);  // its faults are told before the work
  args.page.check();
}

int evaluate(const Arguments& args) {
  check(args);
  const RecognitionOptions options = recognitionOptions(args.options, args.settings, args.decision);
  const BopModels models = loadBopModels(args.models.empty() ? args.dataset + "/models" : args.models);
  BopSplit split = loadBopSplit(args.dataset, args.split, args.scenes, args.images);
  const std::vector<BopTarget> targets = loadTargets(args, split);
  keepImagesOf(targets, &split);
  writeBopResults(args.out, {});  // a path that cannot be written is told before the work, not after

  const Recognizer recognizer(modelBase(models), options);
  CandidateDump dump(models);
  Run run = recognizeAll(args, split, models, recognizer, args.dump.empty() ? nullptr : &dump);

  writeBopResults(args.out, run.results);
  writeImageTimes(imageTimesPath(args.out), run.times);
  if (!args.dump.empty()) dump.write(args.dump);

  run.results = readBopResults(args.out);  // the scores are those of the file
  run.times = readImageTimes(imageTimesPath(args.out));
  printScores(split, models, run, targets);
  if (args.pages()) writePages(args, split, models, recognizer, run);
  return 0;
}

}  // namespace
}  // namespace monocular_eye_hand

int main(int argc, char** argv) {
  using namespace monocular_eye_hand;
  cv::setNumThreads(1);  // times are those of one thread
  Arguments args;

  CLI::App app(
      "Runs the recogniser over a data set of the BOP format, writes BOP results and prints found, right, "
      "AR and AP.",
      "evaluate");
  app.add_option("--dataset", args.dataset, "folder of the data set")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--split", args.split, "its sub-folder with the scenes, e.g. test")->required();
  app.add_option("--models", args.models, "folder of models_info.json and the meshes [DATASET/models]");
  app.add_option("--targets", args.targets, "BOP'19 target list: only its images are run and scored");

  app.add_option("--scenes", args.scenes, "only these scenes")->delimiter(',');
  app.add_option("--images", args.images, "only these image ids of every scene")->delimiter(',');
  app.add_option("--warp", args.warp,
                 "k1,k2,p1,p2,k3: make the images look as taken through this plumb_bob lens")
      ->delimiter(',')
      ->expected(1, 5);
  app.add_option("--scale", args.scale, "resize images and camera by this factor")->capture_default_str();

  app.add_option("--options", args.options, "YAML of recognition options")->check(CLI::ExistingFile);
  app.add_option("--decision", args.decision, "YAML of the decision's weights, as fit_decision writes it")
      ->check(CLI::ExistingFile);
  app.add_option("--set", args.settings, "one option, KEY=VALUE or GROUP.KEY=VALUE; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);

  app.add_option(
         "--proposals", args.proposals,
         "dump of an earlier run: its poses are judged again instead of searching, in a fraction of the "
         "time; 'truth': the true poses are judged")
      ->check(CLI::ExistingFile | CLI::IsMember({"truth"}));
  app.add_flag(
      "--support", args.support,
      "the parts stand on or above the plane z = 0 of the world: cam_R_w2c, cam_t_w2c of scene_camera.json");

  app.add_flag("--all", args.all, "write rejected candidates too");
  app.add_option("--out", args.out, "results file R.csv; R.times.csv is written beside it")->required();
  app.add_option("--dump", args.dump,
                 "CSV of every judged candidate, suppressed ones too: evidence, error, why it lost");
  app.add_option("--report", args.report,
                 "folder for a page with scores by scene and part, recall, reliability and the worst cases");
  app.add_option("--compare", args.compare, "results of another run, for the report")
      ->check(CLI::ExistingFile);
  app.add_option("--cases", args.page.cases,
                 "most missed and most wrong objects pictured in the report, each")
      ->capture_default_str();
  app.add_option("--misses", args.misses,
                 "folder for a page that explains every missed and every wrong object");

  int exit_code = 0;
  if (!parseArguments(&app, argc, argv, &exit_code)) return exit_code;
  return runTool("evaluate", [&] { return evaluate(args); });
}
