#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "grouping/model_symmetry.h"

namespace monocular_eye_hand {
namespace {

// A straight edge is there as a whole when this share of it is visible.
constexpr double kWholeEdge = 0.7;
// An ellipse can be found from this share of a circle: of a cylinder's lower rim one sees half.
constexpr double kWholeCircle = 0.4;
// Groupings kept per kind: the most telling.
constexpr size_t kMaxKept = 500;

/// Which features each view of the nearest distance shows as a whole, and how much of the view sphere it
/// stands for.
struct Visibility {
  std::vector<std::vector<char>> shows;  ///< [view][feature]
  std::vector<double> share;             ///< [view], sums to 1
};

/// Samples that a feature has when all of it is visible.
std::vector<double> wholeCounts(const ObjectModel& model, const ViewSphere& views) {
  std::vector<double> whole(model.featureCount(), 1.0);
  for (const SampledView& view : views.views) {
    std::vector<double> count(whole.size(), 0.0);
    for (const ContourSample& s : view.contour)
      whole[s.feature] = std::max(whole[s.feature], ++count[s.feature]);
  }
  // A feature that no view shows to its full length still has its length.
  const auto atLeast = [&](int feature, double length) {
    if (views.step > 0) whole[feature] = std::max(whole[feature], std::floor(0.9 * length / views.step));
  };
  for (size_t e = 0; e < model.edges.size(); ++e)
    atLeast(model.featureOfEdge(int(e)), (model.edges[e].q - model.edges[e].p).norm());
  for (size_t c = 0; c < model.circles.size(); ++c)
    atLeast(model.featureOfCircle(int(c)), model.circles[c].length());
  return whole;
}

Visibility visibilityOf(const KnownObject& object) {
  const ObjectModel& model = object.model;
  Visibility v;
  const int directions = std::min(object.views.directions, int(object.views.views.size()));
  if (directions == 0) return v;

  const std::vector<double> whole = wholeCounts(model, object.views);
  double sum = 0;
  for (int k = 0; k < directions; ++k) {
    const SampledView& view = object.views.views[k];
    std::vector<char> shows(model.featureCount(), 0);
    std::vector<int> count(model.featureCount(), 0);
    for (const ContourSample& s : view.contour) ++count[s.feature];
    for (int g = 0; g < model.featureCount(); ++g) {
      const double min_share = g < int(model.edges.size()) ? kWholeEdge : kWholeCircle;
      shows[g] = count[g] > 0 && count[g] >= min_share * whole[g];
    }
    v.shows.push_back(std::move(shows));

    // On the half meridian of an axis a direction stands for a circle of them.
    const auto& axis = model.symmetries.axis;
    v.share.push_back(axis ? view.direction.cross(axis->direction).norm() + 1e-3 : 1.0);
    sum += v.share.back();
  }

  for (double& share : v.share) share /= sum;
  return v;
}

/// Is the grouping's copy under a symmetry visible as a whole?
bool shown(const ObjectModel& model, const std::vector<char>& shows, const ModelGrouping& m,
           const FeatureMap& map) {
  for (int e : m.edges)
    if (map.edge[e] < 0 || !shows[model.featureOfEdge(map.edge[e])]) return false;
  for (int c : m.circles)
    if (map.circle[c] < 0 || !shows[model.featureOfCircle(map.circle[c])]) return false;
  return true;
}

void fillViews(const ObjectModel& model, const Visibility& visibility, const std::vector<FeatureMap>& maps,
               ModelGrouping* m) {
  for (int view = 0; view < int(visibility.shows.size()); ++view) {
    for (int symmetry = 0; symmetry < int(maps.size()); ++symmetry) {
      if (!shown(model, visibility.shows[view], *m, maps[symmetry])) continue;
      m->seen.push_back({view, symmetry});
      m->weight += visibility.share[view] / double(maps.size());
      if (m->views.empty() || m->views.back() != view) m->views.push_back(view);
    }
  }
}

/// Size of the smallest feature [m], which an image must resolve.
double smallestFeature(const ObjectModel& model, const ModelGrouping& m) {
  double smallest = model.diameter;
  for (int e : m.edges) smallest = std::min(smallest, (model.edges[e].q - model.edges[e].p).norm());
  for (int c : m.circles) smallest = std::min(smallest, 2 * model.circles[c].radius);
  return smallest;
}

/// Of each kind those that an image is most likely to show: large ones, in many views.
std::vector<ModelGrouping> mostTelling(const ObjectModel& model, const std::vector<ModelGrouping>& all) {
  std::array<std::vector<std::pair<double, size_t>>, kGroupingKinds> ranked;
  for (size_t i = 0; i < all.size(); ++i)
    ranked[size_t(all[i].kind)].emplace_back(-all[i].weight * smallestFeature(model, all[i]), i);

  std::vector<ModelGrouping> kept;
  for (std::vector<std::pair<double, size_t>>& kind : ranked) {
    std::sort(kind.begin(), kind.end());
    if (kind.size() > kMaxKept) kind.resize(kMaxKept);
    for (const auto& [rank, i] : kind) kept.push_back(all[i]);
  }
  return kept;
}

}  // namespace

std::vector<ModelGrouping> modelGroupings(const KnownObject& object) {
  const EdgeGraph graph(object.model);
  const std::vector<FeatureMap> maps = mapFeatures(graph);
  std::vector<ModelGrouping> all = moduloSymmetries(graph, maps, structuralGroupings(graph));
  const Visibility visibility = visibilityOf(object);
  if (!visibility.shows.empty()) {
    for (ModelGrouping& m : all) fillViews(object.model, visibility, maps, &m);
    all.erase(std::remove_if(all.begin(), all.end(), [](const ModelGrouping& m) { return m.views.empty(); }),
              all.end());
  }
  std::vector<ModelGrouping> kept = mostTelling(object.model, all);
  std::stable_sort(kept.begin(), kept.end(), [](const ModelGrouping& a, const ModelGrouping& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.weight > b.weight;
  });
  return kept;
}

}  // namespace monocular_eye_hand
