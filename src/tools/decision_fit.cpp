#include "decision_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMostSteps = 60;
constexpr double kStretchPrior = 1;  // on shift and stretch: few chosen ones change them little
constexpr double kLongestStep = 3;   // of any weight of a standardised term, in one step

// Near copies share the weight of one: n of them count sqrt(n) together.
std::vector<double> sampleWeights(const std::vector<JudgedSample>& samples) {
  using Group = std::tuple<std::string, std::string, std::string>;
  const auto groupOf = [](const JudgedSample& s) { return Group{s.image, s.part, s.right ? s.truth : ""}; };
  std::map<Group, int> sizes;
  for (const JudgedSample& sample : samples) ++sizes[groupOf(sample)];

  std::vector<double> weights;
  for (const JudgedSample& sample : samples) weights.push_back(1 / std::sqrt(double(sizes[groupOf(sample)])));
  return weights;
}

double logistic(double x) { return 1 / (1 + std::exp(-std::clamp(x, -30.0, 30.0))); }

// Samples as a matrix of standardised terms.
struct Regression {
  Eigen::MatrixXd terms;  // one row per sample
  Eigen::VectorXd right, weight;
  Eigen::RowVectorXd mean, scale;
};

Regression standardised(const std::vector<JudgedSample>& samples) {
  const Eigen::Index rows = Eigen::Index(samples.size()), columns = Eigen::Index(decisionTerms().size());
  Regression r;
  r.terms.resize(rows, columns);
  r.right.resize(rows);
  const std::vector<double> weights = sampleWeights(samples);
  r.weight = Eigen::Map<const Eigen::VectorXd>(weights.data(), rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    r.terms.row(i) = Eigen::Map<const Eigen::RowVectorXd>(samples[size_t(i)].values.data(), columns);
    r.right[i] = samples[size_t(i)].right;
  }

  const double total = r.weight.sum();
  r.mean = r.weight.transpose() * r.terms / total;
  r.terms.rowwise() -= r.mean;
  r.scale = (r.weight.transpose() * r.terms.cwiseAbs2() / total).cwiseSqrt();
  for (Eigen::Index k = 0; k < columns; ++k) r.scale[k] = std::max(r.scale[k], 1e-9);
  r.terms.array().rowwise() /= r.scale.array();
  return r;
}

// Bias first, then the weights of the standardised terms: Newton's method on the penalised likelihood.
Eigen::VectorXd solve(const Regression& r, double ridge) {
  const Eigen::Index rows = r.terms.rows(), columns = r.terms.cols() + 1;
  Eigen::MatrixXd a(rows, columns);
  a << Eigen::VectorXd::Ones(rows), r.terms;
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(columns, ridge);
  penalty[0] = 1e-9;

  Eigen::VectorXd solution = Eigen::VectorXd::Zero(columns);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd p = (a * solution).unaryExpr(&logistic);
    const Eigen::VectorXd curvature = r.weight.cwiseProduct(p.cwiseProduct(Eigen::VectorXd::Ones(rows) - p));
    Eigen::MatrixXd hessian = a.transpose() * curvature.asDiagonal() * a;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd gradient =
        a.transpose() * r.weight.cwiseProduct(r.right - p) - penalty.cwiseProduct(solution);
    const Eigen::VectorXd move = hessian.ldlt().solve(gradient);
    const double longest = move.cwiseAbs().maxCoeff();
    solution += move * std::min(1.0, kLongestStep / std::max(longest, 1e-30));
    if (longest < 1e-9) break;
  }
  return solution;
}

// Mean over right candidates: what one expects to see of the part.
std::vector<double> typicalValues(const std::vector<JudgedSample>& samples) {
  const std::vector<double> weights = sampleWeights(samples);
  std::vector<double> typical(decisionTerms().size(), 0);
  double total = 0;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].right) continue;
    total += weights[i];
    for (size_t k = 0; k < typical.size(); ++k) typical[k] += weights[i] * samples[i].values[k];
  }
  for (double& value : typical) value /= total;
  return typical;
}

// Parts dealt out in the order of their names.
std::map<std::string, int> foldOfPart(const std::vector<JudgedSample>& samples, int folds) {
  std::map<std::string, int> fold;
  for (const JudgedSample& sample : samples) fold.emplace(sample.part, 0);
  int next = 0;
  for (auto& [part, number] : fold) number = next++ % folds;
  return fold;
}

}  // namespace

void DecisionFitOptions::check() const {
  if (!(ridge >= 0))
    throw BadInput("decision fit: ridge = " + std::to_string(ridge) + " must not be negative");
  if (folds < 2) throw BadInput("decision fit: folds = " + std::to_string(folds) + " must be at least 2");
}

