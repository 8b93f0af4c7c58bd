#include "monocular_eye_hand/options/tree.h"

#include <fmt/format.h>

#include <utility>

namespace monocular_eye_hand {

OptionTree OptionTree::ofScalar(std::string value, bool text) {
  OptionTree tree;
  tree.kind = Kind::kScalar;
  tree.scalar = std::move(value);
  tree.text = text;
  return tree;
}

OptionTree OptionTree::ofList(std::vector<OptionTree> items) {
  OptionTree tree;
  tree.kind = Kind::kList;
  tree.list = std::move(items);
  return tree;
}

OptionTree OptionTree::ofMap() {
  OptionTree tree;
  tree.kind = Kind::kMap;
  return tree;
}

const OptionTree* OptionTree::find(const std::string& key) const {
  for (const auto& entry : map)
    if (entry.first == key) return &entry.second;
  return nullptr;
}

OptionTree& OptionTree::set(const std::string& key, OptionTree value) {
  if (kind == Kind::kNull) kind = Kind::kMap;
  for (auto& entry : map)
    if (entry.first == key) return entry.second = std::move(value);
  map.emplace_back(key, std::move(value));
  return map.back().second;
}

std::string OptionTree::describe() const {
  switch (kind) {
    case Kind::kNull:
      return "nothing";
    case Kind::kScalar:
      return "'" + scalar + "'";
    case Kind::kList:
      return fmt::format("a list of {}", list.size());
    case Kind::kMap:
      return "a map";
  }
  return "";
}

bool operator==(const OptionTree& a, const OptionTree& b) {
  if (a.kind != b.kind || a.scalar != b.scalar || a.list != b.list || a.map.size() != b.map.size())
    return false;
  for (const auto& entry : a.map) {
    const OptionTree* other = b.find(entry.first);
    if (!other || !(entry.second == *other)) return false;
  }
  return true;
}

}  // namespace monocular_eye_hand
