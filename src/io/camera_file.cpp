#include "monocular_eye_hand/io/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/calibration_fields.h"
#include "io/calibration_tree.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_content.h"
#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/io/plain_number.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kMaxBytes = 4 << 20;
constexpr int kMaxYamlDepth = 50;        // levels of a YAML file
constexpr size_t kMaxValues = 1000000;   // of a YAML file
constexpr double kFarFromMiddle = 0.15;  // of the principal point, as a share of width or height
const char kKnown[] =
    "known are the YAML and ost.ini of camera_calibration, OpenCV's FileStorage (YAML, XML), a CameraInfo "
    "printed by rostopic echo, kalibr's camchain and ViSP's XML";

/// A calibration as a tree of names, with what kind of file it came from.
struct Tree {
  std::string kind;
  YAML::Node root;
};

[[noreturn]] void refuseAsNone(const std::string& why) {
  throw BadInput("this is no camera calibration: " + why + "; " + kKnown);
}

/// Aliases (*name) may stand in what they name, or double it over and over: then there is no end.
void requireEnd(const YAML::Node& node, int depth, size_t* values) {
  if (depth > kMaxYamlDepth || ++*values > kMaxValues)
    refuseAsNone(fmt::format("line {} is nested too deeply or repeated too often (by aliases, *name)",
                             node.Mark().line + 1));
  if (node.IsSequence()) {
    for (const YAML::Node& item : node) requireEnd(item, depth + 1, values);
  } else if (node.IsMap()) {
    for (const auto& pair : node) {
      requireEnd(pair.first, depth + 1, values);
      requireEnd(pair.second, depth + 1, values);
    }
  }
}

/// The text as yaml-cpp takes it: OpenCV writes "%YAML:1.0", which is not YAML's own spelling.
YAML::Node parseYaml(std::string text) {
  for (size_t at = 0; text.compare(at, 1, "%") == 0;) {
    const size_t end = text.find('\n', at);
    if (end == std::string::npos) break;
    std::fill(text.begin() + long(at), text.begin() + long(end), ' ');
    at = end + 1;
  }
  try {
    for (const YAML::Node& document : YAML::LoadAll(text)) {
      if (!document.IsMap()) continue;
      size_t values = 0;
      requireEnd(document, 0, &values);
      return document;
    }
  } catch (const YAML::Exception& e) {
    refuseAsNone(fmt::format("line {} is not YAML ({})", e.mark.line + 1, e.msg));
  }
  refuseAsNone("no line names a value, as \"image_width: 640\" does");
}

std::string kindOfYaml(const std::string& text, const YAML::Node& root) {
  for (const auto& pair : root) {
    if (!pair.first.IsScalar() || !pair.second.IsMap()) continue;
    const std::string name = pair.first.Scalar();
    if (name.compare(0, 3, "cam") == 0 && pair.second["intrinsics"]) return "kalibr camchain";
  }
  if (root["K"] || root["k"]) return "CameraInfo";
  const bool opencv = text.compare(0, 5, "%YAML") == 0 || text.find("opencv-matrix") != std::string::npos;
  return opencv ? "OpenCV FileStorage" : kRosYamlKind;
}

double numberIn(const XmlElement& element, const char* name) {
  YAML::Node tree;
  const XmlElement* child = element.child(name);
  if (!child) throw BadInput("ViSP's <" + std::string(name) + "> is missing");
  tree["value"] = child->text;
  return *CalibrationFields(tree).number({"value"});
}

/// ViSP: u = u0 + px x (1 + kud r^2), so kud is k1. A camera has a model without distortion, one with, or
/// both.
YAML::Node treeOfViSP(const XmlElement& root) {
  const auto is_camera = [](const XmlElement& e) { return e.name == "camera"; };
  if (std::count_if(root.children.begin(), root.children.end(), is_camera) > 1)
    throw BadInput("it holds several <camera>: write the one that is meant to a file of its own");
  const XmlElement& camera = *root.child("camera");

  const XmlElement *plain = nullptr, *distorted = nullptr;
  std::string types;
  for (const XmlElement& model : camera.children) {
    const XmlElement* type = model.name == "model" ? model.child("type") : nullptr;
    if (!type) continue;
    types += (types.empty() ? "" : ", ") + type->text.substr(0, 60);
    if (type->text == "perspectiveProjWithoutDistortion") plain = &model;
    if (type->text == "perspectiveProjWithDistortion") distorted = &model;
  }
  const XmlElement* model = distorted ? distorted : plain;
  if (!model)
    throw BadInput("its camera model (" + types +
                   ") is not supported; known: perspectiveProjWithoutDistortion, "
                   "perspectiveProjWithDistortion");

  YAML::Node tree;
  tree["image_width"] = numberIn(camera, "image_width");
  tree["image_height"] = numberIn(camera, "image_height");
  for (const auto& [to, from] :
       {std::pair("fx", "px"), std::pair("fy", "py"), std::pair("cx", "u0"), std::pair("cy", "v0")})
    tree[to] = numberIn(*model, from);
  if (distorted) tree["k1"] = numberIn(*model, "kud");
  return tree;
}

