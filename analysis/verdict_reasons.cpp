/// Detail of verdict_parts.hpp: why, how comfortable, which size would be, and how sure all that is.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/ticks.hpp"
#include "analysis/verdict_parts.hpp"

namespace gambeson::verdict {

std::string estimateOf(const VerdictInput& in, const Verdict& v) {
  if (!in.sized || !v.chosen || (v.light != Light::amber && v.light != Light::red)) return "";
  std::string sizes, how, not_known;
  const auto say = [](std::string& text, const std::string& s) { text += (text.empty() ? "" : " ") + s; };
  for (const Light light : {Light::amber, Light::green}) {
    if (light == v.light) continue;
    NoSize why = NoSize::none;
    const auto s = sizeFor(in, v.take, light == Light::amber ? in.red : in.green, why);
    if (s) {
      say(sizes,
          fmt::format("About {} {}{}{} would bring it down to {} (range {} to {}).", in.what, in.multiple ? "x " : "",
                      formatNumber(s->size, 2), bracketed(garmentsAt(in, v.take, s->size)), nameOf(light),
                      formatNumber(s->low, 2), formatNumber(s->high, 2)));
      how = fmt::format(
          "Extrapolated, not run: by how the peak that decides, at the {}{}, goes with the {}. The range "
          "is that of the exponents of this joint in all motions.",
          s->joint, bracketed(s->motion), in.what);
    } else if (why == NoSize::too_far) {
      say(not_known, fmt::format("Which {} would be {} cannot be said from this study: it lies more than a factor 3 "
                                 "outside of its range.",
                                 in.what, nameOf(light)));
    } else if (not_known.empty()) {
      say(not_known, fmt::format("Which {} would be {} cannot be said: how the torque goes with it is not known.",
                                 in.what, nameOf(light)));
    }
  }
  for (const std::string& s : {how, not_known})
    if (!s.empty()) say(sizes, s);
  return sizes;
}

std::string whyOf(const VerdictInput& in, const Verdict& v) {
  std::string ratios;
  for (const Option& o : in.options) {
    if (o.missing || in.baseline < 0 || &o == &at(in, in.baseline)) continue;
    std::string all;
    for (const std::string& m : motionsOf(o))
      if (const Option::Cost* c = worstCost(o, &m); c->ratio)
        all += (all.empty() ? "" : ", ") + formatNumber(*c->ratio, 2) + bracketed(m);
    if (!all.empty())
      ratios += fmt::format("{}{} {} it is {}", ratios.empty() ? "" : "; ", wordsOf(in.role).before, o.name, all);
  }
  std::string why;
  const auto say = [&](const std::string& s) { why += (why.empty() ? "" : " ") + s; };
  if (!ratios.empty())
    say(fmt::format("Peak torque in Nm, where it counts most, as a multiple of that {} {}: {}.",
                    wordsOf(in.role).before, at(in, in.baseline).name, ratios));
  std::string laws;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const std::string& m : motionsOf(at(in, v.take)))
    if (const auto* e = exponentOf(in, *worstCost(at(in, v.take), &m)); e && !e->peak.turns()) {
      const std::string range = e->peak.points > 2
                                    ? fmt::format("{} to {} from one {} to the next", formatNumber(e->peak.lowest, 2),
                                                  formatNumber(e->peak.highest, 2), in.what)
                                    : "";
      lowest = std::min(lowest, e->peak.exponent), highest = std::max(highest, e->peak.exponent);
      laws += (laws.empty() ? "" : ", ") + formatNumber(e->peak.exponent, 2) +
              bracketed(m + (m.empty() || range.empty() ? "" : "; ") + range);
    }
  if (!laws.empty())
    say(fmt::format(
        "The torque goes with the {0} to the power {1}: with power 1, half the {0} would leave half of the torque. The "
        "fabric\u2019s stretch, weight and inertia alone give 1, its bending stiffness alone 3, and what does not "
        "depend "
        "on the {0}, such as air drag and springs that hold the garment, 0.",
        in.what, laws));
  // The three powers that are named, and what lies nearest to each.
  const char* cause = lowest > 2 ? "the fabric\u2019s bending"
                      : lowest > 0.5 && highest < 1.5
                          ? "the fabric\u2019s stretch, its weight and its inertia, with the friction that these cause"
                      : highest < 0.5 ? "what does not depend on how thick it is"
                                      : nullptr;
  if (!laws.empty() && cause) say(fmt::format("That is nearest to {}; a mixture of the others can look alike.", cause));
  return why;
}

