#include "model/read_handling.h"

#include <yaml-cpp/yaml.h>

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

template <class T>
T scalar(const YAML::Node& value, const std::string& what, const char* kind) {
  try {
    return value.as<T>();
  } catch (const YAML::Exception&) {
    throw BadInput(what + " must be " + kind);
  }
}

Eigen::Vector3d vector(const YAML::Node& value, const std::string& what) {
  if (!value.IsSequence() || value.size() != 3) throw BadInput(what + " must be a list of 3 numbers");
  Eigen::Vector3d v;
  for (int k = 0; k < 3; ++k) v[k] = scalar<double>(value[k], what, "a list of 3 numbers");
  if (!v.allFinite()) throw BadInput(what + " must be finite");
  return v;
}

GivenGrasp readGrasp(const YAML::Node& node, const std::string& where) {
  if (!node.IsMap()) throw BadInput(where + " must be written {xyz: [...], rpy: [...], width: ...}");
  GivenGrasp grasp;
  bool placed = false;
  for (const auto& pair : node) {
    const std::string key = pair.first.Scalar(), what = where + "." + key;
    const YAML::Node value = pair.second;
    if (key == "xyz") {
      grasp.object_from_tcp.translation = vector(value, what);
      placed = true;
    } else if (key == "rpy") {  // about the fixed axes x, y, z, as in URDF
      const Eigen::Vector3d rpy = vector(value, what);
      grasp.object_from_tcp.rotation = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                                        Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                                           .toRotationMatrix();
    } else if (key == "width") {
      grasp.width = scalar<double>(value, what, "a number [m]");
    } else if (key == "turns") {
      grasp.turns = scalar<int>(value, what, "a whole number");
    } else if (key == "axis") {
      grasp.axis.direction = vector(value, what);
    } else if (key == "point") {
      grasp.axis.point = vector(value, what);
    } else {
      throw BadInput(where + ": unknown key \"" + key + "\"; known: xyz, rpy, width, turns, axis, point");
    }
  }

  if (!placed) throw BadInput(where + ": the key \"xyz\" is missing");
  if (!(grasp.width > 0 && std::isfinite(grasp.width)))
    throw BadInput(where + ".width = " + std::to_string(grasp.width) + " must be above 0 [m]");
  if (grasp.turns < 1 || grasp.turns > 360)
    throw BadInput(where + ".turns = " + std::to_string(grasp.turns) + " must be 1 to 360");
  if (grasp.axis.direction.norm() < 1e-6) throw BadInput(where + ".axis must not be zero");

  grasp.axis.direction.normalize();
  return grasp;
}

}  // namespace

bool readHandling(const std::string& key, const YAML::Node& value, const std::string& where,
                  Handling* handling) {
  if (key == "grasp") {
    handling->grasp = scalar<bool>(value, where + ": \"grasp\"", "true or false");
  } else if (key == "obstacle") {
    handling->obstacle = scalar<bool>(value, where + ": \"obstacle\"", "true or false");
  } else if (key == "grasps") {
    if (!value.IsSequence() || value.size() == 0)
      throw BadInput(where +
                     ": \"grasps\" must be a list with at least one grasp; without the key grasps are "
                     "sampled from the mesh");
    for (size_t k = 0; k < value.size(); ++k)
      handling->grasps.push_back(readGrasp(value[k], where + ": grasps[" + std::to_string(k) + "]"));
  } else {
    return false;
  }
  return true;
}

void finishHandling(Handling* handling) {
  if (handling->obstacle) handling->grasp = false;
  if (!handling->grasp && !handling->grasps.empty())
    throw BadInput("grasps are given for an object that must not be grasped; drop them, or obstacle / grasp");
}

}  // namespace monocular_eye_hand
