#pragma once
/// Strains and resultants at a point of a cell of the degenerated shell (shell_cell.hpp).

#include "core/cloth/degenerated/shell_cell.hpp"

namespace gambeson {

/// y = S x of a symmetric matrix in Voigt's order.
inline Vec3 times(const Voigt& S, const Vec3& x) {
  return {S[0] * x.x + S[3] * x.y + S[4] * x.z, S[3] * x.x + S[1] * x.y + S[5] * x.z,
          S[4] * x.x + S[5] * x.y + S[2] * x.z};
}
inline Vec3 rowsTimes(const std::array<double, 9>& T, double a, double b, double c) {
  return {T[0] * a + T[1] * b + T[2] * c, T[3] * a + T[4] * b + T[5] * c, T[6] * a + T[7] * b + T[8] * c};
}
/// Tᵀ v.
inline Vec3 columnsTimes(const std::array<double, 9>& T, const Vec3& v) {
  return {T[0] * v.x + T[3] * v.y + T[6] * v.z, T[1] * v.x + T[4] * v.y + T[7] * v.z,
          T[2] * v.x + T[5] * v.y + T[8] * v.z};
}

inline Vec3 strainOf(const ShellPoint& p, const Covariant& c) { return rowsTimes(p.T, c[0], c[1], c[2]); }
inline Vec3 curvatureOf(const ShellPoint& p, const Covariant& c) { return -rowsTimes(p.T, c[3], c[4], c[5]); }

/// Strains of a point and what its law answers, by the covariant strains less those at rest.
struct Resultants {
  Vec3 strain, curvature, n, m;
  Vec2 gamma, shear;
  bool linear = true;
  ClothEnergy in_plane;  ///< per area, where the law is not linear

  Resultants(const ShellLaw& law, const ShellPoint& p, const Covariant& c, const RulePoint& rule,
             const ForceTerms& terms, const History<double>& history = {}) {
    if (rule.plane) {
      strain = strainOf(p, c);
      curvature = curvatureOf(p, c);
      linear = law.isLinear() || terms.steepest;
      if (linear)
        section(law.isLinear() ? law.section : law.steepest, terms);
      else
        remember(law, terms, history);
    }
    if (rule.shear && terms.bending) {
      gamma = {p.slant[0] * c[0] + p.slant[1] * c[1] + p.slant[2] * c[2] + p.across[0] * c[6] + p.across[1] * c[7],
               p.slant[3] * c[0] + p.slant[4] * c[1] + p.slant[5] * c[2] + p.across[2] * c[6] + p.across[3] * c[7]};
      shear = {law.shear_N_per_m * gamma.x, law.shear_N_per_m * gamma.y};
    }
  }
  void section(const Section& s, const ForceTerms& terms) {
    if (terms.membrane) n = times(s.A, strain);
    if (terms.bending) m = times(s.D, curvature);
    if (terms.membrane && terms.bending) {
      n += times(s.B, curvature);
      m += times(s.B, strain);
    }
  }
  /// By laws that no section expresses.
  void remember(const ShellLaw& law, const ForceTerms& terms, const History<double>& history);
  double stored() const {  ///< per area [J/m²]
    if (!linear) return in_plane.stored + 0.5 * (shear.x * gamma.x + shear.y * gamma.y);
    return 0.5 * (dot(n, strain) + dot(m, curvature) + shear.x * gamma.x + shear.y * gamma.y);
  }
  /// Conjugate to the covariant strains, over the area.
  Covariant conjugate(const ShellPoint& p) const {
    const Vec3 of_n = columnsTimes(p.T, n), of_m = -columnsTimes(p.T, m);
    return {of_n.x + p.slant[0] * shear.x + p.slant[3] * shear.y,
            of_n.y + p.slant[1] * shear.x + p.slant[4] * shear.y,
            of_n.z + p.slant[2] * shear.x + p.slant[5] * shear.y,
            of_m.x,
            of_m.y,
            of_m.z,
            p.across[0] * shear.x + p.across[2] * shear.y,
            p.across[1] * shear.x + p.across[3] * shear.y};
  }
};

/// The linear law that has the slopes of this one, at these strains and with this history.
ShellLaw linearAt(const ShellLaw& law, const ShellPoint& point, const Covariant& strains, const ForceTerms& terms,
                  const History<double>& history);

}  // namespace gambeson
