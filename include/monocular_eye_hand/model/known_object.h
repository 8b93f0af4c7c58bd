#pragma once
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/rigid3.h"
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

/// A grasp that the user gives: where the hand goes, in the object's frame.
struct GivenGrasp {
  Rigid3 object_from_tcp;  ///< gripper_tcp: z out of the hand, y from pad to pad
  double width = 0;        ///< between the faces that the pads touch [m]
  int rotation_steps = 1;  ///< the grasp serves so many times, evenly turned about `axis`
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

}  // namespace monocular_eye_hand
