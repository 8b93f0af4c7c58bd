#include "simulation/scenes/clutter_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh_checks.h"
#include "monocular_eye_hand/geometry/error.h"

using namespace monocular_eye_hand;

namespace {

void expectSolid(const Mesh& mesh, double expected) {
  EXPECT_TRUE(closed(mesh));
  EXPECT_NEAR(volume(mesh), expected, 0.01 * expected);
}

}  // namespace

TEST(ClutterShapes, AreClosedAndPointOutwards) {
  expectSolid(ringMesh(0.03, 0.02, 0.01, 100), M_PI * (9e-4 - 4e-4) * 0.01);
  expectSolid(screwMesh(0.006, 0.004, 0.003, 0.02), M_PI * (36e-6 * 0.004 + 9e-6 * 0.02));
  expectSolid(angleMesh(0.04, 0.03, 0.005, 0.1), (0.04 * 0.005 + 0.025 * 0.005) * 0.1);
  expectSolid(trayMesh({0.1, 0.08, 0.04}, 0.005), 0.1 * 0.08 * 0.04 - 0.09 * 0.07 * 0.035);
  expectSolid(cableMesh({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0.01, 0}}, 0.002, 40), M_PI * 4e-6 * 0.2);
  expectSolid(turnedMesh({{0, 0}, {0.03, 0}, {0, 0.05}}, 100), M_PI * 9e-4 * 0.05 / 3);
}

TEST(ClutterShapes, ImpossibleOnesAreRefused) {
  EXPECT_THROW(ringMesh(0.02, 0.02, 0.01), BadInput);
  EXPECT_THROW(screwMesh(0.002, 0.004, 0.003, 0.02), BadInput);
  EXPECT_THROW(angleMesh(0.004, 0.03, 0.005, 0.1), BadInput);
  EXPECT_THROW(trayMesh({0.01, 0.08, 0.04}, 0.005), BadInput);
  EXPECT_THROW(cableMesh({{0, 0, 0}}, 0.002), BadInput);
  EXPECT_THROW(turnedMesh({{0, 0}, {-0.03, 0}, {0, 0.05}}), BadInput);
}
