/// Detail of page_parts.hpp: what follows from the verdict, in sentences for its cards.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"

namespace gambeson::study {
namespace {

/// What of the cloth its torque goes with most, where the answer costs most, and what to do about it.
std::string countsOf(const Option& taken, const Comparison& c) {
  const Option::Cost* worst = worstCost(taken);
  const ElasticityRow* row = nullptr;
  for (const ElasticityRow& e : c.elasticities) {
    // Settings are names with commas between; "male_p5" is none of "male_p50".
    const bool there = worst && (worst->motion.empty() ||
                                 (", " + e.setting + ", ").find(", " + worst->motion + ", ") != std::string::npos);
    if (e.quantity != "peak" || !there) continue;
    if (!row || (e.joint == worst->joint && row->joint != worst->joint)) row = &e;
  }
  if (!row) return "";
  struct Property {
    std::optional<double> elasticity;
    const char *name, *advice;
  };
  std::vector<Property> all{
      {row->e.bending, "rigidity of bending", "a fabric that bends more easily"},
      {row->e.membrane, "stiffness in the plane", "a fabric that gives more where it is pulled, or more room there"},
      {row->e.weight, "weight", "a lighter fabric"},
      {row->e.inertia, "inertia", "a lighter fabric, above all far from the joint"},
      {row->e.drag, "air drag", "a closer cut"}};
  std::erase_if(all, [](const Property& p) { return !p.elasticity; });
  std::stable_sort(all.begin(), all.end(), [](const Property& a, const Property& b) {
    return std::abs(*a.elasticity) > std::abs(*b.elasticity);
  });
  constexpr double counts = 0.05;  // 10 % less of it changes the torque by half a per cent
  std::erase_if(all, [](const Property& p) { return std::abs(*p.elasticity) < counts; });
  if (all.empty()) return "None of the fabric\u2019s properties by itself changes the torque much.";
  std::string text;
  for (const Property& p : all)
    text += fmt::format("{}10 % less {} {} {} %", text.empty() ? "" : ", ", p.name,
                        *p.elasticity > 0 ? "takes off" : "adds", formatNumber(std::abs(10 * *p.elasticity), 2));
  const std::string whose = row->joint == worst->joint ? "the peak at the " + row->joint : "the highest peak";
  return fmt::format("Of {}{}: {}.{}", whose, row->setting.empty() ? "" : " (" + row->setting + ")", text,
                     *all[0].elasticity > 0 ? fmt::format(" So first {}.", all[0].advice) : "");
}

}  // namespace

std::string changesOf(const Study& s, const Comparison& c) {
  if (!c.verdict.chosen || c.verdict.take < 0 || c.input.role == Role::model) return "";
  const Option& o = c.input.options[static_cast<std::size_t>(c.verdict.take)];
  const bool is_baseline = c.verdict.take == c.input.baseline;
  std::string text = is_baseline || c.input.baseline < 0
                         ? fmt::format("Of what was varied: {}.", o.name)
                         : fmt::format("Of what was varied: {} in place of {}.", o.name,
                                       c.input.options[static_cast<std::size_t>(c.input.baseline)].name);
  if (c.elasticities.empty())
    text +=
        " Which property of the fabric makes the torque was not asked; \"elasticities\" in the study\u2019s file adds "
        "the runs that tell.";
  else if (const std::string counts = countsOf(o, c); !counts.empty())
    text += " " + counts;
  if (!s.optimise) text += " Where the garment should be thick and where thin was not asked; \"optimise\" searches.";
  return text;
}

std::string whereOf(const Study& s, const Comparison& c) {
  if (!c.verdict.chosen || c.verdict.take < 0 || trustOf(c.input).spoiling > 0) return "";
  const Option& o = c.input.options[static_cast<std::size_t>(c.verdict.take)];
  std::vector<const Option::Cost*> costs;
  for (const VariantGroup& g : c.groups)
    if (const Option::Cost* worst = worstCost(o, &g.label)) costs.push_back(worst);
  if (costs.size() < 2) return "";
  const auto bySize = [](const Option::Cost* a, const Option::Cost* b) {
    return a->part.value_or(0) != b->part.value_or(0) ? a->part.value_or(0) > b->part.value_or(0)
                                                      : a->peak_Nm > b->peak_Nm;
  };
  std::stable_sort(costs.begin(), costs.end(), bySize);
  std::string text;
  for (const Option::Cost* k : costs) {
    const std::string share = k->part ? fmt::format(", {} of what the joint needs without the garment",
                                                    percentBeside(*k->part, s.limits.green, s.limits.red))
                                      : "";
    text += fmt::format("{}{}: {} Nm at the {}{}.", text.empty() ? "" : " ", k->motion, formatNumber(k->peak_Nm),
                        k->joint, share);
  }
  return text;
}

std::string trendOf(const Comparison& c) {
  if (c.meshes.empty()) return "";
  double least = 1e300, most = -1e300;  // of the fine run's, what is gone
  for (const MeshRow& m : c.meshes) {
    const double less = 1 - std::abs(m.fine_Nm / m.coarse_Nm);
    if (!std::isfinite(less)) return "";
    least = std::min(least, less), most = std::max(most, less);
  }
  if (least * most <= 0) return "";
  const bool less = least > 0;
  const std::string low = percent(std::min(std::abs(least), std::abs(most))),
                    high = percent(std::max(std::abs(least), std::abs(most)));
  return fmt::format(" Finer cells gave {} {}, by {}: what stands here is rather too {}.",
                     less ? "smaller peaks" : "larger peaks",
                     c.meshes.size() == 1 ? "in the one pair of runs" : "in all pairs of runs",
                     low == high ? low : low + " to " + high, less ? "large" : "small");
}

std::string measuresOf(const Study& s, const Comparison& c) {
  const BarredNumber* widest = nullptr;
  std::string text, whose;
  for (const Budget& b : c.budgets)
    for (const BarredNumber& n : b.numbers)
      if (n.what.quantity == Headline::Quantity::peak && n.relative() &&
          (!widest || *n.relative() > *widest->relative()))
        widest = &n, whose = settingOf(s, s.variants[b.reference], {});
  const auto say = [&](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; };
  if (const auto& k = c.input.stretch) {
    const double known = k->stated ? c.input.law_strain : k->limit;
    if (known > 0 && k->largest > known)
      say(fmt::format(
          "Pull the fabric in a test up to {:.0f} % of stretch: the numbers that the runs have of it hold up "
          "to {:g} %.",
          std::ceil(100 * k->largest), 100 * known));
  }
  if (widest) {
    say(fmt::format("Least sure of the peak torques: {}{}.", widest->what.label, whose.empty() ? "" : ", " + whose));
    for (const std::string& sentence : adviceOf(s, *widest)) say(sentence);
  } else if (c.input.role != Role::model) {
    say("How far the torque depends on what is known of the fabric was not asked; \"uncertainty\" in the study\u2019s "
        "file adds the runs that tell.");
  }
  return text;
}

}  // namespace gambeson::study
