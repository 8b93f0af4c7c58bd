#include "report/case_cards.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/contour.h"

namespace monocular_eye_hand {
namespace {

const Colour kTruthColour(255, 220, 60);      // cyan
const Colour kCandidateColour(40, 150, 255);  // orange
const Colour kWrongColour(90, 90, 250);       // red

std::string place(int scene, int image) { return fmt::format("scene {}, image {}", scene, image); }

std::string pixels(double value) { return fmt::format("{:.{}f} px", value, value < 100 ? 1 : 0); }

std::string probabilityText(double value) { return fmt::format("{:.2f}", value); }

std::string fateText(const JudgedPose& pose) {
  const std::string p = " (p " + probabilityText(pose.probability) + ")";
  if (pose.fate == JudgedPose::kReported) return "was reported" + p;
  return (pose.fate == JudgedPose::kRejected ? "was rejected" : "was suppressed") + p;
}

std::string pixelsOrNone(double value) { return std::isfinite(value) ? pixels(value) : "none"; }

// How near the search came, stage by stage.
std::string traceText(const TracedTruth& traced) {
  return fmt::format(
      " In the search: groupings of its own {}; nearest generated {}, taken {}, aligned {}, verified {}, "
      "recorded {}.",
      traced.groupings, pixelsOrNone(traced.generated), pixelsOrNone(traced.taken),
      pixelsOrNone(traced.aligned), pixelsOrNone(traced.verified), pixelsOrNone(traced.recorded));
}

std::vector<std::pair<std::string, std::string>> termsOf(const JudgedPose& pose) {
  std::vector<std::pair<std::string, std::string>> terms;
  for (const auto& [term, value] : pose.evidence) terms.emplace_back(term, shortNumber(value));
  return terms;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> caseColours() {
  return {{"#3cdcff", "true contour"},
          {"#ff9628", "nearest candidate of a missed object"},
          {"#fa5a5a", "wrong pose"}};
}

std::string percentText(double share) { return fmt::format("{} %", int(std::lround(100 * share))); }

void createFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw BadInput(folder + ": cannot be created (" + error.message() + ")");
}

std::string writePage(const std::string& folder, const HtmlPage& page) {
  const std::string path = (std::filesystem::path(folder) / "index.html").string();
  std::ofstream file(path, std::ios::binary);
  file << page.text();
  if (!file.flush()) throw BadInput(path + ": cannot be written");
  return path;
}

CaseCards::CaseCards(const std::filesystem::path& folder, const EvaluatedRun& run)
    : folder_(folder), run_(run) {}

const ObjectModel& CaseCards::model(int object) const {
  const auto at = run_.models.find(object);
  const auto index = std::distance(run_.models.begin(), at);
  if (at == run_.models.end() || index >= std::ptrdiff_t(run_.known.objects.size()))
    throw BadInput(fmt::format("report: object {} is not in the model base", object));
  return run_.known.objects[size_t(index)].model;
}

const BopImage& CaseCards::imageOf(int scene, int image) const {
  const BopImage* found = run_.split.find(scene, image);
  if (!found) throw BadInput("report: " + place(scene, image) + " is not in the split");
  return *found;
}

std::string CaseCards::partName(int object) const {
  const auto at = run_.models.find(object);
  return at == run_.models.end() ? fmt::format("object {}", object) : at->second.name;
}

double CaseCards::inFrame(const TruthOutcome& truth) const {
  try {
    const Camera camera = run_.load(imageOf(truth.scene, truth.image)).camera;
    ContourOptions options;
    options.step = model(truth.object).diameter / 100;
    const auto contour =
        visibleContour(model(truth.object), truth.camera_from_object.inverse().translation, options);
    int inside = 0;
    for (const ContourSample& sample : contour) {
      const Eigen::Vector3d p = truth.camera_from_object * sample.p;
      if (!(p.z() > 0)) continue;
      const Eigen::Vector2d uv = camera.distort(camera.project(p));
      inside += uv.x() >= 0 && uv.y() >= 0 && uv.x() <= camera.width - 1 && uv.y() <= camera.height - 1;
    }
    return contour.empty() ? 1 : inside / double(contour.size());
  } catch (const BadInput&) {
    return 1;  // without its image nothing is known; the card says so
  }
}

HtmlPage::Card CaseCards::pictured(HtmlPage::Card card, const std::string& file, const BopImage& image,
                                   const std::vector<Outline>& outlines) const {
  try {
    writePicture((folder_ / file).string(), casePicture(run_.load(image), outlines));
    card.picture = file;
  } catch (const BadInput& e) {
    card.text += " No picture: " + std::string(e.what());
  }
  return card;
}

std::string CaseCards::missedText(const MissedObject& missed) const {
  const TruthOutcome& truth = missed.truth;
  std::string text = percentText(truth.visible) + " visible, " + pixels(truth.size) + " large, " +
                     shortNumber(std::round(1000 * truth.distance)) + " mm away. ";
  if (!missed.limit.empty()) text += "Beyond a limit of the search: " + missed.limit + ". ";
  if (missed.nearest < 0) return text + "No candidate of it was judged.";
  const JudgedPose& pose = run_.judged[size_t(missed.nearest)];
  if (!pose.right()) text += "No candidate within 10 px was judged. ";
  if (missed.turned) text += "One has its place and size in another orientation. ";
  text += (pose.right() ? "Its candidate " : "The nearest one, ") + pixels(pose.errors.mspd) +
          (pose.right() ? " off " : " off, ") + fateText(pose);
  if (missed.lost.stage == LostAt::kFoundElsewhere) text += " and counts for another instance";
  const bool why = !missed.lost.by.empty() && pose.fate != JudgedPose::kReported;
  return text + (why ? ": " + missed.lost.by + "." : ".");
}

HtmlPage::Card CaseCards::missed(const MissedObject& missed) {
  const TruthOutcome& truth = missed.truth;
  std::vector<Outline> outlines{{&model(truth.object), truth.camera_from_object, kTruthColour}};
  HtmlPage::Card card;
  card.title = partName(truth.object) + ", " + place(truth.scene, truth.image);
  card.badge = missed.limit.empty() ? toString(missed.lost.stage) : "limit";
  card.badge_class = missed.limit.empty() ? "rejected" : "ambiguous";
  card.text = missedText(missed) + (missed.traced ? traceText(*missed.traced) : "");
  if (missed.nearest >= 0) {
    const JudgedPose& pose = run_.judged[size_t(missed.nearest)];
    outlines.push_back({&model(truth.object), pose.camera_from_object, kCandidateColour});
    if (pose.right()) card.terms = termsOf(pose);
  }
  const std::string file = fmt::format("missed_{}.jpg", missed_count_++);
  return pictured(card, file, imageOf(truth.scene, truth.image), outlines);
}

std::string CaseCards::wrongText(const WrongAccept& wrong) const {
  const RowOutcome& row = wrong.row;
  const BopImage& image = imageOf(row.scene, row.image);
  std::string text;
  if (wrong.on >= 0 && wrong.cause == WrongCause::kOtherObject)
    text = percentText(wrong.overlap) + " of it lies on the " +
           partName(image.truth[size_t(wrong.on)].object) + ". ";
  if (wrong.cause == WrongCause::kTwin) text = "It covers its object in another orientation. ";
  if (wrong.cause == WrongCause::kMisplaced)
    text = percentText(wrong.overlap) + " of it lies on its object. ";
  if (wrong.cause == WrongCause::kClutter) text = "Nothing that the truth knows is there. ";
  if (row.nearest >= 0) return text + "Its nearest instance is " + pixels(row.errors.mspd) + " off.";
  for (const GroundTruth& truth : image.truth)
    if (truth.object == row.object) return text + "Its instances are all farther than two diameters away.";
  return text + "The image shows no " + partName(row.object) + ".";
}

HtmlPage::Card CaseCards::wrong(const WrongAccept& wrong) {
  const RowOutcome& row = wrong.row;
  const BopImage& image = imageOf(row.scene, row.image);
  std::vector<Outline> outlines{{&model(row.object), row.camera_from_object, kWrongColour}};
  HtmlPage::Card card;
  card.title = partName(row.object) + " p " + probabilityText(row.score) + ", " + place(row.scene, row.image);
  card.badge = toString(wrong.cause);
  card.badge_class = "rejected";
  card.text = wrongText(wrong);
  const int shown = wrong.on >= 0 ? wrong.on : row.nearest;
  if (shown >= 0) {
    const GroundTruth& truth = image.truth[size_t(shown)];
    outlines.push_back({&model(truth.object), truth.camera_from_object, kTruthColour});
  }
  if (wrong.judged >= 0) card.terms = termsOf(run_.judged[size_t(wrong.judged)]);
  return pictured(card, fmt::format("wrong_{}.jpg", wrong_count_++), image, outlines);
}

}  // namespace monocular_eye_hand
