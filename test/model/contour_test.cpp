#include "monocular_eye_hand/model/contour.h"

#include <gtest/gtest.h>

#include <map>

#include "../mesh/shapes.h"
#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/mesh/ray_scene.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;

ObjectModel withoutSymmetries(const Mesh& mesh) {
  ModelOptions options;
  options.find_symmetries = false;
  return buildModel("part", mesh, options);
}

/// Distance along the ray to a triangle, or infinity (Moeller & Trumbore 1997).
double hitDistance(const Eigen::Vector3d& o, const Eigen::Vector3d& d, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d e1 = b - a, e2 = c - a, h = d.cross(e2);
  const double det = e1.dot(h);
  if (std::abs(det) < 1e-18) return 1e300;
  const Eigen::Vector3d s = o - a, q = s.cross(e1);
  const double u = s.dot(h) / det, v = d.dot(q) / det, t = e2.dot(q) / det;
  return (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9 || t < 0) ? 1e300 : t;
}

/// Nothing of the mesh lies between the eye and the point, but for `margin` around the point.
bool seenByBruteForce(const Mesh& mesh, const Eigen::Vector3d& eye, const Eigen::Vector3d& p, double margin) {
  const double distance = (p - eye).norm();
  const Eigen::Vector3d d = (p - eye) / distance;
  for (const auto& t : mesh.triangles) {
    if (hitDistance(eye, d, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]) <
        distance - margin) {
      return false;
    }
  }
  return true;
}

std::vector<Eigen::Vector3d> eyes(const ObjectModel& m, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> g;
  std::uniform_real_distribution<double> ratio(1.2, 6.0);
  std::vector<Eigen::Vector3d> out;
  for (int k = 0; k < count; ++k) {
    out.push_back(m.centre() +
                  m.diameter * ratio(random) * Eigen::Vector3d(g(random), g(random), g(random)).normalized());
  }
  return out;
}

/// Mesh of an angle with a concave edge, its own cast shadow for hidden lines.
Mesh angle() {
  Mesh m;
  const Outline o{{0, 0}, {0.04, 0}, {0.04, 0.01}, {0.01, 0.01}, {0.01, 0.03}, {0, 0.03}};
  wall(&m, o, 0, 0.02);
  for (const bool up : {false, true}) {
    cap(&m, {o[0], o[1], o[2], o[3]}, up ? 0.02 : 0, up);
    cap(&m, {o[0], o[3], o[4], o[5]}, up ? 0.02 : 0, up);
  }
  return m;
}

TEST(RayScene, CastAndOcclusionAgreeWithBruteForce) {
  const ObjectModel m = withoutSymmetries(loadMesh(shippedModel("grenade"), "mm"));
  std::mt19937 random(3);
  std::normal_distribution<double> g;
  int hits = 0;
  for (const Eigen::Vector3d& eye : eyes(m, 300, 4)) {
    const Eigen::Vector3d target =
        m.centre() + 0.25 * m.diameter * Eigen::Vector3d(g(random), g(random), g(random));
    const Eigen::Vector3d d = (target - eye).normalized();
    double nearest = 1e300;
    for (const auto& t : m.mesh.triangles) {
      nearest = std::min(
          nearest, hitDistance(eye, d, m.mesh.vertices[t[0]], m.mesh.vertices[t[1]], m.mesh.vertices[t[2]]));
    }
    const RayScene::Hit hit = m.rays->cast(eye, d);
    ASSERT_EQ(hit.hit, nearest < 1e300);
    if (!hit.hit) continue;
    ++hits;
    EXPECT_NEAR(hit.distance, nearest, 1e-6);
    EXPECT_TRUE(m.rays->occluded(eye + (nearest + 1e-3) * d, eye));
    EXPECT_FALSE(m.rays->occluded(eye + (nearest - 1e-3) * d, eye));
  }

  EXPECT_GT(hits, 100);
}

