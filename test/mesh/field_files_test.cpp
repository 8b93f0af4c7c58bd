// Mesh files as people have them: other programs read them, so they are read, and what was wrong is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "mesh_file.h"
#include "model/build_model.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/mesh/repair_mesh.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kWeldShare = 1e-6;  // of the diameter
/// The warnings on reading a file, which must hold the box.
std::vector<std::string> warningsOf(const std::string& extension, const std::string& bytes,
                                    const std::string& unit = "mm") {
  const MeshFile file(extension, bytes);
  const LoadedMesh loaded = readMesh(file.path, unit);
  EXPECT_EQ(loaded.mesh.triangles.size(), 12u);
  Eigen::AlignedBox3d bounds;
  for (const Point& v : loaded.mesh.vertices) bounds.extend(v);
  EXPECT_LT((bounds.sizes() / metresPerUnit(unit) - Point(40, 50, 60)).norm(), 1e-4);
  return loaded.warnings;
}

std::string withReturns(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? '\r' : c;
  return out;
}

std::string utf16(const std::string& text, bool little, bool mark) {
  std::string out = !mark ? "" : little ? "\xff\xfe" : "\xfe\xff";
  for (const char c : text) out += little ? std::string{c, '\0'} : std::string{'\0', c};
  return out;
}

std::string withCount(std::string stl, uint32_t count) {
  std::memcpy(&stl[80], &count, sizeof count);
  return stl;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(FieldFiles, GoodOnesAreReadWithoutAWord) {
  EXPECT_THAT(warningsOf("stl", asciiStl(kBox)), IsEmpty());
  EXPECT_THAT(warningsOf("stl", binaryStl(kBox)), IsEmpty());
  EXPECT_THAT(warningsOf("ply", ply(kBox, "ascii")), IsEmpty());
  EXPECT_THAT(warningsOf("obj", obj(kBox)), IsEmpty());
  EXPECT_THAT(warningsOf("dae", dae(kBox, "<unit name=\"millimeter\" meter=\"0.001\"/>")), IsEmpty());
}

TEST(FieldFiles, BytesBehindTheData) {
  for (const size_t count : {1u, 50u, 92u, 100u, 1000u})
    EXPECT_THAT(warningsOf("stl", binaryStl(kBox) + std::string(count, '\0')),
                ElementsAre(HasSubstr(std::to_string(count) + " byte")));
  EXPECT_THAT(warningsOf("stl", binaryStl(kBox) + "exported by a program, copyright, and so on"),
              ElementsAre(HasSubstr("43 bytes")));
  EXPECT_THAT(warningsOf("stl", asciiStl(kBox) + "\x1a"), ElementsAre(HasSubstr("1 byte behind endsolid")));
  EXPECT_THAT(warningsOf("stl", asciiStl(kBox) + std::string(30, '\0')), ElementsAre(HasSubstr("30 bytes")));
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(format);
    EXPECT_THAT(warningsOf("ply", ply(kBox, format) + "tail"), ElementsAre(HasSubstr("4 bytes")));
    EXPECT_THAT(warningsOf("ply", ply(kBox, format) + "\x1a"), ElementsAre(HasSubstr("1 byte")));
  }
}

TEST(FieldFiles, CountsThatTheSizePutsRight) {
  const std::string stl = binaryStl(kBox);
  for (const uint32_t count : {0u, 0xffffffffu, 11u, 13u, 5000u})
    EXPECT_THAT(warningsOf("stl", withCount(stl, count)),
                ElementsAre(HasSubstr("the file holds 12, which were read")));
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* count : {"0", "11", "13", "4000"}) {
      SCOPED_TRACE(std::string(format) + " " + count);
      const std::string wrong = replaced(ply(kBox, format), "face 12", std::string("face ") + count);
      EXPECT_THAT(warningsOf("ply", wrong), ElementsAre(HasSubstr(std::string("says ") + count)));
    }
  }
  // What is missing of an open mesh cannot be known.
  EXPECT_THAT(refusalOf("stl", stl.substr(0, stl.size() - 50)), HasSubstr("cut off"));
  EXPECT_THAT(refusalOf("ply", replaced(ply(kBox, "ascii"), "face 12", "face 13").substr(0, 620)),
              HasSubstr("cut off"));
}

