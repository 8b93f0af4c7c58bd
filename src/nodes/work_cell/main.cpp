#include <ros/ros.h>

#include "monocular_eye_hand/arm/load_arm_description.h"
#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/simulation/cell/scene.h"
#include "nodes/common/run_node.h"
#include "nodes/work_cell/node.h"

namespace meh = monocular_eye_hand;

namespace {

/// The meshes of the model base, as the recogniser has them; nothing else of a model is seen or touched.
std::vector<meh::NamedMesh> loadMeshes(const std::string& model_base) {
  std::vector<meh::ObjectEntry> entries = meh::readObjectEntries(model_base);
  for (meh::ObjectEntry& entry : entries) entry.options.find_symmetries = false;
  return meh::namedMeshes(meh::compileModels(entries, meh::ModelDepth::kShape, {}, "none"));
}

}  // namespace

int main(int argc, char** argv) {
  meh::NodeSetup setup;
  setup.help = {"work_cell",
                "plays an arm with gripper and camera over a table of parts",
                "arm_controller/command, gripper/command, ~take_away",
                "joint_states, gripper/state, camera/image_raw, camera/camera_info, ~truth, /clock",
                "",
                "work_cell.launch",
                "config/cell.yaml (below cell)"};
  return meh::runNode<meh::WorkCellParameters>(
      argc, argv, setup, [](meh::WorkCellParameters& parameters, const meh::NodeWatch&) {
        parameters.objects = meh::pathParameter("objects", parameters.objects);
        parameters.urdf = meh::pathParameter("urdf", parameters.urdf);

        meh::ArmDescription arm = meh::loadArmDescription(parameters.urdf);
        meh::requireSameArm(arm, meh::Puma560(parameters.arm));
        meh::CellScene scene = meh::makeCellScene(parameters.cell, loadMeshes(parameters.objects));
        const size_t objects = scene.scene.objects.size();

        meh::WorkCellNode cell(meh::WorkCell(std::move(scene), std::move(arm), parameters.arm), parameters);
        ROS_INFO("ready; %zu objects on the table", objects);
        cell.run();
      });
}
