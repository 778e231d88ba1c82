#include "analysis/report/xy_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/report/html.hpp"
#include "analysis/ticks.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

using html::escape;

constexpr double kWidth = 500, kPlotHeight = 270, kLeft = 62, kRight = 16, kBottom = 46, kLegendRow = 19;
constexpr std::array<const char*, 5> kTones{"left", "third", "right", "fourth", "fifth"};

std::string text(double x, double y, const std::string& s, const char* anchor, const char* style = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor, style, escape(s));
}

/// A point; lights differ in shape too, for those who do not tell their colours: circle, half circle, triangle, square
/// and cross.
std::string point(PointMark mark, double x, double y) {
  switch (mark) {
    case PointMark::open:
      return fmt::format("<circle class=\"published\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.6\"/>", x, y);
    case PointMark::green:
      return fmt::format("<circle class=\"point green\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\"/>", x, y);
    case PointMark::doubtful:
      return fmt::format(
          "<path class=\"point doubtful\" d=\"M{:.2f} {:.2f}a4 4 0 0 1 0 8z\"/>"
          "<circle class=\"point ring\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\"/>",
          x, y - 4, x, y);
    case PointMark::amber:
      return fmt::format("<path class=\"point amber\" d=\"M{:.2f} {:.2f}l5 9h-10z\"/>", x, y - 5.5);
    case PointMark::red:
      return fmt::format("<path class=\"point red\" d=\"M{:.2f} {:.2f}h8v8h-8z\"/>", x - 4, y - 4);
    case PointMark::unknown:
      return fmt::format("<path class=\"point cross\" d=\"M{:.2f} {:.2f}l8 8m0-8l-8 8\"/>", x - 4, y - 4);
  }
  return "";
}

struct Tick {
  double at = 0;  ///< on the axis: the value, or its logarithm
  std::string label;
};

/// One axis; logarithmic ones work with the logarithm to base 10.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double from = 0, to = 1;                  ///< pixels
  bool logarithmic = false, level = false;  ///< level: its labels stand side by side

  double coordinate(double v) const { return logarithmic ? (v > 0 ? std::log10(v) : std::nan("")) : v; }
  double pixel(double c) const { return from + (c - low) / (high - low) * (to - from); }
  void add(double c) { low = std::min(low, c), high = std::max(high, c); }
  /// Grows on both sides to this length.
  void stretchTo(double length) {
    const double room = 0.5 * (length - (high - low));
    low -= room, high += room;
  }
  void widen() {
    const double room = high > low ? 0.04 * (high - low) : low == 0 || logarithmic ? 0.5 : 0.5 * std::abs(low);
    low -= room, high += room;
  }
  std::vector<Tick> ticks(int target) const {
    std::vector<Tick> all;
    if (!logarithmic) {
      const Ticks t = level ? ticksThatFit(low, high, target, std::abs(to - from), 7.4) : niceTicks(low, high, target);
      for (const double v : t.values) all.push_back({v, t.label(v)});
      return all;
    }
    // Every power of ten, and 2 and 5 times it where there is room for them.
    const bool few = high - low < 2.5;
    for (int e = static_cast<int>(std::floor(low)) - 1; e <= static_cast<int>(std::ceil(high)); ++e)
      for (const int m : {1, 2, 5}) {
        const double c = e + std::log10(m);
        if (c < low || c > high || (m != 1 && !few)) continue;
        all.push_back({c, formatNumber(m * std::pow(10.0, e), 1)});
      }
    if (all.size() > 2) return all;
    // Over less than a decade: round steps of the values.
    all.clear();
    const Ticks t = niceTicks(std::pow(10.0, low), std::pow(10.0, high), target);
    for (const double v : t.values) all.push_back({std::log10(v), t.label(v)});
    return all;
  }
};

