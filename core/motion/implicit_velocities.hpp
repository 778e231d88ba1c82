#pragma once
/// Implicit Euler, and the semi-implicit scheme with bending in explicit substeps.
///
/// Implicit Euler (Wong 2014, eq. 3.20 to 3.25, Baraff and Witkin 1998), forces linearised where the step starts:
///
///   (M + dt D + dt^2 K) dv = dt (f - dt K v0 - D (v0 - air)),   v1 = v0 + dv,   x1 = x0 + dt v1
///
/// (the printed right side of 3.25 lacks the dt before K_x v). D is the drag, and the
/// cloth's own damping (eq. 3.2, 3.8), which no air moves; K = -df/dx.
///
/// Semi-implicit (section 4.3, after Schroeder et al. 2011): bending is moved explicitly in `substeps` of h =
/// dt/substeps, v += h M^-1 f_b(x), x += h v, to x* and v*; then the rest implicitly, linearised at x0:
///
///   (M + dt D + dt^2 K) dv = dt (f - K (x* - x0) - D (v* - air)),   v1 = v* + dv,   x1 = x* + dt dv
///
/// Without bending this is implicit Euler, with nothing else the symplectic Euler method in steps of h, stable up to
/// h = 2/omega of bending alone. Inner unknowns (edge rotations) go with bending: in its substeps, or implicitly where
/// the cloth's tangent has rows for them, else in one explicit step. Both are of first order. Loads act where the step
/// starts, with their value at its end.

#include "core/motion/velocity_system.hpp"
#include "core/motion/free_motion.hpp"

namespace gambeson {

struct ImplicitVelocityOptions {
  int substeps = 0;         ///< of bending; 0: it is implicit
  double tolerance = 1e-6;  ///< of the solve, CgReport::residual
};

class ImplicitVelocities : public FreeScheme {
 public:
  explicit ImplicitVelocities(const ImplicitVelocityOptions& options) : options_(options) {}
  bool move(const Model& model, const Stage& stage, const State& in, double dt_s, FreeMotion& free, State& out,
            StepReport& report, StepWork& work) override;
  const VelocitySystem& system() const { return system_; }
  /// The right side of the last solve.
  std::span<const Vec3> asked() const { return b_; }

 private:
  /// From in to x* and v*, at_.p and at_.v; impulses of bending into free.elastic.
  void bend(const Model& model, const State& in, double dt_s, FreeMotion& free, State& out, double& inner_lost_J,
            StepWork& work);

  ImplicitVelocityOptions options_;
  VelocitySystem system_;
  State at_;
  std::vector<Vec3> force_, known_, b_, change_, product_, stretched_, whole_way_, damped_;
  std::vector<double> inner_force_;
};

}  // namespace gambeson
