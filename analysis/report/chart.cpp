#include "analysis/report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/report/html.hpp"
#include "analysis/ticks.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

using html::escape;

constexpr double kWidth = 500, kHeight = 300;
constexpr double kLeft = 56, kRight = 14, kTop = 44, kBottom = 46;

const char* nameOf(Tone tone) {
  switch (tone) {
    case Tone::left:
      return "left";
    case Tone::right:
      return "right";
    case Tone::third:
      return "third";
    case Tone::fourth:
      return "fourth";
  }
  return "third";
}

std::string text(double x, double y, const std::string& s, const char* anchor, const char* style = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor, style, escape(s));
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  bool empty() const { return !(low <= high); }
  /// Never of zero width: a constant gets room on both sides.
  void widen() {
    if (high > low) return;
    const double room = low == 0 ? 1 : 0.5 * std::abs(low);
    low -= room, high += room;
  }
};

struct Frame {
  Range t, v;
  double x(double time) const { return kLeft + (time - t.low) / (t.high - t.low) * (kWidth - kLeft - kRight); }
  double y(double value) const {
    return kHeight - kBottom - (value - v.low) / (v.high - v.low) * (kHeight - kTop - kBottom);
  }
};

bool drawn(const Series& s, std::size_t i) { return std::isfinite(s.time_s[i]) && std::isfinite(s.values[i]); }

