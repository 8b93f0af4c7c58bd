#include "nodes/planner_scene.h"

#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

std::string placeLabel(const SceneObject& object, int place) {
  return object.name + " at place " + std::to_string(place);
}

CollisionWorld fixedWorld(const ArmDescription& arm, const PlannerParameters& parameters) {
  CollisionWorld world(arm);
  const PlannerTable& table = parameters.table;
  world.addBox("table", {table.length, table.width, table.thickness},
               poseOf(table.x, table.y, table.z - table.thickness / 2, 0, 0, table.yaw));
  for (const CellBox& box : parameters.boxes)
    world.addBox(box.name, {box.size[0], box.size[1], box.size[2]}, box.baseFromBox());
  return world;
}

}  // namespace

PlannerScene::PlannerScene(const ArmDescription& arm, const PlannerParameters& parameters)
    : bare_(fixedWorld(arm, parameters)) {
  for (const ObjectEntry& entry : readObjectEntries(parameters.objects)) {
    ModelOptions welded = entry.options;
    welded.find_symmetries = false;
    meshes_.emplace(entry.name,
                    shapeOf(buildModel(entry.name, loadMesh(entry.mesh, entry.unit), welded).mesh));
  }
}

PlannerScene::Shape PlannerScene::shapeOf(Mesh mesh) {
  Shape shape;
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
  shape.mesh = std::move(mesh);
  shape.centre = bounds.center();
  shape.radius = bounds.diagonal().norm() / 2;
  shape.smallest = bounds.sizes().minCoeff();
  return shape;
}

void PlannerScene::learnBox(const std::string& name, const Eigen::Vector3d& size) {
  Mesh box;
  for (int k = 0; k < 8; ++k)
    box.vertices.push_back(size.cwiseProduct(Eigen::Vector3d(k & 1, k >> 1 & 1, k >> 2)) - size / 2);
  box.triangles = {{{0, 2, 1}}, {{1, 2, 3}}, {{4, 5, 6}}, {{5, 7, 6}}, {{0, 1, 4}}, {{1, 5, 4}},
                   {{2, 6, 3}}, {{3, 6, 7}}, {{0, 4, 2}}, {{2, 4, 6}}, {{1, 3, 5}}, {{3, 7, 5}}};
  meshes_.insert_or_assign(name, shapeOf(std::move(box)));
}

std::string PlannerScene::names() const {
  std::string names;
  for (const auto& entry : meshes_) names += (names.empty() ? "" : ", ") + entry.first;
  return names;
}

Eigen::Vector3d PlannerScene::centre(const SceneObject& object) const {
  return object.base_from_object * meshes_.at(object.name).centre;
}

/// Two poses of one thing: its views differ by less than half of its smallest side.
bool PlannerScene::same(const SceneObject& a, const SceneObject& b) const {
  return a.name == b.name && (centre(a) - centre(b)).norm() < meshes_.at(a.name).smallest / 2;
}

/// Something is seen where one thing is remembered; its like may have been pushed or turned a little.
bool PlannerScene::standsAt(const SceneObject& other, const SceneObject& remembered) const {
  const Shape& shape = meshes_.at(remembered.name);
  const double distance = (centre(other) - centre(remembered)).norm();
  return distance < (other.name == remembered.name ? shape.radius : shape.smallest / 2);
}

std::vector<std::string> PlannerScene::see(const std::vector<SceneObject>& objects) {
  seen_.clear();
  std::vector<std::string> unknown;
  for (const SceneObject& object : objects)
    if (knows(object.name) && object.base_from_object.isFinite())
      seen_.push_back(object);
    else
      unknown.push_back(object.label());
  for (auto& entry : placed_)  // what is seen again is known better now
    for (const SceneObject& object : seen_)
      if (same(object, entry.second)) entry.second.base_from_object = object.base_from_object;
  return unknown;
}

CollisionWorld PlannerScene::world(const std::optional<SceneObject>& subject, int free_place,
                                   const std::optional<SceneObject>& in_hand) const {
  CollisionWorld world = bare_;
  const auto add = [&](const std::string& label, const SceneObject& object) {
    if (!world.has(label)) world.addMesh(label, mesh(object.name), object.base_from_object);
  };
  if (subject) add(subject->label(), *subject);

  const auto is_subject = [&](const SceneObject& object) {
    return (subject && (object.label() == subject->label() || same(object, *subject))) ||
           (in_hand && object.name == in_hand->name && standsAt(object, *in_hand));
  };
  for (const SceneObject& object : seen_)
    if (!is_subject(object)) add(object.label(), object);

  for (const auto& entry : placed_) {
    if (entry.first == free_place) continue;
    const SceneObject& object = entry.second;
    const auto here = [&](const SceneObject& other) { return standsAt(other, object); };
    if (std::any_of(seen_.begin(), seen_.end(), here) || (subject && here(*subject))) continue;
    add(placeLabel(object, entry.first), object);
  }
  return world;
}

std::vector<std::string> PlannerScene::labels(const SceneObject& object) const {
  std::vector<std::string> labels{object.label()};
  for (const SceneObject& other : seen_)
    if (standsAt(other, object)) labels.push_back(other.label());
  for (const auto& entry : placed_)
    if (standsAt(object, entry.second)) labels.push_back(placeLabel(entry.second, entry.first));
  return labels;
}

void PlannerScene::takeAway(const SceneObject& object) {
  for (auto entry = placed_.begin(); entry != placed_.end();)
    entry = standsAt(object, entry->second) ? placed_.erase(entry) : std::next(entry);
}

void PlannerScene::putDown(int place, const SceneObject& object) { placed_[place] = object; }

}  // namespace monocular_eye_hand
