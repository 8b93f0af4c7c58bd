#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "report/case_cards.h"
#include "report/charts.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMaxSides = 12;  // parts whose sides are shown

std::string fixed(double value, int digits) {
  if (!std::isfinite(value)) return "\u2013";
  return fmt::format("{:.{}f}", value, digits);
}

std::string signedText(double value, int digits) {
  const std::string text = fixed(value, digits);
  return value > 0 ? "+" + text : text;
}

std::string shareText(const Share& share) {
  if (share.whole == 0) return "\u2013";
  return fmt::format("{} ({}/{})", percentText(share.value()), share.part, share.whole);
}

std::string intervalText(const Share& share) {
  if (share.whole == 0) return "\u2013";
  const Interval interval = wilson95(share);
  return fmt::format("{}\u2013{}", int(std::lround(100 * interval.low)), percentText(interval.high));
}

HtmlPage::Row scoreRow(const GroupScore& score) {
  return {score.name,
          std::to_string(score.images),
          shareText(score.found),
          intervalText(score.found),
          shareText(score.right),
          intervalText(score.right),
          std::to_string(score.wrong()),
          fixed(score.ar, 3),
          std::isfinite(score.median_time) ? fixed(score.median_time, 2) + " s" : "\u2013"};
}

std::string barsOf(const std::string& title, const std::vector<RecallBin>& bins) {
  std::vector<ChartBar> bars;
  for (const RecallBin& bin : bins) {
    const Interval interval = wilson95(bin.found);
    bars.push_back({bin.label, fmt::format("{}/{}", bin.found.part, bin.found.whole), bin.found.value(),
                    interval.low, interval.high, bin.found.whole == 0});
  }
  return barChart(title, bars);
}

class EvaluationPageWriter {
 public:
  EvaluationPageWriter(const std::string& folder, const EvaluatedRun& run,
                       const std::optional<OtherRun>& other, const EvaluationPageOptions& options)
      : folder_(folder), run_(run), other_(other), options_(options), page_(run.title), cards_(folder, run) {}

  std::string write() {
    for (const std::string& note : run_.notes) page_.paragraph(note);
    scores();
    if (other_) comparison();
    recall();
    calibration();
    missedCases();
    wrongCases();
    return writePage(folder_, page_);
  }

 private:
  void scores() {
    page_.heading("Scores", "scores");
    page_.paragraph(
        "Found: wanted instances (at least half visible) that a reported pose hits by less than 10 px MSPD, "
        "one to one. Right: reported poses within 10 px of an instance of their object; the others are false "
        "accepts. AR: mean recall over BOP's thresholds of MSSD and MSPD, of instances at least 10 % "
        "visible. "
        "Intervals are Wilson's at 95 %. A part's time is the median over the images that show it.");

    const HtmlPage::Row head{
        "",   "images",     "found of wanted", "95 %", "right of reported", "95 %", "false accepts",
        "AR", "median time"};

    std::vector<HtmlPage::Row> scenes, parts;
    for (const GroupScore& score : scoresByScene(run_.split, run_.outcomes, run_.times))
      scenes.push_back(scoreRow(score));
    scenes.push_back(scoreRow(scoreOfAll(run_.split, run_.outcomes, run_.times)));
    for (const GroupScore& score : scoresByPart(run_.split, run_.models, run_.outcomes, run_.times))
      parts.push_back(scoreRow(score));

    page_.table(head, scenes);
    page_.heading("Parts", "parts");
    page_.table(head, parts);
  }

  void comparison() {
    const RunComparison comparison =
        compareRuns(run_.split, run_.outcomes, run_.times, other_->outcomes, other_->times);
    page_.heading("Comparison", "comparison");
    page_.paragraph("This run against " + other_->name +
                    ". Chance: probability that two equally good runs differ by as much or more in what "
                    "they find (McNemar's test, exact, two-sided).");
    std::vector<RunComparison::Group> groups = comparison.scenes;
    groups.push_back(comparison.all);
    std::vector<HtmlPage::Row> found, scores;
    for (const RunComparison::Group& group : groups) {
      found.push_back(foundRow(group));
      scores.push_back(scoresRow(group));
    }
    page_.table({"", "found, this", "other", "points", "both", "only this", "only other", "chance"}, found);
    page_.paragraph("Reported poses that are right, and AR:");
    page_.table({"", "right, this", "other", "points", "AR, this", "other", "change"}, scores);
    changedObjects(comparison.changed);
  }

