// Fits the weights of the decision to candidates with known truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "monocular_eye_hand/evaluation/outcomes.h"
#include "monocular_eye_hand/evaluation/statistics.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "tools/csv_table.h"
#include "tools/decision_fit.h"
#include "tools/support.h"

namespace monocular_eye_hand {
namespace {

struct Arguments {
  std::vector<std::string> dumps;
  std::string out, source, keep;
  DecisionFitOptions fit;
  double undecidable = 0.06;
};

// Columns of a dump that hold evidence terms.
std::map<std::string, int> termColumns(const CsvTable& table) {
  std::map<std::string, int> columns;
  for (const auto& term : EvidenceTerms().named()) columns[term.first] = table.column(term.first);
  return columns;
}

// Of a field "rival:value:value... rival:value...".
std::vector<std::pair<int, PoseContest>> parsedContests(const std::string& text) {
  std::vector<std::pair<int, PoseContest>> contests;
  std::istringstream list(text);
  for (std::string one; list >> one;) {
    std::istringstream fields(one);
    char colon;
    contests.emplace_back();
    fields >> contests.back().first;
    contests.back().second.visit([&](const char*, double& value) { fields >> colon >> value; });
    if (!fields) throw BadInput("the contest " + one + " is not that of a dump");
  }
  return contests;
}

void readDump(const std::string& path, double undecidable, std::vector<JudgedSample>* samples) {
  const CsvTable table(path);
  const std::map<std::string, int> terms = termColumns(table);
  const int scene = table.column("scene_id"), image = table.column("im_id"), name = table.column("name");
  const int truth = table.column("gt_id"), error = table.column("mspd_px"), adi = table.column("adi_d");
  const int index = table.column("candidate"), conflicts = table.column("conflicts");
  const int contests = table.column("contests");
  const int sum = table.column("sum");

  for (size_t row = 0; row < table.rows(); ++row) {
    JudgedSample sample;
    sample.image = path + " " + table.text(row, scene) + " " + table.text(row, image);
    sample.part = table.text(row, name);
    sample.right = !table.text(row, error).empty() && table.number(row, error) < kRightError;
    if (sample.right) sample.truth = table.text(row, truth);
    sample.undecidable = !sample.right && table.number(row, adi, 1) < undecidable;
    sample.index = int(table.number(row, index));

    std::istringstream list(table.text(row, conflicts));
    for (int other = 0; list >> other;) sample.conflicts.push_back(other);
    sample.contests = parsedContests(table.text(row, contests));
    sample.rank_base = std::sqrt(std::max(0.0, table.number(row, sum)));

    std::map<std::string, double> named;
    for (const auto& [term, column] : terms) named[term] = table.number(row, column);
    sample.values = decisionValues(evidenceTerms(named));
    samples->push_back(std::move(sample));
  }
}

void printReliability(const std::vector<Prediction>& predictions) {
  std::printf("probability   chosen   mean   right   (parts left out in turn)\n");
  const double edges[] = {0, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0001};
  for (size_t k = 0; k + 1 < std::size(edges); ++k) {
    double sum = 0, right = 0;
    int count = 0;
    for (const Prediction& prediction : predictions) {
      if (prediction.probability < edges[k] || prediction.probability >= edges[k + 1]) continue;
      ++count;
      sum += prediction.probability;
      right += prediction.right;
    }
    if (count)
      std::printf("%.2f - %.2f   %6d  %.3f   %.3f\n", edges[k], std::min(1.0, edges[k + 1]), count,
                  sum / count, right / count);
  }
  std::printf("expected calibration error %.4f\n", calibrationError(reliabilityBins(predictions)));
}

void printWeights(const DecisionWeights& weights, const std::vector<JudgedSample>& samples) {
  const size_t terms = weights.terms.size();
  std::vector<double> spread(terms, 0);
  for (size_t k = 0; k < terms; ++k) {
    double sum = 0, squares = 0;
    for (const JudgedSample& sample : samples) {
      sum += sample.values[k];
      squares += sample.values[k] * sample.values[k];
    }
    const double mean = sum / double(samples.size());
    spread[k] = std::sqrt(std::max(0.0, squares / double(samples.size()) - mean * mean));
  }

  std::vector<size_t> order(terms);
  std::iota(order.begin(), order.end(), size_t(0));
  const auto strength = [&](size_t k) { return std::abs(weights.terms[k].weight) * spread[k]; };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return strength(a) > strength(b); });
  std::printf("log-odds per standard deviation:\n");
  for (size_t k : order)
    std::printf("  %+.2f  %s\n", weights.terms[k].weight * spread[k], decisionTerms()[k].name);
}

