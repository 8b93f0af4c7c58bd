#include "monocular_eye_hand/io/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

void expectRefused(const std::function<void()>& call, const std::vector<std::string>& named) {
  const std::string message = refusal(call);
  EXPECT_NE(message, kAccepted);
  for (const std::string& word : named) EXPECT_THAT(message, testing::HasSubstr(word));
  EXPECT_EQ(message.find("bad conversion"), std::string::npos) << message;
}

class CameraFiles : public ::testing::Test {
 protected:
  void TearDown() override { std::remove(path_.c_str()); }
  std::string write(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string path_ = ::testing::TempDir() + "monocular_eye_hand_camera_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
};

const char kGood[] = R"(image_width: 640
image_height: 480
camera_name: left
camera_matrix:
  rows: 3
  cols: 3
  data: [620.0, 0.0, 318.3, 0.0, 615.0, 243.7, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.28, 0.08, 0.001, -0.0005, 0.0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(CameraFiles, Good) {
  const Camera c = loadCamera(write(kGood));
  EXPECT_EQ(c.width, 640);
  EXPECT_EQ(c.height, 480);
  EXPECT_EQ(c.fx, 620);
  EXPECT_EQ(c.fy, 615);
  EXPECT_EQ(c.cx, 318.3);
  EXPECT_EQ(c.cy, 243.7);
  EXPECT_EQ(c.model, DistortionModel::kPlumbBob);
  EXPECT_EQ(c.d[0], -0.28);
  EXPECT_EQ(c.d[3], -0.0005);
  const Camera undistorted =
      loadCamera(write(std::string(kGood).substr(0, std::string(kGood).find("distortion_model"))));
  EXPECT_FALSE(undistorted.distorted());
}

TEST_F(CameraFiles, BadOnesNameFileAndField) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& named) {
    std::vector<std::string> all = named;
    all.push_back(path_);
    write(text);
    expectRefused([&] { loadCamera(path_); }, all);
  };

  expectRefused([] { loadCamera("/nowhere/camera.yaml"); }, {"/nowhere/camera.yaml", "cannot be read"});
  refused("", {"empty"});
  refused("just text", {"no camera calibration", "ost.ini"});
  refused("[1, 2, 3]", {"no camera calibration"});
  refused("image_width: [", {"line 1", "not YAML"});
  refused("image_width: 640\ncamera: &a {intrinsics: *a}", {"line 2", "nested too deeply"});

  refused(replaced("image_width: 640\n", ""), {"image_width", "missing"});
  refused(replaced("image_height: 480\n", ""), {"image_height", "missing"});
  refused(replaced("image_width: 640", "image_width: wide"), {"image_width", "wide"});
  refused(replaced("image_width: 640", "image_width: 640.5"), {"image_width", "whole number"});
  refused(replaced("image_width: 640", "image_width: 0"), {"width"});

  refused(replaced("camera_matrix:", "other_matrix:"), {"camera_matrix", "missing"});
  refused(replaced("620.0, 0.0, ", "620.0, "), {"camera_matrix", "8", "9"});
  refused(replaced("620.0", ".nan"), {"camera_matrix", "finite"});
  refused(replaced("620.0", ".inf"), {"camera_matrix", "finite"});
  refused(replaced("620.0", "f"), {"camera_matrix", "\"f\""});
  refused(replaced("620.0", "\"620,5\""), {"camera_matrix", "620,5"});
  refused(replaced("620.0", "0.0"), {"fx", "calibrate"});
  refused(replaced("620.0", "62.0"), {"fx", "fifth"});
  refused(replaced("318.3", "3183"), {"cx", "outside"});
  refused(replaced("0.0, 0.0, 1.0]", "0.0, 0.0, 2.0]"), {"camera_matrix"});
  refused(replaced("620.0, 0.0, 318.3, 0.0, 615.0, 243.7, 0.0, 0.0, 1.0",
                   "620, 0, 0, 0, 615, 0, 318.3, 243.7, 1"),
          {"camera_matrix"});  // transposed

  refused(replaced("-0.28", ".nan"), {"distortion_coefficients", "finite"});
  refused(replaced("plumb_bob", "omnidirectional"), {"omnidirectional", "plumb_bob"});
  refused(replaced("-0.0005, 0.0]", "-0.0005, 0.0, 0.1]"), {"plumb_bob", "6"});
}