TEST(FieldFiles, SolidsOneBehindTheOther) {
  const MeshFile file("stl", binaryStl(kBox) + binaryStl(kBox));
  const LoadedMesh loaded = readMesh(file.path, "mm");
  EXPECT_EQ(loaded.mesh.triangles.size(), 24u);
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("another solid")));
}

TEST(FieldFiles, ByteOrderMarks) {
  for (const auto& [extension, text] :
       {std::pair("stl", asciiStl(kBox)), std::pair("ply", ply(kBox, "ascii")), std::pair("obj", obj(kBox)),
        std::pair("dae", dae(kBox, ""))}) {
    SCOPED_TRACE(extension);
    EXPECT_THAT(warningsOf(extension, "\xef\xbb\xbf" + text), ElementsAre(HasSubstr("byte order mark")));
    for (const bool little : {true, false}) {
      for (const bool mark : {true, false})
        EXPECT_THAT(warningsOf(extension, utf16(text, little, mark)), ElementsAre(HasSubstr("UTF-16")));
    }
  }
}

TEST(FieldFiles, CarriageReturnsAlone) {
  EXPECT_THAT(warningsOf("stl", withReturns(asciiStl(kBox))), ElementsAre(HasSubstr("carriage returns")));
  EXPECT_THAT(warningsOf("ply", withReturns(ply(kBox, "ascii"))), ElementsAre(HasSubstr("carriage returns")));
  EXPECT_THAT(warningsOf("obj", withReturns(obj(kBox))), ElementsAre(HasSubstr("carriage returns")));
  // The first byte of the data may be a line feed: it is no part of the header's last line end.
  Mesh fed = kBox;
  float x;
  std::memcpy(&x, "\x0a\0\xa0\xc1", 4);  // -20.000019
  for (Point& v : fed.vertices) v.x() = v.x() < 0 ? double(x) : v.x();
  const std::string whole = ply(fed, "binary_little_endian");
  const size_t data = whole.find("end_header\n") + 11;
  ASSERT_EQ(whole[data], '\n');
  EXPECT_THAT(warningsOf("ply", withReturns(whole.substr(0, data)) + whole.substr(data)),
              ElementsAre(HasSubstr("carriage returns")));
  // The line of a mistake is still told.
  EXPECT_THAT(refusalOf("stl", "solid a\rfacet normal 0 0 1\router loop\rvertex 1 x 2\r"),
              HasSubstr("line 4"));
}

TEST(FieldFiles, AsciiStlAsItIsWritten) {
  const std::string text = asciiStl(kBox);
  const std::string open = text.substr(0, text.find("endsolid"));
  EXPECT_THAT(warningsOf("stl", open), ElementsAre(HasSubstr("endsolid is missing")));
  EXPECT_THAT(warningsOf("stl", open.substr(0, open.size() - 1)), ElementsAre(HasSubstr("endsolid")));
  EXPECT_THAT(warningsOf("stl", text.substr(text.find(" facet"))), ElementsAre(HasSubstr("\"solid\"")));
  EXPECT_THAT(warningsOf("stl", replaced(text, "endloop", "end loop")), IsEmpty());
  EXPECT_THAT(warningsOf("stl", replaced(text, " facet", "color 0.5 0.5 0.5\n facet")),
              ElementsAre(HasSubstr("1 line")));
  EXPECT_THAT(refusalOf("stl", replaced(text, "vertex -20", "vertex -20,5")), HasSubstr("decimal point"));
}

TEST(FieldFiles, TextIsNeverCalledBinary) {
  for (const std::string& text :
       {std::string("hello, this is no mesh\n"), std::string(500, 'x'), std::string("# comment only\n")}) {
    EXPECT_THAT(refusalOf("stl", text), Not(HasSubstr("binary")));
    EXPECT_THAT(refusalOf("ply", text), Not(HasSubstr("binary")));
  }
}

std::string stripPly(const std::string& lists, int count, const std::string& format) {
  std::ostringstream out;
  out << "ply\nformat " << format << " 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
      << "property float z\nelement tristrips " << count
      << "\nproperty list int int vertex_indices\nend_header\n";
  const bool big = format == "binary_big_endian";
  std::istringstream numbers(lists);
  for (int k = 0; k < 8; ++k) {
    const float p[3] = {k & 1 ? 40.0f : 0.0f, k & 2 ? 50.0f : 0.0f, k & 4 ? 60.0f : 0.0f};
    for (const float x : p) format == "ascii" ? void(out << x << " ") : void(out << raw(x, big));
  }
  for (int n; numbers >> n;) format == "ascii" ? void(out << n << " ") : void(out << raw(n, big));
  return out.str();
}

