#include "monocular_eye_hand/simulation/cell/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/random.h"
#include "simulation/render/fast_renderer.h"
#include "simulation/render/parallel_rows.h"
#include "simulation/render/sensor.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMean = 0.42;  // of the linear image when the exposure is chosen

int threadCount(int wanted) {
  if (wanted < 0) throw BadInput(fmt::format("camera threads = {} must be >= 0 (0: all cores)", wanted));
  return wanted > 0 ? wanted : std::max(1, int(std::thread::hardware_concurrency()));
}

/// Values of the normal distribution, equally likely: noise by one look-up.
const std::array<float, 4096>& normalValues() {
  static const std::array<float, 4096> table = [] {
    std::array<float, 4096> values;
    for (size_t k = 0; k < values.size(); ++k) {
      const double p = (double(k) + 0.5) / double(values.size());
      double x = 0;  // Newton on the distribution function
      for (int pass = 0; pass < 60; ++pass) {
        const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - p;
        const double slope = std::exp(-x * x / 2) / std::sqrt(2 * M_PI);
        x -= std::clamp(error / slope, -0.5, 0.5);
      }
      values[k] = float(x);
    }
    return values;
  }();
  return table;
}

/// A solid of the arm as the camera sees it.
struct ArmBody {
  size_t link;
  Mesh mesh;
  double albedo;
  Eigen::Vector3d low, high;  // its box, link frame
};

std::vector<ArmBody> armBodies(const ArmDescription& arm) {
  std::vector<ArmBody> bodies;
  for (size_t k = 0; k < arm.links.size(); ++k) {
    const auto& shapes = arm.links[k].visual.empty() ? arm.links[k].collision : arm.links[k].visual;
    for (const ArmShape& shape : shapes) {
      ArmBody body{k, solidMesh(shape), shape.colour.dot(Eigen::Vector3d(0.299, 0.587, 0.114)),
                   Eigen::Vector3d::Constant(1e9), Eigen::Vector3d::Constant(-1e9)};
      for (const Eigen::Vector3d& p : body.mesh.vertices) {
        body.low = body.low.cwiseMin(p);
        body.high = body.high.cwiseMax(p);
      }
      bodies.push_back(std::move(body));
    }
  }
  return bodies;
}

/// Everything that the camera can see move.
std::vector<double> visibleState(const WorkCell& cell) {
  std::vector<double> state(cell.joints().data(), cell.joints().data() + 6);
  state.push_back(cell.gripperWidth());
  for (const SceneObject& object : cell.scene().scene.objects) {
    const Rigid3& pose = object.world_from_object;
    state.insert(state.end(), pose.rotation.data(), pose.rotation.data() + 9);
    state.insert(state.end(), pose.translation.data(), pose.translation.data() + 3);
  }
  return state;
}

/// A number of what the camera sees, to a nanometre and a nanoradian: the noise of that state.
uint32_t stateKey(const WorkCell& cell) {
  uint32_t key = mixBits(uint32_t(cell.scene().options.seed));
  const auto add = [&key](double value) {
    const int64_t rounded = std::llround(value * 1e9);
    key = mixBits(mixBits(key, uint32_t(rounded)), uint32_t(rounded >> 32));
  };
  for (int j = 0; j < 6; ++j) add(cell.joints()[j]);
  add(cell.gripperWidth());
  for (const SceneObject& object : cell.scene().scene.objects) {
    for (int k = 0; k < 9; ++k) add(object.world_from_object.rotation(k / 3, k % 3));
    for (int k = 0; k < 3; ++k) add(object.world_from_object.translation[k]);
  }
  return key;
}

}  // namespace

struct CellCamera::Impl {
  Impl(const WorkCell& cell, int wanted_threads)
      : options(cell.scene().options),
        camera(cell.scene().camera),
        threads(threadCount(wanted_threads)),
        objects(int(cell.scene().scene.objects.size())),
        arm_bodies(armBodies(cell.arm())),
        table_mesh(boxMesh({options.table.length, options.table.width, options.table.thickness})),
        table(objects + int(arm_bodies.size())),
        world(meshes(cell)),
        shading(cell.scene().scene, materials(cell), table, threads),
        renderer(camera, world, shading, options.camera.shadows, threads) {}

  std::vector<const Mesh*> meshes(const WorkCell& cell) const {
    std::vector<const Mesh*> out;
    for (const SceneObject& object : cell.scene().scene.objects) out.push_back(object.mesh.get());
    for (const ArmBody& body : arm_bodies) out.push_back(&body.mesh);
    out.push_back(&table_mesh);
    return out;
  }
  std::vector<Material> materials(const WorkCell& cell) const {
    std::vector<Material> out;
    for (const SceneObject& object : cell.scene().scene.objects) out.push_back(object.material);
    for (const ArmBody& body : arm_bodies) out.push_back({body.albedo, 0.1, 30, {}});
    out.push_back(cell.scene().scene.table.material);
    return out;
  }
  void place(const WorkCell& cell);
  void takeMaps(CellImage* image) const;
  cv::Mat sensor(const cv::Mat1f& radiance, uint32_t key, double* exposure) const;

