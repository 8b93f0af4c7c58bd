#include "monocular_eye_hand/io/file_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A workspace with two packages, one of which lies in a folder of another name.
class FilePath : public testing::Test {
 protected:
  void SetUp() override {
    addPackage("src/my_parts", "my_parts");
    addPackage("src/stack/folder_of_another_name", "arm_description");
    fs::create_directories(root_ / "odd $name");
    std::ofstream(root_ / "odd $name" / "~part.stl") << "x";
    setenv("ROS_PACKAGE_PATH", ("/nowhere:" + (root_ / "src").string()).c_str(), 1);
    setenv("PARTS_FOLDER", (root_ / "parts").c_str(), 1);
    setenv("HOME", root_.c_str(), 1);
  }
  void TearDown() override { fs::remove_all(root_); }

  void addPackage(const std::string& folder, const std::string& name) const {
    fs::create_directories(root_ / folder / "meshes");
    std::ofstream(root_ / folder / "package.xml") << "<package>\n  <name>" << name << "</name>\n</package>\n";
  }
  static std::string refusalOf(const std::string& name) {
    return refusal([&] { resolvedPath(name, "/parts"); });
  }
  static bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  const fs::path root_ = fs::path(testing::TempDir()) / ("file_path_" + std::to_string(getpid()));
};

TEST_F(FilePath, PlainOnesComeFromTheFolder) {
  EXPECT_EQ(resolvedPath("part.stl", "/parts"), "/parts/part.stl");
  EXPECT_EQ(resolvedPath("/a/part.stl", "/parts"), "/a/part.stl");
  EXPECT_EQ(resolvedPath("part.stl"), "part.stl");
}

TEST_F(FilePath, PackagesAreFound) {
  const std::string parts = (root_ / "src/my_parts").string();
  const std::string arm = (root_ / "src/stack/folder_of_another_name").string();
  EXPECT_EQ(resolvedPath("package://my_parts/meshes/a.stl"), parts + "/meshes/a.stl");
  EXPECT_EQ(resolvedPath("package://arm_description/meshes/a.stl", "/x"), arm + "/meshes/a.stl");
  EXPECT_EQ(resolvedPath("$(find arm_description)/a.stl", "/x"), arm + "/a.stl");
  EXPECT_TRUE(holds(refusalOf("package://no_such_package/a.stl"), "no_such_package"));
  EXPECT_TRUE(holds(refusalOf("package://no_such_package/a.stl"), "ROS_PACKAGE_PATH"));
  EXPECT_TRUE(holds(refusalOf("package://my_parts"), "a file must follow"));
  EXPECT_TRUE(holds(refusalOf("package://a;b/c.stl"), "no name of a ROS package"));
}

TEST_F(FilePath, InstalledPackagesAreFound) {
  fs::create_directories(root_ / "install/share/gripper");
  std::ofstream(root_ / "install/share/gripper/package.xml") << "<package><name>gripper</name></package>";
  setenv("CMAKE_PREFIX_PATH", (root_ / "install").c_str(), 1);
  EXPECT_EQ(resolvedPath("package://gripper/a.stl"), (root_ / "install/share/gripper/a.stl").string());
}

TEST_F(FilePath, FileUrls) {
  EXPECT_EQ(resolvedPath("file:///a/part.stl", "/x"), "/a/part.stl");
  EXPECT_EQ(resolvedPath("file://localhost/a/part.stl", "/x"), "/a/part.stl");
  EXPECT_EQ(resolvedPath("file:///a/my%20part.stl", "/x"), "/a/my part.stl");
  EXPECT_TRUE(holds(refusalOf("file://part.stl"), "three slashes"));
  EXPECT_TRUE(holds(refusalOf("http://host/part.stl"), "http:// is not supported"));
  EXPECT_TRUE(holds(refusalOf("model://part/part.stl"), "model:// is not supported"));
}

TEST_F(FilePath, HomesAndVariables) {
  EXPECT_EQ(resolvedPath("~/part.stl", "/x"), root_.string() + "/part.stl");
  EXPECT_EQ(resolvedPath("$PARTS_FOLDER/part.stl", "/x"), root_.string() + "/parts/part.stl");
  EXPECT_EQ(resolvedPath("${PARTS_FOLDER}_2/part.stl", "/x"), root_.string() + "/parts_2/part.stl");
  EXPECT_EQ(resolvedPath("$(env PARTS_FOLDER)/part.stl", "/x"), root_.string() + "/parts/part.stl");
  EXPECT_TRUE(holds(refusalOf("$NO_SUCH_VARIABLE/part.stl"), "\"NO_SUCH_VARIABLE\" is not set"));
  EXPECT_TRUE(holds(refusalOf("${PARTS_FOLDER/part.stl"), "\"}\" is missing"));
  EXPECT_TRUE(holds(refusalOf("~nobody_of_this_name/part.stl"), "nobody_of_this_name"));
}

TEST_F(FilePath, ExistingFilesMayHaveAnyName) {
  const std::string folder = (root_ / "odd $name").string();
  EXPECT_EQ(resolvedPath(folder + "/~part.stl"), folder + "/~part.stl");
  EXPECT_EQ(resolvedPath("~part.stl", folder), folder + "/~part.stl");
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
