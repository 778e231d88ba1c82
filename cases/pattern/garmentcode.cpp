#include "cases/pattern/garmentcode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "cases/input/schema.hpp"
#include "cases/input/table.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/flat/turn_panel.hpp"

namespace gambeson {
namespace {

using schema::Entry;
using Type = JsonNode::Type;

Entry required(const Entry& p, const char* key, Type type, const char* wanted) {
  if (p.node.type != Type::object) p.fail("expected an object { }, not " + describe(p.node));
  const JsonNode* node = p.node.find(key);
  if (!node) p.failAt(key, std::string("is missing; allowed: ") + wanted);
  if (node->type != type) p.member(*node).fail(std::string("expected ") + wanted + ", not " + describe(*node));
  return p.member(*node);
}

/// A list of exactly these many numbers; true and false count as 1 and 0.
std::vector<double> numbers(const Entry& p, std::size_t count) {
  if (p.node.type != Type::list || p.node.children.size() != count)
    p.fail(fmt::format("expected a list of {} numbers, not {}", count, describe(p.node)));
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) {
    const JsonNode& n = p.node.children[k];
    out.push_back(n.type == Type::boolean ? n.boolean : schema::readNumber(p.item(k), "", schema::any()));
  }
  return out;
}
Vec2 pair(const Entry& p, double scale) {
  const std::vector<double> x = numbers(p, 2);
  return {scale * x[0], scale * x[1]};
}
int index(const Entry& p, std::size_t count, const char* of) {
  if (count == 0) p.fail(fmt::format("names {} where there is none", of));
  return schema::readInteger(p, schema::between(0, static_cast<double>(count) - 1));
}

/// Keys that nobody reads, each with how often it occurs.
class Dropped {
 public:
  void unknown(const Entry& p, const char* where, const std::vector<std::string>& known) {
    for (const JsonNode& child : p.node.children)
      if (std::find(known.begin(), known.end(), child.key) == known.end()) ++count_[{where, child.key}];
  }
  std::vector<std::string> words() const {
    std::vector<std::string> out;
    for (const auto& [key, times] : count_)
      out.push_back(
          fmt::format("\"{}\" of {}{}", key.second, key.first, times > 1 ? fmt::format(", {} times", times) : ""));
    return out;
  }

 private:
  std::map<std::pair<std::string, std::string>, int> count_;
};

class Reader {
 public:
  Reader(const Entry& root, const ImportChoices& choices) : root_(root) {
    const JsonNode* properties = root.node.find("properties");
    std::optional<double> per_metre;
    if (properties) {
      const Entry p = root.member(*properties);
      if (properties->type != Type::object) p.fail("expected an object { }, not " + describe(*properties));
      if (const JsonNode* u = properties->find("units_in_meter"))
        per_metre = schema::readNumber(p.member(*u), "", schema::between(1e-3, 1e6));
      if (const JsonNode* c = properties->find("curvature_coords"))
        absolute_ = schema::readChoice(p.member(*c), {"relative", "absolute"}) == 1;
      dropped_.unknown(p, "properties",
                       {"units_in_meter", "curvature_coords", "normalized_edge_loops", "normalize_panel_translation",
                        "original_units_in_meter"});
    }
    if (!choices.unit.empty()) {
      scale_ = metresOf(choices.unit);
      out_.pattern.source.unit = choices.unit;
    } else if (per_metre) {
      scale_ = 1 / *per_metre;
      out_.pattern.source.unit = *per_metre == 100 ? "cm" : *per_metre == 1000 ? "mm" : *per_metre == 1 ? "m" : "";
    } else {
      root.fail(
          "properties.units_in_meter is missing, so nobody knows how long a 1 is; say it with --unit cm (which "
          "GarmentCode writes), or add it to the file (100 for cm)");
    }
  }

  ImportedPattern read() {
    const Entry pattern = required(root_, "pattern", Type::object, "an object { } with panels");
    const Entry panels = required(pattern, "panels", Type::object, "an object { } of panels by name");
    out_.pattern.source.format = "GarmentCode";
    for (const JsonNode* node : ordered(pattern, panels)) readPanel(panels.member(*node));
    if (const JsonNode* stitches = pattern.node.find("stitches")) readStitches(pattern.member(*stitches));
    for (const char* key : {"parameters", "parameter_order", "constraints", "constraint_order"})
      if (const JsonNode* n = root_.node.find(key); n && !n->children.empty())
        out_.dropped.push_back(fmt::format("{} of the template ({})", key, n->children.size()));
    dropped_.unknown(root_, "the file",
                     {"pattern", "properties", "parameters", "parameter_order", "constraints", "constraint_order"});
    dropped_.unknown(pattern, "the pattern", {"panels", "stitches", "panel_order"});
    for (std::string& words : dropped_.words()) out_.dropped.push_back(std::move(words));
    check(panels);
    return std::move(out_);
  }