std::string axes(const Frame& f, const std::string& unit) {
  std::string out;
  const Ticks xs = ticksThatFit(f.t.low, f.t.high, 6, kWidth - kLeft - kRight, 7.4),
              ys = niceTicks(f.v.low, f.v.high, 5);
  for (const double v : ys.values) {
    out += fmt::format("<line class=\"{}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                       v == 0 ? "zero" : "grid", kLeft, kWidth - kRight, f.y(v), f.y(v));
    out += text(kLeft - 7, f.y(v) + 4.5, ys.label(v), "end");
  }
  for (const double v : xs.values) {
    out += fmt::format("<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", f.x(v), f.x(v),
                       kTop, kHeight - kBottom);
    out += text(f.x(v), kHeight - kBottom + 18, xs.label(v), "middle");
  }
  out += text(0.5 * (kLeft + kWidth - kRight), kHeight - 7, "time [s]", "middle", " class=\"axis\"");
  out += text(4, 15, "[" + unit + "]", "start", " class=\"axis\"");
  return out;
}

std::string path(const Series& s, const Frame& f) {
  std::string d;
  bool pen_down = false;
  for (std::size_t i = 0; i < s.values.size(); ++i) {
    if (!drawn(s, i)) {
      pen_down = false;
      continue;
    }
    d += fmt::format("{}{:.2f} {:.2f}", pen_down ? "L" : "M", f.x(s.time_s[i]), f.y(s.values[i]));
    pen_down = true;
  }
  return fmt::format("<path class=\"series {}\" data-name=\"{}\" d=\"{}\"/>", nameOf(s.tone), escape(s.name), d);
}

/// The place of the largest magnitude: series and index.
std::pair<std::size_t, std::size_t> peakOf(const std::vector<const Series*>& series, double from_s,
                                           const std::string& of) {
  std::pair<std::size_t, std::size_t> best{0, 0};
  double most = -1;
  const bool one = std::any_of(series.begin(), series.end(), [&](const Series* s) { return s->name == of; });
  for (std::size_t k = 0; k < series.size(); ++k)
    for (std::size_t i = 0; i < series[k]->values.size(); ++i)
      if ((!one || series[k]->name == of) && drawn(*series[k], i) && series[k]->time_s[i] >= from_s &&
          std::abs(series[k]->values[i]) > most)
        most = std::abs(series[k]->values[i]), best = {k, i};
  return best;
}

std::string peakMark(const Series& s, std::size_t i, const Frame& f, const std::string& note) {
  const double x = f.x(s.time_s[i]), y = f.y(s.values[i]);
  const std::string label = "peak " + formatNumber(s.values[i]) + " " + s.unit + " at " + html::seconds(s.time_s[i]) +
                            (note.empty() ? "" : ", " + note);
  // Where the middle of it would run over an end of the axis, it stands beside that end.
  const double half = std::min(4.4 * static_cast<double>(label.size()), 0.5 * (kWidth - kRight - kLeft));
  const double at = std::clamp(x, kLeft + half, kWidth - kRight - half);
  return fmt::format("<circle class=\"peak {}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"5\" data-time=\"{:.9g}\"/>",
                     nameOf(s.tone), x, y, s.time_s[i]) +
         text(at, s.values[i] >= 0 ? y - 11 : y + 22, label, "middle", " class=\"peak-label\"");
}

/// The start that is not judged.
std::string uncounted(double until_s, const Frame& f) {
  const double width = f.x(until_s) - kLeft;
  return fmt::format("<rect class=\"uncounted\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", kLeft,
                     kTop, width, kHeight - kBottom - kTop);
}

/// Its name: over the lines, and at the top where the peak is below 0, so that its label is at the bottom.
std::string uncountedLabel(double until_s, bool at_top, const Frame& f) {
  const double width = f.x(until_s) - kLeft;
  if (!(width > 72)) return "";
  return text(kLeft + 0.5 * width, at_top ? kTop + 14 : kHeight - kBottom - 6, "not counted", "middle",
              " class=\"uncounted-label\"");
}

/// Rows of lines with their names, the last at the top of the plot and the others above it; a name starts where its
/// line ends, however wide the letters of the reader's font are.
std::string legend(const std::vector<const Series*>& series, double& above) {
  constexpr double line = 20, gap = 6, between = 14, letter = 8.2, row_height = 19, left = kLeft + 10;
  const auto width = [&](const Series* s) { return line + gap + letter * static_cast<double>(s->name.size()); };
  std::vector<std::vector<const Series*>> rows;
  double used = 0;
  for (const Series* s : series) {
    if (rows.empty() || left + used + between + width(s) > kWidth - kRight) rows.emplace_back(), used = -between;
    rows.back().push_back(s);
    used += between + width(s);
  }
  std::string out;
  above = row_height * static_cast<double>(std::max<std::size_t>(rows.size(), 1) - 1);
  double y = 15 - above;
  for (const auto& row : rows) {
    double x = kWidth - kRight + between;
    for (const Series* s : row) x -= between + width(s);
    x = std::max(x, left);
    for (const Series* s : row) {
      out += fmt::format("<line class=\"series {}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                         nameOf(s->tone), x, x + line, y - 4.5, y - 4.5);
      out += text(x + line + gap, y, s->name, "start");
      x += width(s) + between;
    }
    y += row_height;
  }
  return out;
}

std::string figure(const std::string& title, const std::string& body, const std::string& caption) {
  return html::element(
      "figure",
      html::element("h3", escape(title)) + body + (caption.empty() ? "" : html::element("figcaption", escape(caption))),
      " class=\"chart\"");
}

}  // namespace

std::string lineChart(const Plot& plot) {
  std::vector<const Series*> shown;
  std::string notices;
  Frame f;
  for (const Series& s : plot.series) {
    if (s.time_s.size() != s.values.size())
      throw InputError({"", 0, s.name}, fmt::format("{} times for {} values", s.time_s.size(), s.values.size()));
    std::size_t good = 0;
    for (std::size_t i = 0; i < s.values.size(); ++i)
      if (drawn(s, i)) ++good, f.t.add(s.time_s[i]), f.v.add(s.values[i]);
    if (good > 0) shown.push_back(&s);
    if (s.values.empty())
      notices += html::notice("No values of " + s.name + " were recorded.");
    else if (good == 0)
      notices += html::notice("None of the " + std::to_string(s.values.size()) + " values of " + s.name +
                              " is a finite number.");
    else if (good < s.values.size() && !s.gaps)
      notices += html::notice(fmt::format("{} of the {} values of {} are not finite numbers and are left out.",
                                          s.values.size() - good, s.values.size(), s.name));
  }
  if (shown.empty())
    return figure(plot.title, notices.empty() ? html::notice("There is nothing to plot.") : notices, plot.caption);

  f.t.widen();
  f.v.add(0);
  f.v.widen();
  const double room = 0.15 * (f.v.high - f.v.low);
  if (f.v.high > 0) f.v.high += room;
  if (f.v.low < 0) f.v.low -= room;

  const auto [k, i] = peakOf(shown, plot.mark_from_s, plot.mark_of);
  const std::string peak = fmt::format("{} {} at {} ({})", formatNumber(shown[k]->values[i]), shown[k]->unit,
                                       html::seconds(shown[k]->time_s[i]), shown[k]->name);
  double above = 0;
  const std::string key = legend(shown, above);
  std::string svg = fmt::format(
      "<svg viewBox=\"0 {:g} {} {:g}\" role=\"img\" aria-label=\"{}\" data-time=\"s\" data-frame=\"{} {} {} {} {:.9g} "
      "{:.9g} {:.9g} "
      "{:.9g}\" data-unit=\"{}\">",
      -above, kWidth, kHeight + above, escape(plot.title + " over time. Largest magnitude: " + peak + "."), kLeft,
      kWidth - kRight, kHeight - kBottom, kTop, f.t.low, f.t.high, f.v.low, f.v.high, escape(shown[0]->unit));
  const bool starts_later = plot.mark_from_s > f.t.low && plot.mark_from_s < f.t.high;
  if (starts_later) svg += uncounted(plot.mark_from_s, f);
  svg += axes(f, shown[0]->unit);
  for (const TimeMark& m : plot.marks) {
    if (!(m.time_s >= f.t.low && m.time_s <= f.t.high)) continue;
    const double x = f.x(m.time_s);
    svg += fmt::format("<line class=\"mark\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", x, x, kTop - 6,
                       kHeight - kBottom);
    const bool late = x > kWidth - 90;
    svg += text(late ? x - 3 : x + 3, kTop - 6, m.label, late ? "end" : "start", " class=\"mark-label\"");
  }
  for (const Series* s : shown) svg += path(*s, f);
  if (starts_later) svg += uncountedLabel(plot.mark_from_s, plot.mark_peak && shown[k]->values[i] < 0, f);
  if (plot.mark_peak) svg += peakMark(*shown[k], i, f, plot.peak_note);
  svg += key + "</svg>\n";
  std::string caption = plot.caption;
  if (starts_later)
    caption += fmt::format("{}Counted is what comes from {} on; the shaded start before it is shown but not judged.",
                           caption.empty() ? "" : " ", html::seconds(plot.mark_from_s));
  return figure(plot.title, svg + notices, caption);
}

std::string barChart(const BarChart& chart) {
  if (chart.bars.empty()) return figure(chart.title, html::notice("There is nothing to plot."), chart.caption);
  double most = 0;
  for (const Bar& b : chart.bars)
    if (std::isfinite(b.value)) most = std::max(most, b.value);
  constexpr double row = 26, label = 150, number = 76;
  const double height = row * static_cast<double>(chart.bars.size()) + 6;
  std::string spoken;
  for (const Bar& b : chart.bars) spoken += fmt::format(" {}: {} {}.", b.label, formatNumber(b.value), chart.unit);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kWidth, height,
                                escape(chart.title + "." + spoken));
  double y = 3;
  for (const Bar& b : chart.bars) {
    const double w = most > 0 && b.value > 0 && std::isfinite(b.value) ? b.value / most * (kWidth - label - number) : 0;
    svg += text(label - 8, y + 17, b.label, "end");
    svg += fmt::format("<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\" rx=\"2\"/>",
                       label, y + 4, w, row - 8);
    svg += text(label + w + 6, y + 17, formatNumber(b.value) + " " + chart.unit, "start", " class=\"value\"");
    y += row;
  }
  return figure(chart.title, svg + "</svg>\n", chart.caption);
}

}  // namespace gambeson
