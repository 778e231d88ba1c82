/// Detail of kind.hpp: trousers of four rectangles for the human.

#include "tryon/pattern/trousers.hpp"

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object trousersTable() {
  using T = TrousersGarment;
  return Table<T>("Trousers")
      .number("ease", &T::ease, "", between(0, 1),
              "how much wider than the body: around the hips 1 + ease times the widest outline of hips and legs, "
              "around a leg half of that, and at least 1 + ease times the leg")
      .number("rise", &T::rise_m, "m", between(0.15, 0.6), "crotch to waist edge, along the cloth")
      .number("crotch_ease", &T::crotch_ease_m, "m", between(0, 0.2),
              "how far the crotch of the trousers lies under the body's where they are worn")
      .number("hem", &T::hem_m, "m", between(0.02, 1), "height of the hems above the ground where they are worn")
      .number("cell", &T::cell_m, "m", between(0.002, 0.1), kCellDoc)
      .integer("degree", &T::degree, 2, 5, "polynomial degree")
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind trousers_garment;
const GarmentKind trousers_garment{
    .word = "trousers",
    .drafted = true,
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<TrousersGarment>(
              "trousers", &GarmentCase::shape, schema::trousersTable(),
              "trousers of four equal rectangles, front and back of each leg, for the human of the case (Man 2006, "
              "5.4); they start opened where they are worn, or with position below the legs, to be pulled up");
        },
    .edges = [](const GarmentCase&) { return trousersEdgeNames(); },
    .patches = [](const GarmentCase&) { return trousersPatchNames(); },
    .make = [](const GarmentMaking& m) { return makeTrousers(std::get<TrousersGarment>(m.worn.shape), *m.form); },
};

}  // namespace gambeson