 private:
  /// Panels as `panel_order` has them, those that it leaves out behind.
  std::vector<const JsonNode*> ordered(const Entry& pattern, const Entry& panels) const {
    std::vector<const JsonNode*> out;
    std::set<const JsonNode*> taken;
    if (const JsonNode* order = pattern.node.find("panel_order")) {
      const Entry p = pattern.member(*order);
      if (order->type != Type::list) p.fail("expected a list [ ] of names, not " + describe(*order));
      for (std::size_t k = 0; k < order->children.size(); ++k) {
        const JsonNode* panel = panels.node.find(schema::readText(p.item(k)));
        if (!panel) p.item(k).fail("there is no panel \"" + order->children[k].text + "\"");
        if (taken.insert(panel).second) out.push_back(panel);
      }
    }
    for (const JsonNode& panel : panels.node.children)
      if (taken.insert(&panel).second) out.push_back(&panel);
    return out;
  }

  EdgeCurve readCurve(const Entry& p, Vec2 a, Vec2 b) {
    const Vec2 e{b.x - a.x, b.y - a.y};
    const auto control = [&](const Entry& at) {
      if (absolute_) return pair(at, scale_);
      const Vec2 r = pair(at, 1);
      return Vec2{a.x + r.x * e.x - r.y * e.y, a.y + r.x * e.y + r.y * e.x};
    };
    if (p.node.type == Type::list) return BezierEdge{{control(p)}};  // as files before 2023 have them
    const Entry params = required(p, "params", Type::list, "a list [ ] of the curve's numbers");
    const Entry type = required(p, "type", Type::text, "\"quadratic\", \"cubic\" or \"circle\"");
    dropped_.unknown(p, "curvature", {"type", "params"});
    const std::size_t kind = schema::readChoice(type, {"quadratic", "cubic", "circle"});
    if (kind == 2) {
      const std::vector<double> c = numbers(params, 3);
      const double chord = std::hypot(e.x, e.y), radius = scale_ * c[0];
      if (!(radius > 0)) params.fail(fmt::format("a radius of {:g}; allowed: > 0", c[0]));
      // An arc of SVG whose radius is too short for its chord is a half circle; so is one that rounding alone keeps
      // from it.
      const double half = 0.5 * chord / radius;
      double turn = 2 * std::asin(half < 1 - 1e-15 ? half : 1.0);
      if (c[1] != 0) turn = 2 * std::numbers::pi - turn;
      return ArcEdge{c[2] != 0 ? turn : -turn};
    }
    if (params.node.children.size() != kind + 1)
      params.fail(fmt::format("has {} points; allowed: {}", params.node.children.size(), kind + 1));
    BezierEdge bezier;
    for (std::size_t k = 0; k <= kind; ++k) bezier.controls_m.push_back(control(params.item(k)));
    return bezier;
  }

