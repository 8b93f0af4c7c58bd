#include "cell_random.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "footprint.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/simulation/cell_gripper.h"
#include "monocular_eye_hand/simulation/random_scene.h"
#include "random_look.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPadHalfWidth = 0.010, kPadHeight = 0.020;  // what is assumed of a gripper [m]
constexpr double kReachDown = 0.035;    // the fingers reach so far below a part's top ...
constexpr double kLeastHeight = 0.010;  // ... and stay so far above the table [m]
constexpr double kFriction = 0.3;

/// A way to hold a resting part from above: the rectangles beside its two faces where the fingers go.
struct TopGrasp {
  Eigen::Vector2d along, across;  // unit, table's plane: from pad to pad, and along the pads
  Eigen::Vector2d middle;         // between the faces
  double width = 0, tip_z = 0;
};

std::vector<TopGrasp> topGrasps(const Mesh& mesh, const Rigid3& table_from_object, double widest) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(table_from_object * p);
  const GripperPads pads{kPadHalfWidth, -kPadHeight, 0};  // tcp at the tips, z down
  std::vector<TopGrasp> grasps;
  for (int turn = 0; turn < 12; ++turn)
    for (int step = -4; step <= 4; ++step) {
      const double angle = turn * M_PI / 12;
      const Eigen::Vector3d x(std::cos(angle), std::sin(angle), 0), z = -Eigen::Vector3d::UnitZ();
      Rigid3 table_from_tcp;
      table_from_tcp.rotation << x, z.cross(x), z;
      table_from_tcp.translation = 0.01 * step * x + box.center();
      table_from_tcp.translation.z() = std::max(kLeastHeight, box.max().z() - kReachDown);
      const GripContact contact =
          gripContact(mesh, table_from_tcp.inverse() * table_from_object, pads, 10 * widest);
      if (!contact.low.touched || contact.width() > widest) continue;
      if (!gripWeakness(contact, kFriction).empty()) continue;
      const Eigen::Vector3d middle =
          table_from_tcp * Eigen::Vector3d(0, (contact.low.y + contact.high.y) / 2, 0);
      grasps.push_back({table_from_tcp.rotation.col(1).head<2>(), x.head<2>(), middle.head<2>(),
                        contact.width(), middle.z()});
    }
  return grasps;
}

/// One resting pose of one model that can be held.
struct Choice {
  int model;
  StablePose pose;
};

class Arranger {
 public:
  Arranger(const CellRandom& rules, const std::vector<NamedMesh>& models)
      : rules_(rules), models_(models), random_(uint32_t(rules.seed) ^ 0xce11u) {
    collectChoices();
  }
  /// Frame first, then the parts; false when there was no room.
  bool tryOnce(std::vector<SceneObject>* objects) {
    objects->assign(1, drawFrame());
    for (int k = 0; k < rules_.objects; ++k)
      if (!placePart(objects)) return false;
    for (size_t k = 1; k < objects->size(); ++k)
      if (!canBeTaken(*objects, k)) return false;
    return true;
  }
  Generator& random() { return random_; }

 private:
  void collectChoices();
  SceneObject drawFrame();
  bool placePart(std::vector<SceneObject>* objects);
  bool canBeTaken(const std::vector<SceneObject>& objects, size_t part) const;

  const CellRandom& rules_;
  const std::vector<NamedMesh>& models_;
  Generator random_;
  int frame_ = -1;
  std::vector<int> drawn_;                           // models to draw from
  std::map<int, std::vector<StablePose>> holdable_;  // their poses, weights summing to 1
};

void Arranger::collectChoices() {
  for (size_t k = 0; k < models_.size(); ++k) {
    if (models_[k].name == rules_.frame) frame_ = int(k);
    const bool named = std::count(rules_.parts.begin(), rules_.parts.end(), models_[k].name) > 0;
    if (rules_.parts.empty() ? models_[k].name != rules_.frame : named) drawn_.push_back(int(k));
  }
  if (frame_ < 0) throw BadInput("random.frame = " + rules_.frame + " is not in the model base");
  for (const std::string& part : rules_.parts)
    if (std::none_of(models_.begin(), models_.end(), [&](const NamedMesh& m) { return m.name == part; }))
      throw BadInput("random.parts: '" + part + "' is not in the model base");
  const auto cannotBeHeld = [&](int model) {
    double sum = 0;
    std::vector<StablePose> poses;
    for (const StablePose& pose : stablePoses(*models_[size_t(model)].mesh))
      if (!topGrasps(*models_[size_t(model)].mesh, pose.table_from_object, rules_.gripper_width).empty())
        poses.push_back(pose), sum += pose.weight;
    for (StablePose& pose : poses) pose.weight /= sum;
    holdable_[model] = poses;
    return poses.empty();
  };
  drawn_.erase(std::remove_if(drawn_.begin(), drawn_.end(), cannotBeHeld), drawn_.end());
  if (drawn_.empty() && rules_.objects > 0)
    throw BadInput("random.gripper_width = " + std::to_string(rules_.gripper_width) +
                   " m: no part of the model base can be held from above");
}

