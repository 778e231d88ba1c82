/// Detail of kind.hpp: a cord that draws an edge together.

#include <functional>

#include "cases/wear/case/supports/fields_edge.hpp"
#include "cases/wear/case/supports/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object cordTable() {
  Table<CordSupport> table("Cord");
  edgeField(table);
  table
      .number("tension", &CordSupport::tension_N, "N", aboveTo(0, 1e4),
              "its pull where the edge is as long as at rest; it goes with the edge's length")
      .number("from", &CordSupport::from_s, "s", between(-60, 1e6), "when it begins to be drawn; slack before")
      .defaultsTo("it is drawn from the start on")
      .number("draw", &CordSupport::draw_s, "s", between(0.01, 60), "from then on it is drawn to its tension");
  return table.build();
}

}  // namespace
}  // namespace schema

extern const SupportKind cord_support;
const SupportKind cord_support{
    .word = "cord",
    .addTo =
        [](schema::Table<SupportCase>& table) {
          table.alternative<CordSupport>(
              "cord", std::identity{}, schema::cordTable(),
              "a cord along an edge that is drawn tight, as a belt or a drawstring: it pulls "
              "the edge together, and what lies in it holds it");
        },
    .hold =
        [](const SupportCase& support, const SupportedCloth& on, ModelOptions& options, SupportGroup& group) {
          group.name = on.name + " cord";
          const double tension = std::get<CordSupport>(support).tension_N;
          std::vector<Vec3> X(on.surface.size());
          on.surface.W.multiply<Vec3>(on.cloth.rest(), X);
          for (const std::vector<int>& at : on.lines)
            for (std::size_t k = 0; k + 1 < at.size(); ++k) {
              const double stiffness = tension / norm(X[at[k + 1]] - X[at[k]]);
              group.cord.emplace_back(static_cast<int>(options.stitches.size()), stiffness);
              options.stitches.push_back({at[k], at[k + 1], stiffness, 0});
            }
        },
};

}  // namespace gambeson
