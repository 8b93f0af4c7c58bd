// The coarse score beside a plain sum over the samples, bit by bit: vector instructions change nothing.
#include "recognition/coarse_score.h"

#include <random>

#include "monocular_eye_hand/features/features.h"
#include "recognition/search_model.h"
#include "world.h"

namespace monocular_eye_hand {
namespace {

struct PlainScore {
  CoarseScore score;
  bool hopeless = false;  // by the first samples
};

// Sample by sample, as coarse_score.cpp computes it.
PlainScore plainScore(const std::vector<ViewSample>& samples, float step, const Rigid3& pose,
                      const Camera& camera, const EvidenceMap& map) {
  const Eigen::Matrix3f r = pose.rotation.cast<float>();
  const Eigen::Vector3f t = pose.translation.cast<float>();
  const float fx = float(camera.fx), fy = float(camera.fy);
  const float cx = float(camera.cx) - float(map.u0()) + 0.5f, cy = float(camera.cy) - float(map.v0()) + 0.5f;
  const std::map<size_t, float> least_mean{{8, -1.0f}, {16, -0.6f}, {32, -0.1f}};
  float sum = 0, inside = 0, total = 0;
  PlainScore result;

  for (size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3f &p = samples[i].p, &d = samples[i].tangent;
    const float z = r(2, 0) * p.x() + r(2, 1) * p.y() + r(2, 2) * p.z() + t.z();
    if (z <= 1e-3f) result.hopeless = true;
    const float w = 1.0f / z;
    const float x = (r(0, 0) * p.x() + r(0, 1) * p.y() + r(0, 2) * p.z() + t.x()) * w;
    const float y = (r(1, 0) * p.x() + r(1, 1) * p.y() + r(1, 2) * p.z() + t.y()) * w;
    const float dx = r(0, 0) * d.x() + r(0, 1) * d.y() + r(0, 2) * d.z();
    const float dy = r(1, 0) * d.x() + r(1, 1) * d.y() + r(1, 2) * d.z();
    const float dz = r(2, 0) * d.x() + r(2, 1) * d.y() + r(2, 2) * d.z();
    const float du = fx * (dx - x * dz) * w, dv = fy * (dy - y * dz) * w;
    const float length = std::sqrt(du * du + dv * dv);
    const float u = fx * x + cx, v = fy * y + cy;
    const bool on_map = u >= 0 && v >= 0 && u < float(map.full().width()) && v < float(map.full().height());
    const int8_t value = on_map ? map.full().at(orientationBin(du, dv), int(u), int(v)) : kOutside;

    total += length;
    if (value != kOutside) {
      inside += length;
      sum += length * float(value);
    }
    const auto least = least_mean.find(i + 1);
    if (least != least_mean.end() && sum < least->second * kEvidenceUnit * inside) result.hopeless = true;
  }

  result.score.evidence = sum * step / (5.0f * kEvidenceUnit);
  result.score.in_frame = total > 0 ? inside / total : 0;
  return result;
}

TEST(CoarseScore, IsThePlainSumBitByBitWhereverThePartLies) {
  const Picture picture = shippedPicture("demo/two_bridges_and_grenade");
  const RectDomain domain = rectDomain(picture.camera);
  const EvidenceMap map(detectFeatures(picture.grey, picture.camera), domain);
  const SearchModel model(shippedModels().objects.at(size_t(shippedModels().indexOf("bridge"))));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);

  int scored = 0;
  for (const TruthObject& truth : picture.truth) {
    if (truth.name != "bridge") continue;
    for (int k = 0; k < 2000; ++k) {
      Rigid3 pose = truth.camera_from_object;
      const double reach = k < 1000 ? 0.005 : 0.3;  // some partly or wholly out of the picture
      pose.translation += reach * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
      int view = 0;
      pose = model.canonical(pose, &view);
      const std::vector<ViewSample>& samples = model.samples(view);
      const float step = model.coarse(view).step;
      const PlainScore plain = plainScore(samples, step, pose, picture.camera, map);
      const CoarseScore score = scorePose(model.coarse(view), pose, picture.camera, map);
      if (plain.hopeless) {
        EXPECT_LT(score.evidence, -1e5f);
        continue;
      }
      ++scored;
      EXPECT_EQ(score.evidence, plain.score.evidence);
      EXPECT_EQ(score.in_frame, plain.score.in_frame);
    }
  }
  EXPECT_GT(scored, 200);
}

TEST(CoarseScore, AContourOfAnyNumberOfSamplesIsFilledUpWithWhatSaysNothing) {
  const Picture picture = shippedPicture("golden/bridge");
  const EvidenceMap map(detectFeatures(picture.grey, picture.camera), rectDomain(picture.camera));
  const SearchModel model(shippedModels().objects.at(size_t(shippedModels().indexOf("bridge"))));
  int view = 0;
  const Rigid3 pose = model.canonical(picture.truth.at(0).camera_from_object, &view);
  for (size_t count : {1, 5, 8, 13}) {
    const std::vector<ViewSample>& all = model.samples(view);
    ASSERT_GE(all.size(), count);
    const std::vector<ViewSample> some(all.begin(), all.begin() + long(count));
    const PlainScore plain = plainScore(some, 0.01f, pose, picture.camera, map);
    ASSERT_FALSE(plain.hopeless);
    EXPECT_EQ(scorePose(CoarseContour(some, 0.01f), pose, picture.camera, map).evidence,
              plain.score.evidence);
  }
  EXPECT_EQ(scorePose(CoarseContour({}, 0.01f), pose, picture.camera, map).in_frame, 0);
}

}  // namespace
}  // namespace monocular_eye_hand