// What the decision would come to with log-odds that have not seen the part.
void printChosen(const std::vector<JudgedSample>& samples, const std::vector<double>& left_out,
                 const DecisionWeights& weights) {
  const std::vector<Lead> leads = leadsOf(samples, left_out);
  std::vector<Prediction> predictions;
  int accepted = 0, right = 0;
  std::set<std::pair<std::string, std::string>> found, there;
  for (const JudgedSample& sample : samples)
    if (sample.right) there.insert({sample.image, sample.truth});

  for (size_t i : chosenSamples(samples, left_out)) {
    const double probability = weights.probability(left_out[i], leads[i]);
    if (!samples[i].undecidable) predictions.push_back({probability, samples[i].right});
    if (probability < 0.5) continue;
    ++accepted;
    right += samples[i].right;
    if (samples[i].right) found.insert({samples[i].image, samples[i].truth});
  }

  printReliability(predictions);
  std::printf(
      "of the chosen at 0.5 and above: %d right of %d; %zu of %zu instances that have a right candidate\n",
      right, accepted, found.size(), there.size());
}

// How contests come out by weights that have not seen the part.
void printContests(const std::vector<DecidedContest>& contests, int folds) {
  std::map<std::string, int> fold;
  for (const DecidedContest& contest : contests) fold.emplace(contest.part, int(fold.size()) % folds);

  int won = 0, sure = 0, sure_won = 0;
  double loss = 0;
  for (int left_out = 0; left_out < folds; ++left_out) {
    std::vector<DecidedContest> seen;
    for (const DecidedContest& c : contests)
      if (fold.at(c.part) != left_out) seen.push_back(c);
    const ContestWeights weights = fitContest(seen);

    for (const DecidedContest& c : contests) {
      if (fold.at(c.part) != left_out) continue;
      const double log_odds = weights.logOdds(c.contest);
      won += log_odds > 0;
      sure += std::abs(log_odds) > std::log(4.0);
      sure_won += log_odds > std::log(4.0);
      loss += std::log1p(std::exp(-log_odds)) / double(contests.size());
    }
  }

  std::printf(
      "%zu contests of a right with a wrong pose: the right one preferred in %d, by 0.8 and more in %d of "
      "%d; "
      "mean loss %.3f (parts left out in turn)\n",
      contests.size(), won, sure_won, sure, loss);
}

int fitDecisionTool(const Arguments& args) {
  std::vector<JudgedSample> samples;
  for (const std::string& dump : args.dumps) readDump(dump, args.undecidable, &samples);
  const auto count = [&](bool JudgedSample::*flag) {
    return std::count_if(samples.begin(), samples.end(), [&](const JudgedSample& s) { return s.*flag; });
  };
  std::printf("%zu candidates, %ld right; %ld wrong ones left out that no image tells from the truth\n",
              samples.size(), long(count(&JudgedSample::right)), long(count(&JudgedSample::undecidable)));

  DecisionWeights weights;
  if (args.keep.empty()) {
    const std::vector<double> left_out = logOddsLeftOut(samples, args.fit);
    weights = fitDecision(samples, args.fit);
    weights.lead = fitLead(samples, left_out);
    printWeights(weights, samples);
    printChosen(samples, left_out, weights);
  } else {
    readOptions(loadYaml(args.keep), &weights);
  }
  const std::vector<DecidedContest> contests = decidedContests(samples);
  weights.contest = fitContest(contests);
  printContests(contests, args.fit.folds);
  weights.source += (weights.source.empty() ? "" : "; ") + args.source;

  std::ofstream file(args.out);
  file
      << "# Weights of the evidence in the log-odds that a candidate is right, written by fit_decision. They "
         "belong\n"
         "# together. weight: per unit of the term; typical: its mean over the right candidates of the fit.\n"
      << toYaml(writeOptions(weights));
  file.close();
  if (!file) throw BadInput(args.out + ": cannot be written");
  std::printf("written: %s\n", args.out.c_str());
  return 0;
}

}  // namespace
}  // namespace monocular_eye_hand

int main(int argc, char** argv) {
  using namespace monocular_eye_hand;
  Arguments args;
  CLI::App app(
      "Fits the weights of the decision to dumps of `evaluate --dump`, scenes of your own parts for example. "
      "The file it writes is given to the tools by --decision, to the node by its parameter "
      "recognition/decision.",
      "fit_decision");

  app.add_option("dumps", args.dumps, "CSV files of evaluate --dump")->required()->check(CLI::ExistingFile);
  app.add_option("--out", args.out, "YAML of the weights")->required();
  app.add_option("--source", args.source, "when and on what they were fitted, kept in the file");
  app.add_option(
         "--keep", args.keep,
         "weights that are kept but for those of the contests: for dumps of `evaluate --proposals truth`")
      ->check(CLI::ExistingFile);
  app.add_option("--ridge", args.fit.ridge, "penalty on the weights of standardised terms")
      ->capture_default_str();
  app.add_option("--folds", args.fit.folds, "groups of parts that are left out in turn for the reliability")
      ->capture_default_str();
  app.add_option(
         "--undecidable", args.undecidable,
         "wrong poses whose surface lies nearer than this to the true one's, as a share of the diameter, "
         "are left out of the fit")
      ->capture_default_str();

  int exit_code = 0;
  if (!parseArguments(&app, argc, argv, &exit_code)) return exit_code;
  return runTool("fit_decision", [&] { return fitDecisionTool(args); });
}
