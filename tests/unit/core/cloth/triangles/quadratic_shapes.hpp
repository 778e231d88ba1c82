#pragma once
/// Fabrics for the tests of quadratic hinges.

#include <vector>

#include "triangle_shapes.hpp"

namespace gambeson::shapes {

constexpr BendingElements kQuadratic = BendingElements::quadratic, kHinge = BendingElements::hinge;
constexpr MeshKind kKinds[] = {MeshKind::single, MeshKind::alternating, MeshKind::equilateral};

inline Fabric fabricOf(const BendingLaw& law) {
  Fabric f;
  f.thickness_m = 1e-3;
  f.density_kg_per_m3 = 500;
  f.young_weft_Pa = 1e7;
  f.young_warp_Pa = 2e7;
  f.poisson = 0.3;
  f.shear_Pa = 0.5e7;
  f.law = law;
  return f;
}
/// Rigidities unlike along weft, along warp and of twist; and those of a solid, with D12.
inline Fabric linear() { return fabricOf(LinearBending{{2e-5, 5e-5, 1e-5}}); }
inline Fabric solid() { return fabricOf(ConsistentBending{}); }
inline std::vector<Fabric> fabrics() { return {linear(), solid()}; }

}  // namespace gambeson::shapes
