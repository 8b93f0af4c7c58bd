#include "monocular_eye_hand/mesh/ray_tracer.h"

#include <gtest/gtest.h>

#include <limits>

#include "monocular_eye_hand/mesh/ray_scene.h"
#include "shapes.h"

namespace monocular_eye_hand {
namespace {

using namespace shapes;
using Eigen::Vector3f;

constexpr float kFar = std::numeric_limits<float>::infinity();

Rigid3 at(double x, double y, double z) { return {Eigen::Matrix3d::Identity(), {x, y, z}}; }

std::shared_ptr<const RayTracer> bodyOf(const Mesh& mesh) {
  const auto body = std::make_shared<RayTracer>();
  body->add(mesh);
  body->commit();
  return body;
}

/// The height at which a ray downwards from z = 10 m meets something; 0 when it meets nothing.
double heightAt(const RayTracer& tracer, float x, float y, int* id = nullptr) {
  const RayTracer::Hit hit = tracer.cast({x, y, 10}, -Vector3f::UnitZ());
  if (id) *id = hit.id;
  return hit.id == RayTracer::kNone ? 0 : 10 - hit.distance;
}

TEST(RayTracer, TellsWhichMeshAndWhere) {
  RayTracer tracer;
  EXPECT_EQ(tracer.add(box(1, 1, 1), at(3, 0, 0)), 0);
  EXPECT_EQ(tracer.add(box(1, 1, 4)), 1);
  tracer.commit();

  int id = 7;
  EXPECT_NEAR(heightAt(tracer, 3.1f, 0.2f, &id), 0.5, 1e-5);
  EXPECT_EQ(id, 0);
  EXPECT_NEAR(heightAt(tracer, 0.1f, 0.2f, &id), 2, 1e-5);
  EXPECT_EQ(id, 1);
  EXPECT_EQ(heightAt(tracer, 1.5f, 0, &id), 0);
  EXPECT_EQ(id, RayTracer::kNone);

  const Vector3f down = -Vector3f::UnitZ();
  EXPECT_LT((facingNormal(tracer.cast({0.1f, 0.2f, 10}, down).normal, down) - Vector3f::UnitZ()).norm(),
            1e-6);
  EXPECT_TRUE(tracer.blocked({0.1f, 0.2f, 10}, down, 8.1f));
  EXPECT_FALSE(tracer.blocked({0.1f, 0.2f, 10}, down, 7.9f));
}

TEST(RayTracer, CopiesAreWhereTheyWerePlaced) {
  RayTracer tracer(RayTracer::Kind::kMoving);
  const auto body = bodyOf(box(1, 1, 1));
  for (int id : {0, 1}) EXPECT_EQ(tracer.add(body), id);
  for (double x : {3.0, 5.0}) {
    SCOPED_TRACE(x);
    tracer.place(0, at(0, 0, 0));
    tracer.place(1, at(x, 0, 1));
    tracer.commit();
    int id = 7;
    EXPECT_NEAR(heightAt(tracer, float(x), 0.2f, &id), 1.5, 1e-5);
    EXPECT_EQ(id, 1);
  }
  EXPECT_EQ(heightAt(tracer, 3, 0.2f), 0);

  tracer.show(1, false);
  tracer.commit();
  EXPECT_EQ(heightAt(tracer, 5, 0.2f), 0);
  EXPECT_NEAR(heightAt(tracer, 0, 0.2f), 0.5, 1e-5);
}

TEST(RayTracer, SeveralRaysAtOnceHitWhatEachHitsAlone) {
  RayTracer tracer(RayTracer::Kind::kMoving);
  const auto ball = bodyOf(sphere(32, 1));
  for (int k = 0; k < 3; ++k) {
    tracer.add(ball);
    tracer.place(k, at(1.2 * k, 0.1 * k, 0.3 * k));
  }
  tracer.commit();

  RayTracer::Rays rays;
  for (int k = 0; k < RayTracer::kLanes; ++k) {
    rays.set(k, {0.6f * float(k) - 1.5f, 0.15f, 10}, -Vector3f::UnitZ(), kFar);
    rays.valid[k] = k == 4 ? 0 : -1;
  }
  RayTracer::Hits hits;
  tracer.cast(rays, 0, &hits);
  bool blocked[RayTracer::kLanes] = {};
  tracer.blocked(rays, blocked);

  int met = 0;
  for (int k = 0; k < RayTracer::kLanes; ++k) {
    SCOPED_TRACE(k);
    if (!rays.valid[k]) {
      EXPECT_EQ(hits.id[k], RayTracer::kNone);
      EXPECT_FALSE(blocked[k]);
      continue;
    }
    const RayTracer::Hit alone = tracer.cast({rays.ox[k], rays.oy[k], rays.oz[k]}, -Vector3f::UnitZ());
    EXPECT_EQ(hits.id[k], alone.id);
    EXPECT_EQ(blocked[k], alone.id != RayTracer::kNone);
    if (alone.id == RayTracer::kNone) continue;
    ++met;
    EXPECT_EQ(hits.triangle[k], alone.triangle);
    EXPECT_NEAR(hits.distance[k], alone.distance, 1e-5);
    EXPECT_NEAR(hits.u[k], alone.u, 1e-4);
    EXPECT_NEAR(hits.v[k], alone.v, 1e-4);
  }
  EXPECT_GE(met, 4);

  // From behind the surfaces on nothing is met.
  tracer.cast(rays, 20, &hits);
  for (const int id : hits.id) EXPECT_EQ(id, RayTracer::kNone);
}

TEST(RayScene, IsAsExactFarFromTheOrigin) {
  const Mesh far = moved(box(0.1, 0.1, 0.1), at(500, -300, 200));
  const RayScene scene(far);
  const RayScene::Hit hit = scene.cast({500.01, -300.02, 201}, -Point::UnitZ());
  ASSERT_TRUE(hit.hit);
  EXPECT_NEAR(hit.distance, 0.95, 1e-6);
  EXPECT_TRUE(scene.occluded({500.01, -300.02, 201}, {500.01, -300.02, 200}));
  EXPECT_FALSE(scene.occluded({500.01, -300.02, 201}, {500.01, -300.02, 200.051}));
}

}  // namespace
}  // namespace monocular_eye_hand
