/// Detail of kind.hpp: a skirt drafted on the human.

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object skirtTable() {
  using S = SkirtGarment;
  return Table<S>("Skirt")
      .number("length", &S::length_m, "m", between(0.1, 1.2), "from the waist down")
      .number("ease", &S::ease, "", between(-0.3, 0.5),
              "how much wider than the body at the waist, and wider at least below; below 0: narrower, for cloth that "
              "stretches")
      .number("flare", &S::flare_rad, "rad", between(0, 1.2), "angle of its sides with the vertical")
      .integer("cells_around", &S::cells_around, 16, 1000, "of all eight panels; a multiple of 8")
      .integer("cells_along", &S::cells_along, 2, 1000, "from hem to waist")
      .integer("degree", &S::degree, 2, 5, "polynomial degree")
      .check([](const Entry& p, const S& s) {
        if (s.cells_around % 8 != 0) p.failAt("cells_around", "is not a multiple of 8; allowed: a multiple");
      })
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind skirt_garment;
const GarmentKind skirt_garment{
    .word = "skirt",
    .drafted = true,
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<SkirtGarment>("skirt", &GarmentCase::shape, schema::skirtTable(),
                                          "a flared skirt of eight panels drafted on the human");
        },
    .edges =
        [](const GarmentCase&) {
          return GarmentKind::Names{"waist", "hem"};
        },
    .patches = [](const GarmentCase&) { return skirtPatchNames(); },
    .cells =
        [](const GarmentCase& g) {
          const auto& s = std::get<SkirtGarment>(g.shape);
          return long{s.cells_around} * s.cells_along;
        },
    .make =
        [](const GarmentMaking& m) {
          return makeSkirt(std::get<SkirtGarment>(m.worn.shape), *m.form, m.layer_m, m.under);
        },
};

}  // namespace gambeson
