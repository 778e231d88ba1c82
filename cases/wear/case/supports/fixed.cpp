/// Detail of kind.hpp: an edge that is held.

#include <functional>

#include "cases/wear/case/supports/fields_edge.hpp"
#include "cases/wear/case/supports/fields_held.hpp"
#include "cases/wear/case/supports/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object fixedTable() {
  Table<FixedSupport> table("Fixed edge");
  edgeField(table);
  table.integer("rows", &FixedSupport::rows, 1, 2, "rows of control points held: 1 holds the edge, 2 also its slope");
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
          for (const PatchEdge& e : on.edges) {
            const std::vector<int> points = on.cloth.mounting().edgePoints(e, std::get<FixedSupport>(support).rows);
            group.control_points.insert(group.control_points.end(), points.begin(), points.end());
          }
        },
};

}  // namespace gambeson
