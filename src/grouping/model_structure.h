#pragma once
#include <array>
#include <vector>

#include "monocular_eye_hand/grouping/grouping.h"

namespace monocular_eye_hand {

/// Which straight edges meet where. Ends are numbered 2 * edge (p) and 2 * edge + 1 (q).
struct EdgeGraph {
  explicit EdgeGraph(const ObjectModel& model);

  const ObjectModel& model;
  std::vector<Eigen::Vector3d> points;
  std::vector<int> point_of_end;
  std::vector<std::vector<int>> ends_at;  ///< per point, ascending

  Eigen::Vector3d at(int end) const { return end % 2 ? model.edges[end / 2].q : model.edges[end / 2].p; }
  /// Unit, along the edge, away from this end.
  Eigen::Vector3d away(int end) const { return (at(end ^ 1) - at(end)).normalized(); }
  /// Do two edges meet at an angle that an image can show?
  bool bends(int end_a, int end_b) const;
};

/// All groupings of the model by its structure alone (visibility and symmetries not looked at): kind, shape,
/// edges, circles, points, oriented.
std::vector<ModelGrouping> structuralGroupings(const EdgeGraph& graph);

/// The kinds and shapes that the structure offers; for candidates. Much cheaper than structuralGroupings().
struct Abilities {
  std::array<bool, kGroupingKinds> kind{};
  bool u_chain = false, z_chain = false;  ///< can some chain be seen as a U, as a Z?
};
Abilities abilitiesOf(const ObjectModel& model);

/// All orders that a kind admits (a turning sense that every image preserves leaves the mirrored ones out).
std::vector<Correspondence> ordersOf(GroupingKind kind, bool oriented);

}  // namespace monocular_eye_hand
