#pragma once
/// A sheet with supports and loads: what the static, implicit and modal solvers see.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/math/cholesky.hpp"
#include "core/sheet/constraint.hpp"
#include "core/sheet/loads.hpp"
#include "core/sheet/shell.hpp"
#include "core/sheet/tangent.hpp"

namespace gambeson {

/// A factor over time (or over the load factor, in statics), linear between its points, constant beyond.
struct Program {
  std::vector<double> at, value;
  double operator()(double t) const;
};

/// Constant after it is built. Unknowns y: displacements that satisfy the supports, u = C y + shifts (DofMap).
struct Structure {
  Shell shell;
  FreeMap map;
  DofMap dofs;
  Loads loads;
  std::vector<Program> programs;
  Tangent tangent;                  ///< assembles on the free points
  std::vector<double> lumped_kg;    ///< row sums, of the free points
  SparseRows consistent_kg;         ///< ∫ rho N N dA on the free points
  double rayleigh_mass_per_s = 0;   ///< a in C = a M + b K
  double rayleigh_stiffness_s = 0;  ///< b
  double drag_kg_per_m2s = 0;       ///< Zheng 2013, section 2.2.3
  std::vector<double> area_m2;      ///< ∫ N dA of the free points
};

}  // namespace gambeson
