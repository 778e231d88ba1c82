#include "cases/cloth/loop_input.hpp"

#include <fmt/format.h>

#include "analysis/ticks.hpp"
#include "cases/input/table.hpp"
#include "core/material/hysteresis.hpp"

namespace gambeson::schema {
namespace {

constexpr Range curvature = {.low = 0, .high = 1e5, .low_open = true};

using Pairs = std::vector<std::pair<double, double>>;

/// A list of pairs.
template <class Get>
void pairsField(Table<LoopInput>& table, const char* key, Get get, const std::string& note, const std::string& doc) {
  Field f = fieldOf(key, Kind::lists, "", between(0, 1e6), doc);
  f.default_note = note;
  table.custom(
      f,
      [=](const Entry& p, LoopInput& in) {
        if (p.node.type != JsonNode::Type::list || p.node.children.empty())
          p.fail("expected a list of pairs, not " + describe(p.node));
        for (std::size_t i = 0; i < p.node.children.size(); ++i) {
          const Vec2 pair = readPair(p.item(i), "", between(0, 1e6));
          (in.*get).push_back({pair.x, pair.y});
        }
      },
      [=](const LoopInput& in) -> std::optional<JsonNode> {
        if ((in.*get).empty()) return std::nullopt;
        JsonNode rows = emptyList();
        for (const auto& [a, b] : in.*get) rows.children.push_back(nodeOfList({a, b}));
        return rows;
      });
}

/// The keys NAME, NAME_weft, NAME_warp and, where it has one, NAME_twist.
void byDirection(Table<LoopInput>& table, const std::string& name, ByDirection LoopInput::*what,
                 const std::string& unit, const Range& range, const std::string& doc, const std::string& note,
                 bool has_twist) {
  const auto of = [=](std::optional<double> ByDirection::*which) {
    return [=](auto& in) -> auto& { return (in.*what).*which; };
  };
  table.number(name, of(&ByDirection::both), unit, range, doc)
      .defaultsTo(note)
      .number(name + "_weft", of(&ByDirection::weft), unit, range, "the same, bending along the weft")
      .defaultsTo(name)
      .number(name + "_warp", of(&ByDirection::warp), unit, range, "the same, bending along the warp")
      .defaultsTo(name);
  if (has_twist)
    table.number(name + "_twist", of(&ByDirection::twist), unit, range, "the same, of twist")
        .defaultsTo("as that along the weft is to its own last value");
}

/// Weft and warp of a number that is required.
std::array<double, 2> bothOf(const Entry& loop, const std::string& key, const ByDirection& d) {
  if (d.both && (d.weft || d.warp))
    loop.failAt(key, fmt::format("excludes {}_weft and {}_warp; give one number, or these two", key, key));
  if (!d.both && !(d.weft && d.warp)) loop.failAt(key, fmt::format("is required, or {}_weft and {}_warp", key, key));
  return {d.both ? *d.both : *d.weft, d.both ? *d.both : *d.warp};
}

StopShape<kStops> shapeOf(const Entry& loop, const LoopInput& in, double first, double last, double span) {
  if (!in.stops.empty()) {
    if (in.stops.size() > kStops)
      loop.failAt("stops", fmt::format("has {} rows; allowed: at most {}", in.stops.size(), kStops));
    StopShape<kStops> shape;
    shape.reach.fill(1);
    double sum = 0;
    for (std::size_t j = 0; j < in.stops.size(); ++j) {
      const auto [drop, reach] = in.stops[j];
      if (!(reach > 0 && reach <= 1))
        loop.failAt("stops", fmt::format("{} is out of range; allowed: > 0 and <= 1", reach));
      shape.drop[j] = drop;
      shape.reach[j] = reach;
      sum += drop;
    }
    if (!(std::abs(sum - 1) < 1e-9)) loop.failAt("stops", fmt::format("has parts whose sum is {}; allowed: 1", sum));
    return shape;
  }
  if (in.shape == LoopShape::sharp) {
    StopShape<kStops> shape;
    shape.reach.fill(1);
    shape.drop[0] = 1;
    return shape;
  }
  if (in.shape == LoopShape::zheng) {
    // Its first slope is 5/2 sqrt(k0/kr) of its last.
    const double root = first / (2.5 * last);
    if (!(root >= 1)) loop.failAt("initial_rigidity", "must be at least 2.5 times the rigidity for this shape");
    return stopsOf<kStops>(zhengVirginCurve(last, span, span / (root * root))).shape;
  }
  return stopsOf<kStops>(curveOver(1, 0, 1)).shape;
}

/// By a measured curve of first bending, the same along weft and warp.
void takeVirgin(const LoopInput& in, FrictionInBending& law) {
  const Stops<kStops> stops = stopsOf<kStops>(measuredCurve(in.virgin));
  law.shape = stops.shape;
  law.first_Nm = {stops.first_Nm, stops.first_Nm, 0};
  law.span_per_m = {stops.span_per_m, stops.span_per_m, 0};
}

/// By b1, b2 and K0, or c1.
void takeSlopes(const Entry& loop, const LoopInput& in, FrictionInBending& law) {
  const auto firsts = bothOf(loop, "initial_rigidity", in.first_Nm);
  const double last[2] = {law.weft_Nm, law.warp_Nm};
  for (std::size_t i = 0; i < 2; ++i)
    if (!(firsts[i] > last[i]))
      loop.failAt(in.first_Nm.both ? "initial_rigidity"
                  : i == 0         ? "initial_rigidity_weft"
                                   : "initial_rigidity_warp",
                  fmt::format("{} N m is out of range; allowed: above the rigidity, {} N m", firsts[i], last[i]));
  law.first_Nm = {firsts[0], firsts[1], 0};
  if (in.c1_Nm2) {
    if (in.span_per_m.any()) loop.failAt("c1", "excludes \"friction_curvature\", which it gives");
    law.span_per_m = {(last[0] - firsts[0]) / (2 * *in.c1_Nm2), (last[1] - firsts[1]) / (2 * *in.c1_Nm2), 0};
  } else {
    const auto spans = bothOf(loop, "friction_curvature", in.span_per_m);
    law.span_per_m = {spans[0], spans[1], 0};
  }
  law.shape = shapeOf(loop, in, law.first_Nm[0], law.weft_Nm, law.span_per_m[0]);
}

/// By what KES-FB2 reads, and K0.
void takeWidth(const Entry& loop, const LoopInput& in, FrictionInBending& law) {
  if (in.first_Nm.any()) loop.failAt("hysteresis", "excludes \"initial_rigidity\", which it gives");
  if (in.c1_Nm2) loop.failAt("c1", "goes with initial_rigidity; give friction_curvature");
  if (in.shape == LoopShape::zheng) loop.failAt("shape", "zheng goes with initial_rigidity");
  const auto spans = bothOf(loop, "friction_curvature", in.span_per_m), widths = bothOf(loop, "hysteresis", in.width_N);
  law.shape = shapeOf(loop, in, 0, 0, spans[0]);
  double* const last[2] = {&law.weft_Nm, &law.warp_Nm};
  for (std::size_t i = 0; i < 2; ++i) try {
      const Stops<kStops> stops = stopsOfKes(law.shape, {*last[i], widths[i]}, spans[i], in.width_at_per_m);
      *last[i] = stops.last_Nm;
      law.first_Nm[i] = stops.first_Nm;
      law.span_per_m[i] = spans[i];
    } catch (const InputError& e) {
      loop.failAt("hysteresis", e.reason());
    }
}

/// The third loop: of the tensor's twist, which follows, or of twist alone.
void takeTwist(const Entry& bending, const Entry& loop, const LoopInput& in, FrictionInBending& law) {
  if (in.axes == LoopAxes::isotropic) {
    if (law.weft_Nm != law.warp_Nm || law.first_Nm[0] != law.first_Nm[1] || law.span_per_m[0] != law.span_per_m[1])
      loop.failAt("axes", "isotropic goes with one rigidity and one loop for weft and warp");
    const double half = 0.5 * law.weft_Nm;
    if (law.twist_Nm != 0 && law.twist_Nm != half)
      bending.failAt("twist", fmt::format("{} N m is not allowed with isotropic axes; leave it out: it is {} N m, half "
                                          "the rigidity beyond friction",
                                          law.twist_Nm, half));
    for (const auto& [key, given] : {std::pair("initial_rigidity_twist", in.first_Nm.twist),
                                     std::pair("friction_curvature_twist", in.span_per_m.twist)})
      if (given) loop.failAt(key, "has no meaning with isotropic axes; remove it");
    law.twist_Nm = half;
    law.first_Nm[2] = 0.5 * law.first_Nm[0];
    law.span_per_m[2] = law.span_per_m[0];
    return;
  }
  const double in_proportion = law.weft_Nm > 0 ? law.twist_Nm * law.first_Nm[0] / law.weft_Nm : law.twist_Nm;
  law.first_Nm[2] = in.first_Nm.twist.value_or(in_proportion);
  law.span_per_m[2] = in.span_per_m.twist.value_or(law.span_per_m[0]);
  if (!(law.first_Nm[2] >= law.twist_Nm))
    loop.failAt("initial_rigidity_twist",
                fmt::format("{} N m is out of range; allowed: at least twist, {} N m", law.first_Nm[2], law.twist_Nm));
}

}  // namespace

Object loopTable() {
  using L = LoopInput;
  Table<L> table("Loop of bending");
  table.choice(
      "axes", &L::axes,
      std::vector<std::pair<std::string, LoopAxes>>{{"apart", LoopAxes::apart}, {"isotropic", LoopAxes::isotropic}},
      "apart: weft, warp and twist have loops of their own; isotropic: the tensor of curvature has one, the "
      "same about all axes");
  table.choice(
      "shape", &L::shape,
      std::vector<std::pair<std::string, LoopShape>>{
          {"quadratic", LoopShape::quadratic}, {"sharp", LoopShape::sharp}, {"zheng", LoopShape::zheng}},
      "of the curve on first bending, between initial_rigidity and rigidity: quadratic, Wong 2014, eq. 4.2; "
      "sharp: straight up to a yield curvature (ideal plasticity with hardening); zheng: Zheng 2013, eq. 2.14");
  byDirection(table, "initial_rigidity", &L::first_Nm, "N m", between(0, 1e3),
              "b1, the slope of cloth that was never bent; the bending's rigidity is b2, the slope beyond all friction",
              "required, or hysteresis or virgin", true);
  byDirection(table, "friction_curvature", &L::span_per_m, "1/m", curvature,
              "K0, where all friction is overcome on first bending; of the shape sharp, the yield curvature",
              "required, or c1 or virgin", true);
  table
      .number("c1", &L::c1_Nm2, "N m^2", {.low = -1e3, .high = 0, .high_open = true},
              "in place of friction_curvature, c1 of Wong 2014, eq. 4.2: K0 = (b2 - b1) / (2 c1)")
      .defaultsTo("none");
  byDirection(table, "hysteresis", &L::width_N, "N", aboveTo(0, 1e3),
              "2HB of KES-FB2, the width of the loop; the bending's rigidity is then B of the same test", "none",
              false);
  table.number("hysteresis_at", &L::width_at_per_m, "1/m",
               {.low = 0, .high = kKesCurvature_per_m, .low_open = true, .high_open = true},
               "curvature at which hysteresis was read");
  pairsField(
      table, "virgin", &L::virgin, "none",
      "a measured curve of first bending in place of all these and of the bending's rigidity: pairs [curvature in "
      "1/m, moment in N per m of width], concave");
  pairsField(
      table, "stops", &L::stops, "those of the shape",
      "the friction in at most 8 stops: pairs [part of initial_rigidity - rigidity, curvature at which it slips as a "
      "part of friction_curvature]");
  return table
      .number(
          "set", &L::set, "", between(0, 100),
          "lambda, how fast the curvature without moment follows that of the cloth: per cycle of reference and part of "
          "the friction that is left")
      .number("fatigue", &L::fatigue, "", {.low = 0, .high = 1, .high_open = true},
              "mu, the part of the friction that a cycle of reference takes")
      .number("cycle", &L::cycle_per_m, "1/m", curvature,
              "curvature to which a cycle of reference goes, either way; KES-FB2: 2.5/cm")
      .choice("set_by", &L::set_by,
              std::vector<std::pair<std::string, SetBy>>{{"slip", SetBy::slip}, {"cycles", SetBy::cycles}},
              "what set and fatigue go with: slip of the friction; or cycles as Wong 2014 prints them (eq. 4.6 to "
              "4.12), for comparison: a vibration then counts as a cycle. Of cycles set is at most 1")
      .number("recovery", &L::recovery, "", between(0, 100),
              "Maxwell branch: a spring beside the loop, as a part of the bending's rigidity, that relaxes with time: "
              "what was bent for long then opens slowly")
      .number("recovery_time", &L::recovery_time_s, "s", aboveTo(0, 1e9), "time in which that relaxes e-fold")
      .defaultsTo("required with recovery")
      .build();
}

std::optional<double> rigidityOf(const Entry& bending, const LoopInput& in) {
  if (in.virgin.empty()) return std::nullopt;
  for (const char* key : {"rigidity", "rigidity_weft", "rigidity_warp"})
    if (bending.node.find(key)) bending.failAt(key, "excludes \"virgin\", whose last slope it is; give one of them");
  const Entry loop = bending.member(*bending.node.find("loop"));
  if (in.first_Nm.any()) loop.failAt("initial_rigidity", "excludes \"virgin\", whose first slope it is");
  if (in.span_per_m.any()) loop.failAt("friction_curvature", "excludes \"virgin\", where it is the last corner");
  if (in.c1_Nm2) loop.failAt("c1", "excludes \"virgin\"");
  if (in.width_N.any()) loop.failAt("hysteresis", "excludes \"virgin\", whose loop it is");
  if (!in.stops.empty()) loop.failAt("stops", "excludes \"virgin\", which gives them");
  try {
    const VirginCurve curve = measuredCurve(in.virgin);
    return curve.slope(curve.span_per_m);
  } catch (const InputError& e) {
    loop.failAt("virgin", e.reason());
  }
}

namespace {

/// By the printed rule, which knows neither a tensor nor cloth without stiffness beyond its friction.
BendingLaw cyclicLaw(const Entry& loop, const LoopInput& in, const FrictionInBending& law) {
  if (in.axes == LoopAxes::isotropic)
    loop.failAt("set_by", "cycles is a rule for lines; it is not possible with isotropic axes");
  if (!(in.set <= 1)) loop.failAt("set", fmt::format("{} is out of range; allowed with set_by = cycles: <= 1", in.set));
  if (!(law.least_Nm() > 0)) loop.failAt("set_by", "cycles needs a rigidity beyond friction > 0");
  return CyclicHysteresisBending{law};
}

}  // namespace

BendingLaw resolveLoop(const Entry& bending, const LoopInput& in, const GivenRigidities& given) {
  const Entry loop = bending.member(*bending.node.find("loop"));
  FrictionInBending law;
  static_cast<GivenRigidities&>(law) = given;
  law.setting = in.set;
  law.fatigue = in.fatigue;
  law.cycle_per_m = in.cycle_per_m;
  if (!in.virgin.empty())
    takeVirgin(in, law);
  else if (in.width_N.any())
    takeWidth(loop, in, law);
  else
    takeSlopes(loop, in, law);
  takeTwist(bending, loop, in, law);
  law.check([&](const std::string& key, const std::string& reason) {
    loop.failAt(key == "cycle_per_m" ? "cycle" : "", reason);
  });
  const bool recovers = in.recovery > 0, isotropic = in.axes == LoopAxes::isotropic;
  if (recovers && !in.recovery_time_s) loop.failAt("recovery_time", "is required with recovery");
  if (!recovers && in.recovery_time_s) loop.failAt("recovery_time", "goes with recovery, which is 0; remove it");
  if (in.set_by == SetBy::cycles) {
    if (recovers) loop.failAt("recovery", "is not possible with set_by = cycles, a rule without time");
    return cyclicLaw(loop, in, law);
  }
  const double time = in.recovery_time_s.value_or(1);
  if (recovers && isotropic) return Recovering<IsotropicHysteresisBending>{{law}, in.recovery, time};
  if (recovers) return Recovering<HysteresisBending>{{law}, in.recovery, time};
  if (isotropic) return IsotropicHysteresisBending{law};
  return HysteresisBending{law};
}

namespace {

/// What a law has of a loop.
struct LoopOfLaw {
  const FrictionInBending* loop = nullptr;
  bool isotropic = false;
  SetBy set_by = SetBy::slip;
  double recovery = 0, recovery_time_s = 0;
};
template <class L>
LoopOfLaw loopOf(const L& law) {
  if constexpr (!std::is_base_of_v<FrictionInBending, L>) {
    return {};
  } else {
    LoopOfLaw out{&law, std::is_base_of_v<IsotropicHysteresisBending, L>};
    if constexpr (std::is_same_v<L, CyclicHysteresisBending>) out.set_by = SetBy::cycles;
    if constexpr (requires { law.part; }) out.recovery = law.part, out.recovery_time_s = law.time_s;
    return out;
  }
}
LoopOfLaw loopOf(const BendingLaw& slot) {
  return std::visit([](const auto& law) { return loopOf(law); }, slot);
}

LoopInput restored(const LoopOfLaw& of) {
  const FrictionInBending& law = *of.loop;
  const bool isotropic = of.isotropic;
  LoopInput in;
  in.axes = isotropic ? LoopAxes::isotropic : LoopAxes::apart;
  in.first_Nm.weft = law.first_Nm[0];
  in.first_Nm.warp = law.first_Nm[1];
  in.span_per_m.weft = law.span_per_m[0];
  in.span_per_m.warp = law.span_per_m[1];
  if (!isotropic) {
    in.first_Nm.twist = law.first_Nm[2];
    in.span_per_m.twist = law.span_per_m[2];
  }
  for (std::size_t j = 0; j < kStops; ++j)
    if (law.shape.drop[j] > 0) in.stops.push_back({law.shape.drop[j], law.shape.reach[j]});
  in.set = law.setting;
  in.fatigue = law.fatigue;
  in.cycle_per_m = law.cycle_per_m;
  in.set_by = of.set_by;
  in.recovery = of.recovery;
  if (of.recovery > 0) in.recovery_time_s = of.recovery_time_s;
  return in;
}

}  // namespace

std::optional<LoopInput> restoreLoop(const BendingLaw& law) {
  const LoopOfLaw of = loopOf(law);
  if (!of.loop) return std::nullopt;
  return restored(of);
}

std::string sayLoop(const BendingLaw& law) {
  const LoopOfLaw of = loopOf(law);
  const FrictionInBending& loop = *of.loop;
  std::string text = fmt::format(
      "Bending has hysteresis{}: {} N m (weft) where cloth was never bent, {} N m beyond the friction between its "
      "fibres, which is overcome at {} 1/m.",
      of.isotropic ? ", the same about all axes" : "", formatNumber(loop.first_Nm[0]), formatNumber(loop.weft_Nm),
      formatNumber(loop.span_per_m[0]));
  const std::string cycle = of.set_by == SetBy::cycles
                                ? "at the end of each cycle of bending and recovery (Wong 2014, eq. 4.6 to 4.12)"
                                : fmt::format("in a cycle to {} 1/m and back", formatNumber(loop.cycle_per_m));
  if (loop.setting > 0 || loop.fatigue > 0)
    text += fmt::format(" Folds set (lambda {}), and friction tires by {} {}.", formatNumber(loop.setting),
                        formatNumber(loop.fatigue), cycle);
  if (of.recovery > 0)
    text += fmt::format(" A part of {} of the rigidity relaxes within {} s.", formatNumber(of.recovery),
                        formatNumber(of.recovery_time_s));
  return text;
}

}  // namespace gambeson::schema
