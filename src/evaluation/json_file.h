#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

#include "monocular_eye_hand/geometry/rigid3.h"

namespace monocular_eye_hand {

inline constexpr double kMetresPerMillimetre = 1e-3;  // BOP files are in millimetres

// Readers of the BOP JSON files. All throw BadInput naming the file and what is wrong with it.

nlohmann::json loadJson(const std::string& path);
/// `value[key]` as a finite number. `where` begins the message.
double numberAt(const nlohmann::json& value, const char* key, const std::string& where);
int integerAt(const nlohmann::json& value, const char* key, const std::string& where);
/// `value[key]` as N finite numbers (nested arrays are flattened).
template <int N>
Eigen::Matrix<double, N, 1> numbersAt(const nlohmann::json& value, const char* key, const std::string& where);
/// An object's key, or a folder's or file's name, as a number; -1 when it is none.
int numberOfName(const std::string& name);

}  // namespace monocular_eye_hand
