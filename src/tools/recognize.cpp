#include <fmt/format.h>

// Recognises the known objects in images, without ROS.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <opencv2/core.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/camera_file.h"
#include "monocular_eye_hand/io/grey_image.h"
#include "monocular_eye_hand/io/image_files.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/recognition/recognizer.h"
#include "monocular_eye_hand/recognition/size_check.h"
#include "monocular_eye_hand/report/explanation.h"
#include "monocular_eye_hand/report/result_drawing.h"
#include "tools/result_output.h"
#include "tools/support.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string objects, camera, only, json, overlay, explain, figures, options, decision;
  std::vector<std::string> settings, images;
  double time_limit_s = -1;  // negative: as the options say
  int budget = -1;
  bool show_options = false;
};

RecognitionOptions effectiveOptions(const Arguments& args) {
  std::vector<std::string> settings = args.settings;
  if (args.time_limit_s >= 0) settings.push_back(fmt::format("time_limit={}", args.time_limit_s));
  if (args.budget >= 0) settings.push_back(fmt::format("budget={}", args.budget));
  return recognitionOptions(args.options, settings, args.decision);
}

// `--budget` has been a number of seconds; so few hypotheses find nothing.
std::string hypothesesNotSeconds(const std::string& text) {
  const bool is_count = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (is_count && (text == "0" || text.size() > 2)) return "";
  return "it is a number of hypotheses, 0 or at least 100, not '" + text +
         "'; for seconds there is --time-limit";
}

std::vector<std::string> allImages(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  for (const std::string& argument : arguments)
    for (std::string& file : imageFiles(argument)) files.push_back(std::move(file));
  return files;
}

// "F.png" for one image; "F_<image>.png" for each of several, numbered where the names of images repeat.
class OutputNames {
 public:
  explicit OutputNames(const std::vector<std::string>& images) {
    std::map<std::string, int> seen;
    for (const std::string& image : images) {
      const std::string stem = fs::path(image).stem().string();
      const int count = ++seen[stem];
      names_.push_back(count == 1 ? stem : fmt::format("{}_{}", stem, count));
    }
  }
  std::string file(const std::string& path, size_t image) const {
    if (names_.size() == 1) return path;
    fs::path out(path);
    return out.replace_filename(out.stem().string() + "_" + names_[image] + out.extension().string())
        .string();
  }
  std::string folder(const std::string& path, size_t image) const {
    return names_.size() == 1 ? path : (fs::path(path) / names_[image]).string();
  }

 private:
  std::vector<std::string> names_;
};

// Recognises one image and draws what was asked for. A bad image is in the report, not an exception.
ImageReport process(const Arguments& args, const Recognizer& recognizer, const Camera& camera,
                    const OutputNames& names, const std::string& path, size_t number) {
  ImageReport report;
  report.image = path;

  cv::Mat grey;
  try {
    grey = loadGreyImage(path);
    RecognitionRequest request;
    request.only = args.only;
    const auto start = std::chrono::steady_clock::now();
    report.result = recognizer.recognize(grey, camera, request);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } catch (const BadInput& e) {
    report.error = e.what();
    return report;
  }

  if (!args.overlay.empty())
    writePicture(names.file(args.overlay, number),
                 drawResult(grey, camera, recognizer.models(), report.result));
  if (!args.explain.empty()) {
    ExplanationOptions page;
    page.title = fs::path(path).filename().string();
    writeExplanation(names.folder(args.explain, number), grey, camera, recognizer.models(), report.result,
                     page);
  }
  if (!args.figures.empty())
    writeFigures(names.folder(args.figures, number), grey, camera, recognizer.models(), report.result);
  return report;
}