SceneObject Arranger::drawFrame() {
  const Rigid3 table_from_frame{expSO3({0, 0, random_.uniform(-0.15, 0.15)}),
                                {random_.uniform(-0.02, 0.02), random_.uniform(-0.02, 0.02), 0}};
  SceneObject frame{models_[size_t(frame_)].name, frame_, models_[size_t(frame_)].mesh, table_from_frame, {}};
  double lowest = 1e9;
  for (const Eigen::Vector3d& p : frame.mesh->vertices) lowest = std::min(lowest, p.z());
  frame.world_from_object.translation.z() = -lowest;
  return frame;
}

bool Arranger::placePart(std::vector<SceneObject>* objects) {
  const int model = drawn_[size_t(random_.integer(0, int(drawn_.size()) - 1))];
  const Rigid3 resting = drawPose(holdable_[model], &random_);
  SceneObject part{models_[size_t(model)].name, model, models_[size_t(model)].mesh, {}, {}};
  const SceneObject& frame = objects->front();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : frame.mesh->vertices) box.extend(frame.world_from_object * p);
  for (int attempt = 0; attempt < 40; ++attempt) {
    const Rigid3 turned{
        expSO3({0, 0, random_.uniform(0, 2 * M_PI)}),
        {random_.uniform(box.min().x(), box.max().x()), random_.uniform(box.min().y(), box.max().y()), 0}};
    part.world_from_object = turned * resting;
    const Footprint grown = footprint(part, rules_.gap);
    const bool free = std::all_of(objects->begin(), objects->end(), [&](const SceneObject& other) {
      return sharedCells(grown, footprint(other)) == 0;
    });
    // Beside the frame is free too, but not inside: the part's middle must be where the frame's box is.
    const cv::Point corner = grown.corner, far = corner + cv::Point(grown.mask.size());
    const bool inside = corner.x * kCell > box.min().x() && corner.y * kCell > box.min().y() &&
                        far.x * kCell < box.max().x() && far.y * kCell < box.max().y();
    if (!free || !inside) continue;
    objects->push_back(part);
    return true;
  }
  return false;
}

bool Arranger::canBeTaken(const std::vector<SceneObject>& objects, size_t part) const {
  std::vector<Footprint> others;
  std::vector<double> tops;
  for (size_t k = 0; k < objects.size(); ++k) {
    if (k == part) continue;
    others.push_back(footprint(objects[k]));
    double top = 0;
    for (const Eigen::Vector3d& p : objects[k].mesh->vertices)
      top = std::max(top, (objects[k].world_from_object * p).z());
    tops.push_back(top);
  }
  const auto covered = [&](const Eigen::Vector2d& p, double tip_z) {
    const cv::Point cell(int(std::lround(p.x() / kCell)), int(std::lround(p.y() / kCell)));
    for (size_t k = 0; k < others.size(); ++k) {
      const cv::Point at = cell - others[k].corner;
      if (tops[k] + 0.003 > tip_z && cv::Rect({}, others[k].mask.size()).contains(at) && others[k].mask(at))
        return true;
    }
    return false;
  };
  const auto grasps = topGrasps(*objects[part].mesh, objects[part].world_from_object, rules_.gripper_width);
  return std::any_of(grasps.begin(), grasps.end(), [&](const TopGrasp& grasp) {
    for (int side : {-1, 1})
      for (double y = 0; y <= rules_.finger_room; y += 0.002)
        for (double x = -kPadHalfWidth; x <= kPadHalfWidth; x += 0.002)
          if (covered(grasp.middle + side * (grasp.width / 2 + y) * grasp.along + x * grasp.across,
                      grasp.tip_z))
            return false;
    return true;
  });
}

}  // namespace

void arrangeAtRandom(const std::vector<NamedMesh>& models, CellScene* cell) {
  const CellRandom& rules = cell->options.random;
  Arranger arranger(rules, models);
  constexpr int kAttempts = 400;
  std::vector<SceneObject> objects;
  int attempt = 0;
  while (attempt < kAttempts && !arranger.tryOnce(&objects)) ++attempt;
  if (attempt == kAttempts)
    throw BadInput("random.objects = " + std::to_string(rules.objects) +
                   ": no room for so many in the frame, with random.gap and random.finger_room between them");
  Scene& scene = cell->scene;
  Generator& random = arranger.random();
  if (rules.lights) {
    scene.lights.clear();
    scene.table.material = randomMaterial(&random);
    scene.table.material.specular *= 0.1;
    scene.table.material.texture = randomTexture(&random, 0.3);
    addLights(&random, &scene);
  }
  for (SceneObject& object : objects) {
    object.material = randomMaterial(&random);
    standOut(&object.material, scene.table.material.albedo);
  }
  scene.objects = objects;
  cell->fixed.assign(objects.size(), false);
  cell->fixed[0] = true;
}

}  // namespace monocular_eye_hand
