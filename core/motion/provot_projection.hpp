#pragma once
/// Projection onto strain limits one strain after the other (Provot, Graphics Interface 1995; Man 2006, 2.1.1.1),
/// beside fast projection, which solves for all of them at once.

#include "core/motion/strain_limit.hpp"

namespace gambeson {

/// Sweeps over the strains in their order, Gauss and Seidel's way: what is stretched beyond its limit is drawn together
/// by itself,
///   dlambda = C / (J M^-1 J^T),   dp = - M^-1 J^T dlambda,
/// one row of eq. 5.21 of Zheng 2013. Of a spring between two points that are free, that is Provot's correction, both
/// ends moved by their masses; of one whose one end is held it moves the other. He leaves the velocities as they were;
/// here they follow the positions, as those of all limits do, so that momentum is kept where nothing is held. A sweep
/// undoes part of what it has done before: sweeps end where all are within tolerance, or after max_projections of them,
/// and the report says what is left. Upper limits alone, and supports that hold points whole; throws InputError (key
/// strain_limit.method) else. Sets work.multiplier, pull and force as projectStrain does, and adds to the report.
void projectOneByOne(const StrainRows& rows, const StrainLimit& limit, std::span<Vec3> p, LimitReport& report,
                     LimitWork& work);

}  // namespace gambeson
