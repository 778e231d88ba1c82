#include "analysis/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/ticks.hpp"
#include "analysis/verdict_parts.hpp"

namespace gambeson {
namespace verdict {

std::string percent(double part) { return formatBrief(100 * part, 2) + " %"; }
std::string bracketed(const std::string& text) { return text.empty() ? "" : " (" + text + ")"; }
std::string capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string opening(const std::string& text, const VerdictInput& in) {
  return text.starts_with(in.what) || in.role == Role::model ? capital(text) : text;
}

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

std::string costText(const Option::Cost& c, const VerdictInput& in) {
  std::string s = formatNumber(c.peak_Nm) + " Nm at the " + c.joint;
  if (c.part)
    s += ", " + percentBeside(*c.part, in.green, in.red) + " of its natural " + formatNumber(c.peak_Nm / *c.part) +
         " Nm";
  return s + bracketed(c.motion);
}

std::string whoStretches(const Stretch& s) {
  return s.garment.empty() ? "the fabric stretches" : fmt::format("the fabric of {} stretches", s.garment);
}

std::string meantFor(const Stretch& s) {
  return fmt::format("the {} that {} is meant for", percent(s.limit), s.stated ? "it" : "its law");
}

bool isUsable(const Option& o) { return !o.missing && worstCost(o); }

long usableCount(const VerdictInput& in) { return std::count_if(in.options.begin(), in.options.end(), isUsable); }

Light optionLight(const Option& o, const VerdictInput& in, double error) {
  const Option::Cost* c = worstCost(o);
  if (o.missing || !c || !c->part) return Light::unknown;
  return lightOf(*c->part * (1 + error), in.green, in.red);
}

double factorOf(const Option& a, const Option& b) {
  const Option::Cost *ca = worstCost(a), *cb = worstCost(b);
  return ca->part && cb->part ? *cb->part / *ca->part : cb->peak_Nm / ca->peak_Nm;
}

const VerdictInput::Exponent* exponentOf(const VerdictInput& in, const Option::Cost& c) {
  for (const auto& e : in.exponents)
    if (e.motion == c.motion && e.joint == c.joint) return &e;
  return nullptr;
}

/// Garments at a size: those that go with it, from the option's own.
std::string garmentsAt(const VerdictInput& in, int option, double size) {
  const Option& o = at(in, option);
  std::string text;
  for (const Option::Garment& l : o.garments) {
    bool goes = true;
    for (const Option& other : in.options)
      for (const Option::Garment& k : other.garments)
        if (k.name == l.name)
          goes = goes && std::abs(k.thickness_m / l.thickness_m / (*other.size / *o.size) - 1) < 1e-6;
    if (goes || size == *o.size)
      text += fmt::format("{}{}{} mm", text.empty() ? "" : ", ", l.name.empty() ? "" : l.name + " ",
                          formatNumber(1e3 * l.thickness_m * size / *o.size));
  }
  return text;
}

namespace {

const Option::Comfort* leastComfortable(const Option& o) {
  const Option::Comfort* worst = nullptr;
  for (const Option::Comfort& c : o.comforts)
    if (!worst || c.light > worst->light || (c.light == worst->light && c.part_of_limit() > worst->part_of_limit()))
      worst = &c;
  return worst;
}

}  // namespace

LeastComfortable leastComfortable(const VerdictInput& in, const Verdict& v) {
  if (v.chosen) return {&at(in, v.take), leastComfortable(at(in, v.take))};
  LeastComfortable worst;
  for (const Option& o : in.options) {
    const Option::Comfort* c = leastComfortable(o);
    if (c && (!worst.comfort || c->light > worst.comfort->light ||
              (c->light == worst.comfort->light && c->part_of_limit() > worst.comfort->part_of_limit())))
      worst = {&o, c};
  }
  return worst;
}

}  // namespace verdict

namespace {

using namespace verdict;

/// Index of the choice where all torques are off by a relative error: the thickest that is green, or what costs least;
/// of what is not chosen that which costs most. -1 where nothing is known.
int choose(const VerdictInput& in, double error) {
  int best = -1, green = -1;
  const bool chosen = isChosen(in.role);
  for (int i = 0; i < static_cast<int>(in.options.size()); ++i) {
    const Option& o = at(in, i);
    if (!isUsable(o)) continue;
    if (in.sized && optionLight(o, in, error) == Light::green) green = i;
    if (best < 0) best = i;
    // A cost whose natural moment is known counts before one without.
    const bool known = worstCost(o)->part.has_value(), before = worstCost(at(in, best))->part.has_value();
    if (chosen ? factorOf(o, at(in, best)) > 1 : known != before ? known : factorOf(at(in, best), o) > 1) best = i;
  }
  return chosen && green >= 0 ? green : best;
}

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

}  // namespace

bool isChosen(Role role) {
  return role == Role::thickness || role == Role::material || role == Role::fit || role == Role::other;
}

Trust trustOf(const VerdictInput& in) {
  Trust t;
  t.failing = in.failing_runs;
  for (const auto& d : in.doubts) t.spoiling += d.order;
  if (in.stretch) t.stretch(*in.stretch);
  return t;
}

std::string placeOf(const WrongRuns& runs, const VerdictInput& in) {
  const std::size_t count = runs.names.size();
  if (count == 0) return "";
  if (count > 1 && static_cast<int>(count) == in.checked_runs) return fmt::format("in all {} runs", count);
  return count == 1 ? fmt::format("in the run {}", runs.names[0])
                    : fmt::format("in {} of {} runs", count, in.checked_runs);
}

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
  v.chosen = isChosen(in.role);
  v.take = choose(in, 0);
  if (v.take < 0) {
    v.sentence = !in.options.empty() &&
                         std::all_of(in.options.begin(), in.options.end(), [](const Option& o) { return o.untouched; })
                     ? "No verdict: the garment touches nothing that a joint moves, so that no torque tells what it "
                       "costs."
                     : "No verdict: no variant has a torque to compare.";
    v.numbers = numbersOf(in, v);
    return v;
  }
  v.light = optionLight(at(in, v.take), in);
  v.holds_up_to = marginOf(in, v.take);
  v.doubt = doubtOf(in, v);
  const Trust trust = trustOf(in);
  v.cover = shownLight(v.light, trust);
  if (v.cover == Light::green && !v.doubt.empty()) v.cover = Light::doubtful;
  v.sentence = sentenceOf(in, v);
  if (const auto& size = at(in, v.take).size; v.chosen && size) v.garments = garmentsAt(in, v.take, *size);
  v.enough = enoughOf(in, v);
  if (trust.spoiling == 0) {
    v.estimate = estimateOf(in, v);
    v.why = whyOf(in, v);
  }
  v.comfort = comfortOf(in, v);
  if (const auto least = leastComfortable(in, v); least.comfort) {
    v.comfort_light = shownLight(least.comfort->light, trust);
    if (v.comfort_light == Light::green && !v.doubt.empty()) v.comfort_light = Light::doubtful;
  }
  if (trust.spoiling == 0) judgeChoice(in, v);
  v.numbers = numbersOf(in, v);
  return v;
}

}  // namespace gambeson
