#include "monocular_eye_hand/task/eye_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

/// All are there, and the recogniser worked on the image that was waited for.
EyeChain chain() {
  EyeChain chain;
  chain.recognizer_call = "/recognizer/recognize";
  chain.recognized = "/recognizer/objects";
  chain.located = "/eye_hand/objects";
  chain.tells_recognized = chain.tells_located = true;
  chain.last_recognized = 50;
  return chain;
}

std::string missing(const EyeChain& chain) { return missingInput(chain, 49.5, 30); }

TEST(EyeChain, TheFirstSilentPartIsNamed) {
  EyeChain parts = chain();
  EXPECT_EQ(missing(parts),
            "no view within look_timeout = 30 s; /eye_hand/objects is silent, though the recognizer is not: "
            "look at "
            "the node eye_hand");
  parts.tells_located = false;
  EXPECT_THAT(missing(parts), HasSubstr("nobody publishes /eye_hand/objects: is the node eye_hand running?"));
  parts.last_recognized = 40;
  EXPECT_THAT(missing(parts),
              HasSubstr("last answered for an image of 40.00 s, the camera stands still since 49.50 s: "
                        "does the camera send images"));
  parts.last_recognized = 0;
  EXPECT_THAT(missing(parts), HasSubstr("/recognizer/objects is silent: does the camera"));
  parts.tells_recognized = false;
  EXPECT_THAT(missing(parts), HasSubstr("nobody publishes /recognizer/objects"));
  parts.recognizer_gone = true;
  EXPECT_EQ(missing(parts),
            "the node recognizer does not run (any more): its service /recognizer/recognize is not there");
}

TEST(EyeChain, StampsOfTwoClocksAreTold) {
  EXPECT_THAT(missingInput(chain(), 1.7e9, 30), HasSubstr("do the nodes share one clock?"));
}

TEST(EyeChain, TheRecogniserIsQuoted) {
  EyeChain parts = chain();
  parts.complaint = "bad camera_info";
  EXPECT_THAT(missing(parts), testing::EndsWith("; the recognizer says: bad camera_info"));
}

}  // namespace
}  // namespace monocular_eye_hand
