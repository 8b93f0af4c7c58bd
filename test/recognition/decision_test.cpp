#include "recognition/decision.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <random>

#include "monocular_eye_hand/options/options.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

DecisionWeights onlyWeight(size_t term, double weight) {
  DecisionWeights weights;
  weights.terms[term].weight = weight;
  return weights;
}

// The middle of what the terms are bounded to.
EvidenceTerms middleTerms(double share) {
  EvidenceTerms t;
  t.visit([&](const char*, double& value) { value = share; });
  for (double* count :
       {&t.sum, &t.groups, &t.faces, &t.inner_found, &t.contrast, &t.rel_contrast, &t.blur, &t.complexity})
    *count = 1 + 4 * share;
  t.size = 20 + 100 * share;
  return t;
}

// What a well seen object looks like.
EvidenceTerms goodTerms() {
  EvidenceTerms t;
  t.sum = 120;
  t.mean = 1.6;
  t.hit_ratio = 0.95;
  t.silhouette_hits = 0.96;
  t.crease_hits = 0.93;
  t.groups = 16;
  t.unsupported = 0.03;
  t.unsupported_length = 0.01;
  t.continuation = 0.02;
  t.overhang = 0.05;
  t.interior = 0.02;
  t.solidity = 0.9;
  t.faces = 5;
  t.size = 100;
  t.contrast = 8;
  t.in_frame = 1;
  t.rms = 0.4;
  t.claimed_ratio = 0.98;
  t.slant = 0.005;
  t.linked = 0.95;
  t.jitter = 0.2;
  t.run = 0.3;
  t.polarity = 0.98;
  t.blur = 1.2;
  t.rel_contrast = 1.2;
  t.outline_hits = 0.96;
  t.inner_share = 0.5;
  t.inner_hits = 0.93;
  t.inner_features = 8;
  t.inner_found = 8;
  t.features_found = 1;
  t.chance = 0.2;
  t.chance_mean = 0.1;
  t.chance_inner = 0.1;
  t.excess = 1.5;
  t.repeated = 0.2;
  t.view_area = 0.8;
  t.extent = 0.9;
  t.complexity = 1.8;
  t.offset = 0.15;
  t.precise_features = 12;
  t.shading = 0.8;
  return t;
}

TEST(DecisionTerms, HaveNamesOfTheirOwnAndWords) {
  std::set<std::string> names, words;
  for (const DecisionTerm& term : decisionTerms()) {
    names.insert(term.name);
    words.insert(term.words);
  }
  EXPECT_EQ(names.size(), decisionTerms().size());
  EXPECT_EQ(words.size(), decisionTerms().size());
}

TEST(DecisionTerms, GrowWithTheirEvidenceAndAreBounded) {
  const std::vector<double> low = decisionValues(middleTerms(0.2)), high = decisionValues(middleTerms(0.3));
  EvidenceTerms huge;
  huge.visit([](const char*, double& value) { value = 1e9; });
  const std::vector<double> most = decisionValues(huge);
  for (size_t k = 0; k < low.size(); ++k) {
    EXPECT_GT(high[k], low[k]) << decisionTerms()[k].name;
    if (std::string(decisionTerms()[k].name).rfind("log_", 0) == 0) {
      EXPECT_LT(most[k], std::log(1000)) << decisionTerms()[k].name << " is not bounded";
    }
  }
}

TEST(Probability, EachWeightMovesItByItsOwnTermInTheDirectionOfItsSign) {
  for (size_t k = 0; k < decisionTerms().size(); ++k) {
    const EvidenceTerms low = middleTerms(0.2), high = middleTerms(0.3);
    EXPECT_GT(onlyWeight(k, 2).probability(decisionValues(high)),
              onlyWeight(k, 2).probability(decisionValues(low)))
        << decisionTerms()[k].name;
    EXPECT_LT(onlyWeight(k, -2).probability(decisionValues(high)),
              onlyWeight(k, -2).probability(decisionValues(low)))
        << decisionTerms()[k].name;
  }
}

TEST(Probability, OfTheFittedWeightsSeparatesAGoodFromAnEmptyPose) {
  EXPECT_GT(fittedWeights().probability(decisionValues(goodTerms())), 0.9);
  EvidenceTerms empty;
  empty.unsupported = empty.unsupported_length = empty.outline_bare = empty.inner_bare = 1;
  empty.in_frame = 1;
  empty.rms = 2;
  empty.size = 60;
  EXPECT_LT(fittedWeights().probability(decisionValues(empty)), 0.01);
}

TEST(Probability, StaysBetween0And1ForAnyFiniteTerms) {
  for (double scale : {-1e6, -1.0, 0.0, 1e6}) {
    EvidenceTerms t;
    t.visit([&](const char*, double& value) { value = scale; });
    const double p = fittedWeights().probability(decisionValues(t));
    EXPECT_GE(p, 0) << scale;
    EXPECT_LE(p, 1) << scale;
  }
}

