#pragma once
/// Contact of yarns by the ellipses of their sections, between two sections at a time.

#include <array>

#include "core/math/vec.hpp"
#include "core/yarn/compression.hpp"

namespace gambeson {

/// Energy of a pair of sections by the lengths of both yarns [J/m²] and its derivatives. Unknowns are (x1, turn1, x2,
/// turn2): places in space [m], turns about each section's own axes [rad]. Second derivatives by rows, symmetric also
/// out of balance, where they were asked for.
struct SectionPair {
  double energy = 0;
  double pressing = 0;  ///< force along the normal [N/m²], >= 0
  std::array<Vec3, 4> gradient{};
  std::array<double, 144> tangent{};
};

/// Where yarns cross. A section is a chord of the width 2 a along its second axis, on which the surface stands
/// b - b v²/(2 a²) high at v from its middle: the parabola that the ellipse has at its apex. A pair (s, t) of sections
/// of the two yarns is the place of the cloth where the chords pass each other; v1 and v2 are where on the chords, h
/// the distance of the chords, n normal to both. There the surfaces are
///   d = h + b1 v1²/(2 a1²) + b2 v2²/(2 a2²)
/// apart as middles of yarns that touch at d = D = b1 + b2, and are pressed by the energy per area
///   psi(d) = F(d) sqrt(b1 b2)/(2 pi a1 a2),  W = integral of psi over the cloth = integral of psi/sin(phi) over ds dt
/// with sin(phi) of the angle between chords, F the law of lateral compression. So two straight yarns that cross at
/// right angles carry F(h), spread over the ellipse of their contact (integral of dA over a level of d: 2 pi a1 a2
/// /sqrt(b1 b2)); at another angle F/sin(phi); and a section that turns over the width of the other yarn is turned
/// back, by psi' times the way from its middle. (A bed of springs; Johnson 1985, Contact Mechanics, section 4.3.)
/// Valid: slopes of yarns and turns of sections small against 1 (the thickness is counted along n, not along the
/// section: b theta²/2 of a slope theta is left out), contact no wider than the section (the parabola goes on where the
/// ellipse has ended: half of the width at d = D - b/2), chords not parallel. d > 0.
struct CrossingContact {
  LateralCompression law;
  std::array<double, 2> half_width_m{}, half_thickness_m{};  ///< a, b of both yarns

  double touch_m() const { return half_thickness_m[0] + half_thickness_m[1]; }
  /// d; `above`: 1 where the first yarn lies above (along the cross product of the chords), else -1.
  double distance_m(const Pose& first, const Pose& second, double above) const;
  /// Middles of a pair with d < D are at most so far apart, whatever the angle; of yarns that have not passed through
  /// each other by more than D (h > -D).
  double reach_m() const;
  /// v1 and v2.
  std::array<double, 2> meeting_m(const Pose& first, const Pose& second) const;
  SectionPair evaluate(const Pose& first, const Pose& second, double above, bool tangent) const;
};

/// Yarns of one direction side by side: two equal ellipses that touch where the middles are on an ellipse of twice the
/// axes. With r the way between two sections, y1, y2, y3 along the axes of a section (along, across, through), the mean
/// of both sections,
///   rho² = y1²/b² + y2²/(2 a)² + y3²/(2 b)²,  w = 2 a/D psi(rho D)
/// [J/m²], psi and D those of the crossings. A yarn gives way across as it does through the cloth: the energy of a
/// volume is the same function of its strain 1 - rho. The pair's decay along the yarn stands for that over the height
/// of the contact: of two straight parallel yarns at the distance y the integral over ds' is the energy by length of a
/// bed of springs between two parabolas, of the length 2 a,
///   integral of 2 a/D psi(D (y/(2 a) + z²/(2 b²))) dz,
/// exactly where y is near 2 a. Contact begins where y = 2 a: a trellis locks from cos(gamma) = 2 a/spacing on. rho >
/// 0.
struct BesideContact {
  LateralCompression law;
  double half_width_m = 0, half_thickness_m = 0;  ///< of both
  double touch_m = 0;                             ///< D of the crossings
  double by_area = 0;                             ///< psi/F of the crossings [1/m²]

  /// Middles of a pair that touches are at most so far apart.
  double reach_m() const;
  /// rho
  double distance(const Pose& first, const Pose& second) const;
  SectionPair evaluate(const Pose& first, const Pose& second, bool tangent) const;
};

/// psi/F [1/m²].
double pressureShare(const CrossingContact& crossing);

}  // namespace gambeson
