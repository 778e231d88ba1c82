#pragma once
/// The laws of most garments in few operations: a membrane of St. Venant-Kirchhoff with jamming, and linear or Zheng's
/// bending (core/material/laws: membrane.hpp, jamming.hpp, linear_bending.hpp, zheng_bending.hpp).

#include "core/material/laws/jamming.hpp"
#include "core/material/laws/linear.hpp"
#include "gpu/forces/roots.hpp"

namespace gambeson::gpu {

/// Strains (E11, E22, 2 E12) or resultants (11, 22, 12).
struct Voigt3 {
  double a, b, c;
};

struct PlainNumbers {
  OrthotropicStiffness<double> membrane{};
  double D[3]{};      ///< rigidities along weft, warp, of twist [N m]
  double steep[2]{};  ///< Zheng: 2 B0 sqrt(k0/kr) along weft, along warp [N m]
  double k0 = 0, kr = 0, inverse_kr2 = 0;
  bool zheng = false, jams = false;
  double jam_N_per_m = 0, jam_s = 0;
};

/// zhengCurve (core/material/laws/zheng_bending.hpp).
GAMBESON_HD inline double zhengMoment(const PlainNumbers& l, double b0, double steep, double k) {
  const double a = ::fabs(k);
  double m;
  if (a > l.k0)
    m = b0 * (a + l.k0);
  else if (a > l.kr)
    m = 2.0 * b0 * quickRoot(l.k0 * a);
  else
    m = steep * a * ::fma(-0.25 * l.inverse_kr2, a * a, 1.25);
  return k < 0 ? -m : m;
}

GAMBESON_HD inline Voigt3 momentOf(const PlainNumbers& l, const Voigt3& k) {
  if (!l.zheng) return {l.D[0] * k.a, l.D[1] * k.b, l.D[2] * k.c};
  return {zhengMoment(l, l.D[0], l.steep[0], k.a), zhengMoment(l, l.D[1], l.steep[1], k.b), l.D[2] * k.c};
}

GAMBESON_HD inline Voigt3 tensionOf(const PlainNumbers& l, const Voigt3& e) {
  const auto& s = l.membrane;
  Voigt3 n{::fma(s.s12, e.b, s.s11 * e.a), ::fma(s.s22, e.b, s.s12 * e.a), s.s33 * e.c};
  if (l.jams) {
    // Where the area has not shrunk so far, nothing is added, to the last bit.
    const double a = ::fma(2.0, e.a, 1.0), b = ::fma(2.0, e.b, 1.0), det = ::fma(a, b, -(e.c * e.c));
    if (det < l.jam_s) {
      const double strain[3] = {e.a, e.b, e.c};
      Answer<double, 3> out;
      out.resultant[0] = n.a, out.resultant[1] = n.b, out.resultant[2] = n.c;
      addJamming<only_resultants>(l.jam_N_per_m, l.jam_s, strain, out);
      n = {out.resultant[0], out.resultant[1], out.resultant[2]};
    }
  }
  return n;
}

}  // namespace gambeson::gpu
