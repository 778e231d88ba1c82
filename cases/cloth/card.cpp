#include "cases/cloth/card.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/cloth/card_terms.hpp"
#include "cases/cloth/law_input.hpp"
#include "cases/cloth/law_table.hpp"
#include "core/material/kes_shear.hpp"

namespace gambeson {

TensilePoint secantPoint(const CardTensile& t, int direction) {
  if (t.curves.any()) {
    const std::vector<TensilePoint>& points = t.curves.of(direction);
    if (!t.secant_at_N_per_m) return points.back();
    return {TensionCurve(points).strainAt(*t.secant_at_N_per_m), *t.secant_at_N_per_m};
  }
  const double strain = t.extension.of(direction), load = t.load_N_per_m;
  if (!t.secant_at_N_per_m) return {strain, load};
  const double lt = t.linearity.of(direction);
  return {strain * std::pow(*t.secant_at_N_per_m / load, lt / (2 - lt)), *t.secant_at_N_per_m};
}

namespace {

using lab::kGfCm2PerCm_Nm, lab::kGfPerCm_N_per_m, lab::kGfPerCmDeg_N_per_m;
constexpr double kGfCmPerCm_N = 9.80665e-3;

std::string number(double x) { return formatBrief(x, 4); }

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
    const auto [strain, load] = secantPoint(t, i);
    a = lab::stiffnessAt(load, strain);
    const bool apart = t.extension.apart() || t.curves.apart();
    if (i == 0 || apart)
      out.derived.push_back(fmt::format(
          "stiffness along {} {} N/m: the secant at {} gf/cm, where the cloth is {} % longer{}",
          apart ? names[i] : "weft and warp", number(a), number(load / kGfPerCm_N_per_m), number(100 * strain),
          !t.secant_at_N_per_m ? ""
          : t.curves.any()     ? " (of the points)"
                               : " (EMT and LT)"));
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
  out.derived.push_back(
      fmt::format("shear stiffness {} N/m per radian: G = {} gf/(cm deg)", number(G), number(G / kGfPerCmDeg_N_per_m)));
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
  out.derived.push_back(
      fmt::format("of that {} gf/(cm deg) are elastic; the rest is friction, which grows with the "
                  "shear by 2HG5",
                  number(sheet.elastic_N_per_m / kGfPerCmDeg_N_per_m)));
}

void bendLinearly(const CardBending& b, CardFabric& out) {
  const double weft = b.rigidity.of(0), warp = b.rigidity.of(1);
  out.fabric.law = LinearBending{GivenRigidities{weft, warp, 0.5 * std::sqrt(weft * warp)}};
  out.assumed.push_back("bending without hysteresis: the card has no 2HB");
}

void bendByLoop(const CardBending& b, CardFabric& out) {
  const double span = b.friction_per_m.value_or(kCardFriction_per_m);
  if (!b.hysteresis_at_per_m)
    out.assumed.push_back(
        fmt::format("2HB_at {:g}/cm: the card does not say at which curvature 2HB was read", 0.01 * kKesWidthAt_per_m));
  if (!b.friction_per_m)
    out.assumed.push_back(
        fmt::format("K0 {}/cm: friction in bending is overcome where KES begins to read B", number(span / 100)));
  const StopShape<kStops> shape = shapeOf(b);
  FrictionInBending law;
  law.shape = shape;
  double* const last[2] = {&law.weft_Nm, &law.warp_Nm};
  for (int i = 0; i < 2; ++i) {
    const Stops<kStops> stops = stopsOfKes(shape, {b.rigidity.of(i), b.hysteresis.of(i)}, span,
                                           b.hysteresis_at_per_m.value_or(kKesWidthAt_per_m));
    *last[i] = stops.last_Nm;
    law.first_Nm[static_cast<std::size_t>(i)] = stops.first_Nm;
    law.span_per_m[static_cast<std::size_t>(i)] = span;
    if (i == 0 || b.rigidity.apart() || b.hysteresis.apart())
      out.derived.push_back(fmt::format(
          "bending{}: {} gf cm^2/cm when new, {} beyond the friction of {} gf cm/cm",
          b.rigidity.apart() || b.hysteresis.apart() ? (i == 0 ? " along the weft" : " along the warp") : "",
          number(stops.first_Nm / kGfCm2PerCm_Nm), number(stops.last_Nm / kGfCm2PerCm_Nm),
          number(stops.frictionMoment() / kGfCmPerCm_N)));
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

/// The law of curves, in place of membrane, friction and loops.
void followCurves(const FabricCard& card, CardFabric& out) {
  const CardTensile& t = *card.tensile;
  LawFile law;
  CurveLaw& curves = law.curves.emplace();
  for (int i = 0; i < 2; ++i)
    curves.tension[static_cast<std::size_t>(i)] =
        t.curves.any() ? t.curves.of(i) : tensilePointsOfKes(t.extension.of(i), t.linearity.of(i), t.load_N_per_m);
  curves.shear_N_per_m = card.shear ? card.shear->rigidity.mean() : kCardShear_N_per_m;
  const double weft = card.bending.rigidity.of(0), warp = card.bending.rigidity.of(1);
  curves.rigidity_Nm = {weft, warp, 0.5 * std::sqrt(weft * warp)};
  out.derived.push_back(
      t.curves.any()
          ? fmt::format("tension follows the card's {} points along the weft and {} along the warp",
                        curves.tension[0].size(), curves.tension[1].size())
          : fmt::format("tension stiffens in proportion to itself (Fung 1967), with LT {} along the weft and "
                        "{} along the warp: a work of {} and {} J/m^2",
                        number(t.linearity.of(0)), number(t.linearity.of(1)),
                        number(TensionCurve(curves.tension[0]).work(t.extension.of(0))),
                        number(TensionCurve(curves.tension[1]).work(t.extension.of(1)))));
  out.derived.push_back(fmt::format("shear stiffness {} N/m per radian, linear", number(curves.shear_N_per_m)));
  if (!card.shear) out.assumed.push_back("G 1 gf/(cm deg): the card has no shear");
  out.assumed.push_back("weft and warp do not couple: pulled cloth keeps its width");
  out.assumed.push_back("twist has half the geometric mean of the rigidities of weft and warp");
  if (card.bending.hysteresis.any() || (card.shear && card.shear->hysteresis.any()))
    out.assumed.push_back("no hysteresis: a law of curves is elastic; 2HB and 2HG are not in it");
  out.fabric.jam_area = 0;
  out.fabric = withCurves(std::move(out.fabric), std::make_shared<const LawFile>(std::move(law)));
  out.fabric.limit_of_law = {};  // the card states how far it was measured
}

/// Engineering strain at which the fabric's law has a force per width.
double strainUnder(const FabricCase& f, int direction, double force_N_per_m) {
  if (f.energy_source)
    return TensionCurve(f.energy_source->table().curves->tension[static_cast<std::size_t>(direction)])
        .strainAt(force_N_per_m);
  const double young = direction == 0 ? f.young_weft_Pa : f.young_warp_Pa;
  const double s = 1 - f.poisson * f.poisson * f.young_warp_Pa / f.young_weft_Pa;
  return lab::strainUnder(force_N_per_m, young * f.thickness_m / s);
}

void limitStrains(const FabricCard& card, CardFabric& out) {
  std::optional<double>* const limits[2] = {&out.fabric.limit_strain_weft, &out.fabric.limit_strain_warp};
  for (int i = 0; i < 2; ++i) {
    std::optional<double> most;
    if (card.elongation.any()) most = card.elongation.of(i);
    if (card.strength_N_per_m.any()) {
      const double e = strainUnder(out.fabric, i, card.strength_N_per_m.of(i));
      if (!most || e < *most) most = e;
    }
    if (!most) continue;
    *limits[i] = lab::greenOf(*most);
    out.derived.push_back(fmt::format("stretch along the {} may reach {} % ({} % in length)", i == 0 ? "weft" : "warp",
                                      number(100 * **limits[i]), number(100 * *most)));
  }
}

}  // namespace

CardFabric fabricOf(const FabricCard& card, const IsotropicHysteresisBending* fitted) {
  CardFabric out;
  FabricCase& f = out.fabric;
  f.name = card.name;
  f.thickness_m = card.thickness_m;
  f.thickness_assumed = card.thickness_assumed;
  if (card.thickness_assumed)
    out.assumed.push_back(fmt::format("thickness {} mm: the card has none; the weight over {} kg/m^3",
                                      number(1000 * card.thickness_m), number(kCardDensity_kg_per_m3)));
  f.density_kg_per_m3 = card.weight_kg_per_m2 ? *card.weight_kg_per_m2 / card.thickness_m : kCardDensity_kg_per_m3;
  if (!card.weight_kg_per_m2)
    out.assumed.push_back(fmt::format("weight {} g/m^2: the card has none; {} kg/m^3 times the thickness",
                                      number(1000 * f.surfaceDensity()), number(kCardDensity_kg_per_m3)));
  if (card.bending.length_m.any())
    out.derived.push_back(fmt::format("bending {} gf cm^2/cm along the weft, {} along the warp: W g c^3",
                                      number(card.bending.rigidity.of(0) / kGfCm2PerCm_Nm),
                                      number(card.bending.rigidity.of(1) / kGfCm2PerCm_Nm)));
  f.jam_area = 0.7;
  if (card.tensile && card.tensile->law == TensileLaw::curve) {
    followCurves(card, out);
  } else {
    membrane(card, out);
    if (fitted)
      f.law = *fitted;
    else if (card.bending.hysteresis.any())
      bendByLoop(card.bending, out);
    else
      bendLinearly(card.bending, out);
  }
  limitStrains(card, out);
  return out;
}

}  // namespace gambeson
