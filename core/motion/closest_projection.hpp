#pragma once
/// Projection onto strain limits by the whole Newton iteration (Zheng 2013, eq. 5.15 and 5.16), beside fast projection.

#include "core/motion/strain_limit.hpp"

namespace gambeson {

/// Moves the positions p to the point on the constraints C = 0 that is closest to them in the metric of the mass
/// (eq. 5.14), from which fast projection differs by what the gradients turn on the way. With mu = dt^2 lambda and Dq
/// the whole move, each iterate solves
///   [ M + B^T diag(mu) B   J^T ] [dq ]   [ -M Dq - J^T mu ]
///   [ J                     -r ] [dmu] = [ -C             ]
/// (eq. 5.15 times M, symmetric), r = 1e-4 S_ii as in fast projection, until max |C| is within tolerance,
/// max_projections times at most. 3 n + m unknowns where fast projection has m. Limits of equality whose threads do not
/// yield, and supports that hold points whole; throws InputError (key strain_limit.method) else. Sets work.multiplier,
/// pull and force as projectStrain does, and adds to the report.
void projectClosest(const StrainRows& rows, const StrainLimit& limit, std::span<Vec3> p, LimitReport& report,
                    LimitWork& work);

}  // namespace gambeson
