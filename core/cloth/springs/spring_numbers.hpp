#pragma once
/// How stiff the springs of a cloth are (spring_net.hpp).

namespace gambeson {

/// What joins every second point: Hooke's springs (Provot), or strips that buckle (Choi and Ko).
enum class Flexion { hooke, buckling };

/// 0: from the fabric.
struct SpringNumbers {
  double structural_N_per_m = 0, shear_N_per_m = 0;
  /// hooke: the stiffness. buckling: with which a strip begins to resist; 0: a quarter of the structural springs beside
  /// it, which stiffens the line by as much again where it is pressed.
  double flexion_N_per_m = 0;
  Flexion flexion = Flexion::hooke;
  double rigidity_Nm = 0;  ///< buckling: B
  bool operator==(const SpringNumbers&) const = default;
};

}  // namespace gambeson
