#include "simulation/cell/random.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/stable_poses.h"
#include "monocular_eye_hand/simulation/cell/gripper.h"
#include "simulation/scenes/footprint.h"
#include "simulation/scenes/random_draws.h"

namespace monocular_eye_hand {
namespace {

constexpr double kPadHalfWidth = 0.010, kPadHeight = 0.020;  // what is assumed of a gripper [m]
constexpr double kReachDown = 0.035;  // the fingers reach so far below a part's top ...
constexpr double kMinHeight = 0.010;  // ... and stay so far above the table [m]
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
      table_from_tcp.translation.z() = std::max(kMinHeight, box.max().z() - kReachDown);

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

/// footprint() with a margin, for many calls: the distance to the nearest covered cell decides.
Footprint grown(const Footprint& own, double by) {
  const int margin = int(std::ceil(by / kCell));
  Footprint out{{}, own.corner - cv::Point(margin, margin)};
  cv::Mat1b free;
  cv::copyMakeBorder(own.mask == 0, free, margin, margin, margin, margin, cv::BORDER_CONSTANT,
                     cv::Scalar(255));
  cv::Mat1f distance;
  cv::distanceTransform(free, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  out.mask = distance <= by / kCell;
  return out;
}

/// A resting pose that can be held, and how.
struct Choice {
  StablePose pose;
  std::vector<TopGrasp> grasps;  // as the part lies with `pose` on the table
};

/// A part in its place.
struct Placed {
  SceneObject object;
  Footprint footprint, grown;      // grown by CellRandom::gap
  double top = 0;                  // its highest point [m]
  Rigid3 turned;                   // table from where its grasps were found
  const Choice* choice = nullptr;  // null: the frame
};

class Arranger {
 public:
  Arranger(const CellRandom& rules, const std::vector<NamedMesh>& models)
      : rules_(rules), models_(models), random_(uint32_t(rules.seed) ^ 0xce11u) {
    collectChoices();
  }
  /// Frame first, then the parts; false when there was no room.
  bool tryOnce(std::vector<SceneObject>* objects) {
    placed_.clear();
    placed_.push_back(put(drawFrame()));
    for (int k = 0; k < rules_.objects; ++k)
      if (!placePart()) return false;
    for (const Placed& part : placed_)
      if (part.choice && !canBeTaken(part)) return false;
    objects->clear();
    for (const Placed& part : placed_) objects->push_back(part.object);
    return true;
  }
  Generator& random() { return random_; }

 private:
  void collectChoices();
  SceneObject drawFrame();
  bool placePart();
  bool canBeTaken(const Placed& part) const;
  Placed put(const SceneObject& object) const;
  const Choice& drawChoice(int model);

  const CellRandom& rules_;
  const std::vector<NamedMesh>& models_;
  Generator random_;
  int frame_ = -1;
  std::vector<int> drawn_;                      // models to draw from
  std::map<int, std::vector<Choice>> choices_;  // of each, weights summing to 1
  std::vector<Placed> placed_;
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
    const Mesh& mesh = *models_[size_t(model)].mesh;
    double sum = 0;
    std::vector<Choice> choices;
    for (const StablePose& pose : stablePoses(mesh)) {
      Choice choice{pose, topGrasps(mesh, pose.table_from_object, rules_.gripper_width)};
      if (choice.grasps.empty()) continue;
      sum += pose.weight;
      choices.push_back(std::move(choice));
    }
    for (Choice& choice : choices) choice.pose.weight /= sum;
    choices_[model] = choices;
    return choices.empty();
  };

  drawn_.erase(std::remove_if(drawn_.begin(), drawn_.end(), cannotBeHeld), drawn_.end());
  if (drawn_.empty() && rules_.objects > 0)
    throw BadInput(
        fmt::format("random.gripper_width = {:g} m: no part of the model base can be held from above",
                    rules_.gripper_width));
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

Placed Arranger::put(const SceneObject& object) const {
  double top = 0;
  for (const Eigen::Vector3d& p : object.mesh->vertices)
    top = std::max(top, (object.world_from_object * p).z());
  const Footprint own = footprint(object);
  return {object, own, grown(own, rules_.gap), top, {}, nullptr};
}

const Choice& Arranger::drawChoice(int model) {
  const std::vector<Choice>& choices = choices_[model];
  double left = random_.uniform(0, 1);
  for (const Choice& choice : choices)
    if ((left -= choice.pose.weight) < 0) return choice;
  return choices.front();
}

bool Arranger::placePart() {
  const int model = drawn_[size_t(random_.integer(0, int(drawn_.size()) - 1))];
  const Choice& choice = drawChoice(model);
  SceneObject part{models_[size_t(model)].name, model, models_[size_t(model)].mesh, {}, {}};

  const SceneObject& frame = placed_.front().object;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : frame.mesh->vertices) box.extend(frame.world_from_object * p);
  for (int attempt = 0; attempt < 40; ++attempt) {
    const Rigid3 turned{
        expSO3({0, 0, random_.uniform(0, 2 * M_PI)}),
        {random_.uniform(box.min().x(), box.max().x()), random_.uniform(box.min().y(), box.max().y()), 0}};
    part.world_from_object = turned * choice.pose.table_from_object;

    // Beside the frame is free too: the part must lie inside the frame's box.
    Eigen::AlignedBox3d around;
    for (const Eigen::Vector3d& p : part.mesh->vertices) around.extend(part.world_from_object * p);
    const bool inside = (around.min().head<2>().array() > box.min().head<2>().array()).all() &&
                        (around.max().head<2>().array() < box.max().head<2>().array()).all();
    if (!inside) continue;

    const Footprint own = footprint(part);
    if (std::any_of(placed_.begin(), placed_.end(),
                    [&](const Placed& other) { return sharedCells(own, other.grown) > 0; }))
      continue;

    placed_.push_back(put(part));
    placed_.back().turned = turned;
    placed_.back().choice = &choice;
    return true;
  }
  return false;
}

bool Arranger::canBeTaken(const Placed& part) const {
  const auto covered = [&](const Eigen::Vector2d& p, double tip_z) {
    const cv::Point cell(int(std::lround(p.x() / kCell)), int(std::lround(p.y() / kCell)));
    for (const Placed& other : placed_) {
      const cv::Point at = cell - other.footprint.corner;
      if (&other != &part && other.top + 0.003 > tip_z &&
          cv::Rect({}, other.footprint.mask.size()).contains(at) && other.footprint.mask(at))
        return true;
    }
    return false;
  };

  const Eigen::Matrix2d turn = part.turned.rotation.topLeftCorner<2, 2>();
  const auto free = [&](const TopGrasp& grasp) {
    for (int side : {-1, 1})
      for (double y = 0; y <= rules_.finger_room; y += 0.002)
        for (double x = -kPadHalfWidth; x <= kPadHalfWidth; x += 0.002) {
          const Eigen::Vector2d p =
              grasp.middle + side * (grasp.width / 2 + y) * grasp.along + x * grasp.across;
          if (covered(turn * p + part.turned.translation.head<2>(), grasp.tip_z)) return false;
        }
    return true;
  };

  return std::any_of(part.choice->grasps.begin(), part.choice->grasps.end(), free);
}

}  // namespace

void arrangeAtRandom(const std::vector<NamedMesh>& models, CellScene* cell) {
  const CellRandom& rules = cell->options.random;
  Arranger arranger(rules, models);
  constexpr int kAttempts = 5000;
  std::vector<SceneObject> objects;
  int attempt = 0;
  while (attempt < kAttempts && !arranger.tryOnce(&objects)) ++attempt;
  if (attempt == kAttempts)
    throw BadInput(
        fmt::format("random.objects = {}: no room for so many in the frame, with random.gap and "
                    "random.finger_room between them",
                    rules.objects));

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
