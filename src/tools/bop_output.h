#pragma once
#include <string>
#include <utility>
#include <vector>

namespace monocular_eye_hand {

/// One scene folder of random pictures in a BOP data set.
struct BopRequest {
  std::string objects;      ///< model base (YAML): the parts with truth
  std::string distractors;  ///< model base of parts without truth; "": none
  std::string dataset, split = "train";
  int scene = 1;
  int count = 1;                  ///< images
  unsigned seed = 1;              ///< with the split's name and the scene's number it decides everything
  std::string level;              ///< easy, medium, hard or mixed
  std::string sizes = "640x480";  ///< WIDTHxHEIGHT:WEIGHT,...; one is drawn for the whole scene folder
  std::pair<double, double> part_pixels{75, 300};  ///< PartSize::min_pixels, max_pixels
  double piled = 0;                                ///< RandomSceneOptions::piled in hard scenes
  bool mixed_appearance = false;                   ///< Appearance::kMixed
  int samples = 2;                                 ///< RenderOptions::samples
  int edge_samples = 4;                            ///< RenderOptions::edge_samples
};

/// Renders and writes it; existing files of the same scene are replaced. Throws BadInput.
void renderBopScene(const BopRequest& request);

}  // namespace monocular_eye_hand
