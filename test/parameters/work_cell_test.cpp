#include <gtest/gtest.h>

#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/parameters/work_cell.h"
#include "monocular_eye_hand/simulation/cell/scene.h"

namespace monocular_eye_hand {
namespace {

const std::string kConfig = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/";

// Defaults stand in the structs; the shipped file repeats them for people and must not drift.
TEST(WorkCellParameters, ShippedCellHoldsTheDefaults) {
  CellOptions cell;
  cell.objects.clear();
  cell.lights.clear();
  cell.start_joints.fill(0);
  readOptions(loadYaml(kConfig + "cell.yaml"), &cell);
  EXPECT_EQ(writeOptions(cell), writeOptions(CellOptions()));
}

TEST(WorkCellParameters, ShippedCellNamesEveryOption) {
  const OptionTree file = loadYaml(kConfig + "cell.yaml");
  for (const auto& entry : writeOptions(CellOptions()).map)
    EXPECT_NE(file.find(entry.first), nullptr) << entry.first;
}

TEST(WorkCellParameters, ShippedCellStands) {
  std::vector<NamedMesh> models;
  for (const ObjectEntry& entry : readObjectEntries(kConfig + "objects.yaml"))
    models.push_back({entry.name, std::make_shared<Mesh>(loadMesh(entry.mesh, entry.unit))});
  const CellScene scene = makeCellScene(loadOptions<CellOptions>(kConfig + "cell.yaml"), models);
  EXPECT_EQ(scene.scene.objects.size(), 4u);
}

TEST(WorkCellParameters, AreChecked) {
  const auto refused = [](auto change) {
    WorkCellParameters parameters;
    parameters.objects = "some.yaml";
    parameters.urdf = "some.urdf";
    EXPECT_NO_THROW(parameters.check());
    change(&parameters);
    EXPECT_THROW(parameters.check(), BadInput);
  };
  using Parameters = WorkCellParameters;
  refused([](Parameters* p) { p->objects.clear(); });
  refused([](Parameters* p) { p->urdf.clear(); });
  refused([](Parameters* p) { p->real_time_factor = -1; });
  refused([](Parameters* p) { p->real_time_factor = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Parameters* p) { p->joint_rate = 0; });
  refused([](Parameters* p) { p->camera_rate = 1e4; });
  refused([](Parameters* p) { p->truth_rate = -1; });
  refused([](Parameters* p) { p->camera_threads = -1; });
}

}  // namespace
}  // namespace monocular_eye_hand
