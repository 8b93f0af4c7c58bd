// Does the covariance of a pose tell its error? One part at a time lies in random scenes that are rendered
// and recognised. What the part's symmetry leaves open is left out: of a turned part the errors of its centre
// and of its axis' direction count. A line of the CSV is a pose: the squared Mahalanobis distance of its
// error, and for its centre (x, y, z) and its rotations error and reported standard deviation [m, rad],
// camera axes.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "monocular_eye_hand/geometry/covariance.h"
#include "monocular_eye_hand/model/equal_poses.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/recognition/recognizer.h"
#include "monocular_eye_hand/simulation/render/render.h"
#include "monocular_eye_hand/simulation/scenes/random_scene.h"

namespace {

using namespace monocular_eye_hand;

constexpr double kRight = 0.1;  // farther from the truth than this share of the diameter is another pose

// A camera of 640 x 480 pixels that reads out the part, its own middle and a margin only.
Camera cameraOn(const Mesh& mesh, const Rigid3& camera_from_object) {
  constexpr double kMargin = 40;
  Camera camera{640, 480, 600, 600, 319.5, 239.5, DistortionModel::kNone, {}};
  Eigen::AlignedBox2d window(Eigen::Vector2d(camera.cx, camera.cy));
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    window.extend(camera.project(camera_from_object * vertex));
  const int left = std::clamp(int(window.min().x() - kMargin), 0, camera.width - 64);
  const int top = std::clamp(int(window.min().y() - kMargin), 0, camera.height - 64);
  camera.width = std::clamp(int(window.max().x() + kMargin), left + 64, camera.width) - left;
  camera.height = std::clamp(int(window.max().y() + kMargin), top + 64, camera.height) - top;
  camera.cx -= left;
  camera.cy -= top;
  return camera;
}

struct Sample {
  Eigen::VectorXd error;  // of the centre [m], then of the rotations that can be seen [rad]
  Eigen::MatrixXd covariance;
};

// From perturbed()'s coordinates to the centre's motion and the rotations across the free axis.
Eigen::MatrixXd seenMotions(const ObjectModel& model, const Rigid3& pose) {
  const Symmetries& symmetries = model.symmetries;
  Eigen::Vector3d centre = model.centre();
  Eigen::MatrixXd turns = Eigen::Matrix3d::Identity();
  if (symmetries.axis) {
    const SymmetryAxis& axis = *symmetries.axis;
    centre = axis.point + axis.direction * axis.direction.dot(centre - axis.point);
    const Eigen::Vector3d direction = pose.rotation * axis.direction, across = direction.unitOrthogonal();
    turns.resize(2, 3);
    turns << across.transpose(), direction.cross(across).transpose();
  }
  const int n = int(turns.rows());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 + n, 6);
  motions.topRows(3) = adjointOfTranslation(pose * centre - pose.translation).topRows(3);
  motions.bottomRightCorner(n, 3) = turns;
  return motions;
}

std::optional<Sample> measure(const Recognizer& recognizer, int part, uint32_t seed) {
  const ObjectModel& model = recognizer.models().objects[size_t(part)].model;
  RandomSceneOptions options;
  options.parts = 1;
  const Scene scene = randomScene({namedMeshes(recognizer.models())[size_t(part)]}, seed, options);
  RenderOptions look;
  look.seed = seed;
  const Rigid3 truth = scene.cameraFromObject(0);
  const Camera camera = cameraOn(*scene.objects[0].mesh, truth);
  const RenderedImage image = renderScene(scene, camera, look);
  RecognitionRequest request;
  request.only = model.name;
  for (const ObjectEstimate& found : recognizer.recognize(image.grey, camera, request).objects) {
    const Rigid3 pose = nearestEqualPose(model, found.camera_from_object, truth);
    const Vector6d error = difference(truth, pose);
    const Eigen::MatrixXd motions = seenMotions(model, pose);
    Sample sample{motions * error, motions * found.covariance * motions.transpose()};
    const double turn = sample.error.tail(sample.error.size() - 3).norm() * 0.5;
    if (sample.error.head<3>().norm() / model.diameter + turn < kRight) return sample;
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "pose_covariance OBJECTS.yaml POSES OUT.csv\n");
    return 2;
  }
  const int poses = std::stoi(argv[2]);
  const Recognizer recognizer(loadModels(argv[1], ModelDepth::kViews));
  std::ofstream out(argv[3]);
  out << "part,seed,square,freedoms,errors,sigmas\n";
  for (int part = 0; part < int(recognizer.models().objects.size()); ++part) {
    std::vector<std::optional<Sample>> samples(static_cast<size_t>(poses));
    std::atomic<int> next{0};
    const auto work = [&] {
      for (int i = next++; i < poses; i = next++) samples[size_t(i)] = measure(recognizer, part, uint32_t(i));
    };
    std::vector<std::thread> workers;
    for (unsigned k = 0; k < std::max(1u, std::thread::hardware_concurrency()); ++k)
      workers.emplace_back(work);
    for (std::thread& worker : workers) worker.join();
    for (int i = 0; i < poses; ++i) {
      const std::optional<Sample>& s = samples[size_t(i)];
      if (!s) continue;
      out << recognizer.models().objects[size_t(part)].model.name << ',' << i << ','
          << s->error.dot(s->covariance.ldlt().solve(s->error)) << ',' << s->error.size() << ','
          << s->error.transpose() << ',' << s->covariance.diagonal().cwiseSqrt().transpose() << '\n';
    }
  }
  return out.flush() ? 0 : 1;
}
