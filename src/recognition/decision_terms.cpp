#include "monocular_eye_hand/recognition/decision_terms.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

using Terms = EvidenceTerms;

double logWithin(double value, double low, double high) { return std::log(std::clamp(value, low, high)); }

}  // namespace

const std::vector<DecisionTerm>& decisionTerms() {
  // What grows with the part, the image or the number of features is bounded: beyond its bound it says no
  // more.
  static const std::vector<DecisionTerm> terms{
      {"log_sum", "ln of the evidence of the contour",
       [](const Terms& t) { return logWithin(t.sum, 1, 300); }},
      {"mean", "evidence per contour sample", [](const Terms& t) { return t.mean; }},
      {"hit_ratio", "share of the contour with an edge under it", [](const Terms& t) { return t.hit_ratio; }},
      {"log_groups", "ln of the number of visible features",
       [](const Terms& t) { return logWithin(t.groups, 1, 12); }},
      {"unsupported", "share of its features with hardly any edge under them",
       [](const Terms& t) { return t.unsupported; }},
      {"unsupported_length", "length share of its features with hardly any edge under them",
       [](const Terms& t) { return t.unsupported_length; }},
      {"continuation", "share of its corners past which image edges run on",
       [](const Terms& t) { return t.continuation; }},
      {"overhang", "share of the used image edges that stays unexplained",
       [](const Terms& t) { return t.overhang; }},
      {"interior", "share of its faces with edges that it does not explain",
       [](const Terms& t) { return std::min(t.interior, 0.6); }},
      {"off_face", "share of its faces that is not smoothly shaded",
       [](const Terms& t) { return std::min(t.off_face, 0.6); }},
      {"shading", "share of its shading that one light explains",
       [](const Terms& t) { return std::clamp(t.shading, -1.0, 1.0); }},
      {"solidity", "drawn area over that of its convex hull", [](const Terms& t) { return t.solidity; }},
      {"log_faces", "ln of the number of visible faces",
       [](const Terms& t) { return logWithin(t.faces, 1, 6); }},
      {"log_size", "ln of its size in the image", [](const Terms& t) { return logWithin(t.size, 10, 150); }},
      {"log_contrast", "ln of its edges' contrast over the noise",
       [](const Terms& t) { return logWithin(t.contrast, 1, 20); }},
      {"in_frame", "share of the contour inside the image", [](const Terms& t) { return t.in_frame; }},
      {"rms", "distance of its edges from the contour in px", [](const Terms& t) { return t.rms; }},
      {"claimed_ratio", "different edge points per answered sample",
       [](const Terms& t) { return t.claimed_ratio; }},
      {"offset", "median distance of its edges from the contour in px",
       [](const Terms& t) { return std::min(t.offset, 2.0); }},
      {"log_precise", "ln of the number of features found to half a pixel",
       [](const Terms& t) { return logWithin(t.precise_features + 1, 1, 9); }},
      {"slant", "slant of its edges to the contour", [](const Terms& t) { return t.slant; }},
      {"linked", "share of neighbouring samples on one edge", [](const Terms& t) { return t.linked; }},
      {"jitter", "jitter of its edges about the contour in px", [](const Terms& t) { return t.jitter; }},
      {"run", "longest stretch of the contour on one edge", [](const Terms& t) { return t.run; }},
      {"polarity", "share of its edges with one sign of contrast per feature",
       [](const Terms& t) { return t.polarity; }},
      {"blur", "blur of its edges in px", [](const Terms& t) { return std::clamp(t.blur, 0.0, 4.0); }},
      {"log_rel_contrast", "ln of its edges' contrast over that of the edges around",
       [](const Terms& t) { return logWithin(t.rel_contrast, 0.2, 5); }},
      {"outline_hits", "share of its outline with an edge under it",
       [](const Terms& t) { return t.outline_hits; }},
      {"outline_bare", "share of its outline missing on flat ground",
       [](const Terms& t) { return t.outline_bare; }},
      {"inner_share", "share of the drawing within the outline",
       [](const Terms& t) { return t.inner_share; }},
      {"inner_hits", "share of the drawing within the outline with an edge under it",
       [](const Terms& t) { return t.inner_hits; }},
      {"inner_bare", "share of the drawing within the outline missing on flat ground",
       [](const Terms& t) { return t.inner_bare; }},
      {"sharp_bare", "share of its sharp creases missing on flat ground",
       [](const Terms& t) { return t.sharp_bare; }},
      {"log_inner_found", "ln of the number of inner features found",
       [](const Terms& t) { return logWithin(t.inner_found + 1, 1, 9); }},
      {"features_found", "share of the inner features found",
       [](const Terms& t) { return t.features_found; }},
      {"features_bare", "share of the inner features missing on flat ground",
       [](const Terms& t) { return t.features_bare; }},
      {"chance", "largest share of the contour that edges answer a little beside it",
       [](const Terms& t) { return t.chance; }},
      {"chance_mean", "share of the contour that edges answer beside it",
       [](const Terms& t) { return t.chance_mean; }},
      {"chance_inner", "share of the inner contour that edges answer beside it",
       [](const Terms& t) { return t.chance_inner; }},
      {"excess", "evidence per sample over the largest beside it", [](const Terms& t) { return t.excess; }},
      {"repeated", "share of the edges that answer beside it, too",
       [](const Terms& t) { return t.repeated; }},
      {"crossed", "share of its outline that image edges run through",
       [](const Terms& t) { return t.crossed; }},
      {"through", "share of its faces with edges that run out of it",
       [](const Terms& t) { return std::min(t.through, 0.6); }},
      {"print", "share of its faces with edges that stay within it",
       [](const Terms& t) { return std::min(t.print, 0.6); }},
      {"view_area", "area seen from this side over the largest", [](const Terms& t) { return t.view_area; }},
      {"extent", "extent seen from this side over the largest", [](const Terms& t) { return t.extent; }},
      {"complexity", "ln of contour length over size",
       [](const Terms& t) { return std::clamp(t.complexity, 0.0, 3.5); }},
  };
  return terms;
}

std::vector<double> decisionValues(const EvidenceTerms& evidence) {
  std::vector<double> values;
  for (const DecisionTerm& term : decisionTerms()) values.push_back(term.value(evidence));
  return values;
}

}  // namespace monocular_eye_hand
