#include "grouping/model_structure.h"

namespace monocular_eye_hand {
namespace {

std::vector<Correspondence> tripletOrders(bool oriented) {
  std::vector<Correspondence> result;
  for (int mirrored = 0; mirrored < (oriented ? 1 : 2); ++mirrored)
    for (int shift = 0; shift < 3; ++shift) {
      Correspondence c;
      c.points[0] = 0;
      for (int i = 0; i < 3; ++i) {
        c.segments[i] = (mirrored ? shift + 3 - i : shift + i) % 3;
        c.points[i + 1] = 1 + c.segments[i];
      }
      result.push_back(c);
    }
  return result;
}

std::vector<Correspondence> quadOrders(bool oriented) {
  std::vector<Correspondence> result;
  for (int mirrored = 0; mirrored < (oriented ? 1 : 2); ++mirrored)
    for (int shift = 0; shift < 4; ++shift) {
      Correspondence c;
      for (int i = 0; i < 4; ++i) {
        c.points[i] = (mirrored ? shift + 4 - i : shift + i) % 4;
        // Side i joins points i and i + 1; mirrored, those are the model's shift - i and shift - i - 1.
        c.segments[i] = (mirrored ? shift + 3 - i : shift + i) % 4;
      }
      result.push_back(c);
    }
  return result;
}

}  // namespace

std::vector<Correspondence> ordersOf(GroupingKind kind, bool oriented) {
  switch (kind) {
    case GroupingKind::kEdge:
      return {{{0, 1, -1, -1}, {0, -1, -1, -1}, {-1, -1}}, {{1, 0, -1, -1}, {0, -1, -1, -1}, {-1, -1}}};
    case GroupingKind::kJunction:
      return {{{0, 1, 2, -1}, {0, 1, -1, -1}, {-1, -1}}, {{2, 1, 0, -1}, {1, 0, -1, -1}, {-1, -1}}};
    case GroupingKind::kTriplet:
      return tripletOrders(oriented);
    case GroupingKind::kChain:
      return {{{0, 1, 2, 3}, {0, 1, 2, -1}, {-1, -1}}, {{3, 2, 1, 0}, {2, 1, 0, -1}, {-1, -1}}};
    case GroupingKind::kQuad:
      return quadOrders(oriented);
    case GroupingKind::kParallelPair:
      return {{{0, 1, 2, 3}, {0, 1, -1, -1}, {-1, -1}},
              {{1, 0, 3, 2}, {0, 1, -1, -1}, {-1, -1}},
              {{2, 3, 0, 1}, {1, 0, -1, -1}, {-1, -1}},
              {{3, 2, 1, 0}, {1, 0, -1, -1}, {-1, -1}}};
    case GroupingKind::kEllipse:
      return {{{-1, -1, -1, -1}, {-1, -1, -1, -1}, {0, -1}}};
    case GroupingKind::kEllipsePair:
      return {{{-1, -1, -1, -1}, {-1, -1, -1, -1}, {0, 1}}, {{-1, -1, -1, -1}, {-1, -1, -1, -1}, {1, 0}}};
    case GroupingKind::kEllipseLine:
      return {{{0, 1, -1, -1}, {0, -1, -1, -1}, {0, -1}}, {{1, 0, -1, -1}, {0, -1, -1, -1}, {0, -1}}};
  }
  return {};
}

const std::vector<Correspondence>& correspondences(const Grouping& image, const ModelGrouping& model) {
  static const std::vector<Correspondence> none;
  if (image.kind != model.kind) return none;
  if (image.kind == GroupingKind::kChain && model.shape != GroupingShape::kNone && image.shape != model.shape)
    return none;
  return model.orders;
}

}  // namespace monocular_eye_hand
