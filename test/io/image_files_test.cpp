#include "monocular_eye_hand/io/image_files.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;

class ImageFiles : public testing::Test {
 protected:
  ImageFiles() : folder_(testing::TempDir() + "/image_files_test") {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ + "/empty");
    for (const char* name :
         {"img_2.png", "img_10.png", "img_1.JPG", "img_0003.png", "notes.txt", "img_x.png"})
      std::ofstream(folder_ + "/" + name) << "x";
  }
  ~ImageFiles() override { std::filesystem::remove_all(folder_); }

  std::vector<std::string> names(const std::string& argument) const {
    std::vector<std::string> result;
    for (const std::string& file : imageFiles(folder_ + "/" + argument)) {
      EXPECT_TRUE(std::filesystem::exists(file)) << file;
      result.push_back(std::filesystem::path(file).filename().string());
    }
    return result;
  }

  std::string folder_;
};

TEST_F(ImageFiles, FolderByNumber) {
  EXPECT_THAT(names(""), ElementsAre("img_1.JPG", "img_2.png", "img_0003.png", "img_10.png", "img_x.png"));
  EXPECT_THROW(names("empty"), BadInput);
}

TEST_F(ImageFiles, Pattern) {
  EXPECT_THAT(names("img_%d.png"), ElementsAre("img_2.png", "img_10.png"));
  EXPECT_THAT(names("img_%04d.png"), ElementsAre("img_0003.png"));
  EXPECT_THROW(names("other_%d.png"), BadInput);
  EXPECT_THROW(names("img_%s.png"), BadInput);
  EXPECT_THROW(names("img_%d_%d.png"), BadInput);
}

TEST_F(ImageFiles, AFileIsItselfEvenWhereItIsMissing) {
  EXPECT_THAT(names("img_2.png"), ElementsAre("img_2.png"));
  EXPECT_THAT(imageFiles("/nowhere/a.png"), ElementsAre("/nowhere/a.png"));
}

}  // namespace
}  // namespace monocular_eye_hand
