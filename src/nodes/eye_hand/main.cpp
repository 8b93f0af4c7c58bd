#include <ros/ros.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/model/model_base.h"
#include "nodes/common/conversion.h"
#include "nodes/common/run_node.h"
#include "nodes/eye_hand/node.h"

namespace meh = monocular_eye_hand;

namespace {

// roslaunch may drop or add what surrounds the document.
std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// When /robot_description is not what the file says.
void warnOfOtherRobot(const std::string& urdf) {
  std::string described;
  if (!ros::param::get("robot_description", described)) return;
  std::ifstream file(urdf);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  if (trimmed(described) != trimmed(text))
    ROS_WARN("robot_description is not what %s says: tf and grasps may be of two different arms",
             urdf.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  meh::NodeSetup setup;
  setup.help = {"eye_hand",
                "tells where recognised objects are in the base of the arm that carries the "
                "camera, and how to grasp them",
                "recognizer/objects, camera_info, joint_states, gripper/state, /tf, /tf_static",
                "~objects, ~best_grasps, ~grasp_poses, ~markers, /diagnostics",
                "services ~grasp_targets, ~forget",
                "eye_hand.launch camera:=/camera objects:=FILE.yaml urdf:=ARM.urdf",
                "config/eye_hand.yaml"};
  return meh::runNode<meh::EyeHandParameters>(
      argc, argv, setup, [](meh::EyeHandParameters& parameters, const meh::NodeWatch&) {
        for (std::string* frame : {&parameters.base_frame, &parameters.tool_frame, &parameters.table_frame})
          *frame = meh::withoutSlash(*frame);
        parameters.objects = meh::pathParameter("objects", parameters.objects);
        parameters.urdf = meh::pathParameter("urdf", parameters.urdf);

        const meh::Puma560 arm(parameters.arm);
        const meh::ArmDescription description = meh::loadSameArm(parameters, arm);
        warnOfOtherRobot(parameters.urdf);
        const meh::ModelBase models = meh::loadModels(parameters.objects, meh::ModelDepth::kShape);

        const auto start = std::chrono::steady_clock::now();
        const meh::GraspAdvisor advisor(models, parameters, arm, description.tool0_from_tcp);
        for (size_t k = 0; k < models.objects.size(); ++k) {
          const meh::ModelGrasps& grasps = advisor.modelGrasps(int(k));
          ROS_INFO("%s: %zu ways to hold it%s%s", models.objects[k].model.name.c_str(), grasps.grasps.size(),
                   grasps.reason.empty() ? "" : "; ", grasps.reason.c_str());
        }

        const meh::EyeHandNode eye_hand_node(models, parameters, arm, advisor);
        ROS_INFO("ready; knows %s (grasps sampled in %.2f s)", models.names().c_str(),
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        ros::spin();
      });
}
