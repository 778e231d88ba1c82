#include "analysis/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/ticks.hpp"

namespace gambeson {
namespace {

bool positive(double x) { return x > 0 && std::isfinite(x); }

/// Without zeros at the end: 5 %, not 5.0 %.
std::string short2(double x) {
  std::string s = formatNumber(x, 2);
  if (s.find('.') == std::string::npos) return s;
  while (s.back() == '0') s.pop_back();
  if (s.back() == '.') s.pop_back();
  return s;
}

std::string percent(double part) { return short2(100 * part) + " %"; }

/// The cost that decides: the largest part of a natural moment, or without one the largest peak.
const Option::Cost* worstOf(const Option& o) {
  const Option::Cost* worst = nullptr;
  for (const Option::Cost& c : o.costs) {
    const double part = c.part.value_or(-1), most = worst ? worst->part.value_or(-1) : 0;
    if (!worst || part > most || (part == most && c.peak_Nm > worst->peak_Nm)) worst = &c;
  }
  return worst;
}

Light optionLight(const Option& o, const VerdictInput& in, double error = 0) {
  const Option::Cost* c = worstOf(o);
  if (o.missing || !c || !c->part) return Light::unknown;
  return lightOf(*c->part * (1 + error), in.green, in.red);
}

std::string costText(const Option::Cost& c) {
  std::string s = formatNumber(c.peak_Nm) + " Nm at the " + c.joint;
  if (c.part) s += ", " + percent(*c.part) + " of its natural moment";
  return s + (c.motion.empty() ? "" : " (" + c.motion + ")");
}

/// Index of the choice; -1 where nothing is known.
int choose(const VerdictInput& in, double error) {
  int best = -1;
  const auto worse = [&](int a, int b) {  // a costs more than b
    const auto *ca = worstOf(in.options[static_cast<std::size_t>(a)]),
               *cb = worstOf(in.options[static_cast<std::size_t>(b)]);
    return ca->part && cb->part ? *ca->part > *cb->part : ca->peak_Nm > cb->peak_Nm;
  };
  int green = -1;
  for (int i = 0; i < static_cast<int>(in.options.size()); ++i) {
    const Option& o = in.options[static_cast<std::size_t>(i)];
    if (o.missing || !worstOf(o)) continue;
    if (in.sized && optionLight(o, in, error) == Light::green) green = i;
    if (best < 0 || worse(best, i)) best = i;
  }
  return green >= 0 ? green : best;
}

/// A choice that an error of the torques of this size would change is said to be only just right.
constexpr double kNarrow = 0.1;

/// Smallest relative error, up or down, that changes the choice.
std::optional<double> marginOf(const VerdictInput& in, int take) {
  double margin = std::numeric_limits<double>::infinity();
  for (const Option& o : in.options) {
    const Option::Cost* c = o.missing ? nullptr : worstOf(o);
    if (!c || !c->part || !(*c->part > 0)) continue;
    for (const double limit : {in.green, in.red}) {
      const double error = limit / *c->part - 1;
      // Just beyond the limit, on the side where this option is not now.
      const double beyond = error + (error >= 0 ? 1e-9 : -1e-9);
      const bool other =
          choose(in, beyond) != take || optionLight(in.options[static_cast<std::size_t>(take)], in, beyond) !=
                                            optionLight(in.options[static_cast<std::size_t>(take)], in);
      if (other) margin = std::min(margin, std::abs(error));
    }
  }
  return std::isfinite(margin) ? std::optional(margin) : std::nullopt;
}

std::string whyOf(const VerdictInput& in) {
  std::string why;
  const auto say = [&](const std::string& s) { why += (why.empty() ? "" : " ") + s; };
  for (const Option& o : in.options) {
    if (o.missing || &o - in.options.data() == in.baseline || in.baseline < 0) continue;
    std::string ratios;
    for (const Option::Cost& c : o.costs)
      if (c.ratio)
        ratios += (ratios.empty() ? "" : ", ") + formatNumber(*c.ratio, 2) + (c.motion.empty() ? "" : " " + c.motion);
    if (!ratios.empty())
      say(fmt::format("Peak torque of {} against {}: {}.", o.name,
                      in.options[static_cast<std::size_t>(in.baseline)].name, ratios));
  }
  std::string laws;
  for (const auto& e : in.exponents)
    laws += (laws.empty() ? "" : ", ") + formatNumber(e.law.exponent, 2) +
            (e.law.points > 2 ? fmt::format(" ({} to {} between neighbours)", formatNumber(e.law.lowest, 2),
                                            formatNumber(e.law.highest, 2))
                              : "") +
            (e.motion.empty() ? "" : " " + e.motion);
  if (!laws.empty())
    say(fmt::format(
        "The torque goes with the {} to the power {}: stretch, weight and inertia alone would give 1, bending "
        "alone 3, and what does not go with it, such as drag and springs that hold the garment, less than 1.",
        in.what, laws));
  return why;
}

std::string sureOf(const VerdictInput& in, const Verdict& v) {
  std::string s;
  const auto say = [&](const std::string& text) { s += (s.empty() ? "" : " ") + text; };
  if (!in.mesh_error) {
    say("Mesh error: not known, the study has one mesh.");
    if (v.holds_up_to)
      say(fmt::format(
          "The answer stays the same {}as long as the torques are right within {}{}.",
          *v.holds_up_to < kNarrow ? "only " : "", percent(*v.holds_up_to),
          *v.holds_up_to < kNarrow ? ", a narrow margin: compare with a finer mesh before you decide" : ""));
  } else {
    say(fmt::format("Coarse and fine mesh differ by {} in the peaks.", percent(*in.mesh_error)));
    if (v.holds_up_to)
      say(*in.mesh_error < *v.holds_up_to
              ? fmt::format("That does not change the answer, which stays the same up to {}.", percent(*v.holds_up_to))
              : fmt::format("That is too much to be sure: beyond {} the answer is another one.",
                            percent(*v.holds_up_to)));
    else if (v.light == Light::unknown)
      say("No limit decides, so no error of the torques changes the answer but by changing the order.");
  }
  int missing = 0;
  for (const Option& o : in.options) missing += o.missing;
  if (missing > 0) say(fmt::format("{} of {} are missing because runs failed.", missing, in.options.size()));
  if (in.failing_checks > 0)
    say(fmt::format("Checks fail in {} of {} runs: see below before you rely on this.", in.failing_checks,
                    in.checked_runs));
  else if (in.checked_runs > 0)
    say("All checks of all runs hold.");
  return s;
}

}  // namespace

std::optional<PowerLaw> fitPowerLaw(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size() || x.size() < 2) return {};
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!positive(x[i]) || !positive(y[i])) return {};
    points.emplace_back(std::log(x[i]), std::log(y[i]));
  }
  std::sort(points.begin(), points.end());
  const double n = static_cast<double>(points.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) mx += a / n, my += b / n;
  for (const auto& [a, b] : points) xx += (a - mx) * (a - mx), xy += (a - mx) * (b - my);
  if (!(xx > 0)) return {};
  PowerLaw law;
  law.points = static_cast<int>(points.size());
  law.exponent = xy / xx;
  double rest = 0;
  for (const auto& [a, b] : points) rest += std::pow(b - my - law.exponent * (a - mx), 2);
  law.standard_error = points.size() > 2 ? std::sqrt(rest / (n - 2) / xx) : std::nan("");
  law.lowest = std::numeric_limits<double>::infinity();
  law.highest = -law.lowest;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double dx = points[i + 1].first - points[i].first;
    if (!(dx > 0)) continue;
    const double slope = (points[i + 1].second - points[i].second) / dx;
    law.lowest = std::min(law.lowest, slope);
    law.highest = std::max(law.highest, slope);
  }
  return law;
}

