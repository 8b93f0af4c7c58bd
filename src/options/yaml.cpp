#include <fmt/format.h>

#include <yaml-cpp/yaml.h>

#include <cctype>
#include <fstream>
#include <iterator>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/tree.h"

namespace monocular_eye_hand {
namespace {

std::string place(const YAML::Mark& mark) {
  return mark.is_null() ? "" : fmt::format(" (line {})", mark.line + 1);
}

constexpr int kDeepest = 100;
constexpr size_t kMaxValues = 1000000;

/// Turns YAML into a tree. Aliases (*name) become copies of what they name, which may be the list or map they
/// stand in: then there is no end, and doubled often enough none that memory holds.
class Converter {
 public:
  OptionTree convert(const YAML::Node& node, const std::string& name, int depth = 0) {
    if (depth > kDeepest)
      throw BadInput(fmt::format(
          "'{}' is nested more than {} levels deep; does an alias (*name) stand in what it names?{}",
          name.substr(0, 60), kDeepest, place(node.Mark())));
    if (++values_ > kMaxValues)
      throw BadInput(fmt::format("there are more than {} values; do aliases (*name) double what they name?{}",
                                 kMaxValues, place(node.Mark())));
    switch (node.Type()) {
      case YAML::NodeType::Scalar:
        return OptionTree::ofScalar(node.Scalar(), node.Tag() == "!");
      case YAML::NodeType::Sequence:
        return ofList(node, name, depth);
      case YAML::NodeType::Map:
        return ofMap(node, name, depth);
      default:
        return {};
    }
  }

 private:
  OptionTree ofList(const YAML::Node& node, const std::string& name, int depth) {
    OptionTree tree = OptionTree::ofList();
    for (const YAML::Node& item : node) tree.list.push_back(convert(item, name, depth + 1));
    return tree;
  }

  OptionTree ofMap(const YAML::Node& node, const std::string& parent, int depth) {
    OptionTree tree = OptionTree::ofMap();
    for (const auto& entry : node) {
      if (!entry.first.IsScalar())
        throw BadInput("a key" + (parent.empty() ? "" : " of '" + parent + "'") + " is not a plain name" +
                       place(entry.first.Mark()));
      const std::string key = entry.first.Scalar();
      const std::string name = parent.empty() ? key : parent + "." + key;
      if (tree.find(key)) throw BadInput("'" + name + "' stands twice" + place(entry.first.Mark()));
      tree.map.emplace_back(key, convert(entry.second, name, depth + 1));
    }
    return tree;
  }

  size_t values_ = 0;
};

// A plain scalar that YAML reads as the same text, in any context.
bool plain(const std::string& text) {
  if (text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL") return false;
  if (text == "-" || text == "." || text == "..") return false;
  for (char c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '.' && c != '-' && c != '+' &&
        c != '/')
      return false;
  return text.substr(0, 3) != "---";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      const char* hex = "0123456789abcdef";
      out += "\\x";
      out += hex[byte >> 4];
      out += hex[byte & 15];
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string scalarText(const OptionTree& tree) {
  return tree.text || !plain(tree.scalar) ? quoted(tree.scalar) : tree.scalar;
}

bool inLine(const OptionTree& tree) {
  if (tree.kind == OptionTree::Kind::kMap) return tree.map.empty();
  for (const OptionTree& item : tree.list)
    if (item.kind == OptionTree::Kind::kMap || !inLine(item)) return false;
  return true;
}

std::string lineText(const OptionTree& tree) {
  switch (tree.kind) {
    case OptionTree::Kind::kNull:
      return "~";
    case OptionTree::Kind::kScalar:
      return scalarText(tree);
    case OptionTree::Kind::kMap:
      return "{}";
    case OptionTree::Kind::kList:
      break;
  }
  std::string out = "[";
  for (size_t i = 0; i < tree.list.size(); ++i) out += (i ? ", " : "") + lineText(tree.list[i]);
  return out + "]";
}

void emit(const OptionTree& tree, const std::string& indent, std::string* out) {
  if (inLine(tree)) {
    *out += indent + lineText(tree) + "\n";
    return;
  }

  for (const OptionTree& item : tree.list) {
    // The item's block, with its first indentation replaced by the dash.
    std::string block;
    emit(item, indent + "  ", &block);
    *out += indent + "- " + block.substr(indent.size() + 2);
  }

  for (const auto& entry : tree.map) {
    const std::string key = plain(entry.first) ? entry.first : quoted(entry.first);
    if (inLine(entry.second)) {
      *out += indent + key + ": " + lineText(entry.second) + "\n";
    } else {
      *out += indent + key + ":\n";
      emit(entry.second, indent + "  ", out);
    }
  }
}

}  // namespace

OptionTree parseYaml(const std::string& text, const std::string& source) {
  try {
    return Converter().convert(YAML::Load(text), "");
  } catch (const BadInput& e) {
    throw BadInput(source + ": " + e.what());
  } catch (const YAML::Exception& e) {
    throw BadInput(source + ": not valid YAML: " + e.msg + place(e.mark));
  }
}

OptionTree loadYaml(const std::string& path) {
  std::ifstream file(path);
  file.peek();  // a folder opens on Linux, but cannot be read
  if (!file.is_open() || file.bad()) throw BadInput(path + ": cannot be read (YAML expected)");
  file.clear();
  return parseYaml({std::istreambuf_iterator<char>(file), {}}, path);
}

std::string toYaml(const OptionTree& tree) {
  if (tree.kind == OptionTree::Kind::kNull) return "";
  std::string out;
  emit(tree, "", &out);
  return out;
}

}  // namespace monocular_eye_hand