// The cases of this file tell of one camera in many kinds of file: 640 x 480, f = 700 and 710 px.
void expectCamera(const Camera& c) {
  EXPECT_EQ(c.width, 640);
  EXPECT_EQ(c.height, 480);
  EXPECT_EQ(c.fx, 700);
  EXPECT_EQ(c.fy, 710);
  EXPECT_EQ(c.cx, 321.5);
  EXPECT_EQ(c.cy, 238.25);
}

TEST_F(CameraFiles, OpenCVFileStorage) {
  const std::string matrix =
      ": !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 7.0e+02, 0., 321.5, 0., 710., "
      "238.25,\n"
      "       0., 0., 1. ]\n";
  const std::string lens =
      ": !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ -0.1, 0.02, 0., 0., 0.5 ]\n";
  const std::string start = "%YAML:1.0\n---\n";

  for (const std::string& text :
       {start + "image_width: 640\nimage_height: 480\ncamera_matrix" + matrix + "distortion_coefficients" +
            lens,
        start + "image_Width: 640\nimage_Height: 480\nCamera_Matrix" + matrix + "Distortion_Coefficients" +
            lens,
        "%YAML:1.0\nimageSize: [ 640, 480 ]\ncameraMatrix" + matrix + "distCoeffs" + lens,
        start + "size: !!opencv-size\n  [ 640, 480 ]\nK" + matrix + "D" + lens}) {
    SCOPED_TRACE(text);
    const CameraFile file = readCameraFile(write(text));
    expectCamera(file.camera);
    EXPECT_EQ(file.camera.d[4], 0.5);
    EXPECT_EQ(file.camera.model, DistortionModel::kPlumbBob);
  }

  write(start + "camera_matrix" + matrix);
  expectRefused([&] { loadCamera(path_); }, {path_, "OpenCV FileStorage", "image_width", "missing"});
  write(start + "M1" + matrix + "D1" + lens + "M2" + matrix + "D2" + lens + "image_width: 640\n");
  expectRefused([&] { loadCamera(path_); }, {"stereo pair"});
}

TEST_F(CameraFiles, OpenCVXmlAndJson) {
  const CameraFile xml = readCameraFile(
      write("<?xml version=\"1.0\"?>\n<!-- made by calibration.cpp -->\n<opencv_storage>\n"
            "<image_width>640</image_width>\n<image_height>480</image_height>\n"
            "<camera_matrix type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n  "
            "<data>\n"
            "    7.0e+02 0. 321.5 0. 710. 238.25\n    0. 0. 1.</data></camera_matrix>\n"
            "<distortion_coefficients type_id=\"opencv-matrix\"><rows>5</rows><cols>1</cols><dt>d</dt>\n"
            "<data>-0.1 0. 0. 0. 0.</data></distortion_coefficients>\n</opencv_storage>\n"));
  expectCamera(xml.camera);
  EXPECT_EQ(xml.camera.d[0], -0.1);
  const CameraFile json = readCameraFile(
      write("{\"width\": 640, \"height\": 480, \"fx\": 700, \"fy\": 710, \"ppx\": 321.5, \"ppy\": 238.25, "
            "\"model\": \"Brown Conrady\", \"coeffs\": [0.0, 0.0, 0.0, 0.0, 0.0]}"));
  expectCamera(json.camera);
  write("<opencv_storage><image_width>640</image_width>");
  expectRefused([&] { loadCamera(path_); }, {"XML", "damaged"});
}

TEST_F(CameraFiles, CameraInfoPrintedByRostopic) {
  const std::string start =
      "header: \n  seq: 12\n  stamp: \n    secs: 1\n    nsecs: 2\n  frame_id: \"camera\"\nheight: 480\n"
      "width: 640\ndistortion_model: \"plumb_bob\"\nD: [-0.1, 0.0, 0.0, 0.0, 0.0]\n"
      "K: [700.0, 0.0, 321.5, 0.0, 710.0, 238.25, 0.0, 0.0, 1.0]\nR: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
      "P: [690.0, 0.0, 321.5, 0.0, 0.0, 700.0, 238.25, 0.0, 0.0, 0.0, 1.0, 0.0]\n";
  const std::string roi =
      "roi: \n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n  do_rectify: False\n---\n";
  const CameraFile file = readCameraFile(write(start + "binning_x: 0\nbinning_y: 0\n" + roi));
  expectCamera(file.camera);
  EXPECT_EQ(file.kind, "CameraInfo");
  ASSERT_TRUE(file.projection.has_value());
  EXPECT_EQ((*file.projection)[0], 690);

  // Several messages behind one another; then one of a binned image.
  expectCamera(loadCamera(write(start + roi + start + roi)));
  const Camera binned = loadCamera(write(start + "binning_x: 2\nbinning_y: 2\n" + roi));
  EXPECT_EQ(binned.width, 320);
  EXPECT_EQ(binned.fx, 350);
  EXPECT_EQ(binned.cx, 160.5);
}

