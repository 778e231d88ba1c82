#include "cases/pattern/dxf_write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "cases/input/table.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

constexpr double mm = 1e3, curve_m = 1e-5, apart_m = 0.05, text_mm = 5;

const char* layerOf(NotchKind kind) {
  switch (kind) {
    case NotchKind::t:
      return "80";
    case NotchKind::castle:
      return "81";
    case NotchKind::check:
      return "82";
    case NotchKind::u:
      return "83";
    case NotchKind::slit:
    case NotchKind::v:
      break;
  }
  return "4";
}
const char* layerOf(LineKind kind) {
  switch (kind) {
    case LineKind::sew:
      return "14";
    case LineKind::fold:
      return "6";
    case LineKind::stripe:
      return "9";
    case LineKind::plaid:
      return "10";
    case LineKind::grade:
      return "5";
    case LineKind::drill:
      return "13";
    case LineKind::internal:
      break;
  }
  return "8";
}

/// Pairs of a group code and what stands under it.
class Writer {
 public:
  template <class T>
  void put(int code, const T& value) {
    fmt::format_to(std::back_inserter(out_), "{}\n{}\n", code, value);
  }
  void entity(const char* type, const char* layer) { put(0, type), put(8, layer); }
  void at(Vec2 p, int number = 0, double z = 0) {
    for (const auto& [code, x] : {std::pair{10, p.x}, std::pair{20, p.y}, std::pair{30, z}})
      put(code + number, fmt::format("{:.7f}", mm * x));
  }
  void text(const char* layer, Vec2 p, const std::string& words) {
    entity("TEXT", layer), at(p), put(40, text_mm);
    std::string line = words;
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
    put(1, line);
  }
  void point(const char* layer, Vec2 p, double z = 0) { entity("POINT", layer), at(p, 0, z); }
  void polyline(const char* layer, const std::vector<Vec2>& points, bool closed) {
    entity("POLYLINE", layer), put(66, 1), at({0, 0}), put(70, closed ? 1 : 0);
    for (const Vec2& p : points) entity("VERTEX", layer), at(p);
    entity("SEQEND", layer);
  }
  void loop(const char* layer, const PanelLoop& loop) {
    polyline(layer, flattened(loop, curve_m), true);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::vector<Vec2> points = flattened(loop[k], loop[(k + 1) % loop.size()].start_m, curve_m);
      for (std::size_t i = 0; i < points.size(); ++i) point(i == 0 ? "2" : "3", points[i]);
    }
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

/// JSON without the ends of its lines and what indents them (texts in it have no line ends).
std::string onOneLine(const std::string& json) {
  std::string out;
  bool indent = false;
  for (const char c : json) {
    if (c == '\n') out += ' ';
    indent = c == '\n' || (indent && c == ' ');
    if (!indent) out += c;
  }
  return out;
}

void writePanel(const Panel& panel, const std::string& block, Writer& w) {
  w.entity("BLOCK", "1"), w.put(2, block), w.put(70, 0), w.at({0, 0});
  const PanelBox box = boxOf(panel.outline);
  const Vec2 middle{0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y)};
  double line_m = 0;  // texts stand below each other
  const auto said = [&](const char* key, const std::string& value) {
    if (value.empty()) return;
    w.text("1", {middle.x, middle.y - line_m}, fmt::format("{}: {}", key, value));
    line_m += 1.5 * text_mm / mm;
  };
  said("PIECE NAME", panel.name), said("SIZE", panel.size), said("MATERIAL", panel.material);
  said("CATEGORY", panel.region), said("QUANTITY", fmt::format("{}", panel.quantity));
  w.loop("1", panel.cut_line.empty() ? panel.outline : panel.cut_line);
  if (!panel.cut_line.empty()) w.loop("14", panel.outline);
  for (const PanelLoop& hole : panel.cutouts) w.loop("11", hole);
  for (const Notch& n : panel.notches)
    w.point(layerOf(n.kind), MeasuredCurve(curveOf(panel, n.edge)).at(n.at).point, n.depth_m);
  if (panel.grain) w.entity("LINE", "7"), w.at(panel.grain->from_m), w.at(panel.grain->to_m, 1);
  for (const InternalLine& l : panel.lines) {
    if (l.kind == LineKind::drill)
      w.point("13", l.points_m.front());
    else
      w.polyline(layerOf(l.kind), l.points_m, l.closed);
  }
  for (const Annotation& a : panel.annotations) w.text("15", a.at_m, a.text);
  w.entity("ENDBLK", "1");
}

}  // namespace

std::string patternDxf(const FlatPattern& pattern) {
  Writer w;
  w.put(0, "SECTION"), w.put(2, "HEADER"), w.put(9, "$ACADVER"), w.put(1, "AC1009");
  w.put(9, "$INSUNITS"), w.put(70, 4), w.put(9, "$MEASUREMENT"), w.put(70, 1), w.put(0, "ENDSEC");
  w.put(0, "SECTION"), w.put(2, "BLOCKS");
  const auto block = [](std::size_t k) { return fmt::format("PIECE_{}", k + 1); };
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) writePanel(pattern.panels[k], block(k), w);
  w.put(0, "ENDSEC"), w.put(0, "SECTION"), w.put(2, "ENTITIES");
  w.text("1", {0, -0.02}, "STYLE NAME: " + pattern.name);
  w.text("1", {0, -0.03}, "UNITS: METRIC");
  double x = 0, y = -0.04;
  const JsonNode root = patternNode(pattern);
  if (const JsonNode* seams = root.find("seams"))
    for (const JsonNode& seam : seams->children)
      w.text("1", {0, y}, kDxfSeam + onOneLine(schema::toText(seam))), y -= 0.01;
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
    const PanelBox box = boxOf(pattern.panels[k].outline);
    w.entity("INSERT", "1"), w.put(2, block(k)), w.at({x - box.low.x, -box.low.y});
    x += box.high.x - box.low.x + apart_m;
  }
  w.put(0, "ENDSEC"), w.put(0, "EOF");
  return w.take();
}

}  // namespace gambeson
