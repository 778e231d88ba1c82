/// Detail of kind.hpp: a point that is held.

#include <fmt/format.h>

#include <functional>

#include "cases/input/table.hpp"
#include "cases/wear/case/supports/fields_held.hpp"
#include "cases/wear/case/supports/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object pinnedTable() {
  Table<PinnedSupport> table("Pinned point");
  table
      .text(
          "garment", [](auto& s) -> auto& { return s.edge.garment; }, "which garment, by its name")
      .defaultsTo("the only garment; required where there are several")
      .integer(
          "patch", [](auto& s) -> auto& { return s.edge.patch; }, 0, 9999, "patch of the garment")
      .number("s", &PinnedSupport::s, "", between(0, 1), "where along u, as a part of the patch's range")
      .number("t", &PinnedSupport::t, "", between(0, 1), "where along v");
  heldFields(table);
  return table.build();
}

}  // namespace
}  // namespace schema

extern const SupportKind pinned_support;
const SupportKind pinned_support{
    .word = "pinned",
    .addTo =
        [](schema::Table<SupportCase>& table) {
          table.alternative<PinnedSupport>(
              "pinned", std::identity{}, schema::pinnedTable(),
              "a point that stays where it is in the world, or is moved: the control points that shape it");
        },
    .on_edge = false,
    .hold =
        [](const SupportCase& support, const SupportedCloth& on, ModelOptions&, SupportGroup& group) {
          const auto& pinned = std::get<PinnedSupport>(support);
          const int p = pinned.edge.patch + on.first_patch;
          const ClothPatch& patch = on.cloth.patches()[static_cast<std::size_t>(p)];
          const auto at = [](double from, double to, double part) { return from + part * (to - from); };
          const PlaceRow row = on.cloth.mounting().place(
              p, {at(patch.low.x, patch.high.x, pinned.s), at(patch.low.y, patch.high.y, pinned.t)});
          group.name = on.name + fmt::format("point ({:.3g}, {:.3g}) held", pinned.s, pinned.t);
          for (std::size_t k = 0; k < row.columns.size(); ++k)
            if (row.value[k] > 1e-12) group.control_points.push_back(row.columns[k]);
        },
};

}  // namespace gambeson
