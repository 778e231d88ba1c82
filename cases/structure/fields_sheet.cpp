#include "cases/structure/fields_sheet.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/cloth/kind_fields.hpp"
#include "cases/cloth/membrane_fields.hpp"
#include "cases/cloth/node_fields.hpp"

#include <fmt/format.h>

namespace gambeson::schema {
namespace {

using namespace sheet;

template <class Get>
void addKnots(Table<SheetCase>& table, const std::string& key, Get get, const std::string& along) {
  Field f = fieldOf(key, Kind::numbers, "", between(0, 1),
                    fmt::format("further knots along {}, fractions of each patch's range (strictly between 0 and 1); "
                                "repeat a knot to lower the smoothness there",
                                along));
  table.custom(
      f,
      [get](const Entry& p, SheetCase& s) {
        s.*get = readNumbers(p, "", {.low = 0, .high = 1, .low_open = true, .high_open = true});
      },
      [get](const SheetCase& s) { return std::optional(nodeOfList(s.*get)); });
}

}  // namespace

Object structureSheetTable() {
  using S = SheetCase;
  Table<S> table("Sheet");
  table.alternative<PlateShape>("plate", &S::shape, plateTable(), "a flat rectangle")
      .in("shape")
      .alternative<CylinderShape>("cylinder", &S::shape, cylinderTable(), "a circular cylinder or a part of one, exact")
      .in("shape")
      .alternative<SphereShape>("sphere", &S::shape, sphereTable(), "a zone of a sphere or a part of one, exact")
      .in("shape")
      .alternative<AnnulusShape>("annulus", &S::shape, annulusTable(), "a flat ring or a part of one, exact")
      .in("shape")
      .alternative<NurbsShape>("nurbs", &S::shape, nurbsTable(), "NURBS patches, written out")
      .in("shape")
      .alternative<SheetFile>("file", &S::shape, sheetFileTable(), "patches and seams from a garment file")
      .in("shape")
      .oneOf("shape", true)
      .integer("degree", &S::degree, 2, 5,
               "polynomial degree of both directions; the geometry stays exact (k-refinement: first the degree, then "
               "the knots). Patches of your own are raised to it where they are lower")
      .integer("cells_u", &S::cells_u, 1, 2000,
               "cells along u of a built shape. Arcs are joined of pieces of at most 90 deg, each with the same number "
               "of cells, by seams with common tangents: cells must be at least as many as quarters")
      .defaultsTo("16 for built shapes")
      .integer("cells_v", &S::cells_v, 1, 2000, "cells along v of a built shape")
      .defaultsTo("16 for built shapes")
      .integer("split", &S::split, 1, 1000, "nurbs and file: into how many parts each of their cells is split each way")
      .defaultsTo("1 for nurbs and file");
  addKnots(table, "refine_u", &S::refine_u, "u");
  addKnots(table, "refine_v", &S::refine_v, "v");
  table.direction("weft", &S::weft, "direction 1 of the material, projected on the surface")
      .defaultsTo(
          "axis_u of a plate, axis of a cylinder or sphere, zero of an annulus, along u in the middle of a patch of "
          "your own")
      .number("weft_angle", &S::weft_angle_rad, "rad", between(-7, 7),
              "turns the weft about the normal, counter-clockwise seen against it")
      .list("trim", &S::trim, trimTable(), "closed loops that cut the sheet")
      .integer("trim_points", &S::trim_points, 0, 20,
               "integration points each way on the pieces of cut cells; 0: degree + 1")
      .number("trim_unused", &S::trim_unused, "", between(0, 0.5),
              "control points with less than this part of their area inside follow their neighbours")
      .list("fields", &S::fields, fieldsTable(FieldsOf::sheet),
            "thickness, fibre angle and material that vary over a patch")
      .object("imperfection", &S::imperfection, noiseTable(), "deviation of the stress-free shape along its normal")
      .defaultsTo("none")
      .choice(
          "cell_rule", [](auto& s) -> auto& { return s.cloth.rule; }, cellRules(),
          "integration of quadratic cells, which lock in bending under full, 3 x 3 Gauss points; automatic: 2 x 2, "
          "but 3 across a patch of a single cell, and 3 x 3 on trimmed patches; assumed: strains taken at the "
          "knots, free of locking but less accurate for wrinkles. Other degrees: degree + 1")
      .integer(
          "gauss_extra", [](auto& s) -> auto& { return s.cloth.gauss_extra; }, 0, 5,
          "more integration points each way than the rule takes")
      .choice(
          "model", [](auto& s) -> auto& { return s.cloth.kind; }, clothKinds(), clothKindDoc())
      .unwritten()
      .choice(
          "mesh", [](auto& s) -> auto& { return s.cloth.mesh; }, meshKinds(), meshKindDoc())
      .unwritten()
      .choice(
          "bending_elements", [](auto& s) -> auto& { return s.cloth.bending; }, bendingElements(), bendingElementsDoc())
      .unwritten()
      .number(
          "bending_spring", [](auto& s) -> auto& { return s.cloth.bending_spring_N_per_m; }, "N/m", between(0, 1e6),
          bendingSpringDoc())
      .unwritten();
  addMembraneFields(table);
  addNodeFields(table);
  return table.build();
}

}  // namespace gambeson::schema
