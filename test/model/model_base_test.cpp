#include "monocular_eye_hand/model/model_base.h"
#include "model/build_model.h"

#include <dirent.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "../mesh/shapes.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "support/refusal.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;
using testing::HasSubstr;

/// A folder of its own for each test, emptied at the end.
class Folder {
 public:
  Folder() {
    std::string name = testing::TempDir() + "model_base_XXXXXX";
    path = mkdtemp(&name[0]);
  }
  ~Folder() {
    for (const std::string& f : files()) std::remove((path + "/" + f).c_str());
    rmdir(path.c_str());
  }
  std::vector<std::string> files() const {
    std::vector<std::string> out;
    DIR* dir = opendir(path.c_str());
    while (const dirent* entry = dir ? readdir(dir) : nullptr) {
      if (entry->d_name[0] != '.') out.push_back(entry->d_name);
    }
    if (dir) closedir(dir);
    return out;
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path + "/" + name, std::ios::binary) << text;
    return path + "/" + name;
  }
  std::string path;
};

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

ObjectEntry entry(const std::string& name) { return {name, shippedModel(name), "mm", {}}; }

void expectEqual(const KnownObject& a, const KnownObject& b) {
  ASSERT_EQ(a.views.views.size(), b.views.views.size());
  EXPECT_EQ(a.views.step, b.views.step);
  EXPECT_EQ(a.views.directions, b.views.directions);
  EXPECT_EQ(a.views.distances, b.views.distances);
  for (size_t k = 0; k < a.views.views.size(); ++k) {
    const SampledView &v = a.views.views[k], &w = b.views.views[k];
    EXPECT_EQ(v.direction, w.direction);
    EXPECT_EQ(v.characteristic_view, w.characteristic_view);
    ASSERT_EQ(v.contour.size(), w.contour.size());
    for (size_t s = 0; s < v.contour.size(); ++s) {
      EXPECT_EQ(v.contour[s].p, w.contour[s].p);
      EXPECT_EQ(v.contour[s].tangent, w.contour[s].tangent);
      EXPECT_EQ(v.contour[s].feature, w.contour[s].feature);
      EXPECT_EQ(v.contour[s].silhouette, w.contour[s].silhouette);
      EXPECT_EQ(v.contour[s].inner_side, w.contour[s].inner_side);
    }
  }

  ASSERT_EQ(a.views.characteristic.size(), b.views.characteristic.size());
  for (size_t k = 0; k < a.views.characteristic.size(); ++k) {
    EXPECT_EQ(a.views.characteristic[k].features, b.views.characteristic[k].features);
    EXPECT_EQ(a.views.characteristic[k].weight, b.views.characteristic[k].weight);
  }

  ASSERT_EQ(a.model.symmetries.discrete.size(), b.model.symmetries.discrete.size());
  for (size_t k = 0; k < a.model.symmetries.discrete.size(); ++k) {
    EXPECT_EQ(a.model.symmetries.discrete[k].rotation, b.model.symmetries.discrete[k].rotation);
    EXPECT_EQ(a.model.symmetries.discrete[k].translation, b.model.symmetries.discrete[k].translation);
  }
  ASSERT_EQ(bool(a.model.symmetries.axis), bool(b.model.symmetries.axis));
  if (a.model.symmetries.axis) {
    EXPECT_EQ(a.model.symmetries.axis->direction, b.model.symmetries.axis->direction);
  }
  EXPECT_EQ(a.model.warnings, b.model.warnings);
}

TEST(ModelBase, ShippedBaseLoads) {
  const ModelBase base = loadModels(std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/objects.yaml",
                                    ModelDepth::kViews, {}, "none");
  EXPECT_EQ(base.names(), "bridge, grenade, frame, flange, bracket");
  EXPECT_EQ(base.indexOf("flange"), 3);
  EXPECT_EQ(base.indexOf("teapot"), -1);
  for (const KnownObject& o : base.objects) EXPECT_GT(o.views.views.size(), 0u);
}

