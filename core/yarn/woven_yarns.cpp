#include "core/yarn/woven_yarns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

constexpr double kTouch = 1e-9;  ///< of a length: what touches does not overlap

[[noreturn]] void refuse(const std::string& key, double value, const std::string& allowed) {
  throw InputError({"", 0, key}, fmt::format("{:.6g} m, must be {}", value, allowed));
}

const char* nameOf(int direction) { return direction == along_weft ? "weft" : "warp"; }

/// The yarn over the section of another, both of plain crossings: whether its lower edge enters the section.
bool runsThrough(const WovenYarn& over, const WovenYarn& under) {
  constexpr int kPlaces = 64;
  const double L = under.spacing_m;
  for (int k = 0; k < kPlaces; ++k) {
    const double s = L * k / kPlaces, wave = std::numbers::pi * s / L;
    const double z = over.amplitude_m * std::cos(wave),
                 slope = -over.amplitude_m * std::numbers::pi / L * std::sin(wave);
    const double n = std::hypot(1, slope), b = over.half_thickness_m;
    const double x = (s + b * slope / n) / under.half_width_m;
    const double y = (z - b / n + under.amplitude_m) / under.half_thickness_m;
    if (x * x + y * y < 1 - kTouch) return true;
  }
  return false;
}

}  // namespace

bool WovenYarns::onTop(int direction, int k, int c) const {
  return direction == along_weft ? !weave.warpOver(c, k) : weave.warpOver(k, c);
}

std::optional<int> WovenYarns::halfTurn(int direction, int k) const {
  const auto symmetric = [&](int halves) {
    for (int i = 0; i < count(direction); ++i)
      for (int c = 0; c < crossings(direction); ++c)
        if (onTop(direction, i, c) != onTop(direction, 2 * k - i, halves - c)) return false;
    return true;
  };
  for (int halves = 0; halves < 2 * crossings(direction); ++halves)
    if (symmetric(halves)) return halves;
  return std::nullopt;
}

namespace {

/// Where s lies: after crossing `before`, on the part `along` of the way to the next, of length L.
struct Between {
  int before;
  double along, L;
};
Between between(const WovenYarns& w, int direction, double s) {
  const double L = w.yarn[1 - direction].spacing_m, at = s / L - 0.5;
  return {static_cast<int>(std::floor(at)), at - std::floor(at), L};
}

}  // namespace

double WovenYarns::height_m(int direction, int k, double s) const {
  const Between at = between(*this, direction, s);
  const double from = onTop(direction, k, at.before) ? 1 : -1, to = onTop(direction, k, at.before + 1) ? 1 : -1;
  return 0.5 * yarn[direction].amplitude_m * ((from + to) + (from - to) * std::cos(std::numbers::pi * at.along));
}

double WovenYarns::slope(int direction, int k, double s) const {
  const Between at = between(*this, direction, s);
  const double from = onTop(direction, k, at.before) ? 1 : -1, to = onTop(direction, k, at.before + 1) ? 1 : -1;
  return -0.5 * yarn[direction].amplitude_m * (from - to) * std::numbers::pi / at.L *
         std::sin(std::numbers::pi * at.along);
}

double WovenYarns::arcLength_m(int direction, int k, double s0, double s1) const {
  static const Quadrature rule = gaussLegendre(16);
  const double L = yarn[1 - direction].spacing_m;
  double length = 0;
  for (double from = s0; from < s1;) {
    const double crossing = (std::floor(from / L - 0.5 + kTouch) + 1.5) * L, to = std::min(s1, crossing);
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      length += rule.weights[q] * (to - from) * std::hypot(1, slope(direction, k, from + rule.points[q] * (to - from)));
    from = to;
  }
  return length;
}

Vec3 WovenYarns::middle(int direction, int k, double s) const {
  const double across = (k + 0.5) * yarn[direction].spacing_m, z = height_m(direction, k, s);
  return direction == along_weft ? Vec3{s, across, z} : Vec3{across, s, z};
}

void checkWovenYarns(const WovenYarns& yarns) {
  checkWeave(yarns.weave);
  for (const int d : {along_weft, along_warp}) {
    const WovenYarn& y = yarns.yarn[d];
    const std::string key = nameOf(d);
    if (!(y.spacing_m > 0 && std::isfinite(y.spacing_m))) refuse(key + ".spacing", y.spacing_m, "> 0");
    if (!(y.amplitude_m >= 0 && std::isfinite(y.amplitude_m))) refuse(key + ".amplitude", y.amplitude_m, ">= 0");
    if (!(y.half_thickness_m > 0 && std::isfinite(y.half_thickness_m)))
      refuse(key + ".half_thickness", y.half_thickness_m, "> 0");
    if (!(y.half_width_m > 0 && 2 * y.half_width_m <= y.spacing_m * (1 + kTouch)))
      refuse(key + ".half_width", y.half_width_m,
             fmt::format("> 0 and at most half of the spacing, {:.6g} m: neighbours overlap", 0.5 * y.spacing_m));
  }
  const WovenYarn &weft = yarns.yarn[along_weft], &warp = yarns.yarn[along_warp];
  const double thickness = weft.half_thickness_m + warp.half_thickness_m;
  if (weft.amplitude_m + warp.amplitude_m < thickness * (1 - kTouch))
    refuse("weft.amplitude", weft.amplitude_m,
           fmt::format("at least {:.6g} m: with the warp's amplitude as much as both half thicknesses, or yarns are "
                       "interlocked",
                       thickness - warp.amplitude_m));
  for (const int d : {along_weft, along_warp})
    if (runsThrough(yarns.yarn[d], yarns.yarn[1 - d]))
      refuse(std::string(nameOf(d)) + ".amplitude", yarns.yarn[d].amplitude_m,
             "smaller, or the other yarns narrower: beside the crossing the yarns are interlocked");
}

}  // namespace gambeson
