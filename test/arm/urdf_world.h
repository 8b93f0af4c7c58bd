#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/arm/load_arm_description.h"

namespace monocular_eye_hand {

inline std::string urdfPath() { return MONOCULAR_EYE_HAND_SOURCE_DIR "/urdf/puma560.urdf"; }

inline std::string urdfText() {
  std::stringstream text;
  text << std::ifstream(urdfPath()).rdbuf();
  return text.str();
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// A URDF in a file of its own, far from the meshes.
class TemporaryUrdf {
 public:
  explicit TemporaryUrdf(const std::string& text) : path_(testing::TempDir() + "arm_description_test.urdf") {
    std::ofstream(path_) << text;
  }
  ~TemporaryUrdf() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A prism over a polygon of `sides` points at the corners of a box or on the rim of a cylinder.
inline Mesh prismMesh(const Eigen::Vector3d& size, bool round) {
  const int sides = round ? 64 : 4;
  Mesh mesh;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * (i + 0.5) / sides;
    const double x = round ? size.x() * std::cos(angle) : std::copysign(size.x() / 2, std::cos(angle));
    const double y = round ? size.y() * std::sin(angle) : std::copysign(size.y() / 2, std::sin(angle));
    mesh.vertices.emplace_back(x, y, -size.z() / 2);
    mesh.vertices.emplace_back(x, y, size.z() / 2);
  }

  for (int i = 0; i < sides; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    if (i < 2) continue;
    mesh.triangles.push_back({0, a, a - 2});
    mesh.triangles.push_back({1, a - 1, a + 1});
  }
  return mesh;
}

/// The shape as triangles in its own frame.
inline Mesh meshOf(const ArmShape& shape) {
  if (shape.kind == ArmShape::Kind::kMesh) return *shape.mesh;
  return prismMesh(shape.size, shape.kind == ArmShape::Kind::kCylinder);
}

inline const ArmDescription& description() {
  static const ArmDescription arm = loadArmDescription(urdfPath());
  return arm;
}

}  // namespace monocular_eye_hand
