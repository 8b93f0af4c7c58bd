#include "tools/result_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

using Json = nlohmann::ordered_json;

// Roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll), as tf's getRPY [rad].
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& r) {
  const double pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  if (std::abs(r(2, 0)) > 1 - 1e-12)
    return {0, pitch, std::atan2(-r(0, 1), r(1, 1))};  // gimbal lock: roll = 0
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

std::string objectLine(const ObjectEstimate& object, size_t name_width) {
  const Eigen::Vector3d t = object.camera_from_object.translation * 1e3;
  const Eigen::Vector3d rpy = rollPitchYaw(object.camera_from_object.rotation) * (180 / M_PI);
  return fmt::format("  {:<{}} {:8.1f} {:8.1f} {:8.1f}  {:7.1f} {:7.1f} {:7.1f}  {:11.3f}  {}{}\n",
                     object.name, name_width, t.x(), t.y(), t.z(), rpy.x(), rpy.y(), rpy.z(),
                     object.probability, toString(object.decision),
                     object.symmetry.empty() ? "" : ", " + object.symmetry);
}

Json list(const double* values, size_t count) {
  Json out = Json::array();
  for (size_t i = 0; i < count; ++i) out.push_back(values[i]);
  return out;
}

Json poseJson(const Rigid3& pose) {
  const Eigen::Quaterniond q = pose.quaternion();
  const double xyzw[] = {q.x(), q.y(), q.z(), q.w()};
  return {{"translation", list(pose.translation.data(), 3)}, {"quaternion", list(xyzw, 4)}};
}

Json objectJson(const ObjectEstimate& object, const ModelBase& models) {
  const Eigen::Matrix<double, 6, 6, Eigen::RowMajor> covariance = object.covariance;
  Json out;
  out["name"] = object.name;
  out["decision"] = toString(object.decision);
  out["probability"] = object.probability;
  out["plausibility"] = object.plausibility;
  out["reliability"] = object.reliability;

  out["pose"] = poseJson(object.camera_from_object);
  out["covariance"] = list(covariance.data(), 36);
  out["free_axis"] = object.free_axis;
  out["symmetry"] = object.symmetry;

  out["matched_features"] = object.matched_features;
  out["expected_features"] = object.expected_features;
  out["matched_groupings"] = object.matched_groupings;
  out["characteristic_view"] = object.characteristic_view;
  const cv::Rect& box = object.bounding_box;
  out["bounding_box"] = {box.x, box.y, box.width, box.height};

  out["reason"] = object.reason;
  out["spoke_for"] = object.spoke_for;
  out["spoke_against"] = object.spoke_against;
  out["evidence"] = object.evidence;

  out["alternatives"] = Json::array();
  for (const Alternative& alternative : object.alternatives)
    out["alternatives"].push_back({{"name", models.objects.at(size_t(alternative.object)).model.name},
                                   {"probability", alternative.probability},
                                   {"pose", poseJson(alternative.camera_from_object)}});
  return out;
}

}  // namespace

std::string table(const ImageReport& report) {
  if (!report.error.empty()) return report.image + "\n  not processed: " + report.error + "\n";
  const auto& objects = report.result.objects;
  const char* cut = report.result.truncated      ? " (truncated by the time limit)"
                    : report.result.budget_spent ? " (cut by the budget of hypotheses)"
                                                 : "";
  std::string text = fmt::format("{}: {} object{} in {:.2f} s{}\n", report.image, objects.size(),
                                 objects.size() == 1 ? "" : "s", report.seconds, cut);
  if (objects.empty()) return text + "  nothing found: " + report.result.reason + "\n";
  size_t width = 4;
  for (const ObjectEstimate& object : objects) width = std::max(width, object.name.size());
  text += "  name" + std::string(width - 4, ' ') +
          "   x [mm]   y [mm]   z [mm]  roll[deg]  pitch     yaw  probability  decision\n";
  for (const ObjectEstimate& object : objects) text += objectLine(object, width);
  return text;
}

Json toJson(const ImageReport& report, const ModelBase& models) {
  Json out;
  out["image"] = report.image;
  if (!report.error.empty()) {
    out["error"] = report.error;
    return out;
  }

  const RecognitionResult& result = report.result;
  out["seconds"] = report.seconds;
  out["truncated"] = result.truncated;
  out["budget_spent"] = result.budget_spent;
  out["reason"] = result.reason;

  for (const auto& [key, objects] :
       {std::make_pair("objects", &result.objects), std::make_pair("rejected", &result.rejected)}) {
    out[key] = Json::array();
    for (const ObjectEstimate& object : *objects) out[key].push_back(objectJson(object, models));
  }

  out["stages"] = Json::array();
  for (const StageReport& stage : result.stages)
    out["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}, {"counts", stage.counts}});
  return out;
}

}  // namespace monocular_eye_hand
