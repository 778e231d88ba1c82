/// Detail of kind.hpp: a circular tube.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace schema {
namespace {

Object tubeTable() {
  using T = TubeGarment;
  return Table<T>("Tube")
      .number("radius", &T::radius_m, "m", aboveTo(0, 10), "radius at rest")
      .required()
      .number("length", &T::length_m, "m", aboveTo(0, 100), "length")
      .required()
      .integer("cells_around", &T::cells_around, 3, 1000, "cells around, all patches together")
      .integer("cells_along", &T::cells_along, 1, 1000, "cells along")
      .integer("degree", &T::degree, 2, 5, "polynomial degree")
      .integer("patches", &T::patches, 1, 12, "equal patches around, joined lengthwise by seams")
      .vector("start", &T::start, "m", between(-1e3, 1e3), "centre of the first ring, the edge \"start\"")
      .direction("axis", &T::axis, "direction from the edge \"start\" to the edge \"end\"")
      .check([](const Entry& p, const T& t) {
        if (t.cells_around % t.patches != 0)
          p.failAt("cells_around", "is not a multiple of patches; allowed: a multiple");
      })
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind tube_garment;
const GarmentKind tube_garment{
    .word = "tube",
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<TubeGarment>("tube", &GarmentCase::shape, schema::tubeTable(),
                                         "a circular tube, a sleeve say");
        },
    .edges =
        [](const GarmentCase&) {
          return GarmentKind::Names{"start", "end"};
        },
    .patches =
        [](const GarmentCase& g) {
          GarmentKind::Names names;
          for (int k = 0; k < std::get<TubeGarment>(g.shape).patches; ++k) names.push_back(fmt::format("patch_{}", k));
          return names;
        },
    .cells =
        [](const GarmentCase& g) {
          const auto& t = std::get<TubeGarment>(g.shape);
          return long{t.cells_around} * t.cells_along;
        },
    .make =
        [](const GarmentMaking& m) {
          const auto& t = std::get<TubeGarment>(m.worn.shape);
          return makeTube({t.radius_m, t.length_m, t.cells_around, t.cells_along, t.degree, t.patches, t.start, t.axis,
                           SeamKind::G1, 0});
        },
};

}  // namespace gambeson
