#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../mesh/shapes.h"
#include "model/build_model.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;

Symmetries symmetriesOf(const Mesh& mesh) { return buildModel("part", mesh).symmetries; }

/// Every listed motion maps the vertices of the mesh onto vertices, and the list is a group.
void checkGroup(const Mesh& mesh, const Symmetries& s, double tolerance) {
  for (const Rigid3& g : s.discrete) {
    EXPECT_NEAR(g.rotation.determinant(), 1, 1e-9);
    for (const Eigen::Vector3d& v : mesh.vertices) {
      double nearest = 1e9;
      for (const Eigen::Vector3d& w : mesh.vertices) nearest = std::min(nearest, (g * v - w).norm());
      EXPECT_LT(nearest, tolerance);
    }
    for (const Rigid3& h : s.discrete) {
      int equal = 0;
      for (const Rigid3& k : s.discrete) equal += (k.rotation - (g * h).rotation).norm() < 1e-3;
      EXPECT_EQ(equal, 1);
    }
  }
  EXPECT_TRUE(s.discrete.front().rotation.isIdentity(1e-12));
}

TEST(Symmetry, PolyhedraHaveTheirRotationGroups) {
  struct Case {
    const char* name;
    Mesh mesh;
    size_t order;
  };
  for (const Case& c :
       {Case{"cube", box(0.084, 0.084, 0.084), 24}, Case{"cuboid", box(0.438, 0.785, 0.556), 4},
        Case{"square bar", box(0.03, 0.03, 0.09), 8},
        Case{"hexagonal prism", prism(polygon(6, 0.03), 0.05), 12},
        Case{"triangular prism", prism(polygon(3, 0.03), 0.05), 6},
        Case{"plate with hole", plateWithHole(48, 0.03, 0.01, 0.008), 8},
        Case{"slot", prism(slot(12, 0.01, 0.02), 0.015), 4},
        Case{"wedge", prism({{0, 0}, {0.04, 0}, {0.02, 0.05}}, 0.05), 2},
        Case{"uneven wedge", prism({{0, 0}, {0.04, 0}, {0, 0.03}}, 0.05), 1}}) {
    for (unsigned pose = 0; pose < 3; ++pose) {
      const Mesh mesh = pose == 0 ? c.mesh : rounded(moved(c.mesh, somewhere(pose)));
      const Symmetries s = symmetriesOf(mesh);
      EXPECT_EQ(s.discrete.size(), c.order) << c.name << " pose " << pose;
      EXPECT_FALSE(s.axis) << c.name;
      EXPECT_FALSE(s.sphere) << c.name;
      checkGroup(mesh, s, 1e-4);
    }
  }
}

TEST(Symmetry, TwistedAndChiralPartsHaveNone) {
  // A right angle with unequal legs and thickness: its mirror image is another part.
  Mesh m = box(0.06, 0.01, 0.02);
  append(&m, moved(box(0.01, 0.03, 0.02), {Eigen::Matrix3d::Identity(), {0.025, 0.02, 0}}));
  append(&m, moved(box(0.012, 0.01, 0.03), {Eigen::Matrix3d::Identity(), {-0.024, 0, 0.025}}));
  EXPECT_EQ(symmetriesOf(m).discrete.size(), 1u);
}

TEST(Symmetry, ContinuousAxis) {
  for (const int n : {16, 36, 100}) {
    for (unsigned pose = 0; pose < 2; ++pose) {
      const Rigid3 motion = pose == 0 ? Rigid3{} : somewhere(11);
      const Eigen::Vector3d axis = motion.rotation.col(2);
      const Symmetries rod = symmetriesOf(rounded(moved(cylinder(n, 0.02, 0.05), motion)));
      ASSERT_TRUE(rod.axis) << n;
      EXPECT_EQ(rod.discrete.size(), 2u) << n;  // a flip is left
      EXPECT_NEAR(std::abs(rod.axis->direction.dot(axis)), 1, 1e-6);
      const Eigen::Vector3d off = rod.axis->point - motion.translation;
      EXPECT_LT((off - axis * axis.dot(off)).norm(), 1e-5);
      const Symmetries frustum = symmetriesOf(rounded(moved(cone(n, 0.03, 0.015, 0.04), motion)));
      ASSERT_TRUE(frustum.axis) << n;
      EXPECT_EQ(frustum.discrete.size(), 1u) << n;
    }
  }
}

TEST(Symmetry, CylinderAsHighAsItsMomentsAreEqualStillHasItsAxis) {
  // With equal moments every direction is a principal axis: the wall's own axis must do.
  const Symmetries s = symmetriesOf(cylinder(48, 0.02, 0.0283));
  ASSERT_TRUE(s.axis);
  EXPECT_NEAR(std::abs(s.axis->direction.z()), 1, 1e-6);
}