TEST(Contour, CubeFromACornerShowsNineEdges) {
  const ObjectModel m = withoutSymmetries(box(0.08, 0.08, 0.08));
  ContourOptions options;
  options.step = 0.004;
  const auto contour = visibleContour(m, {0.3, 0.35, 0.4}, options);
  std::map<int, int> per_edge;
  std::map<int, bool> silhouette;
  for (const ContourSample& s : contour) {
    ++per_edge[s.feature];
    silhouette[s.feature] = s.silhouette;
    EXPECT_EQ(s.silhouette, s.inner_side != 0);
  }

  EXPECT_EQ(per_edge.size(), 9u);
  int outline = 0;
  for (const auto& [feature, samples] : per_edge) {
    EXPECT_EQ(samples, 20);
    outline += silhouette[feature];
  }
  EXPECT_EQ(outline, 6);  // the hexagon
}

TEST(Contour, SamplesStandOneStepApartWithTheRestAtBothEnds) {
  const ObjectModel m = withoutSymmetries(box(0.08, 0.08, 0.08));
  ContourOptions options;
  options.step = 0.0073;
  std::map<int, std::vector<Eigen::Vector3d>> points;
  for (const ContourSample& s : visibleContour(m, {0.3, 0.35, 0.4}, options))
    points[s.feature].push_back(s.p);
  for (const auto& [feature, p] : points) {
    for (size_t k = 1; k < p.size(); ++k) EXPECT_NEAR((p[k] - p[k - 1]).norm(), options.step, 1e-12);
    const ModelEdge& e = m.edges[feature];
    EXPECT_NEAR((p.front() - e.p).norm(), (p.back() - e.q).norm(), 1e-12);
    EXPECT_LT((p.front() - e.p).norm(), options.step);
  }
  options.step = 10;  // longer than any edge: one sample each, in the middle
  for (const ContourSample& s : visibleContour(m, {0.3, 0.35, 0.4}, options)) {
    EXPECT_LT((s.p - 0.5 * (m.edges[s.feature].p + m.edges[s.feature].q)).norm(), 1e-9);
  }
}

TEST(Contour, AgreesWithBruteForceOnSharpFeatures) {
  struct Part {
    const char* name;
    Mesh mesh;
  };

  for (const Part& part :
       {Part{"cube", box(0.08, 0.08, 0.08)}, Part{"angle", angle()}, Part{"tube", tube(36, 0.03, 0.02, 0.05)},
        Part{"plate", plateWithHole(24, 0.03, 0.012, 0.02)},
        Part{"bridge", loadMesh(shippedModel("bridge"), "mm")},
        Part{"frame", loadMesh(shippedModel("frame"), "mm")},
        Part{"bracket", loadMesh(shippedModel("bracket"), "mm")},
        Part{"grenade", loadMesh(shippedModel("grenade"), "mm")}}) {
    const ObjectModel m = withoutSymmetries(part.mesh);
    ContourOptions options;
    options.step = m.diameter / 40;
    int agreed = 0, shown = 0, wrong = 0;
    for (const Eigen::Vector3d& eye : eyes(m, 40, 9)) {
      const auto contour = visibleContour(m, eye, options);
      const auto has = [&](const Eigen::Vector3d& p, int feature) {
        return std::any_of(contour.begin(), contour.end(), [&](const ContourSample& s) {
          return s.feature == feature && (s.p - p).norm() < 1e-9;
        });
      };
      const auto judge = [&](const Eigen::Vector3d& p, int feature) {
        // Points that depend on how close is "behind" are not judged: a grazing view, another surface close
        // by.
        const bool strict = seenByBruteForce(m.mesh, eye, p, 0.0005 * m.diameter);
        const bool lax = seenByBruteForce(m.mesh, eye, p, 0.03 * m.diameter);
        if (strict != lax) return;
        ++agreed;
        shown += strict;
        wrong += has(p, feature) != strict;
      };

      for (size_t e = 0; e < m.edges.size(); ++e) {
        const ModelEdge& edge = m.edges[e];
        const double length = (edge.q - edge.p).norm();
        const int n = std::max(1, int(std::lround(length / options.step)));
        for (int k = 0; k < n; ++k) {
          const double s = 0.5 * (length - (n - 1) * options.step) + k * options.step;
          judge(edge.p + s / length * (edge.q - edge.p), m.featureOfEdge(int(e)));
        }
      }

      for (const ContourSample& s : contour) {
        if (s.feature < int(m.edges.size()) || s.feature >= m.featureOfSilhouette(0)) continue;
        // Circles: no visible sample may lie behind something. (The true rim of a hole lies in the
        // tessellation.)
        const bool behind = !seenByBruteForce(m.mesh, eye, s.p, 0.03 * m.diameter);
        ++agreed;
        wrong += behind;
      }
    }
    EXPECT_GT(agreed, 1000) << part.name;
    EXPECT_LE(wrong, agreed / 500) << part.name << ": " << wrong << " of " << agreed << " (" << shown
                                   << " visible)";
  }
}

