#pragma once
/// What a law of cloth as a table is made of: values at the nodes of grids of strain.

#include <array>
#include <cstddef>
#include <vector>

namespace gambeson {

/// Nodes in E11, E22 and 2 E12 (engineering shear: twice the tensor's), each ascending. Splines through n nodes are of
/// degree min(3, n - 1): one node is a constant. Values at nodes are listed with E11 slowest and 2 E12 fastest.
struct StrainGrid {
  std::array<std::vector<double>, 3> nodes;
  std::size_t count() const { return nodes[0].size() * nodes[1].size() * nodes[2].size(); }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (i * nodes[1].size() + j) * nodes[2].size() + k;
  }
  bool operator==(const StrainGrid&) const = default;
};

/// W(E, k) = Wm(E) + k . b(E) + 1/2 k . D(E) . k per area at rest [J/m^2]; k = (k11, k22, 2 k12) [1/m].
struct LawTableData {
  /// The cloth looks the same in a mirror that turns weft over: Wm, b1, b2, D11, D22, D33, D12 are even in shear, b3,
  /// D13, D23 odd. Then the nodes in 2 E12 start at 0, where odd ones are 0 whatever stands there, and negative shear
  /// is the mirror's.
  bool even_in_shear = false;

  StrainGrid membrane;         ///< at least three nodes in each direction (two of the shear where it is even)
  std::vector<double> energy;  ///< Wm [J/m^2] at the nodes

  /// Of b and D. In each direction either one node (constant) or the first and last node of `membrane`.
  StrainGrid bending;
  std::vector<std::array<double, 3>> moment;    ///< b1, b2, b3 [N]: at k = 0; empty: zero
  std::vector<std::array<double, 6>> rigidity;  ///< D11, D22, D33, D12, D13, D23 [N m], 3 of 2 k12; positive definite

  bool operator==(const LawTableData&) const = default;
};

/// Throws InputError (keys "membrane.e11" and so on, "energy", "moment", "rigidity") where nodes do not ascend
/// strictly, are too few or of no plane (E11, E22 > -1/2), counts do not agree, a number is not finite, or a rigidity
/// is not positive definite.
void checkLawTable(const LawTableData& data);

}  // namespace gambeson
