/// Detail of page_parts.hpp: torques of the variants: curves, ratios, exponents, elasticities, standing, meshes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/report/chart.hpp"
#include "analysis/report/html.hpp"
#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/joint_words.hpp"

namespace gambeson::study {
namespace {

using html::element;
using html::escape;

std::string named(const std::string& setting, const std::string& joint) {
  return setting.empty() ? joint : setting + ", " + joint;
}

/// Labels of the joints that matter somewhere.
bool matters(const Comparison& c, const std::string& label) {
  for (const VariantGroup& g : c.groups)
    for (const std::string& name : g.joints)
      for (const std::size_t i : g.members)
        if (const JointNumbers* j = c.runs[i].joint(name); j && j->label == label) return true;
  return false;
}

}  // namespace

std::string curvesOf(const Study& s, const Comparison& c) {
  constexpr std::size_t most = 3;  // lines beside the baseline's that can be told apart
  // The peak that is marked is that of the one that the verdict names.
  const std::string named_one =
      c.verdict.take >= 0 ? c.input.options[static_cast<std::size_t>(c.verdict.take)].name : "";
  std::string open, more;
  for (const VariantGroup& g : c.groups) {
    std::size_t last = 0;
    std::string highest;
    double peak_Nm = 0, decides_Nm = 0;
    for (const std::size_t i : g.members) {
      last = std::max(last, memberOrder(s, c, i));
      if (const JointNumbers* top = c.runs[i].highest(); top && std::abs(top->peak_Nm) > peak_Nm)
        highest = top->name, peak_Nm = std::abs(top->peak_Nm);
      if (const JointNumbers* j = c.runs[i].joint(g.joint())) decides_Nm = std::max(decides_Nm, std::abs(j->peak_Nm));
    }
    if (peak_Nm < 1.1 * decides_Nm) highest = g.joint();  // as good as the same
    for (const std::string& name : g.joints)
      for (std::size_t from = 1; from <= std::max<std::size_t>(last, 1); from += most) {
        Plot plot;
        bool has_named = false;
        const JointNumbers* marked = nullptr;
        plot.mark_of = named_one;
        for (const std::size_t i : g.members) {
          const JointNumbers* j = c.runs[i].joint(name);
          const std::size_t order = memberOrder(s, c, i);
          if (!j || (order != 0 && (order < from || order >= from + most))) continue;
          plot.title = named(g.label, j->label);
          plot.mark_from_s = c.runs[i].counted_from_s;
          plot.caption = signOf(j->movement());
          const bool is_named = memberName(s, c, i) == named_one;
          has_named = has_named || is_named;
          if (is_named || (!has_named && (!marked || std::abs(j->peak_Nm) > std::abs(marked->peak_Nm)))) marked = j;
          plot.peak_note = nameOf(pushOf(marked->peak_Nm, marked->rate_at_peak));
          plot.series.push_back({memberName(s, c, i), "Nm", c.runs[i].time_s, j->torque_Nm,
                                 static_cast<Tone>(order == 0 ? 0 : 1 + (order - 1) % most)});
        }
        std::stable_sort(plot.series.begin(), plot.series.end(),
                         [](const Series& a, const Series& b) { return a.tone < b.tone; });
        if (has_named && plot.series.size() > 1) plot.caption += " Marked is the peak of " + named_one + ".";
        if (!plot.series.empty()) (name == g.joint() || name == highest ? open : more) += lineChart(plot);
      }
  }
  if (open.empty()) return "";
  return charts(open) + (more.empty() ? "" : folded("The other joints that matter", charts(more)));
}

namespace {

/// Along one axis, of one joint in one setting.
struct Law {
  std::string axis, setting, joint;
  const AxisExponent *peak = nullptr, *rms = nullptr;
  /// A power describes one of its curves.
  bool isPower() const { return (peak && !peak->law.turns()) || (rms && !rms->law.turns()); }
};

std::vector<Law> lawsThatMatter(const Comparison& c) {
  std::vector<Law> laws;
  for (const AxisExponent& e : c.exponents) {
    if (!matters(c, e.joint)) continue;
    auto at = std::find_if(laws.begin(), laws.end(), [&](const Law& l) {
      return l.axis == e.axis && l.setting == e.setting && l.joint == e.joint;
    });
    if (at == laws.end()) at = laws.insert(at, {e.axis, e.setting, e.joint});
    (e.quantity == "peak" ? at->peak : at->rms) = &e;
  }
  return laws;
}

std::vector<Html> exponentCells(const Law* l, bool neighbours) {
  const auto cell = [](const AxisExponent* e) { return Html(e && !e->law.turns() ? e->law.exponent : std::nan("")); };
  std::vector<Html> cells{cell(l ? l->peak : nullptr), cell(l ? l->rms : nullptr)};
  if (neighbours)
    cells.push_back(
        Html::aligned(l && l->peak && l->peak->law.points > 2 && !l->peak->law.turns()
                          ? escape(formatNumber(l->peak->law.lowest) + " to " + formatNumber(l->peak->law.highest))
                          : "\u2013"));
  return cells;
}

bool isMultiple(const Study& s, const std::string& axis) {
  return std::any_of(s.axes.begin(), s.axes.end(), [&](const Axis& a) { return a.name == axis && a.multiple; });
}

/// A line per motion, of the joint that decides, along every axis with three levels or more: two are a straight line.
std::string lawPlots(const Study& s, const Comparison& c, const std::vector<Law>& laws) {
  std::map<std::string, XyPlot> plots;
  for (const Law& l : laws) {
    const bool decides = std::any_of(c.groups.begin(), c.groups.end(), [&](const VariantGroup& g) {
      return std::any_of(g.members.begin(), g.members.end(), [&](std::size_t i) {
        const JointNumbers* j = c.runs[i].joint(g.joint());
        return j && j->label == l.joint;
      });
    });
    if (!l.peak || l.peak->law.points < 3 || !decides) continue;
    XyPlot& plot = plots[l.axis];
    if (plot.series.empty())
      plot = {"Peak torque over " + l.axis,
              "Both axes are logarithmic" +
                  (l.peak->law.turns() ? "." : ", so that a power of the " + l.axis + " is a straight line."),
              l.axis + (isMultiple(s, l.axis) ? ", as a multiple of the design\u2019s" : ""),
              "peak [Nm]",
              {},
              true};
    plot.series.push_back({named(l.setting, l.joint), l.peak->x, l.peak->y});
  }
  std::string out;
  for (const auto& [axis, plot] : plots) out += xyChart(plot);
  return out;
}

}  // namespace

std::string lawsOf(const Study& s, const Comparison& c) {
  const std::vector<Law> laws = lawsThatMatter(c);
  const bool neighbours = std::any_of(
      laws.begin(), laws.end(), [](const Law& l) { return l.peak && l.peak->law.points > 2 && !l.peak->law.turns(); });
  const std::string main = c.main_axis >= 0 ? s.axes[static_cast<std::size_t>(c.main_axis)].name : "";
  std::vector<std::string> levels;  // but the baseline's
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members)
      if (!isBaseline(s, i) && !c.ratios[i].empty() &&
          std::find(levels.begin(), levels.end(), memberName(s, c, i)) == levels.end())
        levels.push_back(memberName(s, c, i));
  std::vector<std::string> columns{"joint"};
  for (const std::string& l : levels)
    for (const char* what : {"peak", "RMS", "same course"}) columns.push_back(l + ": " + what);
  bool any_law = false;
  for (const Law& l : laws) any_law = any_law || (l.axis == main && l.isPower());
  if (any_law) columns.insert(columns.end(), {"exponent of the peak", "of the RMS"});
  if (any_law && neighbours) columns.push_back("of the peak, from level to level");
  std::vector<std::vector<Html>> rows, others;
  for (const VariantGroup& g : c.groups) {
    if (!g.label.empty() && !g.joints.empty()) {
      rows.push_back({Html::heading(escape(g.label))});
      rows.back().resize(columns.size(), Html(std::string()));
    }
    for (const std::string& name : g.joints) {
      std::vector<Html> row{Html(std::string())};
      for (const std::string& level : levels) {
        const JointRatio* r = nullptr;
        for (const std::size_t i : g.members)
          if (memberName(s, c, i) == level) r = ratioOf(c, i, name);
        row.push_back(r ? Html(r->peak) : Html(std::nan("")));
        row.push_back(r ? Html(r->rms) : Html(std::nan("")));
        row.push_back(r ? Html(r->likeness.correlation) : Html(std::nan("")));
      }
      std::string label;
      for (const std::size_t i : g.members)
        if (const JointNumbers* j = c.runs[i].joint(name)) label = j->label;
      row[0] = escape(label);
      if (any_law) {
        const Law* law = nullptr;
        for (const Law& l : laws)
          if (l.axis == main && l.joint == label && l.setting == settingOf(s, s.variants[g.members[0]], {c.main_axis}))
            law = &l;
        for (Html& cell : exponentCells(law, neighbours)) row.push_back(std::move(cell));
      }
      rows.push_back(std::move(row));
    }
  }
  for (const Law& l : laws) {
    if (l.axis == main || !l.isPower()) continue;
    others.push_back({escape(named(l.axis + (l.setting.empty() ? "" : ": " + l.setting), l.joint))});
    for (Html& cell : exponentCells(&l, neighbours)) others.back().push_back(std::move(cell));
  }
  std::string out;
  if (columns.size() > 1 && !rows.empty())
    out += htmlTable(
        "As a multiple of the baseline\u2019s, same motion and joint", columns, rows,
        fmt::format("Peak: of the largest torques. RMS: of the root mean squares over the time that counts. Same "
                    "course: the correlation of the two curves, 1 where they rise and fall alike.{}",
                    any_law
                        ? " Exponent n: the torque goes with the " + main +
                              " to the power n. With 1, half of it leaves half of the torque, with 3 an eighth, with "
                              "0 all. " +
                              (neighbours ? "How much it varies from level to level shows how far that is from a law."
                                          : "It is of two points: that it holds between or beyond them is not shown.")
                        : ""));
  if (!others.empty()) {
    std::vector<std::string> heads{"axis and joint", "exponent of the peak", "of the RMS"};
    if (neighbours) heads.push_back("of the peak, from level to level");
    out += htmlTable("Exponents along the other axes", heads, others, "");
  }
  const std::string plots = lawPlots(s, c, laws);
  return (plots.empty() ? "" : charts(plots)) + (out.empty() ? "" : element("div", out, " class=\"charts single\""));
}

