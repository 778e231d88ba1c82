/// Detail of verify.hpp: the page: what passed, at a glance, then every reference with its plot, its convergence and
/// its numbers.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/html.hpp"
#include "analysis/report/style.hpp"
#include "analysis/report/xy_chart.hpp"
#include "analysis/ticks.hpp"
#include "cases/runs/progress.hpp"
#include "cases/verify/verify.hpp"

namespace gambeson::verify {
namespace {

using html::element;
using html::escape;

constexpr const char* kVerifyStyle = R"css(
.tiles { display:flex; flex-wrap:wrap; gap:14px; margin:18px 0 0; }
.tile { background:var(--paper); border:1px solid var(--line); border-radius:10px; padding:12px 20px; }
.tile b { display:block; font-size:1.9rem; line-height:1.15; } .tile.good b { color:var(--good); } .tile.bad b { color:var(--bad); }
.tile span { color:var(--soft); font-size:.95rem; font-weight:400; white-space:nowrap; }
section.reference { border-top:1px solid var(--line); margin-top:36px; } section.reference h3.title { font-size:1.15rem; margin:18px 0 4px; }
.source { color:var(--soft); font-size:.92rem; margin:2px 0; } .doc { max-width:80ch; margin:8px 0; }
.soft { color:var(--soft); } .meter { display:inline-block; width:90px; height:9px; background:#e8ebf0; border-radius:5px; overflow:hidden; vertical-align:middle; margin-right:8px; }
.meter i { display:block; height:100%; background:var(--good); } .meter.over i { background:var(--bad); } .meter.free i { background:#8d95a3; }
details { margin-top:12px; } summary { cursor:pointer; color:var(--accent); }
.charts figure.chart:only-child { max-width:560px; }
.panel { margin-top:14px; } th.heading { padding-top:18px; color:var(--accent); } a { color:var(--accent); }
)css";

std::string cell(const std::string& content, bool number = false) {
  return element("td", content, number ? " class=\"number\"" : "");
}
std::string head(const std::vector<std::string>& names, std::size_t texts) {
  std::string row;
  for (std::size_t i = 0; i < names.size(); ++i)
    row += element("th", escape(names[i]), i < texts ? "" : " class=\"number\"");
  return element("thead", element("tr", row));
}
std::string numberText(const std::optional<double>& v, int digits = 6, const std::string& otherwise = "none") {
  return v ? formatNumber(*v, digits) : otherwise;
}

std::string verdict(const Result& r) {
  if (!r.gated) return r.passed ? "<span class=\"soft\">reported</span>" : "<span class=\"soft\">reported, off</span>";
  return r.passed ? "<span class=\"good\">passed</span>" : "<span class=\"bad\">FAILED</span>";
}

/// Deviation over tolerance; nothing where there is no tolerance or no number.
std::optional<double> used(const Result& r) {
  if (!r.measured || !r.reference || !r.tolerance || !(*r.tolerance > 0)) return std::nullopt;
  return std::abs(*r.measured - *r.reference) / *r.tolerance;
}

std::string meter(const Result& r) {
  const std::optional<double> u = used(r);
  if (!u) return "";
  return fmt::format("<span class=\"meter{}\"><i style=\"width:{:.0f}%\"></i></span>{} %",
                     !r.gated ? " free"
                     : *u > 1 ? " over"
                              : "",
                     100 * std::min(1.0, *u), formatNumber(100 * *u, 2));
}

std::string resultTable(const Verified& v) {
  std::string rows;
  for (const Result& r : v.results()) {
    if (r.other_run) continue;
    std::string what = escape(r.quantity);
    if (!r.item.empty())
      what = element("b", escape(r.item)) + (r.priority.empty() ? "" : " (" + escape(r.priority) + ")") + ": " + what;
    if (!r.note.empty()) what += "<br><span class=\"soft\">" + escape(r.note) + "</span>";
    if (!r.why.empty() && r.why != v.reference.why)
      what += "<br><span class=\"soft\">Reported only: " + escape(r.why) + "</span>";
    const std::string none = r.gated ? "none" : "";  // to be compared with
    rows += element("tr", cell(verdict(r)) + cell(what) + cell(escape(r.unit)) + cell(numberText(r.measured), true) +
                              cell(numberText(r.reference, 6, none), true) +
                              cell(numberText(r.tolerance, 2, none), true) + cell(meter(r), true));
  }
  return element(
      "div",
      element(
          "table",
          head({"", "quantity", "unit", "measured", "reference", "tolerance", "deviation, part of the tolerance"}, 3) +
              element("tbody", rows)),
      " class=\"panel scroll\"");
}

std::string convergenceTable(const Judged& j, const Check& c) {
  if (j.convergence.size() < 2) return "";
  std::string rows;
  for (std::size_t i = 0; i < j.convergence.size(); ++i) {
    const auto& [run, value] = j.convergence[i];
    const std::string change = i == 0 ? "" : formatNumber(value - j.convergence[i - 1].second, 2);
    const std::optional<double> goal = c.kind == Check::Kind::rate ? c.exact : c.reference;
    rows += element("tr", cell(escape(run)) + cell(formatNumber(value, 7), true) + cell(change, true) +
                              cell(goal ? formatNumber(value - *goal, 2) : "", true));
  }
  const bool deviation = c.kind == Check::Kind::curve || c.kind == Check::Kind::table;
  return element(
      "div",
      element("table",
              element("caption", "Mesh convergence: " + escape(c.quantity)) +
                  head({"run", deviation ? "largest deviation" : "measured", "change", "less the reference"}, 1) +
                  element("tbody", rows)),
      " class=\"panel scroll\"");
}

std::string rowTable(const Shown& s) {
  if (s.rows.empty()) return "";
  std::string rows;
  for (const Shown::Row& r : s.rows)
    rows += element("tr", cell(formatNumber(r.x, 6), true) + cell(formatNumber(r.y, 6), true) +
                              cell(formatNumber(r.measured_x, 6), true) + cell(formatNumber(r.measured_y, 6), true) +
                              cell(formatNumber(100 * r.deviation, 3) + " %", true) +
                              cell(r.gated ? "" : "<span class=\"soft\">reported</span>"));
  const std::string table =
      element("table", head({s.x_name, s.y_name, "measured " + s.x_name, "measured " + s.y_name, "deviation", ""}, 0) +
                           element("tbody", rows));
  return element("details",
                 element("summary", escape("All rows: " + s.title)) + element("div", table, " class=\"panel scroll\""));
}

std::string chart(const Shown& s, const Check& c) {
  XyPlot plot;
  plot.title = s.title;
  plot.x_name = s.x_name;
  plot.y_name = s.y_name;
  plot.logarithmic = s.logarithmic;
  for (const Shown::Line& line : s.measured) plot.series.push_back({line.name, line.x, line.y, false});
  if (!s.reference.x.empty()) plot.series.push_back({s.reference.name, s.reference.x, s.reference.y, !s.logarithmic});
  if (c.reported)
    plot.caption = fmt::format("Rows {} to {} of {} are shown and not gated.", c.reported->from, c.reported->to,
                               c.reported->column);
  return xyChart(plot);
}

std::string reproduce(const Verified& v) {
  std::string list;
  for (std::size_t i = 0; i < v.outcomes.size(); ++i) {
    const Outcome& o = v.outcomes[i];
    list += element("li", escape(v.reference.runs[i].name) + ": " +
                              (o.why.empty() ? "" : "<span class=\"bad\">failed</span>: " + escape(o.why) + ", ") +
                              escape(formatNumber(o.seconds, 2)) + " s, <span class=\"soft\">" +
                              escape(o.folder.string()) + "</span>");
  }
  return element("details", element("summary", "Runs and their results") + element("ul", list));
}

std::string statusOf(const Verified& v) {
  if (!v.passed()) return "<span class=\"bad\">FAILED</span>";
  return v.gates() ? "<span class=\"good\">passed</span>" : "<span class=\"soft\">gates nothing</span>";
}

/// At the top: what cannot fail here.
std::string reportsOnly(const std::vector<Verified>& all) {
  std::string list;
  for (const Verified& v : all) {
    if (v.gates()) continue;
    int off = 0, reported = 0;
    for (const Result& r : v.results())
      if (!r.other_run) ++reported, off += !r.passed;
    list += element("li", fmt::format("<a href=\"#{}\">{}</a>: {} of {} numbers are off{}", escape(v.reference.id),
                                      escape(v.reference.title), off, reported,
                                      v.reference.why.empty() ? "" : ". " + escape(v.reference.why)));
  }
  if (list.empty()) return "";
  return element("div",
                 element("p",
                         "These references gate nothing: their numbers are shown, and none of them can fail this "
                         "page, however far off it is.") +
                     element("ul", list),
                 " class=\"alarm\" role=\"alert\"");
}

std::string pageSection(const Verified& v) {
  std::string charts, tables, rows;
  for (std::size_t i = 0; i < v.judged.size(); ++i) {
    const Judged& j = v.judged[i];
    const Check& c = v.reference.checks[i];
    if (j.shown && !j.shown->measured.empty()) charts += chart(*j.shown, c);
    tables += convergenceTable(j, c);
    if (j.shown) rows += rowTable(*j.shown);
  }
  return element("section",
                 element("h3", escape(v.reference.title) + " " + statusOf(v), " class=\"title\"") +
                     element("p", escape("Source: " + v.reference.source), " class=\"source\"") +
                     element("p", escape(v.reference.doc), " class=\"doc\"") +
                     (v.reference.why.empty()
                          ? ""
                          : element("p", escape("What is reported only: " + v.reference.why), " class=\"doc\"")) +
                     resultTable(v) + (charts.empty() ? "" : element("div", charts, " class=\"charts\"")) + tables +
                     rows + reproduce(v),
                 fmt::format(" class=\"reference\" id=\"{}\"", escape(v.reference.id)));
}

std::string overview(const std::vector<Verified>& all, const std::vector<std::string>& headings) {
  std::string rows;
  for (const std::string& heading : headings) {
    rows += element("tr",
                    element("th", escape(heading.empty() ? "References" : heading), " colspan=\"6\" class=\"group\""));
    for (const Verified& v : all) {
      if (v.reference.heading != heading) continue;
      int gated = 0, good = 0, reported = 0;
      bool missing = false;
      const std::vector<Result> results = v.results();
      const Result* worst = nullptr;
      for (const Result& r : results) {
        gated += r.gated, good += r.gated && r.passed, reported += !r.gated && !r.other_run;
        missing = missing || (r.gated && !r.measured);
        if (r.gated && used(r) && (!worst || *used(r) > *used(*worst))) worst = &r;
      }
      rows += element(
          "tr", cell(statusOf(v)) +
                    cell(fmt::format("<a href=\"#{}\">{}</a>", escape(v.reference.id), escape(v.reference.title))) +
                    cell(gated ? fmt::format("{} of {}", good, gated) : "none is gated", true) +
                    cell(reported ? fmt::format("{}", reported) : "", true) +
                    cell(missing ? "<span class=\"bad\">no number</span>"
                         : worst ? meter(*worst)
                                 : "",
                         true) +
                    cell(formatNumber(v.seconds, 2) + " s", true));
    }
  }
  return element("div",
                 element("table", head({"", "reference", "checks passed", "reported",
                                        "largest deviation, part of the tolerance", "computing"},
                                       2) +
                                      element("tbody", rows)),
                 " class=\"panel scroll\"");
}

std::string tile(const std::string& kind, int count, const std::string& what) {
  return element("div", element("b", fmt::format("{}", count)) + element("span", escape(what)),
                 " class=\"tile " + kind + "\"");
}

}  // namespace

std::string formatPage(const std::vector<Verified>& all, const std::string& command, double wall_s,
                       const std::vector<PageLink>& pages) {
  int passed = 0, failed = 0, checks = 0, checks_failed = 0, reported = 0;
  std::vector<std::string> headings;
  for (const Verified& v : all) {
    passed += v.gates() && v.passed();
    failed += !v.passed();
    for (const Result& r : v.results())
      checks += r.gated, checks_failed += r.gated && !r.passed, reported += !r.gated && !r.other_run;
    if (std::find(headings.begin(), headings.end(), v.reference.heading) == headings.end())
      headings.push_back(v.reference.heading);
  }
  std::string body =
      reportsOnly(all) +
      element("div",
              tile("good", passed, "references passed") + tile(failed ? "bad" : "", failed, "references failed") +
                  tile("", checks, "gated checks") + tile(checks_failed ? "bad" : "", checks_failed, "of them failed") +
                  tile("", reported, "numbers reported, not gated"),
              " class=\"tiles\"");
  for (const PageLink& p : pages)
    body += element("p", fmt::format("<a href=\"{}\">{}</a>", escape(p.file), escape(p.title)), " class=\"doc\"");
  body += overview(all, headings);
  for (const std::string& g : headings) {
    body += element("h2", escape(g.empty() ? "References" : g));
    for (const Verified& v : all)
      if (v.reference.heading == g) body += pageSection(v);
  }
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<title>Gambeson against published references</title>\n<style>" +
         std::string(report::kStyle) + kVerifyStyle + "</style></head>\n<body>\n" +
         element("header",
                 element("h1", "Gambeson against published references") +
                     element("p",
                             "Every number here comes from runs of the command itself. Measured, reference and "
                             "tolerance stand side by side; a deviation of 100 % of the tolerance is the most "
                             "that passes. Circles are published points, lines are this program's."),
                 " class=\"page\"") +
         element("main", body) +
         element("footer", element("main", escape(fmt::format("Written by gambeson {}: {}, in {}.", GAMBESON_VERSION,
                                                              command, durationText(wall_s))))) +
         "</body></html>\n";
}

}  // namespace gambeson::verify
