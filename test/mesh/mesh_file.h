#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "monocular_eye_hand/mesh/load_mesh.h"
#include "shapes.h"
#include "support/refusal.h"

namespace monocular_eye_hand {

/// A file in the test's own temporary folder, removed at the end.
class MeshFile {
 public:
  MeshFile(const std::string& extension, const std::string& bytes) {
    static int number = 0;
    path = testing::TempDir() + "load_mesh_" + std::to_string(getpid()) + "_" + std::to_string(number++) +
           "." + extension;
    std::ofstream(path, std::ios::binary) << bytes;
  }
  ~MeshFile() { std::remove(path.c_str()); }
  MeshFile(const MeshFile&) = delete;
  MeshFile& operator=(const MeshFile&) = delete;
  std::string path;
};

/// The message with which a file is refused.
inline std::string refusalOf(const std::string& extension, const std::string& bytes) {
  const MeshFile file(extension, bytes);
  const std::string message = refusal([&] { loadMesh(file.path, "mm"); });
  if (message != kAccepted) {
    EXPECT_NE(message.find(file.path), std::string::npos) << message;
  }
  return message;
}

template <class T>
std::string raw(T value, bool big = false) {
  std::string s(reinterpret_cast<const char*>(&value), sizeof value);
  return big ? std::string(s.rbegin(), s.rend()) : s;
}

inline std::string asciiStl(const Mesh& m) {
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

inline std::string binaryStl(const Mesh& m, const std::string& title = "binary") {
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

inline std::string ply(const Mesh& m, const std::string& format) {
  std::ostringstream out;
  out << "ply\nformat " << format << " 1.0\ncomment made by a test\nelement vertex " << m.vertices.size()
      << "\nproperty float x\nproperty double y\nproperty float z\nproperty uchar red\nelement face "
      << m.triangles.size() << "\nproperty short flags\nproperty list uchar int vertex_indices\nend_header\n";
  const bool big = format == "binary_big_endian";
  for (const Eigen::Vector3d& v : m.vertices) {
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

inline std::string obj(const Mesh& m) {
  std::ostringstream out;
  for (const Eigen::Vector3d& v : m.vertices) out << "v " << v.transpose() << "\n";
  for (const auto& t : m.triangles) out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  return out.str();
}

/// `unit`: the whole <unit> element, or nothing.
inline std::string dae(const Mesh& m, const std::string& unit, const std::string& up = "Z_UP") {
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\">"
      << "<asset>" << unit << "<up_axis>" << up << "</up_axis></asset><library_geometries>"
      << "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"" << 3 * m.vertices.size()
      << "\">";
  for (const Eigen::Vector3d& v : m.vertices) out << v.transpose() << " ";

  out << "</float_array><technique_common><accessor source=\"#a\" count=\"" << m.vertices.size()
      << "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
      << "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\">"
      << "<input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"" << m.triangles.size()
      << "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>";
  for (const auto& t : m.triangles) out << t[0] << " " << t[1] << " " << t[2] << " ";
  out << "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene "
         "id=\"s\">"
      << "<node id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
      << "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
  return out.str();
}

}  // namespace monocular_eye_hand
