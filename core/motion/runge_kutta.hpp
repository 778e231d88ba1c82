#pragma once
/// Explicit Euler and the Runge-Kutta methods of second and fourth order (Wong 2014, section 3.2.1), and Euler's method
/// with the velocity first (Man 2006, eq. 2.2, which section 2.2 calls forward Euler).
///
///   Euler      v1 = v0 + dt a(x0, v0),  x1 = x0 + dt v0                                      (eq. 3.12, 3.13)
///   symplectic v1 = v0 + dt a(x0, v0),  x1 = x0 + dt v1                                      (Man 2006, eq. 2.2)
///   midpoint   v1 = v0 + dt a(x', v'),  x1 = x0 + dt v',  x' = x0 + dt/2 v0, v' = v0 + dt/2 a(x0, v0)
///                                                                                            (eq. 3.16 to 3.19)
///   fourth     the classical weights 1/6, 1/3, 1/3, 1/6 at 0, 1/2, 1/2, 1
///
/// An oscillator's amplitude squared is multiplied in each step by 1 + z^2, 1 + z^4/4 and 1 - z^6/72 + z^8/576, z =
/// omega dt, of Euler, midpoint and fourth: without damping the first two have no stable step, the last is stable up to
/// z = 2 sqrt(2). The orders that the thesis names, two, three and five, are those of the error of one step. Symplectic
/// Euler keeps |x|^2 + |v|^2/omega^2 - dt x.v of an oscillator, so that its amplitude stays bounded up to z = 2; it is
/// of first order, and velocity Verlet with velocities that belong half a step earlier.

#include "core/motion/free_motion.hpp"

namespace gambeson {

enum class RungeKuttaOrder { symplectic = 0, euler = 1, midpoint = 2, fourth = 4 };

class RungeKutta : public FreeScheme {
 public:
  explicit RungeKutta(RungeKuttaOrder order);
  bool move(const Model& model, const Stage& stage, const State& in, double dt_s, FreeMotion& free, State& out,
            StepReport& report, StepWork& work) override;

 private:
  /// What one evaluation of the forces gives.
  struct Slopes {
    std::vector<Vec3> velocity, acceleration;
    std::vector<double> inner_rate, inner_acceleration;
  };
  void follow(const Model& model, const State& in, double dt_s, int stage);

  RungeKuttaOrder order_;
  std::vector<Slopes> slopes_;
  State at_;  ///< of a stage
  std::vector<double> rate_;
};

/// The longest step in which an oscillator of frequency omega does not grow, where drag takes its velocity at the rate
/// `damping` [1/s] (0: none): symplectic 2/omega, Euler damping/omega^2, midpoint (4 damping/omega^4)^(1/3), both at
/// most 1/omega; fourth order 2 sqrt(2)/omega. To first order in the damping.
double longestStableStep(RungeKuttaOrder order, double omega_rad_per_s, double damping_per_s);

}  // namespace gambeson
