#pragma once
#include <array>
#include <string>
#include <vector>

#include "monocular_eye_hand/geometry/camera.h"
#include "monocular_eye_hand/simulation/scene.h"

namespace monocular_eye_hand {

// What a work cell file may say. Everything that stands on the table is placed in the table's frame: origin
// in the middle of its top, axes parallel to base_link when the table is not turned.

/// Position [m] and roll, pitch, yaw about the fixed axes x, y, z [rad], as tf has them.
struct CellPose {
  double x = 0, y = 0, z = 0, roll = 0, pitch = 0, yaw = 0;

  void check() const;  ///< throws BadInput naming field, value and rule; so do all below
  Rigid3 transform() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("x", x);
    v("y", y);
    v("z", z);
    v("roll", roll);
    v("pitch", pitch);
    v("yaw", yaw);
  }
};

struct CellTexture {
  std::string kind = "plain";  ///< plain, noise, checker, wood or bricks
  double scale = 0.02;         ///< [m]
  double amplitude = 0.2;      ///< 0..1
  int seed = 0;

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("kind", kind);
    v("scale", scale);
    v("amplitude", amplitude);
    v("seed", seed);
  }
};

struct CellMaterial {
  double albedo = 0.6;    ///< 0..1
  double specular = 0.1;  ///< 0..1
  double shininess = 40;  ///< Blinn exponent
  CellTexture texture;

  void check() const;
  Material material() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("albedo", albedo);
    v("specular", specular);
    v("shininess", shininess);
    v("texture", texture);
  }
};

struct CellTable {
  CellPose pose;                                       ///< base_link from the table's frame
  double length = 0.6, width = 1.0, thickness = 0.03;  ///< along x, y, down from the top [m]
  CellMaterial material;

  CellTable();
  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("pose", pose);
    v("length", length);
    v("width", width);
    v("thickness", thickness);
    v("material", material);
  }
};

/// Disc that faces the middle of the table.
struct CellLight {
  double x = -0.4, y = -0.5, z = 1.2;  ///< table's frame [m]
  double radius = 0.15;                ///< [m]
  double intensity = 1;                ///< irradiance at 1 m

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("x", x);
    v("y", y);
    v("z", z);
    v("radius", radius);
    v("intensity", intensity);
  }
};

/// The wrist camera; its place in the hand is the URDF's.
struct CellCameraOptions {
  int width = 640, height = 480;                                    ///< [px]
  double fx = 600, fy = 600, cx = 319.5, cy = 239.5;                ///< [px]
  std::vector<double> distortion{-0.11, 0.06, 0.0006, -0.0004, 0};  ///< OpenCV's order; 0, 5 or 8 numbers
  double blur_sigma = 0.5;                                          ///< of the lens [px]
  double noise_sigma = 1.5;                                         ///< sensor noise at black [grey levels]
  double shot_noise = 0.01;  ///< its variance grows by this per grey level
  double exposure = 0;       ///< grey = 255 (exposure radiance)^(1/gamma); 0: chosen for every image
  double gamma = 1;
  bool shadows = true;

  void check() const;
  Camera camera() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("width", width);
    v("height", height);
    v("fx", fx);
    v("fy", fy);
    v("cx", cx);
    v("cy", cy);
    v("distortion", distortion);
    v("blur_sigma", blur_sigma);
    v("noise_sigma", noise_sigma);
    v("shot_noise", shot_noise);
    v("exposure", exposure);
    v("gamma", gamma);
    v("shadows", shadows);
  }
};

/// Rectangle on the table into which the parts are carried.
struct CellDropZone {
  double x = -0.05, y = 0.33;          ///< middle, table's frame [m]
  double length = 0.36, width = 0.26;  ///< along x and y [m]

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("x", x);
    v("y", y);
    v("length", length);
    v("width", width);
  }
};

struct CellObject {
  std::string name;  ///< in the model base
  CellPose pose;     ///< table's frame from the object's frame
  CellMaterial material;
  bool fixed = false;  ///< too heavy or screwed down: cannot be carried

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("name", name);
    v("pose", pose);
    v("material", material);
    v("fixed", fixed);
  }
};

/// A seeded arrangement instead of the list of objects: the frame and parts inside its opening.
struct CellRandom {
  int seed = -1;    ///< >= 0: arrange at random; -1: take `objects`, `lights`, table as they stand
  int objects = 3;  ///< parts inside the frame
  std::string frame = "frame";     ///< model that is the frame; never one of the parts
  std::vector<std::string> parts;  ///< models to draw from; empty: all but the frame
  double gripper_width = 0.085;    ///< only poses that a gripper opening so far can hold from above [m]
  double finger_room = 0.022;      ///< free space beside the two faces to be held [m]
  double gap = 0.008;              ///< least distance between parts and to the frame [m]
  bool lights = true;              ///< draw lights and materials too

  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("seed", seed);
    v("objects", objects);
    v("frame", frame);
    v("parts", parts);
    v("gripper_width", gripper_width);
    v("finger_room", finger_room);
    v("gap", gap);
    v("lights", lights);
  }
};

/// A work cell: defaults stand here and nowhere else. Two bridges and a grenade in the frame.
struct CellOptions {
  CellTable table;
  std::vector<CellLight> lights;
  double ambient = 0.38;     ///< irradiance from everywhere
  double background = 0.10;  ///< radiance where nothing is
  CellCameraOptions camera;
  CellDropZone drop_zone;
  std::vector<CellObject> objects;
  CellRandom random;
  std::array<double, 6> start_joints{{0, 0, 0, 0, 0, 0}};  ///< of the arm [rad]; set by the constructor
  double start_width = 0.06;                               ///< of the gripper [m]
  double gripper_speed = 0.1;                              ///< change of the opening [m/s]
  double friction = 0.5;                                   ///< of the finger pads, Coulomb
  double pad_compliance = 5e-4;      ///< a pad gives way by so much to a part that cannot move [m]
  double contact_tolerance = 0.001;  ///< deeper penetration is a collision [m]
  double step = 0.005;               ///< of the simulation [s]
  int seed = 1;                      ///< of the camera's noise

  CellOptions();
  void check() const;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("table", table);
    v("lights", lights);
    v("ambient", ambient);
    v("background", background);
    v("camera", camera);
    v("drop_zone", drop_zone);
    v("objects", objects);
    v("random", random);
    v("start_joints", start_joints);
    v("start_width", start_width);
    v("gripper_speed", gripper_speed);
    v("friction", friction);
    v("pad_compliance", pad_compliance);
    v("contact_tolerance", contact_tolerance);
    v("step", step);
    v("seed", seed);
  }
};

}  // namespace monocular_eye_hand
