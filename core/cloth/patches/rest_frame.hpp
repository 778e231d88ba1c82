#pragma once
/// The physical directions of a rest surface.

#include "core/math/vec.hpp"

namespace gambeson {

/// G = d(xi)/dX: columns are the physical directions weft and warp (orthonormal, tangent to the rest surface).
struct RestFrame {
  double G11 = 1, G12 = 0, G21 = 0, G22 = 1, area = 1;  ///< area: |A1 x A2|
};

/// A1, A2: derivatives of the rest surface. The weft is projected on it and turned by `angle` [rad] about the normal.
/// Throws InputError where the surface has no area or the weft is normal to it.
RestFrame restFrame(const Vec3& A1, const Vec3& A2, const Vec3& weft, double angle);

/// kappa_ab = n . x,ab in the physical directions (weft, warp, mixed) [1/m], of a surface with the derivatives a and x;
/// Zheng 2013, eq. 2.9.
Vec3 curvature(const RestFrame& G, const Vec3& a1, const Vec3& a2, const Vec3& x11, const Vec3& x22, const Vec3& x12);

}  // namespace gambeson
