#include "cases/pattern/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/pattern/seam_text.hpp"
#include "cases/pattern/svg_path.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

using svg::Frame;

constexpr double kMargin_mm = 15, kGap_mm = 22, kHead_mm = 40, kLine_mm = 6.4, kText_mm = 3.8;

/// A panel on the page.
struct Sheet {
  const Panel* panel;
  Frame frame;
  double width_mm, height_mm;
};

/// Side by side in rows, on a page that is about as wide as it is high.
std::vector<Sheet> laidOut(const FlatPattern& pattern, double& width_mm, double& height_mm) {
  std::vector<Sheet> out;
  double area = 0, widest = 240;
  for (const Panel& p : pattern.panels) {
    PanelBox box = boxOf(p.outline);
    if (!p.cut_line.empty()) {
      const PanelBox cut = boxOf(p.cut_line);
      box.low = {std::min(box.low.x, cut.low.x), std::min(box.low.y, cut.low.y)};
      box.high = {std::max(box.high.x, cut.high.x), std::max(box.high.y, cut.high.y)};
    }
    const double w = 1000 * (box.high.x - box.low.x), h = 1000 * (box.high.y - box.low.y);
    out.push_back({&p, {box.low, box.high.y, {0, 0}}, w, h});
    area += (w + kGap_mm) * (h + kGap_mm);
    widest = std::max(widest, w);
  }
  const double page = std::max(widest, 1.25 * std::sqrt(area));
  // The highest first, those about as high in the order of the file: rows without holes, pairs side by side.
  std::vector<std::size_t> order(out.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::floor(out[a].height_mm / 40) > std::floor(out[b].height_mm / 40);
  });
  double x = 0, y = kMargin_mm + kHead_mm, row = 0;
  width_mm = 0;
  for (const std::size_t k : order) {
    Sheet& s = out[k];
    if (x > 0 && x + s.width_mm > page) {
      y += row + kGap_mm;
      x = row = 0;
    }
    s.frame.corner_mm = {kMargin_mm + x, y};
    x += s.width_mm + kGap_mm;
    row = std::max(row, s.height_mm);
    width_mm = std::max(width_mm, x - kGap_mm);
  }
  width_mm = std::max(width_mm, 240.0) + 2 * kMargin_mm;
  height_mm = y + row + kMargin_mm;
  return out;
}

class Drawing {
 public:
  explicit Drawing(const FlatPattern& pattern) : pattern_(pattern) {}

