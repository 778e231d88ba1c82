#pragma once
/// Strain limits of a structure: those of core/motion/strain_limit.hpp under supports that hold components, couple
/// points or move.

#include <memory>

#include "core/cloth/cloth.hpp"
#include "core/cloth/constraint.hpp"
#include "core/motion/motion_limit.hpp"

namespace gambeson {

struct Structure;

/// Constant after it is built.
struct StructureLimit {
  StrainLimit limit;
  StrainRows rows;
  SparseRows release;  ///< M^-1 C^T: what impulses on the free points do to the unknowns, lumped mass
};

/// Throws InputError.
StructureLimit buildStructureLimit(const Cloth& cloth, const DofMap& dofs, std::span<const double> lumped_kg,
                                   const StrainLimit& limit);

/// Null where the structure has no limits. Lives no longer than the structure.
std::unique_ptr<MotionLimit> motionLimit(const Structure& structure);

/// Throws InputError where there are limits: equilibrium and modes do not see them.
void refuseLimit(const Structure& structure);

/// Forces of the limits on the free points [N]: - J^T lambda with the points at p.
void limitForce(const StrainRows& rows, std::span<const Vec3> p, std::span<const double> multiplier_J,
                std::span<Vec3> force);

/// The free points of a structure, rest + C y + shifts(t).
std::vector<Vec3> freePoints(const Structure& structure, std::span<const double> y, double t);

}  // namespace gambeson
