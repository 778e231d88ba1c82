#pragma once
/// A cell at rest, and on its way through one load: what each of them leaves. Units that know nothing of each other.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cases/cell/engine.hpp"

namespace gambeson {

/// Stiffness of the cloth at rest, by area of the cell at rest. What the engine has not is absent.
struct RestStiffness {
  /// d(n11, n22, n12)/d(E11, E22, 2 E12) [N/m], by rows.
  std::optional<std::array<double, 9>> membrane_N_per_m;
  /// D11, D22 and D12 + 2 D66 [N m] of M(theta) = D(theta) k, theta from the weft:
  ///   D(theta) = D11 cos⁴ + D22 sin⁴ + 2 (D12 + 2 D66) sin² cos²
  /// Cylinders cannot tell D12 from D66.
  std::optional<std::array<double, 3>> bending_Nm;
  std::string why{};  ///< of what is absent though the engine has it
};
RestStiffness restStiffness(const CellEngine& engine);

/// A row of the table of a path, and where yarns were there if that is kept.
struct WalkedRow {
  double part = 0;  ///< of the way
  BalancedCell point;
  std::optional<YarnShape> shape;
};

struct WalkedPath {
  std::vector<WalkedRow> rows;
  bool reached = true;
  std::string why;  ///< else, and where
};

/// `each` is called after every row.
WalkedPath walk(const CellEngine& engine, const PathCase& path, CellShapesKept kept, const std::function<void()>& each);

}  // namespace gambeson
