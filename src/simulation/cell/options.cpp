#include "monocular_eye_hand/simulation/cell/options.h"

#include <cmath>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/geometry/require.h"

namespace monocular_eye_hand {
namespace {

bool in(double value, double low, double high) { return value >= low && value <= high; }

Texture::Kind textureKind(const std::string& kind) {
  if (kind == "plain") return Texture::Kind::kPlain;
  if (kind == "noise") return Texture::Kind::kNoise;
  if (kind == "checker") return Texture::Kind::kChecker;
  if (kind == "wood") return Texture::Kind::kWood;
  if (kind == "bricks") return Texture::Kind::kBricks;
  throw BadInput("kind = " + kind + " must be plain, noise, checker, wood or bricks");
}

CellObject object(const char* name, double x, double y, double yaw, double albedo) {
  CellObject out;
  out.name = name;
  out.pose.x = x;
  out.pose.y = y;
  out.pose.yaw = yaw;
  out.material.albedo = albedo;
  out.material.shininess = 35;
  return out;
}

}  // namespace

Rigid3 CellPose::transform() const {
  return {expSO3({0, 0, yaw}) * expSO3({0, pitch, 0}) * expSO3({roll, 0, 0}), {x, y, z}};
}

void CellPose::check() const {
  const double values[] = {x, y, z, roll, pitch, yaw};
  const char* names[] = {"x", "y", "z", "roll", "pitch", "yaw"};
  for (int k = 0; k < 6; ++k)
    require(in(values[k], -20, 20), names[k], values[k], "finite and within +-20 (metres, radians)");
}

void CellTexture::check() const {
  textureKind(kind);
  require(in(scale, 1e-4, 10), "scale", scale, "0.0001..10 m");
  require(in(amplitude, 0, 1), "amplitude", amplitude, "0..1");
}

void CellMaterial::check() const {
  require(in(albedo, 0, 1), "albedo", albedo, "0..1");
  require(in(specular, 0, 1), "specular", specular, "0..1");
  require(in(shininess, 1, 1000), "shininess", shininess, "1..1000");
}

Material CellMaterial::material() const {
  return {albedo,
          specular,
          shininess,
          {textureKind(texture.kind), texture.scale, texture.amplitude, uint32_t(texture.seed)}};
}

CellTable::CellTable() {
  pose.x = 0.55;
  pose.z = 0.30;
  material.albedo = 0.30;
  material.specular = 0.03;
  material.shininess = 15;
  material.texture.kind = "wood";
  material.texture.scale = 0.018;
  material.texture.amplitude = 0.22;
  material.texture.seed = 3;
}

void CellTable::check() const {
  require(pose.roll == 0, "pose.roll", pose.roll, "0: objects would slide off");
  require(pose.pitch == 0, "pose.pitch", pose.pitch, "0: objects would slide off");
  require(pose.z > 0, "pose.z", pose.z, "above the floor (z = 0)");
  require(in(length, 0.1, 5), "length", length, "0.1..5 m");
  require(in(width, 0.1, 5), "width", width, "0.1..5 m");
  require(in(thickness, 0.001, 1) && thickness <= pose.z, "thickness", thickness,
          "0.001..1 m and end above the floor");
}

void CellLight::check() const {
  requireFinite("x", x);
  requireFinite("y", y);
  require(in(z, 0.05, 20), "z", z, "0.05..20 m above the table");
  require(in(radius, 0, 5), "radius", radius, "0..5 m");
  require(in(intensity, 0, 1000), "intensity", intensity, "0..1000");
}

void CellCameraOptions::check() const {
  require(in(width, 16, 8192), "width", width, "16..8192 px");
  require(in(height, 16, 8192), "height", height, "16..8192 px");
  require(in(blur_sigma, 0, 20), "blur_sigma", blur_sigma, "0..20 px");
  require(in(noise_sigma, 0, 100), "noise_sigma", noise_sigma, "0..100 grey levels");
  require(in(shot_noise, 0, 10), "shot_noise", shot_noise, "0..10");
  require(in(exposure, 0, 1e6), "exposure", exposure, ">= 0 (0: automatic)");
  require(in(gamma, 0.1, 10), "gamma", gamma, "0.1..10");
  const size_t n = distortion.size();
  require(n == 0 || n == 5 || n == 8, "distortion", n, "0, 5 (plumb_bob) or 8 (rational) numbers");
  camera().check();
}

Camera CellCameraOptions::camera() const {
  Camera out{width, height, fx, fy, cx, cy, DistortionModel::kNone, {}};
  if (!distortion.empty())
    setDistortion(&out, distortion.size() == 8 ? "rational_polynomial" : "plumb_bob", distortion.data(),
                  distortion.size());
  return out;
}

void CellDropZone::check() const {
  requireFinite("x", x);
  requireFinite("y", y);
  require(in(length, 0.02, 5), "length", length, "0.02..5 m");
  require(in(width, 0.02, 5), "width", width, "0.02..5 m");
}

void CellObject::check() const {
  if (name.empty()) throw BadInput("name is missing: give an object of the model base");
}

void CellRandom::check() const {
  require(seed >= -1, "seed", seed, ">= 0, or -1 for none");
  require(in(objects, 0, 20), "objects", objects, "0..20");
  require(in(gripper_width, 0.005, 1), "gripper_width", gripper_width, "0.005..1 m");
  require(in(finger_room, 0, 0.2), "finger_room", finger_room, "0..0.2 m");
  require(in(gap, 0, 0.2), "gap", gap, "0..0.2 m");
}

CellOptions::CellOptions() {
  CellLight second;
  second.x = 0.55;
  second.y = 0.45;
  second.z = 1.1;
  second.radius = 0.2;
  second.intensity = 0.4;
  lights = {CellLight(), second};
  lights[0].intensity = 0.85;
  objects = {object("frame", 0, 0, 0, 0.66), object("bridge", -0.045, 0.043, 0.07, 0.74),
             object("bridge", 0.078, 0.0, 1.48, 0.70), object("grenade", -0.040, -0.036, 0.35, 0.60)};
  objects[0].fixed = true;
  start_joints = {0, M_PI / 2, -M_PI / 2, 0, 0, 0};  // "ready": the arm straight up
}

void CellOptions::check() const {
  require(in(ambient, 0, 100), "ambient", ambient, "0..100");
  require(in(background, 0, 100), "background", background, "0..100");
  for (double q : start_joints) require(in(q, -10, 10), "start_joints", q, "within +-10 rad");
  require(in(start_width, 0, 1), "start_width", start_width, "0..1 m");
  require(in(gripper_speed, 1e-3, 10), "gripper_speed", gripper_speed, "0.001..10 m/s");
  require(in(friction, 0.01, 10), "friction", friction, "0.01..10");
  require(in(pad_compliance, 0, 0.01), "pad_compliance", pad_compliance, "0..0.01 m");
  require(in(contact_tolerance, 0, 0.01), "contact_tolerance", contact_tolerance, "0..0.01 m");
  require(in(step, 1e-4, 0.1), "step", step, "0.0001..0.1 s");
  const double reach_x = std::abs(drop_zone.x) + drop_zone.length / 2,
               reach_y = std::abs(drop_zone.y) + drop_zone.width / 2;
  if (reach_x > table.length / 2 || reach_y > table.width / 2)
    throw BadInput("drop_zone: its far corner must lie on the table");
}

}  // namespace monocular_eye_hand