TEST(FieldFiles, TriangleStrips) {
  // A cube in one strip of 14 corners; and as two lists of strips with breaks, of which one has a swap.
  const std::string one = "14  0 2 1 3 7 2 6 0 4 1 5 7 4 6";
  const std::string two = "15  1 3 0 2 -1 2 6 3 7 -1 3 7 1 5 -1   17  5 0 1 -1 0 5 4 6 -1 2 0 6 -1 4 5 6 7";
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(format);
    const MeshFile file("ply", stripPly(one, 1, format));
    const RepairedMesh cube = repairMesh("cube", readMesh(file.path, "mm").mesh, kWeldShare);
    EXPECT_EQ(cube.mesh.triangles.size(), 12u);
    EXPECT_TRUE(cube.closed);
    EXPECT_EQ(cube.turned, 0);
    EXPECT_FALSE(cube.inside_out);
    EXPECT_THAT(warningsOf("ply", stripPly(one, 1, format)), ElementsAre(HasSubstr("12 triangles")));
  }
  const MeshFile file("ply", stripPly(two, 2, "ascii"));
  EXPECT_THAT(readMesh(file.path, "mm").warnings, ElementsAre(HasSubstr("12 triangles")));
  EXPECT_THAT(refusalOf("ply", stripPly("4 0 1 2 8", 1, "ascii")), HasSubstr("vertex 8"));
}

TEST(FieldFiles, NotFiniteVerticesOfNoFace) {
  for (const char* bad : {"nan nan nan", "1 inf 2", "-nan 0 1e999"}) {
    const std::string text = replaced(ply(kBox, "ascii"), "-3 3 0", std::string(bad) + " 7\n-3 3 0");
    const std::string counted = replaced(text, "vertex " + std::to_string(kBox.vertices.size()),
                                         "vertex " + std::to_string(kBox.vertices.size() + 1));
    EXPECT_THAT(warningsOf("ply", counted), ElementsAre(HasSubstr("1 vertex of no face")));
  }
  // In front of the others: the faces' numbers must follow.
  Mesh shifted = kBox;
  shifted.vertices.insert(shifted.vertices.begin(), 2, Point(NAN, 0, 0));
  for (auto& t : shifted.triangles) {
    for (int& v : t) v += 2;
  }
  EXPECT_THAT(warningsOf("ply", ply(shifted, "binary_little_endian")),
              ElementsAre(HasSubstr("2 vertices of no face")));
  shifted.triangles[3][1] = 1;
  EXPECT_THAT(refusalOf("ply", ply(shifted, "binary_little_endian")), HasSubstr("finite"));
}

TEST(FieldFiles, FacesBeforeVertices) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement face 4\nproperty list uchar int vertex_index\nelement vertex 4\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n"
      "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  EXPECT_EQ(loadMesh(MeshFile("ply", text).path, "mm").triangles.size(), 4u);
}

