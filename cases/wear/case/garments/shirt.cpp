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
      .number("cell", &S::cell_m, "m", between(0.002, 0.1), kCellDoc)
      .integer("degree", &S::degree, 2, 5, "polynomial degree")
      .number("gap", &S::gap_m, "m", between(0, 0.02), "farther out than the garments under it ask for")
      .number("sleeve_length", &S::sleeve_length_m, "m", between(0.05, 1),
              "of the sleeves, from the shoulder joint along the arm to the hem: below the armhole, down to the wrist")
      .defaultsTo("no sleeves: a vest")
      .number("sleeve_ease", &S::sleeve_ease, "", between(0, 1),
              "how much wider than the arm: girth = (1 + ease) that of the arm")
      .number("sleeve_hem_ease", &S::sleeve_hem_ease, "", between(0, 1),
              "ease of the sleeves' hems over the arm there, to which they taper between elbow and hem")
      .defaultsTo("hems below the elbow as wide as the forearm with the ease, so that it can bend")
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
              "what the trunk wears, drafted on the human over the garments before it: without `sleeve_length` a vest "
              "that "
              "hangs on straps, as armour has it, of six patches (front, back, strap_left, strap_right, side_wrap, "
              "belly); with it a shirt, whose sleeves are four more each (sleeve_front, sleeve_top, sleeve_back, "
              "sleeve_under, _left and _right)");
        },
    .edges =
        [](const GarmentCase& g) {
          return shirtEdgeNames(std::get<ShirtGarment>(g.shape).sleeve_length_m.has_value());
        },
    .patches =
        [](const GarmentCase& g) {
          return shirtPatchNames(std::get<ShirtGarment>(g.shape).sleeve_length_m.has_value());
        },
    .make =
        [](const GarmentMaking& m) {
          ShirtGarment s = std::get<ShirtGarment>(m.worn.shape);
          s.seam_stiffness_N = m.worn.seam_stiffness_N;
          return makeShirt(s, *m.form, m.layer_m, m.under);
        },
    .arms = [](const GarmentCase&) { return ArmsWanted::hanging; },
};

}  // namespace gambeson
