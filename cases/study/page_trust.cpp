/// Detail of page_parts.hpp: why to trust the comparison: what checks that fail mean, and what was left out.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/report/html.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"
#include "cases/wear/results/check_words.hpp"

namespace gambeson::study {

using html::element;
using html::escape;

std::string checksOf(const Study& s, const Comparison& c) {
  std::vector<std::string> names;
  for (const RunNumbers& r : c.runs)
    for (const CheckNumbers& k : r.checks)
      if (!k.holds && std::find(names.begin(), names.end(), k.name) == names.end()) names.push_back(k.name);
  if (names.empty())
    return element("p", fmt::format("All checks hold in all {} runs that were checked.", c.input.checked_runs));
  std::vector<std::vector<Html>> rows;
  for (const std::string& name : names) {
    std::string runs;
    CheckNumbers worst;
    for (std::size_t i = 0; i < s.variants.size(); ++i)
      for (const CheckNumbers& k : c.runs[i].checks) {
        if (k.holds || k.name != name) continue;
        const std::string unit = k.unit.empty() ? "" : " " + k.unit;
        runs += element("li", html::prose(formatNumber(k.value, 2) + unit + c.runs[i].heldAgainst(name)) + "<br>" +
                                  linkTo(s.variants[i], s.variants[i].label));
        if (worst.name.empty() || !(k.value <= worst.value)) worst = k;
      }
    const CheckWords words = checkWords(name, worst.value, worst.limit, worst.unit);
    rows.push_back({escape(name), element("ul", runs, " class=\"plain\""),
                    Html::aligned(escape(formatNumber(worst.limit, 2) + (worst.unit.empty() ? "" : " ") + worst.unit)),
                    element("div", escape(words.means), " class=\"sentences\""),
                    std::string(words.order ? "<span class=\"bad\">order and sizes</span>" : "sizes")});
  }
  return charts(htmlTable(
      "Checks that fail", {"check", "how much, and where", "allowed", "what that means for the torques", "touches"},
      rows,
      fmt::format(
          "{} The order: which variant costs less. The sizes: how much it costs.",
          c.input.failing_runs < c.input.checked_runs
              ? fmt::format("{} of {} runs; the others hold all checks.", c.input.failing_runs, c.input.checked_runs)
              : fmt::format("None of the {} runs holds all checks.", c.input.checked_runs))));
}

namespace {

/// Joints that the garment does not reach, and the elbow without sleeves: one line for all.
std::string idleJoints(const Study& s, const Comparison& c) {
  std::set<std::string> reported, idle;
  bool elbow = false, touched = false, human = false;
  for (const RunNumbers& r : c.runs) {
    for (const JointNumbers& j : r.joints) {
      (j.applies() ? reported : idle).insert(j.label);
      elbow = elbow || j.name.starts_with("elbow");
    }
    for (const ContactNumbers& b : r.contact)
      touched = touched || (b.share > 0 && (b.segment.find("forearm") != std::string::npos ||
                                            b.segment.find("hand") != std::string::npos));
  }
  for (const Variant& v : s.variants)
    if (const auto* k = std::get_if<Case>(&v.definition)) human = human || k->human.has_value();
  std::string all;
  const auto add = [&](const std::string& j) { all += (all.empty() ? "" : ", ") + j; };
  for (const std::string& j : idle)
    if (!reported.contains(j)) add(j);
  if (human && !elbow && !touched) add("elbow");
  return all.empty() ? "" : element("li", escape("joints beyond which the garment touches nothing: " + all));
}

std::string switchedOffIn(const Study& s) {
  std::vector<std::pair<std::string, std::vector<std::string>>> off;  // of each variant
  for (const Variant& v : s.variants)
    if (const auto* k = std::get_if<Case>(&v.definition)) off.emplace_back(v.label, switchedOff(*k));
  std::string all, some;
  std::set<std::string> said;
  for (const auto& [label, list] : off)
    for (const std::string& o : list) {
      const bool everywhere = std::all_of(off.begin(), off.end(), [&](const auto& other) {
        return std::find(other.second.begin(), other.second.end(), o) != other.second.end();
      });
      if (!everywhere)
        some += element("li", escape(fmt::format("switched off in {}: {}", label, o)));
      else if (said.insert(o).second)
        all += element("li", escape("switched off in all variants: " + o));
    }
  return all + some;
}

}  // namespace

std::string leftOutOf(const Study& s, const Comparison& c) {
  std::string out = idleJoints(s, c) + switchedOffIn(s);
  if (!s.file.empty()) {
    if (c.meshes.empty() && !(s.uncertainty && s.uncertainty->mesh))
      out += element("li",
                     "The study has no finer mesh: there is no error bar. A variant with \"finer\", or an axis with "
                     "the role mesh, gives one.");
    if (c.elasticities.empty())
      out += element("li",
                     "What the torque is made of (bending, membrane, weight, inertia, drag) was not asked: "
                     "\"elasticities\" in the study\u2019s file adds the runs that tell.");
    const bool stood = std::any_of(c.runs.begin(), c.runs.end(), [](const RunNumbers& r) {
      return std::any_of(r.joints.begin(), r.joints.end(), [](const auto& j) { return j.standing_Nm.has_value(); });
    });
    if (!stood)
      out += element("li",
                     "No run stood dressed before its motion (dressing.settle is 0): there is no torque of "
                     "standing to compare with.");
  }
  out += element("li",
                 "Factors: thickness takes mass and membrane in proportion and bending, twist and seams with the cube; "
                 "the contact distance follows it; the drag coefficient, supports and friction stay.");
  out += element("li", "Each variant\u2019s own report says what else was assumed.");
  return element("ul", out, " class=\"assumptions\"");
}

}  // namespace gambeson::study
