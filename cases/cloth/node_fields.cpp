#include "cases/cloth/node_fields.hpp"

namespace gambeson::schema {

Object springsTable() {
  using S = SpringNumbers;
  return Table<S>("Springs of cloth")
      .number("structural", &S::structural_N_per_m, "N/m", aboveTo(0, 1e7),
              "of neighbours along weft and warp; half of it at a border")
      .unwritten()
      .defaultsTo("what the fabric's membrane leaves beside the others")
      .number("shear", &S::shear_N_per_m, "N/m", aboveTo(0, 1e7), "of the diagonals of each cell")
      .unwritten()
      .defaultsTo("the fabric's shear")
      .choice("bending", &S::flexion,
              std::vector<std::pair<std::string, Flexion>>{{"flexion", Flexion::hooke}, {"strips", Flexion::buckling}},
              "what joins every second point. flexion: springs like the others (Provot), limp where flat; strips: arcs "
              "that buckle (Choi and Ko; Man 2006, eq. 2.10), which store B/2 times curvature squared, resist from the "
              "start as a column does, and pull nothing")
      .number("flexion", &S::flexion_N_per_m, "N/m", aboveTo(0, 1e7),
              "of flexion springs, half of it at a border; of strips: with which they begin to resist")
      .unwritten()
      .defaultsTo("stores what the fabric's rigidity does at 1/cm; of strips: a quarter of the structural springs")
      .number("rigidity", &S::rigidity_Nm, "N m", aboveTo(0, 1e3), "of strips: B, moment per width and curvature")
      .unwritten()
      .defaultsTo("the fabric's along them")
      .check([](const Entry& p, const S& s) {
        if (p.node.find("rigidity") && s.flexion != Flexion::buckling)
          p.failAt("rigidity", "is for \"bending\": \"strips\"; flexion springs have a stiffness");
      })
      .build();
}

Object shellTable() {
  using S = DegeneratedOptions;
  return Table<S>("Degenerated shell")
      .choice(
          "rule", &S::rule,
          std::vector<std::pair<std::string, ShellRule>>{{"mitc4", ShellRule::mitc4},
                                                         {"one_point", ShellRule::one_point},
                                                         {"selective", ShellRule::selective},
                                                         {"full", ShellRule::full}},
          "points in the plane of a cell. mitc4: 2 x 2, transverse shear from the middles of the sides (Dvorkin and "
          "Bathe 1984), does not lock; one_point: one for all, the thesis's, leaves hourglass motions without "
          "stiffness; selective: 2 x 2, transverse shear in the middle alone; full: 2 x 2 for all, locks in thin "
          "sheets")
      .number("shear_factor", &S::shear_factor, "", aboveTo(0, 10),
              "of the transverse shear stiffness, factor times G times thickness; 1 in the thesis")
      .choice("rotary", &S::rotary,
              std::vector<std::pair<std::string, RotaryInertia>>{{"exact", RotaryInertia::exact},
                                                                 {"cell", RotaryInertia::cell}},
              "inertia of directors over mass. exact: thickness^2/12; cell: at least a twelfth of the cell's area, so "
              "that explicit steps are as long as those of the membrane; it adds inertia to turns of a cell")
      .build();
}

}  // namespace gambeson::schema
