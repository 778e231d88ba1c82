#include "cases/structure_fields_sheet.hpp"

#include <fmt/format.h>

namespace gambeson::schema {
namespace {

using namespace sheet;

Object patchFieldTable(const std::string& unit, const Range& range, const std::string& title) {
  using F = PatchField;
  Field values =
      fieldOf("values", Kind::rows, unit, range, "rows along v of values along u; each count at least degree + 1");
  values.required = true;
  return Table<F>(title)
      .integer("degree", &F::degree, 0, 3,
               "between the values: 0 constant by rectangle, 1 bilinear, 2 and 3 smooth (B-spline coefficients)")
      .custom(
          values,
          [unit, range](const Place& p, F& f) {
            if (p.node.type != JsonNode::Type::list || p.node.children.empty())
              p.fail("expected a list of rows of numbers, not " + describe(p.node));
            f.values.clear();
            f.count_v = static_cast<int>(p.node.children.size());
            for (std::size_t i = 0; i < p.node.children.size(); ++i) {
              const std::vector<double> row = readNumbers(p.item(i), unit, range);
              if (i == 0) f.count_u = static_cast<int>(row.size());
              if (static_cast<int>(row.size()) != f.count_u)
                p.item(i).fail(
                    fmt::format("has {} values, the first row {}; allowed: the same", row.size(), f.count_u));
              f.values.insert(f.values.end(), row.begin(), row.end());
            }
          },
          [](const F& f) {
            JsonNode list = emptyList();
            const std::size_t n = static_cast<std::size_t>(f.count_u);
            for (std::size_t j = 0; j * n + n <= f.values.size(); ++j)
              list.children.push_back(nodeOfList(
                  {f.values.begin() + static_cast<long>(j * n), f.values.begin() + static_cast<long>(j * n + n)}));
            return std::optional(list);
          })
      .check([](const Place& p, const F& f) {
        if (f.count_u < f.degree + 1 || f.count_v < f.degree + 1)
          p.failAt("values", fmt::format("{} x {} values are too few for degree {}; allowed: at least {} x {}",
                                         f.count_u, f.count_v, f.degree, f.degree + 1, f.degree + 1));
      })
      .build();
}

Object fieldsTable() {
  using F = FieldsCase;
  const auto thickness = [](auto& f) -> auto& { return f.fields.thickness; };
  const auto angle = [](auto& f) -> auto& { return f.fields.fibre_angle; };
  const auto material = [](auto& f) -> auto& { return f.fields.material; };
  return Table<F>("Fields over a patch")
      .integer("patch", &F::patch, 0, 10000, "which patch; pieces of a built shape are counted along u, then along v")
      .object("thickness", thickness, patchFieldTable("", aboveTo(0, 100), "Thickness field"),
              "thickness as a multiple of the material's")
      .defaultsTo("the material's")
      .object("fibre_angle", angle, patchFieldTable("rad", between(-7, 7), "Fibre angle field"),
              "turns the weft about the normal")
      .defaultsTo("none")
      .object("material", material, patchFieldTable("", between(0, 1000), "Material field"),
              "0: the material, k: other_materials[k - 1]; between whole numbers the stiffness (in plane stress), "
              "thickness, density and bending rigidities of the two are mixed linearly")
      .defaultsTo("the material everywhere")
      .build();
}

template <class Get>
void addKnots(Table<SheetCase>& table, const std::string& key, Get get, const std::string& along) {
  Field f = fieldOf(key, Kind::numbers, "", between(0, 1),
                    fmt::format("further knots along {}, fractions of each patch's range (strictly between 0 and 1); "
                                "repeat a knot to lower the smoothness there",
                                along));
  table.custom(
      f,
      [get](const Place& p, SheetCase& s) {
        s.*get = readNumbers(p, "", {.low = 0, .high = 1, .low_open = true, .high_open = true});
      },
      [get](const SheetCase& s) { return std::optional(nodeOfList(s.*get)); });
}

}  // namespace

Object noiseTable() {
  using N = NoiseCase;
  return Table<N>("Noise")
      .number("amplitude", &N::amplitude_m, "m", aboveTo(0, 1e9), "largest displacement along the normal")
      .required()
      .integer("seed", &N::seed, 0, 1000000000, "another seed gives another pattern, the same on every machine")
      .integer("from", &N::from, 0, 1000,
               "lowest number of waves over the sheet; 0: no waves, each control point moves by itself")
      .integer("to", &N::to, 0, 1000, "highest number of waves")
      .choice("along", &N::along_v, std::vector<std::pair<std::string, bool>>{{"u", false}, {"v", true}},
              "the direction of the waves")
      .check([](const Place& p, const N& n) {
        if (n.to < n.from) p.failAt("to", fmt::format("{} is out of range; allowed: >= from = {}", n.to, n.from));
        if (n.from == 0 && n.to > 0) p.failAt("from", "is required with \"to\": the lowest number of waves, >= 1");
      })
      .build();
}

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
  return table.direction("weft", &S::weft, "direction 1 of the material, projected on the surface")
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
      .list("fields", &S::fields, fieldsTable(), "thickness, fibre angle and material that vary over a patch")
      .object("imperfection", &S::imperfection, noiseTable(), "deviation of the stress-free shape along its normal")
      .defaultsTo("none")
      .choice("cell_rule", &S::rule,
              std::vector<std::pair<std::string, CellRule>>{
                  {"automatic", CellRule::automatic}, {"full", CellRule::full}, {"assumed", CellRule::assumed}},
              "integration of quadratic cells, which lock in bending under full, 3 x 3 Gauss points; automatic: 2 x 2, "
              "but 3 across a patch of a single cell, and 3 x 3 on trimmed patches; assumed: strains taken at the "
              "knots, free of locking but less accurate for wrinkles. Other degrees: degree + 1")
      .integer("gauss_extra", &S::gauss_extra, 0, 5, "more integration points each way than the rule takes")
      .build();
}

}  // namespace gambeson::schema
