/// Detail of page_parts.hpp: how sure the numbers are, and what to do about it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/chart.hpp"
#include "analysis/report/html.hpp"
#include "analysis/ticks.hpp"
#include "cases/study/page_parts.hpp"

namespace gambeson::study {

using html::element;
using html::escape;
using html::prose;

namespace {

std::string settingOf(const Study& s, const Budget& b) { return settingOf(s, s.variants[b.reference], {}); }

std::string headed(const std::string& setting, const std::string& number) {
  return setting.empty() ? number : setting + ": " + number;
}

/// "left hip (flexion), peak torque"
std::string nameOf(const Headline& what) { return fmt::format("{}, {}", what.label, what.name()); }

/// Of each source alone the half width, in the unit of the number.
std::string sourcesOf(const Study& s, const Budget& b, const BarredNumber& n) {
  BarChart chart;
  chart.unit = n.what.unit();
  chart.title = fmt::format("{}: {} \u00b1 {} {}", headed(settingOf(s, b), nameOf(n.what)), formatNumber(n.value),
                            formatNumber(*n.bar.combined(), 2), chart.unit);
  if (n.bar.mesh) chart.bars.push_back({"mesh", *n.bar.mesh});
  if (n.bar.step) chart.bars.push_back({"time step", *n.bar.step});
  if (n.fabric) {
    for (std::size_t k = 0; k < s.uncertainty->spreads.size(); ++k)
      chart.bars.push_back({s.uncertainty->spreads[k].name, kCoverage * std::sqrt(n.fabric->variance[k])});
    chart.bars.push_back({"no single number", kCoverage * n.fabric->residual});
  }
  chart.bars.push_back({"all together", *n.bar.combined()});
  chart.caption = "What each would leave of the error bar by itself. All together: the root of the sum of squares.";
  return barChart(chart);
}

std::string adviceOf(const Study& s, const Budget& b, const BarredNumber& n) {
  std::string text;
  for (const std::string& sentence : gambeson::study::adviceOf(s, n)) text += (text.empty() ? "" : " ") + sentence;
  return element("dt", escape(headed(settingOf(s, b), nameOf(n.what)))) +
         element("dd", element("span", prose(text), " class=\"reason\""));
}

/// Of what the rows below are.
void head(std::vector<std::vector<Html>>& rows, const std::string& setting) {
  if (!setting.empty()) rows.push_back({Html::heading(escape(setting))});
}

std::string partsTable(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> rows;
  const auto cell = [](const std::optional<double>& x) { return Html(x, 2); };
  for (const Budget& b : c.budgets) {
    head(rows, settingOf(s, b));
    for (const BarredNumber& n : b.numbers)
      rows.push_back({escape(nameOf(n.what)), std::string(n.what.unit()), Html(n.value), cell(n.bar.combined()),
                      cell(n.relative() ? std::optional(100 * *n.relative()) : std::nullopt), cell(n.bar.mesh),
                      cell(n.bar.step), cell(n.bar.fabric)});
  }
  return htmlTable("Every number with its error bar",
                   {"number", "unit", "value", "\u00b1", "\u00b1 [%]", "by mesh", "by step", "by fabric"}, rows,
                   "In 19 of 20 cases the true number lies within \u00b1 of the value. Mesh: from the difference to "
                   "finer cells, by Roache\u2019s grid "
                   "convergence index (order 2, safety 1.25), of the peaks or of the whole courses, whichever differ "
                   "more. Step: the "
                   "same from half of every step (order 1), until that run ends. Fabric: twice the standard "
                   "deviation. A dash: not known.");
}

std::string fabricTable(const Study& s, const Comparison& c) {
  const Uncertainty& asked = *s.uncertainty;
  std::vector<std::string> columns{"number", "unit", "standard deviation"};
  for (const StudiedSpread& p : asked.spreads)
    columns.push_back(fmt::format("{} ({} %) [% of the variance]", p.name, formatNumber(100 * p.deviation, 2)));
  columns.insert(columns.end(), {"no single number [%]", "residual", "explained by a line [%]", "samples"});
  std::vector<std::vector<Html>> rows;
  for (const Budget& b : c.budgets) {
    const auto fitted = [](const BarredNumber& n) { return n.fabric.has_value(); };
    if (std::any_of(b.numbers.begin(), b.numbers.end(), fitted)) head(rows, settingOf(s, b));
    for (const BarredNumber& n : b.numbers) {
      if (!fitted(n)) continue;
      const SpreadFit& fit = *n.fabric;
      const double total = fit.total();
      const auto part = [&](double v) { return Html(total > 0 ? 100 * v / total : std::nan(""), 2); };
      std::vector<Html> row{escape(nameOf(n.what)), std::string(n.what.unit()), Html(fit.deviation(), 2)};
      for (const double v : fit.variance) row.push_back(part(v));
      row.insert(row.end(), {part(fit.residual * fit.residual), Html(fit.residual, 2), Html(100 * fit.explained, 2),
                             Html(static_cast<int>(fit.runs))});
      rows.push_back(std::move(row));
    }
  }
  if (rows.empty()) return "";
  return htmlTable(
      "What of the fabric\u2019s spread the numbers go with", columns, rows,
      "A straight line through the samples of the fabric: of each of its numbers the share of the variance that "
      "it brings by itself. No single number: what the line leaves, as numbers work together, as the torque "
      "bends with them, or as cloth folds otherwise from run to run.");
}

std::string notesOf(const Study& s, const Comparison& c) {
  const Uncertainty& asked = *s.uncertainty;
  std::string list;
  const auto say = [&](const std::string& text) { list += element("li", escape(text)); };
  std::string spreads;
  for (const StudiedSpread& p : asked.spreads)
    spreads += fmt::format("{}{} {} % ({})", spreads.empty() ? "" : ", ", p.name, formatNumber(100 * p.deviation, 2),
                           p.source);
  if (!spreads.empty())
    say(fmt::format(
        "Standard deviations of the fabric, of their means: {}.{} Samples have multiples whose logarithm is normal; a "
        "thickness takes mass and stiffness in the plane with it, and leaves the rigidity of bending.",
        spreads, asked.source.empty() ? "" : " From: " + asked.source + "."));
  if (!asked.unknown.empty())
    say(fmt::format("No spread is given of {}, by the study or by a card: what it adds is not in the bars.",
                    schema::joined(asked.unknown)));
  if (!asked.step) say("The study does not ask for the error of the time step.");
  for (const Budget& b : c.budgets) {
    const std::string where = settingOf(s, b).empty() ? "" : settingOf(s, b) + ": ";
    if (!b.no_step.empty()) say(fmt::format("{}no bar of the step for some numbers: {}.", where, b.no_step));
    if (!b.no_fabric.empty()) say(fmt::format("{}no bar of the fabric: {}.", where, b.no_fabric));
    if (b.failed > 0 && b.no_fabric.empty())
      say(fmt::format("{}{} of {} samples failed and are left out.", where, b.failed, b.failed + b.samples));
    if (b.mesh_taken_over)
      say(where + "the bar of the mesh is that of the runs that have a finer one beside them, in per cent.");
  }
  say("Not in the bars: what the model leaves out, such as how the body gives way, and how this wearer moves.");
  return element("ul", list, " class=\"assumptions\"");
}

}  // namespace

std::string plusMinus(const Study& s, const Comparison& c, std::size_t variant, const Headline& what) {
  if (s.variants[variant].part != BarPart::none) return "";  // what tells a bar has none
  const auto n = barOf(s, c, variant, what);
  return n && n->bar.combined() ? " \u00b1 " + formatNumber(*n->bar.combined(), 2) : "";
}

std::string sureOf(const Study& s, const Comparison& c) {
  if (c.budgets.empty()) return "";
  std::string advice, sources;
  for (const Budget& b : c.budgets) {
    bool torque = false, pressure = false;
    for (const BarredNumber& n : b.numbers) {
      bool& told = n.what.isTorque() ? torque : pressure;
      if (told || !n.bar.combined() || !(*n.bar.combined() > 0)) continue;
      told = true;
      advice += adviceOf(s, b, n);
      sources += sourcesOf(s, b, n);
    }
  }
  return element("div", element("dl", advice, " class=\"answers\""), " class=\"panel\"") + charts(sources) +
         charts(partsTable(s, c)) + charts(fabricTable(s, c)) + notesOf(s, c);
}

}  // namespace gambeson::study
