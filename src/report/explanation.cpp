#include "monocular_eye_hand/report/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "monocular_eye_hand/drawing/overlays.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/report/result_drawing.h"
#include "report/html.h"

namespace monocular_eye_hand {
namespace {

// "1,234,567".
std::string grouped(double number) {
  std::string digits = std::to_string((long long)std::llround(std::abs(number)));
  for (int k = int(digits.size()) - 3; k > 0; k -= 3) digits.insert(size_t(k), ",");
  return (number < 0 ? "-" : "") + digits;
}

std::string count(size_t number, const std::string& one, const std::string& many) {
  return grouped(double(number)) + " " + (number == 1 ? one : many);
}

// Stages that run once per object are one row.
std::vector<StageReport> stagesByName(const std::vector<StageReport>& stages) {
  std::vector<StageReport> merged;
  for (const StageReport& stage : stages) {
    const auto same = std::find_if(merged.begin(), merged.end(),
                                   [&](const StageReport& other) { return other.name == stage.name; });
    if (same == merged.end()) {
      merged.push_back(stage);
      continue;
    }
    same->seconds += stage.seconds;
    for (const auto& [name, value] : stage.counts) same->counts[name] += value;
  }
  return merged;
}

std::string stageTime(double seconds) { return fmt::format("{:.1f} ms", 1000 * seconds); }

std::string sizeText(const cv::Mat& image) { return fmt::format("{} x {}", image.cols, image.rows); }

std::string decisionText(Decision decision) {
  if (decision == Decision::kAccepted) return "accepted";
  return decision == Decision::kAmbiguous ? "ambiguous" : "rejected";
}

std::string poseText(const Rigid3& camera_from_object) {
  const Eigen::Vector3d t = camera_from_object.translation * 1000;
  const Eigen::Quaterniond q = camera_from_object.quaternion();
  return "(" + shortNumber(t.x()) + ", " + shortNumber(t.y()) + ", " + shortNumber(t.z()) +
         ") mm, quaternion x y z w (" + shortNumber(q.x()) + ", " + shortNumber(q.y()) + ", " +
         shortNumber(q.z()) + ", " + shortNumber(q.w()) + ")";
}

// Standard deviations of the position and, the free axis aside, of the rotation.
std::string accuracyText(const ObjectEstimate& object) {
  const auto sigma = [&](int k) { return std::sqrt(std::max(0.0, object.covariance(k, k))); };
  std::string text = shortNumber(1000 * sigma(0)) + ", " + shortNumber(1000 * sigma(1)) + ", " +
                     shortNumber(1000 * sigma(2)) + " mm";
  const double degrees = 180 / M_PI;
  text += "; " + shortNumber(degrees * sigma(3)) + ", " + shortNumber(degrees * sigma(4)) + ", " +
          shortNumber(degrees * sigma(5)) + " deg";
  return object.free_axis ? text + " (one axis free)" : text;
}

class PageWriter {
 public:
  PageWriter(const std::string& folder, const cv::Mat& grey, const Camera& camera, const ModelBase& models,
             const RecognitionResult& result, const ExplanationOptions& options)
      : folder_(folder),
        grey_(grey),
        camera_(camera),
        search_grey_(searchImage(grey, result.features.camera)),
        models_(models),
        result_(result),
        options_(options),
        page_(options.title) {}

  std::string write() {
    outcome();
    stages();
    features();
    groupings();
    candidates();
    const std::string path = (folder_ / "index.html").string();
    std::ofstream file(path, std::ios::binary);
    file << page_.text();
    if (!file.flush()) throw BadInput(path + ": cannot be written");
    return path;
  }

 private:
  void picture(const std::string& file, const cv::Mat& image) {
    writePicture((folder_ / file).string(), image);
  }
  void figure(const std::string& file, const cv::Mat& image, const std::string& caption, bool wide = false) {
    picture(file, image);
    page_.figure(file, caption, wide);
  }

  void outcome() {
    page_.heading("Result", "result");
    if (result_.objects.empty())
      page_.paragraph("Nothing found. " + result_.reason);
    else
      page_.paragraph(count(result_.objects.size(), "object", "objects") + " found.");
    if (result_.budget_spent) page_.paragraph("The budget was spent before all groupings were used.");
    if (result_.truncated) page_.paragraph("The time limit ended the search before everything was tried.");

    figure("result.png", drawResult(grey_, camera_, models_, result_),
           "Accepted green, ambiguous amber; axes x red, y green, z blue", true);
    if (result_.objects.empty()) return;

    std::vector<HtmlPage::Row> rows;
    for (const ObjectEstimate& object : result_.objects)
      rows.push_back({object.name, decisionText(object.decision), shortNumber(object.probability),
                      shortNumber(object.plausibility), shortNumber(object.reliability),
                      fmt::format("{} of {}", object.matched_features, object.expected_features),
                      poseText(object.camera_from_object)});
    page_.table({"object", "decision", "probability", "plausibility", "reliability", "features",
                 "pose in the camera"},
                rows);
  }

  void stages() {
    page_.heading("Stages", "stages");
    std::vector<HtmlPage::Row> rows;
    double total = 0;
    for (const StageReport& stage : stagesByName(result_.stages)) {
      std::string counts;
      for (const auto& [name, value] : stage.counts)
        counts += (counts.empty() ? "" : ", ") + grouped(value) + " " + name;
      rows.push_back({stage.name, stageTime(stage.seconds), counts});
      total += stage.seconds;
    }
    rows.push_back({"all", stageTime(total), ""});
    page_.table({"stage", "time", "counts"}, rows);
  }

