/// Detail of kind.hpp: an ellipsoid.

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"

namespace gambeson {
namespace schema {
namespace {

const Range world = between(-1e3, 1e3);

Object ellipsoidTable() {
  using E = EllipsoidObstacle;
  return Table<E>("Ellipsoid")
      .vector("semi_axes", &E::semi_axes_m, "m", aboveTo(0, 100), "half lengths along x, y, z")
      .required()
      .vector("center", &E::center_m, "m", world, "centre")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

Shape shapeOf(const EllipsoidObstacle& e) { return Ellipsoid{e.semi_axes_m}; }

}  // namespace

extern const ObstacleKind ellipsoid_obstacle;
const ObstacleKind ellipsoid_obstacle{
    .word = "ellipsoid",
    .addTo =
        [](schema::Table<ObstacleCase>& table) {
          table.alternative<EllipsoidObstacle>("ellipsoid", &ObstacleCase::shape, schema::ellipsoidTable(),
                                               "an ellipsoid");
        },
    .make =
        [](const ObstacleCase& o, const Hurdle*) {
          const auto& e = std::get<EllipsoidObstacle>(o.shape);
          return MadeObstacle{shapeOf(e), e.center_m};
        },
};

}  // namespace gambeson
