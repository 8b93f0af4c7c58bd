#pragma once
#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace monocular_eye_hand {

/// The values of a calibration by name, however the name is spelled ("image_width", "image_Width") and
/// whether or not they stand one level deeper ("cam0: {...}", "projection_parameters: {...}").
class CalibrationFields {
 public:
  /// Throws BadInput when the tree holds two cameras.
  explicit CalibrationFields(const YAML::Node& tree);

  /// `names` in lower case without separators, the likeliest first.
  bool has(std::initializer_list<const char*> names) const { return find(names) != nullptr; }
  /// All numbers below the name (of "data" where there is one), in order; nothing when it is not there.
  /// Throws BadInput naming what is no finite number.
  std::optional<std::vector<double>> numbers(std::initializer_list<const char*> names) const;
  /// One number. Throws BadInput when there are more.
  std::optional<double> number(std::initializer_list<const char*> names) const;
  /// A word; "" when it is not there.
  std::string text(std::initializer_list<const char*> names) const;
  /// The name of the map that the camera stood in, "" at the top.
  const std::string& camera() const { return camera_; }

 private:
  struct Field {
    std::string name;  // as written
    YAML::Node node;
  };
  void add(const YAML::Node& map);
  const Field* find(std::initializer_list<const char*> names) const;

  std::map<std::string, Field> fields_;
  std::string camera_;
};

}  // namespace monocular_eye_hand
