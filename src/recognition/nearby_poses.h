#pragma once
#include <vector>

#include "recognition/candidate.h"
#include "recognition/search_task.h"
#include "recognition/stage_log.h"

namespace monocular_eye_hand {

/// An alignment that has locked on to the wrong ones of many near edges leaves a pose tilted by a few
/// degrees, which looks doubtful. The likeliest doubtful candidates are aligned again from poses tilted to
/// all sides, and give way to what is borne out better there. No candidate is added, for it would compete
/// with its own better self.
std::vector<Candidate> tryNearbyPoses(const SearchTask& task, std::vector<Candidate> candidates,
                                      StageLog* log);

}  // namespace monocular_eye_hand
