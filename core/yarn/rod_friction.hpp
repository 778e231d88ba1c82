#pragma once
/// Friction between two rods that touch: Coulomb's law, regularised by a spring that sticks.

#include <array>

#include "core/math/vec.hpp"

namespace gambeson {

/// A pair of sections that presses with the force f [N] carries a tangential force t, |t| <= mu f.
struct RodFriction {
  double coefficient = 0;  ///< mu, 0 to 10; 0: none
  /// Tangential force by slip, by the lengths of both rods [N/m³], > 0 where mu is. Pairs give way at the slip
  /// mu f/(stiffness ds dt).
  double stick_stiffness_N_per_m3 = 0;
};

/// Throws InputError, key "friction.coefficient" or "friction.stick_stiffness", where a number is out of range.
void checkRodFriction(const RodFriction& friction);

/// The two ends of a pair's spring, each fixed to a section and given in its axes [m]. They lie about the middle
/// between the sections, where the surfaces meet; what parts them along the surfaces is the spring's slip, so a turn of
/// both sections about any axis makes none.
struct RodGrip {
  Vec3 on_first, on_second;
};
/// Ends half way between the sections, `slip` (second to first) apart.
RodGrip gripBetween(const Pose& first, const Pose& second, const Vec3& slip_m);

/// g = g_t + c d: the way from one end to the other, along the line d of the sections and across it.
struct RodSlip {
  Vec3 apart;        ///< d: second to first
  Vec3 arm[2];       ///< of the ends, from their sections
  double along = 0;  ///< c
  Vec3 slip;         ///< g_t
};
/// The sections are apart.
RodSlip slipOf(const RodGrip& grip, const Pose& first, const Pose& second);

/// The potential of a step in which the spring of stiffness k has slipped by r, the limit mu f held: what it stores and
/// what it loses,
///   k r²/2 while k r <= mu f, else mu f r - (mu f)²/(2 k)
/// (return mapping as a minimum over the slip that is lost; Simo and Hughes 1998, section 1.4). Once continuously
/// differentiable. The force on the ends is secant * g_t.
struct StickSlip {
  double energy_J = 0, secant_N_per_m = 0;
  bool slides = false;
};
StickSlip stickSlip(double stiffness_N_per_m, double limit_N, double slip_m);

/// Gradient in (x1, turn1, x2, turn2), turns about each section's own axes [rad], and tangent by rows, symmetric.
struct RodFrictionAnswer {
  double energy_J = 0;
  std::array<Vec3, 4> gradient;
  std::array<double, 144> tangent;  ///< where asked for
};
RodFrictionAnswer evaluateRodFriction(const RodGrip& grip, const Pose& first, const Pose& second,
                                      double stiffness_N_per_m, double limit_N, bool tangent);

/// The section as seen from the place v [m] on its second axis.
inline Pose movedAside(const Pose& section, double v_m) {
  return {section.rotation, section.origin + v_m * section.rotation.b};
}
/// What evaluateRodFriction answers of two sections moved aside, in the places and turns of the sections themselves.
RodFrictionAnswer fromAside(const RodFrictionAnswer& answer, const Pose& first, const Pose& second,
                            const std::array<double, 2>& aside_m, bool tangent);

}  // namespace gambeson
