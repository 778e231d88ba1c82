#pragma once
/// Supports as linear equations of control points, and the map from unknowns to positions that satisfies them.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/cloth/free_map.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// sum_k dot(coefficient_k, u_k) = amount_m s, with u the displacements of control points from rest and s the value of
/// a program (of time, or of the load factor); amount 0 needs none.
struct LinearConstraint {
  std::vector<std::pair<int, Vec3>> terms;  ///< control point, coefficient
  double amount_m = 0;
  int program = -1;
  std::string name;  ///< what it came from, for messages
};

/// Displacements of the free points, 3 per point: u = C y + sum_k s_k shift_k. C has full column rank.
struct DofMap {
  SparseRows C;  ///< 3 x free points rows, unknowns columns
  SparseRows Ct;
  std::vector<int> component;  ///< of u, that each unknown is: y_j = u[component[j]]
  std::vector<std::vector<double>>
      shift;  ///< one per program, each as long as u; empty where the program moves nothing
  int unknowns() const { return C.column_count; }
};

/// Eliminates the constraints (Gauss-Jordan with the largest coefficient as pivot, in the given order). An equation
/// that follows from earlier ones is dropped; one that contradicts them throws InputError with its name.
DofMap buildDofMap(const FreeMap& map, std::span<const LinearConstraint> constraints, int programs);

}  // namespace gambeson
