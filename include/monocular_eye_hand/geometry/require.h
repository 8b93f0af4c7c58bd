#pragma once
#include <string>

namespace monocular_eye_hand {

// For options: each throws BadInput unless the field is as it must be. What is not finite never is.

/// "FIELD = VALUE must be RULE"
void require(bool holds, const std::string& field, double value, const std::string& rule);
void requireFinite(const std::string& field, double value);
void requirePositive(const std::string& field, double value);
void requireNotNegative(const std::string& field, double value);
/// Between 0 and 1.
void requireShare(const std::string& field, double value);
/// "FIELD is not set: give WHAT" when the value is empty.
void requireGiven(const std::string& field, const std::string& value, const std::string& what);

}  // namespace monocular_eye_hand
