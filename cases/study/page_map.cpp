/// Detail of page_parts.hpp: the thickness map that was found, what it gains, and where it stops helping.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/report/html.hpp"
#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"

namespace gambeson::study {
namespace {

using html::element;
using html::escape;
using html::prose;

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return all;
}

std::string folderLink(const MapRun& r, const std::string& text) {
  return element("a", escape(text), " href=\"" + escape(r.folder) + "/report.html\"");
}

std::string barText(const Optimise& o, const MapGain& g) {
  if (!g.scattered)
    return o.found.repeats.empty()
               ? "Nothing was repeated, so that there is no error bar. "
               : "The repeats gave the same numbers to the last digit, so that they changed no step and "
                 "there is no error bar. ";
  std::string text = fmt::format("The error bar is \u00b1 {}: {} from the repeats", percent(g.bar()), percent(g.noise));
  text += g.mesh ? fmt::format(", {} from a finer mesh", percent(*g.mesh))
                 : std::string("; without \"finer\" in the study nothing says what the mesh adds to it");
  return text + (o.aim == Aim::torque
                     ? ". Both maps run on one mesh with one step, so that what these do to both drops "
                       "out of the gain: the bar is by how much the gain moves. "
                     : ". ");
}

/// What was found, in sentences.
std::string saidOfTorque(const Optimise& o, const MapGain& g) {
  const FoundMap& f = o.found;
  if (f.best == 0) return "No map that was tried costs less torque than the one that the search started from. ";
  const std::string to = f.found().joint == f.start().joint ? "" : " at the " + f.found().joint;
  const std::string gain =
      fmt::format("At the same mass of {} kg the largest added torque falls from {} Nm at the {} to {} Nm{}: {} less. ",
                  formatNumber(f.start().mass_kg), formatNumber(f.start().torque_Nm), f.start().joint,
                  formatNumber(f.found().torque_Nm), to, percent(g.gain));
  std::string sure = g.sure        ? "The gain is larger than that"
                     : g.scattered ? "The gain is not larger than that: it may be none"
                                   : "Whether the gain is more than chance is not known";
  if (g.finer) sure += fmt::format("{}on the finer mesh it is {}", g.sure ? "; " : ", and ", percent(*g.finer));
  return gain + barText(o, g) + sure + ". ";
}

std::string saidOfMass(const Optimise& o, const MapGain& g) {
  const FoundMap& f = o.found;
  if (f.found().torque_Nm > o.limit_Nm)
    return fmt::format("No map that was tried stays below {} Nm; the lowest has {} Nm at the {}. ",
                       formatNumber(o.limit_Nm), formatNumber(f.found().torque_Nm), f.found().joint);
  std::string text =
      fmt::format("The lightest map below {} Nm weighs {} kg instead of {} kg, {} less, and has {} Nm at the {}. ",
                  formatNumber(o.limit_Nm), formatNumber(f.found().mass_kg), formatNumber(f.start().mass_kg),
                  percent(g.gain), formatNumber(f.found().torque_Nm), f.found().joint);
  text += barText(o, g);
  text += g.sure ? "With the error bar too the torque is below the limit. "
                 : "Within the error bar the torque may be above the limit. ";
  if (g.finer) text += fmt::format("On the finer mesh it has {} Nm. ", formatNumber(*g.finer));
  return text;
}

/// Where more runs, or more room, would help.
std::string whereItStops(const Optimise& o, const MapGain& g) {
  const FoundMap& f = o.found;
  std::string text = f.best == 0
                         ? fmt::format("{} maps were tried. ", f.runs.size())
                         : fmt::format("Map {} of the {} that were tried is the best. ", f.best + 1, f.runs.size());
  // What was still gained in the last fifth of its runs may go on.
  const bool used_up = static_cast<int>(f.runs.size()) >= o.runs;
  if (used_up && 5 * (g.helps_until + 1) > 4 * f.runs.size())
    text += "The search still gained when its runs were used up: more runs may gain more. ";
  else if (f.best > 0)
    text += fmt::format("After map {} it gained no more than {}: there it stops helping. ", g.helps_until + 1,
                        o.aim == Aim::torque ? "repeats scatter" : "a thousandth");
  std::vector<std::string> thin, thick;
  const auto free = o.free();
  for (std::size_t i = 0; f.best > 0 && i < free.size(); ++i) {
    if (f.found().map[i] <= o.least + 0.01) thin.push_back(free[i]->name);
    if (f.found().map[i] >= o.most - 0.01) thick.push_back(free[i]->name);
  }
  if (!thin.empty())
    text += fmt::format("As thin as the study allows (x {:g}): {}. What protects sets the gain there, not the search. ",
                        o.least, listed(thin));
  if (!thick.empty()) text += fmt::format("As thick as it allows (x {:g}): {}. ", o.most, listed(thick));
  const auto failing = std::ranges::count_if(f.runs, [](const MapRun& r) { return r.failing > 0; });
  const auto failed = std::ranges::count_if(f.runs, [](const MapRun& r) { return !r.why.empty(); });
  if (failing > 0) text += fmt::format("In {} of the runs checks fail: their own pages say which. ", failing);
  if (failed > 0)
    text += fmt::format("{} could not be run, and counted as ten times the first\u2019s torque. ", failed);
  return text;
}

std::string mapTable(const Optimise& o) {
  const FoundMap& f = o.found;
  std::vector<std::vector<Html>> rows;
  double start_kg = 0, found_kg = 0;
  std::size_t k = 0;
  for (const MapRegion& r : o.regions) {
    if (r.kept) {
      rows.push_back({escape(r.name), Html(1e3 * r.thickness_m * r.factor), Html(1e3 * r.thickness_m * r.factor),
                      Html(1.0), Html(std::string()), Html(std::string()), std::string("kept: protected")});
      continue;
    }
    const double before = f.start().map[k], after = f.found().map[k], kg = f.mass_kg[k];
    start_kg += before * kg;
    found_kg += after * kg;
    const std::string note = after <= o.least + 0.01  ? "as thin as allowed"
                             : after >= o.most - 0.01 ? "as thick as allowed"
                                                      : "";
    rows.push_back({escape(r.name), Html(1e3 * r.thickness_m * before), Html(1e3 * r.thickness_m * after),
                    Html(after / before), Html(1e3 * before * kg), Html(1e3 * after * kg), note});
    ++k;
  }
  rows.push_back({Html::heading("free regions together"), Html(std::string()), Html(std::string()), Html(std::string()),
                  Html(1e3 * start_kg, 5), Html(1e3 * found_kg, 5), std::string()});
  return charts(htmlTable(
      "How thick each region is",
      {"region", "before [mm]", "best map [mm]", "times", "mass before [g]", "mass of best map [g]", ""}, rows,
      "Before: the map that the search started from. Mass and stretch stiffness follow the thickness in proportion, "
      "bending stiffness with its cube."));
}

std::string courseOf(const Optimise& o) {
  XyPlot plot;
  plot.title = "Each map that was tried";
  plot.x_name = "map, in the order of the search";
  plot.y_name = o.aim == Aim::torque ? "largest added torque [Nm]" : "mass of the garments [kg]";
  XySeries all{"tried", {}, {}, true}, best{"best so far", {}, {}, false};
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < o.found.runs.size(); ++i) {
    const MapRun& r = o.found.runs[i];
    if (!r.why.empty()) continue;
    const double value = o.aim == Aim::torque ? r.torque_Nm : r.mass_kg;
    if (o.aim == Aim::torque || r.torque_Nm <= o.limit_Nm) lowest = std::min(lowest, value);
    all.x.push_back(static_cast<double>(i + 1));
    all.y.push_back(value);
    best.x.push_back(static_cast<double>(i + 1));
    best.y.push_back(lowest);
  }
  plot.series = {all, best};
  plot.caption = o.aim == Aim::torque ? "The first is the map that the search started from."
                                      : "Best: the lightest whose torque is below the limit.";
  return charts(xyChart(plot));
}

