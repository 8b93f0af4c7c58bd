// The tool that fits the decision's weights, on candidates whose law is known.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/recognition/decision_weights.h"
#include "tool_world.h"

namespace monocular_eye_hand {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FitDecision : public ToolWorld {
 protected:
  static std::string header() {
    std::string text = "scene_id,im_id,obj_id,name,gt_id,mspd_px,adi_d,candidate,conflicts,contests";
    for (const auto& term : EvidenceTerms().named()) text += "," + term.first;
    return text + "\n";
  }

  // Two candidates of one part in every image, the first held against the second, right with the probability
  // of a law in two of the contest's values.
  static std::string contests(int count) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0, 1);
    std::ostringstream text;
    text << header();

    for (int i = 0; i < count; ++i) {
      PoseContest contest;
      contest.visit([&](const char*, double& value) { value = normal(random); });
      const double log_odds = contest.log_odds + 3 * contest.precise;
      const int right = uniform(random) < 1 / (1 + std::exp(-log_odds)) ? 0 : 1;
      for (int candidate : {0, 1}) {
        text << "1," << i << ",1,part" << i % 8 << ",0," << (candidate == right ? 1 : 90) << ",," << candidate
             << ',' << 1 - candidate << ',';
        if (candidate == 0) {
          text << 1;
          contest.visit([&](const char*, double value) { text << ':' << value; });
        }
        for (size_t k = 0; k < EvidenceTerms().named().size(); ++k) text << ",0.5";
        text << '\n';
      }
    }
    return text.str();
  }

  // Candidates of eight parts, one per image, right with the probability of a law in the outline's hits
  // alone.
  std::string dump(int count, bool with_errors = true) const {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::ostringstream text;
    text << header();
    for (int i = 0; i < count; ++i) {
      EvidenceTerms terms;
      terms.visit([&](const char*, double& value) { value = uniform(random); });
      const bool right = uniform(random) < 1 / (1 + std::exp(-(12 * terms.outline_hits - 8)));
      text << "1," << i << ",1,part" << i % 8 << "," << (right ? "0" : "") << ','
           << (with_errors && right ? "2.5" : "") << ",,0,,";
      for (const auto& term : terms.named()) text << ',' << term.second;
      text << '\n';
    }
    return text.str();
  }

  DecisionWeights fitted(const std::string& arguments) const {
    const ProgramResult result = run(FIT_DECISION_PROGRAM, "--out w.yaml --source 'a test' " + arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return loadOptions<DecisionWeights>(path("w.yaml"));
  }
};

TEST_F(FitDecision, FindsTheLawThatMadeTheCandidates) {
  write("d.csv", dump(3000));
  const DecisionWeights weights = fitted("d.csv");
  EXPECT_EQ(weights.source, "a test");
  for (size_t k = 0; k < weights.terms.size(); ++k) {
    const double weight = weights.terms[k].weight;
    if (std::string(decisionTerms()[k].name) == "outline_hits") {
      EXPECT_NEAR(weight, 12, 3);
      EXPECT_GT(weights.terms[k].typical, 0.6) << "of the right ones";
    } else {
      EXPECT_LT(std::abs(weight), 3) << decisionTerms()[k].name;
    }
  }
}

TEST_F(FitDecision, FindsWhatDecidesContestsAndKeepsTheOtherWeights) {
  write("d.csv", dump(1000));
  const DecisionWeights first = fitted("d.csv");
  EXPECT_EQ(first.contest.log_odds, 1) << "no contests: each one's own evidence";
  EXPECT_EQ(first.contest.precise, 0);

  write("base.yaml", readText(path("w.yaml")));
  write("c.csv", contests(2000));
  const DecisionWeights second = fitted("--keep base.yaml c.csv");
  EXPECT_NEAR(second.contest.log_odds, 1, 0.25);
  EXPECT_NEAR(second.contest.precise, 3, 0.5);
  EXPECT_NEAR(second.contest.shading, 0, 0.2);
  EXPECT_EQ(second.source, "a test; a test");
  for (size_t k = 0; k < first.terms.size(); ++k)
    EXPECT_EQ(first.terms[k].weight, second.terms[k].weight) << decisionTerms()[k].name;
}

TEST_F(FitDecision, TellsHowWellItDoesOnPartsLeftOut) {
  write("d.csv", dump(1000));
  const ProgramResult result = run(FIT_DECISION_PROGRAM, "--out w.yaml d.csv");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1000 candidates"), HasSubstr("parts left out in turn"),
                                HasSubstr("expected calibration error 0.0"), HasSubstr("outline_hits")));
}

TEST_F(FitDecision, RefusesWhatIsNoDumpOrHasNothingToLearnFrom) {
  write("none.csv", "scene_id,im_id\n1,2\n");
  write("wrong.csv", dump(50, false));
  write("short.csv", dump(2) + "1,2,3\n");
  const auto refusal = [&](const std::string& file) {
    const ProgramResult result = run(FIT_DECISION_PROGRAM, "--out w.yaml " + file);
    EXPECT_EQ(result.code, 1);
    return result.err;
  };
  std::string broken = contests(2);
  write("broken.csv", broken.replace(broken.find(",1:"), 3, ",1:x:"));
  EXPECT_THAT(refusal("broken.csv"), HasSubstr("is not that of a dump"));
  EXPECT_THAT(refusal("none.csv"), AllOf(HasSubstr("none.csv"), HasSubstr("no column")));
  EXPECT_THAT(refusal("wrong.csv"), HasSubstr("needs right and wrong ones"));
  EXPECT_THAT(refusal("short.csv"), AllOf(HasSubstr("short.csv, line 4"), HasSubstr("3 fields")));
}

}  // namespace
}  // namespace monocular_eye_hand
