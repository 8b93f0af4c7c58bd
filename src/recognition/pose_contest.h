#pragma once
#include <map>
#include <utility>

#include "monocular_eye_hand/model/object_model.h"
#include "monocular_eye_hand/recognition/contest.h"
#include "recognition/candidate.h"
#include "recognition/search_image.h"
#include "recognition/shading.h"

namespace monocular_eye_hand {

/// A pose's faces under the light that explains their greys best.
struct LitFaces {
  int step = 2;                                         ///< of the lattice that is looked at [px]
  std::map<std::pair<int, int>, ShadedPixel> by_pixel;  ///< row, column
  FittedLight light;
};
LitFaces litFaces(const ObjectModel& model, const SearchImage& image, const Candidate& candidate, int step);

/// A pose that is held against others of its part in its place.
struct Contestant {
  const Candidate& candidate;  ///< verified
  double log_odds = 0;         ///< by its own evidence
  LitFaces faces;              ///< on the lattice of all contestants
};

/// What the image says for the first against the second.
PoseContest contestBetween(const SearchImage& image, const Contestant& first, const Contestant& second);

}  // namespace monocular_eye_hand
