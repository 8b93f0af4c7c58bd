#include "monocular_eye_hand/simulation/cell/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "monocular_eye_hand/arm/arm_state.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr double kLongestWait = 600;  // a stamp further ahead is not cell time [s]

using Order = std::array<size_t, 6>;  // place of joint1 to joint6 in the message

Order orderOf(const std::vector<std::string>& joints) {
  Order order;
  std::string given;
  for (const std::string& name : joints) given += (given.empty() ? "" : ", ") + name;
  for (size_t j = 0; j < 6; ++j) {
    const auto place = std::find(joints.begin(), joints.end(), armJointNames()[j]);
    if (place == joints.end())
      throw BadInput("joint_names lacks " + armJointNames()[j] + " (given: " + given +
                     "): name joint1 to joint6, each once");
    order[j] = size_t(place - joints.begin());
  }
  if (joints.size() != 6)
    throw BadInput(fmt::format("joint_names holds {} names ({}): name joint1 to joint6, each once",
                               joints.size(), given));
  return order;
}

std::vector<double> ordered(const std::vector<double>& values, const Order& order, size_t point,
                            const char* field, bool required) {
  if (values.empty() && !required) return {};
  const std::string where = fmt::format("points[{}].{}", point, field);
  if (values.size() != 6)
    throw BadInput(fmt::format("{} holds {} numbers: give one per joint", where, values.size()));
  std::vector<double> out;
  for (size_t place : order) {
    if (!std::isfinite(values[place])) throw BadInput(where + " is not finite");
    out.push_back(values[place]);
  }
  return out;
}

std::vector<CellPathPoint> pathOf(const JointCommand& trajectory) {
  const Order order = orderOf(trajectory.joint_names);
  std::vector<CellPathPoint> path;

  for (size_t k = 0; k < trajectory.points.size(); ++k) {
    const JointCommand::Point& point = trajectory.points[k];
    CellPathPoint out;
    out.time = point.time;
    if (out.time < 0 || (k > 0 && out.time <= path.back().time))
      throw BadInput(fmt::format(
          "points[{}].time_from_start = {:.3f} s must not be negative and must grow from point to point", k,
          out.time));
    const std::vector<double> positions = ordered(point.positions, order, k, "positions", true);
    out.positions = Eigen::Map<const JointVector>(positions.data());
    out.velocities = ordered(point.velocities, order, k, "velocities", false);
    out.accelerations = ordered(point.accelerations, order, k, "accelerations", false);
    if (out.velocities.empty()) out.accelerations.clear();
    path.push_back(std::move(out));
  }
  return path;
}

}  // namespace

ArmCommand armCommand(const JointCommand& trajectory, double now) {
  ArmCommand command{now, {}};
  if (trajectory.points.empty()) return command;
  command.path = pathOf(trajectory);
  if (trajectory.stamp == 0) return command;

  const double ahead = trajectory.stamp - now;
  if (ahead > kLongestWait)
    throw BadInput(fmt::format(
        "header.stamp lies {:.3f} s ahead: stamp it with cell time (use_sim_time), or with 0 for at once",
        ahead));
  if (ahead >= 0) {
    command.start = trajectory.stamp;
    return command;
  }

  const auto first = std::find_if(command.path.begin(), command.path.end(),
                                  [&](const CellPathPoint& point) { return point.time + ahead > 0; });
  if (first == command.path.end())
    throw BadInput(fmt::format(
        "the trajectory ended {:.3f} s ago: stamp it with the present cell time, or with 0 for at once",
        -ahead - command.path.back().time));
  command.path.erase(command.path.begin(), first);
  for (CellPathPoint& point : command.path) point.time += ahead;
  return command;
}

}  // namespace monocular_eye_hand
