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
  // Candidates of eight parts, one per image, right with the probability of a law in the outline's hits
  // alone.
  std::string dump(int count, bool with_errors = true) const {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::ostringstream text;
    text << "scene_id,im_id,obj_id,name,probability,gt_id,mspd_px,adi_d,candidate,conflicts,rank_score";
    for (const auto& term : EvidenceTerms().named()) text << ',' << term.first;
    text << '\n';
    for (int i = 0; i < count; ++i) {
      EvidenceTerms terms;
      terms.visit([&](const char*, double& value) { value = uniform(random); });
      const bool right = uniform(random) < 1 / (1 + std::exp(-(12 * terms.outline_hits - 8)));
      text << "1," << i << ",1,part" << i % 8 << ",0.5," << (right ? "0" : "") << ','
           << (with_errors && right ? "2.5" : "") << ",,0,,5";
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

TEST_F(FitDecision, finds_the_law_that_made_the_candidates) {
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

TEST_F(FitDecision, tells_how_well_it_does_on_parts_left_out) {
  write("d.csv", dump(1000));
  const ProgramResult result = run(FIT_DECISION_PROGRAM, "--out w.yaml d.csv");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1000 candidates"), HasSubstr("parts left out in turn"),
                                HasSubstr("expected calibration error 0.0"), HasSubstr("outline_hits")));
}

TEST_F(FitDecision, refuses_what_is_no_dump_or_has_nothing_to_learn_from) {
  write("none.csv", "scene_id,im_id\n1,2\n");
  write("wrong.csv", dump(50, false));
  write("short.csv", dump(2) + "1,2,3\n");
  const auto refusal = [&](const std::string& file) {
    const ProgramResult result = run(FIT_DECISION_PROGRAM, "--out w.yaml " + file);
    EXPECT_EQ(result.code, 1);
    return result.err;
  };
  EXPECT_THAT(refusal("none.csv"), AllOf(HasSubstr("none.csv"), HasSubstr("no column")));
  EXPECT_THAT(refusal("wrong.csv"), HasSubstr("needs right and wrong ones"));
  EXPECT_THAT(refusal("short.csv"), AllOf(HasSubstr("short.csv, line 4"), HasSubstr("3 fields")));
}

}  // namespace
}  // namespace monocular_eye_hand
