// Clears frames of parts in the work cell without ROS, and compares with the truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/median.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/offline/clearing_report.h"
#include "monocular_eye_hand/offline/offline_task.h"
#include "tools/clearing_pictures.h"
#include "tools/offline_files.h"
#include "tools/support.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

constexpr int kNotGood = 1;      // an object was left, dropped or hit
constexpr int kCouldNotRun = 2;  // or bad arguments

struct Arguments {
  OfflineFiles files;
  int seed = -1;
  std::string seeds, json, pictures, record;
};

void tellProgress(const std::string& step) { std::cerr << "clear_frame: " << step << std::endl; }

/// "3-17" or "5".
std::pair<int, int> seedRange(const std::string& text) {
  int first = 0, last = 0, used = 0;
  if (std::sscanf(text.c_str(), "%d-%d%n", &first, &last, &used) == 2 && size_t(used) == text.size() &&
      first >= 0 && last >= first)
    return {first, last};
  throw BadInput("--seeds " + text + ": of the form A-B, both 0 or more, A not above B");
}

void printFeedback(const TaskFeedback& feedback) {
  std::printf("  %-8s %-10s %s\n", toString(feedback.stage).c_str(), feedback.object.c_str(),
              feedback.text.c_str());
  std::fflush(stdout);
}

ClearingReport clear(const OfflineTask& task, int seed, const std::string& pictures, bool feedback) {
  ClearingWatch watch;
  if (feedback) watch.feedback = printFeedback;
  std::optional<ClearingPictures> taken;
  if (!pictures.empty()) {
    taken.emplace(pictures, task.models());
    taken->watch(&watch);
  }
  return reportOf(task.clear(seed, watch), task.models());
}

int exitCode(const ClearingReport& report) { return report.good() ? 0 : kNotGood; }