  std::string draw() {
    sheets_ = laidOut(pattern_, width_, height_);
    for (std::size_t k = 0; k < sheets_.size(); ++k) cloth(sheets_[k]);
    for (std::size_t k = 0; k < pattern_.seams.size(); ++k) seam(k);
    for (const Sheet& s : sheets_) marks(s);
    for (const Sheet& s : sheets_) numbers(s);
    for (std::size_t k = 0; k < pattern_.seams.size(); ++k) seamNames(k);
    for (const Sheet& s : sheets_) label(s);
    list();
    head();
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n"
        "<title>{2}</title>\n<style>\n{3}</style>\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"#ffffff\"/>\n{4}</svg>\n",
        svg::number(width_), svg::number(height_), svg::escaped(pattern_.name), kStyle, out_);
  }

 private:
  static constexpr const char* kStyle =
      "text { font-family: 'DejaVu Sans', Helvetica, Arial, sans-serif; fill: #26262b; }\n"
      ".cloth { fill: #f6f2e9; stroke: none; fill-rule: evenodd; }\n"
      ".allowance { fill: #fdfbf6; stroke: #26262b; stroke-width: 0.35; fill-rule: evenodd; }\n"
      ".edge { fill: none; stroke: #26262b; stroke-width: 0.35; stroke-linejoin: round; }\n"
      ".sewline { stroke-dasharray: 3 1.5; }\n"
      ".seam { fill: none; stroke-width: 1.9; stroke-linecap: butt; stroke-linejoin: round; }\n"
      ".proposed { stroke-dasharray: 5 2.5; }\n"
      ".mark { fill: none; stroke: #26262b; stroke-width: 0.35; }\n"
      ".internal { fill: none; stroke: #7a7468; stroke-width: 0.3; stroke-dasharray: 2 1.2; }\n"
      ".grain { stroke: #26262b; stroke-width: 0.35; fill: #26262b; }\n"
      ".assumed { stroke: #a39c8c; fill: #a39c8c; stroke-dasharray: 3 2; }\n"
      ".halo { paint-order: stroke; stroke: #f6f2e9; stroke-width: 1.1; stroke-linejoin: round; }\n"
      ".small { fill: #7a7468; }\n";

  void add(const std::string& text) { out_ += text + "\n"; }
  void path(const std::string& kind, const std::string& d, const std::string& more = "") {
    add("<path class=\"" + kind + "\" d=\"" + d + "\"" + more + "/>");
  }
  void text(Vec2 at, double size, const std::string& words, const std::string& kind = "",
            const std::string& more = "") {
    add(fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{}>{}</text>", svg::number(at.x), svg::number(at.y),
                    svg::number(size), kind.empty() ? "" : " class=\"" + kind + "\"", more, svg::escaped(words)));
  }

  void cloth(const Sheet& s) {
    std::string holes;
    for (const PanelLoop& c : s.panel->cutouts) holes.append(" ").append(svg::closedPath(s.frame, c));
    if (!s.panel->cut_line.empty()) path("allowance", svg::closedPath(s.frame, s.panel->cut_line) + holes);
    path("cloth", svg::closedPath(s.frame, s.panel->outline) + holes);
  }

  /// Point and direction (a unit vector of the page, to the left of the edge, where the cloth is) at a part's fraction.
  struct Spot {
    Vec2 at, inward;
  };
  Spot spot(const Sheet& s, int edge, double fraction) const {
    const CurvePoint c = MeasuredCurve(curveOf(*s.panel, edge)).at(fraction);
    return {s.frame.at(c.point), {-c.tangent.y, -c.tangent.x}};
  }
  static Vec2 moved(const Spot& s, double mm) { return {s.at.x + mm * s.inward.x, s.at.y + mm * s.inward.y}; }

  void seam(std::size_t k) {
    const PanelSeam& seam = pattern_.seams[k];
    const std::string more = " stroke=\"" + svg::colour(k) + "\"";
    for (const auto* side : {&seam.a, &seam.b})
      for (const SeamPart& part : *side) {
        const Sheet& s = sheets_[static_cast<std::size_t>(part.panel)];
        const PanelEdge& e = edgeOf(*s.panel, part.edge);
        std::string d = svg::to("M ", s.frame.at(e.start_m)) + svg::along(s.frame, e, edgeEnd(*s.panel, part.edge));
        if (std::min(part.from, part.to) > 0 || std::max(part.from, part.to) < 1) {
          const MeasuredCurve curve(curveOf(*s.panel, part.edge));
          std::vector<Vec2> points;
          for (int i = 0; i <= 64; ++i) points.push_back(curve.at(part.from + (part.to - part.from) * i / 64).point);
          d = svg::polyline(s.frame, points, false);
        }
        path(seam.proposed ? "seam proposed" : "seam", d, more);
      }
  }

  void seamNames(std::size_t k) {
    const PanelSeam& seam = pattern_.seams[k];
    for (const auto* side : {&seam.a, &seam.b}) {
      for (std::size_t i = 0; i < side->size(); ++i) {
        const SeamPart& part = (*side)[i];
        const Sheet& s = sheets_[static_cast<std::size_t>(part.panel)];
        const double size = sizeBeside(*s.panel, part.edge);
        const Spot middle = spot(s, part.edge, 0.5 * (part.from + part.to));
        const Vec2 at = moved(middle, 2.6 * size + 1.4);
        text({at.x, at.y + 0.36 * size}, size, seam.name, "halo",
             " text-anchor=\"middle\" font-weight=\"bold\" style=\"fill: " + svg::colour(k) + "\"");
        if (i > 0) continue;
        const double inset = std::min(0.12, 4e-3 / std::max(1e-3, lengthOf(*s.panel, part.edge)));
        const Vec2 dot = moved(spot(s, part.edge, part.from + (part.to - part.from) * inset), 2.2);
        add(fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"0.9\" fill=\"{}\"/>", svg::number(dot.x), svg::number(dot.y),
                        svg::colour(k)));
      }
    }
  }

  static double sizeBeside(const Panel& panel, int edge) { return std::clamp(120 * lengthOf(panel, edge), 1.8, 5.5); }

  void marks(const Sheet& s) {
    const Panel& p = *s.panel;
    for (int e = 0; e < edgeCount(p); ++e) {
      const PanelEdge& edge = edgeOf(p, e);
      path(p.cut_line.empty() ? "edge" : "edge sewline",
           svg::to("M ", s.frame.at(edge.start_m)) + svg::along(s.frame, edge, edgeEnd(p, e)));
    }
    for (const InternalLine& l : p.lines) {
      if (l.points_m.size() == 1) {
        const Vec2 c = s.frame.at(l.points_m.front());
        path("mark", fmt::format("M {} {} h 6 m -3 -3 v 6", svg::number(c.x - 3), svg::number(c.y)));
        add(fmt::format("<circle class=\"mark\" cx=\"{}\" cy=\"{}\" r=\"1.6\"/>", svg::number(c.x), svg::number(c.y)));
      } else {
        path("internal", svg::polyline(s.frame, l.points_m, l.closed));
      }
    }
    for (const Notch& n : p.notches) notch(s, n);
    for (const Annotation& a : p.annotations) text(s.frame.at(a.at_m), 3.2, a.text, "small");
    grain(s);
  }

  void notch(const Sheet& s, const Notch& n) {
    const Spot spot = this->spot(s, n.edge, n.at);
    const double depth = n.depth_m > 0 ? 1000 * n.depth_m : 5;
    const Vec2 tip = moved(spot, depth), across{-spot.inward.y, spot.inward.x};
    const auto beside = [&](Vec2 p, double mm) { return Vec2{p.x + mm * across.x, p.y + mm * across.y}; };
    const auto line = [&](const std::vector<Vec2>& points) {
      std::string d;
      for (std::size_t k = 0; k < points.size(); ++k) d += svg::to(k == 0 ? "M " : " L ", points[k]);
      path("mark", d);
    };
    switch (n.kind) {
      case NotchKind::slit:
        return line({spot.at, tip});
      case NotchKind::v:
        return line({beside(spot.at, -2), tip, beside(spot.at, 2)});
      case NotchKind::t:
        line({spot.at, tip});
        return line({beside(tip, -2), beside(tip, 2)});
      case NotchKind::check:
        return line({spot.at, tip, beside(spot.at, 2)});
      case NotchKind::castle:
      case NotchKind::u:
        return line({beside(spot.at, -2), beside(tip, -2), beside(tip, 2), beside(spot.at, 2)});
    }
  }

  /// Grain lines may be longer than their panels: drawn as far as the panel's box goes, about the line's middle.
  static std::pair<Vec2, Vec2> drawnWithin(const Sheet& s, const GrainLine& line) {
    const Vec2 middle{0.5 * (line.from_m.x + line.to_m.x), 0.5 * (line.from_m.y + line.to_m.y)};
    const Vec2 half{0.5 * (line.to_m.x - line.from_m.x), 0.5 * (line.to_m.y - line.from_m.y)};
    const Vec2 low = s.frame.low_m, high{low.x + 1e-3 * s.width_mm, s.frame.top_m};
    double part = 1;
    for (const auto& [m, h, l, u] :
         {std::array{middle.x, std::abs(half.x), low.x, high.x}, std::array{middle.y, std::abs(half.y), low.y, high.y}})
      if (h > 0 && m > l && m < u) part = std::min(part, 0.9 * std::min(m - l, u - m) / h);
    return {{middle.x - part * half.x, middle.y - part * half.y}, {middle.x + part * half.x, middle.y + part * half.y}};
  }

  /// An arrow with two heads; without a grain line of its own the panel's warp is assumed, in grey.
  void grain(const Sheet& s) {
    const svg::Inside in = svg::insideOf(*s.panel);
    GrainLine line;
    if (s.panel->grain) {
      line = *s.panel->grain;
    } else {
      const double half = std::max(0.008, 0.75 * in.room_m), left = in.point.x - 0.6 * in.room_m;
      line = {{left, in.point.y - 0.6 * half}, {left, in.point.y + 0.6 * half}};
    }
    const auto [from, to] = drawnWithin(s, line);
    const Vec2 a = s.frame.at(from), b = s.frame.at(to);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) return;
    const Vec2 d{(b.x - a.x) / length, (b.y - a.y) / length};
    const std::string kind = s.panel->grain ? "grain" : "grain assumed";
    path(kind, svg::to("M ", a) + svg::to(" L ", b));
    const double head = std::min(4.0, 0.3 * length);
    for (const auto& [tip, sense] : {std::pair(a, 1.0), std::pair(b, -1.0)}) {
      const Vec2 back{tip.x + sense * head * d.x, tip.y + sense * head * d.y};
      path(kind,
           svg::to("M ", tip) + svg::to(" L ", {back.x - 0.3 * head * d.y, back.y + 0.3 * head * d.x}) +
               svg::to(" L ", {back.x + 0.3 * head * d.y, back.y - 0.3 * head * d.x}) + " Z",
           " style=\"stroke-dasharray: none\"");
    }
  }

  /// Numbers of edges, as seams of the file name them.
  void numbers(const Sheet& s) {
    for (int e = 0; e < edgeCount(*s.panel); ++e) {
      const double size = 0.72 * sizeBeside(*s.panel, e);
      const Vec2 at = moved(spot(s, e, 0.5), 0.9 * size + 1.5);
      const std::string& name = edgeOf(*s.panel, e).name;
      text({at.x, at.y + 0.36 * size}, size, std::to_string(e) + (name.empty() ? "" : " " + name), "small halo",
           " text-anchor=\"middle\"");
    }
  }

  void label(const Sheet& s) {
    const svg::Inside in = svg::insideOf(*s.panel);
    Vec2 at = s.frame.at(in.point);
    const double letters = std::max<double>(6, static_cast<double>(s.panel->name.size()));
    const double size = std::clamp(2000 * in.room_m * 1.3 / (0.62 * letters), 2.2, 11.0),
                 small = std::max(2.0, 0.48 * size);
    std::string middle = " text-anchor=\"middle\"";
    if (s.panel->grain && in.room_m > 0.03) {  // beside the arrow
      const double x = s.frame.at(drawnWithin(s, *s.panel->grain).first).x;
      if (std::abs(x - at.x) < 500 * in.room_m) {
        at.x = x + 4;
        middle.clear();
      }
    }
    text({at.x, at.y}, size, s.panel->name, "halo", middle + " font-weight=\"bold\"");
    std::string cut = fmt::format("cut {}", s.panel->quantity);
    if (!s.panel->size.empty()) cut += " · size " + s.panel->size;
    if (!s.panel->material.empty()) cut += " · " + s.panel->material;
    text({at.x, at.y + 1.35 * small}, small, cut, "halo", middle);
    text({at.x, at.y + 2.7 * small}, small, fmt::format("{:.1f} cm²", 1e4 * areaOf(*s.panel)), "small halo", middle);
  }

  /// Name, scale bar and a square to check the print with.
  void head() {
    const double y = kMargin_mm;
    text({kMargin_mm, y + 8}, 11, pattern_.name, "", " font-weight=\"bold\"");
    std::string from = fmt::format("{} panels, {} seams. Scale 1:1, print at 100 %. Right side of the cloth up.",
                                   pattern_.panels.size(), pattern_.seams.size());
    if (!pattern_.source.format.empty()) from += " From " + pattern_.source.file + " (" + pattern_.source.format + ").";
    text({kMargin_mm, y + 15.5}, 4.4, from, "small");
    const double x = kMargin_mm, bar = y + 21;
    for (int k = 0; k < 10; ++k)
      add(
          fmt::format("<rect x=\"{}\" y=\"{}\" width=\"10\" height=\"2.4\" fill=\"{}\" stroke=\"#26262b\" "
                      "stroke-width=\"0.25\"/>",
                      svg::number(x + 10 * k), svg::number(bar), k % 2 == 0 ? "#26262b" : "#ffffff"));
    text({x, bar + 6}, 3, "0", "small");
    text({x + 100, bar + 6}, 3, "10 cm", "small", " text-anchor=\"middle\"");
    path("mark", fmt::format("M {} {} h 50 v -50 h -50 z", svg::number(width_ - kMargin_mm - 50),
                             svg::number(height_ - kMargin_mm)));
    text({width_ - kMargin_mm - 25, height_ - kMargin_mm - 24}, 3, "5 × 5 cm", "small", " text-anchor=\"middle\"");
  }

  std::string seamWords(const PanelSeam& s) const {
    std::string a, b;
    for (const SeamPart& p : s.a) a += (a.empty() ? "" : " + ") + partText(pattern_, p);
    for (const SeamPart& p : s.b) b += (b.empty() ? "" : " + ") + partText(pattern_, p);
    return fmt::format("{}, {}   {:.1f} / {:.1f} cm{}{}", a, b, 100 * lengthOf(pattern_, s.a),
                       100 * lengthOf(pattern_, s.b),
                       s.use == SeamUse::dart      ? ", dart"
                       : s.use == SeamUse::opening ? ", opening"
                                                   : "",
                       s.proposed ? ", proposed" : "");
  }

  /// Seams with the lengths of their sides, in columns under the panels; leaves room for the square.
  void list() {
    std::vector<std::string> words;
    std::size_t longest = 20;
    for (const PanelSeam& s : pattern_.seams) longest = std::max(longest, words.emplace_back(seamWords(s)).size());
    const double column = 32 + 0.6 * kText_mm * static_cast<double>(longest);
    const double room = std::max(column, width_ - 2 * kMargin_mm - 60);
    const auto columns = static_cast<std::size_t>(std::max(1.0, std::floor(room / column)));
    const std::size_t rows = (words.size() + columns - 1) / columns;
    const double top = height_;
    for (std::size_t k = 0; k < words.size(); ++k) {
      const PanelSeam& s = pattern_.seams[k];
      const Vec2 at{kMargin_mm + column * static_cast<double>(k / rows),
                    top + kLine_mm * static_cast<double>(k % rows + 1)};
      path(s.proposed ? "seam proposed" : "seam",
           fmt::format("M {} {} h 12.5", svg::number(at.x), svg::number(at.y - 1.2)),
           fmt::format(" stroke=\"{}\"", svg::colour(k)));
      text({at.x + 15, at.y}, kText_mm, s.name, "", " font-weight=\"bold\"");
      text({at.x + 27, at.y}, kText_mm, words[k], "small");
    }
    height_ = top + std::max(56.0, kLine_mm * static_cast<double>(rows + 1)) + kMargin_mm;
  }

  const FlatPattern& pattern_;
  std::vector<Sheet> sheets_;
  double width_ = 0, height_ = 0;
  std::string out_;
};

}  // namespace

std::string patternSvg(const FlatPattern& pattern) { return Drawing(pattern).draw(); }

}  // namespace gambeson
