#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/model_base.h"
#include "shapes.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;
using testing::HasSubstr;

/// A file in the test's own temporary folder, removed at the end.
class File {
 public:
  File(const std::string& extension, const std::string& bytes) {
    static int number = 0;
    path = testing::TempDir() + "load_mesh_" + std::to_string(getpid()) + "_" + std::to_string(number++) +
           "." + extension;
    std::ofstream(path, std::ios::binary) << bytes;
  }
  ~File() { std::remove(path.c_str()); }
  std::string path;
};

Mesh load(const std::string& extension, const std::string& bytes, const std::string& unit = "mm") {
  return loadMesh(File(extension, bytes).path, unit);
}
std::string failure(const std::string& extension, const std::string& bytes) {
  const File file(extension, bytes);
  try {
    loadMesh(file.path, "mm");
  } catch (const BadInput& e) {
    EXPECT_THAT(e.what(), HasSubstr(file.path));
    return e.what();
  }
  return "no error";
}

template <class T>
std::string raw(T value, bool big = false) {
  std::string s(reinterpret_cast<const char*>(&value), sizeof value);
  return big ? std::string(s.rbegin(), s.rend()) : s;
}
std::string asciiStl(const Mesh& m) {
  std::ostringstream out;
  out << "solid part\n";
  for (const auto& t : m.triangles) {
    out << " facet normal 0 0 0\n  outer loop\n";
    for (const int v : t) out << "   vertex " << m.vertices[v].transpose() << "\n";
    out << "  endloop\n endfacet\n";
  }
  out << "endsolid part\n";
  return out.str();
}
std::string binaryStl(const Mesh& m, const std::string& title = "binary") {
  std::string s = title;
  s.resize(80, ' ');
  s += raw(uint32_t(m.triangles.size()));
  for (const auto& t : m.triangles) {
    for (int k = 0; k < 3; ++k) s += raw(0.0f);
    for (const int v : t) {
      for (int k = 0; k < 3; ++k) s += raw(float(m.vertices[v][k]));
    }
    s += raw(uint16_t(0));
  }
  return s;
}
std::string ply(const Mesh& m, const std::string& format) {
  std::ostringstream out;
  out << "ply\nformat " << format << " 1.0\ncomment made by a test\nelement vertex " << m.vertices.size()
      << "\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\nelement face "
      << m.triangles.size() << "\nproperty short flags\nproperty list uchar int vertex_indices\nend_header\n";
  const bool big = format == "binary_big_endian";
  for (const Point& v : m.vertices) {
    if (format == "ascii") {
      out << v.transpose() << " 7\n";
    } else {
      out << raw(float(v.x()), big) << raw(double(v.y()), big) << raw(float(v.z()), big) << char(7);
    }
  }
  for (const auto& t : m.triangles) {
    if (format == "ascii") {
      out << "-3 3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    } else {
      out << raw(int16_t(-3), big) << char(3) << raw(int32_t(t[0]), big) << raw(int32_t(t[1]), big)
          << raw(int32_t(t[2]), big);
    }
  }
  return out.str();
}

void expectBox(const Mesh& m, double x, double y, double z) {
  Eigen::AlignedBox3d box;
  for (const Point& v : m.vertices) box.extend(v);
  EXPECT_EQ(m.triangles.size(), 12u);
  EXPECT_LT((box.sizes() - Point(x, y, z)).norm(), 1e-8);
}

const Mesh kBox = box(40, 50, 60);

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
  std::string obj;
  for (const Point& v : kBox.vertices) {
    std::ostringstream line;
    line << "v " << v.transpose() << "\n";
    obj += line.str();
  }
  for (const auto& t : kBox.triangles) {
    obj += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) +
           "\n";
  }
  expectBox(load("obj", obj), 0.04, 0.05, 0.06);
  // The unit and the "up" of a COLLADA file do not count: the caller states the unit, and the frame is the
  // file's.
  for (const char* up : {"Z_UP", "Y_UP", "X_UP"}) {
    for (const char* unit : {"<unit name=\"inch\" meter=\"0.0254\"/>", "<unit meter=\"1\"/>", ""}) {
      std::ostringstream dae;
      dae << "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
             "version=\"1.4.1\">"
          << "<asset>" << unit << "<up_axis>" << up << "</up_axis></asset><library_geometries>"
          << "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\""
          << 3 * kBox.vertices.size() << "\">";
      for (const Point& v : kBox.vertices) dae << v.transpose() << " ";
      dae << "</float_array><technique_common><accessor source=\"#a\" count=\"" << kBox.vertices.size()
          << "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
          << "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\">"
          << "<input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\""
          << kBox.triangles.size() << "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>";
      for (const auto& t : kBox.triangles) dae << t[0] << " " << t[1] << " " << t[2] << " ";
      dae << "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene "
             "id=\"s\">"
          << "<node id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
          << "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
      SCOPED_TRACE(std::string(up) + " " + unit);
      expectBox(load("dae", dae.str()), 0.04, 0.05, 0.06);
    }
  }
}

