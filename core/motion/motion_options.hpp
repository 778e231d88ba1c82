#pragma once
/// Which scheme moves a Model.

namespace gambeson {

enum class MotionScheme { verlet, euler, symplectic_euler, midpoint, runge_kutta, implicit_euler, semi_implicit };

struct MotionOptions {
  MotionScheme scheme = MotionScheme::verlet;
  int substeps = 1;               ///< semi_implicit: of bending in a step
  /// implicit_euler, semi_implicit: CgReport::residual. What 1e-4 leaves is a fifth of what a step of 2 ms leaves (drape
  /// over a sphere, 2 kN/m: contact force and energies against 1e-6, and against half the step).
  double solve_tolerance = 1e-4;
};

/// Whether velocities are solved for. A step may be as long as one likes then, but for what is explicit in it.
inline bool isImplicit(MotionScheme s) {
  return s == MotionScheme::implicit_euler || s == MotionScheme::semi_implicit;
}

}  // namespace gambeson
