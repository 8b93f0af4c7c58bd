#include "monocular_eye_hand/offline/clearing_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

/// A block that looks the same after half a turn.
ModelBase block() {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back(k & 1 ? 0.02 : -0.02, k & 2 ? 0.03 : -0.03, k & 4 ? 0.05 : 0);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  ModelBase models;
  models.objects.push_back({buildModel("block", mesh), {}});
  return models;
}

Rigid3 at(double x, double y, double yaw = 0) { return {expSO3({0, 0, yaw}), {x, y, 0.3}}; }

/// Two blocks, of which the first was picked 1 mm beside where it stood, half a turn off.
ClearingRecord record() {
  ClearingRecord record;
  record.truth = {{"frame_0", "frame", at(0.5, 0), false, false},
                  {"block_0", "block", at(0.5, 0.3), false, true},
                  {"block_1", "block", at(0.6, 0.1), false, false}};
  PickRecord pick;
  pick.name = "block";
  pick.base_from_object = at(0.501, 0.05, M_PI);
  pick.base_from_grasp = at(0.5, 0.05);
  pick.truth = {{"block_0", "block", at(0.5, 0.05), false, false},
                {"block_1", "block", at(0.6, 0.1), false, false}};
  pick.result = ActionResult{ActionOutcome::kDone, "", 0.25, 3.5};
  record.picks = {pick};
  record.end =
      ToldEnd{"1 left in the frame", 20, 3, {{"block", "carried", ""}, {"block", "left", "blocked"}}};
  return record;
}

TEST(ClearingReport, ComparesWithTheTruth) {
  const ClearingReport report = reportOf(record(), block());
  EXPECT_FALSE(report.cleared);
  EXPECT_FALSE(report.good());
  EXPECT_EQ(report.carried(), 1);
  ASSERT_EQ(report.parts.size(), 2u) << "the frame is no part";
  EXPECT_EQ(report.parts[0].attempts, 1);
  EXPECT_EQ(report.parts[1].attempts, 0);

  ASSERT_TRUE(report.picks.at(0).error);
  const GraspError& error = *report.picks[0].error;
  EXPECT_EQ(error.label, "block_0");
  EXPECT_NEAR(error.distance, 0.001, 1e-9) << "modulo the half turn";
  EXPECT_NEAR(error.angle, 0, 1e-6);
}

TEST(ClearingReport, TheErrorIsThatOfTheHand) {
  ClearingRecord turned = record();
  turned.picks[0].base_from_object = at(0.5, 0.05, 0.02);
  turned.picks[0].base_from_grasp.translation.x() += 0.05;  // far from the object's origin
  const ClearingReport report = reportOf(turned, block());
  EXPECT_NEAR(report.picks[0].error->distance, 0.05 * 0.02, 1e-5);
  EXPECT_NEAR(report.picks[0].error->angle, 0.02, 1e-9);
}

TEST(ClearingReport, IsGoodOnlyWithoutCollision) {
  ClearingRecord cleared = record();
  cleared.truth[2].in_drop_zone = true;
  EXPECT_TRUE(reportOf(cleared, block()).good());
  cleared.collisions = 1;
  EXPECT_TRUE(reportOf(cleared, block()).cleared);
  EXPECT_FALSE(reportOf(cleared, block()).good());
  cleared.truth.resize(1);
  EXPECT_FALSE(reportOf(cleared, block()).cleared) << "nothing stood there";
}

TEST(ClearingReport, TableAndJson) {
  const ClearingReport report = reportOf(record(), block());
  const std::string table = reportTable(report);
  EXPECT_THAT(table, HasSubstr("block_0      (501.0, 50.0, 300.0)       (500.0, 50.0, 300.0)       "
                               "1.00 mm, 0.00 deg  250 ms / 3.5 s     carried out\n"));
  EXPECT_THAT(table, HasSubstr("left: never picked"));
  EXPECT_THAT(table, HasSubstr("1 left in the frame; 0 collisions; 20.0 s of cell time, 3 rounds"));

  const nlohmann::json json = nlohmann::json::parse(reportJson(report));
  EXPECT_EQ(json["cleared"], false);
  EXPECT_EQ(json["objects"].size(), 2u);
  EXPECT_NEAR(json["objects"][0]["grasp_error_mm"], 1, 1e-6);
  EXPECT_EQ(json["picks"][0]["label"], "block_0");
  EXPECT_EQ(json["told"][1]["outcome"], "left");

  const nlohmann::json both = nlohmann::json::parse(reportsJson({report, report}));
  EXPECT_EQ(both["parts"], 4);
  EXPECT_EQ(both["carried"], 2);
  EXPECT_EQ(both["scenes"].size(), 2u);
}

const char kRecord[] = R"({
  "seed": 3, "collisions": 1,
  "truth": [{"label": "block_0", "name": "block", "held": true, "in_drop_zone": false,
             "pose": {"position": [0.5, 0, 0.3], "quaternion": [0, 0, 0, 1]}}],
  "picks": [{"name": "block", "instance": 2, "truth": [],
             "object": {"position": [0.5, 0, 0.3], "quaternion": [0, 0, 0, 1]},
             "grasp": {"position": [0.5, 0, 0.35], "quaternion": [1, 0, 0, 0]},
             "result": {"outcome": 3, "reason": "lost", "planning_s": 0.1, "motion_s": 2}}],
  "end": {"reason": "cancelled", "cell_seconds": 12, "rounds": 1, "told": []}})";

TEST(ClearingRecord, IsRead) {
  const ClearingRecord record = parseRecord(kRecord, "record.json");
  EXPECT_EQ(record.seed, 3);
  EXPECT_EQ(record.collisions, 1);
  ASSERT_EQ(record.picks.size(), 1u);
  EXPECT_EQ(record.picks[0].result->outcome, ActionOutcome::kGraspLost);
  EXPECT_NEAR(record.picks[0].base_from_grasp.rotation(2, 2), -1, 1e-12);
  EXPECT_TRUE(record.truth.at(0).held);
  EXPECT_EQ(record.end->reason, "cancelled");
}

TEST(ClearingRecord, WhatIsNoneIsRefused) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      parseRecord(text, "record.json");
    } catch (const BadInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("{"), HasSubstr("record.json: no record of a clearing"));
  EXPECT_THAT(refusal("{}"), HasSubstr("seed"));
  std::string other = kRecord;
  other.replace(other.find("\"outcome\": 3"), 12, "\"outcome\": 9");
  EXPECT_THAT(refusal(other), HasSubstr("outcome = 9 must be 0 to 5"));
}

}  // namespace
}  // namespace monocular_eye_hand
