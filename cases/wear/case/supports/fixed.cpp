/// Detail of kind.hpp: an edge that is held.

#include <functional>
#include <set>

#include "cases/wear/case/supports/fields_edge.hpp"
#include "cases/wear/case/supports/fields_held.hpp"
#include "cases/wear/case/supports/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object fixedTable() {
  Table<FixedSupport> table("Fixed edge");
  edgeField(table);
  table.integer("rows", &FixedSupport::rows, 1, 2,
                "rows of control points held: 1 holds the edge, 2 also its slope; of an edge of a panel, which lies "
                "across the cells, all that shape it are held, and with them its slope");
  heldFields(table);
  return table.build();
}

}  // namespace
}  // namespace schema

extern const SupportKind fixed_support;
const SupportKind fixed_support{
    .word = "fixed",
    .addTo =
        [](schema::Table<SupportCase>& table) {
          table.alternative<FixedSupport>("fixed", std::identity{}, schema::fixedTable(),
                                          "an edge that stays where it is in the world, or is moved");
        },
    .hold =
        [](const SupportCase& support, const SupportedCloth& on, ModelOptions&, SupportGroup& group) {
          group.name = on.name + " held";
          const Mounting& mounting = on.cloth.mounting();
          for (const PatchEdge& e : on.edge.edges) {
            const std::vector<int> points = mounting.edgePoints(e, std::get<FixedSupport>(support).rows);
            group.control_points.insert(group.control_points.end(), points.begin(), points.end());
          }
          std::set<int> shaping;  // lines across the cells
          for (const std::vector<EdgePlace>& line : on.edge.lines)
            for (const EdgePlace& place : line) {
              const PlaceRow row = mounting.place(place.patch, place.uv);
              for (std::size_t k = 0; k < row.columns.size(); ++k)
                if (row.value[k] > 1e-12) shaping.insert(row.columns[k]);
            }
          group.control_points.insert(group.control_points.end(), shaping.begin(), shaping.end());
        },
};

}  // namespace gambeson