  static std::string pointsText(const Share& a, const Share& b) {
    return a.whole && b.whole ? signedText(100 * (a.value() - b.value()), 1) : "\u2013";
  }

  static HtmlPage::Row foundRow(const RunComparison::Group& group) {
    return {group.a.name,
            shareText(group.a.found),
            shareText(group.b.found),
            pointsText(group.a.found, group.b.found),
            std::to_string(group.found.both),
            std::to_string(group.found.only_a),
            std::to_string(group.found.only_b),
            fixed(group.found.chance(), 3)};
  }

  static HtmlPage::Row scoresRow(const RunComparison::Group& group) {
    return {group.a.name,
            shareText(group.a.right),
            shareText(group.b.right),
            pointsText(group.a.right, group.b.right),
            fixed(group.a.ar, 3),
            fixed(group.b.ar, 3),
            signedText(group.a.ar - group.b.ar, 3)};
  }

  void changedObjects(const std::vector<ChangedObject>& changed) {
    if (changed.empty()) {
      page_.paragraph("Both runs found the same instances.");
      return;
    }
    page_.paragraph("Instances that one run alone found, and the MSPD of the pose matched to them:");
    const auto error = [](const TruthOutcome& truth) {
      return std::isfinite(truth.errors.mspd) ? fixed(truth.errors.mspd, 1) + " px" : "none";
    };
    std::vector<HtmlPage::Row> rows;
    for (const ChangedObject& object : changed)
      rows.push_back({std::to_string(object.a.scene), std::to_string(object.a.image),
                      partName(object.a.object), percentText(object.a.visible),
                      fixed(object.a.size, 0) + " px", object.a.found() ? "this run" : "the other",
                      error(object.a), error(object.b)});
    page_.table({"scene", "image", "part", "visible", "size", "found by", "this", "other"}, rows);
  }

  void recall() {
    page_.heading("Recall", "recall");
    page_.paragraph(
        "Found of the instances in each bin, with their counts and 95 % intervals. Visibility: of "
        "all instances; the others: of the wanted ones. Size is the image of the part's diameter.");
    page_.beginGrid();
    page_.chart(barsOf("by visible share [%]", recallByVisibility(run_.outcomes)), "");
    page_.chart(barsOf("by size in the image [px]", recallBySize(run_.outcomes)), "");
    page_.chart(barsOf("by distance [m]", recallByDistance(run_.outcomes)), "");
    page_.endGrid();
    sides();
  }

  void sides() {
    page_.paragraph("By the side of the part, in its own frame, that faces the camera most:");
    page_.beginGrid();
    size_t shown = 0;
    for (const auto& [object, model] : run_.models) {
      const auto bins = recallBySide(run_.outcomes, object);
      const bool wanted =
          std::any_of(bins.begin(), bins.end(), [](const RecallBin& bin) { return bin.found.whole > 0; });
      if (wanted && ++shown <= kMaxSides) page_.chart(barsOf(model.name, bins), "");
    }
    page_.endGrid();
    if (shown > kMaxSides) page_.paragraph(fmt::format("{} more parts are not shown.", shown - kMaxSides));
  }

