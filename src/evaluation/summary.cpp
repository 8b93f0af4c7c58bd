#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "monocular_eye_hand/evaluation/error_meter.h"
#include "monocular_eye_hand/evaluation/pose_error.h"
#include "monocular_eye_hand/evaluation/scores.h"

namespace monocular_eye_hand {
namespace {

constexpr double kSymmetryStep = 0.05;
constexpr double kRightError = 10;       // MSPD [px]
constexpr double kWantedVisible = 0.5;   // for `found`
constexpr double kCountedVisible = 0.1;  // for AR
constexpr double kFarDiameters = 2;
constexpr PoseErrors kNoMatch{std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};

double meanRecall(const PoseErrors& errors) {
  const auto share = [](double error, const std::vector<double>& thresholds) {
    const auto below =
        std::count_if(thresholds.begin(), thresholds.end(), [&](double th) { return error < th; });
    return double(below) / double(thresholds.size());
  };
  return (share(errors.mssd, mssdThresholds()) + share(errors.mspd, mspdThresholds())) / 2;
}

// errors[row][truth]; not a match: infinite.
std::vector<std::vector<PoseErrors>> pairErrors(const BopImage& image, const std::vector<BopResult>& rows,
                                                const ErrorMeter& meter) {
  std::vector<std::vector<PoseErrors>> errors(rows.size(), {image.truth.size(), kNoMatch});
  for (size_t a = 0; a < rows.size(); ++a)
    for (size_t b = 0; b < image.truth.size(); ++b) {
      const GroundTruth& truth = image.truth[b];
      const Rigid3& estimate = rows[a].camera_from_object;
      if (truth.object != rows[a].object) continue;
      const double distance = (estimate.translation - truth.camera_from_object.translation).norm();
      if (distance > kFarDiameters * meter.model(truth.object).diameter) continue;
      errors[a][b] = meter.measure(image, truth, estimate);
    }
  return errors;
}

// For each truth the errors of the row matched to it: one-to-one, smallest MSPD first.
std::vector<PoseErrors> matchSmallestFirst(const std::vector<std::vector<PoseErrors>>& errors,
                                           size_t truths) {
  std::vector<std::pair<size_t, size_t>> pairs;
  for (size_t a = 0; a < errors.size(); ++a)
    for (size_t b = 0; b < truths; ++b)
      if (std::isfinite(errors[a][b].mspd)) pairs.emplace_back(a, b);
  std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& p, const auto& q) {
    return errors[p.first][p.second].mspd < errors[q.first][q.second].mspd;
  });
  std::vector<bool> row_taken(errors.size()), truth_taken(truths);
  std::vector<PoseErrors> matched(truths, kNoMatch);
  for (const auto& [a, b] : pairs) {
    if (row_taken[a] || truth_taken[b]) continue;
    row_taken[a] = truth_taken[b] = true;
    matched[b] = errors[a][b];
  }
  return matched;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// Sums of one scene.
struct SceneTally {
  SceneSummary summary;
  double recall = 0;
  int counted = 0;
  std::vector<double> times;

  void add(const BopImage& image, const std::vector<BopResult>& rows, const ErrorMeter& meter) {
    const auto errors = pairErrors(image, rows, meter);
    summary.rows += int(rows.size());
    for (const auto& row : errors)
      summary.right +=
          std::any_of(row.begin(), row.end(), [](const PoseErrors& e) { return e.mspd < kRightError; });
    const std::vector<PoseErrors> matched = matchSmallestFirst(errors, image.truth.size());
    for (size_t b = 0; b < matched.size(); ++b) {
      const double visible = image.truth[b].visible;
      if (visible >= kWantedVisible) {
        ++summary.wanted;
        summary.found += matched[b].mspd < kRightError;
      }
      if (visible >= kCountedVisible) {
        ++counted;
        recall += meanRecall(matched[b]);
      }
    }
  }

  SceneSummary finish() {
    summary.ar = counted > 0 ? recall / counted : 0;
    summary.median_time = median(times);
    return summary;
  }
};

}  // namespace

std::vector<SceneSummary> summarize(const BopSplit& split, const BopModels& models,
                                    const std::vector<BopResult>& results, const ImageTimes& times) {
  const ErrorMeter meter(models, kSymmetryStep);
  const ResultsByImage table = byImage(results);
  std::map<int, SceneTally> tallies;
  const std::vector<BopResult> none;
  for (const BopImage& image : split.images) {
    const std::pair<int, int> key(image.scene, image.id);
    SceneTally& tally = tallies[image.scene];
    tally.summary.scene = image.scene;
    const auto found = table.find(key);
    const std::vector<BopResult>& rows = found == table.end() ? none : found->second;
    const auto time = times.find(key);
    if (time != times.end())
      tally.times.push_back(time->second);
    else if (!rows.empty())
      tally.times.push_back(rows.front().time);
    tally.add(image, rows, meter);
  }
  std::vector<SceneSummary> summaries;
  for (auto& entry : tallies) summaries.push_back(entry.second.finish());
  return summaries;
}

std::string summaryLine(const SceneSummary& s) {
  char text[200];
  std::snprintf(text, sizeof text, "scene %d: found %.3f (%d/%d) right %.3f (%d/%d) AR %.3f median %.3f s",
                s.scene, s.foundShare(), s.found, s.wanted, s.rightShare(), s.right, s.rows, s.ar,
                s.median_time);
  return text;
}

std::string summaryFigure(const std::vector<SceneSummary>& summaries) {
  std::string text = "found/right/AR/time ";
  for (size_t i = 0; i < summaries.size(); ++i) {
    const SceneSummary& s = summaries[i];
    char part[100];
    std::snprintf(part, sizeof part, "%s%d: %.2f/%.2f/%.2f/%.2fs", i ? " | " : "", s.scene, s.foundShare(),
                  s.rightShare(), s.ar, s.median_time);
    text += part;
  }
  return text;
}

}  // namespace monocular_eye_hand
