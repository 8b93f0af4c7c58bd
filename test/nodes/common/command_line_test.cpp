#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/command_line.h"
#include "nodes/image_source/parameters.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;
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

/// The program runs in one folder, the shell that started it in another.
class PathParameter : public testing::Test {
 protected:
  PathParameter() : before_(fs::current_path()) {
    const char* pwd = std::getenv("PWD");
    pwd_ = pwd ? pwd : "";
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    root_ = fs::canonical(testing::TempDir()) / ("path_parameter_" + name);
    for (const char* folder : {"here", "shell/images"}) fs::create_directories(root_ / folder);
    std::ofstream(root_ / "shell/parts.yaml") << "objects: []";
    fs::current_path(root_ / "here");
    setenv("PWD", (root_ / "shell").c_str(), 1);
  }
  ~PathParameter() override {
    fs::current_path(before_);
    setenv("PWD", pwd_.c_str(), 1);
    fs::remove_all(root_);
  }
  std::string shell(const std::string& name) const { return (root_ / "shell" / name).string(); }

  fs::path before_, root_;
  std::string pwd_;
};

TEST_F(PathParameter, IsFoundBesideTheShell) {
  EXPECT_EQ(pathParameter("objects", "parts.yaml"), shell("parts.yaml"));
  EXPECT_EQ(pathParameter("source", "images"), shell("images"));
  EXPECT_EQ(pathParameter("source", "images/img_%04d.png"), shell("images/img_%04d.png"));
}

TEST_F(PathParameter, TheFolderOfTheProgramGoesFirst) {
  std::ofstream(root_ / "here/parts.yaml") << "objects: []";
  EXPECT_EQ(pathParameter("objects", "parts.yaml"), "parts.yaml");
}

TEST_F(PathParameter, WhatIsNotRelativeStays) {
  for (const char* path :
       {"", "/no/such.yaml", "~/a.yaml", "$HOME/a.yaml", "package://a/b.yaml", "file:///c.yaml"})
    EXPECT_EQ(pathParameter("objects", path), path);
}

TEST_F(PathParameter, AMissingOneNamesBothFolders) {
  for (const char* path : {"none.yaml", "none/img_%d.png"}) {
    try {
      pathParameter("objects", path);
      ADD_FAILURE() << path;
    } catch (const BadInput& e) {
      EXPECT_THAT(e.what(),
                  testing::AllOf(HasSubstr(std::string("objects: there is no ") + path),
                                 HasSubstr((root_ / "here").string()), HasSubstr((root_ / "shell").string()),
                                 HasSubstr(std::string("objects:=$PWD/") + path)));
    }
  }
}

}  // namespace
}  // namespace monocular_eye_hand
