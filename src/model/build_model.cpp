#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/build_model.h"
#include "model/build_steps.h"
#include "model/contour_index.h"
#include "model/rounded_circles.h"
#include "model/rounded_edges.h"
#include "model/sharp_features.h"
#include "model/symmetry.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/plain_number.h"
#include "monocular_eye_hand/mesh/ray_scene.h"

namespace monocular_eye_hand {
namespace {

constexpr int kMaxSharpEdges = 20000;     // of a mesh; CAD parts of 100 000 triangles have half of it
constexpr size_t kManyModelEdges = 5000;  // straight edges of a model
constexpr size_t kManyTriangles = 200000;

/// A noisy scan has an edge between most of its triangles: it would take minutes and gigabytes, and none of
/// its edges is one that an image shows.
void refuseScan(const std::string& name, const Topology& topology, double sharp_angle) {
  const auto sharp = std::count_if(topology.edges.begin(), topology.edges.end(),
                                   [&](const MeshEdge& e) { return e.angle > sharp_angle; });
  if (sharp <= kMaxSharpEdges) return;
  throw BadInput(
      fmt::format("{}: this looks like a scan or a noisy mesh: {} of its {} edges are sharp, and an image "
                  "shows none of them. Use the part's CAD model, or smooth the scan and reduce it to some "
                  "thousand triangles (MeshLab: Quadric Edge Collapse Decimation)",
                  name, sharp, topology.edges.size()));
}

void warnAboutMesh(const RepairedMesh& repaired, ObjectModel* model) {
  auto& warnings = model->warnings;
  if (model->diameter < 0.005 || model->diameter > 5) {
    warnings.push_back(
        fmt::format("the diameter is {} mm: is the stated unit right?", plainNumber(1000 * model->diameter)));
  }

  if (repaired.rim_edges > 0) {
    warnings.push_back(fmt::format("the mesh is open: {} edges have only one triangle; faces may be missing",
                                   repaired.rim_edges));
  }
  if (repaired.crowded_edges > 0) {
    warnings.push_back(
        fmt::format("{} edges join more than two triangles: solids touch or overlap; unite them in CAD",
                    repaired.crowded_edges));
  }
  if (repaired.turned > 0) {
    warnings.push_back(
        fmt::format("{} triangles had their corners in the wrong order and were turned", repaired.turned));
  }
  if (repaired.inside_out) warnings.push_back("the mesh was inside out and was turned");
  if (repaired.degenerate > 0) {
    warnings.push_back(fmt::format("{} triangles without area were dropped", repaired.degenerate));
  }

  if (model->mesh.triangles.size() > kManyTriangles) {
    warnings.push_back(
        fmt::format("{} triangles are many more than an image can show: every start takes long; reduce them",
                    model->mesh.triangles.size()));
  }
  if (model->edges.size() > kManyModelEdges) {
    warnings.push_back(
        fmt::format("{} straight edges are more than a CAD part has: of a scan or a noisy mesh few are seen "
                    "in an image; smooth and reduce it, or use the CAD model",
                    model->edges.size()));
  }
  if (model->edges.empty() && model->circles.empty()) {
    warnings.push_back("no sharp edge or circle at all: only its outline can be recognised");
  }
}

SharpFeatures findFeatures(const Mesh& mesh, const Topology& topology, const SurfaceSplit& split,
                           double tolerance, double diameter) {
  SharpFeatures features = findSharpFeatures(mesh, topology, split, tolerance);
  addRoundedEdges(findRoundedEdges(mesh, topology, split, diameter), &features);
  const std::vector<ModelCircle> rounded = findRoundedCircles(mesh, topology, split, diameter);
  features.circles.insert(features.circles.end(), rounded.begin(), rounded.end());
  return features;
}

}  // namespace

void ModelOptions::check() const {
  const auto refuse = [](const char* field, double value, const char* rule) {
    throw BadInput(fmt::format("ModelOptions.{} is {:g}; it must be {}", field, value, rule));
  };
  if (!(sharp_angle >= 0.02 && sharp_angle <= 1.5)) refuse("sharp_angle", sharp_angle, "0.02 to 1.5 rad");
  if (!(weld_tolerance >= 0 && weld_tolerance <= 1e-2)) refuse("weld_tolerance", weld_tolerance, "0 to 0.01");
  if (!(symmetry_tolerance > 0 && symmetry_tolerance <= 0.05)) {
    refuse("symmetry_tolerance", symmetry_tolerance, "above 0, at most 0.05");
  }
}

std::string turnText(const Rigid3& motion) {
  const Eigen::AngleAxisd turn(motion.rotation);
  return fmt::format("{:.4g} deg about ({:.3g}, {:.3g}, {:.3g})", turn.angle() * 57.29577951308232,
                     turn.axis().x(), turn.axis().y(), turn.axis().z());
}

RepairedModel repairedModel(const std::string& name, const Mesh& mesh, const ModelOptions& options) {
  options.check();
  RepairedModel out;
  out.found = repairMesh(name, mesh, options.weld_tolerance);
  ObjectModel& model = out.model;
  model.name = name;
  model.mesh = std::move(out.found.mesh);
  for (const Eigen::Vector3d& v : model.mesh.vertices) model.bounds.extend(v);
  model.diameter = meshDiameter(model.mesh.vertices);
  model.closed = out.found.closed;
  return out;
}

ObjectModel buildShape(const std::string& name, const Mesh& mesh, const ModelOptions& options) {
  RepairedModel start = repairedModel(name, mesh, options);
  const RepairedMesh& repaired = start.found;
  ObjectModel model = std::move(start.model);

  const Topology topology = buildTopology(model.mesh);
  refuseScan(name, topology, options.sharp_angle);
  SurfaceSplit split = splitSurfaces(model.mesh, topology, options.sharp_angle, repaired.tolerance);
  SharpFeatures features = findFeatures(model.mesh, topology, split, repaired.tolerance, model.diameter);

  model.surfaces = std::move(split.surfaces);
  model.surface_of_triangle = std::move(split.surface_of_triangle);
  model.tessellation_error = split.tessellation_error;
  model.edges = std::move(features.edges);
  model.circles = std::move(features.circles);
  model.corners = std::move(features.corners);
  for (const ModelCircle& c : model.circles) {
    model.tessellation_error = std::max(model.tessellation_error, c.radius * (1 - std::cos(0.5 * c.segment)));
  }

  model.rays = std::make_shared<RayScene>(model.mesh);
  model.contour_index = std::make_shared<ContourIndex>(model, topology, split.sharp);
  warnAboutMesh(repaired, &model);
  return model;
}

SymmetryResult symmetriesOf(const ObjectModel& model, const ModelOptions& options) {
  if (!options.find_symmetries) return {};
  return findSymmetries(model, options.symmetry_tolerance * model.diameter);
}

void setSymmetries(const SymmetryResult& found, ObjectModel* model) {
  model->symmetries = found.symmetries;
  if (found.twins.empty()) return;
  const NearSymmetry& t = found.twins.front();
  const std::string share =
      t.differing < 0.001 ? "less than 0.1" : fmt::format("only {:.1f}", 100 * t.differing);
  model->warnings.push_back("nearly symmetric: turned by " + turnText(t.motion) + " " + share +
                            " % of its surface differs; such views are easily taken for each other");
}

ObjectModel buildModel(const std::string& name, const Mesh& mesh, const ModelOptions& options) {
  ObjectModel model = buildShape(name, mesh, options);
  setSymmetries(symmetriesOf(model, options), &model);
  return model;
}

}  // namespace monocular_eye_hand
