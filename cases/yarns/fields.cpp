#include "cases/yarns/fields.hpp"

#include "cases/input/table.hpp"

namespace gambeson::schema {

Object compressionTable() {
  using L = LateralCompression;
  return Table<L>("Lateral compression")
      .number(
          "half_force", &L::half_force_N, "N", aboveTo(0, 1e12),
          "P of F = P ((D - d)/d)^p: what presses two crossing yarns from the distance D of their middles, at which "
          "they touch, to D/2")
      .required()
      .number("exponent", &L::exponent, "", between(2, 6), "p")
      .build();
}

Object cellSolverTable() {
  using S = CellSolver;
  return Table<S>("Solver of a cell")
      .integer("pieces_per_spacing", &S::pieces_per_spacing, 4, 256,
               "rods: pieces of a yarn between two crossings, an even number; with fewer than 16 yarns catch on each "
               "other's sections, and a lightly pressed crossing may be unstable")
      .number("tolerance", &S::tolerance, "", between(1e-13, 1e-3),
              "rods and solids: residual force as a part of the forces that balance")
      .integer("iterations", &S::iterations, 1, 10000, "rods: Newton iterations of a step")
      .integer("halvings", &S::halvings, 0, 30, "rods and solids: how often a step that fails is halved")
      .check([](const Entry& p, const S& s) {
        if (s.pieces_per_spacing % 2 != 0)
          p.failAt("pieces_per_spacing",
                   std::to_string(s.pieces_per_spacing) + " is odd; allowed: even numbers from 4 to 256");
      })
      .build();
}

}  // namespace gambeson::schema
