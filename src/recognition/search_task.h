#pragma once
#include <limits>
#include <vector>

#include "monocular_eye_hand/recognition/options.h"
#include "recognition/search_image.h"
#include "recognition/search_model.h"

namespace monocular_eye_hand {

class SearchTrace;
struct Support;

/// What is searched for, and in which image. Refers to what must outlive it.
struct SearchTask {
  const SearchImage& image;  ///< with groupings and evidence
  const std::vector<SearchModel>& models;
  const std::vector<int>& wanted;  ///< the models that are searched for, ascending
  const RecognitionOptions& options;
  SearchTrace* trace = nullptr;      ///< listens to the search; nullptr: nobody does
  const Support* support = nullptr;  ///< what the parts stand on; nullptr: not known
  double largest_size =
      std::numeric_limits<double>::infinity();  ///< image of a diameter that is looked for [px]

  /// The same search in another image, for parts of any size; what listens to this one does not see it.
  SearchTask in(const SearchImage& other) const { return {other, models, wanted, options, nullptr, support}; }
  /// The same search for some of the models.
  SearchTask forModels(const std::vector<int>& some) const {
    return {image, models, some, options, trace, support, largest_size};
  }
};

}  // namespace monocular_eye_hand
