#include "monocular_eye_hand/offline/offline_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monocular_eye_hand/offline/clearing_report.h"
#include "small_cell.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

OfflineOptions options() {
  OfflineOptions options;
  options.cache = testing::TempDir() + "/offline_test_cache";
  options.executor.objects = sourceFile("config/objects.yaml");
  options.executor.urdf = sourceFile("urdf/puma560.urdf");
  return options;
}

/// What the same seed gives again: all but times of the machine.
std::string repeatable(const ClearingRecord& record, const ModelBase& models) {
  ClearingRecord same = record;
  same.times.reset();
  for (PickRecord& pick : same.picks) pick.result->planning_time = 0;
  return reportJson(reportOf(same, models));
}

TEST(OfflineTask, ClearsTheCellOfTheFile) {
  const OfflineTask task(options());
  int looks = 0;
  std::vector<TaskStage> stages;
  ClearingWatch watch;
  watch.looked = [&](const CellLook& look) {
    EXPECT_FALSE(look.grey.empty());
    ++looks;
  };
  watch.feedback = [&](const TaskFeedback& feedback) { stages.push_back(feedback.stage); };

  const ClearingRecord record = task.clear(-1, watch);
  const ClearingReport report = reportOf(record, task.models());
  EXPECT_TRUE(report.good()) << reportTable(report);
  EXPECT_EQ(report.parts.size(), 3u);
  EXPECT_EQ(looks, record.looks);
  ASSERT_FALSE(stages.empty());
  EXPECT_EQ(stages.back(), TaskStage::kDone);
  for (const PickReport& pick : report.picks) {
    ASSERT_TRUE(pick.error);
    EXPECT_LT(pick.error->distance, 0.002);
  }
}

TEST(OfflineTask, ARandomCellIsClearedTwiceInTheSameWay) {
  OfflineOptions one_part = options();
  one_part.cell.random.objects = 1;
  one_part.task.clear_frame.searches = 1;
  const OfflineTask task(one_part);
  const ClearingRecord first = task.clear(4), second = task.clear(4);
  EXPECT_TRUE(reportOf(first, task.models()).good()) << reportTable(reportOf(first, task.models()));
  EXPECT_EQ(repeatable(first, task.models()), repeatable(second, task.models()));
  EXPECT_NE(repeatable(first, task.models()), repeatable(task.clear(5), task.models()));
}

TEST(OfflineTask, WhatCannotBeReachedIsLeftWithAReason) {
  OfflineOptions far = options();
  far.cell.random.objects = 1;
  far.executor.drop_zone.x = 3;
  const OfflineTask task(far);
  const ClearingReport report = reportOf(task.clear(4), task.models());
  EXPECT_FALSE(report.good());
  EXPECT_EQ(report.carried(), 0);
  ASSERT_TRUE(report.end);
  EXPECT_THAT(report.end->reason, HasSubstr("1 left in the frame"));
  ASSERT_FALSE(report.picks.empty());
  EXPECT_EQ(report.picks[0].result->outcome, ActionOutcome::kUnreachable);
}

}  // namespace
}  // namespace monocular_eye_hand
