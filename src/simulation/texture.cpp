#include "texture.h"

#include <cmath>

#include "random.h"

namespace monocular_eye_hand {
namespace {

double lattice(int x, int y, int z, uint32_t seed) {
  return 2 * unitInterval(mixBits(mixBits(mixBits(seed, uint32_t(x)), uint32_t(y)), uint32_t(z))) - 1;
}

// Value noise, -1..1, one blotch per unit.
double noise(const Eigen::Vector3d& p, uint32_t seed) {
  const Eigen::Vector3d cell = p.array().floor();
  const Eigen::Vector3d f = p - cell;
  const Eigen::Vector3d s = f.array().square() * (3 - 2 * f.array());
  const int x = int(cell.x()), y = int(cell.y()), z = int(cell.z());
  double value = 0;
  for (int k = 0; k < 8; ++k) {
    const int dx = k & 1, dy = (k >> 1) & 1, dz = k >> 2;
    value += (dx ? s.x() : 1 - s.x()) * (dy ? s.y() : 1 - s.y()) * (dz ? s.z() : 1 - s.z()) *
             lattice(x + dx, y + dy, z + dz, seed);
  }
  return value;
}

double fractalNoise(const Eigen::Vector3d& p, uint32_t seed) {
  double sum = 0, weight = 0.5, frequency = 1;
  for (uint32_t octave = 0; octave < 4; ++octave, weight *= 0.5, frequency *= 2.03)
    sum += weight * noise(p * frequency, mixBits(seed, octave));
  return sum * 1.6;
}

double wood(const Eigen::Vector3d& p, double scale, uint32_t seed) {
  // Rings about an axis along x below the table, bent by slow noise, with fine grain along x.
  const Eigen::Vector3d q = p / scale;
  const double bend = 1.1 * noise({q.x() * 0.12, q.y() * 0.35, q.z() * 0.35}, seed);
  const double ring = std::hypot(q.y() + 1.7, q.z() + 3.3) + bend;
  const double phase = ring - std::floor(ring);
  const double late_wood = phase < 0.8 ? phase / 0.8 : (1 - phase) / 0.2;
  const double grain = noise({q.x() * 0.8, q.y() * 14, q.z() * 14}, mixBits(seed, 7));
  return 0.75 * (1 - 2 * late_wood * late_wood) + 0.25 * grain;
}

double bricks(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double scale, uint32_t seed) {
  int axis;
  n.cwiseAbs().maxCoeff(&axis);
  const double u = p[(axis + 1) % 3] / scale, v = p[(axis + 2) % 3] / (0.5 * scale);
  const int row = int(std::floor(v));
  const double shifted = u + (row & 1 ? 0.5 : 0.0);
  const int column = int(std::floor(shifted));
  const double fu = shifted - column, fv = v - row;
  if (fu < 0.05 || fu > 0.95 || fv < 0.1 || fv > 0.9) return -1;
  return 0.45 + 0.55 * lattice(column, row, axis, seed);
}

}  // namespace

double textureFactor(const Texture& texture, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
  double value = 0;
  switch (texture.kind) {
    case Texture::Kind::kPlain:
      return 1;
    case Texture::Kind::kNoise:
      value = fractalNoise(p / texture.scale, texture.seed);
      break;
    case Texture::Kind::kChecker: {
      // Slightly off the origin: faces through it would lie on the border of two checks.
      const Eigen::Vector3d q = (p / texture.scale).array() + 0.137;
      const long sum = long(std::floor(q.x())) + long(std::floor(q.y())) + long(std::floor(q.z()));
      value = sum & 1 ? 1 : -1;
      break;
    }
    case Texture::Kind::kWood:
      value = wood(p, texture.scale, texture.seed);
      break;
    case Texture::Kind::kBricks:
      value = bricks(p, n, texture.scale, texture.seed);
      break;
  }
  return 1 + texture.amplitude * std::max(-1.0, std::min(1.0, value));
}

}  // namespace monocular_eye_hand