  CellOptions options;
  Camera camera;
  int threads, objects;
  std::vector<ArmBody> arm_bodies;
  Mesh table_mesh;
  int table;
  InstanceWorld world;
  FastShading shading;
  FastRenderer renderer;
  std::vector<double> last_state;  // of last_grey
  cv::Mat last_grey;
};

void CellCamera::Impl::place(const WorkCell& cell) {
  const CellScene& scene = cell.scene();
  const Rigid3 table_from_base = scene.base_from_table.inverse();
  const std::vector<Rigid3> base_from_links = cell.baseFromLinks();
  const Eigen::Vector3d eye = cell.baseFromCamera().translation;

  std::vector<Rigid3> poses;
  std::vector<bool> seen;
  for (size_t k = 0; k < scene.scene.objects.size(); ++k) {
    poses.push_back(scene.scene.objects[k].world_from_object);
    seen.push_back(!cell.takenAway(int(k)));
  }
  for (const ArmBody& body : arm_bodies) {
    poses.push_back(table_from_base * base_from_links[body.link]);
    // The camera's own housing around the lens is not seen from inside.
    const Eigen::Vector3d p = base_from_links[body.link].inverse() * eye;
    seen.push_back(((p - body.low).array() < -1e-3).any() || ((body.high - p).array() < -1e-3).any());
  }
  poses.push_back({Eigen::Matrix3d::Identity(), {0, 0, -options.table.thickness}});
  seen.push_back(true);

  world.place(poses, seen);
  shading.place(poses);
}

void CellCamera::Impl::takeMaps(CellImage* image) const {
  image->depth = renderer.depth();
  image->ids = renderer.bodies();
  for (int y = 0; y < image->ids.rows; ++y)
    for (int x = 0; x < image->ids.cols; ++x) {
      short& id = image->ids.at<short>(y, x);
      if (id < 0)
        id = kNothingId;
      else if (id == table)
        id = kTableId;
      else if (id >= objects)
        id = kArmId;
    }
}

cv::Mat CellCamera::Impl::sensor(const cv::Mat1f& radiance, uint32_t key, double* exposure) const {
  const CellCameraOptions& sensor = options.camera;
  const cv::Mat1f light = blurred(radiance, sensor.blur_sigma);
  *exposure = sensor.exposure > 0 ? sensor.exposure : automaticExposure(light, kMean);

  const float gain = float(*exposure), base = float(sensor.noise_sigma * sensor.noise_sigma);
  const float shot = float(sensor.shot_noise), power = float(1 / sensor.gamma);
  const auto& normal = normalValues();

  cv::Mat grey(light.rows, light.cols, CV_8UC1);
  parallelRows(threads, grey.rows, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < grey.cols; ++x) {
        const float linear = std::clamp(gain * light(y, x), 0.0f, 1.0f);
        const float value = 255 * (power == 1 ? linear : std::pow(linear, power));
        const uint32_t bits = mixBits(key + uint32_t(y) * 0x9e3779b9u + uint32_t(x) * 0x85ebca6bu);
        const float noise = std::sqrt(base + shot * value) * normal[bits >> 20];
        grey.at<uchar>(y, x) = cv::saturate_cast<uchar>(int(std::floor(value + noise + 0.5f)));
      }
  });
  return grey;
}

CellCamera::CellCamera(const WorkCell& cell, int threads) : impl_(new Impl(cell, threads)) {}
CellCamera::~CellCamera() = default;
CellCamera::CellCamera(CellCamera&&) noexcept = default;

const Camera& CellCamera::camera() const { return impl_->camera; }

CellImage CellCamera::capture(const WorkCell& cell) {
  if (int(cell.scene().scene.objects.size()) != impl_->objects)
    throw BadInput("cell camera: made for another cell");
  CellImage image;
  image.time = cell.time();
  image.base_from_camera = cell.baseFromCamera();
  impl_->place(cell);
  // Shadow samples stay where they are from frame to frame: a still scene does not flicker.
  const cv::Mat1f& radiance = impl_->renderer.render(
      cell.scene().base_from_table.inverse() * image.base_from_camera, uint32_t(impl_->options.seed));
  image.grey = impl_->sensor(radiance, stateKey(cell), &image.exposure);
  impl_->takeMaps(&image);
  return image;
}

const cv::Mat& CellCamera::grey(const WorkCell& cell) {
  std::vector<double> state = visibleState(cell);
  if (impl_->last_grey.empty() || state != impl_->last_state) {
    impl_->last_grey = capture(cell).grey;
    impl_->last_state = std::move(state);
  }
  return impl_->last_grey;
}

}  // namespace monocular_eye_hand