TEST(FittedWeights, AreThoseOfTheShippedFileAndTellTheirSource) {
  const auto file =
      loadOptions<DecisionWeights>(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/decision.yaml");
  EXPECT_EQ(writeOptions(file), writeOptions(fittedWeights()));
  EXPECT_FALSE(fittedWeights().source.empty());
  int used = 0;
  for (const TermWeight& term : fittedWeights().terms) used += term.weight != 0;
  EXPECT_GT(used, 10);
}

TEST(FittedWeights, ThatAreNotFiniteAreRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const DecisionWeights& weights, const std::string& word) {
    EXPECT_THAT(refusal([&] { weights.check(); }), testing::HasSubstr(word));
  };
  DecisionWeights term = fittedWeights(), lead = term, contest = term;
  term.terms[0].weight = nan;
  refused(term, decisionTerms()[0].name);
  lead.lead.own = nan;
  refused(lead, "lead");
  contest.contest.shading = nan;
  refused(contest, "contest");
}

TEST(Contributions, AddUpToTheDifferenceFromATypicalCandidate) {
  const DecisionWeights weights = fittedWeights();
  std::vector<double> typical;
  for (const TermWeight& term : weights.terms) typical.push_back(term.typical);
  const std::vector<double> values = decisionValues(middleTerms(0.4));
  const Lead lead{3, 1, -0.5};
  const Lead usual{weights.lead.over_most.typical, weights.lead.elsewhere.typical,
                   weights.lead.in_place.typical};

  const std::vector<TermContribution> all = contributions(values, lead, weights);
  double sum = 0;
  for (const TermContribution& c : all) sum += c.log_odds;
  EXPECT_NEAR(
      sum, weights.logOdds(weights.logOdds(values), lead) - weights.logOdds(weights.logOdds(typical), usual),
      1e-6);
  for (size_t k = 1; k < all.size(); ++k) EXPECT_GE(all[k - 1].log_odds, all[k].log_odds);
  EXPECT_EQ(inWords({"hits", 0.5, 0.25, 1.5}), "hits 0.25 (usually 1.50)");
}

TEST(LeadWeights, ByDefaultLeaveTheProbabilityAsItIs) {
  DecisionWeights weights = fittedWeights();
  weights.lead = {};
  for (double log_odds : {-9.0, 0.0, 3.0}) EXPECT_EQ(weights.logOdds(log_odds, {-2, 8, 3}), log_odds);
}

TEST(LeadWeights, NoProbabilityClaimsMoreThanAFitCanKnow) {
  EXPECT_LT(fittedWeights().probability(60, {8, 8, 8}), 0.9992);
  EXPECT_GT(fittedWeights().probability(60, {8, 8, 8}), 0.999);
}

TEST(LeadWeights, ThatWereFittedFavourWhatStandsOut) {
  const DecisionWeights weights = fittedWeights();
  const double among_equals = weights.probability(0, {0, 0, 0}), alone = weights.probability(0, {8, 8, 8});
  EXPECT_GT(alone, 0.5);
  EXPECT_LT(among_equals, 0.2);
}

TEST(LeadWeights, AmongManyModelsEachIsLessLikelyFromTheStart) {
  const DecisionWeights fitted = fittedWeights();
  for (int models : {1, 3, 5}) EXPECT_EQ(amongModels(fitted, models).lead.bias, fitted.lead.bias) << models;
  const double twenty = amongModels(fitted, 20).lead.bias, hundred = amongModels(fitted, 100).lead.bias;
  EXPECT_LT(twenty, fitted.lead.bias);
  EXPECT_NEAR(hundred - twenty, -0.5 * std::log(5), 1e-12);
}

TEST(RankScore, MoreEvidenceAndProbabilityLiftIt) {
  Candidate base;
  base.terms = goodTerms();
  base.probability = 0.8;
  const double score = rankScore(base);
  EXPECT_GT(score, 0);
  const auto changed = [&](auto&& change) {
    Candidate c = base;
    change(&c);
    return rankScore(c);
  };
  EXPECT_GT(changed([](Candidate* c) { c->terms.sum *= 1.5; }), score);
  EXPECT_GT(changed([](Candidate* c) { c->probability = 0.95; }), score);
  EXPECT_LT(changed([](Candidate* c) { c->probability = 0.1; }), score);
  EXPECT_EQ(changed([](Candidate* c) { c->terms.sum = -1; }), 0);
}

// A candidate that covers the cells and claims the edge points first .. first + count.
Candidate candidate(double strength, int first_cell, int cells, int first_point, int points) {
  Candidate c;
  c.terms = goodTerms();
  c.terms.sum = strength;
  c.probability = 0.8;
  c.covered.resize(size_t(cells));
  std::iota(c.covered.begin(), c.covered.end(), first_cell);
  c.claimed.resize(size_t(points));
  std::iota(c.claimed.begin(), c.claimed.end(), first_point);
  return c;
}

