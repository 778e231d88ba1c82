#include "cases/cloth/fabric_table.hpp"

#include <fmt/format.h>

#include <string>

#include "analysis/ticks.hpp"
#include "cases/cloth/law_table.hpp"
#include "cases/input/table.hpp"
#include "core/error.hpp"
#include "core/material/linearised.hpp"
#include "core/material/table/law_table.hpp"

namespace gambeson::schema {

Object tableLawTable() {
  using T = TableInput;
  return Table<T>("Law of a fabric")
      .path("table", &T::table, "file of a law table (see Law tables, and gambeson homogenise)")
      .defaultsTo("required, or values")
      .custom(
          fieldOf("values", Kind::any, "", any(), "what such a file holds, in its place"),
          [](const Entry& p, T& t) { t.values = std::make_shared<const LawFile>(readLawFile(p)); },
          [](const T& t) { return t.values ? std::optional(nodeOf(*t.values)) : std::nullopt; })
      .defaultsTo("those of the file; a finished run keeps them")
      .choice("rest", &T::rest,
              std::vector<std::pair<std::string, RestCurvature>>{{"zero", RestCurvature::zero},
                                                                 {"shape", RestCurvature::shape}},
              "curvature without moment: zero (flat cloth, sewn), or that of the garment's rest shape")
      .build();
}

void resolveTable(const Entry& entry, const TableInput& in, FabricCase& fabric) {
  for (const char* key :
       {"card", "young", "young_weft", "young_warp", "shear", "shear_loop", "poisson", "jam_area", "bending"})
    if (entry.node.find(key)) entry.failAt(key, "has no meaning where \"law\" is given, which replaces it; remove it");
  const Entry law = entry.member(*entry.node.find("law"));
  if (in.table.empty() && !in.values) law.failAt("table", "is required: the file of a law table, or values");
  FabricTable table{in.table, in.values};
  if (!table.content) table.content = std::make_shared<const LawFile>(readLawTable(in.table));
  const auto energy = std::make_shared<const LawTable>(table.content->table);
  try {
    static_cast<Fabric&>(fabric) = withEnergy(std::move(fabric), energy);
  } catch (const InputError& e) {
    law.failAt("table", e.reason());
  }
  fabric.rest_curvature_of_shape = in.rest == RestCurvature::shape;
  const auto range = energy->range();
  if (!fabric.limit_strain_weft) fabric.limit_strain_weft = range[0][1];
  if (!fabric.limit_strain_warp) fabric.limit_strain_warp = range[1][1];
  fabric.table = std::move(table);
}

TableInput restoreTable(const FabricCase& fabric) {
  return {fabric.table->file, fabric.table->content,
          fabric.rest_curvature_of_shape ? RestCurvature::shape : RestCurvature::zero};
}

std::string lawInWords(const FabricTable& table) {
  const auto range = LawTable(table.content->table).range();
  const LawProvenance& from = table.content->provenance;
  std::string text = fmt::format(
      "Its law is a table of energy over strain{}: E11 from {} to {} %, E22 from {} to {} %, 2 E12 from {} to {}; "
      "beyond "
      "that the energy goes on convexly, as stiff as at its end. It is elastic",
      table.file.empty() ? "" : " (" + table.file.filename().string() + ")", formatNumber(100 * range[0][0]),
      formatNumber(100 * range[0][1]), formatNumber(100 * range[1][0]), formatNumber(100 * range[1][1]),
      formatNumber(range[2][0]), formatNumber(range[2][1]));
  if (!from.cell_name.empty() || !from.cell.empty())
    text += fmt::format(", computed from a cell of yarns{}", from.cell_name.empty() ? "" : ", " + from.cell_name);
  if (from.error_tension)
    text += fmt::format("; estimated error of tensions {} %", formatNumber(100 * *from.error_tension, 2));
  if (from.error_shear) text += fmt::format(", of shear {} % of the largest", formatNumber(100 * *from.error_shear, 2));
  return text + ".";
}

}  // namespace gambeson::schema
