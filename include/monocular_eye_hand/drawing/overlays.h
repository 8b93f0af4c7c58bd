#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "monocular_eye_hand/drawing/canvas.h"
#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/grouping/grouping.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

// Overlays of the stages before recognition, written once and used by tools, nodes and reports. `grey` is the
// raw 8-bit image; FeatureSet::camera says where its lens puts the features. What needs a RecognitionResult
// is in report/.

/// Each trace in a colour of its own.
void drawTraces(Canvas* canvas, const FeatureSet& features);
/// Plain segments yellow, joined ones cyan, ends dotted.
void drawSegments(Canvas* canvas, const FeatureSet& features);
/// Arcs orange, their ellipses not drawn.
void drawArcs(Canvas* canvas, const FeatureSet& features);
/// Fitted ellipses: thin all round, thick where arcs support them.
void drawEllipses(Canvas* canvas, const FeatureSet& features);
/// One grouping: its segments, ellipses and points.
void drawGrouping(Canvas* canvas, const FeatureSet& features, const Grouping& grouping, const Colour& colour);

cv::Mat tracesPicture(const cv::Mat& grey, const FeatureSet& features);
cv::Mat segmentsPicture(const cv::Mat& grey, const FeatureSet& features);
cv::Mat ellipsesPicture(const cv::Mat& grey, const FeatureSet& features);
/// Everything in one picture: traces, segments, arcs, ellipses.
cv::Mat featuresPicture(const cv::Mat& grey, const FeatureSet& features);

/// A picture and the kind of grouping it shows.
struct GroupingPicture {
  GroupingKind kind;
  int shown = 0, total = 0;  ///< the best `shown` by weight of `total`
  cv::Mat picture;
};
/// One picture per kind that occurs, at most `most` groupings in each, best by weight.
std::vector<GroupingPicture> groupingPictures(const cv::Mat& grey, const FeatureSet& features,
                                              const std::vector<Grouping>& groupings, int max_lines = 150);
/// Figure 10 (a) of Wong et al.: the fitted lines, coloured by the connected group that corners make of them;
/// grey where none does. Only groupings of at least `min_weight` connect: chance meetings in texture do not.
cv::Mat lineGroupsPicture(const cv::Mat& grey, const FeatureSet& features,
                          const std::vector<Grouping>& groupings, double min_weight = 0.1);

/// How a back-projected model is drawn.
struct ObjectStyle {
  Colour colour{80, 230, 90};
  int width = 2;
  bool axes = true;   ///< x red, y green, z blue, a third of the diameter long
  std::string label;  ///< none when empty
};
/// Back-projection of the CAD model with hidden lines removed (visibleContour).
void drawObject(Canvas* canvas, const ObjectModel& model, const Rigid3& camera_from_object,
                const ObjectStyle& style);
/// Its label alone: drawn after all objects, no line runs through it.
void drawObjectLabel(Canvas* canvas, const ObjectModel& model, const Rigid3& camera_from_object,
                     const ObjectStyle& style);

}  // namespace monocular_eye_hand
