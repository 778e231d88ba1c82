#pragma once
/// Weak seams: patches whose edges do not match, joined by a penalty that scales itself.
///
/// At quadrature points along the union of both edges' knots, with A and D the larger membrane and bending stiffness of
/// the two cloths there (N/m, N m) and h the mean length of the two cells along the edge:
///   E = ∫ 1/2 f A/h |x_a - x_b|^2 + 1/2 f D/h (theta - theta0)^2 ds
/// theta is the angle between the patches about the edge (hingeAngle), so that a rigid motion of any size costs
/// nothing. After Herrema, Johnson, Proserpio, Wu, Kiendl and Hsu, Comput. Methods Appl. Mech. Engrg. 346 (2019)
/// 810-840, with the angle itself in place of their products of base vectors. The factor f needs no tuning: under
/// tension and under bending the seam gives way by about h/f times the strain or the curvature, as if the sheet were
/// longer by h/f. With f = 1e3 that is 1e-3 of one cell: of a strip of two patches and four cells in a row 1.2e-4
/// (tension) and 1.7e-4 (bending) of its displacement (weak_seam_test). The condition number grows by the order of f.
/// An explicit scheme pays with a step smaller by the order of sqrt(f): take matching seams there.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/draft/seams.hpp"

namespace gambeson {

/// One point that holds positions together: energy 1/2 stiffness |sum_k row[k] q[columns[k]]|^2.
struct GapPoint {
  std::vector<int> columns;
  std::vector<double> row;
  double stiffness_N_per_m = 0;  ///< per area and length, times the length it stands for
};

/// All points of the weak seams of a garment. The hinges are evaluated like those of other seams.
struct WeakPoints {
  std::vector<GapPoint> gaps;
  std::vector<HingePoint> hinges;
};

/// Throws InputError (key "weak_seams[i]") where the edges do not lie on one curve to 1e-7 of the length of the shorter
/// (a gap would turn with the sheet and stress it), where neither is joined over its whole length, or where a number is
/// out of range.
WeakPoints buildWeakSeams(const Garment& garment);

/// The size of a fabric's stiffness: of its membrane [N/m] and in bending [N m]. A scale, not a law: the stiffest
/// direction of each ply.
struct StiffnessScale {
  double membrane = 0, bending = 0;
};
StiffnessScale stiffnessScale(const Fabric& fabric);

/// Sewn seams that are weak (SeamHold): each row k of SewnRows has the energy 1/2 f A/h l_k |g_k|^2, l_k the length that
/// it stands for, A and h as above. A multiplier lambda_k per length then leaves the gap lambda_k h/(f A): as the weak
/// seam of one curve does, without more conditions than a multiplier would have, so that a large f locks nothing.
std::vector<GapPoint> weakSewnRows(const Garment& garment);

/// The gap of a point, sum_k row[k] q[columns[k]] [m].
Vec3 gapOf(const GapPoint& gap, std::span<const Vec3> q);
/// Adds the forces - dE/dq of all points to f and returns E [J].
double addWeakForce(const WeakPoints& points, std::span<const Vec3> q, std::span<Vec3> f);
/// d2E/dq2 of a gap point, laid out as hingeStiffness does.
void gapStiffness(const GapPoint& gap, std::vector<std::array<double, 9>>& blocks);

}  // namespace gambeson
