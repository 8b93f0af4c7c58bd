#include "tools/judged_poses.h"

#include <fmt/format.h>

namespace monocular_eye_hand {
namespace {

JudgedPose::Fate fateOf(const JudgedCandidate& candidate) {
  if (candidate.fate == Fate::kSuppressed) return JudgedPose::kSuppressed;
  return candidate.fate == Fate::kRejected ? JudgedPose::kRejected : JudgedPose::kReported;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& one : words) text += (text.empty() ? "" : "; ") + one;
  return text;
}

// A rejected candidate stands among the rejected objects, too, with what spoke against it in words.
std::string rejection(const RecognitionResult& result, const JudgedCandidate& candidate) {
  const Rigid3& pose = candidate.camera_from_object;
  for (const ObjectEstimate& object : result.rejected)
    if (object.object == candidate.object && object.camera_from_object.translation == pose.translation &&
        object.camera_from_object.rotation == pose.rotation)
      return joined(object.spoke_against);
  return "";
}

std::string suppression(const JudgedCandidate& candidate, const JudgedCandidate& by) {
  const bool same = by.object == candidate.object;
  return fmt::format("{} at p {:.2f}, rank {:.3g} over {:.3g}{}",
                     same ? "another pose of it" : "a " + by.name, by.probability, by.rank_score,
                     candidate.rank_score, by.fate == Fate::kRejected ? ", which was then rejected" : "");
}

std::string whatSpokeAgainst(const RecognitionResult& result, const JudgedCandidate& candidate) {
  if (candidate.fate == Fate::kRejected) return rejection(result, candidate);
  const bool known = candidate.suppressed_by >= 0 && candidate.suppressed_by < int(result.judged.size());
  return known ? suppression(candidate, result.judged[size_t(candidate.suppressed_by)]) : "";
}

}  // namespace

std::vector<JudgedPose> judgedPoses(const RecognitionResult& result, const std::vector<int>& bop_objects,
                                    const BopImage& image, int first) {
  std::vector<JudgedPose> poses;
  for (const JudgedCandidate& candidate : result.judged) {
    JudgedPose pose;
    pose.scene = image.scene;
    pose.image = image.id;
    pose.object = bop_objects.at(size_t(candidate.object));
    pose.camera_from_object = candidate.camera_from_object;
    pose.probability = candidate.probability;
    pose.fate = fateOf(candidate);
    if (candidate.suppressed_by >= 0) pose.suppressed_by = first + candidate.suppressed_by;
    pose.against = whatSpokeAgainst(result, candidate);
    pose.strongest_against = candidate.strongest_against;
    pose.evidence = candidate.evidence;
    poses.push_back(std::move(pose));
  }
  return poses;
}

SearchLimits searchLimits(const RecognitionOptions& options, double scale) {
  SearchLimits limits;
  limits.min_distance = options.min_distance;
  limits.max_distance = options.max_distance;
  limits.min_size = options.min_size;
  limits.min_in_frame = options.min_in_frame;
  limits.accept_probability = options.accept_probability;
  limits.searched_scale = scale;
  return limits;
}

}  // namespace monocular_eye_hand