TEST(ModelBase, EachDepthHoldsWhatTheDeeperOneHolds) {
  Folder folder;
  std::vector<std::string> told;
  const auto tell = [&](const std::string& text) { told.push_back(text); };
  const auto compiled = [&](ModelDepth depth) {
    return compileModels({entry("flange")}, depth, {}, folder.path, tell).objects.at(0);
  };
  const KnownObject mesh = compiled(ModelDepth::kMesh);
  EXPECT_TRUE(told.empty());
  EXPECT_TRUE(mesh.model.edges.empty());
  const KnownObject full = compiled(ModelDepth::kViews);
  told.clear();
  const KnownObject shape = compiled(ModelDepth::kShape);
  EXPECT_TRUE(told.empty()) << "the symmetries come from the cache";
  EXPECT_TRUE(shape.views.views.empty());

  EXPECT_EQ(mesh.model.mesh.vertices, full.model.mesh.vertices);
  EXPECT_EQ(mesh.model.mesh.triangles, full.model.mesh.triangles);
  EXPECT_EQ(mesh.model.diameter, full.model.diameter);
  EXPECT_EQ(mesh.model.closed, full.model.closed);
  EXPECT_EQ(shape.model.edges.size(), full.model.edges.size());
  ASSERT_EQ(shape.model.symmetries.discrete.size(), full.model.symmetries.discrete.size());
  for (size_t k = 0; k < full.model.symmetries.discrete.size(); ++k)
    EXPECT_EQ(shape.model.symmetries.discrete[k].rotation, full.model.symmetries.discrete[k].rotation);
}

TEST(ModelBase, ShapesWithoutACacheAreTheSame) {
  const ObjectModel built = buildModel("flange", loadMesh(shippedModel("flange"), "mm"));
  const ObjectModel loaded =
      compileModels({entry("flange")}, ModelDepth::kShape, {}, "none").objects.at(0).model;
  EXPECT_EQ(loaded.mesh.vertices, built.mesh.vertices);
  EXPECT_EQ(loaded.edges.size(), built.edges.size());
  EXPECT_EQ(loaded.symmetries.discrete.size(), built.symmetries.discrete.size());
}

TEST(ModelBase, ProgressIsTold) {
  Folder folder;
  std::vector<std::string> told;
  const auto tell = [&](const std::string& text) { told.push_back(text); };
  compileModels({entry("flange")}, ModelDepth::kViews, {}, folder.path, tell);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_THAT(told[0], HasSubstr("flange ("));
  EXPECT_THAT(told[0], HasSubstr("symmetries"));
  compileModels({entry("flange")}, ModelDepth::kViews, {}, folder.path,
                tell);  // from the cache: nothing takes long
  EXPECT_EQ(told.size(), 2u);
}

/// A block of `n` x `n` facets a face whose vertices are off by noise, as a scanner leaves them.
Mesh scannedBlock(int n, double noise) {
  std::mt19937 random(5);
  std::normal_distribution<double> off(0, noise);
  Mesh m;

  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      std::vector<Point> grid;
      for (int k = 0; k < (n + 1) * (n + 1); ++k) {
        Point p;
        p[axis] = 0.03 * side + off(random);
        p[(axis + 1) % 3] = 0.03 * (2.0 * (k % (n + 1)) / n - 1);
        p[(axis + 2) % 3] = 0.03 * (2.0 * (k / (n + 1)) / n - 1);
        grid.push_back(p);
      }
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const int a = j * (n + 1) + i, b = a + n + 1;
          if (side > 0) quad(&m, grid[a], grid[a + 1], grid[b + 1], grid[b]);
          if (side < 0) quad(&m, grid[a], grid[b], grid[b + 1], grid[a + 1]);
        }
      }
    }
  }
  return m;
}

TEST(Scans, NoisyOnesAreRefusedAndSmallerOnesWarnedAbout) {
  for (const int n : {60, 120}) {
    const std::string message = refusal([&] { buildModel("scan", scannedBlock(n, 0.0005)); });
    EXPECT_THAT(message, HasSubstr("scan"));
    EXPECT_THAT(message, HasSubstr("CAD model"));
  }
  bool warned = false;
  for (const std::string& w : buildModel("scan", scannedBlock(30, 0.0005)).warnings)
    warned = warned || w.find("more than a CAD part has") != std::string::npos;
  EXPECT_TRUE(warned);
  // Many triangles without noise are a CAD part.
  EXPECT_EQ(buildModel("block", scannedBlock(80, 0)).edges.size(), 12u);
}

TEST(Cache, GivesTheSameAndIsRebuiltWhenDamaged) {
  const Folder folder;
  for (const char* name : {"bridge", "flange"}) {
    const ModelBase fresh = compileModels({entry(name)}, ModelDepth::kViews, {}, "none");
    const size_t before = folder.files().size();
    const ModelBase first = compileModels({entry(name)}, ModelDepth::kViews, {}, folder.path);
    ASSERT_EQ(folder.files().size(), before + 1);
    const ModelBase second = compileModels({entry(name)}, ModelDepth::kViews, {}, folder.path);
    EXPECT_EQ(folder.files().size(), before + 1);
    expectEqual(fresh.objects[0], first.objects[0]);
    expectEqual(fresh.objects[0], second.objects[0]);
  }
}

