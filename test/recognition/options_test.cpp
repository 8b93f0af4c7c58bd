#include "monocular_eye_hand/recognition/options.h"

#include <gmock/gmock.h>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusalOf(const std::string& yaml) {
  RecognitionOptions options;
  return refusal([&] { readOptions(parseYaml(yaml), &options); });
}

TEST(RecognitionOptions, DefaultsHold) { EXPECT_NO_THROW(RecognitionOptions{}.check()); }

TEST(RecognitionOptions, AValueOutOfRangeIsNamedWithItsValueAndTheRule) {
  const std::vector<std::array<const char*, 3>> bad{
      {"min_distance", "-0.5", "positive"},    {"max_distance", "0.01", "min_distance"},
      {"min_size", "2", "at least"},           {"min_in_frame", "0", "(0, 1]"},
      {"min_in_frame", "1.5", "(0, 1]"},       {"search_width", "100", "at least"},
      {"refined_per_object", "0", "positive"}, {"verified_per_object", "-3", "positive"},
      {"thorough_models", "0", "positive"},    {"budget", "-1", "0 or more"},
      {"time_limit", "-2", "0 or more"},       {"threads", "-1", "0 or more"},
      {"accept_probability", "1", "(0, 1)"},   {"accept_probability", "0", "(0, 1)"},
      {"rest_log_odds", "-0.5", "0 or more"},  {"ambiguous_ratio", "0", "(0, 1]"},
      {"ambiguous_ratio", "1.25", "(0, 1]"}};
  for (const auto& [field, value, rule] : bad) {
    EXPECT_THAT(refusalOf(std::string(field) + ": " + value),
                AllOf(HasSubstr(field), HasSubstr(value), HasSubstr(rule)));
  }
  EXPECT_THAT(refusalOf("min_distance: 9"), HasSubstr("must be larger than min_distance"));
}

TEST(RecognitionOptions, NanIsOutOfEveryRange) {
  for (const char* field : {"min_distance", "max_distance", "min_size", "min_in_frame", "time_limit",
                            "accept_probability", "ambiguous_ratio"})
    EXPECT_THAT(refusalOf(std::string(field) + ": .nan"), HasSubstr(field));
}

TEST(RecognitionOptions, NestedOptionsAreCheckedAndNamedByTheirPath) {
  EXPECT_THAT(refusalOf("features: {noise_factor: -1}"),
              AllOf(HasSubstr("features"), HasSubstr("noise_factor")));
  EXPECT_THAT(refusalOf("grouping: {corner_gap: -1}"), AllOf(HasSubstr("grouping"), HasSubstr("corner_gap")));
  RecognitionOptions options;
  options.features.min_trace_points = -5;
  EXPECT_THROW(options.check(), BadInput);
}

TEST(RecognitionOptions, UnknownKeysAreRefusedWithTheNearestKnown) {
  EXPECT_THAT(refusalOf("min_distence: 1"), AllOf(HasSubstr("min_distence"), HasSubstr("min_distance")));
  EXPECT_THAT(refusalOf("decision: {hit_ration: {weight: 1}}"),
              AllOf(HasSubstr("decision.hit_ration"), HasSubstr("hit_ratio")));
  EXPECT_THAT(refusalOf("budget: many"), AllOf(HasSubstr("budget"), HasSubstr("many")));
}

TEST(RecognitionOptions, EveryFieldIsWrittenAndReadBack) {
  RecognitionOptions options;
  options.features.smoothing_sigma = 1.25;
  options.grouping.corner_gap = 6;
  options.decision.bias = -3;
  options.min_distance = 0.3;
  options.max_distance = 1.5;
  options.min_size = 40;
  options.min_in_frame = 0.5;
  options.search_width = 640;
  options.refined_per_object = 100;
  options.verified_per_object = 20;
  options.thorough_models = 3;
  options.budget = 5000;
  options.time_limit = 2;
  options.threads = 3;
  options.accept_probability = 0.6;
  options.rest_log_odds = 1;
  options.ambiguous_ratio = 0.4;
  const OptionTree written = writeOptions(options);
  RecognitionOptions again;
  readOptions(parseYaml(toYaml(written)), &again);
  EXPECT_EQ(writeOptions(again), written);

  const OptionTree defaults = writeOptions(RecognitionOptions{});
  for (const auto& [key, value] : written.map) EXPECT_NE(*defaults.find(key), value) << key;
}

}  // namespace
}  // namespace monocular_eye_hand
