#include "model/similar_models.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr double kAlike = 0.02;  // of the diameter: sizes that one grey image hardly tells apart

/// Sizes of the features as shares of the diameter, each kind ascending.
struct Signature {
  std::vector<double> edges, circles, extent;
};

Signature signatureOf(const ObjectModel& model) {
  Signature s;
  for (const ModelEdge& e : model.edges) s.edges.push_back((e.q - e.p).norm() / model.diameter);
  for (const ModelCircle& c : model.circles) s.circles.push_back(c.length() / model.diameter);
  const Eigen::Vector3d size = model.bounds.sizes() / model.diameter;
  s.extent = {size.x(), size.y(), size.z()};
  for (auto* list : {&s.edges, &s.circles, &s.extent}) std::sort(list->begin(), list->end());
  return s;
}

bool alike(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (size_t k = 0; k < a.size(); ++k) {
    if (std::abs(a[k] - b[k]) > kAlike) return false;
  }
  return true;
}

/// With features, these decide: the box depends on how the part lies in its frame. Without, the box must do.
bool alike(const Signature& a, const Signature& b) {
  if (!alike(a.edges, b.edges) || !alike(a.circles, b.circles)) return false;
  return !a.edges.empty() || !a.circles.empty() || alike(a.extent, b.extent);
}

}  // namespace

void warnAboutSimilarModels(ModelBase* base) {
  std::vector<Signature> signatures;
  for (const KnownObject& o : base->objects) signatures.push_back(signatureOf(o.model));
  for (size_t i = 0; i < signatures.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (!alike(signatures[i], signatures[j])) continue;
      ObjectModel &a = base->objects[i].model, &b = base->objects[j].model;
      const bool same_size = std::abs(a.diameter / b.diameter - 1) < kAlike;
      const std::string end = same_size ? ": one is easily taken for the other"
                                        : " in another size: one camera tells them apart by distance only";
      a.warnings.push_back("looks like " + b.name + end);
      b.warnings.push_back("looks like " + a.name + end);
    }
  }
}

}  // namespace monocular_eye_hand
