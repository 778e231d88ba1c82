/// Detail of kind.hpp: a sphere.

#include <fmt/format.h>

#include <cmath>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"

namespace gambeson {
namespace schema {
namespace {

const Range world = between(-1e3, 1e3);

Object sphereTable() {
  using S = SphereObstacle;
  return Table<S>("Sphere")
      .number("radius", &S::radius_m, "m", aboveTo(0, 100), "radius")
      .required()
      .vector("center", &S::center_m, "m", world, "centre")
      .integer("rings", &S::rings, 0, 1000, "bands of triangles from pole to pole along z; 0: an exact sphere")
      .integer("segments", &S::segments, 0, 1000, "triangles around; 0: an exact sphere")
      .check([](const Entry& p, const S& s) {
        if ((s.rings == 0) != (s.segments == 0))
          p.failAt(s.rings ? "segments" : "rings", "rings and segments go together; give both or neither");
        if (s.rings != 0 && s.rings < 2)
          p.failAt("rings", fmt::format("{} is out of range; allowed: 0 or >= 2", s.rings));
        if (s.segments != 0 && s.segments < 3)
          p.failAt("segments", fmt::format("{} is out of range; allowed: 0 or >= 3", s.segments));
      })
      .build();
}

}  // namespace
}  // namespace schema

namespace {

Shape shapeOf(const SphereObstacle& s) {
  if (s.rings == 0) return Ellipsoid{{s.radius_m, s.radius_m, s.radius_m}};
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, s.radius_m});
  for (int r = 1; r < s.rings; ++r)
    for (int k = 0; k < s.segments; ++k) {
      const double theta = M_PI * r / s.rings, phi = 2 * M_PI * k / s.segments;
      mesh.vertices.push_back(s.radius_m *
                              Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  mesh.vertices.push_back({0, 0, -s.radius_m});
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto id = [&](int r, int k) { return 1 + (r - 1) * s.segments + k % s.segments; };
  for (int k = 0; k < s.segments; ++k) {
    mesh.triangles.push_back({0, id(1, k), id(1, k + 1)});
    for (int r = 1; r + 1 < s.rings; ++r) {
      mesh.triangles.push_back({id(r, k), id(r + 1, k), id(r + 1, k + 1)});
      mesh.triangles.push_back({id(r, k), id(r + 1, k + 1), id(r, k + 1)});
    }
    mesh.triangles.push_back({id(s.rings - 1, k), last, id(s.rings - 1, k + 1)});
  }
  return mesh;
}

}  // namespace

extern const ObstacleKind sphere_obstacle;
const ObstacleKind sphere_obstacle{
    .word = "sphere",
    .addTo =
        [](schema::Table<ObstacleCase>& table) {
          table.alternative<SphereObstacle>("sphere", &ObstacleCase::shape, schema::sphereTable(),
                                            "a sphere, exact or as a mesh");
        },
    .make =
        [](const ObstacleCase& o, const Hurdle*) {
          const auto& s = std::get<SphereObstacle>(o.shape);
          return MadeObstacle{shapeOf(s), s.center_m};
        },
};

}  // namespace gambeson