TEST(FieldFiles, NamedForWhatTheyAre) {
  const std::string pointer =
      "version https://git-lfs.github.com/spec/v1\noid sha256:094db5fe7f25242c13\nsize 625707\n";
  for (const char* extension : {"stl", "ply", "obj", "dae"})
    EXPECT_THAT(refusalOf(extension, pointer), HasSubstr("git lfs pull"));
  const std::string step = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('part'),'2;1');\n";
  for (const char* extension : {"stl", "obj", "step"})
    EXPECT_THAT(refusalOf(extension, step), HasSubstr("STEP"));
  EXPECT_THAT(refusalOf("stl", "<!DOCTYPE html>\n<html>"), HasSubstr("web page"));
  EXPECT_THAT(refusalOf("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), testing::Ne(std::string(kAccepted)));
  EXPECT_THAT(refusalOf("ply",
                        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n1 2 3\n"),
              HasSubstr("point cloud"));
}

TEST(FieldFiles, WordsAmongTheNumbersOfADaeAreRefused) {
  const std::string text = dae(kBox, "");
  EXPECT_THAT(refusalOf("dae", replaced(text, "<p>", "<p>0 x ")), HasSubstr("<p> holds \"x\""));
  for (const char* word : {"^", ".", "1.5", "-", "1e", "end_header4"})
    EXPECT_THAT(refusalOf("dae", replaced(text, "</p>", std::string(" ") + word + " 9</p>")),
                HasSubstr("no number"));
  EXPECT_THAT(refusalOf("dae", replaced(text, "-20", "1,5")), HasSubstr("<float_array>"));
}

TEST(FieldFiles, ReadByContentWhateverTheName) {
  EXPECT_THAT(warningsOf("stl", ply(kBox, "binary_little_endian")), ElementsAre(HasSubstr("that of .ply")));
  EXPECT_THAT(warningsOf("stl", obj(kBox)), ElementsAre(HasSubstr("that of .obj")));
  EXPECT_THAT(warningsOf("obj", dae(kBox, "")), ElementsAre(HasSubstr("that of .dae")));
  EXPECT_THAT(warningsOf("ply", binaryStl(kBox)), ElementsAre(HasSubstr("that of .stl")));
  EXPECT_THAT(warningsOf("model", asciiStl(kBox)), ElementsAre(HasSubstr("that of .stl")));
}

TEST(FieldFiles, TheFilesOwnUnitIsCompared) {
  const auto other = [](const std::string& unit) { return ElementsAre(HasSubstr("its unit is " + unit)); };
  EXPECT_THAT(warningsOf("dae", dae(kBox, "<unit name=\"meter\" meter=\"1\"/>")), other("m, but"));
  EXPECT_THAT(warningsOf("dae", dae(kBox, "<unit meter='0.0254' name='inch'></unit>")), other("inch"));
  EXPECT_THAT(warningsOf("dae", dae(kBox, "<unit name=\"x\" meter=\"0,01\"/>")), other("cm"));
  EXPECT_THAT(warningsOf("dae", dae(kBox, "<unit name=\"millimeter\" meter=\"0,001\"/>")), IsEmpty());
  EXPECT_THAT(warningsOf("dae", dae(kBox, "<unit name=\"millimeter\" meter=\"0,001\"/>"), "m"),
              other("mm, but the stated unit is m"));
  EXPECT_THAT(warningsOf("dae", dae(kBox, "")), IsEmpty());
  EXPECT_THAT(warningsOf("obj", "# File units = meters\n" + obj(kBox)), other("m, but"));
  EXPECT_THAT(warningsOf("obj", "# File units = millimeters\n" + obj(kBox)), IsEmpty());
  EXPECT_THAT(warningsOf("stl", binaryStl(kBox, "part, units: inches")), other("inch"));
  EXPECT_THAT(warningsOf("ply", replaced(ply(kBox, "ascii"), "made by a test", "unit: cm")), other("cm"));
}

TEST(FieldFileCases, AreTheSamePart) {
  const char* data = std::getenv("MONOCULAR_EYE_HAND_DATA");
  if (!data) GTEST_SKIP() << "MONOCULAR_EYE_HAND_DATA is not set: files of the field are not read";
  const std::string folder = std::string(data) + "/field_cases/";
  for (const char* name :
       {"stl/02_trailing92.stl", "stl/04_count0.stl", "stl/06_bom.stl", "stl/07_cr_only.stl",
        "stl/09b_no_endsolid.stl", "ply/55_cr_binary.ply", "ply/57_tail.ply", "ply/61_tristrips.ply",
        "ply/67_nan_unused.ply", "dae_obj/40_bom.obj", "dae_obj/88_unit_comma.dae"}) {
    SCOPED_TRACE(name);
    const RepairedMesh part = repairMesh("part", loadMesh(folder + name, "mm"), kWeldShare);
    EXPECT_EQ(part.mesh.triangles.size(), 20u);
    EXPECT_TRUE(part.closed);
    Eigen::AlignedBox3d bounds;
    for (const Point& p : part.mesh.vertices) bounds.extend(p);
    EXPECT_LT((bounds.sizes() - Point(0.06, 0.04, 0.03)).norm(), 1e-8);
  }

  for (const char* name : {"stl/70_lfs.stl", "ply/70_lfs.ply"}) {
    EXPECT_THAT(refusal([&] { loadMesh(folder + name, "mm"); }), HasSubstr("git lfs pull"));
  }
}

}  // namespace
}  // namespace monocular_eye_hand
