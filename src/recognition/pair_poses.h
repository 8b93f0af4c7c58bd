#pragma once
#include <vector>

#include "recognition/hypotheses.h"

namespace monocular_eye_hand {

/// An image grouping laid over a model grouping of its kind in one of the orders that the kind admits.
struct GroupingPair {
  const Grouping& seen;
  const ModelGrouping& known;
  const Correspondence& order;
};

/// Whether a pose can be had from the image grouping at all: enough of its points are no cut-off ends.
bool fixesPose(const Grouping& seen);

/// Appends the poses `camera_from_object` of a pair (seed 2.3): points by the perspective tetrahedron, a
/// triplet whose ends are cut off by its three lines and one whole edge, circles by their ellipse with the
/// rotation about their axis from a line, or stepped through where nothing else tells it. Further points,
/// lines and ellipses of the grouping choose among the roots.
void posesOfPair(const SearchContext& context, const ObjectModel& model, const GroupingPair& pair,
                 std::vector<Rigid3>* poses);

// The kinds, for posesOfPair().
void posesOfPoints(const SearchContext& context, const GroupingPair& pair, std::vector<Rigid3>* poses);
void posesOfCorner(const SearchContext& context, const GroupingPair& pair, std::vector<Rigid3>* poses);
void posesOfEllipse(const SearchContext& context, const ObjectModel& model, const GroupingPair& pair,
                    std::vector<Rigid3>* poses);
void posesOfEllipsePair(const SearchContext& context, const ObjectModel& model, const GroupingPair& pair,
                        std::vector<Rigid3>* poses);
void posesOfEllipseLine(const SearchContext& context, const ObjectModel& model, const GroupingPair& pair,
                        std::vector<Rigid3>* poses);

}  // namespace monocular_eye_hand
