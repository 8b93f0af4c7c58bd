#include "recognition/coarse_score.h"

#include <algorithm>
#include <cmath>

#include "monocular_eye_hand/geometry/vector_clones.h"

namespace monocular_eye_hand {
namespace {

constexpr float kNearest = 1e-3f;  // depth of a sample that a camera can see [m]

// A pose in single precision, over the map.
struct PoseInMap {
  PoseInMap(const Rigid3& pose, const Camera& camera, const EvidenceMap& map)
      : rotation(pose.rotation.cast<float>()),
        translation(pose.translation.cast<float>()),
        fx(float(camera.fx)),
        fy(float(camera.fy)),
        cx(float(camera.cx) - float(map.u0()) + 0.5f),
        cy(float(camera.cy) - float(map.v0()) + 0.5f) {}

  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  float fx, fy, cx, cy;
};

// Where the samples of a batch look into the map, and how long a metre along each is there [px].
struct Looks {
  std::array<int, CoarseContour::kBatch> place;  // EvidencePlanes::index
  std::array<float, CoarseContour::kBatch> length;
  bool all_in_front = true;
};

MONOCULAR_EYE_HAND_VECTOR_CLONES
void lookAt(const CoarseContour& contour, int first, const PoseInMap& pose, const EvidencePlanes& planes,
            Looks* looks) {
  constexpr int kBatch = CoarseContour::kBatch;
  const float* const px = &contour.p[0][size_t(first)];
  const float* const py = &contour.p[1][size_t(first)];
  const float* const pz = &contour.p[2][size_t(first)];
  const float* const tx = &contour.tangent[0][size_t(first)];
  const float* const ty = &contour.tangent[1][size_t(first)];
  const float* const tz = &contour.tangent[2][size_t(first)];
  const Eigen::Matrix3f r = pose.rotation;
  const Eigen::Vector3f t = pose.translation;

  float u[kBatch], v[kBatch], du[kBatch], dv[kBatch], depth[kBatch];
  for (int i = 0; i < kBatch; ++i) {
    const float z = r(2, 0) * px[i] + r(2, 1) * py[i] + r(2, 2) * pz[i] + t.z();
    const float w = 1.0f / z;
    const float x = (r(0, 0) * px[i] + r(0, 1) * py[i] + r(0, 2) * pz[i] + t.x()) * w;
    const float y = (r(1, 0) * px[i] + r(1, 1) * py[i] + r(1, 2) * pz[i] + t.y()) * w;
    const float dx = r(0, 0) * tx[i] + r(0, 1) * ty[i] + r(0, 2) * tz[i];
    const float dy = r(1, 0) * tx[i] + r(1, 1) * ty[i] + r(1, 2) * tz[i];
    const float dz = r(2, 0) * tx[i] + r(2, 1) * ty[i] + r(2, 2) * tz[i];
    depth[i] = z;
    u[i] = pose.fx * x + pose.cx;
    v[i] = pose.fy * y + pose.cy;
    du[i] = pose.fx * (dx - x * dz) * w;
    dv[i] = pose.fy * (dy - y * dz) * w;
  }

  int behind = 0;
  for (int i = 0; i < kBatch; ++i) behind |= int(depth[i] <= kNearest);
  looks->all_in_front = behind == 0;

  int bin[kBatch];
  for (int i = 0; i < kBatch; ++i) bin[i] = orientationBin(du[i], dv[i]);
  for (int i = 0; i < kBatch; ++i) looks->length[size_t(i)] = std::sqrt(du[i] * du[i] + dv[i] * dv[i]);
  for (int i = 0; i < kBatch; ++i) looks->place[size_t(i)] = planes.indexNear(bin[i], u[i], v[i]);
}

}  // namespace

CoarseContour::CoarseContour(const std::vector<ViewSample>& samples, float sample_step) : step(sample_step) {
  for (Row& row : p) row.fill(0);
  for (Row& row : tangent) row.fill(0);
  if (samples.empty()) return;

  count = (int(samples.size()) + kBatch - 1) / kBatch * kBatch;
  for (size_t i = 0; i < size_t(count); ++i) {
    const bool fills_up = i >= samples.size();
    const ViewSample& sample = samples[fills_up ? 0 : i];
    for (size_t axis = 0; axis < 3; ++axis) {
      p[axis][i] = sample.p[long(axis)];
      tangent[axis][i] = fills_up ? 0 : sample.tangent[long(axis)];
    }
  }
}

CoarseScore scorePose(const CoarseContour& contour, const Rigid3& pose, const Camera& camera,
                      const EvidenceMap& map) {
  constexpr CoarseScore kHopeless{-1e6f, 0};
  // Mean evidence after the first, second and fourth batch below which a pose is hopeless [nats].
  constexpr std::array<float, 5> kMinMean{-1e6f, -1.0f, -0.6f, -1e6f, -0.1f};
  const PoseInMap in_map(pose, camera, map);
  const EvidencePlanes& planes = map.full();
  Looks looks;
  float sum = 0;
  float inside = 0;
  float total = 0;

  for (int first = 0, batch = 1; first < contour.count; first += CoarseContour::kBatch, ++batch) {
    lookAt(contour, first, in_map, planes, &looks);
    if (!looks.all_in_front) return kHopeless;
    for (size_t i = 0; i < looks.place.size(); ++i) {
      total += looks.length[i];
      const int8_t value = looks.place[i] < 0 ? kOutside : planes.value(looks.place[i]);
      if (value == kOutside) continue;
      inside += looks.length[i];
      sum += looks.length[i] * float(value);
    }
    if (batch < int(kMinMean.size()) && sum < kMinMean[size_t(batch)] * kEvidenceUnit * inside)
      return kHopeless;
  }

  CoarseScore score;
  score.evidence = sum * contour.step / (5.0f * kEvidenceUnit);
  score.in_frame = total > 0 ? inside / total : 0;
  return score;
}

}  // namespace monocular_eye_hand
