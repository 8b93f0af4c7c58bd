#include "recognition/decision.h"

#include <gmock/gmock.h>

#include <numeric>
#include <random>

#include "monocular_eye_hand/options/options.h"

namespace monocular_eye_hand {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

struct Term {
  const char* name;
  double DecisionWeights::*weight;
  double EvidenceTerms::*value;
};
const Term kTerms[] = {
    {"log_sum", &DecisionWeights::log_sum, &EvidenceTerms::sum},
    {"mean", &DecisionWeights::mean, &EvidenceTerms::mean},
    {"hit_ratio", &DecisionWeights::hit_ratio, &EvidenceTerms::hit_ratio},
    {"silhouette_hits", &DecisionWeights::silhouette_hits, &EvidenceTerms::silhouette_hits},
    {"crease_hits", &DecisionWeights::crease_hits, &EvidenceTerms::crease_hits},
    {"log_groups", &DecisionWeights::log_groups, &EvidenceTerms::groups},
    {"unsupported", &DecisionWeights::unsupported, &EvidenceTerms::unsupported},
    {"unsupported_length", &DecisionWeights::unsupported_length, &EvidenceTerms::unsupported_length},
    {"continuation", &DecisionWeights::continuation, &EvidenceTerms::continuation},
    {"overhang", &DecisionWeights::overhang, &EvidenceTerms::overhang},
    {"interior", &DecisionWeights::interior, &EvidenceTerms::interior},
    {"solidity", &DecisionWeights::solidity, &EvidenceTerms::solidity},
    {"log_faces", &DecisionWeights::log_faces, &EvidenceTerms::faces},
    {"log_size", &DecisionWeights::log_size, &EvidenceTerms::size},
    {"log_contrast", &DecisionWeights::log_contrast, &EvidenceTerms::contrast},
    {"in_frame", &DecisionWeights::in_frame, &EvidenceTerms::in_frame},
    {"rms", &DecisionWeights::rms, &EvidenceTerms::rms},
};

// All weights 0 but for those named.
DecisionWeights onlyWeight(double DecisionWeights::*weight, double value) {
  DecisionWeights weights;
  weights.bias = 0;
  for (const Term& t : kTerms) weights.*t.weight = 0;
  weights.*weight = value;
  return weights;
}

// What a well seen object looks like.
EvidenceTerms goodTerms() {
  EvidenceTerms t;
  t.sum = 120, t.mean = 1.6, t.hit_ratio = 0.95, t.silhouette_hits = 0.96, t.crease_hits = 0.93;
  t.groups = 16, t.unsupported = 0.03, t.unsupported_length = 0.01, t.continuation = 0.02, t.overhang = 0.05;
  t.interior = 0.02, t.solidity = 0.9, t.faces = 5, t.size = 100, t.contrast = 8, t.in_frame = 1, t.rms = 0.4;
  return t;
}

TEST(Probability, each_weight_moves_it_by_its_own_term_in_the_direction_of_its_sign) {
  EvidenceTerms low, high;
  for (const Term& t : kTerms) low.*t.value = 0.2, high.*t.value = 0.3;
  for (double EvidenceTerms::*count :
       {&EvidenceTerms::sum, &EvidenceTerms::groups, &EvidenceTerms::faces, &EvidenceTerms::size})
    low.*count = 4, high.*count = 8;
  for (const Term& t : kTerms) {
    EvidenceTerms more = low;
    more.*t.value = high.*t.value;
    const DecisionWeights plus = onlyWeight(t.weight, 2), minus = onlyWeight(t.weight, -2);
    EXPECT_GT(probability(more, plus), probability(low, plus)) << t.name;
    EXPECT_LT(probability(more, minus), probability(low, minus)) << t.name;
    EvidenceTerms others = high;
    others.*t.value = low.*t.value;
    EXPECT_EQ(probability(others, plus), probability(low, plus)) << t.name << " depends on another term";
  }
  EXPECT_EQ(writeOptions(DecisionWeights{}).map.size(), std::size(kTerms) + 1) << "a weight is not tested";
}

TEST(Probability, of_the_fitted_weights_separates_a_good_from_an_empty_pose) {
  const DecisionWeights weights;
  EXPECT_GT(probability(goodTerms(), weights), 0.9);
  EvidenceTerms empty;
  empty.unsupported = empty.unsupported_length = 1, empty.in_frame = 1, empty.rms = 2, empty.size = 60;
  EXPECT_LT(probability(empty, weights), 0.01);
}

TEST(Probability, stays_between_0_and_1_for_any_finite_terms) {
  for (double scale : {-1e6, -1.0, 0.0, 1e6}) {
    EvidenceTerms t;
    for (const Term& term : kTerms) t.*term.value = scale;
    const double p = probability(t, DecisionWeights{});
    EXPECT_GE(p, 0) << scale;
    EXPECT_LE(p, 1) << scale;
  }
}

TEST(RankScore, more_evidence_and_probability_lift_it_contradictions_lower_it) {
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
  EXPECT_LT(changed([](Candidate* c) { c->terms.off_face = 0.4; }), score);
  EXPECT_LT(changed([](Candidate* c) { c->terms.continuation = 0.5; }), score);
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

TEST(ChooseExplanations, apart_all_are_chosen_the_best_first) {
  const std::vector<Candidate> candidates{candidate(50, 0, 100, 0, 60), candidate(90, 200, 100, 100, 60),
                                          candidate(70, 400, 100, 200, 60)};
  const auto chosen = chooseExplanations(candidates);
  ASSERT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen[0].candidate, 1);
  EXPECT_EQ(chosen[1].candidate, 2);
  EXPECT_EQ(chosen[2].candidate, 0);
  for (const Explanation& e : chosen) EXPECT_THAT(e.rivals, IsEmpty());
}

TEST(ChooseExplanations, who_covers_the_same_faces_is_a_rival_of_the_best_in_order_of_rank) {
  const std::vector<Candidate> candidates{candidate(50, 10, 100, 0, 60), candidate(90, 0, 100, 100, 60),
                                          candidate(70, 20, 100, 200, 60), candidate(80, 500, 100, 300, 60)};
  const auto chosen = chooseExplanations(candidates);
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].candidate, 1);
  EXPECT_THAT(chosen[0].rivals, ElementsAre(2, 0));
  EXPECT_EQ(chosen[1].candidate, 3);
}

