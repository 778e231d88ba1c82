#pragma once
/// What computes a cell: an interface with a class for each way of seeing yarns, chosen by `yarns` of the case.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/cell/paths.hpp"
#include "cases/cell/yarn_shape.hpp"
#include "core/yarn/cell_response.hpp"

namespace gambeson {

/// A cell in equilibrium.
struct BalancedCell {
  CellLoad load;
  CellResultants resultants;          ///< its energy is what is stored: in yarns, in contact, in what friction holds
  double lost_J_per_m2 = 0;           ///< by friction, on the whole way from rest
  std::array<double, 2> tension_N{};  ///< the largest of the yarns of a direction
  bool stable = true;
  int iterations = 0;
  double residual = 0;   ///< forces out of balance, of those that balance
  bool rounded = false;  ///< rounding kept the residual above the tolerance: there is next to no force

  // Of solids:
  /// (S11, S22, S12) as the thesis prints them (Man 2006, eq. 4.64), by the height of the cell [Pa].
  std::array<double, 3> mean_stress_Pa{};
  double passed_m = 0;  ///< how far surfaces have passed through each other, the most
};

/// Whether a target was reached; if not, why, and the last equilibrium before it.
struct CellStep {
  bool reached = true;
  std::string why;
  BalancedCell point;
};

/// One cell that is taken through loads, with whatever it remembers; from rest.
class CellSpecimen {
 public:
  virtual ~CellSpecimen() = default;
  /// From where it is to a target.
  virtual CellStep bring(const CellTarget& to) = 0;
  virtual YarnShape shape() const = 0;
  /// d(n11, n22, n12)/d(E11, E22, 2 E12) [N/m] of flat cloth where it is, by rows; none where the engine has none.
  /// Throws RunError where the cell is not stable.
  virtual std::optional<std::array<double, 9>> membraneTangent() = 0;
  /// D11, D22 and D12 + 2 D66 [N m] of flat cloth where it is, as it begins to bend; none where the engine has none.
  /// Throws RunError where the cell is not stable.
  virtual std::optional<std::array<double, 3>> bendingStiffness() = 0;
};

/// Constant; specimens of it may be moved side by side, and not longer than it lives.
class CellEngine {
 public:
  virtual ~CellEngine() = default;
  virtual std::unique_ptr<CellSpecimen> specimen() const = 0;
  virtual const YarnSurface& surface() const = 0;
  /// What it takes for granted, in sentences.
  virtual std::vector<std::string> assumptions() const = 0;
};

/// Throws InputError with the key of the case where the cell cannot be built.
std::unique_ptr<const CellEngine> makeEngine(const CellCase& c);

}  // namespace gambeson
