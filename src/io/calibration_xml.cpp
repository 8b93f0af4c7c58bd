#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "io/calibration_tree.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxElementDepth = 30;

std::string trimmed(const std::string& text) {
  const size_t begin = text.find_first_not_of(" \t\n"), end = text.find_last_not_of(" \t\n");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

/// Elements and their text; declarations, comments and attributes are skipped.
class XmlParser {
 public:
  explicit XmlParser(const std::string& text) : text_(text) {}

  XmlElement parse() {
    skipToElement();
    return element(0);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    const long line = 1 + std::count(text_.begin(), text_.begin() + long(std::min(at_, text_.size())), '\n');
    throw BadInput(fmt::format("the XML is damaged in line {}: {}", line, problem));
  }

  bool isAt(const std::string& wanted) const { return text_.compare(at_, wanted.size(), wanted) == 0; }

  void skipPast(const std::string& end) {
    const size_t found = text_.find(end, at_);
    if (found == std::string::npos) fail("\"" + end + "\" is missing");
    at_ = found + end.size();
  }

  /// Past a comment or declaration; false when there is none.
  bool skipMarkup() {
    if (isAt("<!--")) {
      skipPast("-->");
    } else if (isAt("<?")) {
      skipPast("?>");
    } else if (isAt("<!")) {
      skipPast(">");
    } else {
      return false;
    }
    return true;
  }

  void skipToElement() {
    for (;;) {
      at_ = text_.find('<', at_);
      if (at_ == std::string::npos) fail("no element is found");
      if (!skipMarkup()) return;
    }
  }

  XmlElement element(int depth) {
    if (depth > kMaxElementDepth) fail("elements are nested too deeply");
    XmlElement out;
    const size_t begin = ++at_;
    at_ = text_.find_first_of(" \t\n/>", begin);
    if (at_ == std::string::npos) fail("a tag does not end");
    out.name = text_.substr(begin, at_ - begin);

    skipPast(">");
    if (text_[at_ - 2] != '/') content(&out, depth);
    out.text = trimmed(out.text);
    return out;
  }

  void content(XmlElement* out, int depth) {
    for (;;) {
      const size_t tag = text_.find('<', at_);
      if (tag == std::string::npos) fail("the end of <" + out->name.substr(0, 24) + "> is missing");
      out->text += text_.substr(at_, tag - at_);
      at_ = tag;
      if (isAt("</")) {
        skipPast(">");
        return;
      }
      if (!skipMarkup()) out->children.push_back(element(depth + 1));
    }
  }

  const std::string& text_;
  size_t at_ = 0;
};

}  // namespace

const XmlElement* XmlElement::child(const std::string& wanted) const {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const XmlElement& element) { return element.name == wanted; });
  return found == children.end() ? nullptr : &*found;
}

XmlElement parseXml(const std::string& text) { return XmlParser(text).parse(); }

YAML::Node treeOfXml(const XmlElement& element) {
  YAML::Node tree;
  if (!element.children.empty()) {
    for (const XmlElement& child : element.children) tree[child.name] = treeOfXml(child);
    return tree;
  }
  std::istringstream in(element.text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  if (words.size() <= 1) return YAML::Node(element.text);
  for (const std::string& word : words) tree.push_back(word);
  return tree;
}

}  // namespace monocular_eye_hand
