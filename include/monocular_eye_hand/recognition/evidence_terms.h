#pragma once
#include <map>
#include <string>

namespace monocular_eye_hand {

/// What the image says about one refined pose: for it, and against it. Every term is a plain number that the
/// decision weighs; names are those of ObjectEstimate::evidence.
struct EvidenceTerms {
  double sum = 0;                 ///< log-likelihood ratio of the visible contour [nats], one sample per 5 px
  double mean = 0;                ///< ... per sample
  double hit_ratio = 0;           ///< share of the contour inside the image with an edge within 2 px
  double in_frame = 0;            ///< share of the contour inside the image
  double contour_length = 0;      ///< visible contour inside the image [px]
  double groups = 0;              ///< visible model features (edges, circles, silhouettes)
  double unsupported = 0;         ///< share of them with hardly any edge under them
  double unsupported_length = 0;  ///< ... weighted by their length
  double silhouette_hits = 0;     ///< hit ratio of the outline alone
  double crease_hits = 0;         ///< ... of the inner edges alone (of the outline where there are none)
  double overhang = 0;       ///< share of the length of the image segments it uses that it does not explain
  double continuation = 0;   ///< share of edge ends past which an image edge runs straight on
  double ends = 0;           ///< edge ends that were tested for it
  double interior = 0;       ///< share of face pixels with an edge that the model does not explain
  double off_face = 0;       ///< share of face pixels that depart from a smooth shading of their face
  double shading = 0;        ///< share of its faces' spread of greys that one light explains
  double faces = 0;          ///< visible faces
  double solidity = 0;       ///< drawn area over the area of the drawing's convex hull
  double size = 0;           ///< square root of the drawn area [px]
  double contrast = 0;       ///< median gradient of the answering edge points, relative to the image's noise
  double rms = 0;            ///< back-projection error of the answered samples [px]
  double claimed_ratio = 0;  ///< different edge points per answered sample
  double offset = 0;         ///< median distance of the answered samples from their edge [px]
  double precise_features = 0;  ///< features of which half is answered by parallel edges within 0.5 px
  double slant = 0;             ///< mean of 1 - |cos| between drawn and found direction
  double linked = 0;        ///< share of neighbouring answered samples whose edge points follow on one trace
  double jitter = 0;        ///< rms change of the offset between such neighbours [px]
  double run = 0;           ///< longest stretch answered by one trace, share of the contour
  double polarity = 0;      ///< share of the answered samples with their feature's prevailing gradient sign
  double blur = 0;          ///< median blur of the answering edge points [px]
  double rel_contrast = 0;  ///< their median gradient over that of the edges around
  double outline_hits = 0;  ///< share of the part's outline with an edge under it
  double outline_bare = 0;  ///< share of the outline without an edge, on flat ground
  double inner_share = 0;   ///< share of the drawing that lies within the outline
  double inner_hits = 0;    ///< share of it with an edge under it
  double inner_bare = 0;    ///< share of it without an edge, on flat ground
  double sharp_bare = 0;    ///< the same of creases that shading shows
  double inner_features = 0;  ///< features of 12 px and more within the outline
  double inner_found = 0;     ///< ... of which half is there
  double features_found = 0;  ///< ... as a share
  double features_bare = 0;   ///< share of them that half lie on flat ground without an edge
  double chance = 0;          ///< largest share of the drawing that finds edges when shifted by 11 and 19 px
  double chance_mean = 0;     ///< mean of it
  double chance_inner = 0;    ///< mean of it within the outline
  double excess = 0;          ///< mean evidence less the largest of the shifted drawing
  double repeated = 0;        ///< share of the shifted drawing's edge points that answer the drawing itself
  double crossed = 0;         ///< share of the outline that image edges run through
  double through = 0;         ///< share of face pixels on unexplained edges that run out of the drawing
  double print = 0;           ///< share of face pixels on unexplained edges that stay within the drawing
  double hidden = 0;          ///< share of the contour that surely recognised objects hide
  double view_area = 0;       ///< area of the part in this view over its largest
  double extent = 0;          ///< longest extent in this view over the diameter
  double complexity = 0;      ///< ln of contour length over size
  double diameter = 0;        ///< the part's diameter at this distance [px]

  /// Calls v(name, field) for every term.
  template <class Visitor>
  void visit(Visitor&& v) {
    v("sum", sum);
    v("mean", mean);
    v("hit_ratio", hit_ratio);
    v("in_frame", in_frame);
    v("contour_length", contour_length);
    v("groups", groups);
    v("unsupported", unsupported);
    v("unsupported_length", unsupported_length);
    v("silhouette_hits", silhouette_hits);
    v("crease_hits", crease_hits);
    v("overhang", overhang);
    v("continuation", continuation);
    v("ends", ends);
    v("interior", interior);
    v("off_face", off_face);
    v("shading", shading);
    v("faces", faces);
    v("solidity", solidity);
    v("size", size);
    v("contrast", contrast);
    v("rms", rms);
    v("claimed_ratio", claimed_ratio);
    v("offset", offset);
    v("precise_features", precise_features);
    v("slant", slant);
    v("linked", linked);
    v("jitter", jitter);
    v("run", run);
    v("polarity", polarity);
    v("blur", blur);
    v("rel_contrast", rel_contrast);
    v("outline_hits", outline_hits);
    v("outline_bare", outline_bare);
    v("inner_share", inner_share);
    v("inner_hits", inner_hits);
    v("inner_bare", inner_bare);
    v("sharp_bare", sharp_bare);
    v("inner_features", inner_features);
    v("inner_found", inner_found);
    v("features_found", features_found);
    v("features_bare", features_bare);
    v("chance", chance);
    v("chance_mean", chance_mean);
    v("chance_inner", chance_inner);
    v("excess", excess);
    v("repeated", repeated);
    v("crossed", crossed);
    v("through", through);
    v("print", print);
    v("hidden", hidden);
    v("view_area", view_area);
    v("extent", extent);
    v("complexity", complexity);
    v("diameter", diameter);
  }
  std::map<std::string, double> named() const;
};

/// The terms that `named` gives by name; what it lacks is 0, names that are no terms are passed over.
EvidenceTerms evidenceTerms(const std::map<std::string, double>& named);

}  // namespace monocular_eye_hand