TEST(Cache, DamageAtManyPlacesIsNoticed) {
  const Folder folder;
  ViewOptions views;
  views.spacing = 0.6;
  const ModelBase good = compileModels({entry("frame")}, ModelDepth::kViews, views, folder.path);
  const std::string name = folder.files().at(0), bytes = bytesOf(folder.path + "/" + name);
  for (size_t k = 0; k < 40; ++k) {
    std::string bad = bytes;
    if (k % 2 == 0) {
      bad[k * (bytes.size() - 1) / 40] ^= 0x10;
    } else {
      bad.resize(k * bytes.size() / 40);
    }
    folder.write(name, bad);
    expectEqual(good.objects[0],
                compileModels({entry("frame")}, ModelDepth::kViews, views, folder.path).objects[0]);
    ASSERT_EQ(bytesOf(folder.path + "/" + name), bytes) << "not rebuilt after damage " << k;
  }
}

TEST(Cache, IsReadAndNotOnlyWritten) {
  // A sound file under the same name with another object's content must show in the result.
  const Folder folder, other;
  compileModels({entry("frame")}, ModelDepth::kViews, {}, folder.path);
  compileModels({entry("bridge")}, ModelDepth::kViews, {}, other.path);
  folder.write(folder.files().at(0), bytesOf(other.path + "/" + other.files().at(0)));
  EXPECT_EQ(compileModels({entry("frame")}, ModelDepth::kViews, {}, folder.path)
                .objects[0]
                .model.symmetries.discrete.size(),
            2u);
}

TEST(Cache, MeshUnitAndOptionsMakeItStale) {
  const Folder folder;
  ObjectEntry e = entry("frame");
  compileModels({e}, ModelDepth::kViews, {}, folder.path);
  ViewOptions views;
  views.samples_per_view = 60;
  compileModels({e}, ModelDepth::kViews, views, folder.path);
  e.unit = "cm";
  compileModels({e}, ModelDepth::kViews, {}, folder.path);
  e.unit = "mm";
  e.options.symmetry_tolerance = 1e-3;
  compileModels({e}, ModelDepth::kViews, {}, folder.path);
  e = entry("bridge");
  e.name = "frame";
  compileModels({e}, ModelDepth::kViews, {}, folder.path);
  EXPECT_EQ(folder.files().size(), 5u);
}

TEST(Cache, AFolderThatCannotBeWrittenIsNoError) {
  const Folder folder;
  const std::string file = folder.write("taken", "a file where the folder should be");
  EXPECT_EQ(compileModels({entry("frame")}, ModelDepth::kViews, {}, file + "/cache").objects.size(), 1u);
}

// Once, however many objects could not be kept; not at all where there is no cache, or where all went well.
TEST(Cache, AFolderThatCannotBeWrittenIsToldOnce) {
  const Folder folder;
  const std::string file = folder.write("taken", "a file where the folder should be");
  const auto toldOf = [](const std::string& cache) {
    std::vector<std::string> told;
    compileModels({entry("frame"), entry("bridge")}, ModelDepth::kViews, {}, cache,
                  [&](const std::string& text) {
                    if (text.find("cannot be written") != std::string::npos) told.push_back(text);
                  });
    return told;
  };
  const std::vector<std::string> told = toldOf(file + "/cache");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], HasSubstr(file + "/cache"));
  EXPECT_TRUE(toldOf("none").empty());
  EXPECT_TRUE(toldOf(folder.path + "/new").empty());
}

TEST(Cache, FolderFollowsTheEnvironment) {
  const Folder folder;
  setenv("XDG_CACHE_HOME", folder.path.c_str(), 1);
  compileModels({entry("frame")}, ModelDepth::kViews, {}, "");
  unsetenv("XDG_CACHE_HOME");
  const std::string inside = folder.path + "/monocular_eye_hand";
  DIR* dir = opendir(inside.c_str());
  ASSERT_TRUE(dir);
  int files = 0;
  while (const dirent* e = readdir(dir)) {
    if (e->d_name[0] == '.') continue;
    ++files;
    std::remove((inside + "/" + e->d_name).c_str());
  }
  closedir(dir);
  rmdir(inside.c_str());
  EXPECT_EQ(files, 1);
}

TEST(SimilarModels, AreWarnedAboutInBothModels) {
  ObjectEntry twin = entry("bridge");
  twin.name = "bridge2";
  ObjectEntry larger = twin;
  larger.name = "big bridge";
  larger.unit = "cm";
  ViewOptions views;
  views.spacing = 0.6;
  const ModelBase base =
      compileModels({entry("bridge"), twin, larger, entry("frame")}, ModelDepth::kViews, views, "none");
  EXPECT_THAT(base.objects[0].model.warnings,
              testing::Contains(HasSubstr("looks like bridge2: one is easily")));
  EXPECT_THAT(base.objects[1].model.warnings, testing::Contains(HasSubstr("looks like bridge:")));
  EXPECT_THAT(base.objects[2].model.warnings, testing::Contains(HasSubstr("another size")));
  EXPECT_TRUE(base.objects[3].model.warnings.empty());
}

