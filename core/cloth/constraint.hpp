#pragma once
/// Supports as linear equations of control points, and the map from unknowns to positions that satisfies them. Inner
/// unknowns (core/cloth/cloth.hpp) are there as changes of their values from where they start.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/cloth/free_map.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// sum_k dot(coefficient_k, u_k) + sum_l coefficient_l phi_l = amount_m s, with u the displacements of control points
/// from rest, phi inner unknowns and s the value of a program (of time, or of the load factor); amount 0 needs none.
struct LinearConstraint {
  std::vector<std::pair<int, Vec3>> terms;  ///< control point, coefficient
  double amount_m = 0;
  int program = -1;
  std::string name;                             ///< what it came from, for messages
  std::vector<std::pair<int, double>> inner{};  ///< inner unknown, coefficient
};

/// Displacements of the free points, 3 per point, and behind them the inner unknowns, filled up to a multiple of 3:
/// u = C y + sum_k s_k shift_k. C has full column rank. All unknowns y are lengths, those of inner unknowns by
/// `inner_length_m`.
struct DofMap {
  SparseRows C;  ///< a row for each component of u, unknowns columns
  SparseRows Ct;
  std::vector<int> component;  ///< of u, that each unknown is: y_j = u[component[j]], times its length if inner
  std::vector<std::vector<double>>
      shift;  ///< one per program, each as long as u; empty where the program moves nothing
  int points = 0;                      ///< free points: inner unknowns are components from 3 points on
  std::vector<double> inner_length_m;  ///< y of an inner unknown over its value
  int unknowns() const { return C.column_count; }
  /// y_j of the component that it is.
  double unknownOf(int j, double component_value) const {
    const int inner = component[static_cast<std::size_t>(j)] - 3 * points;
    return inner < 0 ? component_value : inner_length_m[static_cast<std::size_t>(inner)] * component_value;
  }
};

/// The part of a map that is of points alone. Points follow no inner unknown.
DofMap pointsOf(const DofMap& dofs);

/// Eliminates the constraints (Gauss-Jordan with the largest coefficient as pivot, or an inner unknown where there is
/// one, in the given order). An equation that follows from earlier ones is dropped; one that contradicts them throws
/// InputError with its name.
DofMap buildDofMap(const FreeMap& map, std::span<const LinearConstraint> constraints, int programs,
                   std::span<const double> inner_length_m = {});

}  // namespace gambeson
