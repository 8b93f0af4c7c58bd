#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/options/options.h"

namespace monocular_eye_hand {
namespace {

using Numbers = std::array<double, 3>;

/// A grasp as it is written; the object's frame.
struct GraspKeys {
  Numbers xyz{std::numeric_limits<double>::quiet_NaN(), 0, 0};  // [m]; not a number: not given
  Numbers rpy{};                                                // about the fixed axes x, y, z, as in URDF
  double width = 0;                                             // [m]
  int rotation_steps = 1;
  Numbers axis{0, 0, 1}, point{};

  template <class Visitor>
  void visit(Visitor&& v) {
    v("xyz", xyz);
    v("rpy", rpy);
    v("width", width);
    v("rotation_steps", rotation_steps);
    v("axis", axis);
    v("point", point);
  }

  void check() const {
    if (std::isnan(xyz[0])) throw BadInput("the key \"xyz\" is missing");
    if (!(width > 0)) throw BadInput(fmt::format("width = {:.4f} must be above 0 [m]", width));
    if (rotation_steps < 1 || rotation_steps > 360)
      throw BadInput(fmt::format("rotation_steps = {} must be 1 to 360", rotation_steps));
    if (Eigen::Vector3d(axis.data()).norm() < 1e-6) throw BadInput("axis must not be zero");
  }
};

/// An object as it is written: the model's options stand beside the other keys.
struct ObjectKeys {
  std::string name, mesh, unit = "mm";
  ModelOptions options;
  bool grasp = true, obstacle = false;
  std::vector<GraspKeys> grasps;

  template <class Visitor>
  void visit(Visitor&& v) {
    v("name", name);
    v("mesh", mesh);
    v("unit", unit);
    options.visit(v);
    v("grasp", grasp);
    v("obstacle", obstacle);
    v("grasps", grasps);
  }

  void check() const {
    if (name.empty()) throw BadInput("the key \"name\" is missing");
    if (mesh.empty()) throw BadInput("the key \"mesh\" is missing");
    metresPerUnit(unit);
    options.check();
    if ((obstacle || !grasp) && !grasps.empty())
      throw BadInput(
          "grasps are given for an object that must not be grasped; drop them, or obstacle / grasp");
  }
};

GivenGrasp grasped(const GraspKeys& keys) {
  GivenGrasp grasp;
  grasp.object_from_tcp.translation = Eigen::Vector3d(keys.xyz.data());
  grasp.object_from_tcp.rotation = (Eigen::AngleAxisd(keys.rpy[2], Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(keys.rpy[1], Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(keys.rpy[0], Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  grasp.width = keys.width;
  grasp.rotation_steps = keys.rotation_steps;
  grasp.axis.point = Eigen::Vector3d(keys.point.data());
  grasp.axis.direction = Eigen::Vector3d(keys.axis.data()).normalized();
  return grasp;
}

Handling handlingOf(const ObjectKeys& keys) {
  Handling handling;
  handling.obstacle = keys.obstacle;
  handling.grasp = keys.grasp && !keys.obstacle;
  for (const GraspKeys& grasp : keys.grasps) handling.grasps.push_back(grasped(grasp));
  return handling;
}

bool exists(const std::string& path) {
  struct stat info;
  return stat(path.c_str(), &info) == 0;
}

std::string meshPath(const std::string& mesh, const std::string& folder) {
  std::string path;
  try {
    path = resolvedPath(mesh, folder);
  } catch (const BadInput& e) {
    throw BadInput(std::string("mesh ") + e.what());
  }
  if (!exists(path))
    throw BadInput("there is no file " + path + "; meshes are looked up from the folder of the YAML file");
  return path;
}

ObjectEntry readEntry(const OptionTree& tree, const std::string& folder) {
  if (tree.kind != OptionTree::Kind::kMap)
    throw BadInput("an object must be written {name: ..., mesh: ..., unit: mm}");
  const OptionTree* grasps = tree.find("grasps");
  if (grasps && grasps->list.empty() && grasps->kind == OptionTree::Kind::kList)
    throw BadInput(
        "'grasps' must be a list with at least one grasp; without the key grasps are sampled from the mesh");

  ObjectKeys keys;
  readOptions(tree, &keys);
  return {keys.name, meshPath(keys.mesh, folder), keys.unit, keys.options, handlingOf(keys)};
}

/// "object 2 (bridge)".
std::string placeOf(size_t index, const OptionTree& tree) {
  const OptionTree* name = tree.find("name");
  const bool named = name && name->kind == OptionTree::Kind::kScalar && !name->scalar.empty();
  return fmt::format("object {}{}", index + 1, (named ? " (" + name->scalar + ")" : ""));
}

/// The list of objects that the file holds.
const std::vector<OptionTree>& objectList(const OptionTree& root) {
  if (root.kind != OptionTree::Kind::kMap)
    throw BadInput("the file must hold the key \"objects\" with a list");
  options_detail::requireKnown(root, "", {"objects"});
  const OptionTree* objects = root.find("objects");
  if (!objects || objects->list.empty())
    throw BadInput("\"objects\" must be a list with at least one object");
  return objects->list;
}

std::vector<ObjectEntry> readList(const std::vector<OptionTree>& list, const std::string& folder) {
  std::vector<ObjectEntry> entries;
  for (size_t k = 0; k < list.size(); ++k) {
    try {
      entries.push_back(readEntry(list[k], folder));
    } catch (const BadInput& e) {
      throw BadInput(placeOf(k, list[k]) + ": " + e.what());
    }

    const bool twice = std::any_of(entries.begin(), entries.end() - 1,
                                   [&](const ObjectEntry& e) { return e.name == entries.back().name; });
    if (twice)
      throw BadInput(fmt::format("object {}: the name \"{}\" is used twice", k + 1, entries.back().name));
  }
  return entries;
}

}  // namespace

std::vector<ObjectEntry> readObjectEntries(const std::string& name) {
  const std::string yaml_path = resolvedPath(name);
  if (!exists(yaml_path)) throw BadInput(yaml_path + ": there is no such file; check the path");
  const size_t slash = yaml_path.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : yaml_path.substr(0, slash);

  const OptionTree root = loadYaml(yaml_path);
  try {
    return readList(objectList(root), folder);
  } catch (const BadInput& e) {
    throw BadInput(yaml_path + ": " + e.what());
  }
}

}  // namespace monocular_eye_hand
