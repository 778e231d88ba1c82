/// Detail of kind.hpp: shorts drafted on the human.

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace schema {
namespace {

Object shortsTable() {
  using S = ShortsGarment;
  return Table<S>("Shorts")
      .number("inseam", &S::inseam_m, "m", between(0.08, 1.2),
              "length of the inner leg, crotch to hem: shorts above the knee, trousers below it, down to the ankle; "
              "they taper to a hem as wide as the calf")
      .number("rise", &S::rise_m, "m", between(0.1, 0.5), "height of the waist edge above the crotch of the shorts")
      .number(
          "crotch_ease", &S::crotch_ease_m, "m", between(0, 0.08),
          "how far the crotch of the shorts lies under the body's: room for the thighs to rise without pulling at the "
          "waist; a longer rise keeps the waist edge where it was")
      .number("ease", &S::ease, "", between(0, 0.5), "how much wider than the body: girth = (1 + ease) body girth")
      .number("waist_ease", &S::waist_ease, "", between(0, 0.5),
              "ease of the waist edge, which goes over into the other within 12 cm below it; small under a belt")
      .defaultsTo("ease")
      .number("cell", &S::cell_m, "m", between(0.002, 0.1), kCellDoc)
      .integer("degree", &S::degree, 2, 5, "polynomial degree")
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind shorts_garment;
const GarmentKind shorts_garment{
    .word = "shorts",
    .drafted = true,
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<ShortsGarment>("shorts", &GarmentCase::shape, schema::shortsTable(),
                                           "shorts of six patches drafted on the human of the case");
        },
    .edges =
        [](const GarmentCase&) {
          return GarmentKind::Names{"waist", "hem_left", "hem_right"};
        },
    .patches = [](const GarmentCase&) { return shortsPatchNames(); },
    .make =
        [](const GarmentMaking& m) {
          const auto& s = std::get<ShortsGarment>(m.worn.shape);
          ShortsPattern pattern;
          pattern.inseam_m = s.inseam_m;
          pattern.rise_m = s.rise_m;
          pattern.crotch_ease_m = s.crotch_ease_m;
          pattern.ease = s.ease;
          pattern.waist_ease = s.waist_ease;
          pattern.cell_m = s.cell_m;
          pattern.degree = s.degree;
          pattern.seam_stiffness_N = m.worn.seam_stiffness_N;
          return makeShorts(pattern, *m.form);
        },
};

}  // namespace gambeson
