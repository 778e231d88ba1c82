#include "analysis/render/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/render/canvas.hpp"
#include "analysis/ticks.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr Color kInk{0.13f, 0.14f, 0.17f}, kSoftInk{0.36f, 0.38f, 0.43f};
constexpr double kLine = 1.35;    ///< of the font's size
constexpr double kSwatch = 1.45;  ///< of the font's size: a square of colour and its gap, before a note

double unitOf(int width, int height) { return std::clamp(std::sqrt(double(width) * height) / 1100, 0.62, 4.0); }
double ease(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

bool hasLegend(const Scene& s) { return !s.arrow_legend.empty() && s.arrow_legend_length_m > 0; }

}  // namespace

Fonts loadFonts(int width, int height) {
  const double u = unitOf(width, height);
  const auto regular = findFont(FontWeight::regular, fontFolders()), bold = findFont(FontWeight::bold, fontFolders());
  return {Font(bold, 27 * u), Font(regular, 19 * u), Font(regular, 16.5 * u)};
}

ColorBar effective(const ColorBar& bar) {
  if (!std::isfinite(bar.low) || !std::isfinite(bar.high) || bar.high < bar.low)
    throw RunError("cannot draw the colour bar \"" + bar.title + "\" from " + formatNumber(bar.low) + " to " +
                   formatNumber(bar.high));
  ColorBar e = bar;
  if (!(e.high > e.low)) e.high = e.low + (e.low == 0 ? 1 : std::abs(e.low));
  return e;
}

namespace {

/// What of its texts a picture shows.
struct Shown {
  bool heading = true, legend = true, bar = true;
};

/// None where the picture has no room beside them.
std::optional<Overlay> layOut(const Scene& scene, const Shot& shot, const Fonts& fonts, int width, int height,
                              const Shown& shown) {
  Overlay o;
  const double u = o.unit = unitOf(width, height), m = o.margin = 34 * u;
  const bool heading = shown.heading && (!scene.title.empty() || !scene.subtitle.empty() || shot.note),
             legend = shown.legend && hasLegend(scene), bar = shown.bar && scene.bar.has_value();
  o.free = {0, 0, double(width), double(height)};
  if (!heading && !legend && !bar) return o;
  o.wide = width > 1.15 * height;
  const double column = o.wide ? 0.30 * width : width - 2 * m;
  if (heading) {
    o.title = fonts.title.wrap(scene.title, column);
    o.subtitle = fonts.text.wrap(scene.subtitle, column);
    if (shot.note) o.note = fonts.text.wrap(shot.note->words, column - kSwatch * fonts.text.size());
  }
  const double title_h = kLine * fonts.title.size() * double(o.title.size()) +
                         kLine * fonts.text.size() * double(o.subtitle.size() + o.note.size()) +
                         (o.title.empty() || o.subtitle.empty() ? 0 : 6 * u) + (o.note.empty() ? 0 : 6 * u);
  o.block_title = {m, m, m + column, m + (heading ? title_h : 0)};

  const double bar_w = o.wide ? column - 20 * u : legend ? 0.56 * column : std::min(column, 620 * u);
  const double ticks_h = 12 * u + fonts.small.size();
  double bottom = height - m;
  const double inset = 16 * u;  // room for the pointed end and half a tick label
  if (bar) {
    o.bar_title = fonts.text.wrap(scene.bar->title, bar_w);
    o.bar = {m + inset, bottom - ticks_h - 18 * u, m + bar_w - inset, bottom - ticks_h};
    if (!(o.bar.width() > 40 * u)) return std::nullopt;
    if (o.wide) bottom = o.bar.top - 14 * u - kLine * fonts.text.size() * double(o.bar_title.size()) - 26 * u;
  }
  const double legend_h = 2.4 * fonts.text.size();
  if (legend) {
    if (o.wide)
      o.legend = {m, bottom - legend_h, m + column, bottom};
    else
      o.legend = {m + 0.64 * column, height - m - legend_h, width - m, height - m};
  }
  // Beside the scene the texts stand above each other: where they would lie over each other there is no room.
  if (o.wide && bar)
    bottom = std::min(bottom, o.bar.top - 14 * u - kLine * fonts.text.size() * double(o.bar_title.size()));
  if (o.wide && legend) bottom = std::min(bottom, o.legend.top);
  if (o.wide && heading && o.block_title.bottom > bottom) return std::nullopt;
  if (o.wide) {
    o.free = {m + column + 0.6 * m, m, width - m, height - m};
  } else {
    const double bar_top = bar ? o.bar.top - 10 * u - kLine * fonts.text.size() * double(o.bar_title.size()) : height;
    const double low = std::min(bar_top, legend ? o.legend.top : height);
    o.free = {m, heading ? o.block_title.bottom + 0.6 * m : m, width - m, (bar || legend) ? low - 0.6 * m : height - m};
  }
  if (!(o.free.width() > 8) || !(o.free.height() > 8)) return std::nullopt;
  return o;
}

}  // namespace