TEST(WeighAmongOthers, OfEqualCandidatesTheOneWithoutARivalIsLikelier) {
  std::vector<Candidate> candidates{candidate(50, 0, 100, 0, 60), candidate(50, 20, 100, 200, 60),
                                    candidate(50, 500, 100, 400, 60)};
  candidates = weighAmongOthers(std::move(candidates), fittedWeights());
  EXPECT_EQ(candidates[0].lead.in_place, 0) << "the second one lies in its place";
  EXPECT_EQ(candidates[1].lead.in_place, 0);
  EXPECT_EQ(candidates[2].lead.in_place, 8) << "nothing else is there";
  EXPECT_GT(candidates[2].probability, candidates[0].probability);
}

TEST(ChooseExplanations, ApartAllAreChosenTheBestFirst) {
  const std::vector<Candidate> candidates{candidate(50, 0, 100, 0, 60), candidate(90, 200, 100, 100, 60),
                                          candidate(70, 400, 100, 200, 60)};
  const auto chosen = chooseExplanations(candidates);
  ASSERT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen[0].candidate, 1);
  EXPECT_EQ(chosen[1].candidate, 2);
  EXPECT_EQ(chosen[2].candidate, 0);
  for (const Explanation& e : chosen) EXPECT_THAT(e.rivals, IsEmpty());
}

TEST(ChooseExplanations, WhoCoversTheSameFacesIsARivalOfTheBestInOrderOfRank) {
  const std::vector<Candidate> candidates{candidate(50, 10, 100, 0, 60), candidate(90, 0, 100, 100, 60),
                                          candidate(70, 20, 100, 200, 60), candidate(80, 500, 100, 300, 60)};
  const auto chosen = chooseExplanations(candidates);
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].candidate, 1);
  EXPECT_THAT(chosen[0].rivals, ElementsAre(2, 0));
  EXPECT_EQ(chosen[1].candidate, 3);
}

TEST(ChooseExplanations, OverlapCountsByTheSmallerOne) {
  // A part of the large object: all of its cells are covered, only a tenth of the large one's.
  const auto inside = chooseExplanations({candidate(90, 0, 500, 0, 200), candidate(50, 100, 50, 500, 60)});
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_THAT(inside[0].rivals, ElementsAre(1));
  // Neighbours whose drawings touch.
  EXPECT_EQ(chooseExplanations({candidate(90, 0, 100, 0, 60), candidate(50, 90, 100, 500, 60)}).size(), 2u);
}

TEST(ChooseExplanations, EdgePointsHaveOneOwner) {
  // Side by side, but two thirds of the second one's edge points are the first one's.
  EXPECT_EQ(chooseExplanations({candidate(90, 0, 100, 0, 60), candidate(50, 300, 100, 20, 60)}).size(), 1u);
  // A common edge of two objects in contact.
  EXPECT_EQ(chooseExplanations({candidate(90, 0, 100, 0, 60), candidate(50, 300, 100, 50, 60)}).size(), 2u);
}

TEST(AllConflicts, LetTheChoiceBeMadeAgainWithOtherProbabilities) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> place(0, 400);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Candidate> candidates;
  for (int i = 0; i < 40; ++i)
    candidates.push_back(
        candidate(20 + 100 * uniform(random), place(random), 20 + place(random) / 4, place(random), 60));
  const std::vector<std::vector<int>> conflicts = allConflicts(candidates);

  for (int round = 0; round < 5; ++round) {
    for (Candidate& c : candidates) c.probability = uniform(random);
    for (const Explanation& e : chooseExplanations(candidates)) {
      for (int rival : e.rivals) EXPECT_THAT(conflicts[rival], Contains(e.candidate));
      for (const Explanation& other : chooseExplanations(candidates)) {
        if (rankScore(candidates[other.candidate]) <= rankScore(candidates[e.candidate])) continue;
        EXPECT_THAT(conflicts[e.candidate], Not(Contains(other.candidate)));
      }
    }
  }
}

TEST(AllConflicts, NameTheOneThatSuppressesNotTheOneThatIs) {
  // Two thirds of the second one's edge points are the first one's, but they are few of the first one's.
  const auto conflicts = allConflicts({candidate(90, 0, 100, 0, 600), candidate(50, 300, 100, 20, 60)});
  ASSERT_EQ(conflicts.size(), 2u);
  EXPECT_THAT(conflicts[0], IsEmpty());
  EXPECT_THAT(conflicts[1], ElementsAre(0));
}

TEST(ChooseExplanations, OfNothingIsNothing) { EXPECT_THAT(chooseExplanations({}), IsEmpty()); }

TEST(ChooseExplanations, EqualsKeepTheOrderTheyCameIn) {
  const std::vector<Candidate> twins(3, candidate(50, 0, 100, 0, 60));
  const auto chosen = chooseExplanations(twins);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].candidate, 0);
  EXPECT_THAT(chosen[0].rivals, ElementsAre(1, 2));
}

}  // namespace
}  // namespace monocular_eye_hand