TEST(ChooseExplanations, overlap_counts_by_the_smaller_one) {
  // A part of the large object: all of its cells are covered, only a tenth of the large one's.
  const auto inside = chooseExplanations({candidate(90, 0, 500, 0, 200), candidate(50, 100, 50, 500, 60)});
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_THAT(inside[0].rivals, ElementsAre(1));
  // Neighbours whose drawings touch.
  EXPECT_EQ(chooseExplanations({candidate(90, 0, 100, 0, 60), candidate(50, 90, 100, 500, 60)}).size(), 2u);
}

TEST(ChooseExplanations, edge_points_have_one_owner) {
  // Side by side, but two thirds of the second one's edge points are the first one's.
  EXPECT_EQ(chooseExplanations({candidate(90, 0, 100, 0, 60), candidate(50, 300, 100, 20, 60)}).size(), 1u);
  // A common edge of two objects in contact.
  EXPECT_EQ(chooseExplanations({candidate(90, 0, 100, 0, 60), candidate(50, 300, 100, 50, 60)}).size(), 2u);
}

TEST(AllConflicts, let_the_choice_be_made_again_with_other_probabilities) {
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

TEST(AllConflicts, name_the_one_that_suppresses_not_the_one_that_is) {
  // Two thirds of the second one's edge points are the first one's, but they are few of the first one's.
  const auto conflicts = allConflicts({candidate(90, 0, 100, 0, 600), candidate(50, 300, 100, 20, 60)});
  ASSERT_EQ(conflicts.size(), 2u);
  EXPECT_THAT(conflicts[0], IsEmpty());
  EXPECT_THAT(conflicts[1], ElementsAre(0));
}

TEST(ChooseExplanations, of_nothing_is_nothing) { EXPECT_THAT(chooseExplanations({}), IsEmpty()); }

TEST(ChooseExplanations, equals_keep_the_order_they_came_in) {
  const std::vector<Candidate> twins(3, candidate(50, 0, 100, 0, 60));
  const auto chosen = chooseExplanations(twins);
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].candidate, 0);
  EXPECT_THAT(chosen[0].rivals, ElementsAre(1, 2));
}

}  // namespace
}  // namespace monocular_eye_hand