TEST(LoadMesh, UnitsAreStated) {
  expectBox(load("stl", asciiStl(kBox), "m"), 40, 50, 60);
  expectBox(load("stl", asciiStl(kBox), "cm"), 0.4, 0.5, 0.6);
  expectBox(load("stl", asciiStl(kBox), "inch"), 40 * 0.0254, 50 * 0.0254, 60 * 0.0254);
  EXPECT_EQ(metresPerUnit("mm"), 0.001);
  try {
    metresPerUnit("furlong");
    FAIL();
  } catch (const BadInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("furlong"));
    EXPECT_THAT(e.what(), HasSubstr("m, cm, mm, inch"));
  }
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
  EXPECT_THAT(failure("stl", ""), HasSubstr("empty"));
  EXPECT_THAT(failure("step", "ISO-10303"), HasSubstr("unknown kind"));
  EXPECT_THAT(failure("stl", "hello"), HasSubstr("too few"));
  EXPECT_THAT(failure("stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 x 2\n"), HasSubstr("line 4"));
  EXPECT_THAT(failure("stl", "solid a\nendsolid a\n"), HasSubstr("no triangles"));
  std::string nan = asciiStl(kBox);
  nan.replace(nan.find("vertex") + 7, 3, "nan");
  EXPECT_THAT(failure("stl", nan), HasSubstr("finite"));
  std::string binary_nan = binaryStl(kBox);
  const float not_a_number = std::nanf(""), infinite = INFINITY;
  std::memcpy(&binary_nan[84 + 12], &not_a_number, 4);
  EXPECT_THAT(failure("stl", binary_nan), HasSubstr("finite"));
  std::memcpy(&binary_nan[84 + 12], &infinite, 4);
  EXPECT_THAT(failure("stl", binary_nan), HasSubstr("finite"));
  std::string absurd = binaryStl(kBox);
  std::memset(&absurd[80], 0xff, 4);
  EXPECT_THAT(failure("stl", absurd), HasSubstr("4294967295 triangles"));
  EXPECT_THAT(failure("stl", binaryStl(kBox) + "tail"), HasSubstr("bytes"));
}

TEST(LoadMesh, BadPlyFilesAreRefusedWithTheReason) {
  EXPECT_THAT(failure("ply", "plx\n"), HasSubstr("ply"));
  EXPECT_THAT(failure("ply", "ply\nelement vertex 1\nend_header\n1\n"), HasSubstr("format"));
  EXPECT_THAT(failure("ply", "ply\nformat ascii 2.0\nend_header\n\n"), HasSubstr("1.0"));
  EXPECT_THAT(failure("ply", "ply\nformat nonsense 1.0\nend_header\n\n"), HasSubstr("nonsense"));
  EXPECT_THAT(failure("ply", plyText(kFour, "3 0 1 4\n", 4, 1)), HasSubstr("vertex 4"));
  EXPECT_THAT(failure("ply", plyText(kFour, "3 0 1 -1\n", 4, 1)), HasSubstr("vertex -1"));
  EXPECT_THAT(failure("ply", plyText(kFour, "2 0 1\n", 4, 1)), HasSubstr("fewer than three"));
  EXPECT_THAT(failure("ply", plyText(kFour, "3 0 1 2\n", 4, 2000000000)), HasSubstr("damaged"));
  EXPECT_THAT(failure("ply", plyText(kFour, "99999 0 1 2\n", 4, 1)), HasSubstr("damaged"));
  EXPECT_THAT(failure("ply", plyText(kFour, "-3 0 1 2\n", 4, 1)), HasSubstr("damaged"));
  EXPECT_THAT(failure("ply", plyText("0 0 0\n1 0 inf\n1 1 0\n0 1 0\n", "3 0 1 2\n", 4, 1)),
              HasSubstr("finite"));
  EXPECT_THAT(failure("ply", plyText("0 0 0\n1 0 1e999\n1 1 0\n0 1 0\n", "3 0 1 2\n", 4, 1)),
              HasSubstr("finite"));
  EXPECT_THAT(failure("ply", plyText(kFour, "3 0 1 2\n3 0 2 3\n", 4, 1)), HasSubstr("data follow"));
  EXPECT_THAT(failure("ply", plyText(kFour, "", 4, 0)), HasSubstr("no triangles"));
  EXPECT_THAT(
      failure("ply",
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nelement face 0\n"
              "property list uchar int vertex_index\nend_header\n1 2\n"),
      HasSubstr("\"z\""));
  EXPECT_THAT(failure("ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                      "property float z\nend_header\n1 2 3\n"),
              HasSubstr("face"));
  EXPECT_THAT(failure("ply",
                      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000000000000\n"
                      "property float x\nproperty float y\nproperty float z\nend_header\n1234"),
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
      EXPECT_THROW(load(extension, bytes.substr(0, length)), BadInput) << extension << " cut at " << length;
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
