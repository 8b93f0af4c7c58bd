#include "tools/decision_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxSteps = 60;
constexpr double kContestPrior = 1;  // on the weights of the standardised differences
constexpr double kLeadPrior = 1;     // on the weights of the lead: few chosen ones change them little
constexpr double kLongestStep = 3;   // of any weight of a standardised term, in one step

// Near copies share the weight of one: n of them count sqrt(n) together. What is undecidable counts nothing.
std::vector<double> sampleWeights(const std::vector<JudgedSample>& samples) {
  using Group = std::tuple<std::string, std::string, std::string>;
  const auto groupOf = [](const JudgedSample& s) { return Group{s.image, s.part, s.right ? s.truth : ""}; };
  std::map<Group, int> sizes;
  for (const JudgedSample& sample : samples)
    if (!sample.undecidable) ++sizes[groupOf(sample)];

  std::vector<double> weights;
  for (const JudgedSample& sample : samples)
    weights.push_back(sample.undecidable ? 0 : 1 / std::sqrt(double(sizes[groupOf(sample)])));
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

// Newton's method on the penalised likelihood; `penalty` draws the solution to `start`.
Eigen::VectorXd logisticFit(const Eigen::MatrixXd& a, const Eigen::VectorXd& right,
                            const Eigen::VectorXd& weight, const Eigen::VectorXd& penalty,
                            const Eigen::VectorXd& start) {
  Eigen::VectorXd solution = start;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::VectorXd p = (a * solution).unaryExpr(&logistic);
    const Eigen::VectorXd curvature =
        weight.cwiseProduct(p.cwiseProduct(Eigen::VectorXd::Ones(a.rows()) - p));
    Eigen::MatrixXd hessian = a.transpose() * curvature.asDiagonal() * a;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd gradient =
        a.transpose() * weight.cwiseProduct(right - p) - penalty.cwiseProduct(solution - start);
    const Eigen::VectorXd move = hessian.ldlt().solve(gradient);
    const double longest = move.cwiseAbs().maxCoeff();
    solution += move * std::min(1.0, kLongestStep / std::max(longest, 1e-30));
    if (longest < 1e-9) break;
  }
  return solution;
}

// Bias first, then the weights of the standardised terms.
Eigen::VectorXd solve(const Regression& r, double ridge) {
  const Eigen::Index rows = r.terms.rows(), columns = r.terms.cols() + 1;
  Eigen::MatrixXd a(rows, columns);
  a << Eigen::VectorXd::Ones(rows), r.terms;
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(columns, ridge);
  penalty[0] = 1e-9;
  return logisticFit(a, r.right, r.weight, penalty, Eigen::VectorXd::Zero(columns));
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

std::map<std::string, std::vector<size_t>> samplesByImage(const std::vector<JudgedSample>& samples) {
  std::map<std::string, std::vector<size_t>> images;
  for (size_t i = 0; i < samples.size(); ++i) images[samples[i].image].push_back(i);
  return images;
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
  if (!(ridge >= 0)) throw BadInput(fmt::format("decision fit: ridge = {:g} must not be negative", ridge));
  if (folds < 2) throw BadInput(fmt::format("decision fit: folds = {} must be at least 2", folds));
}

DecisionWeights fitDecision(const std::vector<JudgedSample>& samples, const DecisionFitOptions& options) {
  options.check();
  const auto right = std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.right; });
  if (right == 0 || right == long(samples.size()))
    throw BadInput(fmt::format("of {} candidates {} are right: a fit needs right and wrong ones",
                               samples.size(), right));

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

std::vector<double> logOddsLeftOut(const std::vector<JudgedSample>& samples,
                                   const DecisionFitOptions& options) {
  options.check();
  const std::map<std::string, int> fold = foldOfPart(samples, options.folds);
  std::vector<double> log_odds(samples.size());
  for (int left_out = 0; left_out < options.folds; ++left_out) {
    std::vector<JudgedSample> seen;
    for (const JudgedSample& sample : samples)
      if (fold.at(sample.part) != left_out) seen.push_back(sample);
    if (seen.size() == samples.size()) continue;  // fewer parts than folds

    const DecisionWeights weights = fitDecision(seen, options);
    for (size_t i = 0; i < samples.size(); ++i)
      if (fold.at(samples[i].part) == left_out) log_odds[i] = weights.logOdds(samples[i].values);
  }
  return log_odds;
}