namespace {

std::string kPa(double Pa) { return formatNumber(1e-3 * Pa) + " kPa"; }

/// Which of its two limits a pressure is told by.
bool toldByMean(const Option::Comfort& c) {
  return c.mean_Pa > c.limit_Pa || c.mean_Pa / c.limit_Pa >= c.peak_Pa / c.peak_limit_Pa;
}

/// "10.1 kPa at the peak (limit 9.81 kPa)"; both limits where both are surpassed, else the one that is nearer.
std::string pressureText(const Option::Comfort& c) {
  const std::string mean = fmt::format("{} in the mean (limit {})", kPa(c.mean_Pa), kPa(c.limit_Pa)),
                    peak = fmt::format("{} at the peak (limit {})", kPa(c.peak_Pa), kPa(c.peak_limit_Pa));
  if (c.mean_Pa > c.limit_Pa && c.peak_Pa > c.peak_limit_Pa) return mean + ", " + peak;
  return toldByMean(c) ? mean : peak;
}

/// In how many joints and motions the torque of `more` is larger than that of `taken`, and where it is not.
std::string comparedOf(const Option& taken, const Option& more, bool one_motion) {
  int less = 0, both = 0;
  std::string others;
  for (const Option::Cost& c : taken.costs) {
    const Option::Cost* k = costAt(more, c.motion, c.joint);
    if (!k) continue;
    ++both;
    if (c.peak_Nm < k->peak_Nm) {
      ++less;
      continue;
    }
    others += fmt::format("{}{}{}: {} Nm against {} Nm", others.empty() ? "" : "; ", c.joint,
                          one_motion ? "" : ", " + c.motion, formatNumber(k->peak_Nm, 2), formatNumber(c.peak_Nm, 2));
  }
  const std::string all = fmt::format("{} {} that matter", both, one_motion ? "joints" : "pairs of joint and motion");
  if (less == both) return fmt::format("Its torque is larger in all {}.", all);
  return fmt::format("Its torque is larger in {} of the {}; not at {}.", less, all, others);
}

/// Whether all options press like this one in its motion.
bool alikeEverywhere(const VerdictInput& in, const Option::Comfort& c) {
  const auto alike = [&](const Option& o) {
    return std::any_of(o.comforts.begin(), o.comforts.end(), [&](const Option::Comfort& k) {
      return k.motion == c.motion && k.part == c.part && k.light == c.light && pressureText(k) == pressureText(c);
    });
  };
  return in.options.size() > 1 && std::all_of(in.options.begin(), in.options.end(), alike);
}

}  // namespace

std::string comfortOf(const VerdictInput& in, const Verdict& v) {
  const auto [option, c] = leastComfortable(in, v);
  if (!c) return "";
  const RoleWords words = wordsOf(in.role);
  if (trustOf(in).spoiling > 0) return "Comfort: not judged.";
  const bool alike = alikeEverywhere(in, *c);
  const bool named = !v.chosen && !alike;
  const std::string at_what = (named ? option->name + (c->motion.empty() ? "" : ", ") : "") + c->motion;
  const std::string when =
      c->peak_time_s && !(toldByMean(*c) && c->peak_Pa <= c->peak_limit_Pa)
          ? fmt::format(", at {:.2f} s{}", *c->peak_time_s, c->peak_during.empty() ? "" : ", during " + c->peak_during)
          : "";
  std::string text = fmt::format("{}: on the {}{} {}{}.",
                                 c->light == Light::red     ? "Not comfortable"
                                 : c->light == Light::amber ? "Not quite comfortable"
                                 : trustOf(in).whole()      ? "Comfortable"
                                                            : "Comfortable, with doubt",
                                 c->part, bracketed(at_what), pressureText(*c), when);
  if (alike)
    text += fmt::format(" The pressure is the same {} all {} {}.", words.before, in.options.size(), words.many);
  if (in.sensor_m > 0) text += fmt::format(" Pressure is the mean over {:g} mm.", 1e3 * in.sensor_m);
  if (!alike)
    for (const Option& o : in.options)
      for (const Option::Comfort& k : o.comforts) {
        if (&o == option || k.motion != c->motion || k.part != c->part) continue;
        const bool by_mean = toldByMean(*c);
        const double change = by_mean ? k.mean_Pa / c->mean_Pa : k.peak_Pa / c->peak_Pa;
        const std::string same =
            fmt::format(": the {} hardly matters here", in.role == Role::other ? in.what : words.one);
        text += fmt::format(" {} {} it is {}{}.", capital(words.before), o.name, kPa(by_mean ? k.mean_Pa : k.peak_Pa),
                            std::abs(change - 1) < kNarrow ? same : "");
      }
  if (!v.chosen) return text;
  // Motions in which the one taken presses worse than another: least torque need not be most comfortable.
  for (const Option::Comfort& mine : option->comforts)
    for (const Option& o : in.options)
      for (const Option::Comfort& k : o.comforts)
        if (&o != option && k.motion == mine.motion && k.light < mine.light)
          text += fmt::format(" Less comfortable than {}{}: {} on the {} ({}) against {} on the {} ({}).", o.name,
                              bracketed(mine.motion), kPa(mine.peak_Pa), mine.part, nameOf(mine.light), kPa(k.peak_Pa),
                              k.part, nameOf(k.light));
  return text;
}

