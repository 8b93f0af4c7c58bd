#include <fmt/format.h>

#include <cmath>

#include "evaluation/json_file.h"
#include "monocular_eye_hand/evaluation/dataset.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

BopSymmetries readSymmetries(const nlohmann::json& info, const std::string& where) {
  BopSymmetries symmetries;
  const nlohmann::json none = nlohmann::json::array();
  for (const nlohmann::json& entry : info.value("symmetries_discrete", none)) {
    // One 4x4 matrix, row by row; wrapped so that messages name it.
    const auto numbers = numbersAt<16>({{"symmetries_discrete", entry}}, "symmetries_discrete", where);
    const RowMajor4 matrix = Eigen::Map<const RowMajor4>(numbers.data());
    symmetries.discrete.push_back(
        {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>() * kMetresPerMillimetre});
  }
  for (const nlohmann::json& entry : info.value("symmetries_continuous", none)) {
    const Eigen::Vector3d axis = numbersAt<3>(entry, "axis", where);
    if (!(axis.norm() > 0)) throw BadInput(where + ": a continuous symmetry's 'axis' is zero");
    symmetries.continuous.push_back(
        {numbersAt<3>(entry, "offset", where) * kMetresPerMillimetre, axis.normalized()});
  }
  return symmetries;
}

}  // namespace

BopModels loadBopModels(const std::string& models_dir) {
  const std::string info_path = models_dir + "/models_info.json";
  const nlohmann::json infos = loadJson(info_path);
  if (!infos.is_object() || infos.empty())
    throw BadInput(info_path + ": no models (a map of object ids expected)");

  BopModels models;
  for (const auto& item : infos.items()) {
    const std::string where = info_path + ": object '" + item.key() + "'";
    const nlohmann::json& info = item.value();
    BopModel model;
    model.id = numberOfName(item.key());
    if (model.id < 0) throw BadInput(where + ": its key is not an object id");
    model.name = "obj_" + item.key();
    if (info.contains("name") && info["name"].is_string()) model.name = info["name"];
    model.diameter = numberAt(info, "diameter", where) * kMetresPerMillimetre;
    if (!(model.diameter > 0)) throw BadInput(where + ": 'diameter' must be positive");

    try {
      model.symmetries = readSymmetries(info, where);
    } catch (const nlohmann::json::exception& e) {
      throw BadInput(where + ": symmetries cannot be read: " + e.what());
    }

    model.mesh_path = fmt::format("{}/obj_{:06}.ply", models_dir, model.id);
    model.vertices = loadMesh(model.mesh_path, "mm").vertices;
    models[model.id] = std::move(model);
  }
  return models;
}

}  // namespace monocular_eye_hand
