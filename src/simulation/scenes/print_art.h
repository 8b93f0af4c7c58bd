#pragma once
#include <opencv2/core.hpp>

#include "monocular_eye_hand/geometry/random.h"

namespace monocular_eye_hand {

/// Pictures as they are found on things and on tables.
enum class Art {
  kText,         ///< a few lines of printed words
  kHandwriting,  ///< by felt pen
  kLabel,        ///< light rectangle with words, lines and a bar code
  kBarcode,
  kTag,        ///< square black and white cells
  kLogo,       ///< polygons, rings, letters
  kPatchwork,  ///< cells of different greys with drawings: covers all
  kBoxFront,   ///< panels, headline, photograph: covers all
  kScratches,
  kStains,
  kGrid,  ///< of a cutting mat
  kPage,  ///< white sheet full of text
  kRuler  ///< marks along the width
};

/// `ground`: albedo of what it is drawn on. Returns albedo times cover, and cover (Print::picture).
cv::Mat_<cv::Vec2f> drawArt(Art art, const cv::Size& texels, double ground, Generator* random);

}  // namespace monocular_eye_hand
