#pragma once
/// Solids that touch, at one load: forces and their slopes in the unknowns with given multipliers, and Newton's method
/// for them.

#include <span>
#include <vector>

#include "core/solid/solid_contact.hpp"
#include "core/solid/solid_system.hpp"
#include "core/solid/tangent_solver.hpp"
#include "core/statics/newton.hpp"

namespace gambeson {

struct ContactNewton {
  int iterations = 30;
  double tolerance = 1e-10;  ///< of |r| against the forces that balance
  double least_force = 0;    ///< these count as at least so large [N]
  /// Of each diagonal entry, added to the symmetric tangent that is factorised: what nothing holds takes a step of
  /// nothing, and equilibria stay what they are. 0: a singular tangent ends the iteration.
  double raise = 0;
};

/// Solids in contact at the load t, from the positions `start`, where the step began. Refers to solids, contact and
/// solver.
class ContactSystem {
 public:
  ContactSystem(SolidSystem& solids, const SolidContact& contact, TangentSolver& solver, double t,
                std::vector<Vec3> start)
      : solids_(solids), contact_(contact), solver_(solver), t_(t), start_(std::move(start)) {}

  /// f_int + f_cnt = f_ext with the multipliers held (step 2 of boxes 6 and 7; all zero: the penalty method, 3.28). y
  /// is the start and, where the report says so, the solution. Whole steps; those into states that are not finite are
  /// halved.
  NewtonReport solve(std::span<const ContactMultipliers> multipliers, const ContactNewton& options,
                     std::vector<double>& y);
  /// The multipliers of the last `solve`; where nodes keep facets, with those that pressed for the first time, at zero.
  const std::vector<ContactMultipliers>& known() const { return known_; }

  /// f_int + Gᵀ lambda = f_ext and g = 0 for each of the pairs (3.29, 3.30), whatever the sign of their pressures,
  /// which are solved for too. Rows of g are scaled by A eps_N: they are forces.
  NewtonReport solveTogether(std::span<ContactMultipliers> pairs, const ContactNewton& options, std::vector<double>& y);

  /// How y goes on to first order while the load goes on by dt; empty where the tangent is singular. `raise`:
  /// ContactNewton's.
  std::vector<double> ahead(std::span<const ContactMultipliers> multipliers, std::span<const double> y, double dt,
                            double raise = 0);

  /// SolidContact::points.
  std::vector<ContactPoint> points(std::span<const ContactMultipliers> multipliers, std::span<const double> y,
                                   bool all = false) const;

  /// r of `solve`; returns the size of the forces that balance.
  double residual(std::span<const ContactMultipliers> multipliers, std::span<const double> y, std::span<double> r);
  /// dr/dy, both triangles; entries of one place add up.
  std::vector<MatrixEntry> tangent(std::span<const ContactMultipliers> multipliers, std::span<const double> y);
  /// The same of these points alone.
  std::vector<MatrixEntry> tangentOf(std::span<const ContactPoint> points, std::span<const double> y);

 private:
  void addForce(std::span<const ContactPoint> points, std::span<double> r) const;
  void addSolids(std::span<const double> y, std::vector<MatrixEntry>& entries);
  void addBlock(const ContactBlock& block, std::vector<MatrixEntry>& entries) const;
  bool symmetric() const;
  /// Points that have no multipliers yet get some, of zero: while forces are being balanced they keep their facets.
  void keepFacets(std::span<const double> y);

  SolidSystem& solids_;
  const SolidContact& contact_;
  TangentSolver& solver_;
  double t_;
  std::vector<Vec3> start_;
  std::vector<ContactMultipliers> known_;
};

}  // namespace gambeson
