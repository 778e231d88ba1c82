/// Detail of kind.hpp: flat panels and their seams, from a file of a pattern.

#include "cases/input/table.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_garment.hpp"

namespace gambeson {
namespace schema {
namespace {

Object patternGarmentTable() {
  using P = PatternGarment;
  return Table<P>("Garment of a pattern")
      .path("path", &P::path, "a pattern as gambeson import writes it, relative to the case's folder")
      .required()
      .number("cell", &P::cell_m, "m", between(0.001, 0.2), "wanted size of a cell, along weft and warp")
      .integer("degree", &P::degree, 2, 5, "polynomial degree")
      .number("close_within", &P::close_within_s, "s", aboveTo(0, 100),
              "by then its seams are closed around the wearer; else the run says which gape, and by how much")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

Garment readPanels(const GarmentCase& g) {
  const auto& p = std::get<PatternGarment>(g.shape);
  const FlatPattern pattern = readPattern(p.path);
  try {
    return panelGarment(pattern, {p.cell_m, p.degree});
  } catch (const InputError& e) {
    throw InputError({p.path.string(), 0, e.where().key}, e.reason());
  }
}

}  // namespace

extern const GarmentKind pattern_garment;
const GarmentKind pattern_garment{
    .word = "pattern",
    .sewn = true,
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<PatternGarment>("pattern", &GarmentCase::shape, schema::patternGarmentTable(),
                                            "flat panels from a file, sewn around the wearer");
        },
    .make = [](const GarmentMaking& m) { return readPanels(m.worn); },
    .look = readPanels,
    .files = [](GarmentCase& g, const GarmentKind::Take& take) { take(std::get<PatternGarment>(g.shape).path); },
};

}  // namespace gambeson
