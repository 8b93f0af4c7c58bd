#include <fmt/format.h>

#include <map>

#include "monocular_eye_hand/evaluation/outcomes.h"
#include "monocular_eye_hand/evaluation/scores.h"
#include "monocular_eye_hand/evaluation/statistics.h"

namespace monocular_eye_hand {
namespace {

// Sums of one scene.
struct SceneTally {
  SceneSummary summary;
  double recall = 0;
  int counted = 0;
  std::vector<double> times;

  void add(const TruthOutcome& truth) {
    if (truth.wanted()) {
      ++summary.wanted;
      summary.found += truth.found();
    }
    if (truth.counted()) {
      ++counted;
      recall += truth.recall();
    }
  }

  void add(const RowOutcome& row) {
    ++summary.rows;
    summary.right += row.right();
  }

  SceneSummary finish(int scene) {
    summary.scene = scene;
    summary.ar = counted > 0 ? recall / counted : 0;
    summary.median_time = median(times);
    return summary;
  }
};

}  // namespace

ImageTimes timesOfImages(const BopSplit& split, const std::vector<BopResult>& results,
                         const ImageTimes& times) {
  ImageTimes known;
  for (const BopImage& image : split.images) {
    const auto time = times.find({image.scene, image.id});
    if (time != times.end()) known.insert(*time);
  }
  for (const BopResult& row : results)
    if (row.time >= 0 && split.find(row.scene, row.image)) known.insert({{row.scene, row.image}, row.time});
  return known;
}

std::vector<SceneSummary> summarize(const BopSplit& split, const BopModels& models,
                                    const std::vector<BopResult>& results, const ImageTimes& times) {
  const RunOutcomes outcomes = judgeRun(split, models, results);
  std::map<int, SceneTally> tallies;
  for (const BopImage& image : split.images) tallies[image.scene];
  for (const TruthOutcome& truth : outcomes.truths) tallies[truth.scene].add(truth);
  for (const RowOutcome& row : outcomes.rows) tallies[row.scene].add(row);
  for (const auto& [key, seconds] : timesOfImages(split, results, times))
    tallies[key.first].times.push_back(seconds);
  std::vector<SceneSummary> summaries;
  for (auto& [scene, tally] : tallies) summaries.push_back(tally.finish(scene));
  return summaries;
}

std::string summaryLine(const SceneSummary& s) {
  return fmt::format("scene {}: found {:.3f} ({}/{}) right {:.3f} ({}/{}) AR {:.3f} median {:.3f} s", s.scene,
                     s.foundShare(), s.found, s.wanted, s.rightShare(), s.right, s.rows, s.ar, s.median_time);
}

std::string summaryFigure(const std::vector<SceneSummary>& summaries) {
  std::string text = "found/right/AR/time ";
  for (size_t i = 0; i < summaries.size(); ++i) {
    const SceneSummary& s = summaries[i];
    text += fmt::format("{}{}: {:.2f}/{:.2f}/{:.2f}/{:.2f}s", i ? " | " : "", s.scene, s.foundShare(),
                        s.rightShare(), s.ar, s.median_time);
  }
  return text;
}

}  // namespace monocular_eye_hand