TEST_F(CameraFiles, Kalibr) {
  const std::string lens = "  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]\n  distortion_model: radtan\n";
  const std::string rest =
      "  intrinsics: [700.0, 710.0, 321.5, 238.25]\n  resolution: [640, 480]\n  rostopic: "
      "/camera/image_raw\n";
  const std::string model = "  camera_model: pinhole\n";
  const CameraFile file = readCameraFile(write("cam0:\n  cam_overlaps: []\n" + model + lens + rest));
  expectCamera(file.camera);
  EXPECT_EQ(file.kind, "kalibr camchain");
  EXPECT_EQ(file.camera.d[3], -0.002);

  expectCamera(
      loadCamera(write("cam0:\n" + model + "  distortion_coeffs: []\n  distortion_model: none\n" + rest)));
  write("cam0:\n" + model + lens + rest + "cam1:\n" + model + lens + rest);
  expectRefused([&] { loadCamera(path_); }, {"cam0, cam1", "file of its own"});
  const Camera wide = loadCamera(write("cam0:\n" + model +
                                       "  distortion_coeffs: [0.01, -0.02, 0.003, -0.004]\n"
                                       "  distortion_model: equidistant\n" +
                                       rest));
  expectCamera(wide);
  EXPECT_EQ(wide.model, DistortionModel::kEquidistant);
  EXPECT_EQ(wide.d[3], -0.004);
  write("cam0:\n  camera_model: omni\n" + lens + rest);
  expectRefused([&] { loadCamera(path_); }, {"omni", "pinhole"});
}

const char kIni[] =
    "# oST version 5.0 parameters\n\n\n[image]\n\nwidth\n640\n\nheight\n480\n\n[narrow_stereo]\n\n"
    "camera matrix\n700.0 0.0 321.5\n0.0 710.0 238.25\n0.0 0.0 1.0\n\ndistortion\n-0.1 0.0 0.0 0.0 0.0\n\n"
    "rectification\n1.0 0.0 0.0\n0.0 1.0 0.0\n0.0 0.0 1.0\n\nprojection\n700.0 0.0 321.5 0.0\n"
    "0.0 710.0 238.25 0.0\n0.0 0.0 1.0 0.0\n";

TEST_F(CameraFiles, OstIni) {
  const CameraFile file = readCameraFile(write(kIni));
  expectCamera(file.camera);
  EXPECT_EQ(file.camera.d[0], -0.1);
  EXPECT_TRUE(file.projection.has_value());
  std::string windows;
  for (const char c : std::string(kIni)) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expectCamera(loadCamera(write(windows)));
  write(std::string(kIni) + "[narrow_stereo/right]\ncamera matrix\n1 0 0\n0 1 0\n0 0 1\n");
  expectRefused([&] { loadCamera(path_); }, {"two cameras"});
}

TEST_F(CameraFiles, ViSP) {
  const std::string start =
      "<?xml version=\"1.0\"?>\n<root>\n <!--comment-->\n <camera>\n  <name>Camera</name>\n"
      "  <image_width>640</image_width>\n  <image_height>480</image_height>\n";
  const auto model = [](const std::string& type, const std::string& more) {
    return "  <model>\n   <type>" + type + "</type>\n   <px>700</px>\n   <py>710</py>\n   <u0>321.5</u0>\n" +
           "   <v0>238.25</v0>\n" + more + "  </model>\n";
  };
  const std::string plain = model("perspectiveProjWithoutDistortion", "");
  const std::string distorted =
      model("perspectiveProjWithDistortion", "   <kud>-0.11</kud>\n   <kdu>0.12</kdu>\n");
  const std::string end = " </camera>\n</root>\n";
  expectCamera(loadCamera(write(start + plain + end)));
  EXPECT_FALSE(loadCamera(path_).distorted());

  const CameraFile both = readCameraFile(write(start + plain + distorted + end));
  expectCamera(both.camera);
  EXPECT_EQ(both.camera.d[0], -0.11);
  write(start + model("ProjWithKannalaBrandtDistortion", "") + end);
  expectRefused([&] { loadCamera(path_); }, {"ViSP", "ProjWithKannalaBrandtDistortion"});
}

