/// Detail of kind.hpp: a ring.

#include <fmt/format.h>

#include <cmath>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"
#include "cases/input/typed.hpp"

namespace gambeson {
namespace schema {
namespace {

const Range world = between(-1e3, 1e3);

Object torusTable() {
  using T = TorusObstacle;
  return Table<T>("Torus")
      .number("radius", &T::radius_m, "m", aboveTo(0, 100), "radius of the ring's middle line")
      .required()
      .number("tube", &T::tube_m, "m", aboveTo(0, 100), "radius of the tube about it, smaller than radius")
      .required()
      .vector("center", &T::center_m, "m", world, "centre")
      .direction("axis", &T::axis, "axis of the ring")
      .integer("segments", &T::segments, 3, 1000, "pieces around the axis")
      .integer("rings", &T::rings, 3, 1000, "pieces around the tube")
      .check([](const Entry& p, const T& t) {
        if (!(t.tube_m < t.radius_m))
          p.failAt("tube", fmt::format("{} is out of range; allowed: < radius = {}", inUnitOf(p, "tube", t.tube_m, "m"),
                                       inUnitOf(p, "tube", t.radius_m, "m")));
      })
      .build();
}

}  // namespace
}  // namespace schema

namespace {

Shape shapeOf(const TorusObstacle& t) {
  const Vec3 n = normalized(t.axis);
  const Vec3 e1 = normalized(cross(std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n)), e2 = cross(n, e1);
  TriangleMesh mesh;
  const auto id = [&](int i, int k) { return i % t.segments * t.rings + k % t.rings; };
  for (int i = 0; i < t.segments; ++i) {
    const double phi = 2 * M_PI * i / t.segments;
    const Vec3 out = std::cos(phi) * e1 + std::sin(phi) * e2;
    for (int k = 0; k < t.rings; ++k) {
      const double theta = 2 * M_PI * k / t.rings;
      mesh.vertices.push_back((t.radius_m + t.tube_m * std::cos(theta)) * out + t.tube_m * std::sin(theta) * n);
      mesh.triangles.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
      mesh.triangles.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
    }
  }
  return mesh;
}

}  // namespace

extern const ObstacleKind torus_obstacle;
const ObstacleKind torus_obstacle{
    .word = "torus",
    .addTo =
        [](schema::Table<ObstacleCase>& table) {
          table.alternative<TorusObstacle>("torus", &ObstacleCase::shape, schema::torusTable(), "a ring");
        },
    .make =
        [](const ObstacleCase& o, const Hurdle*) {
          const auto& t = std::get<TorusObstacle>(o.shape);
          return MadeObstacle{shapeOf(t), t.center_m};
        },
};

}  // namespace gambeson