Overlay layOut(const Scene& scene, const Shot& shot, const Fonts& fonts, int width, int height) {
  for (const Shown& shown : {Shown{}, Shown{false, true, true}, Shown{false, false, true}})
    if (const auto o = layOut(scene, shot, fonts, width, height, shown)) return *o;
  return *layOut(scene, shot, fonts, width, height, {false, false, false});
}

float fadeAt(const Overlay& o, double x, double y) {
  const double reach = 0.6 * o.margin + 1;
  if (o.wide) return static_cast<float>(ease((x - (o.free.left - reach)) / (1.6 * reach)));
  double f = 1;
  if (!o.title.empty() || !o.subtitle.empty()) f *= ease((y - (o.free.top - reach)) / (1.6 * reach));
  if (o.bar.width() > 0 || o.legend.width() > 0) f *= ease(((o.free.bottom + reach) - y) / (1.6 * reach));
  return static_cast<float>(f);
}

void drawOverlay(Image& image, const Scene& scene, const Shot& shot, const Overlay& o, const Fonts& fonts,
                 const ColorTable& colors, Beyond beyond) {
  const double u = o.unit;
  double y = o.block_title.top;
  for (const auto& line : o.title) {
    fonts.title.draw(image, o.block_title.left, y + fonts.title.size(), line, kInk);
    y += kLine * fonts.title.size();
  }
  if (!o.title.empty()) y += 6 * u;
  for (const auto& line : o.subtitle) {
    fonts.text.draw(image, o.block_title.left, y + fonts.text.size(), line, kSoftInk);
    y += kLine * fonts.text.size();
  }
  if (!o.note.empty()) {
    y += 6 * u;
    const double side = 0.85 * fonts.text.size(), left = o.block_title.left, top = y + fonts.text.size() - 0.8 * side;
    fillRect(image, left, top, left + side, top + side, shot.note->color);
  }
  for (const auto& line : o.note) {
    fonts.text.draw(image, o.block_title.left + kSwatch * fonts.text.size(), y + fonts.text.size(), line, kSoftInk);
    y += kLine * fonts.text.size();
  }
  if (scene.bar && o.bar.width() > 0) {
    const ColorBar bar = effective(*scene.bar);
    const PixelRect& r = o.bar;
    double line_y = r.top - 14 * u - kLine * fonts.text.size() * (double(o.bar_title.size()) - 1);
    for (const auto& line : o.bar_title) {
      fonts.text.draw(image, o.margin, line_y, line, kInk);
      line_y += kLine * fonts.text.size();
    }
    for (int x = static_cast<int>(std::floor(r.left)); x < r.right; ++x) {
      const double left = std::max(r.left, double(x)), right = std::min(r.right, x + 1.0);
      fillRect(image, left, r.top, right, r.bottom, colorAt(colors, (0.5 * (left + right) - r.left) / r.width()));
    }
    const double tip = 12 * u, half = 0.5 * r.height(), mid = 0.5 * (r.top + r.bottom), gap = 2 * u;
    const auto pointed = [&](double base, double sign, Color color) {
      fillWhere(image, base - tip - 1, r.top, base + tip + 1, r.bottom, color, 1, [&](double px, double py) {
        const double along = sign * (px - base);
        return along >= 0 && std::abs(py - mid) <= half * (1 - along / tip);
      });
    };
    if (beyond.below) pointed(r.left - gap, -1, colors.front());
    if (beyond.above) pointed(r.right + gap, 1, colors.back());
    const auto label = [&](double x, const std::string& words) {
      fonts.small.draw(image, x - 0.5 * fonts.small.width(words), r.bottom + 10 * u + 0.85 * fonts.small.size(), words,
                       kInk);
    };
    const Ticks ticks =
        niceTicks(bar.low, bar.high, std::clamp(static_cast<int>(r.width() / (5.2 * fonts.small.size())), 2, 6));
    for (const double value : ticks.values) {
      const double x = r.left + (value - bar.low) / (bar.high - bar.low) * r.width();
      const double w = std::max(1.0, std::round(1.3 * u)), left = std::round(x - 0.5 * w);
      fillRect(image, left, r.bottom, left + w, r.bottom + 6 * u, kSoftInk);
      // What would run into the mark of an end gives way to it.
      const bool lower = value - bar.low < bar.high - value;
      const double from_end = lower ? value - bar.low : bar.high - value;
      if ((lower ? beyond.below : beyond.above) && from_end < 0.11 * (bar.high - bar.low)) continue;
      label(x, ticks.label(value));
    }
    // The ends say that there is more beyond.
    if (beyond.below) label(r.left, "\u2264 " + formatBrief(bar.low));
    if (beyond.above) label(r.right, "\u2265 " + formatBrief(bar.high));
  }
  if (o.legend.width() > 0)
    fonts.text.draw(image, o.legend.left, o.legend.top + fonts.text.size(), scene.arrow_legend, kInk);
}

}  // namespace gambeson