  void readPanel(const Entry& p) {
    Panel panel;
    panel.name = p.node.key;
    const Entry vertices = required(p, "vertices", Type::list, "a list [ ] of points");
    const Entry edges = required(p, "edges", Type::list, "a list [ ] of edges");
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < vertices.node.children.size(); ++k) points.push_back(pair(vertices.item(k), scale_));
    std::vector<std::array<int, 2>> ends;
    for (std::size_t k = 0; k < edges.node.children.size(); ++k) {
      const Entry edge = edges.item(k);
      const Entry at = required(edge, "endpoints", Type::list, "a list of two numbers of vertices");
      if (at.node.children.size() != 2) at.fail("expected two numbers of vertices, not " + describe(at.node));
      const int from = index(at.item(0), points.size(), "a vertex"), to = index(at.item(1), points.size(), "a vertex");
      ends.push_back({from, to});
      const Vec2 a = points[static_cast<std::size_t>(from)], b = points[static_cast<std::size_t>(to)];
      PanelEdge out{"", a, StraightEdge{}};
      if (const JsonNode* c = edge.node.find("curvature")) out.curve = readCurve(edge.member(*c), a, b);
      if (const JsonNode* label = edge.node.find("label"); label && label->type == Type::text) out.name = label->text;
      dropped_.unknown(edge, "edges", {"endpoints", "curvature", "label"});
      panel.outline.push_back(std::move(out));
    }
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const std::size_t next = (k + 1) % ends.size();
      const Vec2 a = points[static_cast<std::size_t>(ends[k][1])], b = points[static_cast<std::size_t>(ends[next][0])];
      if (ends[k][1] != ends[next][0] && !(std::hypot(a.x - b.x, a.y - b.y) < 1e-9))
        edges.item(next).fail(
            fmt::format("panel \"{}\" is open: edge {} ends at vertex {} and edge {} starts at vertex {}; allowed: "
                        "edges that follow "
                        "each other around the panel, once",
                        panel.name, k, ends[k][1], next, ends[next][0]));
    }
    if (const JsonNode* label = p.node.find("label"); label && label->type == Type::text) panel.region = label->text;
    readPlacement(p, panel);
    dropped_.unknown(p, "panels", {"vertices", "edges", "translation", "rotation", "label"});
    at_.push_back(&p.node);
    out_.pattern.panels.push_back(std::move(panel));
  }

  void readPlacement(const Entry& p, Panel& panel) {
    const JsonNode *t = p.node.find("translation"), *r = p.node.find("rotation");
    if (!t && !r) return;
    const std::vector<double> move = t ? numbers(p.member(*t), 3) : std::vector<double>(3);
    const std::vector<double> turn = r ? numbers(p.member(*r), 3) : std::vector<double>(3);
    double c[3], s[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = turn[k] * std::numbers::pi / 180;
      c[k] = std::cos(angle), s[k] = std::sin(angle);
    }
    // The first two columns of Rz Ry Rx, in axes with z forward, x to the left and y up.
    const Vec3 x{c[2] * c[1], s[2] * c[1], -s[1]};
    const Vec3 y{c[2] * s[1] * s[0] - s[2] * c[0], s[2] * s[1] * s[0] + c[2] * c[0], c[1] * s[0]};
    const auto ours = [](const Vec3& v) { return Vec3{v.z, v.x, v.y}; };
    panel.placement = PanelPlace{scale_ * ours({move[0], move[1], move[2]}), ours(x), ours(y)};
  }

  void readStitches(const Entry& stitches) {
    if (stitches.node.type != Type::list)
      stitches.fail("expected a list [ ] of stitches, not " + describe(stitches.node));
    for (std::size_t k = 0; k < stitches.node.children.size(); ++k) {
      const Entry stitch = stitches.item(k);
      if (stitch.node.type != Type::list || stitch.node.children.size() < 2)
        stitch.fail("expected a list [ ] of two sides, not " + describe(stitch.node));
      PanelSeam seam;
      seam.name = fmt::format("s{}", k + 1);
      SeamPart a = readSide(stitch.item(0)), b = readSide(stitch.item(1));
      bool wrong_side = false;
      for (std::size_t i = 2; i < stitch.node.children.size(); ++i) {
        schema::readChoice(stitch.item(i), {"right_wrong"});
        wrong_side = true;
      }
      if (!wrong_side) std::swap(b.from, b.to);
      const Panel& panel = out_.pattern.panels[static_cast<std::size_t>(a.panel)];
      if (a.panel == b.panel && !wrong_side &&
          (edgeAfter(panel, a.edge) == b.edge || edgeBefore(panel, a.edge) == b.edge))
        seam.use = SeamUse::dart;
      seam.a = {a};
      seam.b = {b};
      out_.pattern.seams.push_back(std::move(seam));
    }
  }

  SeamPart readSide(const Entry& p) {
    const std::string& name = schema::readText(required(p, "panel", Type::text, "the name of a panel"));
    dropped_.unknown(p, "stitches", {"panel", "edge"});
    for (std::size_t k = 0; k < out_.pattern.panels.size(); ++k)
      if (out_.pattern.panels[k].name == name) {
        const Entry edge = required(p, "edge", Type::number, "the number of an edge");
        return {static_cast<int>(k), index(edge, out_.pattern.panels[k].outline.size(), "an edge"), 0, 1};
      }
    p.failAt("panel", "there is no panel \"" + name + "\"");
  }

  /// Mirrors the clockwise panels and says what is wrong where it stands in the file.
  void check(const Entry& panels) {
    FlatPattern& pattern = out_.pattern;
    const auto say = [&](const InputError& e) {
      int k = -1;
      std::string rest = e.where().key;
      if (const std::size_t end = rest.find(']'); rest.starts_with("panels[") && end != std::string::npos) {
        k = std::stoi(rest.substr(7, end - 7));
        if (k >= 0 && k < static_cast<int>(at_.size()))
          panels.member(*at_[static_cast<std::size_t>(k)])
              .fail(rest.substr(end + 1).empty() ? e.reason() : rest.substr(end + 2) + ": " + e.reason());
      }
      root_.fail(rest + ": " + e.reason());
    };
    try {
      for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
        checkEdges(pattern.panels[k], fmt::format("panels[{}]", k));
        if (areaOf(pattern.panels[k].outline) < 0) mirror(pattern.panels[k]);
      }
      checkPattern(pattern);
    } catch (const InputError& e) {
      if (!e.where().file.empty()) throw;
      say(e);
    }
  }

  const Entry& root_;
  double scale_ = 1;
  bool absolute_ = false;
  Dropped dropped_;
  std::vector<const JsonNode*> at_;
  ImportedPattern out_;
};

}  // namespace

bool isGarmentCode(const JsonNode& root) {
  const JsonNode* pattern = root.type == Type::object ? root.find("pattern") : nullptr;
  return pattern && pattern->type == Type::object && pattern->find("panels");
}

ImportedPattern readGarmentCode(const JsonNode& root, const std::string& file, const ImportChoices& choices) {
  const Entry entry{root, "", file};
  return Reader(entry, choices).read();
}

}  // namespace gambeson
