#include <fmt/format.h>
#include <ros/ros.h>

#include "monocular_eye_hand/io/file_path.h"
#include "nodes/common/conversion.h"
#include "nodes/common/run_node.h"
#include "nodes/planner/node.h"

namespace meh = monocular_eye_hand;

int main(int argc, char** argv) {
  meh::NodeSetup setup;
  setup.help = {"planner",
                "plans and drives the arm: picks objects up, puts them down",
                "joint_states, gripper/state, eye_hand/objects",
                "arm_controller/command, gripper/command, ~path, ~cell, /diagnostics",
                "actions ~pick, ~place, ~move, ~recover",
                "planner.launch objects:=FILE.yaml urdf:=ARM.urdf",
                "config/planner.yaml"};
  // actionlib keeps its settings below the names of the actions.
  setup.foreign_parameters = {"pick", "place", "move", "recover"};
  setup.ends_when_asked = true;
  return meh::runNode<meh::PlannerParameters>(
      argc, argv, setup, [](meh::PlannerParameters& parameters, const meh::NodeWatch& watch) {
        parameters.base_frame = meh::withoutSlash(parameters.base_frame);
        parameters.objects = meh::pathParameter("objects", parameters.objects);
        parameters.urdf = meh::pathParameter("urdf", parameters.urdf);

        ros::AsyncSpinner spinner(2);
        meh::PlannerNode planner(parameters, watch);
        meh::runUntilAsked(&spinner,
                           fmt::format("{} places in the drop zone", parameters.drop_zone.places().size()),
                           [&planner] { planner.stop(); });
      });
}
