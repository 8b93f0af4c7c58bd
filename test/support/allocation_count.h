#pragma once

namespace monocular_eye_hand {

/// Calls of operator new in this program so far. Linking allocation_count.cpp replaces the operator.
long allocationCount();

}  // namespace monocular_eye_hand