Tree readXml(const std::string& text) {
  const XmlElement root = parseXml(text);
  if (root.name == "opencv_storage") return {"OpenCV FileStorage (XML)", treeOfXml(root)};
  if (root.child("camera")) return {"ViSP XML", treeOfViSP(root)};
  refuseAsNone("its outermost element is <" + root.name.substr(0, 24) + ">");
}

Tree readTree(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\n");
  if (first != std::string::npos && text[first] == '<') return readXml(text);
  if (isOstIni(text)) return {"ost.ini of camera_calibration", treeOfIni(text)};
  const YAML::Node root = parseYaml(text);
  return {kindOfYaml(text, root), root};
}

int wholeNumber(double value, const char* name) {
  if (!(value >= 0 && value <= 1e6) || value != std::floor(value))
    throw BadInput(std::string("'") + name + "' must be a whole number of pixels");
  return int(value);
}

void readSize(const CalibrationFields& fields, Camera* camera) {
  std::optional<double> width = fields.number({"imagewidth", "width", "camerawidth"});
  std::optional<double> height = fields.number({"imageheight", "height", "cameraheight"});
  if (const auto both = fields.numbers({"resolution", "imagesize", "size"});
      both && both->size() == 2 && !width && !height) {
    width = (*both)[0];
    height = (*both)[1];
  }
  const char* help = " is missing: add the size of the images that were calibrated, image_width: 640";
  if (!width) throw BadInput(std::string("'image_width'") + help);
  if (!height) throw BadInput(std::string("'image_height'") + help);
  camera->width = wholeNumber(*width, "image_width");
  camera->height = wholeNumber(*height, "image_height");
}

void readMatrix(const std::vector<double>& k, Camera* camera) {
  if (k.size() == 4) {  // kalibr
    camera->fx = k[0];
    camera->fy = k[1];
    camera->cx = k[2];
    camera->cy = k[3];
    return;
  }
  if (k.size() != 9)
    throw BadInput(fmt::format("'camera_matrix' has {} numbers, 9 expected, row by row", k.size()));
  if (k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1)
    throw BadInput(
        "'camera_matrix' is not of the form [fx 0 cx; 0 fy cy; 0 0 1], row by row (no skew, not transposed)");
  camera->fx = k[0];
  camera->cx = k[2];
  camera->fy = k[4];
  camera->cy = k[5];
}

void readFocal(const CalibrationFields& fields, Camera* camera) {
  const auto fx = fields.number({"fx", "camerafx"}), fy = fields.number({"fy", "camerafy"});
  const auto cx = fields.number({"cx", "ppx", "cameracx"}), cy = fields.number({"cy", "ppy", "cameracy"});
  if (fx && fy && cx && cy) {
    readMatrix({*fx, *fy, *cx, *cy}, camera);
  } else if (const auto k = fields.numbers({"cameramatrix", "k", "intrinsicmatrix", "mtx", "intrinsics"})) {
    readMatrix(*k, camera);
  } else {
    throw BadInput("'camera_matrix' with 'data' is missing");
  }
}

std::vector<double> distortionOf(const CalibrationFields& fields) {
  if (const auto list = fields.numbers(
          {"distortioncoefficients", "distortioncoeffs", "distcoeffs", "d", "distortion", "coeffs", "dist"}))
    return *list;
  std::vector<double> d;
  for (const char* name : {"k1", "k2", "p1", "p2", "k3"}) {
    const std::string in_camera = std::string("camera") + name;
    d.push_back(fields.number({name, in_camera.c_str()}).value_or(0));
  }
  return d;
}

void readDistortion(const CalibrationFields& fields, Camera* camera) {
  const std::string projection = fields.text({"cameramodel", "modeltype", "cameratype"});
  std::string low = projection;
  for (char& c : low) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (!low.empty() && low.find("pinhole") == std::string::npos &&
      low.find("perspective") == std::string::npos)
    throw BadInput("the camera model '" + projection.substr(0, 24) +
                   "' is not supported; known: pinhole. Calibrate with a pinhole model");
  std::string model = fields.text({"distortionmodel", "model", "distortiontype"});
  if (model.empty() && fields.text({"fisheyemodel", "fisheye"}) == "1") model = "equidistant";
  const std::vector<double> d = distortionOf(fields);
  setDistortion(camera, model, d.data(), d.size());
}

