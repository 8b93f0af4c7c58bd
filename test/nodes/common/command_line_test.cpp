#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nodes/common/command_line.h"
#include "nodes/image_source/parameters.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

const NodeHelp kHelp{"some_node",    "does something", "image_raw", "~objects",
                     "service ~ask", "some.launch",    ""};

std::optional<int> exitCode(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "some_node");
  return exitAtCommandLine(int(arguments.size()), const_cast<char**>(arguments.data()), kHelp,
                           writeOptions(ImageSourceParameters()));
}

TEST(CommandLine, HelpNamesJobTopicsAndParameters) {
  for (const char* flag : {"--help", "-h"}) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(exitCode({flag}), 0);
    const std::string text = testing::internal::GetCapturedStdout();
    for (const char* part : {"does something", "image_raw", "~objects", "service ~ask", "some.launch",
                             "frame_id: \"camera\"", "loop: true"})
      EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(CommandLine, WhatRosGivesIsNoArgument) {
  EXPECT_FALSE(exitCode({}));
  EXPECT_FALSE(exitCode({"__name:=other", "__log:=/dev/null", "_source:=a.png", "image_raw:=b"}));
}

TEST(CommandLine, OtherArgumentsAreRefused) {
  for (const char* wrong : {"objects.yaml", "--objects"}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(exitCode({"__name:=other", wrong}), 1);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr(std::string("'") + wrong + "'"));
  }
}

}  // namespace
}  // namespace monocular_eye_hand
