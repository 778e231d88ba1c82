#pragma once
/// Kawabata's structure model of a plain weave: straight yarns joined at their crossings (Man 2006, section 4.1.2.1,
/// eqs. 4.1 to 4.9, after Kawabata, Niwa and Kawai 1973).

#include <array>

#include "core/yarn/compression.hpp"

namespace gambeson {

/// One direction. The yarn i of the thesis: a length y_0i of cloth along it holds one segment, up by h_mi to the
/// crossing and down again.
struct KawabataYarn {
  double spacing_m = 0;         ///< y_0, of the crossings along this yarn, > 0
  double crimp_height_m = 0;    ///< h_m, of the crossing over the middle of the yarn's ends, >= 0
  double stretch_N = 0;         ///< EA: F_T = EA (lambda_y - 1), eq. 4.3; a yarn that is slack carries nothing; > 0
  double yarns_per_m = 0;       ///< n, of this direction, > 0
  double half_thickness_m = 0;  ///< b, > 0
};

struct KawabataCloth {
  std::array<KawabataYarn, 2> yarn;
  LateralCompression compression;  ///< Phi of eq. 4.6
};

/// Throws InputError, keys "weft.spacing" and so on, or as checkCompression.
void checkKawabata(const KawabataCloth& cloth);

struct KawabataState {
  std::array<double, 2> deflection_m{};    ///< h_1, h_2
  std::array<double, 2> yarn_stretch{};    ///< lambda_y, eq. 4.1
  std::array<double, 2> yarn_tension_N{};  ///< F_T
  std::array<double, 2> force_N_per_m{};   ///< f, eq. 4.9: by width of the cloth at rest
  double contact_N = 0;                    ///< F_c
};

/// The equilibrium under the stretch ratios lambda_1, lambda_2 > 0: eqs. 4.4 and 4.7,
///   F_c = 2 F_T1 cos(theta_1) = 2 F_T2 cos(theta_2),  h_2 = h_1 - Phi(F_c).
/// With F_c of yarn 1, what is left of the second equation falls with h_1 all the way: bisected from -h_m2 to h_m1, to
/// rounding. Where a range of h_1 is without force the end of it that is nearer to rest is taken. Forces are the
/// derivative of what yarns and crossings store: y_0i F_i = dW/d(lambda_i) of one crossing. Throws InputError, key
/// "stretch", where a ratio is not positive.
KawabataState kawabataState(const KawabataCloth& cloth, const std::array<double, 2>& stretch);

}  // namespace gambeson
