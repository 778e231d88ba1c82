#include "core/yarn/kawabata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// A yarn whose crossing stands at this height over its ends.
struct Segment {
  double stretch, tension, cos, sin;  ///< cos and sin of the angle with the normal of the cloth, eq. 4.2
  double press() const { return 2 * tension * cos; }
};
Segment segmentAt(const KawabataYarn& y, double height_m, double ratio) {
  const double length = std::hypot(2 * height_m, ratio * y.spacing_m);
  const double stretch = length / std::hypot(2 * y.crimp_height_m, y.spacing_m);
  return {stretch, y.stretch_N * std::max(0.0, stretch - 1), 2 * height_m / length, ratio * y.spacing_m / length};
}

}  // namespace

void checkKawabata(const KawabataCloth& cloth) {
  for (int d = 0; d < 2; ++d) {
    const KawabataYarn& y = cloth.yarn[d];
    const auto check = [&](const char* name, double value, bool zero) {
      if (!((zero ? value >= 0 : value > 0) && std::isfinite(value)))
        throw InputError({"", 0, fmt::format("{}.{}", d == 0 ? "weft" : "warp", name)},
                         fmt::format("{:.6g}, must be {} 0", value, zero ? ">=" : ">"));
    };
    check("spacing", y.spacing_m, false);
    check("crimp_height", y.crimp_height_m, true);
    check("stretch", y.stretch_N, false);
    check("yarns", y.yarns_per_m, false);
    check("half_thickness", y.half_thickness_m, false);
  }
  checkCompression(cloth.compression);
}

KawabataState kawabataState(const KawabataCloth& cloth, const std::array<double, 2>& stretch) {
  for (const double ratio : stretch)
    if (!(ratio > 0 && std::isfinite(ratio)))
      throw InputError({"", 0, "stretch"}, fmt::format("{:.6g}, must be > 0", ratio));
  const double touch = cloth.yarn[0].half_thickness_m + cloth.yarn[1].half_thickness_m;
  const auto first = [&](double h) { return segmentAt(cloth.yarn[0], cloth.yarn[0].crimp_height_m - h, stretch[0]); };
  const auto follow = [&](double h) { return h - cloth.compression.approach_m(first(h).press(), touch); };
  const auto second = [&](double h) {
    return segmentAt(cloth.yarn[1], cloth.yarn[1].crimp_height_m + follow(h), stretch[1]);
  };
  const auto left = [&](double h) { return first(h).press() - second(h).press(); };

  double h = 0;
  const double at_rest = left(0);
  if (at_rest != 0) {
    double low = -cloth.yarn[1].crimp_height_m, high = cloth.yarn[0].crimp_height_m;
    (at_rest > 0 ? low : high) = 0;
    for (h = 0.5 * (low + high); h > low && h < high; h = 0.5 * (low + high)) {
      const double now = left(h);
      (now > 0 || (now == 0 && at_rest < 0) ? low : high) = h;
    }
  }
  KawabataState state;
  state.deflection_m = {h, follow(h)};
  const std::array<Segment, 2> segments{first(h), second(h)};
  for (int d = 0; d < 2; ++d) {
    state.yarn_stretch[d] = segments[d].stretch;
    state.yarn_tension_N[d] = segments[d].tension;
    state.force_N_per_m[d] = cloth.yarn[d].yarns_per_m * segments[d].tension * segments[d].sin;
  }
  state.contact_N = segments[0].press();
  return state;
}

}  // namespace gambeson
