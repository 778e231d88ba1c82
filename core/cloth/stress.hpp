#pragma once
/// Strain and stress at points of a cloth.

#include <functional>
#include <span>
#include <vector>

#include "core/cloth/cloth_state.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Principal resultants and strains at one point.
struct PrincipalStress {
  double principal1_N_per_m = 0, principal2_N_per_m = 0;  ///< true (Cauchy) resultants, first >= second
  double strain1 = 0, strain2 = 0;                        ///< principal Green-Lagrange strains, first >= second
};

/// All that the law sees and says at one point, in the physical basis (weft, warp, shear or twist) of the rest surface:
/// Green-Lagrange strains (E11, E22, 2 E12), changes of curvature (k11, k22, 2 k12) [1/m], their conjugates n [N/m]
/// (second Piola-Kirchhoff) and m [N].
struct PointState {
  Vec3 strain, curvature_change, n, m;
};

/// Symmetric, in the basis (weft, warp) of the rest surface, the weft not turned by a fibre angle: so it is continuous
/// where that is not.
struct PlaneTensor {
  double t11 = 0, t22 = 0, t12 = 0;
};

/// Stress and strain as pictures and tables show them: of cells, where a cloth has cells, so that what swings within
/// them is left out. Lives no longer than its cloth.
class StressView {
 public:
  virtual ~StressView() = default;

  /// What is added to the second Piola-Kirchhoff resultants along weft and warp at a place (by strain limits).
  using More = std::function<Vec2(int patch, Vec2 uv)>;

  /// True (Cauchy) resultants, turned back with the sheet's rotation, and Green-Lagrange strains.
  struct Sample {
    PlaneTensor stress, strain;
  };
  virtual std::size_t cells() const = 0;  ///< how many means there are
  /// The means of stress and strain over each cell in a state; `at` and `strainAt` take them.
  virtual std::vector<Sample> means(const ClothState& state, const More& more = {}) const = 0;
  /// Principal values at a place. Where `means` is empty, the means that are needed are computed.
  virtual PrincipalStress at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                             const More& more = {}) const = 0;
  /// Green-Lagrange strain at a place along the fabric's weft and warp, and between them, from the same means.
  virtual PlaneTensor strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const = 0;
};

}  // namespace gambeson
