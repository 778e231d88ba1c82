#pragma once
/// The balance of energy and of linear momentum of a structure's motion, step by step. Nothing here enters the motion.

#include <optional>
#include <vector>

#include "core/motion/structure_motion.hpp"

namespace gambeson {

/// Over the steps so far, with forces F (loads), R (supports) and -d (drag, damping by mass), displacements u, U with
/// what the laws have lost:
///
///   energy:    K + U - (K + U at the start) - ∑ (F0 + F1)/2 . du - ∑ (R0 + R1)/2 . du + ∑ d . du
///   momentum:  P - (P at the start) - ∑ h (F0 + F1 + R0 + R1 - d0 - d1)/2
///
/// The momentum's gap is rounding for explicit steps and the trapezoidal rule, and of second order in the step
/// otherwise; internal forces that do not sum to zero, or a load that is not what it claims to be, open it. The
/// energy's gap is of second order in the step; a step that is too long feeds it. R is what the equation of motion
/// leaves where supports act, and there alone. Stiffness damping is not counted: with it there is no energy's gap.
///
/// Explicit steps say themselves what acted in them (StepReport), with contacts and strain limits; d . du is then the
/// trapezium rule of d . v, and what contacts and limits hold in advance in the velocities is part of the balance.
/// Where a support's program has a kink its points change speed within two steps, and the energy's gap holds up to a
/// quarter of their kinetic energy in between.
class MotionAudit {
 public:
  MotionAudit(const Structure& structure, bool lumped_mass);
  /// Every accepted state of implicit steps; the balance starts at the first. Costs one evaluation of the forces and
  /// one of the energy.
  void observe(const State& state, double lost_J);
  /// Every explicit step.
  void observe(const State& before, const State& after, const StepReport& report);

  bool hasEnergy() const { return structure_.rayleigh_stiffness_s == 0; }
  double energyGap() const { return gap_J_; }
  double largestEnergyGap() const { return largest_gap_J_; }
  /// What explicit and implicit schemes of points have made (positive) or taken themselves, as they say it.
  double integratorEnergy() const { return integrator_J_; }
  double works() const { return works_J_; }  ///< ∑ of the sizes of the works of each step
  Vec3 momentumGap() const { return gap_Ns_; }
  double largestMomentumGap() const { return largest_gap_Ns_; }
  double impulses() const { return impulses_Ns_; }  ///< ∑ of the sizes of the impulses of each step

 private:
  struct Moment {
    double time_s = 0, energy_J = 0;
    Vec3 momentum_Ns, load_N, support_N, damping_N;
    std::vector<Vec3> u, load, support, damping;                          ///< of the free points
    std::vector<double> inner, inner_load, inner_support, inner_damping;  ///< of the inner unknowns
  };
  Moment at(const State& state) const;
  void closeEnergy(double energy_J);

  const Structure& structure_;
  bool lumped_;
  std::vector<char> free_, inner_free_;  ///< of the displacements and inner unknowns: no support acts
  std::optional<Moment> last_;
  std::optional<double> start_of_steps_J_;
  double lost_J_ = 0;
  double start_J_ = 0, gap_J_ = 0, largest_gap_J_ = 0, works_J_ = 0, balance_J_ = 0, integrator_J_ = 0;
  Vec3 start_Ns_, gap_Ns_, balance_Ns_;
  double largest_gap_Ns_ = 0, impulses_Ns_ = 0;
};

}  // namespace gambeson
