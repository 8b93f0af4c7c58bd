#pragma once
#include <vector>

#include "grouping/model_structure.h"

namespace monocular_eye_hand {

/// What each discrete symmetry does to the model's features: index of the copy; -1 when there is none.
struct FeatureMap {
  std::vector<int> point;   ///< EdgeGraph::points
  std::vector<int> edge;    ///< ObjectModel::edges
  std::vector<int> circle;  ///< ObjectModel::circles
};
std::vector<FeatureMap> mapFeatures(const EdgeGraph& graph);

/// Keeps the first of the groupings that symmetries make equal and fills in `orders`, without the orders that
/// a symmetry makes equal to an earlier one.
std::vector<ModelGrouping> moduloSymmetries(const EdgeGraph& graph, const std::vector<FeatureMap>& maps,
                                            const std::vector<ModelGrouping>& groupings);

}  // namespace monocular_eye_hand
