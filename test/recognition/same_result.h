#pragma once
#include <gtest/gtest.h>

#include "monocular_eye_hand/recognition/object_estimate.h"

namespace monocular_eye_hand {

/// Number of hypotheses scored.
inline double scored(const RecognitionResult& result) {
  double count = 0;
  for (const StageReport& stage : result.stages) {
    const auto it = stage.counts.find("scored");
    if (it != stage.counts.end()) count += it->second;
  }
  return count;
}

template <class Objects>
void expectSameObjects(const Objects& a, const Objects& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].decision, b[i].decision);
    EXPECT_EQ(a[i].probability, b[i].probability);
    EXPECT_EQ(a[i].plausibility, b[i].plausibility);
    EXPECT_EQ(a[i].reliability, b[i].reliability);
    EXPECT_EQ(a[i].camera_from_object.rotation, b[i].camera_from_object.rotation);
    EXPECT_EQ(a[i].camera_from_object.translation, b[i].camera_from_object.translation);
    EXPECT_EQ(a[i].covariance, b[i].covariance);
    EXPECT_EQ(a[i].evidence, b[i].evidence);
    EXPECT_EQ(a[i].reason, b[i].reason);
    EXPECT_EQ(a[i].bounding_box, b[i].bounding_box);
    EXPECT_EQ(a[i].alternatives.size(), b[i].alternatives.size());
  }
}

/// The same answer bit by bit, from the same work.
inline void expectSame(const RecognitionResult& a, const RecognitionResult& b) {
  expectSameObjects(a.objects, b.objects);
  expectSameObjects(a.rejected, b.rejected);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.truncated, b.truncated);
  EXPECT_EQ(scored(a), scored(b));
}

}  // namespace monocular_eye_hand
