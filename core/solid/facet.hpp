#pragma once
/// One facet of a contact surface: four corners, bilinear between them (Man 2006, eq. 3.16, 3.17),
///   m(xi) = sum_I N_I(xi) x_I,  N_I = (1 + xi1_I xi1)(1 + xi2_I xi2)/4,  tangents t_a = dm/dxi_a (3.37),
///   n = t_1 x t_2/|t_1 x t_2| (3.38), outward where corners go round against the clock as seen from outside.

#include <array>
#include <optional>

#include "core/math/vec.hpp"

namespace gambeson {

using FacetCorners = std::array<Vec3, 4>;

std::array<double, 4> facetShape(const Vec2& local);
Vec3 facetPosition(const FacetCorners& corners, const Vec2& local);
/// t_1 and t_2.
std::array<Vec3, 2> facetTangents(const FacetCorners& corners, const Vec2& local);
/// Of unit length. The facet has an area there.
Vec3 facetNormal(const FacetCorners& corners, const Vec2& local);

/// Where p lies over the surface of the facet, which goes on beyond its edges: (p - m) . t_a = 0 (3.56), by Newton from
/// the middle. None where that leaves |xi_a| <= `reach`, or does not come to rest.
std::optional<Vec2> projectOnFacet(const FacetCorners& corners, const Vec3& p, double reach);

/// Which part of a facet: corner 0..3, edge 4 (corners 0, 1) to 7 (corners 3, 0), or the face.
enum FacetFeature { kFacetCorner = 0, kFacetEdge = 4, kFacetFace = 8 };

struct FacetPoint {
  Vec2 local;
  Vec3 position;
  double dist2_m2 = 0;
  int feature = kFacetFace;
};

/// The closest point of the facet to p. Edges are straight: theirs is exact. Over the face there may be several minima
/// where a facet is twisted more than p is far from it; the one that Newton finds from the middle is taken, and the
/// edges'.
FacetPoint closestOnFacet(const FacetCorners& corners, const Vec3& p);

}  // namespace gambeson
