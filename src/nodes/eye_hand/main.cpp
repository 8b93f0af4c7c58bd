#include <ros/ros.h>

#include <chrono>

#include "monocular_eye_hand/arm/arm_description.h"
#include "monocular_eye_hand/geometry/error.h"
#include "nodes/common/conversion.h"
#include "nodes/common/run_node.h"
#include "nodes/eye_hand/node.h"
#include "nodes/eye_hand/setup.h"

namespace meh = monocular_eye_hand;

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
        meh::warnOfOtherRobot(parameters.urdf);
        const meh::ModelBase models = meh::loadShapes(parameters.objects);

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
