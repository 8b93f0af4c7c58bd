#pragma once
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace monocular_eye_hand {

/// The best of every place of an image, so that a strong place cannot crowd out the others. T has a
/// `bool betterThan(const T&) const` that orders all that differ: what is kept does not depend on the order
/// in which it comes.
template <class T>
class BestOfPlaces {
 public:
  /// `width`, `height`: of the image [px]; `most`: kept of each place.
  BestOfPlaces(int width, int height, int max_count)
      : cells_x_(int(std::ceil(width / kCell)) + 2),
        cells_y_(int(std::ceil(height / kCell)) + 2),
        max_count_(size_t(max_count)),
        cells_(size_t(cells_x_) * size_t(cells_y_)) {}

  /// Whether something at a pixel would find its place: in the image or just beside it.
  bool hasPlace(double u, double v) const { return placeOf(u, v) >= 0; }
  /// What is better than the worst that is kept at its pixel, which must have a place.
  void offer(double u, double v, const T& item) { put(&cells_[size_t(placeOf(u, v))], item); }
  /// Takes up what another one of the same size has kept.
  void add(BestOfPlaces&& other) {
    for (size_t c = 0; c < cells_.size(); ++c)
      for (const T& item : other.cells_[c]) put(&cells_[c], item);
  }

  /// All that is kept, place by place.
  std::vector<T> all() const {
    std::vector<T> all;
    for (const std::vector<T>& cell : cells_) all.insert(all.end(), cell.begin(), cell.end());
    return all;
  }
  template <class Condition>
  void removeIf(const Condition& condition) {
    for (std::vector<T>& cell : cells_) {
      cell.erase(std::remove_if(cell.begin(), cell.end(), condition), cell.end());
      std::make_heap(cell.begin(), cell.end(), better);
    }
  }

 private:
  static constexpr double kCell = 32;  // side of a place [px]

  static bool better(const T& a, const T& b) { return a.betterThan(b); }

  int placeOf(double u, double v) const {
    const int x = int(std::floor(u / kCell)) + 1;
    const int y = int(std::floor(v / kCell)) + 1;
    return x < 0 || y < 0 || x >= cells_x_ || y >= cells_y_ ? -1 : y * cells_x_ + x;
  }

  // A heap with the worst in front.
  void put(std::vector<T>* cell, const T& item) {
    if (cell->size() == max_count_) {
      if (!item.betterThan(cell->front())) return;
      std::pop_heap(cell->begin(), cell->end(), better);
      cell->pop_back();
    }
    cell->push_back(item);
    std::push_heap(cell->begin(), cell->end(), better);
  }

  int cells_x_, cells_y_;
  size_t max_count_;
  std::vector<std::vector<T>> cells_;
};

}  // namespace monocular_eye_hand
