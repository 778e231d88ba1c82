#include "cases/cloth/card.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/ticks.hpp"
#include "core/material/kes_shear.hpp"

namespace gambeson {
namespace {

constexpr double kGf_N = 9.80665e-3, kGfPerCm_N_per_m = 0.980665,
                 kKesShear_N_per_m = kGfPerCm_N_per_m * 57.29577951308232;

std::string number(double x) { return formatBrief(x, 4); }

/// Secant stiffness A of n = A E at an engineering strain e under a force per width.
double stiffnessAt(double force_N_per_m, double e) { return force_N_per_m / ((1 + e) * (e + 0.5 * e * e)); }

/// A11 and A22 [N/m].
std::array<double, 2> tension(const CardTensile& t, CardFabric& out) {
  std::array<double, 2> A{};
  const char* const names[2] = {"weft", "warp"};
  for (int i = 0; i < 2; ++i) {
    double& a = A[static_cast<std::size_t>(i)];
    if (t.modulus_N_per_m.any()) {
      a = t.modulus_N_per_m.of(i);
      continue;
    }
    double load = t.load_N_per_m, strain = t.extension.of(i);
    if (t.secant_at_N_per_m) {
      const double lt = t.linearity.of(i);
      strain *= std::pow(*t.secant_at_N_per_m / load, lt / (2 - lt));
      load = *t.secant_at_N_per_m;
    }
    a = stiffnessAt(load, strain);
    if (i == 0 || t.extension.apart())
      out.derived.push_back(fmt::format(
          "stiffness along {} {} N/m: the secant at {} gf/cm, where the cloth is {} % longer{}",
          t.extension.apart() ? names[i] : "weft and warp", number(a), number(load / kGfPerCm_N_per_m),
          number(100 * strain), t.secant_at_N_per_m ? " (EMT and LT)" : ""));
  }
  if (t.extension.any() && !t.secant_at_N_per_m)
    out.derived.push_back("cloth is softer at small loads where LT is below 1; secant_at chooses the load");
  return A;
}

}  // namespace

StopShape<kStops> shapeOf(const CardBending& b) {
  if (b.stops.empty()) return stopsOf<kStops>(curveOver(1, 0, 1)).shape;
  StopShape<kStops> shape;
  shape.reach.fill(1);
  for (std::size_t j = 0; j < b.stops.size(); ++j) {
    shape.drop[j] = b.stops[j].first;
    shape.reach[j] = b.stops[j].second;
  }
  return shape;
}

ShearedSheet sheetOf(const CardShear& s) {
  return sheetOfKesShear({s.rigidity.mean(), s.hysteresis.mean(), s.hysteresis_5.any() ? s.hysteresis_5.mean() : 0},
                         s.friction_rad.value_or(kCardFriction_rad));
}

namespace {

void membrane(const FabricCard& card, CardFabric& out) {
  CardTensile t;
  t.extension.both = kCardExtension;
  if (card.tensile)
    t = *card.tensile;
  else
    out.assumed.push_back(fmt::format("EMT {} % at 500 gf/cm along weft and warp: the card has no tension",
                                      number(100 * kCardExtension)));
  FabricCase& f = out.fabric;
  const std::array<double, 2> A = tension(t, out);
  f.poisson = t.poisson.value_or(0);
  if (!t.poisson) out.assumed.push_back("poisson 0: pulled cloth keeps its width");
  const double s = 1 - f.poisson * f.poisson * A[1] / A[0];
  f.young_weft_Pa = A[0] * s / f.thickness_m;
  f.young_warp_Pa = A[1] * s / f.thickness_m;
  double G = kCardShear_N_per_m;
  if (card.shear) {
    G = card.shear->rigidity.mean();
    if (card.shear->rigidity.apart()) out.derived.push_back("G is the mean of weft and warp");
  } else {
    out.assumed.push_back("G 1 gf/(cm deg): the card has no shear");
  }
  out.derived.push_back(fmt::format("shear stiffness {} N/m per radian: G = {} gf/(cm deg)", number(G),
                                    number(G / kKesShear_N_per_m)));
  f.shear_Pa = G / f.thickness_m;
  if (!card.shear) return;
  if (!card.shear->hysteresis.any()) {
    out.assumed.push_back("shear without hysteresis: the card has no 2HG");
    return;
  }
  const ShearedSheet sheet = sheetOf(*card.shear);
  f.shear_Pa = sheet.elastic_N_per_m / f.thickness_m;
  f.shear_friction = sheet.friction;
  if (!card.shear->friction_rad) out.assumed.push_back("friction_angle 1 degree: where friction in shear is overcome");
  if (!card.shear->hysteresis_5.any()) out.assumed.push_back("2HG5 that of 2HG's friction: the card has none");
  out.derived.push_back(fmt::format("of that {} gf/(cm deg) are elastic; the rest is friction, which grows with the "
                                    "shear by 2HG5",
                                    number(sheet.elastic_N_per_m / kKesShear_N_per_m)));
}

void bendLinearly(const CardBending& b, CardFabric& out) {
  const double weft = b.rigidity.of(0), warp = b.rigidity.of(1);
  out.fabric.law = LinearBending{GivenRigidities{weft, warp, 0.5 * std::sqrt(weft * warp)}};
  out.assumed.push_back("bending without hysteresis: the card has no 2HB");
}

void bendByLoop(const CardBending& b, CardFabric& out) {
  const double span = b.friction_per_m.value_or(kCardFriction_per_m);
  if (!b.friction_per_m)
    out.assumed.push_back(
        fmt::format("K0 {}/cm: friction in bending is overcome where KES begins to read B", number(span / 100)));
  const StopShape<kStops> shape = shapeOf(b);
  FrictionInBending law;
  law.shape = shape;
  double* const last[2] = {&law.weft_Nm, &law.warp_Nm};
  for (int i = 0; i < 2; ++i) {
    const Stops<kStops> stops =
        stopsOfKes(shape, {b.rigidity.of(i), b.hysteresis.of(i)}, span, *b.hysteresis_at_per_m);
    *last[i] = stops.last_Nm;
    law.first_Nm[static_cast<std::size_t>(i)] = stops.first_Nm;
    law.span_per_m[static_cast<std::size_t>(i)] = span;
    if (i == 0 || b.rigidity.apart() || b.hysteresis.apart())
      out.derived.push_back(fmt::format(
          "bending{}: {} gf cm^2/cm when new, {} beyond the friction of {} gf cm/cm",
          b.rigidity.apart() || b.hysteresis.apart() ? (i == 0 ? " along the weft" : " along the warp") : "",
          number(stops.first_Nm / (kGf_N / 100)), number(stops.last_Nm / (kGf_N / 100)),
          number(stops.frictionMoment() / kGf_N)));
  }
  law.span_per_m[2] = span;
  if (!b.rigidity.apart() && !b.hysteresis.apart()) {
    law.twist_Nm = 0.5 * law.weft_Nm;
    law.first_Nm[2] = 0.5 * law.first_Nm[0];
    out.fabric.law = IsotropicHysteresisBending{law};
    out.assumed.push_back("one loop about all axes: the card does not tell weft and warp apart");
    return;
  }
  law.twist_Nm = 0.5 * std::sqrt(law.weft_Nm * law.warp_Nm);
  law.first_Nm[2] = 0.5 * std::sqrt(law.first_Nm[0] * law.first_Nm[1]);
  out.fabric.law = HysteresisBending{law};
  out.assumed.push_back("twist has half the geometric mean of the loops of weft and warp, which KES does not measure");
}

}  // namespace

CardFabric fabricOf(const FabricCard& card, const IsotropicHysteresisBending* fitted) {
  CardFabric out;
  FabricCase& f = out.fabric;
  f.name = card.name;
  f.thickness_m = card.thickness_m;
  f.density_kg_per_m3 = card.weight_kg_per_m2 ? *card.weight_kg_per_m2 / card.thickness_m : kCardDensity_kg_per_m3;
  if (!card.weight_kg_per_m2)
    out.assumed.push_back(fmt::format("weight {} g/m^2: the card has none; {} kg/m^3 times the thickness",
                                      number(1000 * f.surfaceDensity()), number(kCardDensity_kg_per_m3)));
  f.jam_area = 0.7;
  membrane(card, out);
  if (fitted)
    f.law = *fitted;
  else if (card.bending.hysteresis.any())
    bendByLoop(card.bending, out);
  else
    bendLinearly(card.bending, out);
  return out;
}

}  // namespace gambeson