  void calibration() {
    page_.heading("Probabilities", "probabilities");
    const std::vector<Prediction> all = predictions(run_.judged);
    if (all.empty()) {
      page_.paragraph("No candidate was judged.");
      return;
    }

    const auto bins = reliabilityBins(all);
    std::vector<ChartPoint> points;
    for (const ReliabilityBin& bin : bins) {
      const Interval interval = wilson95(bin.right);
      points.push_back({bin.mean_probability, bin.right.value(), interval.low, interval.high,
                        shareText(bin.right) + " right at mean p " + fixed(bin.mean_probability, 2)});
    }

    page_.beginGrid();
    page_.chart(diagonalChart("Share right over probability", "mean probability", "share right", points),
                fmt::format("{} candidates that were reported or rejected, in {} bins of equal count; "
                            "expected calibration error {}",
                            all.size(), bins.size(), fixed(calibrationError(bins), 3)));

    const auto curve = precisionRecall(run_.judged, run_.outcomes);
    if (!curve.empty()) precisionChart(curve);
    page_.endGrid();
  }

  void precisionChart(const std::vector<PrecisionRecallPoint>& curve) {
    std::vector<ChartPoint> line, marked;
    for (const PrecisionRecallPoint& point : curve) line.push_back({point.recall, point.precision, 0, 0, ""});
    for (const double score : {0.9, run_.limits.accept_probability, 0.1}) {
      // The last point of at least this score.
      const auto below = std::find_if(curve.begin(), curve.end(),
                                      [&](const PrecisionRecallPoint& p) { return p.score < score; });
      if (below == curve.begin()) continue;
      const PrecisionRecallPoint& at = *(below - 1);
      marked.push_back({at.recall, at.precision, 0, 0, "p \u2265 " + shortNumber(score)});
    }
    page_.chart(
        curveChart("Precision over recall", "recall of the wanted instances", "precision", line, marked),
        "Over the probability from which a candidate counts; accepted are those of at least " +
            shortNumber(run_.limits.accept_probability));
  }

  void missedCases() {
    const auto in_frame = [this](const TruthOutcome& truth) { return cards_.inFrame(truth); };
    const auto missed = missedObjects(run_.split, run_.models, run_.outcomes, run_.judged, run_.traced,
                                      run_.limits, in_frame);
    page_.heading("Missed", "missed");
    intro(missed.size(), "wanted instances were missed", "the most visible and largest first");
    page_.legend(caseColours());
    page_.beginGrid(true);
    for (size_t k = 0; k < std::min(missed.size(), size_t(options_.cases)); ++k)
      page_.card(cards_.missed(missed[k]));
    page_.endGrid();
  }

  void wrongCases() {
    const auto wrong = wrongAccepts(run_.split, run_.models, run_.outcomes, run_.judged);
    page_.heading("Wrong", "wrong");
    intro(wrong.size(), "reported poses are wrong", "the surest first");
    page_.beginGrid(true);
    for (size_t k = 0; k < std::min(wrong.size(), size_t(options_.cases)); ++k)
      page_.card(cards_.wrong(wrong[k]));
    page_.endGrid();
  }

  void intro(size_t count, const std::string& what, const std::string& order) {
    std::string text = fmt::format("{} {}", count, what);
    if (count > size_t(options_.cases)) text += fmt::format("; the first {} are shown", options_.cases);
    page_.paragraph(text + (count > 1 ? ", " + order + "." : "."));
  }

  std::string partName(int object) const {
    const auto at = run_.models.find(object);
    return at == run_.models.end() ? fmt::format("object {}", object) : at->second.name;
  }

  const std::string& folder_;
  const EvaluatedRun& run_;
  const std::optional<OtherRun>& other_;
  const EvaluationPageOptions& options_;
  HtmlPage page_;
  CaseCards cards_;
};

}  // namespace

void EvaluationPageOptions::check() const {
  if (cases < 0 || cases > 1000)
    throw BadInput(fmt::format("evaluation page options: cases = {} must be 0..1000", cases));
}

std::string writeEvaluationPage(const std::string& folder, const EvaluatedRun& run,
                                const std::optional<OtherRun>& other, const EvaluationPageOptions& options) {
  options.check();
  createFolder(folder);
  return EvaluationPageWriter(folder, run, other, options).write();
}

}  // namespace monocular_eye_hand
