#include "evaluation/json_file.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

const nlohmann::json& memberOf(const nlohmann::json& value, const char* key, const std::string& where) {
  if (!value.is_object() || !value.contains(key)) throw BadInput(where + ": '" + key + "' is missing");
  return value[key];
}

void flatten(const nlohmann::json& value, std::vector<double>* numbers) {
  if (value.is_array()) {
    for (const nlohmann::json& item : value) flatten(item, numbers);
  } else {
    numbers->push_back(value.is_number() ? value.get<double>() : std::nan(""));
  }
}

}  // namespace

nlohmann::json loadJson(const std::string& path) {
  std::ifstream file(path);
  file.peek();
  if (!file.is_open() || file.bad()) throw BadInput(path + ": cannot be read");
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& e) {
    throw BadInput(path + ": not valid JSON: " + e.what());
  }
}

double numberAt(const nlohmann::json& value, const char* key, const std::string& where) {
  return numbersAt<1>(value, key, where)[0];
}

int integerAt(const nlohmann::json& value, const char* key, const std::string& where) {
  const double number = numberAt(value, key, where);
  if (number != std::floor(number) || std::abs(number) > std::numeric_limits<int>::max())
    throw BadInput(where + ": '" + key + "' is not an integer");
  return int(number);
}

template <int N>
Eigen::Matrix<double, N, 1> numbersAt(const nlohmann::json& value, const char* key,
                                      const std::string& where) {
  std::vector<double> numbers;
  flatten(memberOf(value, key, where), &numbers);
  if (numbers.size() != size_t(N))
    throw BadInput(fmt::format("{}: '{}' has {} numbers, {} expected", where, key, numbers.size(), N));
  for (double number : numbers)
    if (!std::isfinite(number))
      throw BadInput(where + ": '" + key + "' holds something that is not a finite number");
  return Eigen::Map<const Eigen::Matrix<double, N, 1>>(numbers.data());
}
template Eigen::Matrix<double, 1, 1> numbersAt<1>(const nlohmann::json&, const char*, const std::string&);
template Eigen::Matrix<double, 3, 1> numbersAt<3>(const nlohmann::json&, const char*, const std::string&);
template Eigen::Matrix<double, 9, 1> numbersAt<9>(const nlohmann::json&, const char*, const std::string&);
template Eigen::Matrix<double, 16, 1> numbersAt<16>(const nlohmann::json&, const char*, const std::string&);

int numberOfName(const std::string& name) {
  if (name.empty() || name.size() > 9 || name.find_first_not_of("0123456789") != std::string::npos) return -1;
  return std::stoi(name);
}

}  // namespace monocular_eye_hand