TEST_F(CameraFiles, MatricesAsScriptsWriteThem) {
  expectCamera(
      loadCamera(write("resolution: [640, 480]\ncamera_matrix: [[700.0, 0.0, 321.5], [0.0, 710.0, 238.25], "
                       "[0.0, 0.0, 1.0]]\ndist_coeff: [[-0.1, 0.0, 0.0, 0.0, 0.0]]\n")));
  expectCamera(
      loadCamera(write("%YAML:1.0\nCamera.fx: 700.0\nCamera.fy: 710.0\nCamera.cx: 321.5\nCamera.cy: 238.25\n"
                       "Camera.k1: -0.1\nCamera.width: 640\nCamera.height: 480\n")));
  EXPECT_EQ(loadCamera(path_).d[0], -0.1);
}

TEST_F(CameraFiles, TextOfOtherEditors) {
  const CameraFile marked = readCameraFile(write("\xef\xbb\xbf" + std::string(kGood)));
  EXPECT_EQ(marked.camera.fx, 620);
  ASSERT_EQ(marked.warnings.size(), 1u);
  EXPECT_NE(marked.warnings[0].find("byte order mark"), std::string::npos);
  std::string wide = "\xff\xfe", old;
  for (const char c : std::string(kGood)) {
    wide += c;
    wide += '\0';
    old += c == '\n' ? '\r' : c;
  }
  const CameraFile converted = readCameraFile(write(wide));
  EXPECT_EQ(converted.camera.fx, 620);
  ASSERT_EQ(converted.warnings.size(), 1u);
  EXPECT_NE(converted.warnings[0].find("UTF-16"), std::string::npos);
  EXPECT_EQ(loadCamera(write(old)).fx, 620);
}

TEST_F(CameraFiles, NamesWhatAFileReallyIs) {
  const auto refused = [&](const std::string& text, const std::vector<std::string>& named) {
    write(text);
    expectRefused([&] { loadCamera(path_); }, named);
  };
  refused("version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12\n",
          {"Git LFS", "git lfs pull"});
  refused("<!DOCTYPE html>\n<html></html>", {"web page"});
  refused(std::string("\x93NUMPY\x01\0v", 9), {"NumPy"});
  refused("<?xml version=\"1.0\"?><robot name=\"arm\"/>", {"no camera calibration", "<robot>"});
  refused(std::string("\x01\x02\x03\0\0\0", 6), {"binary"});
  refused("left:\n  camera_matrix: [1]\nright:\n  camera_matrix: [1]\n", {"left, right"});
}

TEST_F(CameraFiles, PrincipalPointsFarFromTheMiddleAreWarnedOf) {
  EXPECT_TRUE(readCameraFile(write(kGood)).warnings.empty());
  // Calibrated at twice the size; cropped at the right.
  for (const auto& [from, to] : {std::pair("243.7", "470.0"), std::pair("318.3", "480.0")}) {
    const CameraFile file = readCameraFile(write(replaced(from, to)));
    ASSERT_EQ(file.warnings.size(), 1u) << to;
    EXPECT_NE(file.warnings[0].find("binning"), std::string::npos);
    EXPECT_NE(file.warnings[0].find("cropped"), std::string::npos);
  }
}

TEST_F(CameraFiles, LensesThatFoldAreNamed) {
  write(replaced("-0.28, 0.08, 0.001, -0.0005, 0.0", "-2.8, 0.08, 0.001, -0.0005, 0.0"));
  expectRefused([&] { loadCamera(path_); }, {path_, "folds over", "Calibrate"});
}

TEST(CameraFileCases, OfTheField) {
  const char* data = std::getenv("MONOCULAR_EYE_HAND_DATA");
  if (!data) GTEST_SKIP() << "MONOCULAR_EYE_HAND_DATA is not set: files of the field are not read";
  const std::string folder = std::string(data) + "/field_cases/calibration/";
  for (const char* name :
       {"01_opencv_filestorage.yaml", "01b_opencv_camelcase.yaml", "02_kalibr.yaml", "08_plumb8_zero.yaml",
        "13_radtan.yaml", "13b_none.yaml", "22_rostopic_echo.yaml", "24_ost.ini"}) {
    SCOPED_TRACE(name);
    const Camera camera = loadCamera(folder + name);
    EXPECT_EQ(camera.width, 640);
    EXPECT_EQ(camera.height, 480);
    EXPECT_EQ(camera.fx, 700);
    EXPECT_EQ(camera.fy, 700);
  }
  expectRefused([&] { loadCamera(folder + "lens_folds_over.yaml"); }, {"folds over inside the image"});
}

}  // namespace
}  // namespace monocular_eye_hand
