/// Detail of kind.hpp: a shirt drafted on the human.

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object shirtTable() {
  using S = ShirtGarment;
  return Table<S>("Shirt")
      .number("ease", &S::ease, "", between(0, 0.5), "how much wider than the body: girth = (1 + ease) body girth")
      .number("hem_above_waist", &S::hem_above_waist_m, "m", between(-0.1, 0.2),
              "lower edge above the edge \"waist\" of a garment under it")
      .number("top_below_shoulder", &S::top_below_shoulder_m, "m", between(-0.1, 0.2),
              "upper edges of front and back below the shoulder joints")
      .number("wrap_share", &S::wrap_share, "", between(0.1, 0.9), "height of the side wrap over that of the front")
      .number("front_share", &S::front_share, "", between(0.1, 0.9), "part of the girth that the front covers below")
      .number("strap_width", &S::strap_width_m, "m", between(0.01, 0.2), "width of a strap; there are four legs of it")
      .number("neck_share", &S::neck_share, "", between(0.1, 0.9),
              "distance between the straps over that of the shoulder joints, to whole cells")
      .number("neck_depth", &S::neck_depth_m, "m", between(0.01, 0.3), "of the neckline below the front's upper edge")
      .number("margin", &S::margin_m, "m", between(0, 0.1), "of the panels beside the straps, to whole cells")
      .number("belly_length", &S::belly_length_m, "m", between(0.02, 0.5), "of the belly protector")
      .number("belly_share", &S::belly_share, "", between(0.1, 0.9), "its width over that of the front")
      .number("cell", &S::cell_m, "m", between(0.002, 0.1), "wanted size of a cell; smaller is finer and slower")
      .integer("degree", &S::degree, 2, 5, "polynomial degree")
      .number("gap", &S::gap_m, "m", between(0, 0.02), "farther out than the garments under it ask for")
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind shirt_garment;
const GarmentKind shirt_garment{
    .word = "shirt",
    .drafted = true,
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<ShirtGarment>(
              "shirt", &GarmentCase::shape, schema::shirtTable(),
              "a shirt without sleeves of six patches (front, back, strap_left, strap_right, "
              "side_wrap, belly), drafted on the human over the garments before it");
        },
    .edges =
        [](const GarmentCase&) {
          return GarmentKind::Names{"hem", "neck_front", "neck_back", "belly_hem"};
        },
    .patches = [](const GarmentCase&) { return shirtPatchNames(); },
    .make =
        [](const GarmentMaking& m) {
          ShirtGarment s = std::get<ShirtGarment>(m.worn.shape);
          s.seam_stiffness_N = m.worn.seam_stiffness_N;
          return makeShirt(s, *m.form, m.layer_m, m.under);
        },
    .arms = [](const GarmentCase&) { return ArmsWanted::hanging; },
};

}  // namespace gambeson
