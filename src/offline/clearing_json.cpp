#include <nlohmann/json.hpp>

#include "monocular_eye_hand/offline/clearing_report.h"

namespace monocular_eye_hand {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kDegrees = 180 / M_PI;

OrderedJson list(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

void addPick(const PickReport& pick, OrderedJson* json) {
  if (pick.error) {
    (*json)["grasp_error_mm"] = 1e3 * pick.error->distance;
    (*json)["grasp_error_deg"] = kDegrees * pick.error->angle;
    (*json)["pose_m"] = list(pick.error->recognised);
    (*json)["truth_m"] = list(pick.error->truth);
  }
  if (!pick.result) return;
  (*json)["planning_s"] = pick.result->planning_time;
  (*json)["motion_s"] = pick.result->motion_time;
  (*json)["outcome"] = int(pick.result->outcome);  // the constants of Pick.action
  (*json)["reason"] = pick.result->reason;
}

OrderedJson pickJson(const PickReport& pick) {
  OrderedJson json{{"name", pick.name}, {"instance", pick.instance}};
  if (pick.error) json["label"] = pick.error->label;
  addPick(pick, &json);
  return json;
}

OrderedJson partJson(const PartReport& part) {
  OrderedJson json{{"label", part.label},
                   {"name", part.name},
                   {"in_drop_zone", part.in_drop_zone},
                   {"held", part.held},
                   {"attempts", part.attempts}};
  if (!part.last) return json;
  json["instance"] = part.last->instance;
  addPick(*part.last, &json);
  return json;
}

OrderedJson timesJson(const ClearingTimes& times) {
  return {{"rendering", times.rendering}, {"recognition", times.recognition}, {"grasps", times.grasps},
          {"planning", times.planning},   {"motion", times.motion},           {"all", times.all}};
}

OrderedJson reportTree(const ClearingReport& report) {
  OrderedJson json{{"seed", report.seed}, {"cleared", report.cleared}, {"collisions", report.collisions}};
  if (!report.hits.empty()) json["hits"] = report.hits;
  json["objects"] = OrderedJson::array();
  for (const PartReport& part : report.parts) json["objects"].push_back(partJson(part));
  json["picks"] = OrderedJson::array();
  for (const PickReport& pick : report.picks) json["picks"].push_back(pickJson(pick));

  const ToldEnd end = report.end.value_or(ToldEnd());
  json["reason"] = end.reason;
  json["cell_seconds"] = report.end ? OrderedJson(end.cell_seconds) : OrderedJson();
  json["rounds"] = end.rounds;
  json["told"] = OrderedJson::array();
  for (const ToldObject& told : end.objects)
    json["told"].push_back({{"name", told.name}, {"outcome", told.outcome}, {"reason", told.reason}});
  if (report.looks > 0) json["looks"] = report.looks;
  if (report.times) json["wall_s"] = timesJson(*report.times);
  return json;
}

// Names come from files: bytes that are not UTF-8 are replaced, not refused.
std::string textOf(const OrderedJson& json) {
  return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace

std::string reportJson(const ClearingReport& report) { return textOf(reportTree(report)); }

std::string reportsJson(const std::vector<ClearingReport>& reports) {
  const ClearingSums sums = sumsOf(reports);
  OrderedJson scenes = OrderedJson::array();
  for (const ClearingReport& report : reports) scenes.push_back(reportTree(report));

  return textOf({{"format", "monocular_eye_hand clearing 1"},
                 {"cleared", sums.cleared},
                 {"parts", sums.parts},
                 {"carried", sums.carried},
                 {"collisions", sums.collisions},
                 {"scenes", scenes}});
}

}  // namespace monocular_eye_hand
