/// Detail of kind.hpp: a flat rectangle.

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace schema {
namespace {

Object sheetTable() {
  using S = SheetGarment;
  return Table<S>("Sheet")
      .number("width", &S::width_m, "m", aboveTo(0, 100), "length along axis_u")
      .required()
      .number("height", &S::height_m, "m", aboveTo(0, 100), "length along axis_v")
      .required()
      .integer("cells_u", &S::cells_u, 1, 1000, "cells along u; there are cells + degree control points")
      .integer("cells_v", &S::cells_v, 1, 1000, "cells along v")
      .integer("degree", &S::degree, 1, 5, "polynomial degree; 1 does not feel bending")
      .vector("corner", &S::corner, "m", between(-1e3, 1e3), "the corner u = v = 0 in the world")
      .direction("axis_u", &S::axis_u, "direction of u, the weft where weft_angle is 0")
      .direction("axis_v", &S::axis_v, "direction of v; at right angles to axis_u")
      .check([](const Entry& p, const S& s) {
        if (!(std::abs(dot(s.axis_u, s.axis_v)) < 1e-6))
          p.failAt("axis_v", "is not at right angles to axis_u; allowed: 90 deg");
      })
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind sheet_garment;
const GarmentKind sheet_garment{
    .word = "sheet",
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<SheetGarment>("sheet", &GarmentCase::shape, schema::sheetTable(), "a flat rectangle");
        },
    .edges =
        [](const GarmentCase&) {
          return GarmentKind::Names{"u0", "u1", "v0", "v1"};
        },
    .cells =
        [](const GarmentCase& g) {
          const auto& s = std::get<SheetGarment>(g.shape);
          return long{s.cells_u} * s.cells_v;
        },
    .make =
        [](const GarmentMaking& m) {
          const auto& s = std::get<SheetGarment>(m.worn.shape);
          return makeSheet({s.width_m, s.height_m, s.cells_u, s.cells_v, s.degree, s.corner, s.axis_u, s.axis_v});
        },
};

}  // namespace gambeson
