#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// One sampled viewpoint: the eye at `eye_in_object`, and what it sees.
struct SampledView {
  Eigen::Vector3d direction;       ///< unit, from the object's centre to the eye
  double distance = 0;             ///< eye to centre [m]
  std::vector<ContourSample> contour;
  int characteristic_view = -1;    ///< index of its class
};

/// A class of neighbouring viewpoints with the same visible features (Chakravarty & Freeman 1982).
struct CharacteristicView {
  std::vector<int> views;          ///< SampledViews merged in it
  std::vector<int> groups;         ///< visible contour groups, ascending
  std::vector<double> visible;     ///< per group: mean visible share of its length
  std::vector<double> weight;      ///< per group: seed's pre-calculated weighting score, sums to 1 over the view
};

/// The view sphere of a model, modulo its symmetries (one fundamental domain; for an axis one half meridian).
struct ViewSphere {
  std::vector<double> distances;    ///< eye distances sampled [m], ascending
  int directions = 0;               ///< views are stored distance by distance: views[distance * directions + k]
  std::vector<SampledView> views;
  std::vector<CharacteristicView> characteristic;
};

struct ViewOptions {
  double spacing = 0.21;            ///< angle between neighbouring directions [rad]
  std::vector<double> distance_ratios{2.0, 3.5, 7.0};  ///< eye distance in diameters
  int samples_per_view = 120;       ///< contour samples of a typical view: sets the step
  void check() const;
};

/// Directions covering the view sphere modulo the symmetries, about `spacing` apart.
std::vector<Eigen::Vector3d> viewDirections(const Symmetries& symmetries, double spacing);
ViewSphere sampleViews(const ObjectModel& model, const ViewOptions& options);

}  // namespace monocular_eye_hand
