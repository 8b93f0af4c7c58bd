#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace monocular_eye_hand::fuzz {

/// Random numbers that are the same on every machine (splitmix64, Steele, Lea, Flood 2014).
class Dice {
 public:
  explicit Dice(uint64_t seed) : state_(seed) {}
  uint64_t next();
  size_t below(size_t n) { return n == 0 ? 0 : size_t(next() % n); }
  bool oneIn(size_t n) { return below(n) == 0; }
  template <class T>
  const T& of(const std::vector<T>& list) {
    return list[below(list.size())];
  }

 private:
  uint64_t state_;
};

/// The file with one to five kinds of damage; `others` are files of any kind that pieces are taken from.
std::string damaged(std::string file, const std::vector<std::string>& others, Dice* dice);

}  // namespace monocular_eye_hand::fuzz
