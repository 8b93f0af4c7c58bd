#pragma once
#include <algorithm>
#include <thread>
#include <vector>

namespace monocular_eye_hand {

/// Calls work(first, last) for bands of rows, each row once, on so many threads. Bands are small and dealt
/// out in turn, so that a difficult region does not keep one thread busy alone.
template <class Work>
void parallelRows(int threads, int rows, const Work& work) {
  constexpr int kBand = 8;
  const auto share = [&](int thread) {
    for (int first = thread * kBand; first < rows; first += threads * kBand)
      work(first, std::min(rows, first + kBand));
  };
  std::vector<std::thread> others;
  for (int k = 1; k < threads; ++k) others.emplace_back(share, k);
  share(0);
  for (std::thread& thread : others) thread.join();
}

}  // namespace monocular_eye_hand
