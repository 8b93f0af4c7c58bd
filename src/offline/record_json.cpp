#include <nlohmann/json.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/offline/clearing_report.h"

namespace monocular_eye_hand {
namespace {

using Json = nlohmann::json;

constexpr int kLastOutcome = int(ActionOutcome::kFault);

Rigid3 poseOf(const Json& json) {
  const auto t = json.at("position").get<std::array<double, 3>>();
  const auto q = json.at("quaternion").get<std::array<double, 4>>();  // x, y, z, w
  return {Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix(), {t[0], t[1], t[2]}};
}

std::vector<TrueObject> truthOf(const Json& json) {
  std::vector<TrueObject> truth;
  for (const Json& object : json)
    truth.push_back({object.at("label"), object.at("name"), poseOf(object.at("pose")), object.at("held"),
                     object.at("in_drop_zone")});
  return truth;
}

ActionResult resultOf(const Json& json) {
  const int outcome = json.at("outcome");
  if (outcome < 0 || outcome > kLastOutcome)
    throw BadInput("outcome = " + std::to_string(outcome) + " must be 0 to " + std::to_string(kLastOutcome));
  return {ActionOutcome(outcome), json.at("reason"), json.at("planning_s"), json.at("motion_s")};
}

PickRecord pickOf(const Json& json) {
  PickRecord pick;
  pick.name = json.at("name");
  pick.instance = json.at("instance");
  pick.base_from_object = poseOf(json.at("object"));
  pick.base_from_grasp = poseOf(json.at("grasp"));
  pick.truth = truthOf(json.at("truth"));
  if (json.contains("result")) pick.result = resultOf(json.at("result"));
  return pick;
}

ToldEnd endOf(const Json& json) {
  ToldEnd end;
  end.reason = json.at("reason");
  end.cell_seconds = json.at("cell_seconds");
  end.rounds = json.at("rounds");
  for (const Json& told : json.at("told"))
    end.objects.push_back({told.at("name"), told.at("outcome"), told.at("reason")});
  return end;
}

ClearingRecord recordOf(const Json& json) {
  ClearingRecord record;
  record.seed = json.at("seed");
  record.frame = json.value("frame", record.frame);
  for (const Json& pick : json.at("picks")) record.picks.push_back(pickOf(pick));
  record.truth = truthOf(json.at("truth"));
  record.collisions = json.at("collisions");
  record.hits = json.value("hits", record.hits);
  if (json.contains("end")) record.end = endOf(json.at("end"));
  return record;
}

}  // namespace

ClearingRecord parseRecord(const std::string& text, const std::string& source) {
  try {
    return recordOf(Json::parse(text));
  } catch (const Json::exception& e) {
    throw BadInput(source + ": no record of a clearing: " + e.what());
  } catch (const BadInput& e) {
    throw BadInput(source + ": " + e.what());
  }
}

}  // namespace monocular_eye_hand
