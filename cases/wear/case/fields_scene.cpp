/// Detail of fields.hpp: the tables of obstacles and supports.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/obstacles/kind.hpp"

namespace gambeson::schema {
namespace {

/// "waist", or "2.u0" for side u0 of patch 2.
const std::vector<std::string> side_names{"u0", "u1", "v0", "v1"};

template <class S>
void edgeField(Table<S>& table) {
  table
      .text(
          "garment", [](auto& s) -> auto& { return s.edge.garment; }, "whose edge it is, by the garment's name")
      .defaultsTo("the only garment; required where there are several");
  Field f;
  f.key = "edge";
  f.kind = Kind::text;
  f.required = true;
  f.doc =
      "which edge of the garment: waist, hem_left, hem_right of shorts; start, end of a tube; u0, u1, v0, v1 of a "
      "sheet; or "
      "patch and side, such as 2.u0";
  table.custom(
      f,
      [](const Place& p, S& s) {
        const std::string& text = readText(p);
        const std::size_t dot_at = text.find('.');
        if (dot_at == std::string::npos) {
          s.edge.name = text;
          return;
        }
        const std::string patch = text.substr(0, dot_at), side = text.substr(dot_at + 1);
        const auto found = std::find(side_names.begin(), side_names.end(), side);
        if (patch.empty() || patch.size() > 4 || patch.find_first_not_of("0123456789") != std::string::npos ||
            found == side_names.end())
          p.fail(describe(p.node) + " is not an edge; allowed: a name, or patch and side such as 2.u0");
        s.edge.name.clear();
        s.edge.patch = std::stoi(patch);
        s.edge.side = static_cast<Side>(found - side_names.begin());
      },
      [](const S& s) {
        return std::optional(nodeOf(
            s.edge.name.empty() ? fmt::format("{}.{}", s.edge.patch, side_names[static_cast<std::size_t>(s.edge.side)])
                                : s.edge.name));
      });
}

}  // namespace

Object obstacleTable() {
  using O = ObstacleCase;
  Table<O> table("Obstacle");
  table.text("name", &O::name, "what the tables call it").required();
  for (const ObstacleKind* kind : obstacleKinds()) {
    kind->addTo(table);
    table.in("shape");
  }
  return table.oneOf("shape", true)
      .vector("velocity", &O::velocity_m_per_s, "m/s", between(-100, 100), "constant velocity")
      .build();
}

Object supportTable() {
  const auto self = [](auto& s) -> auto& { return s; };
  Table<FixedSupport> fixed("Fixed edge");
  edgeField(fixed);
  fixed.integer("rows", &FixedSupport::rows, 1, 2, "rows of control points held: 1 holds the edge, 2 also its slope");
  Table<SpringSupport> springs("Springs");
  edgeField(springs);
  springs
      .number("stiffness", &SpringSupport::stiffness_N_per_m2, "N/m^2", aboveTo(0, 1e8),
              "force per displacement and length of edge")
      .text("link", &SpringSupport::link, "link of the human that the springs are tied to, such as pelvis")
      .required();
  Table<PinnedSupport> pinned("Pinned point");
  pinned
      .text(
          "garment", [](auto& s) -> auto& { return s.edge.garment; }, "which garment, by its name")
      .defaultsTo("the only garment; required where there are several")
      .integer(
          "patch", [](auto& s) -> auto& { return s.edge.patch; }, 0, 9999, "patch of the garment")
      .number("s", &PinnedSupport::s, "", between(0, 1), "where along u, as a part of the patch's range")
      .number("t", &PinnedSupport::t, "", between(0, 1), "where along v");
  return Table<SupportCase>("Support")
      .alternative<FixedSupport>("fixed", self, fixed.build(), "an edge that stays where it is in the world")
      .in("support")
      .alternative<SpringSupport>("springs", self, springs.build(),
                                  "an edge tied by elastic springs to a link of the human, so that it hangs where it "
                                  "was drafted; above a skin they act along it only: contact is what presses; their "
                                  "reactions are reported apart")
      .in("support")
      .alternative<PinnedSupport>("pinned", self, pinned.build(),
                                  "a point that stays where it is in the world: the control points that shape it")
      .in("support")
      .oneOf("support", true)
      .build();
}

}  // namespace gambeson::schema
