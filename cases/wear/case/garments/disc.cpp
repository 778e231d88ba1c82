/// Detail of kind.hpp: a flat disc.

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace schema {
namespace {

Object discTable() {
  using D = DiscGarment;
  return Table<D>("Disc")
      .number("radius", &D::radius_m, "m", aboveTo(0, 100), "radius")
      .required()
      .integer("cells", &D::cells, 2, 1000, "cells across the diameter; the rim cuts through the outer ones")
      .integer("degree", &D::degree, 2, 5, "polynomial degree")
      .vector("center", &D::center, "m", between(-1e3, 1e3), "centre in the world")
      .direction("axis_u", &D::axis_u, "direction of u through the centre, the weft where weft_angle is 0")
      .direction("axis_v", &D::axis_v, "direction of v through the centre; at right angles to axis_u")
      .check([](const Entry& p, const D& d) {
        if (!(std::abs(dot(d.axis_u, d.axis_v)) < 1e-6))
          p.failAt("axis_v", "is not at right angles to axis_u; allowed: 90 deg");
      })
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind disc_garment;
const GarmentKind disc_garment{
    .word = "disc",
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<DiscGarment>("disc", &GarmentCase::shape, schema::discTable(), "a flat disc");
        },
    .cells =
        [](const GarmentCase& g) {
          const auto& d = std::get<DiscGarment>(g.shape);
          return long{d.cells} * d.cells;
        },
    .make =
        [](const GarmentMaking& m) {
          const auto& d = std::get<DiscGarment>(m.worn.shape);
          return makeDisc({d.radius_m, d.cells, d.degree, d.center, d.axis_u, d.axis_v});
        },
};

}  // namespace gambeson