void writeJson(const std::string& path, const nlohmann::ordered_json& document) {
  // Names come from files: bytes that are not UTF-8 are replaced, not refused.
  writeText(path, document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void warn(const std::string& text) { std::cerr << "recognize: warning: " << text << "\n"; }

void warnAboutModels(const Recognizer& recognizer, const Camera& camera) {
  for (const KnownObject& known : recognizer.models().objects) {
    for (const std::string& warning : known.model.warnings) warn(known.model.name + ": " + warning);
  }
  for (const std::string& warning : sizeWarnings(recognizer.models(), camera, recognizer.options()))
    warn(warning);
}

int recognize(const Arguments& args) {
  const RecognitionOptions options = effectiveOptions(args);
  if (args.show_options) {
    std::cout << toYaml(writeOptions(options));
    return 0;
  }
  if (args.objects.empty())
    throw BadInput("--objects FILE is missing: the model base, as config/objects.yaml");
  if (args.camera.empty()) throw BadInput("--camera FILE.yaml is missing: the camera's calibration");
  if (args.images.empty()) throw BadInput("no image given");
  const std::vector<std::string> images = allImages(args.images);
  const CameraFile calibration = readCameraFile(args.camera);
  for (const std::string& warning : calibration.warnings) warn(args.camera + ": " + warning);
  const Camera& camera = calibration.camera;
  const auto tell = [](const std::string& step) { std::cerr << "recognize: " << step << std::endl; };
  const Recognizer recognizer(loadModels(args.objects, ModelDepth::kViews, {}, "", tell), options);
  warnAboutModels(recognizer, camera);
  if (!args.only.empty() && recognizer.models().indexOf(args.only) < 0)
    throw BadInput("--only " + args.only + ": no such object; known are " + recognizer.models().names());

  const bool print_table = args.json != "-";
  const OutputNames names(images);
  Progress progress(images.size(), images.size() > 1 && (!print_table || !isatty(STDOUT_FILENO)));
  nlohmann::ordered_json document{{"format", "monocular_eye_hand recognition 1"},
                                  {"images", nlohmann::json::array()}};
  bool all_processed = true;
  for (size_t i = 0; i < images.size(); ++i) {
    const ImageReport report = process(args, recognizer, camera, names, images[i], i);
    if (print_table) std::cout << table(report) << std::flush;
    if (!report.error.empty()) {
      all_processed = false;
      std::cerr << "recognize: " << report.error << "\n";
    }
    if (!args.json.empty()) document["images"].push_back(toJson(report, recognizer.models()));
    progress.step(images[i]);
  }
  if (!args.json.empty()) writeJson(args.json, document);
  return all_processed ? 0 : 1;
}

}  // namespace
}  // namespace monocular_eye_hand

int main(int argc, char** argv) {
  using namespace monocular_eye_hand;
  cv::setNumThreads(1);  // times are those of one thread
  Arguments args;
  CLI::App app("Recognises known objects in grey images and prints their poses in the camera frame.",
               "recognize");
  app.footer(
      "Exit code: 0 when every image was processed, whether or not something was found; 1 on bad input.");

  app.add_option("--objects", args.objects, "model base: YAML list of CAD files, as config/objects.yaml");
  app.add_option(
      "--camera", args.camera,
      "calibration: YAML or ost.ini of camera_calibration, OpenCV FileStorage, CameraInfo, kalibr, "
      "ViSP");
  app.add_option("--only", args.only,
                 "look for this object only; stops at its first plausible and reliable match");
  app.add_option("--time-limit", args.time_limit_s,
                 "stop the search after this many seconds (results say truncated); 0: never")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--budget", args.budget,
                 "stop after this many hypotheses: the same answer on every machine; 0: never")
      ->check(hypothesesNotSeconds);
  refuseRenamed(&app, "--work", "--budget");
  app.add_option("--json", args.json, "write the results as JSON (docs/json.md); - for standard output");
  app.add_option("--overlay", args.overlay,
                 "picture of the result; F_<image>.png for each of several images");
  app.add_option("--explain", args.explain,
                 "folder for a page with a picture per stage; DIR/<image> for several");
  app.add_option("--figures", args.figures,
                 "folder for the scene, line groups, ellipses and a back-projection per object as pictures; "
                 "DIR/<image> for several");
  app.add_option("--options", args.options, "YAML of recognition options, or config/recognizer.yaml");
  app.add_option("--decision", args.decision, "YAML of the decision's weights, as fit_decision writes it")
      ->check(CLI::ExistingFile);
  app.add_option("--set", args.settings, "one option, KEY=VALUE or GROUP.KEY=VALUE; may be repeated")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  app.add_flag("--show-options", args.show_options, "print the effective options as YAML and stop");
  app.add_option("images", args.images, "image files, folders or printf patterns (img_%04d.png)");

  int exit_code = 0;
  if (!parseArguments(&app, argc, argv, &exit_code)) return exit_code;
  return runTool("recognize", [&] { return recognize(args); });
}
