#pragma once
#include <string>
#include <utility>
#include <vector>

namespace monocular_eye_hand {

/// What a YAML file, or the ROS parameter server, says: a tree of scalars. Scalars stay text until an options
/// struct says what type they are.
struct OptionTree {
  enum class Kind { kNull, kScalar, kList, kMap };
  Kind kind = Kind::kNull;
  std::string scalar;                                   ///< kScalar
  bool text = false;                                    ///< kScalar: certainly a string (quoted when written)
  std::vector<OptionTree> list;                         ///< kList
  std::vector<std::pair<std::string, OptionTree>> map;  ///< kMap, in the order of the source, keys unique

  static OptionTree ofScalar(std::string value, bool text = false);
  static OptionTree ofList(std::vector<OptionTree> items = {});
  static OptionTree ofMap();
  /// The value of `key`, nullptr when there is none (or this is no map).
  const OptionTree* find(const std::string& key) const;
  /// Adds or replaces an entry of a map and returns it; a null tree becomes a map.
  OptionTree& set(const std::string& key, OptionTree value);
  /// "a number", "a list", ... for messages: what this is, with its value if it is a scalar.
  std::string describe() const;
};

bool operator==(const OptionTree& a,
                const OptionTree& b);  ///< same kinds, keys and texts; map order is ignored
inline bool operator!=(const OptionTree& a, const OptionTree& b) { return !(a == b); }

/// Parses YAML; an empty text is a null tree. `source` names it in messages. Throws BadInput on broken YAML,
/// on a key that stands twice and on a key that is not a scalar.
OptionTree parseYaml(const std::string& text, const std::string& source = "YAML");
/// Throws BadInput when the file cannot be read, and as parseYaml does.
OptionTree loadYaml(const std::string& path);
/// Block-style YAML that parseYaml reads back to an equal tree; lists of scalars stand on one line.
std::string toYaml(const OptionTree& tree);

}  // namespace monocular_eye_hand