namespace {

/// What options are compared by.
const char* unitOf(const Option& a, const Option& b) {
  return worstCost(a)->part && worstCost(b)->part ? "large a share of the natural moment" : "large a torque";
}

/// Of what is not taken: which is worst, by how much, and what its light stands.
void sayWorst(const VerdictInput& in, Verdict& v) {
  const auto say = [&](const std::string& s) { v.choice += (v.choice.empty() ? "" : " ") + s; };
  const Option &worst = at(in, v.take), *next = nullptr, *least = nullptr;
  for (const Option& o : in.options) {
    if (&o == &worst || !isUsable(o) || worstCost(o)->part.has_value() != worstCost(worst)->part.has_value()) continue;
    if (!next || factorOf(*next, o) > 1) next = &o;
    if (!least || factorOf(o, *least) > 1) least = &o;
  }
  if (next) {
    v.order = factorOf(*next, worst);
    const char* what = unitOf(worst, *next);
    say(fmt::format(
        "{} {} times as {} as {}, the next{}.", whoPays(in, worst), formatNumber(*v.order, 2), what, next->name,
        least != next
            ? fmt::format(", and {} times that of {}, the least", formatNumber(factorOf(*least, worst), 2), least->name)
            : ""));
    v.choice = opening(v.choice, in);
  }
  if (v.holds_up_to)
    say(fmt::format("Its light stays {}as long as the torques are right within {}.",
                    *v.holds_up_to < kNarrow ? "only " : "", percent(*v.holds_up_to)));
}

}  // namespace

void judgeChoice(const VerdictInput& in, Verdict& v) {
  const auto say = [&](const std::string& s) { v.choice += (v.choice.empty() ? "" : " ") + s; };
  const auto missing = std::count_if(in.options.begin(), in.options.end(), [](const Option& o) { return o.missing; });
  // By how much the torques may be wrong before another one is taken: all together where limits decide, one against the
  // other where the order does.
  std::optional<double> margin;
  if (in.sized && v.light == Light::green) {
    margin = v.holds_up_to;
    if (margin)
      say(fmt::format(
          "It stays the answer {}as long as the torques are right within {}: beyond that its own torque may "
          "not be low enough, or that of another may be.",
          *margin < kNarrow ? "only " : "", percent(*margin)));
  } else if (!v.chosen) {
    sayWorst(in, v);
    margin = v.light == Light::unknown ? v.order ? std::optional(*v.order - 1) : std::nullopt : v.holds_up_to;
  } else {
    const Option* next = nullptr;
    for (const Option& o : in.options)
      if (&o != &at(in, v.take) && isUsable(o) &&
          (!next || factorOf(at(in, v.take), o) < factorOf(at(in, v.take), *next)))
        next = &o;
    if (next) {
      v.order = factorOf(at(in, v.take), *next);
      margin = *v.order - 1;
      const bool one_motion = motionsOf(at(in, v.take)).size() < 2;
      say(
          fmt::format("{} costs {} times as {}, each where it costs most. {} To turn the order, the torques of one "
                      "would have to be wrong against the other by that factor.",
                      next->name, formatNumber(*v.order, 2), unitOf(at(in, v.take), *next),
                      comparedOf(at(in, v.take), *next, one_motion)));
      v.choice = opening(v.choice, in);
    }
  }
  // Of two torques one may be off by it upwards, the other downwards.
  const std::optional<double> error = in.error();
  const double e = error.value_or(0);
  const double needed = v.order && (v.chosen || v.light == Light::unknown) ? (1 + e) / std::max(1 - e, 1e-9) - 1 : e;
  v.surety = margin && *margin >= kNarrow ? Surety::fairly : Surety::no;
  if (!margin) v.surety = in.options.size() > 1 && v.light == Light::green ? Surety::fairly : Surety::no;
  if (error && margin) {
    v.surety = *margin > needed ? Surety::yes : Surety::no;
    say(v.surety == Surety::yes ? fmt::format("The error bar is smaller, {}.", percent(*error))
                                : fmt::format("The error bar is {}: too much to be sure.", percent(*error)));
  } else if (margin && *margin < kNarrow) {
    say(v.chosen ? "A narrow margin: compare with a finer mesh before you decide."
                 : "A narrow margin: compare with a finer mesh.");
  } else if (margin) {
    say("No finer mesh was run to confirm it.");
  }
  if (missing > 0) {
    say(fmt::format("{} of {} are missing because runs failed.", missing, in.options.size()));
    v.surety = Surety::no;
  }
  // Where limits decide, so do the sizes of the torques.
  const bool limits_decide = (in.sized && v.light == Light::green) || !v.chosen;
  if (in.failing_runs > 0 && limits_decide) {
    say("The checks that fail touch the sizes of the torques, and with them which of them are low enough.");
    v.surety = Surety::no;
  }
  if (in.stretch && !in.stretch->holds()) {
    const std::string place = placeOf(in.stretched, in);
    say(fmt::format("{} further than {}{}: that touches the sizes of the torques{}.",
                    capital(whoStretches(*in.stretch)), meantFor(*in.stretch), place.empty() ? "" : " " + place,
                    limits_decide ? ", and with them which of them are low enough" : ""));
    v.surety = limits_decide ? Surety::no : std::min(v.surety, Surety::fairly);
  }
}

}  // namespace gambeson::verdict
