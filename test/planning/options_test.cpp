#include "monocular_eye_hand/planning/options.h"

#include <gtest/gtest.h>

#include <cmath>

#include "monocular_eye_hand/options/options.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

TEST(PlanningOptions, DefaultsPassAndSurviveATree) {
  PlanningOptions options;
  options.check();
  options.path.seed = 7;
  options.timing.tool_speed = 0.25;
  PlanningOptions copy;
  readOptions(writeOptions(options), &copy);
  EXPECT_EQ(copy.path.seed, 7);
  EXPECT_EQ(copy.timing.tool_speed, 0.25);
}

TEST(PlanningOptions, RefusedByName) {
  const auto message = [](auto change) -> std::string {
    PlanningOptions options;
    change(options);
    return refusal([&] { options.check(); });
  };
  EXPECT_NE(message([](PlanningOptions& o) { o.padding = -1; }).find("padding = -1"), std::string::npos);
  EXPECT_NE(message([](PlanningOptions& o) { o.near_padding = 0.05; }).find("near_padding"),
            std::string::npos);
  EXPECT_NE(message([](PlanningOptions& o) { o.path.resolution = NAN; }).find("resolution"),
            std::string::npos);
  EXPECT_NE(message([](PlanningOptions& o) { o.timing.speed = 1.5; }).find("speed"), std::string::npos);
  EXPECT_NE(message([](PlanningOptions& o) { o.cartesian.max_step = 0; }).find("max_step"),
            std::string::npos);
  EXPECT_NE(message([](PlanningOptions& o) { o.path.budget = 0; }).find("budget"), std::string::npos);
}

}  // namespace
}  // namespace monocular_eye_hand
