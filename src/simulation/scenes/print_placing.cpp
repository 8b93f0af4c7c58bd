#include "simulation/scenes/print_placing.h"

#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

constexpr int kMinTexels = 12;  // across a picture: a smaller one would only be a smudge

Rigid3 turned(double angle, double x, double y) { return {expSO3({0, 0, angle}), {x, y, 0}}; }

Art drawMark(Generator* random) {
  static const Art kMarks[] = {Art::kText,  Art::kText,    Art::kHandwriting, Art::kHandwriting, Art::kLabel,
                               Art::kLabel, Art::kBarcode, Art::kTag,         Art::kLogo,        Art::kLogo};
  return kMarks[random->integer(0, 9)];
}

// Larger faces more often.
size_t drawFace(const std::vector<PlanarFace>& faces, Generator* random) {
  double sum = 0;
  for (const PlanarFace& face : faces) sum += face.area;
  double left = random->uniform(0, sum);
  for (size_t k = 0; k < faces.size(); ++k)
    if ((left -= faces[k].area) < 0) return k;
  return 0;
}

// A curved surface takes a picture as a sheet laid against it.
bool markCurved(const Mesh& mesh, double texel, double ground, Generator* random,
                std::vector<Print>* prints) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high - low).minCoeff() * random->uniform(0.4, 1.0);
  if (size < kMinTexels * texel) return false;

  const auto& t = mesh.triangles[size_t(random->integer(0, int(mesh.triangles.size()) - 1))];
  const Eigen::Vector3d &a = mesh.vertices[size_t(t[0])], &b = mesh.vertices[size_t(t[1])],
                        &c = mesh.vertices[size_t(t[2])];
  const Eigen::Vector3d area = (b - a).cross(c - a);
  if (!(area.norm() > 0)) return false;

  Rigid3 frame;
  const Eigen::Vector3d z = area.normalized(), x = z.unitOrthogonal();
  frame.rotation << x, z.cross(x), z;
  frame.translation = (a + b + c) / 3;
  frame = frame * turned(random->uniform(0, 2 * M_PI), 0, 0);

  Print print =
      makePrint(drawMark(random), frame, size, size * random->uniform(0.3, 0.9), texel, ground, random);
  print.reach = 0.35 * size;
  print.facing = 0.35;
  prints->push_back(print);
  return true;
}

void markFace(const PlanarFaces& found, double texel, double ground, Generator* random,
              std::vector<Print>* prints) {
  const PlanarFace& face = found.faces[drawFace(found.faces, random)];
  const Art art = drawMark(random);
  const double width = face.width * random->uniform(0.25, 0.9);
  const double height = std::min(
      face.height * 0.95, art == Art::kTag || art == Art::kLogo ? width : width * random->uniform(0.2, 0.6));
  if (std::min(width, height) < kMinTexels * texel) return;
  // In the middle, at the border, or hanging over it.
  const double reach_x =
      std::max(0.0, 0.5 * (face.width - width)) + (random->integer(0, 3) == 0 ? 0.2 * width : 0);
  const double reach_y = std::max(0.0, 0.5 * (face.height - height));
  const double skew = random->integer(0, 1) ? 0 : random->uniform(-0.3, 0.3);
  const double angle = M_PI * random->integer(0, 1) + skew;
  const Rigid3 frame = face.object_from_face *
                       turned(angle, random->uniform(-reach_x, reach_x), random->uniform(-reach_y, reach_y));
  prints->push_back(makePrint(art, frame, width, height, texel, ground, random));
}

/// A sticker that is bent over an edge: the same picture in both planes.
void stickerOverEdge(const PlanarFaces& found, double texel, double ground, Generator* random,
                     std::vector<Print>* prints) {
  const FaceFold& fold = found.folds[size_t(random->integer(0, int(found.folds.size()) - 1))];
  const PlanarFace& face = found.faces[size_t(fold.from)];
  const double width = std::min(face.width, 2 * face.height) * random->uniform(0.3, 0.8);
  const double height = width * random->uniform(0.4, 0.9);
  if (height < kMinTexels * texel) return;
  const Eigen::Vector3d at = face.object_from_face.inverse() * fold.middle;
  const Rigid3 frame = face.object_from_face *
                       turned(M_PI / 2 * random->integer(0, 3) + random->uniform(-0.2, 0.2), at.x(), at.y());
  Print print = makePrint(random->integer(0, 2) ? Art::kLabel : Art::kPatchwork, frame, width, height, texel,
                          ground, random);
  prints->push_back(print);
  print.object_from_print = fold.turn * print.object_from_print;
  prints->push_back(print);
}

void fillFace(const PlanarFace& face, Art art, double texel, double ground, Generator* random,
              std::vector<Print>* prints) {
  const double margin = random->integer(0, 1) ? 1.0 : random->uniform(0.8, 1.0);
  if (face.height < kMinTexels * texel) return;
  prints->push_back(makePrint(art, face.object_from_face * turned(M_PI * random->integer(0, 1), 0, 0),
                              face.width * margin, face.height * margin, texel, ground, random));
}

}  // namespace

Print makePrint(Art art, const Rigid3& object_from_print, double width, double height, double texel,
                double ground, Generator* random) {
  Print print;
  print.object_from_print = object_from_print;
  print.width = width;
  print.height = height;
  const cv::Size texels(int(std::lround(width / texel)), int(std::lround(height / texel)));
  print.picture = drawArt(art, texels, ground, random);
  return print;
}

std::vector<Print> drawPrints(const Mesh& mesh, PrintPlan plan, double texel, double ground,
                              Generator* random) {
  const PlanarFaces found = planarFaces(mesh);
  std::vector<Print> prints;
  if (found.faces.empty()) {
    if (!mesh.triangles.empty()) markCurved(mesh, texel, ground, random, &prints);
    return prints;
  }

  switch (plan) {
    case PrintPlan::kMarked: {
      const int marks = random->integer(1, 4);
      for (int k = 0; k < marks; ++k) markFace(found, texel, ground, random, &prints);
      if (!found.folds.empty() && random->integer(0, 3) == 0)
        stickerOverEdge(found, texel, ground, random, &prints);
      if (random->integer(0, 4) == 0) markCurved(mesh, texel, ground, random, &prints);
      break;
    }
    case PrintPlan::kPackaging: {
      const Art art = random->integer(0, 1) ? Art::kPatchwork : Art::kBoxFront;
      for (const PlanarFace& face : found.faces) fillFace(face, art, texel, ground, random, &prints);
      break;
    }
    case PrintPlan::kWorn:
      for (const PlanarFace& face : found.faces) {
        if (random->integer(0, 3) == 0) continue;
        fillFace(face, random->integer(0, 1) ? Art::kScratches : Art::kStains, texel, ground, random,
                 &prints);
      }
      break;
  }

  return prints;
}

}  // namespace monocular_eye_hand