std::optional<double> elasticity(double low, double high, double y_low, double y_high) {
  if (!positive(low) || !positive(high) || low == high || !positive(y_low) || !positive(y_high)) return {};
  return std::log(y_high / y_low) / std::log(high / low);
}

std::optional<double> Elasticities::sum() const {
  if (!complete()) return {};
  return *bending + *membrane + *weight + *inertia + *drag;
}

std::optional<double> Elasticities::thicknessExponent() const {
  if (!bending || !membrane || !weight || !inertia) return {};
  return *membrane + *weight + *inertia + 3 * *bending;
}

Light lightOf(std::optional<double> part, double green, double red) {
  if (!part || !std::isfinite(*part)) return Light::unknown;
  return *part < green ? Light::green : *part > red ? Light::red : Light::amber;
}

const char* nameOf(Light light) {
  switch (light) {
    case Light::green:
      return "green";
    case Light::amber:
      return "amber";
    case Light::red:
      return "red";
    case Light::unknown:
      break;
  }
  return "not known";
}

Verdict verdictOf(const VerdictInput& in) {
  Verdict v;
  v.take = choose(in, 0);
  if (v.take < 0) {
    v.sentence = "No verdict: no variant has a torque to compare.";
    v.sure = sureOf(in, v);
    return v;
  }
  const Option& o = in.options[static_cast<std::size_t>(v.take)];
  const Option::Cost& c = *worstOf(o);
  v.light = optionLight(o, in);
  v.holds_up_to = marginOf(in, v.take);
  const auto known =
      std::count_if(o.costs.begin(), o.costs.end(), [](const auto& cost) { return cost.part.has_value(); });
  const bool only_just = v.holds_up_to && *v.holds_up_to < kNarrow;
  // Motions without a natural moment have no light to stay in.
  const std::string where =
      (known < 2                      ? std::string()
       : known == std::ssize(o.costs) ? fmt::format(" in all {} motions", known)
                                      : fmt::format(" in the {} motions whose natural moments are known", known))
          .append(only_just ? ", though only just" : "");
  const Option* next = nullptr;  // the next larger one, which was not taken
  if (in.sized)
    for (std::size_t i = static_cast<std::size_t>(v.take) + 1; i < in.options.size() && !next; ++i)
      if (!in.options[i].missing && worstOf(in.options[i])) next = &in.options[i];
  switch (v.light) {
    case Light::green:
      if (!in.sized) {
        v.sentence = fmt::format("Take {}: it costs least, {} at most: green, below {}.", o.name, costText(c),
                                 percent(in.green));
      } else if (!next) {
        v.sentence = fmt::format("Take {}, the thickest: it stays green{}, {} at most, below {}.", o.name, where,
                                 costText(c), percent(in.green));
      } else {
        v.sentence =
            fmt::format("Take {}, the thickest that stays green{}: {} at most, below {}. The next, {}, costs {}: {}.",
                        o.name, where, costText(c), percent(in.green), next->name, costText(*worstOf(*next)),
                        nameOf(optionLight(*next, in)));
      }
      break;
    case Light::amber:
    case Light::red:
      v.sentence = fmt::format(
          "{}: {} costs least, but {} at most: {}, {} {}.",
          v.light == Light::red ? "Take none of them as it is" : fmt::format("Take {} if it must be", o.name), o.name,
          costText(c), nameOf(v.light), v.light == Light::red ? "above" : "not below",
          percent(v.light == Light::red ? in.red : in.green));
      break;
    case Light::unknown:
      v.sentence = fmt::format(
          "{} costs the wearer least: {} at most. No natural moment of this task is known, so whether the others cost "
          "too "
          "much cannot be said.",
          o.name, costText(c));
      v.sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(v.sentence[0])));
      break;
  }
  v.why = whyOf(in);
  v.sure = sureOf(in, v);
  return v;
}

}  // namespace gambeson
