#pragma once
/// Bending of cloth that remembers its folds: elastic, with friction between the fibres, set and fatigue.

#include <cmath>

#include "core/material/laws/given_rigidities.hpp"
#include "core/material/laws/stops.hpp"

namespace gambeson {

constexpr int kStops = 8;

/// What both hysteresis laws have. The given rigidities are those beyond the friction, b2 of Wong 2014, eq. 4.2.
struct FrictionInBending : GivenRigidities {
  StopShape<kStops> shape;
  std::array<double, 3> first_Nm{};    ///< b1 along weft, along warp, of twist: slopes of cloth that is new
  std::array<double, 3> span_per_m{};  ///< K0
  double setting = 0;                  ///< lambda
  double fatigue = 0;                  ///< mu: what a cycle of reference takes of the friction
  double cycle_per_m = 250;            ///< curvature to which a cycle of reference goes, either way; of KES: 2.5/cm

  bool operator==(const FrictionInBending&) const = default;
  static constexpr int number_count = 2 * kStops + 11;
  std::array<double, number_count> numbers() const {
    std::array<double, number_count> all{};
    const double last[3] = {weft_Nm, warp_Nm, twist_Nm};
    for (std::size_t j = 0; j < kStops; ++j) {
      all[j] = shape.drop[j];
      all[kStops + j] = shape.reach[j];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      all[2 * kStops + i] = first_Nm[i] - last[i];
      all[2 * kStops + 3 + i] = span_per_m[i];
      all[2 * kStops + 6 + i] = 1 / cycleLoss(shape, span_per_m[i], cycle_per_m);
    }
    all[2 * kStops + 9] = -std::log1p(-fatigue);
    all[2 * kStops + 10] = setting;
    return all;
  }
  void check(const Refusal& refuse) const {
    GivenRigidities::check(refuse);
    const double last[3] = {weft_Nm, warp_Nm, twist_Nm};
    for (std::size_t i = 0; i < 3; ++i)
      if (!(first_Nm[i] >= last[i])) refuse("first_Nm", "must be at least the rigidity beyond friction");
    for (const double span : span_per_m)
      if (!(span > 0)) refuse("span_per_m", "must be > 0");
    if (!(setting >= 0)) refuse("setting", "must be >= 0");
    if (!(fatigue >= 0 && fatigue < 1)) refuse("fatigue", "must be >= 0 and < 1");
    for (const double span : span_per_m)
      if (!(cycleLoss(shape, span, cycle_per_m) > 0))
        refuse("cycle_per_m", "a cycle of reference must make a stop slip");
  }
  void stiffen(double factor) {
    GivenRigidities::stiffen(factor);
    for (double& first : first_Nm) first *= factor;
  }
  /// As of a homogeneous sheet: curvatures go with 1 over the thickness, rigidities with its cube.
  void thicken(double factor) {
    stiffen(factor * factor * factor);
    for (double& span : span_per_m) span /= factor;
  }
  double most_Nm() const { return std::max({first_Nm[0], first_Nm[1], first_Nm[2]}); }

 protected:
  static FrictionInBending mixed(const FrictionInBending& a, const FrictionInBending& b, double w) {
    FrictionInBending c;
    static_cast<GivenRigidities&>(c) = GivenRigidities::mixed(a, b, w);
    for (std::size_t j = 0; j < kStops; ++j) {
      c.shape.drop[j] = mix(a.shape.drop[j], b.shape.drop[j], w);
      c.shape.reach[j] = mix(a.shape.reach[j], b.shape.reach[j], w);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      c.first_Nm[i] = mix(a.first_Nm[i], b.first_Nm[i], w);
      c.span_per_m[i] = mix(a.span_per_m[i], b.span_per_m[i], w);
    }
    c.setting = mix(a.setting, b.setting, w);
    c.fatigue = mix(a.fatigue, b.fatigue, w);
    c.cycle_per_m = mix(a.cycle_per_m, b.cycle_per_m, w);
    return c;
  }
  /// The numbers of the sum of stops along weft (0), along warp (1) or of twist (2).
  template <class P>
  GAMBESON_LAW static StopNumbers<P> stopsOf(const P* n, int i) {
    return {n,
            n + kStops,
            n[2 * kStops + i],
            n[2 * kStops + 3 + i],
            n[2 * kStops + 6 + i],
            n[2 * kStops + 9],
            n[2 * kStops + 10]};
  }
};

/// A sum of stops along weft, one along warp and one of twist, each for itself (sumOfStops of stops.hpp): for cloth
/// whose weft and warp were measured apart.
struct HysteresisBending : FrictionInBending {
  static constexpr int history_size = 3 * kStopHistory<kStops, LineCurvature>;

  bool operator==(const HysteresisBending&) const = default;
  static HysteresisBending mixed(const HysteresisBending& a, const HysteresisBending& b, double w) {
    return {FrictionInBending::mixed(a, b, w)};
  }
  template <unsigned kParts, class S, class P>
  GAMBESON_LAW static void bend(const P* D, const P* numbers, const S* k, History<S> history, Answer<S, 3>& out) {
    for (int i = 0; i < 3; ++i) {
      Answer<S, 1> one;
      sumOfStops<kParts, kStops, LineCurvature>(D + i, stopsOf(numbers, i), k + i, history,
                                                i * kStopHistory<kStops, LineCurvature>, one);
      out.resultant[i] = one.resultant[0];
      if constexpr (kParts & with_energy) {
        out.energy += one.energy;
        out.lost += one.lost;
      }
      if constexpr (kParts & with_slope) out.slope[i] = one.slope[0];
    }
    if constexpr (kParts & with_slope) out.slope[3] = out.slope[4] = out.slope[5] = S{};
  }
  template <class P>
  GAMBESON_LAW static P steepest(int i, const P* D, const P* numbers) {
    return D[i] + numbers[2 * kStops + i];
  }
};

/// One sum of stops for the tensor of curvature (sumOfStops of stops.hpp): cloth that bends alike about all axes, so
/// that its rigidities are B, B and B/2 of twist. Rise and span are those along weft. Bent to a cylinder about any axis
/// it has the curve of a line.
struct IsotropicHysteresisBending : FrictionInBending {
  static constexpr int history_size = kStopHistory<kStops, PlaneCurvature>;

  bool operator==(const IsotropicHysteresisBending&) const = default;
  void check(const Refusal& refuse) const {
    FrictionInBending::check(refuse);
    if (!(warp_Nm == weft_Nm && twist_Nm == 0.5 * weft_Nm))
      refuse("bending_warp_Nm", "an isotropic law has one rigidity, and half of it for twist");
  }
  static IsotropicHysteresisBending mixed(const IsotropicHysteresisBending& a, const IsotropicHysteresisBending& b,
                                          double w) {
    return {FrictionInBending::mixed(a, b, w)};
  }
  template <unsigned kParts, class S, class P>
  GAMBESON_LAW static void bend(const P* D, const P* numbers, const S* k, History<S> history, Answer<S, 3>& out) {
    sumOfStops<kParts, kStops, PlaneCurvature>(D, stopsOf(numbers, 0), k, history, 0, out);
  }
  template <class P>
  GAMBESON_LAW static P steepest(int i, const P* D, const P* numbers) {
    return D[i] + (i < 2 ? 1.0 : 0.5) * numbers[2 * kStops];
  }
};

}  // namespace gambeson
