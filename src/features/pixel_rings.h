#pragma once
#include "features/edge_detection.h"

namespace monocular_eye_hand {

inline int lowestBit(uint32_t v) {  // de Bruijn multiplication
  static constexpr int8_t kPlace[32] = {0,  1,  28, 2,  29, 14, 24, 3, 30, 22, 20, 15, 25, 17, 4,  8,
                                        31, 27, 13, 23, 21, 19, 16, 7, 26, 12, 18, 6,  11, 5,  10, 9};
  return kPlace[((v & (~v + 1)) * 0x077CB531u) >> 27];
}

/// The edge points on the rings of pixels one and two away from an edge point.
class PixelRings {
 public:
  // Edge points keep two pixels from the border: the window lies in the image.
  PixelRings(const EdgeMap& edges, int i) : edges_(edges), x_(edges.x[i] - 2), y_(edges.y[i] - 2) {
    for (int k = 0; k < 5; ++k) bits_ |= edges.pixels.run(x_, y_ + k, 5) << (5 * k);
  }
  /// Calls use(point) for those on a ring, in raster order.
  template <class Use>
  void onRing(int reach, const Use& use) const {
    // Five bits per row, the top row lowest.
    constexpr uint32_t kInner = (14u << 5) | (10u << 10) | (14u << 15);
    constexpr uint32_t kOuter = 31u | (17u << 5) | (17u << 10) | (17u << 15) | (31u << 20);
    for (uint32_t left = bits_ & (reach == 1 ? kInner : kOuter); left; left &= left - 1) {
      const int at = lowestBit(left), row = at / 5;
      use(edges_.pixels.point(x_ + at - 5 * row, y_ + row));
    }
  }

 private:
  const EdgeMap& edges_;
  const int x_, y_;
  uint32_t bits_ = 0;
};

}  // namespace monocular_eye_hand
