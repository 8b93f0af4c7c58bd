#include "monocular_eye_hand/model/characteristic_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/model/contour.h"

namespace monocular_eye_hand {
namespace {

constexpr double kNeighbour = 1.6;  // directions nearer than this many spacings are neighbours
constexpr double kMinShare = 0.05;  // a feature is in a view when this share of it is visible

double stepFor(const ObjectModel& model, const std::vector<Eigen::Vector3d>& directions,
               const ViewOptions& options) {
  std::vector<double> ratios = options.distance_ratios;
  std::sort(ratios.begin(), ratios.end());
  const double distance = ratios[ratios.size() / 2] * model.diameter;
  ContourOptions coarse;
  coarse.step = model.diameter / 60;
  const size_t stride = std::max<size_t>(1, directions.size() / 24);
  double length = 0;
  int views = 0;
  for (size_t k = 0; k < directions.size(); k += stride, ++views) {
    length += coarse.step * visibleContour(model, model.centre() + distance * directions[k], coarse).size();
  }
  length = std::max(length / views, model.diameter / 10);
  return length / options.samples_per_view;
}

/// Visible contour length of every feature in every view [m].
using Lengths = std::vector<std::vector<double>>;

Lengths visibleLengths(const ViewSphere& sphere, int features) {
  Lengths lengths;
  for (const SampledView& view : sphere.views) {
    lengths.emplace_back(features, 0.0);
    for (const ContourSample& s : view.contour) lengths.back()[s.feature] += sphere.step;
  }
  return lengths;
}

/// Full length of each feature; a silhouette's is the longest that any view shows.
std::vector<double> fullLengths(const ObjectModel& model, const Lengths& visible, double step) {
  std::vector<double> full(model.featureCount(), 0.0);
  for (size_t e = 0; e < model.edges.size(); ++e) full[e] = (model.edges[e].q - model.edges[e].p).norm();
  for (size_t c = 0; c < model.circles.size(); ++c)
    full[model.featureOfCircle(int(c))] = model.circles[c].length();
  for (size_t s = 0; s < model.surfaces.size(); ++s) {
    double& longest = full[model.featureOfSilhouette(int(s))];
    for (const auto& lengths : visible)
      longest = std::max(longest, lengths[model.featureOfSilhouette(int(s))]);
  }
  for (double& f : full) f = std::max(f, step);
  return full;
}

int rootOf(std::vector<int>* parent, int k) {
  while ((*parent)[k] != k) k = (*parent)[k] = (*parent)[(*parent)[k]];
  return k;
}

/// Joins neighbouring views with equal sets of visible features; returns each view's class, numbered by first
/// view.
std::vector<int> mergeViews(const ViewSphere& sphere, const std::vector<std::vector<int>>& features,
                            double spacing) {
  std::vector<int> parent(sphere.views.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto join = [&](int a, int b) {
    if (features[a] != features[b]) return;
    a = rootOf(&parent, a);
    b = rootOf(&parent, b);
    parent[std::max(a, b)] = std::min(a, b);
  };

  const int n = sphere.directions;
  const double near = std::cos(std::min(kNeighbour * spacing, 1.5));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      if (sphere.views[i].direction.dot(sphere.views[j].direction) < near) continue;
      for (size_t d = 0; d < sphere.distances.size(); ++d) join(int(d) * n + i, int(d) * n + j);
    }
    for (size_t d = 1; d < sphere.distances.size(); ++d) join(int(d - 1) * n + i, int(d) * n + i);
  }

  std::vector<int> of_view(sphere.views.size());
  std::map<int, int> number;
  for (size_t k = 0; k < of_view.size(); ++k) {
    of_view[k] = number.emplace(rootOf(&parent, int(k)), int(number.size())).first->second;
  }
  return of_view;
}

void weigh(const Lengths& lengths, const std::vector<double>& full,
           const std::vector<int>& views_with_feature, CharacteristicView* view) {
  const double all_views = double(lengths.size());
  double total = 0;
  std::vector<double> mean(full.size(), 0.0);
  for (const int v : view->views) {
    for (size_t g = 0; g < full.size(); ++g) mean[g] += lengths[v][g] / double(view->views.size());
  }
  for (const int g : view->features) total += mean[g];
  double sum = 0;
  for (const int g : view->features) {
    view->visible.push_back(std::min(1.0, mean[g] / full[g]));
    view->weight.push_back(std::sqrt(mean[g] / total) * (1 + std::log(all_views / views_with_feature[g])));
    sum += view->weight.back();
  }
  for (double& w : view->weight) w /= sum;
}

}  // namespace

void ViewOptions::check() const {
  if (!(spacing >= 0.05 && spacing <= 1.0)) {
    throw BadInput(fmt::format("ViewOptions.spacing is {:g}; it must be 0.05 to 1 rad", spacing));
  }
  if (distance_ratios.empty())
    throw BadInput("ViewOptions.distance_ratios is empty; it needs at least one ratio");
  for (const double r : distance_ratios) {
    if (!(r > 0.6 && r < 1000)) {
      throw BadInput(
          fmt::format("ViewOptions.distance_ratios holds {:g}; each must be above 0.6 (the eye outside the "
                      "object) and below 1000",
                      r));
    }
  }
  if (samples_per_view < 8 || samples_per_view > 100000) {
    throw BadInput(
        fmt::format("ViewOptions.samples_per_view is {}; it must be 8 to 100000", samples_per_view));
  }
}

ViewSphere sampleViews(const ObjectModel& model, const ViewOptions& options) {
  options.check();
  ViewSphere sphere;
  const std::vector<Eigen::Vector3d> directions = viewDirections(model.symmetries, options.spacing);
  sphere.directions = int(directions.size());
  for (const double ratio : options.distance_ratios) sphere.distances.push_back(ratio * model.diameter);
  std::sort(sphere.distances.begin(), sphere.distances.end());
  sphere.step = stepFor(model, directions, options);

  ContourOptions contour;
  contour.step = sphere.step;
  for (const double distance : sphere.distances) {
    for (const Eigen::Vector3d& d : directions) {
      SampledView view;
      view.direction = d;
      view.distance = distance;
      view.contour = visibleContour(model, model.centre() + distance * d, contour);
      sphere.views.push_back(std::move(view));
    }
  }

  const Lengths lengths = visibleLengths(sphere, model.featureCount());
  const std::vector<double> full = fullLengths(model, lengths, sphere.step);
  std::vector<std::vector<int>> features(sphere.views.size());
  std::vector<int> views_with_feature(model.featureCount(), 0);
  for (size_t v = 0; v < sphere.views.size(); ++v) {
    for (int g = 0; g < model.featureCount(); ++g) {
      if (lengths[v][g] < kMinShare * full[g] || lengths[v][g] <= 0) continue;
      features[v].push_back(g);
      ++views_with_feature[g];
    }
  }

  const std::vector<int> class_of_view = mergeViews(sphere, features, options.spacing);
  for (size_t v = 0; v < sphere.views.size(); ++v) {
    sphere.views[v].characteristic_view = class_of_view[v];
    if (class_of_view[v] == int(sphere.characteristic.size())) {
      sphere.characteristic.emplace_back();
      sphere.characteristic.back().features = features[v];
    }
    sphere.characteristic[class_of_view[v]].views.push_back(int(v));
  }
  for (CharacteristicView& view : sphere.characteristic) weigh(lengths, full, views_with_feature, &view);
  return sphere;
}

}  // namespace monocular_eye_hand