TEST(Symmetry, KeyedShaftHasNoAxis) {
  Mesh m = cylinder(64, 0.02, 0.05);
  append(&m, moved(box(0.006, 0.006, 0.02), {Eigen::Matrix3d::Identity(), {0.02, 0, 0.05}}));
  const Symmetries s = symmetriesOf(m);
  EXPECT_FALSE(s.axis);
  EXPECT_EQ(s.discrete.size(), 1u);
}

TEST(Symmetry, Sphere) {
  const Symmetries s = symmetriesOf(rounded(sphere(64, 0.03)));
  EXPECT_TRUE(s.sphere);
}

TEST(Symmetry, ShippedModels) {
  struct Want {
    const char* name;
    size_t order;
    bool axis;
  };
  for (const Want& w : {Want{"bridge", 2, false}, Want{"grenade", 1, false}, Want{"frame", 4, false},
                        Want{"flange", 1, true}, Want{"bracket", 1, false}}) {
    const Symmetries s = symmetriesOf(loadMesh(shippedModel(w.name), "mm"));
    EXPECT_EQ(s.discrete.size(), w.order) << w.name;
    EXPECT_EQ(bool(s.axis), w.axis) << w.name;
    if (s.axis) {
      EXPECT_NEAR(std::abs(s.axis->direction.z()), 1, 1e-9);
      EXPECT_LT(s.axis->point.head<2>().norm(), 1e-6);
    }
  }
}

TEST(Symmetry, ToleranceDecidesWhatIsEqual) {
  ModelOptions loose;
  loose.symmetry_tolerance = 0.02;
  const Mesh nearly_cube = box(0.080, 0.080, 0.081);
  EXPECT_EQ(buildModel("part", nearly_cube).symmetries.discrete.size(), 8u);
  EXPECT_EQ(buildModel("part", nearly_cube, loose).symmetries.discrete.size(), 24u);
}

TEST(Symmetry, NearSymmetricTwinIsWarnedAbout) {
  // A plate with one small stud: half a turn changes little.
  Mesh m = box(0.08, 0.05, 0.01);
  append(&m, moved(box(0.006, 0.006, 0.004), {Eigen::Matrix3d::Identity(), {0.02, 0, 0.007}}));
  const ObjectModel part = buildModel("part", m);
  EXPECT_EQ(part.symmetries.discrete.size(), 1u);
  bool warned = false;
  for (const std::string& w : part.warnings) warned = warned || w.find("nearly symmetric") == 0;
  EXPECT_TRUE(warned);
}

TEST(Symmetry, AgreesWithTheDataSets) {
  const char* data = std::getenv("MONOCULAR_EYE_HAND_DATA");
  if (!data) GTEST_SKIP() << "MONOCULAR_EYE_HAND_DATA is not set: the data sets' models are not compared";

  for (const std::string set : {"workcell", "real/cube", "real/cabinet"}) {
    const std::string folder = std::string(data) + "/" + set + "/models/";
    std::ifstream in(folder + "models_info.json");
    ASSERT_TRUE(in) << folder;
    const nlohmann::json info = nlohmann::json::parse(in);
    for (const auto& [id, truth] : info.items()) {
      const std::string file = folder + "obj_" + std::string(6 - id.size(), '0') + id + ".ply";
      const ObjectModel m = buildModel("part", loadMesh(file, "mm"));
      EXPECT_NEAR(m.diameter * 1000, truth["diameter"].get<double>(), 0.01) << file;
      const auto listed = truth.value("symmetries_discrete", nlohmann::json::array());
      const auto axes = truth.value("symmetries_continuous", nlohmann::json::array());
      EXPECT_EQ(m.symmetries.discrete.size(), listed.size() + 1) << file;
      EXPECT_EQ(bool(m.symmetries.axis), !axes.empty()) << file;

      for (const auto& s : listed) {
        Rigid3 want;
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c) want.rotation(r, c) = s[4 * r + c].get<double>();
          want.translation[r] = s[4 * r + 3].get<double>() / 1000;
        }
        double nearest = 1e9;
        for (const Rigid3& g : m.symmetries.discrete) {
          nearest = std::min(nearest,
                             (g.rotation - want.rotation).norm() + (g.translation - want.translation).norm());
        }
        EXPECT_LT(nearest, 1e-4) << file;
      }

      for (const auto& a : axes) {
        const Eigen::Vector3d want(a["axis"][0].get<double>(), a["axis"][1].get<double>(),
                                   a["axis"][2].get<double>());
        EXPECT_NEAR(std::abs(m.symmetries.axis->direction.dot(want)), 1, 1e-9) << file;
      }
    }
  }
}

}  // namespace
}  // namespace monocular_eye_hand