TEST(Contour, WholeCircleIsVisibleFromAboveAndHalfHiddenInABore) {
  const ObjectModel m = withoutSymmetries(plateWithHole(24, 0.03, 0.01, 0.02));
  ContourOptions options;
  options.step = 0.001;

  for (const double tilt : {0.0, 0.4, 0.9}) {
    const Eigen::Vector3d eye = m.centre() + 0.3 * Eigen::Vector3d(std::sin(tilt), 0, std::cos(tilt));
    std::map<int, int> count;
    for (const ContourSample& s : visibleContour(m, eye, options)) ++count[s.feature];
    const int whole = int(std::lround(2 * kPi * 0.01 / options.step));
    for (size_t c = 0; c < m.circles.size(); ++c) {
      const int seen = count[m.featureOfCircle(int(c))];
      if (m.circles[c].centre.z() > 0.01) {
        EXPECT_EQ(seen, whole) << tilt;
      } else {
        // Far rim: visible where the near rim's projection leaves it: all of it only from straight above.
        EXPECT_LE(seen, tilt == 0 ? whole : whole / 2 + 2) << tilt;
        if (tilt == 0.4) {
          EXPECT_GT(seen, whole / 8);
        }
        if (tilt == 0.9) {
          EXPECT_LE(seen, whole / 8);
        }
      }
    }
  }
}

TEST(Contour, CylinderShowsItsTwoExactSilhouetteLines) {
  for (const int n : {12, 24, 100}) {
    const double r = 0.02;
    const ObjectModel m = withoutSymmetries(cylinder(n, r, 0.06));
    int wall = -1;
    for (size_t s = 0; s < m.surfaces.size(); ++s) {
      if (m.surfaces[s].kind == Surface::Kind::kCylinder) wall = m.featureOfSilhouette(int(s));
    }
    ContourOptions options;
    options.step = 0.002;
    for (const Eigen::Vector3d& eye : {Eigen::Vector3d(0.2, 0, 0.03), Eigen::Vector3d(0.1, 0.15, 0.2),
                                       Eigen::Vector3d(-0.05, 0.02, -0.1)}) {
      std::map<int, int> per_side;
      for (const ContourSample& s : visibleContour(m, eye, options)) {
        if (s.feature != wall) continue;
        EXPECT_TRUE(s.silhouette);
        EXPECT_NEAR(s.p.head<2>().norm(), r, 1e-9);
        const Eigen::Vector3d normal(s.p.x() / r, s.p.y() / r, 0);
        EXPECT_NEAR(normal.dot((eye - s.p).normalized()), 0, 1e-9);
        EXPECT_NEAR(std::abs(s.tangent.z()), 1, 1e-9);
        // The object lies towards the axis.
        EXPECT_GT(s.inner_side * s.tangent.cross(s.p - eye).dot(-normal), 0);
        ++per_side[Eigen::Vector2d(eye.x(), eye.y()).dot(Eigen::Vector2d(-s.p.y(), s.p.x())) > 0 ? 1 : -1];
      }
      EXPECT_EQ(per_side[1], 30);
      EXPECT_EQ(per_side[-1], 30);
    }
  }
}

TEST(Contour, HoleWallHasNoSilhouette) {
  const ObjectModel m = withoutSymmetries(plateWithHole(24, 0.03, 0.01, 0.02));
  for (const Eigen::Vector3d& eye : eyes(m, 20, 2)) {
    for (const ContourSample& s : visibleContour(m, eye, {})) EXPECT_LT(s.feature, m.featureOfSilhouette(0));
  }
}

