#pragma once
/// Contact by a penalty (Man 2006, eq. 3.23, 3.27 and box 3).

#include "core/contact/method.hpp"

namespace gambeson {

/// The traction of a row at the start x(n) of a step, eps <g> along its normal, is a force of that instant (eq. 3.27):
///   lambda = dt a eps <g>,   g = layer - gap, the depth in the layer [m],
/// a the area that the row stands for, eps = ContactParameters::penalty_Pa_per_m. Box 3 and eq. 2.85 have the residual
/// with the other sign: a = M^-1 (f_ext - f_int - f_cnt) is meant.
///
/// A node of mass m that meets a body at v sinks by v sqrt(m/(a eps)) + m g/(a eps) and comes back as fast. Its
/// frequency sqrt(eps/rho) shortens the stable step (penaltyFrequency). The layer is the cushion: what comes through it
/// meets the surface and is stopped there as an impact.
class Penalty : public BodyMethod {
 public:
  void prepare(const MethodStep& step, const RowLayer& layer, ContactRow& row) const override;
  ContactSolve solve(const MethodStep& step, const LayeredRows& rows, std::span<Vec3> velocity, std::span<Vec3> warm,
                     std::span<Vec3> impulses, ContactWork& work, MethodWork& scratch) const override;
};

/// The largest frequency that penalties alone give cloth, sqrt(eps/rho) with the least surface density [rad/s]: a
/// bound, as W_T^T a = m/rho. 0 with other methods.
double penaltyFrequency(const ContactParameters& parameters, std::span<const double> density_kg_per_m2);

}  // namespace gambeson
