#pragma once
#include <functional>
#include <string>
#include <vector>

#include "monocular_eye_hand/model/characteristic_views.h"
#include "monocular_eye_hand/model/object_model.h"

namespace monocular_eye_hand {

/// How a CAD file becomes an ObjectModel.
struct ModelOptions {
  double sharp_angle = 0.35;     ///< smallest dihedral of a sharp edge [rad]
  double weld_tolerance = 1e-6;  ///< vertices nearer than this share of the diameter are one
  double symmetry_tolerance =
      2e-3;  ///< largest surface distance of a symmetric copy, as a share of the diameter
  bool find_symmetries = true;

  void check() const;
  /// Calls v("field", field) for every field: readers fill options by name.
  template <class Visitor>
  void visit(Visitor&& v) {
    v("sharp_angle", sharp_angle);
    v("weld_tolerance", weld_tolerance);
    v("symmetry_tolerance", symmetry_tolerance);
    v("find_symmetries", find_symmetries);
  }
};

/// Metres per unit: "m", "cm", "mm", "inch". Throws BadInput naming the known ones.
double metresPerUnit(const std::string& unit);

/// A mesh in metres with what was ignored or put right on reading it.
struct LoadedMesh {
  Mesh mesh;
  std::vector<std::string> warnings;  ///< without the path; also a unit of the file's own that is another
};

/// Reads STL, OBJ, PLY or DAE, told apart by content, then by the end of the name. Throws BadInput that names
/// what the file really is, or what is damaged and where, and what to do.
LoadedMesh readMesh(const std::string& path, const std::string& unit);
/// The mesh alone; its warnings are dropped.
Mesh loadMesh(const std::string& path, const std::string& unit);

/// Welds, finds surfaces, sharp edges, circles, corners, symmetries; fills warnings. Throws BadInput on an
/// empty mesh.
ObjectModel buildModel(const std::string& name, const Mesh& mesh, const ModelOptions& options = {});

/// A grasp that the user gives: where the hand goes, in the object's frame.
struct GivenGrasp {
  Rigid3 object_from_tcp;  ///< gripper_tcp: z out of the hand, y from pad to pad
  double width = 0;        ///< between the faces that the pads touch [m]
  int turns = 1;           ///< the grasp serves so many times, evenly turned about `axis`
  SymmetryAxis axis{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
};

/// What a robot may do with an object.
struct Handling {
  bool grasp = true;               ///< false: never grasped
  bool obstacle = false;           ///< true: something that other things lie in; implies grasp = false
  std::vector<GivenGrasp> grasps;  ///< empty: sampled from the CAD model
};

/// A known object with everything recognition needs, compiled once.
struct KnownObject {
  ObjectModel model;
  ViewSphere views;
  Handling handling{};
};

/// The known objects. Names are unique.
struct ModelBase {
  std::vector<KnownObject> objects;
  int indexOf(const std::string& name) const;  ///< -1 when unknown
  std::string names() const;                   ///< "bridge, grenade, ..." for messages
};

/// One entry of a model base file.
struct ObjectEntry {
  std::string name;
  std::string mesh;  ///< path; in the YAML as io/file_path.h, relative to the YAML
  std::string unit = "mm";
  ModelOptions options;
  Handling handling{};
};

/// Reads the list of objects of config/objects.yaml: `objects: [{name, mesh, unit, grasp, obstacle, grasps,
/// ...overrides}]`. Unknown keys, double names and missing files are BadInput.
std::vector<ObjectEntry> readObjectEntries(const std::string& yaml_path);

/// Takes a line of what is being done, before each step that may take long.
using CompileProgress = std::function<void(const std::string&)>;

/// Builds and compiles the entries, using the cache folder ("" = $XDG_CACHE_HOME or ~/.cache,
/// monocular_eye_hand/; "none" = no cache). A stale or damaged cache file is rebuilt. Throws BadInput; a
/// noisy scan is refused within seconds.
ModelBase compileModelBase(const std::vector<ObjectEntry>& entries, const ViewOptions& views = {},
                           const std::string& cache_dir = "", const CompileProgress& progress = {});
ModelBase loadModelBase(const std::string& yaml_path, const ViewOptions& views = {},
                        const std::string& cache_dir = "", const CompileProgress& progress = {});

}  // namespace monocular_eye_hand
