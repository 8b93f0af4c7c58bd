#include "simulation/scenes/clutter.h"

#include <Eigen/Geometry>
#include <cmath>

#include "simulation/scenes/clutter_shapes.h"
#include "simulation/scenes/random_draws.h"

namespace monocular_eye_hand {
namespace {

Mesh simpleMesh(Generator* random, double s) {
  switch (random->integer(0, 4)) {
    case 0:
      return boxMesh({2 * s, 2 * s * random->uniform(0.4, 1.5), 2 * s * random->uniform(0.4, 1.5)});
    case 1:
      return cylinderMesh(s, s * random->uniform(0.5, 4));
    case 2:
      return coneMesh(s, s * random->uniform(0.2, 0.8), s * random->uniform(1, 3));
    case 3:
      return sphereMesh(s);
    default:
      // A printed sheet: thin enough to count as flat, thick enough to be above the table.
      return boxMesh({3 * s, 4 * s, 0.0005});
  }
}

void append(Mesh* mesh, const Mesh& other, const Rigid3& place) {
  const int base = int(mesh->vertices.size());
  for (const Eigen::Vector3d& p : other.vertices) mesh->vertices.push_back(place * p);
  for (const auto& t : other.triangles) mesh->triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

Mesh stackedPlates(Generator* random, double s) {
  Mesh mesh;
  double z = 0;
  const int count = random->integer(2, 5);
  for (int k = 0; k < count; ++k) {
    const double height = s * random->uniform(0.05, 0.3);
    const Rigid3 place{expSO3({0, 0, random->uniform(-0.3, 0.3)}),
                       {s * random->uniform(-0.2, 0.2), s * random->uniform(-0.2, 0.2), z}};
    append(&mesh, boxMesh({s * random->uniform(1.2, 2.5), s * random->uniform(1, 2), height}), place);
    z += height;
  }
  return mesh;
}

// Bends at random, stays on the table.
Mesh cable(Generator* random, double s) {
  const double radius = s * random->uniform(0.04, 0.12), step = 0.25 * s;
  std::vector<Eigen::Vector3d> path{{0, 0, radius}};
  double angle = 0, turn = 0;
  const int count = random->integer(16, 48);
  for (int k = 0; k < count; ++k) {
    turn = 0.85 * turn + random->uniform(-0.15, 0.15);
    angle += turn;
    path.push_back(path.back() + step * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return cableMesh(path, radius);
}

/// A body of revolution along z, laid down on its side; `radius`: its largest.
Rigid3 lyingDown(double radius) { return {expSO3({M_PI / 2, 0, 0}), {0, 0, radius}}; }

ClutterPiece pieceOf(const std::string& name, Mesh mesh, const Rigid3& table_from_object = {}) {
  ClutterPiece piece;
  piece.object.name = "clutter " + name;
  piece.object.mesh = std::make_shared<Mesh>(std::move(mesh));
  piece.table_from_object = table_from_object;
  return piece;
}

ClutterPiece screw(Generator* random, double s) {
  const double head = s * random->uniform(0.15, 0.35), shank = head * random->uniform(0.4, 0.7);
  const double height = head * random->uniform(0.4, 1.2), length = head * random->uniform(2, 9);
  // Its head and its tip touch the table.
  const double slope = std::atan2(head - shank, height + length);
  Rigid3 lying = lyingDown(head);
  lying.rotation = expSO3({slope, 0, 0}) * lying.rotation;
  const Mesh mesh = screwMesh(head, height, shank, length);
  double lowest = 1e9;
  for (const Eigen::Vector3d& p : mesh.vertices) lowest = std::min(lowest, (lying * p).z());
  lying.translation.z() -= lowest;
  return pieceOf("screw", mesh, lying);
}

}  // namespace

ClutterPiece simplePiece(Generator* random, double scale) {
  ClutterPiece piece;
  piece.object.name = "clutter";
  const double s = scale * random->uniform(0.015, 0.045);
  piece.object.mesh = std::make_shared<Mesh>(simpleMesh(random, s));
  piece.object.material = randomMaterial(random);
  if (random->integer(0, 2) > 0) piece.object.material.texture = randomTexture(random, 0.6);
  piece.object.material.texture.scale *= scale;
  return piece;
}

ClutterPiece workshopPiece(Generator* random, double scale) {
  const double s = scale * random->uniform(0.015, 0.05);

  switch (random->integer(0, 9)) {
    case 0:
      return pieceOf("tray", trayMesh({s * random->uniform(1.5, 3), s * random->uniform(1.5, 3),
                                       s * random->uniform(0.4, 1.5)},
                                      s * random->uniform(0.05, 0.2)));
    case 1:
      return pieceOf("angle", angleMesh(s * random->uniform(0.6, 1.6), s * random->uniform(0.6, 1.6),
                                        s * random->uniform(0.08, 0.25), s * random->uniform(1, 4)));
    case 2: {
      const double outer = s * random->uniform(0.3, 1.2);
      return pieceOf("ring",
                     ringMesh(outer, outer * random->uniform(0.35, 0.9), outer * random->uniform(0.15, 1.2)));
    }
    case 3: {
      const double outer = s * random->uniform(0.2, 0.6);
      const double length = s * random->uniform(1.5, 5);
      Rigid3 lying = lyingDown(outer);
      return pieceOf("tube", ringMesh(outer, outer * random->uniform(0.5, 0.9), length), lying);
    }
    case 4:
      return pieceOf("plates", stackedPlates(random, s));
    case 5:
    case 6:
      return screw(random, s);
    case 7:
      return pieceOf("cable", cable(random, s));
    case 8:
      return pieceOf("ruler",
                     boxMesh({s * random->uniform(5, 9), s * random->uniform(0.5, 0.8), 0.001 * scale}));
    default:
      return pieceOf("solid", simpleMesh(random, s));
  }
}

}  // namespace monocular_eye_hand
