/// The sentences of a verdict: which one to take or how the worst fares, whether that is good enough, what is in doubt,
/// and how exact the numbers are.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/ticks.hpp"
#include "analysis/verdict_parts.hpp"

namespace gambeson::verdict {
namespace {

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

}  // namespace

RoleWords wordsOf(Role role) {
  switch (role) {
    case Role::thickness:
      return {"with", "thickness", "thicknesses", "costs"};
    case Role::mesh:
      return {"on", "mesh", "meshes", "costs"};
    case Role::motion:
      return {"in", "motion", "motions", "costs"};
    case Role::wearer:
      return {"for", "wearer", "wearers", "pays"};
    case Role::size:
      return {"in", "size", "sizes", "costs"};
    case Role::material:
      return {"in", "material", "materials", "costs"};
    case Role::friction:
      return {"at", "friction", "frictions", "costs"};
    case Role::fit:
      return {"with", "fit", "fits", "costs"};
    case Role::other:
      break;
  }
  return {"with", "variant", "variants", "costs"};
}

namespace {

/// Where torques are judged: " in all 2 motions", " for the 2 wearers whose natural moments are known"; empty for one.
std::string everywhereOf(const VerdictInput& in, const Option& o) {
  const bool all = std::all_of(o.costs.begin(), o.costs.end(), [](const auto& c) { return c.part.has_value(); });
  std::size_t known = 0;
  for (const std::string& m : motionsOf(o)) known += worstCost(o, &m)->part.has_value();
  if (known < 2) return "";
  // Several things together are no variants of their own.
  const RoleWords w = in.setting == Role::other ? RoleWords{"in", "setting", "settings", ""} : wordsOf(in.setting);
  return all ? fmt::format(" {} all {} {}", w.before, known, w.many)
             : fmt::format(" {} the {} {} whose natural moments are known", w.before, known, w.many);
}

/// "for all 3 wearers", "for 1 of 3 wearers", "for the one wearer studied"
std::string amongOf(Role role, long count, long all) {
  const RoleWords w = wordsOf(role);
  if (all == 1) return fmt::format("{} the one {} studied", w.before, w.one);
  return count == all ? fmt::format("{} all {} {}", w.before, all, w.many)
                      : fmt::format("{} {} of {} {}", w.before, count, all, w.many);
}

/// "male_p95 pays", "friction 0.5 costs"
std::string whoPays(const VerdictInput& in, const Option& o) {
  return fmt::format("{} {}", o.name, wordsOf(in.role).costs);
}

/// None is taken: how the worst fares, and how many fare like that.
std::string worstSentence(const VerdictInput& in, const Verdict& v) {
  const Option& o = at(in, v.take);
  const long all = usableCount(in), alike = std::count_if(in.options.begin(), in.options.end(), [&](const Option&k) {
                                      return isUsable(k) && optionLight(k, in) == v.light;
                                    });
  const std::string who = all > 1 ? whoPays(in, o) + " most" : o.name;
  if (v.light == Light::unknown)
    return capital(all > 1 ? fmt::format("{} of the {} {} studied: whether that is too much is not known.", who, all,
                                         wordsOf(in.role).many)
                           : fmt::format("{}: whether its torque is too much is not known.", who));
  if (v.light == Light::green && v.cover != Light::green)
    return fmt::format("Low torque {}, with doubt: {}. {}.", amongOf(in.role, alike, all), v.doubt, capital(who));
  const char* just = v.light == Light::green && v.holds_up_to && *v.holds_up_to < kNarrow ? ", though only just" : "";
  return fmt::format("{} {}{}: {}.", capital(nameOf(v.light)), amongOf(in.role, alike, all), just, who);
}

/// The worst check that leaves none of the numbers; empty without one.
std::string spoilingOf(const VerdictInput& in) {
  for (const auto& d : in.doubts)
    if (d.order) return d.text;
  return "";
}

}  // namespace

std::string doubtOf(const VerdictInput& in, const Verdict& v) {
  std::string all;
  const auto say = [&](const std::string& s) { all += (all.empty() ? "" : "; ") + s; };
  if (in.failing_runs > 0) say(fmt::format("checks fail in {} of {} runs", in.failing_runs, in.checked_runs));
  if (in.stretch && !in.stretch->holds())
    say(fmt::format("the fabric stretches by up to {}, and {} is meant for less than {}", percent(in.stretch->largest),
                    in.stretch->stated ? "it" : "its law", percent(in.stretch->limit)));
  std::string missing, untouched, unknown;
  for (const Option& o : in.options) {
    if (o.missing) missing += (missing.empty() ? "" : ", ") + o.name;
    if (o.untouched) untouched += (untouched.empty() ? "" : ", ") + o.name;
    if (!v.chosen && isUsable(o) && !worstCost(o)->part) unknown += (unknown.empty() ? "" : ", ") + o.name;
  }
  if (!missing.empty()) say(fmt::format("of {} nothing is known, as a run failed", missing));
  if (!untouched.empty())
    say(fmt::format("{} {} the garment touches nothing that a joint moves", wordsOf(in.role).before, untouched));
  if (!unknown.empty() && v.light != Light::unknown) say(fmt::format("no natural moment is known of {}", unknown));
  return all;
}

std::string sentenceOf(const VerdictInput& in, const Verdict& v) {
  const Option& o = at(in, v.take);
  const std::string& name = o.name;
  if (const std::string spoiled = spoilingOf(in); !spoiled.empty())
    return v.chosen
               ? fmt::format("Choose none yet: {}. By numbers that cannot be relied on it would be {}.", spoiled, name)
               : fmt::format("No verdict yet: {}. By numbers that cannot be relied on {} most.", spoiled,
                             whoPays(in, o));
  if (!v.chosen) return worstSentence(in, v);
  const long count = usableCount(in);
  const bool doubtful = v.light == Light::green && v.cover != Light::green;
  if (v.light != Light::green || !in.sized) {
    const std::string doubt = doubtful ? " With doubt: " + v.doubt + "." : "";
    return (count > 1
                ? fmt::format(
                      "Take {}: of the {} {}studied it adds the least torque.", name, count,
                      in.role == Role::material || in.role == Role::fit ? std::string(wordsOf(in.role).many) + " " : "")
                : fmt::format("Only {} was studied: there is nothing to compare it with.", name)) +
           doubt;
  }
  bool thickest = true;
  for (std::size_t i = static_cast<std::size_t>(v.take) + 1; i < in.options.size(); ++i)
    thickest = thickest && !isUsable(in.options[i]);
  const std::string where = everywhereOf(in, o);
  if (doubtful)
    return thickest ? fmt::format("Take {}, with doubt: the thickest studied, and its torque is low enough{}, but {}.",
                                  name, where, v.doubt)
                    : fmt::format("Take {}, with doubt: the thickest whose torque is low enough{}, but {}.", name,
                                  where, v.doubt);
  const char* just = v.holds_up_to && *v.holds_up_to < kNarrow ? ", though only just" : "";
  return thickest ? fmt::format("Take {}: the thickest studied, and green{}{}.", name, where, just)
                  : fmt::format("Take {}: the thickest that stays green{}{}.", name, where, just);
}

std::string enoughOf(const VerdictInput& in, const Verdict& v) {
  const Option& o = at(in, v.take);
  const Option::Cost& worst = *worstCost(o);
  const std::string small = smallMoment(o, worst, in);
  const std::string cost = costText(worst, in);
  // Of one that is taken "at most ..."; of the worst "male_p95 pays ...".
  const auto up = [&](const char* bound) { return (v.chosen ? bound : whoPays(in, o)) + " " + cost; };
  if (trustOf(in).spoiling > 0)
    return fmt::format("Not judged, as {}. Its numbers would say: {}.", spoilingOf(in), up("up to"));
  std::string text;
  switch (v.light) {
    case Light::green:
      text = v.cover == Light::green
                 ? fmt::format("Good enough: {}: green, below {}.", up("at most"), percent(in.green))
                 : fmt::format("By its torque it would be good enough: {}, below {}. But {}: that is no green.",
                               up("at most"), percent(in.green), v.doubt);
      if (in.sized)
        for (std::size_t i = static_cast<std::size_t>(v.take) + 1; i < in.options.size(); ++i)
          if (isUsable(in.options[i]))
            return text + fmt::format(" The next, {}, costs {}: {}.", in.options[i].name,
                                      costText(*worstCost(in.options[i]), in), nameOf(optionLight(in.options[i], in)));
      return text;
    case Light::amber:
      return fmt::format("Not free of burden: {}: amber, between {} and {}.", up("up to"), percent(in.green),
                         percent(in.red)) +
             small;
    case Light::red:
      return fmt::format("Not good enough as it is: {}: red, above {}.", up("up to"), percent(in.red)) + small;
    default:
      break;
  }
  return v.chosen ? fmt::format(
                        "Whether that is good enough cannot be said: no natural moment of this task is known. "
                        "It costs {} at most.",
                        cost)
                  : fmt::format(
                        "Whether that is good enough cannot be said: no natural moment of this task is known. "
                        "{} {}.",
                        capital(whoPays(in, o)), cost);
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
  if (in.stretch && !in.stretch->holds()) say(gambeson::sentenceOf(*in.stretch));
  if (in.failing_runs == 0 && in.checked_runs > 0) say("All checks of all runs hold.");
  if (in.failing_runs > 0) {
    say(fmt::format("Checks fail in {} of {} runs{}.", in.failing_runs, in.checked_runs,
                    v.surety == Surety::no ? "" : ": that makes the sizes of the torques less sure than their order"));
  }
  return s;
}

}  // namespace gambeson::verdict
