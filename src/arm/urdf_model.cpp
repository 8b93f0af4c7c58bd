#include "arm/urdf_model.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/file_path.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

/// Keeps what urdfdom would print while it is in scope. The handler is one per process.
class Complaints : public console_bridge::OutputHandler {
 public:
  Complaints() : lock_(mutex()) { console_bridge::useOutputHandler(this); }
  ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
  std::string text_;
};

/// The file that a mesh is in. One of a package is first looked for beside and above the URDF, which lies in
/// the package most of the time.
std::string findMesh(const std::string& name, const std::string& urdf_path) {
  const fs::path folder = fs::absolute(urdf_path).parent_path();
  const std::string package = "package://";
  if (name.compare(0, package.size(), package) != 0) return resolvedPath(name, folder.string());
  const size_t slash = name.find('/', package.size());
  const std::string rest = slash == std::string::npos ? "" : name.substr(slash + 1);
  for (fs::path at = folder; !rest.empty(); at = at.parent_path()) {
    if (fs::is_regular_file(at / rest)) return (at / rest).string();
    if (at == at.parent_path()) break;
  }
  try {
    return resolvedPath(name, folder.string());
  } catch (const BadInput& e) {
    throw BadInput("mesh " + name + " is neither in the folder of the URDF nor in one above it; " + e.what());
  }
}

std::shared_ptr<const Mesh> readMesh(const urdf::Mesh& shape, const std::string& urdf_path) {
  auto mesh = std::make_shared<Mesh>(loadMesh(findMesh(shape.filename, urdf_path), "m"));
  const Eigen::Vector3d scale(shape.scale.x, shape.scale.y, shape.scale.z);
  if (!scale.allFinite() || scale.minCoeff() <= 0)
    throw BadInput("mesh " + shape.filename + ": the scale must be above 0 in x, y and z");
  for (Eigen::Vector3d& vertex : mesh->vertices) vertex = vertex.cwiseProduct(scale);
  return mesh;
}

ArmShape readShape(const urdf::Geometry* geometry, const urdf::Pose& origin, const std::string& urdf_path) {
  ArmShape shape;
  shape.link_from_shape = toRigid(origin);
  if (!geometry) throw BadInput("a shape without <geometry>");

  if (geometry->type == urdf::Geometry::BOX) {
    const urdf::Vector3& dim = static_cast<const urdf::Box*>(geometry)->dim;
    shape.kind = ArmShape::Kind::kBox;
    shape.size = {dim.x, dim.y, dim.z};
  } else if (geometry->type == urdf::Geometry::CYLINDER) {
    const auto* cylinder = static_cast<const urdf::Cylinder*>(geometry);
    shape.kind = ArmShape::Kind::kCylinder;
    shape.size = {cylinder->radius, cylinder->radius, cylinder->length};
  } else if (geometry->type == urdf::Geometry::MESH) {
    shape.kind = ArmShape::Kind::kMesh;
    shape.mesh = readMesh(*static_cast<const urdf::Mesh*>(geometry), urdf_path);
    return shape;
  } else {
    throw BadInput("a sphere; only boxes, cylinders and meshes are supported");
  }

  if (!shape.size.allFinite() || shape.size.minCoeff() <= 0) throw BadInput("a box or cylinder of no size");
  return shape;
}

}  // namespace

urdf::ModelInterfaceSharedPtr readUrdf(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  if (!fs::is_regular_file(path) || !(text << file.rdbuf()))
    throw BadInput(path + ": cannot be read; give the path of a URDF file");
  const Complaints complaints;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text.str());
  } catch (const std::exception& e) {
    throw BadInput(path + ": is no URDF: " + e.what());
  }
  if (!model || !model->getRoot())
    throw BadInput(path +
                   ": is no URDF: " + (complaints.text().empty() ? "no robot in it" : complaints.text()));
  return model;
}

Rigid3 toRigid(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return {Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix(),
          {pose.position.x, pose.position.y, pose.position.z}};
}

void readShapes(const urdf::Link& link, const std::string& urdf_path, ArmLink* out) {
  for (const auto& collision : link.collision_array)
    out->collision.push_back(readShape(collision->geometry.get(), collision->origin, urdf_path));
  for (const auto& visual : link.visual_array) {
    out->visual.push_back(readShape(visual->geometry.get(), visual->origin, urdf_path));
    if (!visual->material) continue;
    const urdf::Color& colour = visual->material->color;
    out->visual.back().colour = {colour.r, colour.g, colour.b};
  }
}

}  // namespace monocular_eye_hand
