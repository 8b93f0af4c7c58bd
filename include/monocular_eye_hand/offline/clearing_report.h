#pragma once
#include <optional>
#include <string>
#include <vector>

#include "monocular_eye_hand/model/known_object.h"
#include "monocular_eye_hand/offline/clearing_record.h"

namespace monocular_eye_hand {

/// How far the hand is off at the grasp because the pose is, modulo the object's symmetries.
struct GraspError {
  std::string label;                  ///< of the true object: the nearest of that name
  double distance = 0;                ///< at gripper_tcp [m]
  double angle = 0;                   ///< [rad]
  Eigen::Vector3d recognised, truth;  ///< origin of the object, base [m]
};

struct PickReport {
  std::string name;
  int instance = 0;
  std::optional<GraspError> error;     ///< none: nothing of that name stood in the cell
  std::optional<ActionResult> result;  ///< none: it did not end
};

/// What became of a part that stood in the cell, by the truth.
struct PartReport {
  std::string label, name;
  bool in_drop_zone = false, held = false;
  int attempts = 0;                ///< picks that were meant for it
  std::optional<PickReport> last;  ///< of them
};

struct ClearingReport {
  int seed = -1;
  bool cleared = false;  ///< every part lies in the drop zone
  int collisions = 0, looks = 0;
  std::vector<std::string> hits;  ///< as in the record
  std::vector<PartReport> parts;
  std::vector<PickReport> picks;
  std::optional<ToldEnd> end;
  std::optional<ClearingTimes> times;

  int carried() const;  ///< parts in the drop zone
  bool good() const { return cleared && collisions == 0; }
};

/// Of several scenes.
struct ClearingSums {
  int cleared = 0, parts = 0, carried = 0, collisions = 0;
};
ClearingSums sumsOf(const std::vector<ClearingReport>& reports);

/// Compares what the task did with the truth. Throws BadInput on a name that is not in `models`.
ClearingReport reportOf(const ClearingRecord& record, const ModelBase& models);

/// One line per part, then what the task said; for people.
std::string reportTable(const ClearingReport& report);
/// docs/json.md tells the keys.
std::string reportJson(const ClearingReport& report);
/// The same of several scenes, with their sums.
std::string reportsJson(const std::vector<ClearingReport>& reports);
/// Reads a record that another program wrote. Throws BadInput on what is none; `source` names it.
ClearingRecord parseRecord(const std::string& json, const std::string& source);

}  // namespace monocular_eye_hand