std::string legend(const std::vector<XySeries>& series, double& height) {
  std::string out;
  double x = kLeft, y = 12;
  std::size_t tone = 0;
  for (const XySeries& s : series) {
    const double w = 7.4 * static_cast<double>(s.name.size()) + 42;
    if (x > kLeft && x + w > kWidth) x = kLeft, y += kLegendRow;
    if (s.circles)
      out += point(s.mark, x + 10, y - 1);
    else
      out += fmt::format("<line class=\"series {}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                         kTones[tone++ % kTones.size()], x, x + 20, y - 1, y - 1);
    out += text(x + 26, y + 4, s.name, "start");
    x += w;
  }
  height = y + 10;
  return out;
}

/// What is drawn, in a box of kWidth times `height`, without a frame around it; empty where there is nothing to plot.
struct Drawing {
  std::string content;
  double height = 0;
};

Drawing draw(const XyPlot& plot) {
  Axis ax, ay;
  ax.logarithmic = ay.logarithmic = plot.logarithmic;
  ax.level = true;
  for (const XySeries& s : plot.series) {
    if (s.x.size() != s.y.size())
      throw InputError({"", 0, s.name}, fmt::format("{} values of x for {} of y", s.x.size(), s.y.size()));
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const double cx = ax.coordinate(s.x[i]), cy = ay.coordinate(s.y[i]);
      if (std::isfinite(cx) && std::isfinite(cy)) ax.add(cx), ay.add(cy);
    }
  }
  if (!(ax.low <= ax.high)) return {};
  ax.widen();
  ay.widen();

  double top = 0;
  const std::string key = legend(plot.series, top);
  top += 22;  // the name of the ordinate
  const double width = kWidth - kRight - kLeft, bottom = top + (plot.equal ? width : kPlotHeight - kBottom - 22);
  if (plot.equal) {
    const double length = std::max(ax.high - ax.low, ay.high - ay.low);
    ax.stretchTo(length), ay.stretchTo(length);
  }
  ax.from = kLeft, ax.to = kLeft + width;
  ay.from = bottom, ay.to = top;

  std::string svg;
  for (const Tick& t : ay.ticks(5)) {
    const double y = ay.pixel(t.at);
    svg += fmt::format("<line class=\"{}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                       t.at == 0 && !plot.logarithmic ? "zero" : "grid", ax.from, ax.to, y, y);
    svg += text(kLeft - 7, y + 4.5, t.label, "end");
  }
  for (const Tick& t : ax.ticks(6)) {
    const double x = ax.pixel(t.at);
    svg += fmt::format("<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", x, x, top,
                       bottom);
    svg += text(x, bottom + 18, t.label, "middle");
  }
  svg += text(0.5 * (ax.from + ax.to), bottom + 39, plot.x_name, "middle", " class=\"axis\"");
  svg += text(4, top - 9, plot.y_name, "start", " class=\"axis\"");

  std::size_t tone = 0;
  std::string lines, circles;
  for (const XySeries& s : plot.series) {
    std::string d;
    bool pen_down = false;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const double cx = ax.coordinate(s.x[i]), cy = ay.coordinate(s.y[i]);
      if (!std::isfinite(cx) || !std::isfinite(cy)) {
        pen_down = false;
      } else if (s.circles) {
        circles += point(s.mark, ax.pixel(cx), ay.pixel(cy));
      } else {
        d += fmt::format("{}{:.2f} {:.2f}", pen_down ? "L" : "M", ax.pixel(cx), ay.pixel(cy));
        pen_down = true;
      }
    }
    if (!s.circles)
      lines += fmt::format("<path class=\"series {}\" data-name=\"{}\" d=\"{}\"/>", kTones[tone++ % kTones.size()],
                           escape(s.name), d);
  }
  return {svg + lines + circles + key, bottom + kBottom};
}

std::string labelOf(const XyPlot& plot) { return escape(plot.title + ": " + plot.y_name + " over " + plot.x_name); }

/// The look of a page's plots (style.hpp), for a picture that has no page.
constexpr const char* kPictureStyle =
    "text{font:14px system-ui,-apple-system,'Segoe UI','DejaVu Sans',sans-serif;fill:#1b1f27}.axis,.note{fill:#555d6b}"
    ".note{font-size:12px}.title{font-weight:600}.grid{stroke:#e4e7ec}.zero{stroke:#8d95a3}"
    ".series{fill:none;stroke-width:2.2;stroke-linejoin:round}.left{stroke:#1668b0}"
    ".right{stroke:#c04a0f;stroke-dasharray:7 2.5}.third{stroke:#a3246b}.fourth{stroke:#6b4c9a;stroke-dasharray:2 3}"
    ".fifth{stroke:#1b6e3c;stroke-dasharray:9 3 2 3}"
    ".published{fill:#fff;fill-opacity:.75;stroke:#1b1f27;stroke-width:1.3}"
    ".point.green{fill:#1b6e3c}.point.doubtful{fill:#655847}.point.amber{fill:#c98500}.point.red{fill:#a61b1b}"
    ".ring,.cross{fill:none;stroke-width:1.6}.ring{stroke:#655847}.cross{stroke:#1b1f27}";

}  // namespace

std::string xyChart(const XyPlot& plot) {
  const std::string heading = html::element("h3", escape(plot.title));
  const std::string caption = plot.caption.empty() ? "" : html::element("figcaption", escape(plot.caption));
  const Drawing drawing = draw(plot);
  if (drawing.content.empty())
    return html::element("figure", heading + html::notice("There is nothing to plot.") + caption, " class=\"chart\"");
  const std::string frame = fmt::format("<svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"{}\">", kWidth,
                                        drawing.height, labelOf(plot));
  return html::element("figure", heading + frame + drawing.content + "</svg>\n" + caption, " class=\"chart\"");
}

std::string xyPicture(const XyPlot& plot, const std::vector<std::string>& notes) {
  constexpr double kMargin = 14, kHead = 30, kNote = 17;
  const Drawing drawing = draw(plot);
  const double width = kWidth + 2 * kMargin,
               height = kHead + drawing.height + 2 * kMargin + kNote * static_cast<double>(notes.size());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"0 0 {:.0f} {:.0f}\" "
      "role=\"img\" aria-label=\"{}\">\n<style>{}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      1.6 * width, 1.6 * height, width, height, labelOf(plot), kPictureStyle);
  svg += text(kMargin, kHead - 8, plot.title, "start", " class=\"title\"");
  svg += fmt::format("\n<g transform=\"translate({} {})\">{}</g>\n", kMargin, kHead, drawing.content);
  double y = kHead + drawing.height + kMargin;
  for (const std::string& note : notes) svg += text(kMargin, y += kNote, note, "start", " class=\"note\"");
  return svg + "\n</svg>\n";
}

}  // namespace gambeson
