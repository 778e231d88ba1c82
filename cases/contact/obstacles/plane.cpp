/// Detail of kind.hpp: a square of a plane.

#include <cmath>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"

namespace gambeson {
namespace schema {
namespace {

const Range world = between(-1e3, 1e3);

Object planeTable() {
  using P = PlaneObstacle;
  return Table<P>("Plane")
      .vector("point", &P::point_m, "m", world, "centre of the square")
      .direction(
          "normal", &P::normal,
          "points to the side that bears cloth; what starts behind the square, or passes beside it, falls freely")
      .number("size", &P::size_m, "m", aboveTo(0, 1e3), "edge of the square")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

Shape shapeOf(const PlaneObstacle& p) {
  const Vec3 n = normalized(p.normal);
  const Vec3 e1 = normalized(cross(std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n)), e2 = cross(n, e1);
  const double h = 0.5 * p.size_m;
  return TriangleMesh{{-h * e1 - h * e2, h * e1 - h * e2, h * e1 + h * e2, -h * e1 + h * e2}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

extern const ObstacleKind plane_obstacle;
const ObstacleKind plane_obstacle{
    .word = "plane",
    .addTo =
        [](schema::Table<ObstacleCase>& table) {
          table.alternative<PlaneObstacle>(
              "plane", &ObstacleCase::shape, schema::planeTable(),
              "a square of a plane; it bears cloth on one side alone and ends at its edges");
        },
    .make =
        [](const ObstacleCase& o, const Hurdle*) {
          const auto& p = std::get<PlaneObstacle>(o.shape);
          return MadeObstacle{shapeOf(p), p.point_m};
        },
};

}  // namespace gambeson
