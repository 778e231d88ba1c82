#pragma once
/// From a cell of yarns to the law of a cloth: its energy by strain and its rigidity against bending, as a table.

#include <array>

#include "core/material/table/law_table_data.hpp"
#include "core/yarn/strain_states.hpp"

namespace gambeson {

struct HomogeniseOptions {
  /// Of E11, E22 and 2 E12, each with 0 inside or at an end. A weave that is its own mirror image is solved for shear
  /// from 0 to the greater end.
  std::array<std::array<double, 2>, 3> range{{{-0.02, 0.10}, {-0.02, 0.10}, {-0.5, 0.5}}};
  /// Wanted, of the tensions n11, n22 and the shear n12, each of the largest in the range.
  double tension_error = 2e-3, shear_error = 8e-3;
  std::array<int, 3> first_nodes{5, 5, 4};  ///< at least 4, so that splines are cubic
  int most_nodes = 4000;                    ///< of all directions together
  bool rigidity_by_strain = true;           ///< at each of the first nodes; otherwise at rest alone
  /// Where a load finds no stable equilibrium: the range becomes four fifths of what it was about rest, up to ten
  /// times.
  bool shrink = false;
  EquilibriumOptions equilibrium{1e-8, 200, 8};
};

/// What went into a table, and how far it can be trusted.
struct HomogenisedCell {
  LawTableData table;
  std::array<std::array<double, 2>, 3> range{};  ///< the one kept
  double largest_tension_N_per_m = 0, largest_shear_N_per_m = 0;
  /// Estimated, of the largest: the greatest differences that each direction of the grid is the cause of, added.
  double tension_error = 0, shear_error = 0;
  bool reached = false;  ///< the errors wanted, within most_nodes
  int checked = 0;       ///< cells solved between nodes
};

/// The table of a cell: W at nodes of a grid of strains, D and (where the faces of the weave differ) b from bendingOf.
/// The grid begins with the first nodes, evenly from rest to both ends. In each direction, on lines through first and
/// last and middle nodes of the first grid of the others, cells are solved at parts 0.2113 and 0.5 of each interval:
/// there the slope of a spline (t (1 - t) (1 - 2 t)) and its value (t² (1 - t)²) err most. The component along the
/// direction errs by this direction alone there, and at nodes (all are looked at); of the others, what the nodes at
/// both ends do not err. While an error is greater than wanted, intervals of the direction that is worst are halved,
/// those with at least half of its greatest error.
///
/// Friction between yarns is left out: an energy has none. Bits do not depend on threads. Throws InputError (keys
/// "range.e11", "range.e22", "range.g12", "first_nodes", "most_nodes", "errors"), NoEquilibrium where a load has no
/// stable equilibrium and the range may not shrink.
HomogenisedCell homogenise(const RodCell& cell, const HomogeniseOptions& options = {});

}  // namespace gambeson
