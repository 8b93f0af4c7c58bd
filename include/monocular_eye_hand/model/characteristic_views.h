#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// One sampled viewpoint: the eye at `eye_in_object`, and what it sees.
struct SampledView {
  Eigen::Vector3d direction;  ///< unit, from the object's centre to the eye
  double distance = 0;        ///< eye to centre [m]
  std::vector<ContourSample> contour;
  int characteristic_view = -1;  ///< index of its class
};

/// A class of neighbouring viewpoints with the same visible features (Chakravarty & Freeman 1982).
struct CharacteristicView {
  std::vector<int> views;       ///< SampledViews merged in it
  std::vector<int> features;    ///< visible contour features, ascending
  std::vector<double> visible;  ///< per feature: mean visible share of its length
  /// Per feature: the pre-calculated weighting score of Wong et al., sums to 1 over the view. Proportional to
  /// sqrt(l / L) (1 + ln(V / v)): l of the view's visible contour length L belongs to the feature, and v of
  /// all V views show it. A long feature weighs more, and so does one that few other views offer.
  std::vector<double> weight;
};

/// The view sphere of a model, modulo its symmetries (one fundamental domain; for an axis one half meridian).
struct ViewSphere {
  std::vector<double> distances;  ///< eye distances sampled [m], ascending
  double step = 0;                ///< distance of the contour samples [m]
  int directions = 0;             ///< views are stored distance by distance: views[distance * directions + k]
  std::vector<SampledView> views;
  std::vector<CharacteristicView> characteristic;
};

struct ViewOptions {
  double spacing = 0.21;                               ///< angle between neighbouring directions [rad]
  std::vector<double> distance_ratios{2.0, 3.5, 7.0};  ///< eye distance in diameters
  int samples_per_view = 120;                          ///< contour samples of a typical view: sets the step

  void check() const;
  /// Calls v("field", field) for every field: readers fill options by name.
  template <class Visitor>
  void visit(Visitor&& v) {
    v("spacing", spacing);
    v("distance_ratios", distance_ratios);
    v("samples_per_view", samples_per_view);
  }
};

/// Directions covering the view sphere modulo the symmetries, about `spacing` apart: every direction of the
/// sphere is nearer than 0.75 spacing to a symmetric copy of one of them. For a discrete feature they lie in
/// the fundamental domain of directions whose dot product with a fixed generic vector no rotation of the
/// feature makes larger; for an axis on half a meridian (a quarter with a flip); for a sphere there is one.
std::vector<Eigen::Vector3d> viewDirections(const Symmetries& symmetries, double spacing);
/// The contour seen from every direction and distance, and its classes: neighbouring views (next directions
/// at one distance, or one direction at next distances) that show the same features are one class.
ViewSphere sampleViews(const ObjectModel& model, const ViewOptions& options);

}  // namespace monocular_eye_hand
