#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "mesh_file.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;
using testing::HasSubstr;

Mesh load(const std::string& extension, const std::string& bytes, const std::string& unit = "mm") {
  return loadMesh(MeshFile(extension, bytes).path, unit);
}

void expectBox(const Mesh& m, double x, double y, double z) {
  Eigen::AlignedBox3d box;
  for (const Point& v : m.vertices) box.extend(v);
  EXPECT_EQ(m.triangles.size(), 12u);
  EXPECT_LT((box.sizes() - Point(x, y, z)).norm(), 1e-8);
}

TEST(LoadMesh, ReadsEveryFormat) {
  expectBox(load("stl", asciiStl(kBox)), 0.04, 0.05, 0.06);
  expectBox(load("STL", binaryStl(kBox)), 0.04, 0.05, 0.06);
  expectBox(load("stl", binaryStl(kBox, "solid that is binary")), 0.04, 0.05, 0.06);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    expectBox(load("ply", ply(kBox, format)), 0.04, 0.05, 0.06);
  }
}

TEST(LoadMesh, ReadsTwoSolidsAndCapitalsAndWindowsLineEnds) {
  std::string text = asciiStl(kBox) + asciiStl(kBox);
  EXPECT_EQ(load("stl", text).triangles.size(), 24u);
  std::string other;
  for (const char c : asciiStl(kBox)) {
    if (c == '\n') other += '\r';
    other += char(std::toupper(c));
  }
  expectBox(load("stl", other), 0.04, 0.05, 0.06);
  std::string header = ply(kBox, "ascii"), crlf;
  for (const char c : header) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expectBox(load("ply", crlf), 0.04, 0.05, 0.06);
}

TEST(LoadMesh, ReadsObjAndDae) {
  expectBox(load("obj", obj(kBox)), 0.04, 0.05, 0.06);
  // The unit and the "up" of a COLLADA file do not count: the caller states the unit, and the frame is the
  // file's.
  for (const char* up : {"Z_UP", "Y_UP", "X_UP"}) {
    for (const char* unit : {"<unit name=\"inch\" meter=\"0.0254\"/>", "<unit meter=\"1\"/>", ""}) {
      SCOPED_TRACE(std::string(up) + " " + unit);
      expectBox(load("dae", dae(kBox, unit, up)), 0.04, 0.05, 0.06);
    }
  }
}

TEST(LoadMesh, UnitsAreStated) {
  expectBox(load("stl", asciiStl(kBox), "m"), 40, 50, 60);
  expectBox(load("stl", asciiStl(kBox), "cm"), 0.4, 0.5, 0.6);
  expectBox(load("stl", asciiStl(kBox), "inch"), 40 * 0.0254, 50 * 0.0254, 60 * 0.0254);
  EXPECT_EQ(metresPerUnit("mm"), 0.001);
  const std::string message = refusal([&] { metresPerUnit("furlong"); });
  EXPECT_THAT(message, HasSubstr("furlong"));
  EXPECT_THAT(message, HasSubstr("m, cm, mm, inch"));
}

std::string plyText(const std::string& vertices, const std::string& faces, int nv, int nf) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(nv) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(nf) +
         "\nproperty list uchar int vertex_index\nend_header\n" + vertices + faces;
}
const char* kFour = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(LoadMesh, PolygonsAreTriangulatedInsideTheirOutline) {
  EXPECT_EQ(load("ply", plyText(kFour, "4 0 1 2 3\n", 4, 1)).triangles.size(), 2u);
  // A concave arrow: a fan from its first corner would leave the outline.
  const Mesh m = load("ply", plyText("2 0 0\n0 1 0\n-2 0 0\n0 3 0\n", "4 0 3 2 1\n", 4, 1), "m");
  ASSERT_EQ(m.triangles.size(), 2u);
  double area = 0;
  for (const auto& t : m.triangles) {
    const double part =
        0.5 * (m.vertices[t[1]] - m.vertices[t[0]]).cross(m.vertices[t[2]] - m.vertices[t[0]]).z();
    EXPECT_GT(part, 0);
    area += part;
  }
  EXPECT_NEAR(area, 4, 1e-9);
}

TEST(LoadMesh, BadFilesAreRefusedWithTheReason) {
  EXPECT_THROW(loadMesh("/no/such/file.stl", "mm"), BadInput);
  EXPECT_THROW(loadMesh(testing::TempDir(), "mm"), BadInput);
  EXPECT_THAT(refusalOf("stl", ""), HasSubstr("empty"));
  EXPECT_THAT(refusalOf("step", "ISO-10303"), HasSubstr("unknown kind"));
  EXPECT_THAT(refusalOf("stl", "hello"), HasSubstr("where solid should stand"));
  EXPECT_THAT(refusalOf("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 x 2\n"),
              HasSubstr("line 4"));
  EXPECT_THAT(refusalOf("stl", "solid a\nendsolid a\n"), HasSubstr("no triangles"));
  std::string nan = asciiStl(kBox);
  nan.replace(nan.find("vertex") + 7, 3, "nan");
  EXPECT_THAT(refusalOf("stl", nan), HasSubstr("finite"));

  std::string binary_nan = binaryStl(kBox);
  const float not_a_number = std::nanf(""), infinite = INFINITY;
  std::memcpy(&binary_nan[84 + 12], &not_a_number, 4);
  EXPECT_THAT(refusalOf("stl", binary_nan), HasSubstr("finite"));
  std::memcpy(&binary_nan[84 + 12], &infinite, 4);
  EXPECT_THAT(refusalOf("stl", binary_nan), HasSubstr("finite"));
  std::string absurd = binaryStl(kBox).substr(0, 84 + 11 * 50);
  std::memset(&absurd[80], 0x7f, 4);
  EXPECT_THAT(refusalOf("stl", absurd), HasSubstr("2139062143 triangles"));
}

