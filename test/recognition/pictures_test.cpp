// The shipped pictures, from the image to the poses.
#include <opencv2/imgproc.hpp>

#include "world.h"

namespace monocular_eye_hand {
namespace {

constexpr double kImageError = 3.0;                // [px], modulo the symmetries
constexpr double kSurfaceError = 0.03;             // share of the diameter
constexpr double kRotationError = 2 * M_PI / 180;  // [rad]

// Whether a report is the pose of this true object.
bool isPoseOf(const ObjectEstimate& report, const TruthObject& truth, const Camera& camera) {
  return report.name == truth.name &&
         poseError(shippedModel(truth.name), camera, report.camera_from_object, truth.camera_from_object)
                 .image < 10;
}

void expectExact(const ObjectEstimate& report, const TruthObject& truth, const Camera& camera) {
  const PoseError error =
      poseError(shippedModel(truth.name), camera, report.camera_from_object, truth.camera_from_object);
  EXPECT_LT(error.image, kImageError) << truth.name;
  EXPECT_LT(error.surface, kSurfaceError) << truth.name;
  EXPECT_LT(error.rotation, kRotationError) << truth.name;
  EXPECT_LT(error.translation, 0.02 * truth.camera_from_object.translation.norm()) << truth.name;
}

void expectWellFormed(const ObjectEstimate& o) {
  EXPECT_EQ(o.name, shippedModels().objects.at(size_t(o.object)).model.name);
  for (double share : {o.probability, o.plausibility, o.reliability}) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
  }
  EXPECT_FALSE(o.reason.empty());
  EXPECT_LE(o.matched_features, o.expected_features);
  EXPECT_GT(o.matched_features, 0);
  EXPECT_GE(o.characteristic_view, 0);
  EXPECT_GT(o.bounding_box.area(), 0);
  EXPECT_NEAR(o.camera_from_object.rotation.determinant(), 1, 1e-9);
  EXPECT_TRUE(o.covariance.allFinite());
  EXPECT_GT(o.covariance.diagonal().minCoeff(), 0);
  EXPECT_FALSE(o.evidence.empty());
}

struct Expectation {
  const char* picture;
  double visible;  ///< objects seen by this share or more must be found
};

class ShippedPicture : public testing::TestWithParam<Expectation> {};

TEST_P(ShippedPicture, ShowsEachWellSeenObjectExactlyOnceAndNothingElse) {
  const Picture picture = shippedPicture(GetParam().picture);
  const RecognitionResult result = shippedRecognizer().recognize(picture.grey, picture.camera);
  EXPECT_FALSE(result.truncated);

  for (const TruthObject& truth : picture.truth) {
    int reports = 0;
    for (const ObjectEstimate& o : result.objects)
      if (isPoseOf(o, truth, picture.camera)) {
        ++reports;
        expectExact(o, truth, picture.camera);
        EXPECT_TRUE((o.bounding_box & truth.box_visible).area() > 0 || picture.camera.distorted());
      }
    EXPECT_LE(reports, 1) << truth.name << " is reported more than once:\n" << listed(result);
    if (truth.visible_fraction < GetParam().visible) continue;
    EXPECT_EQ(reports, 1) << truth.name << ", visible " << truth.visible_fraction << ":\n" << listed(result);
  }

  for (const ObjectEstimate& o : result.objects) {
    EXPECT_NE(o.decision, Decision::kRejected);
    EXPECT_GE(o.probability, shippedRecognizer().options().accept_probability);
    expectWellFormed(o);
    bool real = false;
    for (const TruthObject& truth : picture.truth) real |= isPoseOf(o, truth, picture.camera);
    EXPECT_TRUE(real) << o.name << " is not there:\n" << listed(result);
  }

  for (const ObjectEstimate& o : result.rejected) {
    EXPECT_EQ(o.decision, Decision::kRejected);
    EXPECT_FALSE(o.reason.empty());
  }
  for (size_t i = 1; i < result.objects.size(); ++i)
    EXPECT_GE(result.objects[i - 1].probability, result.objects[i].probability) << "best first";
}

INSTANTIATE_TEST_SUITE_P(
    All, ShippedPicture,
    testing::Values(Expectation{"golden/bridge", 0.5}, Expectation{"golden/grenade", 0.5},
                    Expectation{"golden/frame", 0.5}, Expectation{"golden/flange", 0.5},
                    Expectation{"golden/bracket", 0.5}, Expectation{"golden/distorted", 0.5},
                    Expectation{"golden/occluded", 0.9}, Expectation{"demo/two_bridges_and_grenade", 0.5},
                    Expectation{"demo/frame_and_flange", 0.5}),
    [](const auto& info) {
      std::string name = info.param.picture;
      std::replace(name.begin(), name.end(), '/', '_');
      return name;
    });

TEST(ShippedPictures, GoldenObjectsAreAcceptedWithAReportOfTheStages) {
  const Picture picture = shippedPicture("golden/bridge");
  const RecognitionResult result = shippedRecognizer().recognize(picture.grey, picture.camera);
  ASSERT_EQ(result.objects.size(), 1u) << listed(result);
  EXPECT_EQ(result.objects[0].decision, Decision::kAccepted) << listed(result);
  EXPECT_TRUE(result.reason.empty());
  EXPECT_FALSE(result.features.segments.empty());
  EXPECT_FALSE(result.groupings.empty());
  ASSERT_FALSE(result.stages.empty());
  for (const StageReport& stage : result.stages) {
    EXPECT_FALSE(stage.name.empty());
    EXPECT_GE(stage.seconds, 0);
  }
}

void expectNothing(const cv::Mat& grey, const Camera& camera, const std::string& what) {
  const RecognitionResult result = shippedRecognizer().recognize(grey, camera);
  EXPECT_TRUE(result.objects.empty()) << what << ":\n" << listed(result);
  EXPECT_FALSE(result.reason.empty()) << what;
  EXPECT_FALSE(result.truncated) << what;
}

TEST(NothingKnown, ClutterIsNothingAndTheReasonIsTold) {
  const Picture picture = shippedPicture("demo/nothing_known");
  ASSERT_TRUE(picture.truth.empty());
  expectNothing(picture.grey, picture.camera, "nothing_known");
}

TEST(NothingKnown, PlainNoiseChecksAndStripesAreNothing) {
  const Camera camera = testCamera();
  const cv::Size size(camera.width, camera.height);
  for (int level : {0, 128, 255}) expectNothing(cv::Mat(size, CV_8UC1, cv::Scalar(level)), camera, "plain");

  cv::RNG random(5);
  cv::Mat noise(size, CV_8UC1), soft;
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  expectNothing(noise, camera, "white noise");
  cv::GaussianBlur(noise, soft, {}, 4);
  cv::normalize(soft, soft, 0, 255, cv::NORM_MINMAX);
  expectNothing(soft, camera, "blobs");
  cv::Mat checks(size, CV_8UC1), stripes(size, CV_8UC1);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      checks.at<uint8_t>(v, u) = (u / 40 + v / 40) % 2 ? 60 : 190;
      stripes.at<uint8_t>(v, u) = (u + v / 2) / 30 % 2 ? 60 : 190;
    }
  expectNothing(checks, camera, "checks");
  expectNothing(stripes, camera, "stripes");
}

