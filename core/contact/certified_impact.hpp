#pragma once
/// When four moving points touch: a point and a triangle, or two edges. Certified in double precision: no impact is
/// missed, none is reported late.

#include <array>
#include <optional>

#include "core/math/vec.hpp"

namespace gambeson {

/// Point and triangle as (p, a, b, c), two edges as (a, b, c, d): ab against cd.
using FourPoints = std::array<Vec3, 4>;

struct ImpactTime {
  double time = 0;  ///< in [0, 1]; up to it the pair is certainly further apart than the separation
  /// Nearest points at that time: (1-u-v) a + u b + v c on the triangle; (1-u) a + u b and (1-v) c + v d on the edges.
  double u = 0, v = 0;
  double gap_m = 0;     ///< distance at that time, to rounding
  bool capped = false;  ///< reported without having come this near: cap of steps, or directions lost to rounding
};

/// Distance over which an impact may be reported early where the caller has no better value. A pair that starts within
/// separation + tolerance is a hit at 0: where starting gaps are smaller, both are to be chosen below them.
constexpr double kImpactTolerance_m = 1e-9;

/// First time in [0, 1] at which the Euclidean distance of the pair may be `separation_m` (>= 0) or less, all four
/// points moving straight at constant speed from x0 to x1.
///
/// Guarantees, for all inputs (relative coordinates below 1e50 m; above, or where one is not finite, the answer is a
/// hit at 0):
/// - nothing returned: the distance exceeds separation_m at all times in [0, 1];
/// - a time returned: the distance exceeds separation_m at all earlier times. A query that reaches its cap of steps is
///   a hit at the time up to which it got.
/// A hit that is not `capped` has a distance of at most separation_m + max(tolerance_m, 2^-46 R) + 2^-46 R at its
/// time, R the largest coordinate difference between the two primitives, at the start or the end.
///
/// Law. Two convex sets are further apart than s where a unit vector n has n.(x_i - x_j) > s for all pairs of corners
/// (3 or 4 pairs). For an n that is constant, linear or quadratic in time these gaps are polynomials of degree 1, 2 or
/// 3 in time. On an interval each lies above the lower hull of its Bernstein coefficients: where the hull lies above
/// s |n| the pair is apart, wherever n came from. In order of cost:
/// - n a coordinate axis: swept boxes;
/// - n the normal of the triangle, or the cross product of the edges, at each time: quadratic. The gap is then the
///   determinant of coplanarity, a cubic, against s max|n|, with either sign;
/// - n the direction between the nearest points, constant from the time t reached so far, or turning linearly to the
///   direction at a later time, just before that at which the nearest points would meet.
/// t moves as far as the best of these certifies: few steps, as in Newton's method. Nearest points and directions may
/// be as inexact as they like: they decide how far a step reaches, never whether it is certain. (An inclusion in time,
/// not in (t, u, v) as in Wang et al. 2021: a direction stands for all u, v.)
///
/// Rounding, u = 2^-53. Inputs enter as differences x_i - x_j, each rounded once: relative error u.
/// - Axes: the sign of a difference is exact, its value to u; s is rounded up by 16u.
/// - Constant n, |n| <= 1 + 5u, |n|_1 <= sqrt(3)(1 + 5u): a gap at 0 or 1 is off by 4u |n|_1 R, interpolation in time
///   adds as much: below 14u R. Linear n: positions at t are off by 5u R, so the coefficients by 8u |n|_1 R, their
///   mean by 2u |n|_1 R more: below 18u R. 32u R = 2^-48 R is taken off both; twice that where a time is solved for,
///   which may itself be off by 2u (and is then rounded down by 4u).
/// - Quadratic n: components of the edges are at most E, F, of the arm W, each with an error of 5u of that at a time
///   within [0, 1]. A component of a coefficient of n: two products (5u + 5u + u), their difference, the mean of two:
///   2EF with an error of 13u 2EF. A coefficient of the determinant: 6EFW in all, with 13u + 5u + u, two sums, three
///   roundings for the weighted mean: 144u EFW, and |n| to sqrt(3) 26u EF; the time at which it falls to the level
///   adds 100u EFW. 512u = 2^-44 of EFW and EF is taken off.
/// Underflow (of products, below 1e-290) is covered by a constant of 1e-280, in m and m^3. No contraction, no
/// reordering: the file is compiled with -ffp-contract=off; the same bits on all instruction sets.
///
/// Which pairs to ask. The queries are complete for two triangles without a common corner (6 point-triangle, 9
/// edge-edge). Triangles that share corners touch there at all times; what else they can do is seen by those of the
/// same queries that have four different vertices:
/// - one common corner o, triangles oab and ocd: the common part of two convex sets is convex and holds o, so a
///   second common point means a whole line segment from o, which leaves one of the triangles through the edge opposite
///   o: the edge ab touches ocd, or cd touches oab. First contact of these is point-triangle (a, b; ocd), (c, d; oab)
///   or edge-edge (ab; cd), (ab; oc), (ab; od), (cd; oa), (cd; ob): all with four different vertices, complete.
/// - a common edge ab, triangles abc and abd: they touch elsewhere where the dihedral angle closes. Then both lie in
///   one plane on one side of ab, so either one apex is in the other triangle, (c; abd), (d; abc), or sides cross,
///   (ac; bd), (bc; ad): complete, with a separation too: these four distances are positive until the angle closes.
/// Queries with a repeated vertex have distance 0 at all times and mean nothing (they are a hit at 0).
std::optional<ImpactTime> pointTriangleImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                              double tolerance_m = kImpactTolerance_m);
std::optional<ImpactTime> edgeEdgeImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                         double tolerance_m = kImpactTolerance_m);

/// Certified lower bound (>= 0) of the distance of a pair at rest, at most 2^-46 R below it where the nearest points
/// are well defined: the separation of a pair is to be chosen below it.
double pointTriangleGap(const FourPoints& x);
double edgeEdgeGap(const FourPoints& x);

}  // namespace gambeson