TEST(Contour, SphereSilhouetteIsTheTangentCircle) {
  const double r = 0.03, distance = 0.12;
  const ObjectModel m = withoutSymmetries(sphere(64, r));
  ContourOptions options;
  options.step = 0.002;
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(1, 0.2, 0.1), Eigen::Vector3d(0.1, 0.3, 1), Eigen::Vector3d(-1, 1, -1)}) {
    const Eigen::Vector3d eye = distance * d.normalized();
    const auto contour = visibleContour(m, eye, options);
    const double circle = 2 * kPi * r * std::sqrt(1 - r * r / distance / distance);
    EXPECT_NEAR(double(contour.size()), circle / options.step, 0.04 * circle / options.step);
    for (const ContourSample& s : contour) {
      EXPECT_NEAR(s.p.norm(), r, 0.003 * r);  // the facets lie inside by up to 2.4e-3 r
      EXPECT_NEAR(s.p.normalized().dot(d.normalized()), r / distance, 0.03);
      EXPECT_NEAR(s.tangent.dot(s.p.normalized()), 0, 0.1);
      EXPECT_GT(s.inner_side * s.tangent.cross(s.p - eye).dot(-s.p), 0);
    }
  }
}

TEST(Contour, ConeShowsItsGeneratorLines) {
  const ObjectModel m = withoutSymmetries(cone(48, 0.03, 0.01, 0.04));
  ContourOptions options;
  options.step = 0.001;
  int samples = 0;
  for (const ContourSample& s : visibleContour(m, {0.3, 0.05, 0.02}, options)) {
    if (s.feature < m.featureOfSilhouette(0)) continue;
    ++samples;
    const double radius_here = 0.03 - 0.02 * s.p.z() / 0.04;
    EXPECT_NEAR(s.p.head<2>().norm(), radius_here, 0.005 * radius_here);
  }
  EXPECT_NEAR(samples, 2 * std::hypot(0.04, 0.02) / options.step, 6);
}

TEST(Contour, ConeShowsItsGeneratorLinesUpToItsTip) {
  const double radius = 0.03, height = 0.08;
  const ObjectModel m = withoutSymmetries(cone(48, radius, 0, height));
  ContourOptions options;
  options.step = 0.001;
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(0.3, 0.05, 0.02), Eigen::Vector3d(-0.1, 0.25, 0.2)}) {
    int samples = 0;
    double highest = 0;
    for (const ContourSample& s : visibleContour(m, eye, options)) {
      if (s.feature < m.featureOfSilhouette(0)) continue;
      ++samples;
      highest = std::max(highest, s.p.z());
      EXPECT_NEAR(s.p.head<2>().norm(), radius * (1 - s.p.z() / height), 0.005 * radius);
    }
    EXPECT_GT(highest, height - 2 * options.step);
    EXPECT_NEAR(samples, 2 * std::hypot(height, radius) / options.step, 6);
  }
}

TEST(Contour, SilhouetteSideNamesWhereTheObjectIs) {
  for (const char* name : {"bridge", "bracket", "grenade", "flange"}) {
    const ObjectModel m = withoutSymmetries(loadMesh(shippedModel(name), "mm"));
    int judged = 0, right = 0;
    for (const Eigen::Vector3d& eye : eyes(m, 30, 6)) {
      for (const ContourSample& s : visibleContour(m, eye, {})) {
        if (!s.silhouette) continue;
        const Eigen::Vector3d view = (s.p - eye).normalized();
        const Eigen::Vector3d inward = s.inner_side * s.tangent.cross(view).normalized();
        const double aside = 0.004 * m.diameter;
        const auto in = m.rays->cast(eye, (s.p + aside * inward - eye).normalized());
        const auto out = m.rays->cast(eye, (s.p - aside * inward - eye).normalized());
        const double here = (s.p - eye).norm();
        const auto near = [&](const RayScene::Hit& h) {
          return h.hit && h.distance < here + 0.03 * m.diameter;
        };
        if (near(in) == near(out)) continue;  // corners, thin webs
        ++judged;
        right += near(in);
      }
    }
    EXPECT_GT(judged, 500) << name;
    EXPECT_GT(right, 0.995 * judged) << name;
  }
}

TEST(Contour, BadOptionsAndModelsAreRefused) {
  const ObjectModel m = withoutSymmetries(box(1, 1, 1));
  ContourOptions options;
  options.step = 0;
  EXPECT_THROW(visibleContour(m, {3, 3, 3}, options), BadInput);
  EXPECT_THROW(visibleContour(ObjectModel{}, {3, 3, 3}, {}), BadInput);
}

}  // namespace
}  // namespace monocular_eye_hand
