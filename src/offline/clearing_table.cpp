#include <array>
#include <cstdarg>
#include <cstdio>

#include "monocular_eye_hand/offline/clearing_report.h"

namespace monocular_eye_hand {
namespace {

constexpr double kDegreesPerRadian = 180 / M_PI;

std::string format(const char* form, ...) {
  std::array<char, 512> text{};
  va_list values;
  va_start(values, form);
  std::vsnprintf(text.data(), text.size(), form, values);
  va_end(values);
  return text.data();
}

std::string row(const std::array<std::string, 6>& cells) {
  return format("%-12s %-26s %-26s %-18s %-18s ", cells[0].c_str(), cells[1].c_str(), cells[2].c_str(),
                cells[3].c_str(), cells[4].c_str()) +
         cells[5] + "\n";
}

std::string millimetres(const Eigen::Vector3d& p) {
  return format("(%.1f, %.1f, %.1f)", 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z());
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
    cells[3] = format("%.2f mm, %.2f deg", 1e3 * error.distance, kDegreesPerRadian * error.angle);
  }
  if (part.last && part.last->result)
    cells[4] =
        format("%.0f ms / %.1f s", 1e3 * part.last->result->planning_time, part.last->result->motion_time);
  return row(cells);
}

std::string several(int count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

std::string reportTable(const ClearingReport& report) {
  std::string table =
      row({"object", "recognised (mm, base)", "truth", "grasp error", "plan / motion", "outcome"});
  for (const PartReport& part : report.parts) table += partRow(part);

  const std::string collisions = several(report.collisions, "collision");
  if (!report.end) return table + "\nno result; " + collisions + "\n";
  return table + "\n" + report.end->reason + "; " + collisions + "; " +
         format("%.1f s of cell time, ", report.end->cell_seconds) + several(report.end->rounds, "round") +
         "\n";
}

}  // namespace monocular_eye_hand
