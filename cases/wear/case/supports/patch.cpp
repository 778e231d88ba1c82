/// Detail of kind.hpp: a whole patch that is held.

#include <fmt/format.h>

#include <functional>

#include "cases/wear/case/supports/fields_held.hpp"
#include "cases/wear/case/supports/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object patchTable() {
  Table<PatchSupport> table("Held patch");
  table
      .text(
          "garment", [](auto& s) -> auto& { return s.edge.garment; }, "which garment, by its name")
      .defaultsTo("the only garment; required where there are several")
      .integer(
          "patch", [](auto& s) -> auto& { return s.edge.patch; }, 0, 9999, "patch of the garment");
  heldFields(table);
  return table.build();
}

}  // namespace
}  // namespace schema

extern const SupportKind patch_support;
const SupportKind patch_support{
    .word = "patch",
    .addTo =
        [](schema::Table<SupportCase>& table) {
          table.alternative<PatchSupport>("patch", std::identity{}, schema::patchTable(),
                                          "all of a patch, which stays where it is in the world, or is moved");
        },
    .on_edge = false,
    .hold =
        [](const SupportCase& support, const SupportedCloth& on, ModelOptions&, SupportGroup& group) {
          const int p = std::get<PatchSupport>(support).edge.patch;
          const ClothPatch& patch = on.cloth.patches()[static_cast<std::size_t>(p + on.first_patch)];
          group.name = on.name + fmt::format("patch {} held", p);
          for (int c = patch.first_point; c < patch.end_point; ++c) group.control_points.push_back(c);
        },
};

}  // namespace gambeson
