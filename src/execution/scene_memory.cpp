#include "monocular_eye_hand/execution/scene_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/model/same_place.h"

namespace monocular_eye_hand {
namespace {

std::string placeLabel(const PlacedObject& object, int place) {
  return fmt::format("{} at place {}", object.name, place);
}

CollisionWorld fixedWorld(const ArmDescription& arm, const ExecutorOptions& options) {
  CollisionWorld world(arm);
  const WorkTable& table = options.table;
  world.addBox("table", {table.length, table.width, table.thickness}, table.baseFromBox());
  for (const CellBox& box : options.boxes)
    world.addBox(box.name, {box.size[0], box.size[1], box.size[2]}, box.baseFromBox());
  return world;
}

}  // namespace

SceneMemory::SceneMemory(const ArmDescription& arm, const ExecutorOptions& options)
    : bare_(fixedWorld(arm, options)) {
  for (KnownObject& object : loadModels(options.objects, ModelDepth::kMesh).objects)
    meshes_.emplace(object.model.name, shapeOf(std::move(object.model.mesh)));
}

SceneMemory::Shape SceneMemory::shapeOf(Mesh mesh) {
  Shape shape;
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
  shape.mesh = std::move(mesh);
  shape.centre = bounds.center();
  shape.radius = bounds.diagonal().norm() / 2;
  shape.smallest = bounds.sizes().minCoeff();
  return shape;
}

void SceneMemory::learnBox(const std::string& name, const Eigen::Vector3d& size) {
  Mesh box;
  for (int k = 0; k < 8; ++k)
    box.vertices.push_back(size.cwiseProduct(Eigen::Vector3d(k & 1, k >> 1 & 1, k >> 2)) - size / 2);
  box.triangles = {{{0, 2, 1}}, {{1, 2, 3}}, {{4, 5, 6}}, {{5, 7, 6}}, {{0, 1, 4}}, {{1, 5, 4}},
                   {{2, 6, 3}}, {{3, 6, 7}}, {{0, 4, 2}}, {{2, 4, 6}}, {{1, 3, 5}}, {{3, 7, 5}}};
  meshes_.insert_or_assign(name, shapeOf(std::move(box)));
}

void SceneMemory::requireKnown(const std::string& name) const {
  if (!knows(name)) throw BadInput("no object is named '" + name + "'; known: " + names());
}

std::string SceneMemory::names() const {
  std::string names;
  for (const auto& entry : meshes_) names += (names.empty() ? "" : ", ") + entry.first;
  return names;
}

Eigen::Vector3d SceneMemory::centre(const PlacedObject& object) const {
  return object.base_from_object * meshes_.at(object.name).centre;
}

/// Two poses of one thing: its views differ by no more than half of its smallest side.
bool SceneMemory::same(const PlacedObject& a, const PlacedObject& b) const {
  return a.name == b.name && samePlace(centre(a), centre(b), meshes_.at(a.name).smallest / 2);
}

/// Something is seen where one thing is remembered; a similar one may have been pushed or turned a little.
bool SceneMemory::standsAt(const PlacedObject& other, const PlacedObject& remembered) const {
  const Shape& shape = meshes_.at(remembered.name);
  const double reach = other.name == remembered.name ? shape.radius : shape.smallest / 2;
  return samePlace(centre(remembered), centre(other), reach);
}

std::vector<std::string> SceneMemory::see(const std::vector<PlacedObject>& objects) {
  seen_.clear();
  std::vector<std::string> unknown;
  for (const PlacedObject& object : objects)
    if (knows(object.name) && object.base_from_object.isFinite())
      seen_.push_back(object);
    else
      unknown.push_back(object.label());
  for (auto& entry : placed_)  // what is seen again is known better now
    for (const PlacedObject& object : seen_)
      if (same(object, entry.second)) entry.second.base_from_object = object.base_from_object;
  return unknown;
}

CollisionWorld SceneMemory::world(const std::optional<PlacedObject>& subject, int free_place,
                                  const std::optional<PlacedObject>& in_hand) const {
  CollisionWorld world = bare_;
  const auto add = [&](const std::string& label, const PlacedObject& object) {
    if (!world.has(label)) world.addMesh(label, mesh(object.name), object.base_from_object);
  };
  if (subject) add(subject->label(), *subject);

  const auto is_subject = [&](const PlacedObject& object) {
    return (subject && (object.label() == subject->label() || same(object, *subject))) ||
           (in_hand && object.name == in_hand->name && standsAt(object, *in_hand));
  };
  for (const PlacedObject& object : seen_)
    if (!is_subject(object)) add(object.label(), object);

  for (const auto& entry : placed_) {
    if (entry.first == free_place) continue;
    const PlacedObject& object = entry.second;
    const auto here = [&](const PlacedObject& other) { return standsAt(other, object); };
    if (std::any_of(seen_.begin(), seen_.end(), here) || (subject && here(*subject))) continue;
    add(placeLabel(object, entry.first), object);
  }
  return world;
}

std::vector<std::string> SceneMemory::labels(const PlacedObject& object) const {
  std::vector<std::string> labels{object.label()};
  for (const PlacedObject& other : seen_)
    if (standsAt(other, object)) labels.push_back(other.label());
  for (const auto& entry : placed_)
    if (standsAt(object, entry.second)) labels.push_back(placeLabel(entry.second, entry.first));
  return labels;
}

void SceneMemory::takeAway(const PlacedObject& object) {
  for (auto entry = placed_.begin(); entry != placed_.end();)
    entry = standsAt(object, entry->second) ? placed_.erase(entry) : std::next(entry);
}

void SceneMemory::putDown(int place, const PlacedObject& object) { placed_[place] = object; }

}  // namespace monocular_eye_hand