/// The report of what another program wrote down.
int reportRecord(const Arguments& args) {
  std::ifstream file(args.record);
  if (!file) throw BadInput(args.record + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const ModelBase models = loadModels(objectsFile(args.files), ModelDepth::kShape, {}, "", tellProgress);
  const ClearingReport report = reportOf(parseRecord(text, args.record), models);

  if (args.json != "-") std::cout << "\n" << reportTable(report) << std::flush;
  if (!args.json.empty()) writeText(args.json, reportJson(report));
  return exitCode(report);
}

int clearOne(const Arguments& args) {
  const OfflineTask task(readOfflineFiles(args.files), tellProgress);
  const bool print = args.json != "-";
  const ClearingReport report = clear(task, args.seed, args.pictures, print);

  if (print) std::cout << "\n" << reportTable(report) << std::flush;
  if (!args.json.empty()) writeText(args.json, reportJson(report));
  return exitCode(report);
}

/// One line of the table over many scenes.
void printScene(const ClearingReport& report) {
  std::vector<double> errors;
  for (const PickReport& pick : report.picks)
    if (pick.error) errors.push_back(1e3 * pick.error->distance);
  std::string left;
  for (const PartReport& part : report.parts)
    if (!part.in_drop_zone) left += (left.empty() ? "" : ", ") + part.label;

  std::printf("%5d %7s %5d/%zu %10d %6d %6zu %11.2f %9.1f %7.1f  %s\n", report.seed,
              report.cleared ? "yes" : "NO", report.carried(), report.parts.size(), report.collisions,
              report.looks, report.picks.size(), median(&errors), report.end->cell_seconds, report.times->all,
              left.empty() ? "" : ("left: " + left).c_str());
  std::fflush(stdout);
}

void printSums(const std::vector<ClearingReport>& reports, int scenes) {
  if (reports.empty()) return;
  std::vector<double> cell, wall;
  for (const ClearingReport& report : reports) {
    cell.push_back(report.end->cell_seconds);
    wall.push_back(report.times->all);
  }

  const ClearingSums sums = sumsOf(reports);
  std::printf("%d of %d cleared, %d of %d parts, %d collisions; median %.1f s of cell time, %.1f s\n",
              sums.cleared, scenes, sums.carried, sums.parts, sums.collisions, median(&cell), median(&wall));
}

int clearMany(const Arguments& args) {
  const auto [first, last] = seedRange(args.seeds);
  const OfflineTask task(readOfflineFiles(args.files), tellProgress);
  const bool print = args.json != "-";
  if (print)
    std::printf("%5s %7s %7s %10s %6s %6s %11s %9s %7s\n", "seed", "cleared", "parts", "collisions", "looks",
                "picks", "error [mm]", "cell [s]", "[s]");

  int code = 0;
  std::vector<ClearingReport> reports;
  for (int seed = first; seed <= last; ++seed) {
    const std::string pictures =
        args.pictures.empty() ? "" : (fs::path(args.pictures) / std::to_string(seed)).string();
    try {
      reports.push_back(clear(task, seed, pictures, false));
      code = std::max(code, exitCode(reports.back()));
      if (print) printScene(reports.back());
    } catch (const BadInput& e) {
      code = kCouldNotRun;
      std::cerr << "clear_frame: seed " << seed << ": " << e.what() << std::endl;
    }
  }

  if (print) printSums(reports, last - first + 1);
  if (!args.json.empty()) writeText(args.json, reportsJson(reports));
  return code;
}

int run(const Arguments& args) {
  if (!args.record.empty()) return reportRecord(args);
  return args.seeds.empty() ? clearOne(args) : clearMany(args);
}

void addOptions(CLI::App* app, Arguments* args) {
  CLI::Option* seed = app->add_option("--seed", args->seed, "a random scene; -1: the one of the cell's file")
                          ->check(CLI::Range(-1, 1000000000))
                          ->capture_default_str();
  CLI::Option* seeds =
      app->add_option("--seeds", args->seeds, "random scenes, as 0-49: a line for each, then their sums")
          ->excludes(seed);
  app->add_option("--json", args->json, "write the report as JSON (docs/json.md); - for standard output");
  app->add_option("--pictures", args->pictures,
                  "folder for what every look saw and how the cell stands at the end; DIR/<seed> for several "
                  "scenes");
  app->add_option("--record", args->record,
                  "nothing is run: reports on a task that scripts/clear_frame.py wrote down")
      ->check(CLI::ExistingFile)
      ->excludes(seed)
      ->excludes(seeds);

  app->add_option("--objects", args->files.objects, "model base (default: objects.yaml of --config)");
  app->add_option("--cell", args->files.cell, "the work cell (default: cell.yaml of --config)");
  app->add_option(
         "--config", args->files.config,
         "folder with recognizer.yaml, eye_hand.yaml, planner.yaml and task.yaml, which the nodes read, "
         "too (default: the package's config)")
      ->check(CLI::ExistingDirectory);
  app->add_option("--urdf", args->files.urdf,
                  "arm with gripper and camera (default: urdf/puma560.urdf of the package)");
}

}  // namespace
}  // namespace monocular_eye_hand

int main(int argc, char** argv) {
  using namespace monocular_eye_hand;
  cv::setNumThreads(1);  // times are those of one thread
  Arguments args;
  CLI::App app(
      "Clears a frame of parts in the simulated work cell: camera, recognition, grasps, plans and arm in one "
      "process, without ROS. Compares with the truth. The same seed gives the same answer on every machine.",
      "clear_frame");
  app.footer(
      "Exit code: 0 when every part was carried out and nothing was hit; 1 when one was left, dropped or "
      "hit; "
      "2 when a scene could not be run, or on bad arguments.");
  addOptions(&app, &args);

  int exit_code = 0;
  if (!parseArguments(&app, argc, argv, &exit_code, kCouldNotRun)) return exit_code;
  return runTool(
      "clear_frame", [&] { return run(args); }, kCouldNotRun);
}