std::string refusalOfEntries(const std::string& yaml) {
  const Folder folder;
  folder.write("part.ply", bytesOf(shippedModel("bridge")));
  const std::string message = refusal([&] { readObjectEntries(folder.write("objects.yaml", yaml)); });
  if (message != kAccepted) {
    EXPECT_THAT(message, HasSubstr("objects.yaml"));
  }
  return message;
}

TEST(ObjectEntries, PathsUnitsAndOverrides) {
  const Folder folder;
  folder.write("part.ply", bytesOf(shippedModel("bridge")));
  const std::string yaml =
      folder.write("objects.yaml",
                   "objects:\n- {name: a, mesh: part.ply, unit: inch, sharp_angle: 0.5}\n"
                   "- {name: b, mesh: " +
                       shippedModel("frame") + ", find_symmetries: false}\n");
  const auto entries = readObjectEntries(yaml);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].mesh, folder.path + "/part.ply");
  EXPECT_EQ(entries[0].unit, "inch");
  EXPECT_EQ(entries[0].options.sharp_angle, 0.5);
  EXPECT_EQ(entries[1].unit, "mm");
  EXPECT_EQ(entries[1].mesh, shippedModel("frame"));
  EXPECT_FALSE(entries[1].options.find_symmetries);
}

TEST(ObjectEntries, MeshPathsMayNamePackagesUrlsAndVariables) {
  Folder folder;
  folder.write("part.stl", "solid");
  folder.write("package.xml", "<package><name>parts_of_a_test</name></package>");
  setenv("ROS_PACKAGE_PATH", folder.path.c_str(), 1);
  setenv("PARTS_OF_A_TEST", folder.path.c_str(), 1);
  for (const std::string& mesh :
       {std::string("package://parts_of_a_test/part.stl"), "file://" + folder.path + "/part.stl",
        std::string("$PARTS_OF_A_TEST/part.stl"), std::string("${PARTS_OF_A_TEST}/part.stl")}) {
    const std::string yaml = folder.write("o.yaml", "objects: [{name: a, mesh: \"" + mesh + "\"}]\n");
    EXPECT_EQ(readObjectEntries(yaml).front().mesh, folder.path + "/part.stl") << mesh;
  }
  const std::string yaml =
      folder.write("o.yaml", "objects: [{name: a, mesh: \"package://not_there/p.stl\"}]\n");
  EXPECT_THAT(refusal([&] { readObjectEntries(yaml); }), HasSubstr("there is no ROS package \"not_there\""));
}

TEST(ObjectEntries, MistakesAreNamed) {
  EXPECT_THROW(readObjectEntries("/no/such/objects.yaml"), BadInput);
  EXPECT_THAT(refusalOfEntries("objects: [{name: a"), HasSubstr("objects.yaml"));
  EXPECT_THAT(refusalOfEntries("object: []"), HasSubstr("unknown key 'object'; did you mean 'objects'?"));
  EXPECT_THAT(refusalOfEntries("objects: []"), HasSubstr("at least one"));
  EXPECT_THAT(refusalOfEntries("just text"), HasSubstr("objects"));
  EXPECT_THAT(refusalOfEntries("objects: [3]"), HasSubstr("name"));
  EXPECT_THAT(refusalOfEntries("objects: [{mesh: part.ply}]"), HasSubstr("\"name\" is missing"));
  EXPECT_THAT(refusalOfEntries("objects: [{name: a}]"), HasSubstr("\"mesh\" is missing"));
  EXPECT_THAT(refusalOfEntries("objects: [{name: a, mesh: none.stl}]"), HasSubstr("none.stl"));
  EXPECT_THAT(refusalOfEntries("objects: [{name: a, mesh: part.ply, units: mm}]"),
              HasSubstr("objects.yaml: object 1 (a): unknown key 'units'; did you mean 'unit'?"));
  EXPECT_THAT(refusalOfEntries("objects: [{name: a, mesh: part.ply, unit: ell}]"),
              HasSubstr("known: m, cm, mm, inch"));
  EXPECT_THAT(refusalOfEntries("objects: [{name: a, mesh: part.ply, sharp_angle: wide}]"),
              HasSubstr("sharp_angle"));
  EXPECT_THAT(refusalOfEntries("objects: [{name: a, mesh: part.ply, sharp_angle: 9}]"),
              HasSubstr("sharp_angle"));
  EXPECT_THAT(refusalOfEntries("objects: [{name: a, mesh: part.ply}, {name: a, mesh: part.ply}]"),
              HasSubstr("used twice"));
}

}  // namespace
}  // namespace monocular_eye_hand
