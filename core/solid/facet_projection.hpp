#pragma once
/// A node over a facet: gap and local coordinates of its projection, with first and second derivatives in the positions
/// z of the node and of the four corners (15 components in this order).
///
/// With r(xi, z) = x_s - sum_I N_I(xi) x_I and phi = r . r/2 the projection is where phi_a = dphi/dxi_a = 0 (Man 2006,
/// eq. 3.56). B = dr/dz, an index a is a derivative in xi_a, H_ab = phi_ab = r_a . r_b + r . r_ab:
///   dxi_a  = - (H⁻¹)_ab phi_bz,           phi_az = B^T r_a + B_a^T r,
///   d²xi_a = - (H⁻¹)_ab [phi_bcd dxi_c dxi_d + phi_bcz dxi_c + dxi_c phi_bcz + B_b^T B + B^T B_b],
///   g = - r . n,  dg = - B^T n            (3.9, 3.14),
///   d²g = - B_a^T n dxi_a - B^T t^a [B_a^T n + (n . r_ab) dxi_b],  t^a the dual of the tangents t_a = - r_a.
/// Where g = 0 this is Man's d(xi_a) = t^a . (dx_s - dx_m) (3.48); the terms with r are what he leaves out.

#include <array>

#include "core/solid/facet.hpp"

namespace gambeson {

inline constexpr int kProjectionSize = 15;
using ProjectionSlope = std::array<double, kProjectionSize>;
/// 15 x 15, row by row.
using ProjectionMatrix = std::array<double, kProjectionSize * kProjectionSize>;

struct FacetProjection {
  Vec2 local;
  double gap_m = 0;  ///< > 0: the node has passed the facet
  Vec3 normal;
  ProjectionSlope gap_slope{};                   ///< dg/dz
  std::array<ProjectionSlope, 2> local_slope{};  ///< dxi/dz [1/m]
};

/// Of the node at x over the facet at `local`, as projectOnFacet found it.
FacetProjection projectionOf(const FacetCorners& corners, const Vec3& x, const Vec2& local);

/// K += factor d²g.
void addGapCurvature(const FacetCorners& corners, const Vec3& x, const FacetProjection& at, double factor,
                     ProjectionMatrix& K);
/// K += factor_a d²xi_a.
void addLocalCurvature(const FacetCorners& corners, const Vec3& x, const FacetProjection& at, const Vec2& factor,
                       ProjectionMatrix& K);

}  // namespace gambeson