TEST(NothingKnown, TheReasonTellsAnEmptyImageFromAClutteredOne) {
  const Camera camera = testCamera();
  const cv::Mat plain(camera.height, camera.width, CV_8UC1, cv::Scalar(90));
  const std::string empty = shippedRecognizer().recognize(plain, camera).reason;
  const Picture clutter = shippedPicture("demo/nothing_known");
  EXPECT_THAT(empty, testing::HasSubstr("no straight edge"));
  EXPECT_NE(shippedRecognizer().recognize(clutter.grey, clutter.camera).reason, empty);
}

TEST(DoubleSize, TheSameObjectsAtTheSamePoses) {
  for (const char* name : {"golden/grenade", "demo/two_bridges_and_grenade"}) {
    const Picture picture = shippedPicture(name);
    cv::Mat large;
    cv::resize(picture.grey, large, {}, 2, 2, cv::INTER_CUBIC);
    const Camera camera = picture.camera.resized(2);
    const RecognitionResult result = shippedRecognizer().recognize(large, camera);
    EXPECT_EQ(result.objects.size(), picture.truth.size()) << name << ":\n" << listed(result);
    for (const TruthObject& truth : picture.truth) {
      int reports = 0;
      for (const ObjectEstimate& o : result.objects) {
        const PoseError error =
            poseError(shippedModel(truth.name), camera, o.camera_from_object, truth.camera_from_object);
        if (o.name != truth.name || error.image > 20) continue;
        ++reports;
        EXPECT_LT(error.image, 2 * kImageError) << "pixels of the large image";
        EXPECT_LT(error.surface, kSurfaceError);
        const cv::Rect box = truth.box_visible;
        EXPECT_NEAR(o.bounding_box.x, 2 * box.x, 8);
        EXPECT_NEAR(o.bounding_box.width, 2 * box.width, 12);
      }
      EXPECT_EQ(reports, 1) << truth.name << ":\n" << listed(result);
    }
  }
}

}  // namespace
}  // namespace monocular_eye_hand
