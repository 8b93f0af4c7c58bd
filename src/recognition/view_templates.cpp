#include "recognition/view_templates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "recognition/flat_view.h"
#include "recognition/outline_sides.h"

namespace monocular_eye_hand {
namespace {

constexpr double kMinShare = 0.10;    // shortest base edge, as a share of the diameter
constexpr double kMinVisible = 0.8;   // of an edge: else its ends are not those of the segment
constexpr size_t kEnough = 4;         // base edges: a view with as many sharp edges needs no other
constexpr double kLong = 0.25;        // a view without a base edge of this share of the diameter needs others
constexpr double kStraight = 0.0015;  // departure of a straight line from its chord, share of the diameter
constexpr double kNext = 2.5;         // steps between neighbouring samples of one line

std::vector<char> ownSamples(size_t count, int first, int last) {
  std::vector<char> own(count, 0);
  std::fill(own.begin() + first, own.begin() + last, 1);
  return own;
}

void addEdges(const ObjectModel& model, const SampledView& view, const Eigen::Matrix3d& rotation,
              const FlatView& flat, double step, std::vector<BaseEdge>* bases) {
  std::vector<int> visible(model.edges.size(), 0);
  for (int feature : flat.feature)
    if (feature < int(visible.size())) ++visible[size_t(feature)];
  for (size_t e = 0; e < model.edges.size(); ++e) {
    const ModelEdge& edge = model.edges[e];
    if (visible[e] * step < kMinVisible * (edge.q - edge.p).norm()) continue;
    BaseEdge base{flatPoint(edge.p, view, rotation, model.centre()),
                  flatPoint(edge.q, view, rotation, model.centre()), std::vector<char>(flat.feature.size())};
    if (base.length() < kMinShare * model.diameter) continue;
    for (size_t i = 0; i < flat.feature.size(); ++i) base.own[i] = flat.feature[i] == int(e);
    bases->push_back(std::move(base));
  }
}

// Index of the sample between first and last that is farthest from their chord, -1: the line is straight.
int bend(const FlatView& flat, int first, int last, double tolerance) {
  const Eigen::Vector2d& a = flat.place[size_t(first)];
  const Eigen::Vector2d chord = flat.place[size_t(last)] - a;
  const Eigen::Vector2d normal = Eigen::Vector2d(-chord.y(), chord.x()).normalized();
  int farthest = -1;
  double largest = tolerance;
  for (int i = first + 1; i < last; ++i) {
    const double off = std::abs(normal.dot(flat.place[size_t(i)] - a));
    if (off <= largest) continue;
    largest = off;
    farthest = i;
  }
  return farthest;
}

// Straight pieces of the samples first ... last of one line.
void addStraight(const FlatView& flat, int first, int last, double diameter, std::vector<BaseEdge>* bases) {
  const Eigen::Vector2d &p = flat.place[size_t(first)], &q = flat.place[size_t(last)];
  if (last - first < 3) return;
  const int bent = bend(flat, first, last, kStraight * diameter);
  if (bent >= 0) {
    addStraight(flat, first, bent, diameter, bases);
    addStraight(flat, bent, last, diameter, bases);
    return;
  }

  if ((q - p).norm() < kMinShare * diameter) return;
  // Half a step lies before the first sample, and half of one behind the last.
  const Eigen::Vector2d half = 0.5 * (q - p) / double(last - first);
  bases->push_back({p - half, q + half, ownSamples(flat.place.size(), first, last + 1)});
}

// Of the lines that are no straight edges.
void addStraightPieces(const ObjectModel& model, const SampledView& view, const FlatView& flat, double step,
                       std::vector<BaseEdge>* bases) {
  const int count = int(flat.place.size());
  const auto goesOn = [&](int i) {
    return flat.feature[size_t(i)] == flat.feature[size_t(i) - 1] &&
           (view.contour[size_t(i)].p - view.contour[size_t(i) - 1].p).norm() < kNext * step;
  };
  for (int first = 0; first < count;) {
    int next = first + 1;
    while (next < count && goesOn(next)) ++next;
    if (flat.feature[size_t(first)] >= int(model.edges.size()))
      addStraight(flat, first, next - 1, model.diameter, bases);
    first = next;
  }
}

bool anyLongerThan(double length, const std::vector<BaseEdge>& bases) {
  return std::any_of(bases.begin(), bases.end(), [&](const BaseEdge& r) { return r.length() > length; });
}

// The template of a base edge: samples of other lines first, farthest from the edge first. None of a view
// without samples.
std::optional<ViewTemplate> makeTemplate(const FlatView& flat, const BaseEdge& base, int view,
                                         double diameter) {
  const Eigen::Vector2d &a = base.a, ab = base.b - base.a;
  std::vector<double> weight(flat.place.size());
  for (size_t i = 0; i < weight.size(); ++i) {
    const double along = std::clamp((flat.place[i] - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    weight[i] = base.own[i] ? 1e-6 : (flat.place[i] - a - along * ab).norm() + 1e-3 * diameter;
  }
  std::vector<int> order = spreadOrder(flat.place, weight, ViewTemplate::kSamples);
  if (order.empty()) return std::nullopt;
  const size_t distinct = order.size();
  while (order.size() < size_t(ViewTemplate::kSamples)) order.push_back(order[order.size() % distinct]);

  ViewTemplate result;
  result.a = a.cast<float>();
  result.b = base.b.cast<float>();
  result.length = float(ab.norm());
  result.contour = float(flat.length);
  result.view = view;
  result.centre_x = float(-a.dot(ab) / ab.squaredNorm());
  result.centre_y = float((ab.y() * a.x() - ab.x() * a.y()) / ab.squaredNorm());
  for (size_t i = 0; i < size_t(ViewTemplate::kSamples); ++i) {
    const Eigen::Vector2d r = flat.place[size_t(order[i])] - a, d = flat.direction[size_t(order[i])];
    result.x[i] = float(r.dot(ab) / ab.squaredNorm());
    result.y[i] = float((ab.x() * r.y() - ab.y() * r.x()) / ab.squaredNorm());
    const double angle = std::atan2(ab.x() * d.y() - ab.y() * d.x(), ab.dot(d));
    result.angle[i] = uint8_t(int(std::lround(angle / M_PI * 256.0)) & 255);
  }
  return result;
}

}  // namespace

std::vector<TemplateLevel> templateLevels(const KnownObject& object,
                                          const std::vector<Eigen::Matrix3d>& view_rotations) {
  const ViewSphere& sphere = object.views;
  const ObjectModel& model = object.model;
  std::vector<TemplateLevel> levels;
  for (size_t l = 0; l < sphere.distances.size(); ++l) {
    TemplateLevel level;
    const double ratio = sphere.distances[l] / model.diameter;
    // Levels meet half way in 1 / ratio, which is what perspective depends on.
    level.min_ratio = l == 0 ? 0.8 * ratio : levels.back().max_ratio;
    level.max_ratio =
        l + 1 == sphere.distances.size() ? 1e9 : 2 / (1 / ratio + model.diameter / sphere.distances[l + 1]);

    for (int k = 0; k < sphere.directions; ++k) {
      const int index = int(l) * sphere.directions + k;
      const SampledView& view = sphere.views[size_t(index)];
      const Eigen::Matrix3d& rotation = view_rotations[size_t(index)];
      const double step = sampleStepOf(view);
      const FlatView flat = flatten(view, rotation, model.centre(), step);

      std::vector<BaseEdge> bases;
      addEdges(model, view, rotation, flat, step, &bases);
      if (bases.size() < kEnough) addStraightPieces(model, view, flat, step, &bases);
      if (!anyLongerThan(kLong * model.diameter, bases)) {
        std::vector<BaseEdge> sides = outlineSides(flat, model.diameter);
        std::move(sides.begin(), sides.end(), std::back_inserter(bases));
      }
      for (const BaseEdge& base : bases)
        if (const auto made = makeTemplate(flat, base, index, model.diameter))
          level.templates.push_back(*made);
    }

    std::stable_sort(level.templates.begin(), level.templates.end(),
                     [](const ViewTemplate& p, const ViewTemplate& q) { return p.length < q.length; });
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace monocular_eye_hand
