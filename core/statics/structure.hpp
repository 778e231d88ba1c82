#pragma once
/// A sheet with supports and loads: what the solvers see.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/cloth/cloth.hpp"
#include "core/cloth/constraint.hpp"
#include "core/math/cholesky.hpp"
#include "core/statics/program.hpp"
#include "core/statics/reduction.hpp"

namespace gambeson {

/// Constant after it is built. Unknowns y: displacements and inner unknowns that satisfy the supports, u = C y + shifts
/// (DofMap); points q = rest + T u.
struct Structure {
  std::shared_ptr<const Cloth> cloth;
  DofMap dofs;
  Loads loads;
  std::vector<Program> programs;
  std::unique_ptr<const ClothTangent> tangent;
  Reduction reduction;              ///< of the tangent to the unknowns
  std::vector<DeadLoad> dead;       ///< part of `loads`: those with a potential
  std::vector<double> lumped_kg;    ///< row sums, of the free points
  SparseRows consistent_kg;         ///< ∫ rho N N dA on the free points
  double rayleigh_mass_per_s = 0;   ///< a in C = a M + b K
  double rayleigh_stiffness_s = 0;  ///< b
  double drag_kg_per_m2s = 0;       ///< Zheng 2013, section 2.2.3
  std::vector<double> area_m2;      ///< ∫ N dA of the free points
  std::vector<double> inner_mass;   ///< of the rates of the inner unknowns (Cloth::innerMasses), lumped or not

  /// What drag takes from inner unknowns, over their mass: what it takes from a mean point [1/s].
  double innerDrag() const;
};

struct StructureOptions {
  std::vector<LinearConstraint> constraints;
  std::vector<DeadLoad> dead;
  std::vector<PressureLoad> pressure;
  std::vector<EdgeMoment> moments;
  std::vector<Program> programs;  ///< none: one, from 0 at 0 to 1 at 1
  double rayleigh_mass_per_s = 0, rayleigh_stiffness_s = 0, drag_kg_per_m2s = 0;
};

/// The unknowns that supports leave of a cloth. Inner unknowns are there as lengths by which they have the mass of a
/// mean free point: all are of one size. Directors are lengths by the side of a mean cell, so that a turn is as stiff
/// as a stretch, however thin the sheet is. Throws InputError.
DofMap dofsOf(const Cloth& cloth, std::span<const LinearConstraint> constraints, int programs);

/// Throws InputError (key "sewn_seams") where a cloth has seams that explicit steps alone hold.
void refuseProjectedSeams(const Structure& structure);

/// Throws InputError.
std::unique_ptr<Structure> buildStructure(std::shared_ptr<const Cloth> cloth, const StructureOptions& options);

}  // namespace gambeson