DecisionWeights fitDecision(const std::vector<JudgedSample>& samples, const DecisionFitOptions& options) {
  options.check();
  const auto right = std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.right; });
  if (right == 0 || right == long(samples.size()))
    throw BadInput("of " + std::to_string(samples.size()) + " candidates " + std::to_string(right) +
                   " are right: a fit needs right and wrong ones");

  const Regression r = standardised(samples);
  const Eigen::VectorXd solution = solve(r, options.ridge);
  const std::vector<double> typical = typicalValues(samples);
  DecisionWeights weights;
  weights.bias = solution[0];
  for (size_t k = 0; k < typical.size(); ++k) {
    const Eigen::Index column = Eigen::Index(k);
    weights.terms[k] = {solution[column + 1] / r.scale[column], typical[k]};
    weights.bias -= weights.terms[k].weight * r.mean[column];
  }
  return weights;
}

std::vector<double> probabilitiesLeftOut(const std::vector<JudgedSample>& samples,
                                         const DecisionFitOptions& options) {
  options.check();
  const std::map<std::string, int> fold = foldOfPart(samples, options.folds);
  std::vector<double> probabilities(samples.size());
  for (int left_out = 0; left_out < options.folds; ++left_out) {
    std::vector<JudgedSample> seen;
    for (const JudgedSample& sample : samples)
      if (fold.at(sample.part) != left_out) seen.push_back(sample);
    if (seen.size() == samples.size()) continue;  // fewer parts than folds

    const DecisionWeights weights = fitDecision(seen, options);
    for (size_t i = 0; i < samples.size(); ++i)
      if (fold.at(samples[i].part) == left_out) probabilities[i] = weights.probability(samples[i].values);
  }
  return probabilities;
}

std::vector<size_t> chosenSamples(const std::vector<JudgedSample>& samples,
                                  const std::vector<double>& probabilities) {
  std::map<std::string, std::vector<size_t>> images;
  for (size_t i = 0; i < samples.size(); ++i) images[samples[i].image].push_back(i);

  const auto rank = [&](size_t i) { return samples[i].rank_base * (probabilities[i] + 0.05); };
  std::vector<size_t> all_chosen;
  for (auto& [image, order] : images) {
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return rank(a) > rank(b); });
    std::set<int> chosen;
    for (size_t i : order) {
      const std::vector<int>& conflicts = samples[i].conflicts;
      if (std::any_of(conflicts.begin(), conflicts.end(), [&](int k) { return chosen.count(k) > 0; }))
        continue;
      chosen.insert(samples[i].index);
      all_chosen.push_back(i);
    }
  }
  return all_chosen;
}

DecisionWeights calibratedOnChosen(DecisionWeights weights, const std::vector<JudgedSample>& samples,
                                   const std::vector<double>& left_out) {
  const std::vector<size_t> chosen = chosenSamples(samples, left_out);
  Eigen::Vector2d line(0, 1);  // shift and stretch of the log-odds
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::Matrix2d hessian = kStretchPrior * Eigen::Matrix2d::Identity();
    Eigen::Vector2d gradient = -kStretchPrior * (line - Eigen::Vector2d(0, 1));
    for (size_t i : chosen) {
      const double p = std::clamp(left_out[i], 1e-6, 1 - 1e-6);
      const Eigen::Vector2d a(1, std::log(p / (1 - p)));
      const double q = logistic(a.dot(line));
      gradient += (samples[i].right - q) * a;
      hessian += q * (1 - q) * a * a.transpose();
    }
    const Eigen::Vector2d move = hessian.ldlt().solve(gradient);
    line += move;
    if (move.cwiseAbs().maxCoeff() < 1e-9) break;
  }

  weights.bias = line[0] + line[1] * weights.bias;
  for (TermWeight& term : weights.terms) term.weight *= line[1];
  return weights;
}

double calibrationError(const std::vector<double>& probabilities, const std::vector<JudgedSample>& samples,
                        int bins) {
  std::vector<size_t> order(samples.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return probabilities[a] < probabilities[b]; });
  double error = 0;
  for (int bin = 0; bin < bins; ++bin) {
    const size_t begin = order.size() * size_t(bin) / size_t(bins);
    const size_t end = order.size() * size_t(bin + 1) / size_t(bins);
    double difference = 0;
    for (size_t k = begin; k < end; ++k) difference += probabilities[order[k]] - samples[order[k]].right;
    error += std::abs(difference);
  }
  return samples.empty() ? 0 : error / double(samples.size());
}

}  // namespace monocular_eye_hand
