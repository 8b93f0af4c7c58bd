#include <fmt/format.h>

// What the package sees in CAD files: size, surfaces, edges, circles, symmetries, views, warnings, and a
// picture.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/model_base.h"
#include "tools/model_picture.h"

namespace monocular_eye_hand {
namespace {

struct Arguments {
  std::vector<std::string> files;
  std::string unit = "mm", png, json;
};

bool isYaml(const std::string& path) {
  const auto ends = [&](const std::string& end) {
    return path.size() > end.size() && path.compare(path.size() - end.size(), end.size(), end) == 0;
  };
  return ends(".yaml") || ends(".yml");
}

/// "flange" of "parts/flange.stl"; a number is added when the name is taken.
std::string nameOf(const std::string& path, const std::vector<ObjectEntry>& taken) {
  const size_t slash = path.rfind('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  const std::string stem = file.substr(0, file.rfind('.'));
  std::string name = stem;
  for (int n = 2;
       std::any_of(taken.begin(), taken.end(), [&](const ObjectEntry& e) { return e.name == name; }); ++n) {
    name = fmt::format("{}_{}", stem, n);
  }
  return name;
}

std::vector<ObjectEntry> entriesOf(const Arguments& arguments) {
  metresPerUnit(arguments.unit);
  std::vector<ObjectEntry> entries;
  for (const std::string& file : arguments.files) {
    if (!isYaml(file)) {
      ObjectEntry entry;
      entry.name = nameOf(file, entries);
      entry.mesh = file;
      entry.unit = arguments.unit;
      entries.push_back(entry);
      continue;
    }
    for (const ObjectEntry& entry : readObjectEntries(file)) entries.push_back(entry);
  }
  return entries;
}

std::string symmetryText(const Symmetries& s) {
  if (s.sphere) return "sphere: every rotation about its centre";
  const std::string poses =
      fmt::format("{}{}", s.discrete.size(), s.discrete.size() == 1 ? " pose" : " equal poses");
  if (!s.axis) return s.discrete.size() == 1 ? "none" : poses;
  const Eigen::Vector3d &d = s.axis->direction, p = 1000 * s.axis->point;
  return fmt::format("free about the axis ({:.4g}, {:.4g}, {:.4g}) through ({:.3f}, {:.3f}, {:.3f}) mm{}",
                     d.x() + 0.0, d.y() + 0.0, d.z() + 0.0, p.x(), p.y(), p.z(),
                     s.discrete.size() > 1 ? ", and a flip" : "");
}

int count(const ObjectModel& m, Surface::Kind kind) {
  return int(
      std::count_if(m.surfaces.begin(), m.surfaces.end(), [&](const Surface& s) { return s.kind == kind; }));
}

int fullCircles(const ObjectModel& m) {
  return int(
      std::count_if(m.circles.begin(), m.circles.end(), [](const ModelCircle& c) { return c.full(); }));
}

template <class Feature>
int rounded(const std::vector<Feature>& features) {
  return int(
      std::count_if(features.begin(), features.end(), [](const Feature& f) { return f.rounding > 0; }));
}

std::vector<std::string> describe(const KnownObject& object) {
  const ObjectModel& m = object.model;
  const Eigen::Vector3d size = 1000 * m.bounds.sizes(), low = 1000 * m.bounds.min();
  const int full = fullCircles(m);

  std::vector<std::string> lines;
  lines.push_back(m.name);
  lines.push_back(fmt::format("  size        {:.2f} x {:.2f} x {:.2f} mm, diameter {:.2f} mm", size.x(),
                              size.y(), size.z(), 1000 * m.diameter));
  lines.push_back(fmt::format("  lowest      ({:.2f}, {:.2f}, {:.2f}) mm", low.x(), low.y(), low.z()));
  lines.push_back(fmt::format("  mesh        {} triangles, {} vertices, {}", m.mesh.triangles.size(),
                              m.mesh.vertices.size(), m.closed ? "closed" : "open"));

  lines.push_back(fmt::format("  faces       {} planes, {} cylinders, {} free forms",
                              count(m, Surface::Kind::kPlane), count(m, Surface::Kind::kCylinder),
                              count(m, Surface::Kind::kFreeform)));
  lines.push_back(fmt::format("  edges       {} straight, {} corners", m.edges.size(), m.corners.size()));
  lines.push_back(fmt::format("  circles     {} full, {} arcs", full, m.circles.size() - full));
  if (rounded(m.edges) + rounded(m.circles) > 0)
    lines.push_back(fmt::format("  of these    {} edges and {} circles or arcs are rounded", rounded(m.edges),
                                rounded(m.circles)));

  lines.push_back("  symmetry    " + symmetryText(m.symmetries));
  lines.push_back(fmt::format("  views       {} directions x {} distances, {} characteristic views",
                              object.views.directions, object.views.distances.size(),
                              object.views.characteristic.size()));
  for (const std::string& w : m.warnings) lines.push_back("  warning     " + w);
  return lines;
}

nlohmann::json asJson(const KnownObject& object) {
  const ObjectModel& m = object.model;
  const auto list = [](const Eigen::Vector3d& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };

  nlohmann::json j;
  j["name"] = m.name;
  j["size_m"] = list(m.bounds.sizes());
  j["min_m"] = list(m.bounds.min());
  j["diameter_m"] = m.diameter;
  j["triangles"] = m.mesh.triangles.size();
  j["closed"] = m.closed;

  j["planes"] = count(m, Surface::Kind::kPlane);
  j["cylinders"] = count(m, Surface::Kind::kCylinder);
  j["freeforms"] = count(m, Surface::Kind::kFreeform);
  j["edges"] = m.edges.size();
  j["corners"] = m.corners.size();
  j["circles"] = fullCircles(m);
  j["arcs"] = m.circles.size() - fullCircles(m);
  j["rounded_edges"] = rounded(m.edges);
  j["rounded_circles"] = rounded(m.circles);

  j["equal_poses"] = m.symmetries.discrete.size();
  for (const Rigid3& s : m.symmetries.discrete)
    j["equal_pose_transforms"].push_back(
        {{"rotation", {list(s.rotation.row(0)), list(s.rotation.row(1)), list(s.rotation.row(2))}},
         {"translation_m", list(s.translation)}});
  j["sphere"] = m.symmetries.sphere;
  if (m.symmetries.axis) {
    j["axis"] = {{"direction", list(m.symmetries.axis->direction)},
                 {"point_m", list(m.symmetries.axis->point)}};
  }

  j["view_directions"] = object.views.directions;
  j["characteristic_views"] = object.views.characteristic.size();
  j["warnings"] = m.warnings;
  return j;
}

void check(const Arguments& arguments) {
  const ModelBase base =
      compileModels(entriesOf(arguments), ModelDepth::kViews, {}, "",
                    [](const std::string& step) { std::cerr << "model_check: " << step << std::endl; });

  nlohmann::json report = nlohmann::json::array();
  std::vector<cv::Mat> pictures;
  for (const KnownObject& object : base.objects) {
    const std::vector<std::string> lines = describe(object);
    for (const std::string& line : lines) std::cout << line << "\n";
    report.push_back(asJson(object));
    if (!arguments.png.empty()) pictures.push_back(modelPicture(object.model, lines));
  }

  if (!arguments.json.empty()) {
    std::ofstream out(arguments.json);
    out << report.dump(2) << "\n";
    out.close();
    if (!out) throw BadInput(arguments.json + ": cannot be written; check the folder");
  }

  if (pictures.empty()) return;
  cv::Mat all;
  cv::vconcat(pictures, all);
  bool written = false;
  try {
    written = cv::imwrite(arguments.png, all);
  } catch (const cv::Exception&) {
  }
  if (!written)
    throw BadInput(arguments.png + ": cannot be written; check the folder, and that the name ends in .png");
}

}  // namespace
}  // namespace monocular_eye_hand

int main(int argc, char** argv) {
  monocular_eye_hand::Arguments arguments;
  CLI::App app(
      "Shows what recognition can see in CAD files: size, faces, edges, circles, symmetries, views, "
      "warnings.");

  app.add_option("FILE", arguments.files, "STL, OBJ, PLY or DAE files, or a model base (.yaml)")->required();
  app.add_option("--unit", arguments.unit,
                 "what one unit of the files is: m, cm, mm, inch (a .yaml states its own)")
      ->capture_default_str();
  app.add_option("--png", arguments.png, "draw the models, one below the other");
  app.add_option("--json", arguments.json, "write the figures");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }

  try {
    monocular_eye_hand::check(arguments);
  } catch (const monocular_eye_hand::BadInput& e) {
    std::cerr << "model_check: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
