#include "cases/cloth/law_input.hpp"

#include <fmt/format.h>

#include <string>

#include "analysis/ticks.hpp"
#include "cases/cloth/curve_input.hpp"
#include "cases/cloth/law_table.hpp"
#include "cases/input/table.hpp"
#include "cases/yarns/cell_file.hpp"
#include "core/error.hpp"
#include "core/material/linearised.hpp"
#include "core/material/table/curve_energy.hpp"
#include "core/material/table/law_table.hpp"

namespace gambeson {
namespace {

/// What nobody said of how far the fabric may be stretched, its law's range says.
void limitByLaw(FabricCase& fabric, double weft, double warp) {
  fabric.limit_of_law = {!fabric.limit_strain_weft, !fabric.limit_strain_warp};
  if (!fabric.limit_strain_weft) fabric.limit_strain_weft = weft;
  if (!fabric.limit_strain_warp) fabric.limit_strain_warp = warp;
}

}  // namespace

FabricCase withCurves(FabricCase fabric, std::shared_ptr<const LawFile> law) {
  const auto energy = std::make_shared<const CurveEnergy>(*law->curves);
  static_cast<Fabric&>(fabric) = withEnergy(std::move(fabric), energy);
  limitByLaw(fabric, energy->curve(0).end(), energy->curve(1).end());
  fabric.energy_source = EnergySource{{}, std::move(law)};
  return fabric;
}

namespace schema {
namespace {

bool isCurves(const EnergySource& source) { return !source.isCell() && source.table().curves; }

/// One of a table, a cell and curves, the first two by their file or by what that holds.
void requireOne(const Entry& law) {
  const bool table = law.node.find("table") || law.node.find("values"),
             cell = law.node.find("cell") || law.node.find("yarns"), curves = law.node.find("curves");
  if (table && cell) law.failAt(law.node.find("cell") ? "cell" : "yarns", "excludes a table; give one law");
  if (curves && (table || cell)) law.failAt("curves", "excludes a table and a cell; give one law");
  if (!table && !cell && !curves)
    law.failAt("table", "is required: the file of a law table, or values; or cell, or curves");
}

void takeEnergy(const Entry& law, const char* key, std::shared_ptr<const PointEnergy> energy, FabricCase& fabric) {
  try {
    static_cast<Fabric&>(fabric) = withEnergy(std::move(fabric), std::move(energy));
  } catch (const InputError& e) {
    law.failAt(key, e.reason());
  }
}

void resolveTable(const Entry& law, const LawInput& in, FabricCase& fabric) {
  const auto content = in.values ? in.values : std::make_shared<const LawFile>(readLawTable(in.table));
  const auto energy = std::make_shared<const LawTable>(content->table);
  takeEnergy(law, "table", energy, fabric);
  const auto range = energy->range();
  limitByLaw(fabric, range[0][1], range[1][1]);
  fabric.energy_source = EnergySource{in.table, content};
}

void resolveCurves(const Entry& law, const LawInput& in, FabricCase& fabric) {
  try {
    fabric = withCurves(std::move(fabric), in.curves);
  } catch (const InputError& e) {
    law.failAt("curves", e.where().key + " " + e.reason());
  }
}

void resolveCell(const Entry& law, const LawInput& in, FabricCase& fabric) {
  std::shared_ptr<const CellFile> content = in.yarns;
  std::shared_ptr<const CellEnergy> energy;
  if (content) {
    energy = energyOf(law.member(*law.node.find("yarns")), *content);
  } else {
    const JsonNode root = readJson(in.cell);
    const std::string name = in.cell.string();
    const Entry file{root, "", name};
    if (!root.find("kind")) file.failAt("kind", "is required: cell, a case of yarns");
    content = std::make_shared<const CellFile>(readCellFile(file));
    energy = energyOf(file, *content);
  }
  takeEnergy(law, "cell", std::move(energy), fabric);
  fabric.energy_source = EnergySource{in.cell, std::move(content)};
}

}  // namespace

Object lawTable() {
  using L = LawInput;
  Field curves = fieldOf("curves", Kind::object, "", any(),
                         "in place of a table, curves of tension along weft and warp, through measured points");
  curves.object = std::make_shared<const Object>(curvesTable());
  return Table<L>("Law of a fabric")
      .path("table", &L::table, "file of a law table (see Law tables, and gambeson homogenise)")
      .defaultsTo("required, or values, or cell, or curves")
      .custom(
          fieldOf("values", Kind::any, "", any(), "what such a file holds, in its place"),
          [](const Entry& p, L& l) { l.values = std::make_shared<const LawFile>(readLawFile(p)); },
          [](const L& l) { return l.values ? std::optional(nodeOf(*l.values)) : std::nullopt; })
      .defaultsTo("those of the file; a finished run keeps them")
      .path(
          "cell", &L::cell,
          "file of a case of kind cell, whose rods are solved at every point of the cloth: in static cases with nurbs "
          "cloth; gambeson homogenise makes a table of it for all others")
      .defaultsTo("none")
      .custom(
          fieldOf("yarns", Kind::any, "", any(), "what such a file says of its yarns, in its place"),
          [](const Entry& p, L& l) { l.yarns = std::make_shared<const CellFile>(readCellFile(p)); },
          [](const L& l) { return l.yarns ? std::optional(nodeOf(*l.yarns)) : std::nullopt; })
      .defaultsTo("those of the file; a finished run keeps them")
      .custom(
          curves,
          [o = curves.object](const Entry& p, L& l) {
            auto law = std::make_shared<LawFile>();
            readObject(*o, p, &law->curves.emplace());
            l.curves = std::move(law);
          },
          [o = curves.object](const L& l) {
            return l.curves ? std::optional(writeObject(*o, &*l.curves->curves)) : std::nullopt;
          })
      .defaultsTo("none")
      .choice("rest", &L::rest,
              std::vector<std::pair<std::string, RestCurvature>>{{"zero", RestCurvature::zero},
                                                                 {"shape", RestCurvature::shape}},
              "curvature without moment: zero (flat cloth, sewn), or that of the garment's rest shape")
      .build();
}

void refuseReplaced(const Entry& entry, const char* by) {
  for (const char* key : {"young", "young_weft", "young_warp", "shear", "stiffness", "stiffness_weft", "stiffness_warp",
                          "shear_stiffness", "shear_loop", "poisson", "jam_area", "bending"})
    if (entry.node.find(key))
      entry.failAt(key, fmt::format("has no meaning where {}, which replaces it; remove it", by));
}

void resolveLaw(const Entry& entry, const LawInput& in, FabricCase& fabric) {
  refuseReplaced(entry, "\"law\" is given");
  fabric.shear_friction = {};  // of a card
  const Entry law = entry.member(*entry.node.find("law"));
  requireOne(law);
  if (!in.cell.empty() || in.yarns)
    resolveCell(law, in, fabric);
  else if (in.curves)
    resolveCurves(law, in, fabric);
  else
    resolveTable(law, in, fabric);
  fabric.rest_curvature_of_shape = in.rest == RestCurvature::shape;
}

LawInput restoreLaw(const FabricCase& fabric) {
  const EnergySource& source = *fabric.energy_source;
  LawInput in;
  (source.isCell() ? in.cell : in.table) = source.file;
  if (isCurves(source))
    in.curves = std::get<0>(source.content);
  else if (source.isCell())
    in.yarns = std::get<1>(source.content);
  else
    in.values = std::get<0>(source.content);
  in.rest = fabric.rest_curvature_of_shape ? RestCurvature::shape : RestCurvature::zero;
  return in;
}

namespace {

std::string cellInWords(const EnergySource& source) {
  const CellFile& cell = source.cell();
  return fmt::format(
      "Its law is a cell of yarns{}{}, brought to equilibrium at every point of the sheet, from where it was at the "
      "point "
      "of the path before. It bends as at rest; yarns slide without friction.",
      source.file.empty() ? "" : " (" + source.file.filename().string() + ")",
      cell.name.empty() ? "" : ", " + cell.name);
}

std::string tableInWords(const EnergySource& source) {
  const LawFile& law = source.table();
  const auto range = LawTable(law.table).range();
  const LawProvenance& from = law.provenance;
  std::string text = fmt::format(
      "Its law is a table of energy over strain{}: E11 from {} to {} %, E22 from {} to {} %, 2 E12 from {} to {}; "
      "beyond "
      "that the energy goes on convexly, as stiff as at its end. It is elastic",
      source.file.empty() ? "" : " (" + source.file.filename().string() + ")", formatNumber(100 * range[0][0]),
      formatNumber(100 * range[0][1]), formatNumber(100 * range[1][0]), formatNumber(100 * range[1][1]),
      formatNumber(range[2][0]), formatNumber(range[2][1]));
  if (!from.cell_name.empty() || !from.cell.empty())
    text += fmt::format(", computed from a cell of yarns{}", from.cell_name.empty() ? "" : ", " + from.cell_name);
  if (from.error_tension)
    text += fmt::format("; estimated error of tensions {} %", formatNumber(100 * *from.error_tension, 2));
  if (from.error_shear) text += fmt::format(", of shear {} % of the largest", formatNumber(100 * *from.error_shear, 2));
  return text + ".";
}

}  // namespace

std::string lawInWords(const EnergySource& source) {
  if (isCurves(source)) return inWords(*source.table().curves);
  return source.isCell() ? cellInWords(source) : tableInWords(source);
}

}  // namespace schema
}  // namespace gambeson
