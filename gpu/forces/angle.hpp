#pragma once
/// The angle of a sine and a cosine in basic operations: the same bits on every device.

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// The angle [rad] in [-pi, pi] whose sine and cosine are in this proportion, within two units in the last place. Not
/// for 0 and 0. The fit is that of angleOf in core/math/lanes.hpp.
GAMBESON_HD inline double angleOf(double sine, double cosine) {
  constexpr double pi = 3.14159265358979323846;
  constexpr double fit[] = {1.0,
                            -0.3333333333333286,
                            0.19999999999929946,
                            -0.14285714281592693,
                            0.11111110982087126,
                            -0.09090906605656898,
                            0.0769227555520563,
                            -0.06666371187721098,
                            0.05880342002401543,
                            -0.052527255573225747,
                            0.04719723992321112,
                            -0.042125723963855326,
                            0.03651081352721035,
                            -0.02970071773623423,
                            0.021740213830758134,
                            -0.013674139288399478,
                            0.007038646202989813,
                            -0.0028047655531701315,
                            0.0008033604181626027,
                            -0.00014617088163625013,
                            1.2631178430477426e-05};
  const double up = sine < 0 ? -sine : sine, along = cosine < 0 ? -cosine : cosine;
  const bool steep = up > along;
  const double t = (steep ? along : up) / (steep ? up : along), z = t * t, z2 = z * z;
  double even = fit[20], odd = fit[19];
  for (int k = 18; k >= 0; k -= 2) even = even * z2 + fit[k];
  for (int k = 17; k >= 1; k -= 2) odd = odd * z2 + fit[k];
  double angle = t * (even + z * odd);
  angle = steep ? 0.5 * pi - angle : angle;
  angle = cosine < 0 ? pi - angle : angle;
  return sine < 0 ? -angle : angle;
}

}  // namespace gambeson::gpu
