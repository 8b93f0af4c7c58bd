#include <sys/stat.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "model/read_handling.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/model_base.h"

namespace monocular_eye_hand {
namespace {

/// Reads one value into the option of this name; remembers whether there was one.
class FillOption {
 public:
  FillOption(std::string key, const YAML::Node& value, std::string where)
      : key_(std::move(key)), value_(value), where_(std::move(where)) {}

  template <class T>
  void operator()(const char* name, T& field) {
    known_ += std::string(", ") + name;
    if (key_ != name) return;
    found_ = true;
    try {
      field = value_.as<T>();
    } catch (const YAML::Exception&) {
      throw BadInput(where_ + ": the value of \"" + key_ +
                     "\" is not of the right kind (number or true/false)");
    }
  }
  bool found() const { return found_; }
  const std::string& known() const { return known_; }

 private:
  std::string key_;
  const YAML::Node& value_;
  std::string where_, known_;
  bool found_ = false;
};

std::string text(const YAML::Node& value, const std::string& key, const std::string& where) {
  if (!value.IsScalar() || value.Scalar().empty()) throw BadInput(where + ": \"" + key + "\" must be a text");
  return value.Scalar();
}

std::string meshPath(const std::string& yaml_path, const std::string& mesh, const std::string& where) {
  const size_t slash = yaml_path.rfind('/');
  try {
    return resolvedPath(mesh, slash == std::string::npos ? "" : yaml_path.substr(0, slash));
  } catch (const BadInput& e) {
    throw BadInput(where + ": mesh " + e.what());
  }
}

ObjectEntry readEntry(const YAML::Node& node, const std::string& yaml_path, const std::string& where) {
  if (!node.IsMap()) throw BadInput(where + ": an object must be written {name: ..., mesh: ..., unit: mm}");
  ObjectEntry entry;
  for (const auto& pair : node) {
    const std::string key = pair.first.Scalar();
    const YAML::Node value = pair.second;
    if (key == "name") {
      entry.name = text(value, key, where);
    } else if (key == "mesh") {
      entry.mesh = meshPath(yaml_path, text(value, key, where), where);
    } else if (key == "unit") {
      entry.unit = text(value, key, where);
    } else if (readHandling(key, value, where, &entry.handling)) {
      continue;
    } else {
      FillOption fill(key, value, where);
      entry.options.visit(fill);
      if (!fill.found())
        throw BadInput(where + ": unknown key \"" + key + "\"; known: name, mesh, unit" + fill.known() +
                       ", grasp, obstacle, grasps");
    }
  }

  if (entry.name.empty()) throw BadInput(where + ": the key \"name\" is missing");
  if (entry.mesh.empty()) throw BadInput(where + " (" + entry.name + "): the key \"mesh\" is missing");
  struct stat info;
  if (stat(entry.mesh.c_str(), &info) != 0) {
    throw BadInput(where + " (" + entry.name + "): there is no file " + entry.mesh +
                   "; meshes are looked up from the folder of the YAML file");
  }

  try {
    metresPerUnit(entry.unit);
    entry.options.check();
    finishHandling(&entry.handling);
  } catch (const BadInput& e) {
    throw BadInput(where + " (" + entry.name + "): " + e.what());
  }
  return entry;
}

}  // namespace

std::vector<ObjectEntry> readObjectEntries(const std::string& name) {
  const std::string yaml_path = resolvedPath(name);
  struct stat info;
  if (stat(yaml_path.c_str(), &info) != 0)
    throw BadInput(yaml_path + ": there is no such file; check the path");

  YAML::Node root;
  try {
    root = YAML::LoadFile(yaml_path);
  } catch (const YAML::Exception& e) {
    throw BadInput(yaml_path + ": " + e.what());
  }

  if (!root.IsMap()) throw BadInput(yaml_path + ": the file must hold the key \"objects\" with a list");
  for (const auto& pair : root) {
    if (pair.first.Scalar() != "objects") {
      throw BadInput(yaml_path + ": unknown key \"" + pair.first.Scalar() + "\"; known: objects");
    }
  }
  const YAML::Node list = root["objects"];
  if (!list || !list.IsSequence() || list.size() == 0) {
    throw BadInput(yaml_path + ": \"objects\" must be a list with at least one object");
  }

  std::vector<ObjectEntry> entries;
  for (size_t k = 0; k < list.size(); ++k) {
    const std::string where = yaml_path + ", object " + std::to_string(k + 1);
    entries.push_back(readEntry(list[k], yaml_path, where));
    const bool twice = std::any_of(entries.begin(), entries.end() - 1,
                                   [&](const ObjectEntry& e) { return e.name == entries.back().name; });
    if (twice) throw BadInput(where + ": the name \"" + entries.back().name + "\" is used twice");
  }
  return entries;
}

}  // namespace monocular_eye_hand
