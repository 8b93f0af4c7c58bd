#include "simulation/render/texture.h"

#include <cmath>

#include "monocular_eye_hand/geometry/random.h"

namespace monocular_eye_hand {
namespace {

double lattice(int x, int y, int z, uint32_t seed) {
  const uint32_t cell = uint32_t(x) * 0x8da6b343u ^ uint32_t(y) * 0xd8163841u ^ uint32_t(z) * 0xcb1ab31fu;
  return 2 * unitInterval(mixBits(cell + seed)) - 1;
}

double mix(double a, double b, double share) { return a + share * (b - a); }

// Value noise, -1..1, one blotch per unit.
double noise(const Eigen::Vector3d& p, uint32_t seed) {
  const double fx = std::floor(p.x()), fy = std::floor(p.y()), fz = std::floor(p.z());
  const int x = int(fx), y = int(fy), z = int(fz);
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double sx = smooth(p.x() - fx), sy = smooth(p.y() - fy), sz = smooth(p.z() - fz);
  const auto row = [&](int dy, int dz) {
    return mix(lattice(x, y + dy, z + dz, seed), lattice(x + 1, y + dy, z + dz, seed), sx);
  };
  return mix(mix(row(0, 0), row(1, 0), sy), mix(row(0, 1), row(1, 1), sy), sz);
}

double fractalNoise(const Eigen::Vector3d& p, uint32_t seed) {
  double sum = 0, weight = 0.5, frequency = 1;
  for (uint32_t octave = 0; octave < 4; ++octave, weight *= 0.5, frequency *= 2.03)
    sum += weight * noise(p * frequency, mixBits(seed, octave));
  return sum * 1.6;
}

double wood(const Eigen::Vector3d& p, double scale, uint32_t seed) {
  // Year rings about an axis along x below the table, bent by slow noise; pores drawn out along x.
  const Eigen::Vector3d q = p / scale;
  const double bend = 1.6 * noise({q.x() * 0.05, q.y() * 0.22, q.z() * 0.22}, seed);
  const double ring = 0.8 * std::hypot(q.y() + 1.7, q.z() + 5.3) + bend;
  const double phase = ring - std::floor(ring);
  const double late_wood = phase < 0.7 ? phase / 0.7 : (1 - phase) / 0.3;
  const double pores = noise({q.x() * 0.6, q.y() * 12, q.z() * 12}, mixBits(seed, 7));
  const double blotches = noise({q.x() * 0.2, q.y() * 1.3, q.z() * 1.3}, mixBits(seed, 9));
  return 0.35 * (1 - 2 * late_wood * late_wood) + 0.4 * pores + 0.25 * blotches;
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