/// REP-104: K describes the whole sensor; the images show a window of it, binned.
void applyWindow(const CalibrationFields& fields, const YAML::Node& root, Camera* camera) {
  PixelWindow window{0, 0, camera->width, camera->height, 1, 1};
  window.bin_x = std::max(1, wholeNumber(fields.number({"binningx"}).value_or(0), "binning_x"));
  window.bin_y = std::max(1, wholeNumber(fields.number({"binningy"}).value_or(0), "binning_y"));
  if (root["roi"] && root["roi"].IsMap()) {
    YAML::Node copy;
    for (const auto& pair : root["roi"]) copy[pair.first.Scalar()] = pair.second;
    const CalibrationFields roi(copy);
    const int width = wholeNumber(roi.number({"width"}).value_or(0), "roi.width");
    const int height = wholeNumber(roi.number({"height"}).value_or(0), "roi.height");
    if (width > 0 && height > 0) {
      window.x = wholeNumber(roi.number({"xoffset"}).value_or(0), "roi.x_offset");
      window.y = wholeNumber(roi.number({"yoffset"}).value_or(0), "roi.y_offset");
      window.width = width;
      window.height = height;
    }
  }
  *camera = camera->seenThrough(window);
}

template <size_t n>
std::optional<std::array<double, n>> fixedList(const CalibrationFields& fields,
                                               std::initializer_list<const char*> names) {
  const auto list = fields.numbers(names);
  if (!list || list->size() != n) return std::nullopt;
  std::array<double, n> out;
  std::copy(list->begin(), list->end(), out.begin());
  return out;
}

CameraFile fromTree(const Tree& tree) {
  const CalibrationFields fields(tree.root);
  CameraFile out;
  out.kind = tree.kind;
  const bool any = fields.has({"cameramatrix", "k", "intrinsicmatrix", "intrinsics", "imagewidth", "width"});
  if (!any && !fields.has({"fx", "camerafx", "mtx", "imageheight", "height", "resolution"}))
    refuseAsNone("'camera_matrix' and 'image_width' are missing");

  readSize(fields, &out.camera);
  readFocal(fields, &out.camera);
  readDistortion(fields, &out.camera);
  out.name = fields.text({"cameraname"});
  out.rectification = fixedList<9>(fields, {"rectificationmatrix", "rectification", "r"});
  out.projection = fixedList<12>(fields, {"projectionmatrix", "projection", "p"});
  out.camera.check();
  applyWindow(fields, tree.root, &out.camera);
  out.warnings = cameraWarnings(out.camera);
  return out;
}

}  // namespace

std::vector<std::string> cameraWarnings(const Camera& camera) {
  const double u = camera.cx / camera.width - 0.5, v = camera.cy / camera.height - 0.5;
  if (std::abs(u) <= kFarFromMiddle && std::abs(v) <= kFarFromMiddle) return {};
  return {
      fmt::format("the principal point ({}, {}) px lies far from the middle of the image ({}x{}): is the "
                  "calibration that of another binning or of an image that was cropped? Then its poses are "
                  "wrong; calibrate images of this size",
                  plainNumber(camera.cx), plainNumber(camera.cy), camera.width, camera.height)};
}

CameraFile readCameraFile(const std::string& name) {
  const std::string path = resolvedPath(name);
  const std::string bytes = readFileBytes(path, "a camera calibration", kMaxBytes);
  const std::string foreign = foreignContent(bytes);
  if (!foreign.empty()) throw BadInput(path + ": this is " + foreign);

  std::string kind;
  try {
    const PlainText plain = plainText(bytes);
    if (looksBinary(plain.text)) refuseAsNone("the file is binary");
    const Tree tree = readTree(withLineFeeds(plain.text));
    kind = " (" + tree.kind + ")";
    CameraFile out = fromTree(tree);
    out.warnings.insert(out.warnings.begin(), plain.warnings.begin(), plain.warnings.end());
    return out;
  } catch (const BadInput& e) {
    throw BadInput(path + kind + ": " + e.what());
  } catch (const YAML::Exception& e) {
    throw BadInput(path + kind + ": this is no camera calibration (" + e.msg + "); " + kKnown);
  }
}

Camera loadCamera(const std::string& path) { return readCameraFile(path).camera; }

}  // namespace monocular_eye_hand