TEST(LoadMesh, BadPlyFilesAreRefusedWithTheReason) {
  EXPECT_THAT(refusalOf("ply", "plx\n"), HasSubstr("ply"));
  EXPECT_THAT(refusalOf("ply", "ply\nelement vertex 1\nend_header\n1\n"), HasSubstr("format"));
  EXPECT_THAT(refusalOf("ply", "ply\nformat ascii 2.0\nend_header\n\n"), HasSubstr("1.0"));
  EXPECT_THAT(refusalOf("ply", "ply\nformat nonsense 1.0\nend_header\n\n"), HasSubstr("nonsense"));

  EXPECT_THAT(refusalOf("ply", plyText(kFour, "3 0 1 4\n", 4, 1)), HasSubstr("vertex 4"));
  EXPECT_THAT(refusalOf("ply", plyText(kFour, "3 0 1 -1\n", 4, 1)), HasSubstr("vertex -1"));
  EXPECT_THAT(refusalOf("ply", plyText(kFour, "2 0 1\n", 4, 1)), HasSubstr("no triangles"));
  EXPECT_THAT(refusalOf("ply", plyText(kFour, "3 0 1 2\n", 4, 2000000000)), HasSubstr("damaged"));
  EXPECT_THAT(refusalOf("ply", plyText(kFour, "99999 0 1 2\n", 4, 1)), HasSubstr("damaged"));
  EXPECT_THAT(refusalOf("ply", plyText(kFour, "-3 0 1 2\n", 4, 1)), HasSubstr("damaged"));

  EXPECT_THAT(refusalOf("ply", plyText("0 0 0\n1 0 inf\n1 1 0\n0 1 0\n", "3 0 1 2\n", 4, 1)),
              HasSubstr("finite"));
  EXPECT_THAT(refusalOf("ply", plyText("0 0 0\n1 0 1e999\n1 1 0\n0 1 0\n", "3 0 1 2\n", 4, 1)),
              HasSubstr("finite"));
  EXPECT_THAT(refusalOf("ply", plyText(kFour, "", 4, 0)), HasSubstr("no triangles"));

  EXPECT_THAT(
      refusalOf(
          "ply",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nelement face 0\n"
          "property list uchar int vertex_index\nend_header\n1 2\n"),
      HasSubstr("\"z\""));
  EXPECT_THAT(refusalOf("ply",
                        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n1 2 3\n"),
              HasSubstr("face"));
  EXPECT_THAT(refusalOf("ply",
                        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000000000000\n"
                        "property float x\nproperty float y\nproperty float z\nelement face 1\n"
                        "property list uchar int vertex_indices\nend_header\n1234"),
              HasSubstr("damaged"));
}

/// Every prefix of a good file must be refused (never crash, never pass), and damage must not crash.
TEST(LoadMesh, TruncationAtEveryLengthIsRefused) {
  Mesh two;
  quad(&two, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});

  for (const auto& [extension, bytes] :
       {std::make_pair("stl", asciiStl(two)), std::make_pair("stl", binaryStl(two)),
        std::make_pair("stl", binaryStl(two, "solid")), std::make_pair("ply", ply(two, "ascii")),
        std::make_pair("ply", ply(two, "binary_little_endian")),
        std::make_pair("ply", ply(two, "binary_big_endian"))}) {
    // What may be missing without harm: the name and line end after endsolid, the last digits' line end.
    const bool text = bytes.find("endsolid") != std::string::npos || bytes.find("ascii") != std::string::npos;
    const size_t tail = bytes.find("endsolid") != std::string::npos
                            ? bytes.size() - bytes.rfind("endsolid") - 8
                        : text ? 1
                               : 0;
    for (size_t length = 0; length < bytes.size() - tail; ++length) {
      const std::string cut = bytes.substr(0, length);
      // Behind a whole facet only endsolid is missing, which is warned of.
      const size_t last = cut.find_last_not_of(" \n"), facet = cut.rfind("endfacet");
      if (text && facet != std::string::npos && facet + 7 == last) continue;
      EXPECT_THROW(load(extension, cut), BadInput) << extension << " cut at " << length;
    }
    EXPECT_EQ(load(extension, bytes).triangles.size(), 2u);
  }
}

TEST(LoadMesh, RandomDamageIsReadOrRefusedButNeverCrashes) {
  Mesh two;
  quad(&two, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  std::mt19937 random(17);
  int read = 0, refused = 0;
  for (const auto& [extension, bytes] :
       {std::make_pair("stl", asciiStl(two)), std::make_pair("stl", binaryStl(two)),
        std::make_pair("ply", ply(two, "ascii")), std::make_pair("ply", ply(two, "binary_little_endian"))}) {
    for (int k = 0; k < 400; ++k) {
      std::string damaged = bytes;
      for (int n = 0; n < 1 + k % 4; ++n) damaged[random() % damaged.size()] = char(random() % 256);
      try {
        for (const Point& v : load(extension, damaged).vertices) ASSERT_TRUE(v.allFinite());
        ++read;
      } catch (const BadInput&) {
        ++refused;
      }
    }
  }

  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace monocular_eye_hand