std::string elasticitiesOf(const Comparison& c) {
  std::vector<std::vector<Html>> rows;
  for (const ElasticityRow& e : c.elasticities) {
    if (!matters(c, e.joint)) continue;
    const auto sum = e.e.sum(), predicted = e.e.thicknessExponent();
    rows.push_back({escape(named(e.setting, e.joint)), std::string(e.quantity), Html(e.e.bending), Html(e.e.membrane),
                    Html(e.e.weight), Html(e.e.inertia), Html(e.e.drag), Html(sum),
                    Html(sum ? 1 - *sum : std::nan(""), 2), Html(predicted), Html(e.measured),
                    predicted && e.measured ? Html(*e.measured - *predicted, 2) : Html(std::nan(""))});
  }
  if (rows.empty()) return "";
  return charts(htmlTable("By how many per cent the torque changes with one per cent of ...",
                          {"torque", "of", "bending", "membrane", "weight", "inertia", "drag", "sum", "rest",
                           "exponent of thickness: predicted", "measured", "difference"},
                          rows,
                          "Each is found from two runs, one with a little less of it and one with a little more. Where "
                          "they do not sum to 1, the rest is carried by what is none of the five: above all springs of "
                          "supports, which do not change with the cloth. The exponent of the thickness that follows is "
                          "membrane + weight + inertia + 3 bending; beside it the one that was measured."));
}

