/// Detail of write.hpp: the page's look at what met what, and the headline of runs that nobody wears.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/ticks.hpp"
#include "cases/wear/results/write.hpp"

namespace gambeson {
namespace {

using Value = std::function<double(const CollisionWindow&)>;

Series seriesOf(const Measured& m, const std::string& name, const std::string& unit, Tone tone, const Value& value) {
  Series s{name, unit, {}, {}, tone};
  for (const CollisionWindow& w : m.steps.collisions) {
    s.time_s.push_back(0.5 * (w.start_s + w.end_s));
    s.values.push_back(value(w));
  }
  return s;
}

/// Whether there is a line to see: not where all is 0, nor where most windows have no value.
bool shows(const Plot& plot) {
  for (const Series& s : plot.series) {
    const auto known = std::count_if(s.values.begin(), s.values.end(), [](double v) { return std::isfinite(v); });
    const bool any = std::any_of(s.values.begin(), s.values.end(), [](double v) { return std::isfinite(v) && v != 0; });
    if (any && 2 * known > static_cast<long>(s.values.size())) return true;
  }
  return false;
}

/// The largest (or smallest) of all windows, and when. Without a unit it is a count.
std::vector<TableCell> most(const Measured& m, const std::string& name, const Value& value, const std::string& unit,
                            bool smallest = false) {
  double best = -std::numeric_limits<double>::infinity(), at = 0;
  for (const CollisionWindow& w : m.steps.collisions) {
    const double v = smallest ? -value(w) : value(w);
    if (v > best) best = v, at = w.end_s;
  }
  if (!std::isfinite(best)) return {name, "none", ""};
  if (best == 0 && !smallest) return {name, "0", ""};
  const double shown = smallest ? -best : best;
  return {name, unit.empty() ? fmt::format("{:.0f}", shown) : formatNumber(shown) + " " + unit,
          fmt::format("{:.2f}", at)};
}

std::vector<TableCell> total(const Measured& m, const std::string& name, const Value& value) {
  double sum = 0, at = 0;
  for (const CollisionWindow& w : m.steps.collisions) {
    if (sum == 0 && value(w) > 0) at = w.end_s;
    sum += value(w);
  }
  return {name, fmt::format("{:.0f}", sum), sum > 0 ? fmt::format("{:.2f}", at) : ""};
}

}  // namespace

void addCollisions(const Measured& m, ReportInput& in) {
  const auto count = [](long CollisionWindow::*of) {
    return [of](const CollisionWindow& w) { return static_cast<double>(w.*of); };
  };
  const Value gap_mm = [](const CollisionWindow& w) {
    return w.contacts > 0 ? 1e3 * w.smallest_gap_m : std::numeric_limits<double>::quiet_NaN();
  };
  const Value residual = [](const CollisionWindow& w) { return 1e3 * w.residual_m_per_s; };
  const Value way = [](const CollisionWindow& w) { return w.way_cells; };
  const auto bodies = [](const CollisionWindow& w) { return static_cast<double>(w.contacts - w.cloth_contacts); };
  using W = CollisionWindow;
  Table most_of{"The most in any step", "", {"what", "most", "at [s]"}, {}};
  most_of.rows = {most(m, "Contacts with bodies", bodies, ""),
                  most(m, "Contacts of cloth with cloth", count(&W::cloth_contacts), ""),
                  most(m, "Intersections", count(&W::intersections), ""),
                  most(m, "Smallest gap", gap_mm, "mm", true),
                  most(m, "Residual of the contact solve", residual, "mm/s"),
                  most(m, "Movement of a sample", way, "cells")};
  Table totals{"Over the whole run",
               "An impact is a pair that would have passed through each other; what the solve leaves goes into impact "
               "zones, then the step is cut. Pinched samples have no way to go.",
               {"what", "number", "first at [s]"},
               {}};
  totals.rows = {total(m, "Impacts", count(&W::impacts)), total(m, "Impact zones", count(&W::impact_zones)),
                 total(m, "Cut steps", count(&W::cut_steps)), total(m, "Pinched samples", count(&W::pinched))};
  in.collision_tables.insert(in.collision_tables.end(), {most_of, totals});
  std::vector<Plot> plots{{"Contacts",
                           "The most in a step of each window.",
                           {seriesOf(m, "with bodies", "number", Tone::left, bodies),
                            seriesOf(m, "cloth with cloth", "number", Tone::right, count(&W::cloth_contacts))},
                           {},
                           false},
                          {"Smallest gap",
                           "Between what touches; the line has gaps where nothing does.",
                           {seriesOf(m, "smallest gap", "mm", Tone::third, gap_mm)},
                           {},
                           false},
                          {"Impacts and what remained",
                           "In each window.",
                           {seriesOf(m, "impacts", "number", Tone::left, count(&W::impacts)),
                            seriesOf(m, "impact zones", "number", Tone::right, count(&W::impact_zones)),
                            seriesOf(m, "cut steps", "number", Tone::third, count(&W::cut_steps)),
                            seriesOf(m, "pinched samples", "number", Tone::fourth, count(&W::pinched))},
                           {},
                           false},
                          {"Intersections",
                           "Places where cloth passes through cloth or a mesh, the most in a step of each window.",
                           {seriesOf(m, "intersections", "number", Tone::third, count(&W::intersections))},
                           {},
                           false},
                          {"Residual of the contact solve",
                           "The largest of each window.",
                           {seriesOf(m, "residual", "mm/s", Tone::third, residual)},
                           {},
                           false}};
  plots[1].series[0].gaps = true;
  for (Plot& plot : plots)
    if (shows(plot)) in.collision_plots.push_back(std::move(plot));
}

}  // namespace gambeson
