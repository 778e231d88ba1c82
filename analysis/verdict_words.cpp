/// Detail of verdict_parts.hpp: the sentences of a verdict: which one to take or how the worst fares, whether that is
/// good enough, what is in doubt, and how exact the numbers are.

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
    case Role::model:
      return {"as", "kind of cloth", "kinds of cloth", "costs"};
    case Role::other:
      break;
  }
  return {"with", "variant", "variants", "costs"};
}

std::string whoPays(const VerdictInput& in, const Option& o) {
  return in.role == Role::model ? fmt::format("as {} it costs", o.name)
                                : fmt::format("{} {}", o.name, wordsOf(in.role).costs);
}

namespace {

/// "both motions", "all 3 motions"
std::string allOf(long count, const std::string& many) {
  return count == 2 ? "both " + many : fmt::format("all {} {}", count, many);
}

/// Where torques are judged: " in both motions", " for the 2 wearers whose natural moments are known"; empty for one.
std::string everywhereOf(const VerdictInput& in, const Option& o) {
  const bool all = std::all_of(o.costs.begin(), o.costs.end(), [](const auto& c) { return c.part.has_value(); });
  std::size_t known = 0;
  for (const std::string& m : motionsOf(o)) known += worstCost(o, &m)->part.has_value();
  if (known < 2) return "";
  // Several things together are no variants of their own.
  const RoleWords w = in.setting == Role::other ? RoleWords{"in", "setting", "settings", ""} : wordsOf(in.setting);
  return all ? fmt::format(" {} {}", w.before, allOf(static_cast<long>(known), w.many))
             : fmt::format(" {} the {} {} whose natural moments are known", w.before, known, w.many);
}

/// "for all 3 wearers", "for 1 of 3 wearers", "for the one wearer studied"
std::string amongOf(Role role, long count, long all) {
  const RoleWords w = wordsOf(role);
  if (all == 1) return fmt::format("{} the one {} studied", w.before, w.one);
  return count == all ? fmt::format("{} {}", w.before, allOf(all, w.many))
                      : fmt::format("{} {} of {} {}", w.before, count, all, w.many);
}

/// How far the kinds of cloth of one garment are apart. No light is the garment's own before one kind is believed.
std::string modelSentence(const VerdictInput& in, const Verdict& v) {
  const Option &most = at(in, v.take), *least = &most;
  for (const Option& o : in.options)
    if (isUsable(o) && factorOf(o, *least) > 1) least = &o;
  return fmt::format("One garment as {} kinds of cloth: the largest torque ({}) is {} times the least ({}).{}",
                     usableCount(in), most.name, formatNumber(factorOf(*least, most), 2), least->name,
                     v.light == Light::unknown ? "" : fmt::format(" By the largest it is {}.", nameOf(v.cover)));
}

/// The sentence where no option is taken: how the worst fares, and how many fare like that.
std::string worstSentence(const VerdictInput& in, const Verdict& v) {
  const Option& o = at(in, v.take);
  if (in.role == Role::model && usableCount(in) > 1) return modelSentence(in, v);
  const long all = usableCount(in), alike = std::count_if(in.options.begin(), in.options.end(), [&](const Option&k) {
                                      return isUsable(k) && optionLight(k, in) == v.light;
                                    });
  const std::string who = all > 1 ? whoPays(in, o) + " the largest share of the natural moment" : o.name;
  if (v.light == Light::unknown)
    return all > 1 ? fmt::format("Of the {} {} studied {} the largest torque: whether that is too much is not known.",
                                 all, wordsOf(in.role).many, whoPays(in, o))
                   : fmt::format("{}: whether its torque is too much is not known.", who);
  if (v.light == Light::green && v.cover != Light::green)
    return fmt::format("Low torque {}, with doubt: {}. {}.", amongOf(in.role, alike, all), v.doubt, opening(who, in));
  const char* just = v.light == Light::green && v.holds_up_to && *v.holds_up_to < kNarrow ? ", though only just" : "";
  return fmt::format("{} {}{}: {}.", capital(nameOf(v.light)), amongOf(in.role, alike, all), just, who);
}

/// The worst check that leaves none of the numbers; empty without one.
std::string spoilingOf(const VerdictInput& in) {
  for (const auto& d : in.doubts)
    if (d.order) {
      const std::string place = placeOf(d.runs, in);
      return d.text + (place.empty() ? "" : " " + place);
    }
  return "";
}

/// placeOf, as seen from the one taken: "in its run", "in the run thickness x 1, not in its own".
std::string placeBeside(const WrongRuns& runs, const VerdictInput& in, const Verdict& v) {
  const std::string place = placeOf(runs, in);
  const auto count = static_cast<int>(runs.names.size());
  if (!v.chosen || count == in.checked_runs || count == 0) return place;
  const auto own = std::count(runs.options.begin(), runs.options.end(), v.take);
  const bool several = motionsOf(at(in, v.take)).size() > 1;
  if (count > 1 && own == 1 && several) {
    const auto which = std::find(runs.options.begin(), runs.options.end(), v.take) - runs.options.begin();
    return place + ", among them " + runs.names[static_cast<std::size_t>(which)];
  }
  if (count > 1) return place + (own > 0 ? ", its own among them" : ", none of them its own");
  if (own == 0) return place + ", not in its own";
  return several ? "in its run " + runs.names[0] : "in its run";
}

/// "the check Energy fails in its run: 7.5 % of the work is unaccounted for"; more than two are counted.
std::string failuresOf(const VerdictInput& in, const Verdict& v) {
  constexpr std::size_t most = 2;
  std::string all;
  for (std::size_t i = 0; i < in.doubts.size(); ++i) {
    const auto& d = in.doubts[i];
    if (d.check.empty()) return fmt::format("checks fail in {} of {} runs", in.failing_runs, in.checked_runs);
    if (i < most)
      all += fmt::format("{}the check {} fails {}: {}", i > 0 ? "; " : "", d.check, placeBeside(d.runs, in, v), d.text);
  }
  if (in.doubts.size() == most + 1) all += "; and one more check fails";
  if (in.doubts.size() > most + 1) all += fmt::format("; and {} more checks fail", in.doubts.size() - most);
  return all;
}

/// Where what is taken is in doubt itself: another that is green and without doubt, the thickest of sizes, else the one
/// that costs least. Empty without one.
std::string withoutDoubt(const VerdictInput& in, const Verdict& v) {
  if (!v.chosen || at(in, v.take).trust.whole()) return "";
  const Option* best = nullptr;
  for (const Option& o : in.options)
    if (isUsable(o) && o.trust.whole() && optionLight(o, in) == Light::green &&
        (!best || in.sized || factorOf(o, *best) > 1))
      best = &o;
  if (!best) return "";
  const bool stretched = in.stretch && !in.stretch->holds();
  return fmt::format(" {} {} is green and all its checks hold{}.",
                     trustOf(in).spoiling > 0 ? "Of the others" : "Whoever wants no doubt takes another:", best->name,
                     stretched ? ", and its fabric stretches no further than it is meant for" : "");
}

}  // namespace