std::vector<size_t> chosenSamples(const std::vector<JudgedSample>& samples,
                                  const std::vector<double>& log_odds) {
  const auto rank = [&](size_t i) { return samples[i].rank_base * (logistic(log_odds[i]) + 0.05); };
  std::vector<size_t> all_chosen;
  for (auto [image, order] : samplesByImage(samples)) {
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

std::vector<Lead> leadsOf(const std::vector<JudgedSample>& samples, const std::vector<double>& log_odds) {
  std::vector<Lead> leads(samples.size());
  for (const auto& [image, members] : samplesByImage(samples)) {
    std::map<int, int> place_of_index;
    std::map<std::string, int> object_of_part;
    for (size_t k = 0; k < members.size(); ++k) {
      const JudgedSample& sample = samples[members[k]];
      place_of_index[sample.index] = int(k);
      object_of_part.emplace(sample.part, int(object_of_part.size()));
    }

    std::vector<Competitor> competitors;
    for (size_t i : members) {
      Competitor competitor{object_of_part.at(samples[i].part), log_odds[i], {}};
      for (int index : samples[i].conflicts) {
        const auto place = place_of_index.find(index);
        if (place != place_of_index.end()) competitor.conflicts.push_back(place->second);
      }
      competitors.push_back(std::move(competitor));
    }

    const std::vector<Lead> among = leadsAmong(competitors);
    for (size_t k = 0; k < members.size(); ++k) leads[members[k]] = among[k];
  }
  return leads;
}

LeadWeights fitLead(const std::vector<JudgedSample>& samples, const std::vector<double>& left_out) {
  using Row = Eigen::Matrix<double, 1, 5>;
  const std::vector<Lead> leads = leadsOf(samples, left_out);
  std::vector<size_t> teaching;
  for (size_t i : chosenSamples(samples, left_out))
    if (!samples[i].undecidable) teaching.push_back(i);

  const Eigen::Index rows = Eigen::Index(teaching.size());
  Eigen::MatrixXd regressors(rows, 5);
  Eigen::VectorXd right(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const size_t i = teaching[size_t(row)];
    regressors.row(row) =
        (Row() << 1, left_out[i], leads[i].over_most, leads[i].elsewhere, leads[i].in_place).finished();
    right[row] = samples[i].right;
  }

  const Eigen::VectorXd line =
      logisticFit(regressors, right, Eigen::VectorXd::Ones(rows), Eigen::VectorXd::Constant(5, kLeadPrior),
                  Eigen::VectorXd::Unit(5, 1));  // from the log-odds as they are
  const Eigen::RowVectorXd typical = right.transpose() * regressors / std::max(1.0, right.sum());
  return {line[0], line[1], {line[2], typical[2]}, {line[3], typical[3]}, {line[4], typical[4]}};
}

std::vector<DecidedContest> decidedContests(const std::vector<JudgedSample>& samples) {
  std::vector<DecidedContest> decided;
  for (const auto& [image, members] : samplesByImage(samples)) {
    std::map<int, size_t> sample_of_index;
    for (size_t i : members) sample_of_index[samples[i].index] = i;
    for (size_t i : members)
      for (auto [index, contest] : samples[i].contests) {
        const auto rival = sample_of_index.find(index);
        if (rival == sample_of_index.end() || samples[i].right == samples[rival->second].right) continue;
        if (!samples[i].right) contest.visit([](const char*, double& value) { value = -value; });
        decided.push_back({samples[i].part, contest});
      }
  }
  return decided;
}

ContestWeights fitContest(const std::vector<DecidedContest>& contests) {
  ContestWeights weights;
  if (contests.empty()) return weights;
  const Eigen::Index rows = Eigen::Index(contests.size()), columns = 5;
  Eigen::MatrixXd values(rows, columns);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const PoseContest& c = contests[size_t(row)].contest;
    values.row(row) << c.log_odds, c.precise, c.contrast, c.strength, c.shading;
  }
  const Eigen::VectorXd scale = (values.colwise().squaredNorm() / double(rows)).cwiseSqrt().cwiseMax(1e-9);
  values.array().rowwise() /= scale.transpose().array();

  const Eigen::VectorXd solution =
      logisticFit(values, Eigen::VectorXd::Ones(rows), Eigen::VectorXd::Ones(rows),
                  Eigen::VectorXd::Constant(columns, kContestPrior), Eigen::VectorXd::Zero(columns));
  const Eigen::VectorXd fitted = solution.cwiseQuotient(scale);
  weights.log_odds = fitted[0];
  weights.precise = fitted[1];
  weights.contrast = fitted[2];
  weights.strength = fitted[3];
  weights.shading = fitted[4];
  return weights;
}

}  // namespace monocular_eye_hand
