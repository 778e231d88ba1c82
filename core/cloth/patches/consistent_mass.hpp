#pragma once
/// The consistent mass of cloth on patches.

#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// The rest mass of the control points: ∫ rho N N dA, and ∫ N dA.
struct MassIntegral {
  SparseRows mass;
  std::vector<double> area;
};
MassIntegral consistentMass(const Garment& garment);

}  // namespace gambeson
