/// Penetration of a finer surface, and body vertices through the cloth.
#include "core/contact/scene_check.hpp"

#include <gtest/gtest.h>

#include "core/contact/mesh_surface.hpp"
#include "unit/core/contact/mesh_shapes.hpp"

namespace gambeson {
namespace {

using namespace testing_shapes;

std::vector<Obstacle> obstaclesOf(std::vector<Shape> shapes) {
  std::vector<Obstacle> o(shapes.size());
  for (std::size_t i = 0; i < o.size(); ++i) o[i].shape = std::move(shapes[i]);
  return o;
}

TEST(SceneCheck, DeepestPointIsNamed) {
  const auto o = obstaclesOf({Ellipsoid{{1, 1, 1}}, box({0.5, 0.5, 0.5})});
  const std::vector<Placement> X{{{}, {0, 0, 0}, 1}, {{}, {5, 0, 0}, 2}};
  const ProximityQuery query(o);
  EXPECT_FALSE(deepestPenetration(query, X, std::vector<Vec3>{{1.001, 0, 0}, {3.9, 0, 0}}));
  const auto d = deepestPenetration(query, X, std::vector<Vec3>{{0.99, 0, 0}, {4.2, 0, 0}, {0, 0, 1.5}, {0, -0.95, 0}});
  ASSERT_TRUE(d);
  EXPECT_NEAR(d->depth_m, 0.2, 1e-14);
  EXPECT_EQ(d->point, 1);
  EXPECT_EQ(d->obstacle, 1);
}

TEST(SceneCheck, ASpikeBetweenThePointsOfTheClothIsFound) {
  // A box corner pushed up through the middle of a coarse sheet: no cloth point is inside the box.
  const TriangleMesh cloth = plane(1);
  const auto o = obstaclesOf({box({0.05, 0.05, 0.05})});
  std::vector<Placement> X(1);
  X[0].origin = {0.3, 0.4, -0.02};
  EXPECT_FALSE(deepestPenetration(ProximityQuery(o), X, cloth.vertices));
  const auto p = piercings(o, X, cloth);
  ASSERT_GE(p.size(), 4u) << "the four upright edges, and diagonals of the sides";
  for (const Piercing& k : p) EXPECT_EQ(k.obstacle, 0);
  X[0].origin.z = -0.0500001;
  EXPECT_TRUE(piercings(o, X, cloth).empty());
}

TEST(SceneCheck, AnEllipsoidThroughTheCloth) {
  const auto o = obstaclesOf({Ellipsoid{{0.2, 0.3, 0.1}}});
  std::vector<Placement> X(1);
  X[0].origin = {0.4, 0.5, -0.1001};
  EXPECT_TRUE(piercings(o, X, plane(2)).empty());
  X[0].origin.z = -0.098;
  EXPECT_FALSE(piercings(o, X, plane(2)).empty());
}

TEST(SceneCheck, EllipsoidMeshIsClosedAndInscribed) {
  const Ellipsoid e{{0.3, 0.2, 0.1}};
  const TriangleMesh m = ellipsoidMesh(e, 3);
  EXPECT_EQ(m.triangles.size(), 20u * 64);
  EXPECT_EQ(m.vertices.size(), 10u * 64 + 2);
  EXPECT_TRUE(MeshSurface(m).closed());
  double volume = 0;
  for (const auto& t : m.triangles) volume += dot(m.vertices[t[0]], cross(m.vertices[t[1]], m.vertices[t[2]])) / 6;
  const double exact = 4 * M_PI / 3 * 0.3 * 0.2 * 0.1;
  EXPECT_LT(volume, exact);
  EXPECT_GT(volume, 0.98 * exact);
  for (const Vec3& v : m.vertices) EXPECT_NEAR(norm({v.x / 0.3, v.y / 0.2, v.z / 0.1}), 1, 1e-15);
}

}  // namespace
}  // namespace gambeson