std::string doubtOf(const VerdictInput& in, const Verdict& v) {
  std::string all;
  const auto say = [&](const std::string& s) { all += (all.empty() ? "" : "; ") + s; };
  if (in.failing_runs > 0) say(failuresOf(in, v));
  if (in.stretch && !in.stretch->holds()) {
    const std::string place = placeBeside(in.stretched, in, v);
    say(fmt::format("{}{} further than {}: up to {}", place + (place.empty() ? "" : " "), whoStretches(*in.stretch),
                    meantFor(*in.stretch), percent(in.stretch->largest)));
  }
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
    return v.chosen ? fmt::format("Choose none yet: {}.{}", spoiled, withoutDoubt(in, v))
                    : fmt::format("No verdict yet: {}.", spoiled);
  if (!v.chosen) return worstSentence(in, v);
  const long count = usableCount(in);
  const bool doubtful = v.light == Light::green && v.cover != Light::green;
  if (v.light != Light::green || !in.sized) {
    const std::string doubt = doubtful ? " With doubt: " + v.doubt + "." + withoutDoubt(in, v) : "";
    const std::string many =
        in.role == Role::material || in.role == Role::fit ? std::string(wordsOf(in.role).many) + " " : "";
    // The best of them is no answer where it is not good enough itself.
    if (v.light == Light::red)
      return count > 1 ? fmt::format("None of the {} {}is good enough: {} adds the least torque.", count, many, name)
                       : fmt::format("Not good enough: {}, the only one studied.", name);
    return (count > 1 ? fmt::format("Take {}: of the {} {}studied it adds the least torque.", name, count, many)
                      : fmt::format("Only {} was studied: there is nothing to compare it with.", name)) +
           doubt;
  }
  bool thickest = true;
  for (std::size_t i = static_cast<std::size_t>(v.take) + 1; i < in.options.size(); ++i)
    thickest = thickest && !isUsable(in.options[i]);
  const std::string where = everywhereOf(in, o);
  if (doubtful)
    return (thickest ? fmt::format("Take {}, with doubt: the thickest studied, and its torque is low enough{}, but {}.",
                                   name, where, v.doubt)
                     : fmt::format("Take {}, with doubt: the thickest whose torque is low enough{}, but {}.", name,
                                   where, v.doubt)) +
           withoutDoubt(in, v);
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
    return fmt::format("Not judged. By numbers that cannot be relied on {}: {}.",
                       v.chosen ? "it would be " + o.name : "the worst is this", up("up to"));
  std::string text;
  switch (v.light) {
    case Light::green:
      text = v.cover == Light::green
                 ? fmt::format("Good enough: {}: green, below {}.", up("at most"), percent(in.green))
                 : fmt::format(
                       "By its torque it would be good enough: {}, below {}; with the doubt above that is no "
                       "green.",
                       up("at most"), percent(in.green));
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
                        opening(whoPays(in, o), in), cost);
}