std::string standingOf(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> rows;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members) {
      const JointNumbers* j = c.runs[i].good ? c.runs[i].joint(g.joint()) : nullptr;
      if (!j || !j->standing_Nm) continue;
      const auto above = peakAboveStanding(c.runs[i], *j);
      std::optional<double> ratio, base_above;
      if (g.baseline >= 0)
        if (const JointNumbers* b = c.runs[static_cast<std::size_t>(g.baseline)].joint(g.joint()))
          base_above = peakAboveStanding(c.runs[static_cast<std::size_t>(g.baseline)], *b);
      if (base_above && above && *base_above > 0) ratio = *above / *base_above;
      rows.push_back({escape(s.variants[i].label), escape(j->label), Html(*j->standing_Nm, 2),
                      Html(std::abs(j->peak_Nm)), Html(above), Html(ratio, 2)});
    }
  if (rows.empty()) return "";
  return charts(
      htmlTable("What standing still costs already, and what moving adds",
                {"variant", "joint that decides", "standing [Nm]", "peak [Nm]", "largest distance from standing [Nm]",
                 "of the baseline\u2019s"},
                rows,
                "Standing: the mean torque of the last 0.1 s before the motion, dressed and at rest. Distance "
                "from standing: how far the torque goes from that value, up or down."));
}

std::string meshesOf(const Comparison& c) {
  std::vector<std::vector<Html>> rows;
  for (const MeshRow& m : c.meshes)
    rows.push_back({escape(named(m.setting, m.joint)), Html(m.coarse_points), Html(m.fine_points),
                    Html(std::abs(m.coarse_Nm)), Html(std::abs(m.fine_Nm)), Html(100 * m.difference, 2),
                    Html(100 * m.course, 2), Html(100 * m.bar, 2)});
  if (rows.empty()) return "";
  return charts(htmlTable(
      "Coarse against fine",
      {"variant", "points of the mesh, coarse", "fine", "peak, coarse [Nm]", "fine [Nm]", "difference [%]",
       "curves differ [% of the peak]", "error bar [%]"},
      rows,
      "The same garment computed with fewer and with more points. Curves: root mean square of the "
      "difference from 0.2 s on, of the fine peak. Error bar: either way about the run that this page shows, in "
      "19 of 20 cases; Roache\u2019s grid convergence index of the peaks or of the courses, whichever "
      "differ more (the error falls with the square of the cell, safety 1.25)."));
}

}  // namespace gambeson::study
