#pragma once
/// The rows of a contact solve that are iterated on, with the part of the cloth that they touch. Internal to the solve.

#include <cmath>
#include <span>

#include "core/contact/response.hpp"
#include "core/material/laws/friction.hpp"

namespace gambeson {

/// Coulomb's law of the row: the traction cut to its cone.
GAMBESON_LAW Vec3 project(const Vec3& traction, const Vec3& n, double mu, double drag) {
  const double normal[3] = {n.x, n.y, n.z}, trial[3] = {traction.x, traction.y, traction.z};
  double cut[3];
  coulombImpulse<only_resultants>(mu, drag, normal, trial, cut);
  return {cut[0], cut[1], cut[2]};
}

/// v_n - target = (v - drift) . normal.
inline Vec3 driftOf(const ContactRow& row) { return row.body_velocity + row.target_m_per_s * row.contact.normal; }

/// 1/rho, or for cloth on cloth the sum of both, and what the layer yields: the residual's measure.
inline double slopeOf(const ContactRow& row, std::span<const double> density) {
  double slope = 0;
  for (int j = 0; j < row.stencil.count; ++j) slope += std::abs(row.stencil.weight[j]) / density[row.stencil.sample[j]];
  return slope + row.compliance;
}

/// The area that each row stands for, work.area_of; 0 where only held points carry its samples.
void shareAreas(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> area,
                std::span<const double> inverse_mass, ContactWork& work);

/// What the rows of work.order move with, work.reach, where it is not known yet.
void reachRows(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
               std::span<const Vec3> velocity, ContactWork& work);

/// Sets work.change: what these impulses of all rows do to all free points, M^-1 W_T^T B^T i. Sums go over the rows of
/// a sample in their order, then over the samples of a point in theirs: an order that needs no other rows.
void spreadImpulses(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                    std::span<const Vec3> impulses, ContactWork& work);

/// The relative velocity of a row, less its drift, where free points move so.
Vec3 velocityAt(const ContactRow& row, const SparseRows& WT, std::span<const Vec3> velocity);

/// Sorts work.order by islands, which keep the order of their first rows, and these by row_order.hpp; the free points
/// that the rows touch; everything of the iteration that follows from the rows, and its arrays at their sizes.
void restrict(std::span<const ContactRow> rows, int free_count, std::span<const double> inverse_mass,
              std::span<const double> density, std::span<const int> place, std::span<const Vec3> velocity,
              ContactWork& work);

/// Where samples outnumber control points, tractions have parts that move nothing; a solve neither makes nor removes
/// them, so what an impact left would stay. Each warm start moves a fifth of the way to the lumped projection of the
/// traction on the basis, sum_I N_I (sum_s N_I a tau)/(sum_s N_I a), which keeps constants. Sets work.start of the rows
/// that work.in marks, 0 of the others.
/// Contacts of samples on cloth have no direction in common with the others around: theirs take the projection of
/// their normal parts, the two sides of the cloth apart, told by the normal's sign along a direction that no usual
/// sheet lies in.
void smoothWarm(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                std::span<const Vec3> warm, ContactWork& work);

}  // namespace gambeson