  void features() {
    const FeatureSet& f = result_.features;
    page_.heading("Features", "features");
    if (search_grey_.cols != grey_.cols)
      page_.paragraph("The image of " + sizeText(grey_) + " px was searched at " + sizeText(search_grey_) +
                      " px: features and groupings are of that size, the poses were refined in full.");

    page_.beginGrid();
    figure("image.png", Canvas(grey_, camera_).picture(), "The image as taken");
    figure("traces.png", tracesPicture(search_grey_, f),
           count(f.traces.size(), "edge trace", "edge traces") + ", " +
               count(f.points.size(), "point", "points"));

    size_t joined = 0;
    for (const LineSegment& segment : f.segments) joined += segment.joined();
    figure("segments.png", segmentsPicture(search_grey_, f),
           fmt::format("{} (yellow), {} joined across gaps (blue)",
                       count(f.segments.size() - joined, "straight segment", "straight segments"), joined));
    figure("ellipses.png", ellipsesPicture(search_grey_, f),
           count(f.arcs.size(), "elliptic arc", "elliptic arcs") + " (orange), " +
               count(f.ellipses.size(), "ellipse", "ellipses") + " fitted to them");
    page_.endGrid();
  }

  void groupings() {
    page_.heading("Groupings", "groupings");
    page_.paragraph(count(result_.groupings.size(), "grouping", "groupings") +
                    " of features that likely belong to one part of one object. The pictures show the "
                    "heaviest of each kind.");
    page_.beginGrid();
    figure("line_groups.png", lineGroupsPicture(search_grey_, result_.features, result_.groupings),
           "Lines that corners connect, one colour per group");
    int index = 0;
    for (const GroupingPicture& shown : groupingPictures(search_grey_, result_.features, result_.groupings))
      figure(fmt::format("groupings_{}.png", index++), shown.picture,
             fmt::format("{}: {} of {}", toString(shown.kind), shown.shown, shown.total));
    page_.endGrid();
  }

  void candidate(const ObjectEstimate& object, const std::string& file) {
    picture(file, drawCandidate(grey_, camera_, models_, object));

    HtmlPage::Card card;
    card.picture = file;
    card.title = objectLabel(object);
    card.badge = card.badge_class = decisionText(object.decision);
    card.text = object.reason;
    card.terms = {
        {"pose", poseText(object.camera_from_object)},
        {"standard deviation", accuracyText(object)},
        {"plausibility", shortNumber(object.plausibility)},
        {"reliability", shortNumber(object.reliability)},
        {"features matched", fmt::format("{} of {}", object.matched_features, object.expected_features)},
        {"groupings explained", std::to_string(object.matched_groupings)},
        {"characteristic view", std::to_string(object.characteristic_view)}};

    if (!object.symmetry.empty()) card.terms.push_back({"symmetry", object.symmetry});
    for (const std::string& words : object.spoke_for) card.terms.push_back({"speaks for it", words});
    for (const std::string& words : object.spoke_against) card.terms.push_back({"speaks against it", words});
    for (const auto& [term, value] : object.evidence) card.terms.push_back({term, shortNumber(value)});
    for (const Alternative& other : object.alternatives) {
      const bool known = other.object >= 0 && other.object < int(models_.objects.size());
      card.terms.push_back(
          {"alternative", (known ? models_.objects[other.object].model.name : std::string("?")) + " " +
                              shortNumber(other.probability) + " at " + poseText(other.camera_from_object)});
    }

    page_.card(card);
  }

  void candidates() {
    page_.heading("Candidates", "candidates");
    const size_t shown = std::min(result_.rejected.size(), size_t(options_.rejected));
    page_.paragraph(fmt::format("{} kept, {} judged and rejected; the best {} of those are shown.",
                                count(result_.objects.size(), "candidate", "candidates"),
                                result_.rejected.size(), shown));
    page_.beginGrid();
    for (size_t k = 0; k < result_.objects.size(); ++k)
      candidate(result_.objects[k], fmt::format("object_{}.png", k));
    for (size_t k = 0; k < shown; ++k) candidate(result_.rejected[k], fmt::format("rejected_{}.png", k));
    page_.endGrid();
  }

  std::filesystem::path folder_;
  const cv::Mat& grey_;
  const Camera& camera_;
  const cv::Mat search_grey_;
  const ModelBase& models_;
  const RecognitionResult& result_;
  const ExplanationOptions& options_;
  HtmlPage page_;
};

}  // namespace

void ExplanationOptions::check() const {
  if (rejected < 0 || rejected > 1000)
    throw BadInput(fmt::format("explanation options: rejected = {} must be 0..1000", rejected));
}

std::string writeExplanation(const std::string& folder, const cv::Mat& grey, const Camera& camera,
                             const ModelBase& models, const RecognitionResult& result,
                             const ExplanationOptions& options) {
  options.check();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw BadInput(folder + ": cannot be created (" + error.message() + ")");
  return PageWriter(folder, grey, camera, models, result, options).write();
}

}  // namespace monocular_eye_hand
