/// Detail of kind.hpp: a belt drafted on the human.

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object beltTable() {
  using B = BeltGarment;
  return Table<B>("Belt")
      .number("width", &B::width_m, "m", between(0.01, 0.2), "height of the band")
      .number("tension", &B::tension_N, "N", between(0, 100),
              "of the belt on the waist, over the garments before it: the whole belt presses 2 pi times as much. It is "
              "made shorter by the stretch at which it carries this")
      .number("below_waist", &B::below_waist_m, "m", between(-0.2, 0.2),
              "its upper edge below the edge \"waist\" of the garment under it")
      .number("cell", &B::cell_m, "m", between(0.002, 0.1), kCellDoc)
      .integer("degree", &B::degree, 2, 5, "polynomial degree")
      .number("gap", &B::gap_m, "m", between(0, 0.02), "that it starts farther out than the garments under it ask for")
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind belt_garment;
const GarmentKind belt_garment{
    .word = "belt",
    .drafted = true,
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<BeltGarment>("belt", &GarmentCase::shape, schema::beltTable(),
                                         "a belt drafted on the human, over the garments before it");
        },
    .edges =
        [](const GarmentCase&) {
          return GarmentKind::Names{"lower", "upper"};
        },
    .patches = [](const GarmentCase&) { return beltPatchNames(); },
    .fieldless = [](const GarmentCase& g) -> std::string {
      if (!(std::get<BeltGarment>(g.shape).tension_N > 0)) return "";
      return "a belt's length follows from its tension and one fabric; allowed: with tension 0 N";
    },
    .make =
        [](const GarmentMaking& m) {
          return makeBelt(std::get<BeltGarment>(m.worn.shape), *m.form, m.fabric, m.layer_m, m.under);
        },
};

}  // namespace gambeson
