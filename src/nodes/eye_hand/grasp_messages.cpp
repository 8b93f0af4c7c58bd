#include "nodes/eye_hand/grasp_messages.h"

#include "nodes/eye_hand/conversion.h"

namespace monocular_eye_hand {
namespace {

using Response = GraspTargets::Response;

uint8_t code(GraspStatus status) {
  switch (status) {
    case GraspStatus::kFound:
      return Response::FOUND;
    case GraspStatus::kUnknownName:
      return Response::UNKNOWN_NAME;
    case GraspStatus::kNotReady:
      return Response::NOT_READY;
    case GraspStatus::kNotKnown:
      return Response::NOT_KNOWN;
    case GraspStatus::kNoGrasp:
      return Response::NO_GRASP;
    case GraspStatus::kTooUncertain:
      return Response::TOO_UNCERTAIN;
  }
  return Response::NO_GRASP;
}

}  // namespace

Response toMessage(const GraspAnswer& answer, const KnownObjects& known) {
  Response response;
  response.status = code(answer.status);
  response.text = answer.text;
  if (!answer.index) return response;
  for (const GraspCandidate& grasp : answer.candidates)
    response.targets.push_back(toMessage(known.messages.at(*answer.index), grasp));
  return response;
}

GraspTargetArray toMessage(const std::vector<BestGrasp>& best, const KnownObjects& known,
                           const std::string& base_frame) {
  GraspTargetArray array;
  array.header.stamp = known.stamp;
  array.header.frame_id = base_frame;
  for (const BestGrasp& one : best) {
    const LocatedObject& object = known.messages.at(one.index);
    array.targets.push_back(one.grasp ? toMessage(object, *one.grasp) : noGrasp(object, one.reason));
  }
  return array;
}

}  // namespace monocular_eye_hand