std::string barTable(const Optimise& o) {
  std::vector<std::vector<Html>> rows;
  const auto add = [&](const std::string& what, const MapRun& start, const MapRun& best) {
    rows.push_back({escape(what), Html(start.mass_kg, 5), Html(best.mass_kg, 5), Html(start.torque_Nm, 4),
                    Html(best.torque_Nm, 4), Html(100 * (1 - best.torque_Nm / start.torque_Nm), 3)});
  };
  add("as searched", o.found.start(), o.found.found());
  for (const MapPair& p : o.found.repeats) add("repeat: " + p.what, p.start, p.best);
  if (o.found.finer) add(o.found.finer->what, o.found.finer->start, o.found.finer->best);
  return charts(htmlTable("Where the error bar comes from",
                          {"runs", "mass before [kg]", "mass of best map [kg]", "torque before [Nm]",
                           "torque of best map [Nm]", "less [%]"},
                          rows, "Masses as the runs have them."));
}

std::string runsTable(const Optimise& o) {
  std::vector<std::string> columns{"map"};
  for (const MapRegion* r : o.free()) columns.push_back(r->name + " x");
  columns.insert(columns.end(), {"mass [kg]", "torque [Nm]", "joint", "checks that fail"});
  std::vector<std::vector<Html>> rows;
  for (std::size_t i = 0; i < o.found.runs.size(); ++i) {
    const MapRun& r = o.found.runs[i];
    std::vector<Html> row{folderLink(r, fmt::format("{}{}", i + 1, i == o.found.best ? " (best)" : ""))};
    for (const double factor : r.map) row.emplace_back(factor, 4);
    row.emplace_back(r.mass_kg, 5);
    row.emplace_back(r.torque_Nm, 4);
    row.emplace_back(escape(r.why.empty() ? r.joint : "failed: " + r.why));
    row.emplace_back(r.failing);
    rows.push_back(std::move(row));
  }
  return folded(fmt::format("All {} maps", rows.size()), charts(htmlTable("Maps", columns, rows, "")));
}

}  // namespace

std::string mapOf(const Study& s) {
  if (!s.optimise || s.optimise->found.runs.empty()) return "";
  const Optimise& o = *s.optimise;
  const MapGain g = gainOf(o);
  const std::string said = o.aim == Aim::torque ? saidOfTorque(o, g) : saidOfMass(o, g);
  return element("p", prose(said), " class=\"sentence\"") + element("p", prose(whereItStops(o, g))) + mapTable(o) +
         barTable(o) + courseOf(o) + runsTable(o);
}

}  // namespace gambeson::study