std::string numbersOf(const VerdictInput& in, const Verdict& v) {
  std::string s;
  const auto say = [&](const std::string& text) { s += (s.empty() ? "" : " ") + text; };
  const ErrorBar bar{in.mesh_error, in.step_error, in.fabric_error};
  if (const auto whole = bar.combined()) {
    std::string parts;
    for (const BarPart part : kBarParts)
      if (const auto one = bar.of(part))
        parts += fmt::format("{}{} {} %{}", parts.empty() ? "" : ", ", nameOf(part), formatBrief(100 * *one, 2),
                             part == BarPart::mesh && !in.mesh_where.empty() ? " (" + in.mesh_where + ")" : "");
    say(fmt::format("Error bar of the peaks: {} % either way, in 19 of 20 cases: {}.", formatBrief(100 * *whole, 2),
                    parts));
  }
  if (!in.mesh_error)
    say(fmt::format("No error bar{}: the study has one mesh, so what a finer one would change is not known.",
                    bar.combined() ? " of the mesh" : ""));
  const bool judged = trustOf(in).spoiling == 0;
  if (judged && v.holds_up_to && v.light == Light::red)
    say(fmt::format("It is not red only if the true torque is more than {} smaller.", percent(*v.holds_up_to)));
  if (judged && v.holds_up_to && v.light == Light::amber)
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
  if (in.failing_runs == 0 && in.checked_runs > 0) say("All checks of all runs hold.");
  if (in.failing_runs > 0) {
    say(fmt::format("Checks fail in {} of {} runs{}.", in.failing_runs, in.checked_runs,
                    v.surety == Surety::no ? "" : ": that makes the sizes of the torques less sure than their order"));
  }
  // A limit that the case states counts, though the law of the fabric ends before it.
  if (in.stretch && in.stretch->stated && in.stretch->holds() && in.law_strain > 0 &&
      in.stretch->largest > in.law_strain)
    say(
        fmt::format("{} by up to {}, less than {}, and that limit counts; its law is taken for strains below {}, and "
                    "continued beyond.",
                    capital(whoStretches(*in.stretch)), percent(in.stretch->largest), meantFor(*in.stretch),
                    percent(in.law_strain)));
  if (in.stretch && !in.stretch->holds()) say(gambeson::sentenceOf(*in.stretch));
  return s;
}

}  // namespace gambeson::verdict
