#pragma once
#include <limits>
#include <vector>

#include "monocular_eye_hand/grouping/grouping.h"
#include "recognition/search_image.h"

namespace monocular_eye_hand {

/// An image grouping laid over a model grouping of its kind in one of the orders that the kind admits.
struct GroupingPair {
  const Grouping& seen;
  const ModelGrouping& known;
  const Correspondence& order;
};

/// Whether a pose can be had from the image grouping at all: enough of its points are no cut-off ends.
bool fixesPose(const Grouping& seen);

/// Distances of an object's centre at which it is looked for [m].
struct DistanceRange {
  double nearest = 0;
  double farthest = std::numeric_limits<double>::max();
};

/// Appends the poses `camera_from_object` of a pair (Wong et al., 2.3): points by the perspective
/// tetrahedron, a triplet whose ends are cut off by its three lines and one whole edge, circles by their
/// ellipse with the rotation about their axis from a line, or stepped through where nothing else tells it.
/// Further points, lines and ellipses of the grouping choose among the roots. `range`: poses that are surely
/// out of it may be left out.
void posesOfPair(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                 const GroupingPair& pair, std::vector<Rigid3>* poses);

// The kinds, for posesOfPair().
void posesOfPoints(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                   const GroupingPair& pair, std::vector<Rigid3>* poses);
void posesOfCorner(const SearchImage& image, const GroupingPair& pair, std::vector<Rigid3>* poses);
void posesOfEllipse(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                    const GroupingPair& pair, std::vector<Rigid3>* poses);
void posesOfEllipsePair(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                        const GroupingPair& pair, std::vector<Rigid3>* poses);
void posesOfEllipseLine(const SearchImage& image, const ObjectModel& model, const DistanceRange& range,
                        const GroupingPair& pair, std::vector<Rigid3>* poses);

}  // namespace monocular_eye_hand
