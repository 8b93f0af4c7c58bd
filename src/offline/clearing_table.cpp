#include <fmt/format.h>

#include <array>

#include "monocular_eye_hand/offline/clearing_report.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDegreesPerRadian = 180 / M_PI;

std::string row(const std::array<std::string, 6>& cells) {
  return fmt::format("{:<12} {:<26} {:<26} {:<18} {:<18} {}\n", cells[0], cells[1], cells[2], cells[3],
                     cells[4], cells[5]);
}

std::string millimetres(const Eigen::Vector3d& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z());
}

std::string outcomeOf(const PartReport& part) {
  if (part.in_drop_zone) return "carried out";
  if (part.held) return "in the hand";
  if (!part.last) return "left: never picked";
  return "left: " + (part.last->result ? part.last->result->reason : std::string("the pick did not end"));
}

std::string partRow(const PartReport& part) {
  std::array<std::string, 6> cells{part.label, "-", "-", "-", "-", outcomeOf(part)};
  if (part.last && part.last->error) {
    const GraspError& error = *part.last->error;
    cells[1] = millimetres(error.recognised);
    cells[2] = millimetres(error.truth);
    cells[3] = fmt::format("{:.2f} mm, {:.2f} deg", 1e3 * error.distance, kDegreesPerRadian * error.angle);
  }
  if (part.last && part.last->result)
    cells[4] = fmt::format("{:.0f} ms / {:.1f} s", 1e3 * part.last->result->planning_time,
                           part.last->result->motion_time);
  return row(cells);
}

std::string several(int count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string reportTable(const ClearingReport& report) {
  std::string table =
      row({"object", "recognised (mm, base)", "truth", "grasp error", "plan / motion", "outcome"});
  for (const PartReport& part : report.parts) table += partRow(part);

  for (const std::string& hit : report.hits) table += "\n" + hit;
  if (!report.hits.empty()) table += "\n";

  const std::string collisions = several(report.collisions, "collision");
  if (!report.end) return table + "\nno result; " + collisions + "\n";
  return table + "\n" + report.end->reason + "; " + collisions + "; " +
         fmt::format("{:.1f} s of cell time, ", report.end->cell_seconds) +
         several(report.end->rounds, "round") + "\n";
}

}  // namespace monocular_eye_hand
