#pragma once
#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace monocular_eye_hand {

// Calibration files that are no YAML as the tree that a YAML of the same numbers would give.

/// True for text with the line "camera matrix" below a line "[section]": ost.ini or ost.txt.
bool isOstIni(const std::string& text);

/// Map from "width", "camera matrix", ... to their numbers. Throws BadInput when there are two cameras.
YAML::Node treeOfIni(const std::string& text);

/// An XML element with what stands inside it. Attributes are left out.
struct XmlElement {
  std::string name;
  std::string text;  ///< of the element itself, blanks at both ends removed
  std::vector<XmlElement> children;

  const XmlElement* child(const std::string& wanted) const;  ///< the first of that name, or null
};

/// The outermost element. Throws BadInput with the line of what is wrong.
XmlElement parseXml(const std::string& text);

/// A map of the children; an element without children is a scalar, or a list of its words when several.
YAML::Node treeOfXml(const XmlElement& element);

}  // namespace monocular_eye_hand
