#include "cases/cloth/spring_fields.hpp"

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

}  // namespace gambeson::schema
