#pragma once
#include "grouping/ends.h"
#include "grouping/image_context.h"
#include "monocular_eye_hand/features/features.h"
#include "monocular_eye_hand/grouping/grouping.h"

namespace monocular_eye_hand {

EndMap mapEnds(const ImageContext& context);
EndMap mapEnds(const FeatureSet& features, const GroupingOptions& options);

}  // namespace monocular_eye_hand
