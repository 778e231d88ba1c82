#include "analysis/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/ticks.hpp"

namespace gambeson {
namespace {

std::string percent(double part) { return formatBrief(100 * part, 2) + " %"; }

const Option& at(const VerdictInput& in, int i) { return in.options[static_cast<std::size_t>(i)]; }

std::vector<std::string> motionsOf(const Option& o) {
  std::vector<std::string> all;
  for (const Option::Cost& c : o.costs)
    if (std::find(all.begin(), all.end(), c.motion) == all.end()) all.push_back(c.motion);
  return all;
}

const Option::Cost* costAt(const Option& o, const std::string& motion, const std::string& joint) {
  for (const Option::Cost& c : o.costs)
    if (c.motion == motion && c.joint == joint) return &c;
  return nullptr;
}

Light optionLight(const Option& o, const VerdictInput& in, double error = 0) {
  const Option::Cost* c = worstCost(o);
  if (o.missing || !c || !c->part) return Light::unknown;
  return lightOf(*c->part * (1 + error), in.green, in.red);
}

std::string bracketed(const std::string& text) { return text.empty() ? "" : " (" + text + ")"; }

std::string costText(const Option::Cost& c, const VerdictInput& in) {
  std::string s = formatNumber(c.peak_Nm) + " Nm at the " + c.joint;
  if (c.part)
    s += ", " + percentBeside(*c.part, in.green, in.red) + " of its natural " + formatNumber(c.peak_Nm / *c.part) +
         " Nm";
  return s + bracketed(c.motion);
}

bool usable(const Option& o) { return !o.missing && worstCost(o); }

/// How many times as much `b` costs as `a`, where each is worst.
double factorOf(const Option& a, const Option& b) {
  const Option::Cost *ca = worstCost(a), *cb = worstCost(b);
  return ca->part && cb->part ? *cb->part / *ca->part : cb->peak_Nm / ca->peak_Nm;
}

/// Index of the choice where all torques are off by a relative error: the thickest that is green, or what costs least;
/// -1 where nothing is known.
int choose(const VerdictInput& in, double error) {
  int best = -1, green = -1;
  for (int i = 0; i < static_cast<int>(in.options.size()); ++i) {
    const Option& o = at(in, i);
    if (!usable(o)) continue;
    if (in.sized && optionLight(o, in, error) == Light::green) green = i;
    if (best < 0 || factorOf(o, at(in, best)) > 1) best = i;
  }
  return green >= 0 ? green : best;
}

/// A choice that an error of this size would change is said to be only just right.
constexpr double kNarrow = 0.1;

/// Smallest relative error of all torques together, up or down, that changes the choice or its light.
std::optional<double> marginOf(const VerdictInput& in, int take) {
  double margin = std::numeric_limits<double>::infinity();
  for (const Option& o : in.options) {
    const Option::Cost* c = o.missing ? nullptr : worstCost(o);
    if (!c || !c->part || !(*c->part > 0)) continue;
    for (const double limit : {in.green, in.red}) {
      const double error = limit / *c->part - 1;
      // Just beyond the limit, on the side where this option is not now.
      const double beyond = error + (error >= 0 ? 1e-9 : -1e-9);
      const bool other =
          choose(in, beyond) != take || optionLight(at(in, take), in, beyond) != optionLight(at(in, take), in);
      if (other) margin = std::min(margin, std::abs(error));
    }
  }
  return std::isfinite(margin) ? std::optional(margin) : std::nullopt;
}

/// Layers at a size: those that go with it, from the option's own.
std::string layersAt(const VerdictInput& in, int option, double size) {
  const Option& o = at(in, option);
  std::string text;
  for (const Option::Layer& l : o.layers) {
    bool goes = true;
    for (const Option& other : in.options)
      for (const Option::Layer& k : other.layers)
        if (k.name == l.name)
          goes = goes && std::abs(k.thickness_m / l.thickness_m / (*other.size / *o.size) - 1) < 1e-6;
    if (goes || size == *o.size)
      text += fmt::format("{}{}{} mm", text.empty() ? "" : ", ", l.name.empty() ? "" : l.name + " ",
                          formatNumber(1e3 * l.thickness_m * size / *o.size));
  }
  return text;
}

const VerdictInput::Exponent* exponentOf(const VerdictInput& in, const Option::Cost& c) {
  for (const auto& e : in.exponents)
    if (e.motion == c.motion && e.joint == c.joint) return &e;
  return nullptr;
}

std::string sentenceOf(const VerdictInput& in, const Verdict& v) {
  const Option& o = at(in, v.take);
  const auto count = std::count_if(in.options.begin(), in.options.end(), usable);
  const std::string& name = o.name;
  if (v.light != Light::green || !in.sized)
    return count > 1 ? fmt::format("Take {}: of the {} studied it adds the least torque.", name, count)
                     : fmt::format("Take {}: there is nothing to compare it with.", name);
  const std::size_t known = static_cast<std::size_t>(
      std::count_if(o.costs.begin(), o.costs.end(), [](const auto& c) { return c.part.has_value(); }));
  std::vector<std::string> motions;
  for (const std::string& m : motionsOf(o))
    if (worstCost(o, &m)->part) motions.push_back(m);
  const std::string where = motions.size() < 2 ? ""
                            : known == o.costs.size()
                                ? fmt::format(" in all {} motions", motions.size())
                                : fmt::format(" in the {} motions whose natural moments are known", motions.size());
  bool thickest = true;
  for (std::size_t i = static_cast<std::size_t>(v.take) + 1; i < in.options.size(); ++i)
    thickest = thickest && !usable(in.options[i]);
  const char* just = v.holds_up_to && *v.holds_up_to < kNarrow ? ", though only just" : "";
  return thickest ? fmt::format("Take {}: the thickest studied, and green{}{}.", name, where, just)
                  : fmt::format("Take {}: the thickest that stays green{}{}.", name, where, just);
}

/// Where a joint decides because hardly anything is asked of it, the other side tells what a leg pays that bears more.
std::string smallMoment(const Option& o, const Option::Cost& c, const VerdictInput& in) {
  constexpr double kFar = 3;
  const bool right = c.joint.starts_with("right ");
  if (!c.lever_m || !c.part || !(right || c.joint.starts_with("left "))) return "";
  const std::string other = right ? "left " + c.joint.substr(6) : "right " + c.joint.substr(5);
  const Option::Cost* k = costAt(o, c.motion, other);
  if (!k || !k->part || !(*k->part > 0) || k->peak_Nm / *k->part < kFar * c.peak_Nm / *c.part) return "";
  return fmt::format(
      " That moment is small because the ground\u2019s force on this foot passes only {} cm off the joint: at the {}, "
      "{} Nm of natural {} Nm are {}.",
      formatNumber(100 * *c.lever_m, 2), other, formatNumber(k->peak_Nm), formatNumber(k->peak_Nm / *k->part),
      percentBeside(*k->part, in.green, in.red));
}

std::string enoughOf(const VerdictInput& in, const Verdict& v) {
  const Option& o = at(in, v.take);
  const std::string small = smallMoment(o, *worstCost(o), in);
  const std::string cost = costText(*worstCost(o), in);
  std::string text;
  switch (v.light) {
    case Light::green:
      text = fmt::format("Good enough: at most {}: green, below {}.", cost, percent(in.green));
      if (in.sized)
        for (std::size_t i = static_cast<std::size_t>(v.take) + 1; i < in.options.size(); ++i)
          if (usable(in.options[i]))
            return text + fmt::format(" The next, {}, costs {}: {}.", in.options[i].name,
                                      costText(*worstCost(in.options[i]), in), nameOf(optionLight(in.options[i], in)));
      return text;
    case Light::amber:
      return fmt::format("Not free of burden: up to {}: amber, between {} and {}.", cost, percent(in.green),
                         percent(in.red)) +
             small;
    case Light::red:
      return fmt::format("Not good enough as it is: up to {}: red, above {}.", cost, percent(in.red)) + small;
    case Light::unknown:
      break;
  }
  return fmt::format(
      "Whether that is good enough cannot be said: no natural moment of this task is known. It costs {} at most.",
      cost);
}

std::string estimateOf(const VerdictInput& in, const Verdict& v) {
  if (!in.sized || (v.light != Light::amber && v.light != Light::red)) return "";
  std::string sizes, how, not_known;
  const auto say = [](std::string& text, const std::string& s) { text += (text.empty() ? "" : " ") + s; };
  for (const Light light : {Light::amber, Light::green}) {
    if (light == v.light) continue;
    NoSize why = NoSize::none;
    const auto s = sizeFor(in, v.take, light == Light::amber ? in.red : in.green, why);
    if (s) {
      say(sizes,
          fmt::format("About {} {}{}{} would bring it down to {} (range {} to {}).", in.what, in.multiple ? "x " : "",
                      formatNumber(s->size, 2), bracketed(layersAt(in, v.take, s->size)), nameOf(light),
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
    if (!all.empty()) ratios += fmt::format("{}with {} it is {}", ratios.empty() ? "" : "; ", o.name, all);
  }
  std::string why;
  const auto say = [&](const std::string& s) { why += (why.empty() ? "" : " ") + s; };
  if (!ratios.empty())
    say(fmt::format("Peak torque, where it counts most, as a multiple of that with {}: {}.", at(in, in.baseline).name,
                    ratios));
  std::string laws;
  for (const std::string& m : motionsOf(at(in, v.take)))
    if (const auto* e = exponentOf(in, *worstCost(at(in, v.take), &m))) {
      const std::string range = e->peak.points > 2
                                    ? fmt::format("{} to {} from one {} to the next", formatNumber(e->peak.lowest, 2),
                                                  formatNumber(e->peak.highest, 2), in.what)
                                    : "";
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
  return why;
}

const Option::Comfort* leastComfortable(const Option& o) {
  const Option::Comfort* worst = nullptr;
  for (const Option::Comfort& c : o.comforts)
    if (!worst || c.light > worst->light || (c.light == worst->light && c.part_of_limit() > worst->part_of_limit()))
      worst = &c;
  return worst;
}

std::string kPa(double Pa) { return formatNumber(1e-3 * Pa) + " kPa"; }

std::string comfortOf(const VerdictInput& in, const Verdict& v) {
  const Option::Comfort* c = leastComfortable(at(in, v.take));
  if (!c) return "";
  // Both limits where both are surpassed; else the one that is nearer.
  const bool by_mean = c->mean_Pa / c->limit_Pa >= c->peak_Pa / c->peak_limit_Pa;
  const std::string mean = fmt::format("{} in the mean (limit {})", kPa(c->mean_Pa), kPa(c->limit_Pa)),
                    peak = fmt::format("{} at the peak (limit {})", kPa(c->peak_Pa), kPa(c->peak_limit_Pa));
  const bool both = c->mean_Pa > c->limit_Pa && c->peak_Pa > c->peak_limit_Pa;
  std::string text = fmt::format("{}: on the {}{} {}.",
                                 c->light == Light::red     ? "Not comfortable"
                                 : c->light == Light::amber ? "Not quite comfortable"
                                                            : "Comfortable",
                                 c->part, bracketed(c->motion),
                                 both      ? mean + ", " + peak
                                 : by_mean ? mean
                                           : peak);
  for (const Option& o : in.options)
    for (const Option::Comfort& k : o.comforts) {
      if (&o == &at(in, v.take) || k.motion != c->motion || k.part != c->part) continue;
      const bool told_mean = both || by_mean;
      const double change = told_mean ? k.mean_Pa / c->mean_Pa : k.peak_Pa / c->peak_Pa;
      text += fmt::format(" With {} it is {}{}.", o.name, kPa(told_mean ? k.mean_Pa : k.peak_Pa),
                          std::abs(change - 1) < kNarrow ? fmt::format(": the {} hardly matters here", in.what) : "");
    }
  // Motions in which the one taken presses worse than another: least torque need not be most comfortable.
  for (const Option::Comfort& mine : at(in, v.take).comforts)
    for (const Option& o : in.options)
      for (const Option::Comfort& k : o.comforts)
        if (&o != &at(in, v.take) && k.motion == mine.motion && k.light < mine.light)
          text += fmt::format(" Less comfortable than {}{}: {} on the {} ({}) against {} on the {} ({}).", o.name,
                              bracketed(mine.motion), kPa(mine.peak_Pa), mine.part, nameOf(mine.light), kPa(k.peak_Pa),
                              k.part, nameOf(k.light));
  return text;
}

/// In how many joints and motions `more` costs more than `taken`, and where it does not.
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
  if (less == both) return fmt::format("It costs more in all {}.", all);
  return fmt::format("It costs more in {} of the {}; not at {}.", less, all, others);
}

void judgeChoice(const VerdictInput& in, Verdict& v) {
  const auto say = [&](const std::string& s) { v.choice += (v.choice.empty() ? "" : " ") + s; };
  const auto missing = std::count_if(in.options.begin(), in.options.end(), [](const Option& o) { return o.missing; });
  // By how much the torques may be wrong before another one is taken: all together where limits decide, one against the
  // other where the order does.
  std::optional<double> margin;
  if (in.sized && v.light == Light::green) {
    margin = v.holds_up_to;
    if (margin)
      say(fmt::format("It stays the answer {}as long as the torques are right within {}.",
                      *margin < kNarrow ? "only " : "", percent(*margin)));
  } else {
    const Option* next = nullptr;
    for (const Option& o : in.options)
      if (&o != &at(in, v.take) && usable(o) &&
          (!next || factorOf(at(in, v.take), o) < factorOf(at(in, v.take), *next)))
        next = &o;
    if (next) {
      v.order = factorOf(at(in, v.take), *next);
      margin = *v.order - 1;
      const bool one_motion = motionsOf(at(in, v.take)).size() < 2;
      say(
          fmt::format("{} costs {} times as much, each where it costs most. {} To turn the order, the torques of one "
                      "would have to be wrong against the other by that factor.",
                      next->name, formatNumber(*v.order, 2), comparedOf(at(in, v.take), *next, one_motion)));
      v.choice[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(v.choice[0])));
    }
  }
  // Of two torques one may be off by it upwards, the other downwards.
  const double e = in.mesh_error.value_or(0);
  const double needed = v.order ? (1 + e) / std::max(1 - e, 1e-9) - 1 : e;
  v.surety = margin && *margin >= kNarrow ? Surety::fairly : Surety::no;
  if (!margin) v.surety = in.options.size() > 1 && v.light == Light::green ? Surety::fairly : Surety::no;
  if (in.mesh_error && margin) {
    v.surety = *margin > needed ? Surety::yes : Surety::no;
    say(v.surety == Surety::yes
            ? fmt::format("Coarse and fine mesh differ by less, {}.", percent(*in.mesh_error))
            : fmt::format("Coarse and fine mesh differ by {}: too much to be sure.", percent(*in.mesh_error)));
  } else if (margin && *margin < kNarrow) {
    say("A narrow margin: compare with a finer mesh before you decide.");
  } else if (margin) {
    say("No finer mesh was run to confirm it.");
  }
  if (missing > 0) {
    say(fmt::format("{} of {} are missing because runs failed.", missing, in.options.size()));
    v.surety = Surety::no;
  }
  for (const auto& d : in.doubts)
    if (d.order) {
      say(fmt::format("But {}: that may turn the order.", d.text));
      v.surety = Surety::no;
    }
}

std::string numbersOf(const VerdictInput& in, const Verdict& v) {
  std::string s;
  const auto say = [&](const std::string& text) { s += (s.empty() ? "" : " ") + text; };
  if (in.mesh_error)
    say(fmt::format("Error bar of the peaks: {} % either way, the difference of coarse and fine mesh{}.",
                    formatBrief(100 * *in.mesh_error, 2), in.mesh_where.empty() ? "" : " (" + in.mesh_where + ")"));
  else
    say("No error bar: the study has one mesh, so what a finer one would change is not known.");
  if (v.holds_up_to && v.light == Light::red)
    say(fmt::format("It is not red only if the true torque is more than {} smaller.", percent(*v.holds_up_to)));
  if (v.holds_up_to && v.light == Light::amber)
    say(fmt::format("It stays amber as long as the torques are right within {}.", percent(*v.holds_up_to)));
  // What is held, or still grows.
  for (const std::string& m : v.take < 0 ? std::vector<std::string>{} : motionsOf(at(in, v.take))) {
    constexpr double kHigh = 0.9;
    const Option::Cost& c = *worstCost(at(in, v.take), &m);
    if (c.end_part >= kHigh)
      say(
          fmt::format("{} the torque of the {} is at {} of its largest value when the run ends: what going on would "
                      "cost is not known.",
                      m.empty() ? "Here" : "In " + m, c.joint, percent(c.end_part)));
  }
  if (in.stretch && in.stretch->largest > in.stretch->meant_for)
    say(
        fmt::format("Fabric stretches by up to {} (99 % of it by less than {}), and its law is meant for less than {}: "
                    "beyond that its stress is extrapolated.",
                    percent(in.stretch->largest), percent(in.stretch->most), percent(in.stretch->meant_for)));
  if (in.failing_runs == 0 && in.checked_runs > 0) say("All checks of all runs hold.");
  if (in.failing_runs > 0) {
    say(fmt::format("Checks fail in {} of {} runs{}.", in.failing_runs, in.checked_runs,
                    v.surety == Surety::no ? "" : ": that makes the sizes of the torques less sure than their order"));
  }
  return s;
}

}  // namespace

std::string percentBeside(double part, double green, double red) {
  int digits = 2;
  const auto as = [&](double p) { return formatBrief(100 * p, digits); };
  while (digits < 5 && ((part != green && as(part) == as(green)) || (part != red && as(part) == as(red)))) ++digits;
  return as(part) + " %";
}

const Option::Cost* worstCost(const Option& o, const std::string* motion) {
  const Option::Cost* worst = nullptr;
  for (const Option::Cost& c : o.costs) {
    if (motion && c.motion != *motion) continue;
    const double part = c.part.value_or(-1), most = worst ? worst->part.value_or(-1) : 0;
    if (!worst || part > most || (part == most && c.peak_Nm > worst->peak_Nm)) worst = &c;
  }
  return worst;
}

double Option::Comfort::part_of_limit() const { return std::max(mean_Pa / limit_Pa, peak_Pa / peak_limit_Pa); }

std::optional<SizeFor> sizeFor(const VerdictInput& in, int option, double limit, NoSize& why) {
  constexpr double far = 3;  // of the studied range
  const Option& o = at(in, option);
  why = NoSize::no_exponent;
  if (!o.size) return {};
  std::optional<SizeFor> best;
  for (const Option::Cost& c : o.costs) {
    if (!c.part) continue;
    const auto* e = exponentOf(in, c);
    if (!e) {
      if (*c.part < limit) continue;  // not the one that decides, as far as is known
      return {};
    }
    SizeFor here{0, std::numeric_limits<double>::infinity(), 0, c.motion, c.joint};
    const auto size = [&](double exponent) {
      return exponent > 0 ? *o.size * std::pow(limit / *c.part, 1 / exponent) : std::nan("");
    };
    here.size = size(e->peak.exponent);
    bool known = here.size > 0;
    for (const auto& other : in.exponents) {
      if (other.joint != c.joint) continue;
      for (const PowerLaw* law : {&other.peak, &other.rms})
        for (const double exponent : {law->lowest, law->exponent, law->highest}) {
          known = known && exponent > 0;
          here.low = std::min(here.low, size(exponent));
          here.high = std::max(here.high, size(exponent));
        }
    }
    if (!known) {
      if (*c.part < limit) continue;
      return {};
    }
    if (!best || here.size < best->size) best = here;
  }
  if (!best) return {};
  const auto [thin, thick] = std::minmax_element(in.options.begin(), in.options.end(),
                                                 [](const Option& a, const Option& b) { return *a.size < *b.size; });
  why = best->size < *thin->size / far || best->size > *thick->size * far ? NoSize::too_far : NoSize::none;
  return why == NoSize::none ? best : std::nullopt;
}

Verdict verdictOf(const VerdictInput& in) {
  Verdict v;
  v.take = choose(in, 0);
  if (v.take < 0) {
    v.sentence = "No verdict: no variant has a torque to compare.";
    v.numbers = numbersOf(in, v);
    return v;
  }
  v.light = optionLight(at(in, v.take), in);
  v.holds_up_to = marginOf(in, v.take);
  v.sentence = sentenceOf(in, v);
  if (const auto& size = at(in, v.take).size) v.layers = layersAt(in, v.take, *size);
  v.enough = enoughOf(in, v);
  v.estimate = estimateOf(in, v);
  v.why = whyOf(in, v);
  v.comfort = comfortOf(in, v);
  if (const auto* c = leastComfortable(at(in, v.take))) v.comfort_light = c->light;
  judgeChoice(in, v);
  v.numbers = numbersOf(in, v);
  return v;
}

}  // namespace gambeson
