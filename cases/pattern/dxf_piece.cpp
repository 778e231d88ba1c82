#include "cases/pattern/dxf_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/pattern/dxf_loops.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/crossings.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/flat/turn_panel.hpp"
#include "tryon/pattern/flat/unfold_panel.hpp"

namespace gambeson {
namespace {

constexpr double kNotchOff_m = 5e-3, kAllowance_m = 6e-2, kDeepest_m = 0.05, kCheck = 0.02;
constexpr std::size_t kMostEntities = 20000;

/// "# 12": the number of a grade rule, at its point.
bool isGradeRule(const std::string& text) {
  return text.size() > 1 && text[0] == '#' && text.find_first_not_of(" 0123456789", 1) == std::string::npos;
}

class Piece {
 public:
  Piece(const std::filesystem::path& file, const DxfBlock& block, double metres, bool unfolds,
        std::vector<std::string>& notes, DxfCounts& dropped)
      : file_(file), block_(block), metres_(metres), unfolds_(unfolds), notes_(notes), dropped_(dropped) {}

  Panel read() {
    if (block_.entities.size() > kMostEntities)
      throw InputError({file_.string(), 0, "block \"" + block_.name + "\""},
                       fmt::format("has {} lines and points; allowed: {}", block_.entities.size(), kMostEntities));
    texts();
    for (const DxfEntity& e : block_.entities)
      if (e.layer == "2" && e.kind == DxfEntity::Kind::point) turns_.push_back(at(e));
    loops();
    marks();
    foldOut();
    return std::move(panel_);
  }

 private:
  [[noreturn]] void reject(const std::string& layer, const std::string& reason) const {
    throw InputError({file_.string(), 0, fmt::format("block \"{}\", layer {}", block_.name, layer)}, reason);
  }
  Vec2 at(const DxfEntity& e) const { return {metres_ * e.points.front().x, metres_ * e.points.front().y}; }
  void note(const std::string& words) { notes_.push_back(fmt::format("panel \"{}\": {}", panel_.name, words)); }

  void texts() {
    panel_.name = block_.name;
    for (const DxfEntity& e : block_.entities) {
      if (e.kind != DxfEntity::Kind::text || e.text.empty()) continue;
      const auto said = systemText(e);
      if (isGradeRule(e.text)) {
        dropped_.add("numbers of grade rules (texts # 1)");
        continue;
      }
      if (!said) {
        panel_.annotations.push_back({e.text, at(e)});
        continue;
      }
      const auto& [key, value] = *said;
      if (value.empty()) continue;
      if (key == "PIECE NAME")
        panel_.name = value;
      else if (key == "SIZE")
        panel_.size = value;
      else if (key == "MATERIAL" || (key == "FABRIC" && panel_.material.empty()))
        panel_.material = value;
      else if (key == "CATEGORY")
        panel_.region = value;
      else if (key == "QUANTITY")
        quantity(value);
      else if (key == "ANNOTATION")
        panel_.annotations.push_back({value, at(e)});
      else if (key != "UNITS")
        dropped_.add("texts " + key);
    }
  }

  /// "2", or "1,1": as it is drawn, and mirrored.
  void quantity(const std::string& text) {
    int sum = 0, number = 0, parts = 0;
    bool digits = false;
    for (std::size_t k = 0; k <= text.size(); ++k) {
      if (k < text.size() && text[k] >= '0' && text[k] <= '9') {
        number = std::min(1000, 10 * number + (text[k] - '0'));
        digits = true;
      } else if (digits) {
        sum += number;
        parts += number > 0;
        number = 0;
        digits = false;
      }
    }
    panel_.quantity = std::clamp(sum, 1, 1000);
    if (parts > 1) note(fmt::format("QUANTITY: {}: {} are cut, some of them mirrored", text.substr(0, 40), sum));
  }

  PanelLoop loop(const DxfChain& chain, bool outline) {
    bool guessed = false;
    PanelLoop out = loopOf(chain, turns_, guessed);
    if (guessed && outline && !guessed_) {
      guessed_ = true;
      note("no turn points (layer 2) lie on its boundary; its corners are where it turns by more than 30 degrees");
    }
    return out;
  }

  /// Closed chains of a layer; open ones of less than a millimetre are closed.
  std::vector<DxfChain> closed(const char* layer, bool needed) {
    std::vector<DxfChain> out;
    for (DxfChain& c : chainsOf(block_.entities, layer, metres_)) {
      if (!c.closed && c.points.size() > 2 && gapOf(c) < 1e-3) {
        note(fmt::format("a line of layer {} is open by {:.2f} mm, and closed here", layer, 1e3 * gapOf(c)));
        c.closed = true;
      }
      if (c.closed) {
        out.push_back(std::move(c));
      } else if (needed) {
        reject(layer, fmt::format("the boundary is open: it starts at ({:.2f}, {:.2f}) cm and ends at ({:.2f}, {:.2f}) "
                                  "cm, {:.2f} cm apart; allowed: a closed polyline. Close it where it is drawn",
                                  100 * c.points.front().x, 100 * c.points.front().y, 100 * c.points.back().x,
                                  100 * c.points.back().y, 100 * gapOf(c)));
      } else {
        open_.push_back(std::move(c));
      }
    }
    return out;
  }

  double areaOfChain(const DxfChain& c) {
    Panel alone;
    alone.name = panel_.name;
    alone.outline = loop(c, false);
    check(alone);
    return std::abs(areaOf(alone.outline));
  }
  void check(const Panel& p) const {
    try {
      checkEdges(p, "");
    } catch (const InputError& e) {
      throw InputError(
          {file_.string(), 0, "block \"" + block_.name + "\""},
          (e.where().key.empty() ? "" : e.where().key.substr(e.where().key[0] == '.') + ": ") + e.reason());
    }
  }

  void loops() {
    std::vector<DxfChain> boundary = closed("1", true);
    if (boundary.empty()) reject("1", "has no closed boundary; allowed: a closed polyline");
    std::vector<double> area;
    for (const DxfChain& c : boundary) area.push_back(areaOfChain(c));
    const auto k = static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
    PanelLoop outer = loop(boundary[k], true);
    if (areaOf(outer) < 0) outer = reversed(outer);
    for (std::size_t i = 0; i < boundary.size(); ++i)
      if (i != k) cutout(boundary[i]);
    if (boundary.size() > 1) note("layer 1 has several closed lines; those within the largest are taken for cutouts");
    checked84(area[k]);
    for (const DxfChain& c : closed("11", false)) cutout(c);
    const std::vector<DxfChain> sew = closed("14", false);
    panel_.outline = outer;
    if (sew.size() == 1) {
      PanelLoop inner = loop(sew.front(), true);
      if (areaOfChain(sew.front()) > 0.5 * area[k]) {
        panel_.outline = areaOf(inner) < 0 ? reversed(inner) : std::move(inner);
        panel_.cut_line = std::move(outer);
      } else {
        open_.push_back(sew.front());
      }
    } else {
      open_.insert(open_.end(), sew.begin(), sew.end());
    }
    for (const DxfChain& c : open_) line(c, LineKind::sew);
    if (!open_.empty() && panel_.cut_line.empty())
      note("its sew lines (layer 14) do not close around the piece; it is read to its boundary, the cut line");
    check(panel_);
  }

  void cutout(const DxfChain& c) {
    PanelLoop hole = loop(c, false);
    Panel alone;
    alone.name = panel_.name;
    alone.outline = hole;
    check(alone);
    panel_.cutouts.push_back(areaOf(hole) > 0 ? reversed(hole) : std::move(hole));
  }

  /// Layer 84 has the boundary again, to check readers with.
  void checked84(double area) {
    for (const DxfChain& c : chainsOf(block_.entities, "84", metres_)) {
      if (!c.closed || c.points.size() < 3) continue;
      const double other = areaOfChain(c);
      if (std::abs(other - area) > kCheck * area)  // some programs write every tenth point there
        note(fmt::format("layer 84 (for checking) encloses {:.2f} cm^2, the boundary {:.2f} cm^2", 1e4 * other,
                         1e4 * area));
    }
  }

  void line(const DxfChain& c, LineKind kind) { panel_.lines.push_back({kind, c.points, c.closed}); }

  void marks() {
    const std::map<std::string, NotchKind> notches{{"4", NotchKind::slit},
                                                   {"80", NotchKind::t},
                                                   {"81", NotchKind::castle},
                                                   {"82", NotchKind::check},
                                                   {"83", NotchKind::u}};
    const std::map<std::string, LineKind> lines{{"5", LineKind::grade},
                                                {"6", LineKind::fold},
                                                {"8", LineKind::internal},
                                                {"9", LineKind::stripe},
                                                {"10", LineKind::plaid}};
    for (const auto& [layer, kind] : lines) {
      const std::vector<DxfChain> chains = chainsOf(block_.entities, layer, metres_);
      for (const DxfChain& c : chains) line(c, kind);
    }
    const std::vector<DxfChain> grain = chainsOf(block_.entities, "7", metres_);
    if (!grain.empty()) panel_.grain = GrainLine{grain.front().points.front(), grain.front().points.back()};
    for (std::size_t k = 1; k < grain.size(); ++k) dropped_.add("further grain lines of a piece (layer 7)");
    prepareNotches();
    for (const DxfEntity& e : block_.entities) {
      const bool point = e.kind == DxfEntity::Kind::point;
      if (const auto notch = notches.find(e.layer); notch != notches.end() && point)
        addNotch(at(e), notch->second, metres_ * e.size);
      else if (e.layer == "13" && (point || e.kind == DxfEntity::Kind::circle))
        panel_.lines.push_back({LineKind::drill, {at(e)}, false});
      else if (e.layer == "3" && point)
        dropped_.add("curve points (layer 3): lines are kept point by point");
      else if (e.layer == "84" || e.layer == "85" || e.layer == "86" || e.layer == "87")
        dropped_.add("lines for checking (layers 84 to 87)");
      else if (e.kind == DxfEntity::Kind::other || !known(e))
        dropped_.add(fmt::format("{} on layer {}", e.type, e.layer));
    }
  }
  static bool known(const DxfEntity& e) {
    static const std::set<std::string> lines{"1", "5", "6", "7", "8", "9", "10", "11", "14"};
    if (e.kind == DxfEntity::Kind::text) return true;
    if (e.kind == DxfEntity::Kind::point) return e.layer == "2";
    return (e.kind == DxfEntity::Kind::polyline || e.kind == DxfEntity::Kind::circle) && lines.contains(e.layer);
  }

  /// A mirror line along the border of the piece says that a half is drawn.
  void foldOut() {
    for (const InternalLine& l : panel_.lines) {
      if (l.kind != LineKind::fold || l.points_m.size() < 2) continue;
      Panel whole = panel_;
      if (!unfold(whole, l.points_m.front(), l.points_m.back())) continue;
      if (!unfolds_) {
        note("is drawn as a half, up to its mirror line (layer 6), and read so; --unfold makes it whole");
        return;
      }
      note(fmt::format("is drawn as a half, up to its mirror line (layer 6), and made whole{}",
                       whole.cut_line.empty() && !panel_.cut_line.empty()
                           ? "; its cut line is left out, as it does not "
                             "end on that line"
                           : ""));
      panel_ = std::move(whole);
      check(panel_);
      return;
    }
  }

  /// The outline as lines, with the edge and the length along it where each starts.
  void prepareNotches() {
    for (int k = 0; k < static_cast<int>(panel_.outline.size()); ++k) {
      std::vector<Vec2> points = flattened(edgeOf(panel_, k), edgeEnd(panel_, k), 1e-6);
      points.push_back(edgeEnd(panel_, k));
      double along = 0;
      const std::size_t first = lines_.size();
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double length = std::hypot(points[i + 1].x - points[i].x, points[i + 1].y - points[i].y);
        lines_.push_back({points[i], points[i + 1], k, along, length, 0});
        along += length;
      }
      for (std::size_t i = first; i < lines_.size(); ++i) lines_[i].whole = along;
    }
  }
  void addNotch(Vec2 p, NotchKind kind, double depth) {
    double best = 1e300;
    Notch notch;
    notch.kind = kind;
    for (const Line& l : lines_) {
      const Vec2 d{l.b.x - l.a.x, l.b.y - l.a.y};
      const double d2 = l.length * l.length;
      const double t = d2 > 0 ? std::clamp(((p.x - l.a.x) * d.x + (p.y - l.a.y) * d.y) / d2, 0.0, 1.0) : 0;
      const double off = std::hypot(p.x - l.a.x - t * d.x, p.y - l.a.y - t * d.y);
      if (off < best) {
        best = off;
        notch.edge = l.edge;
        notch.at = l.whole > 0 ? std::clamp((l.along + t * l.length) / l.whole, 0.0, 1.0) : 0;
      }
    }
    if (!(best <= (panel_.cut_line.empty() ? kNotchOff_m : kAllowance_m))) {
      dropped_.add("notches that lie off their piece's edges");
      return;
    }
    if (depth > 0 && depth <= kDeepest_m) notch.depth_m = depth;
    panel_.notches.push_back(notch);
  }

  struct Line {
    Vec2 a, b;
    int edge;
    double along, length, whole;
  };

  const std::filesystem::path& file_;
  const DxfBlock& block_;
  double metres_;
  bool unfolds_;
  std::vector<std::string>& notes_;
  DxfCounts& dropped_;
  Panel panel_;
  std::vector<Vec2> turns_;
  std::vector<DxfChain> open_;
  std::vector<Line> lines_;
  bool guessed_ = false;
};

}  // namespace

std::optional<std::pair<std::string, std::string>> systemText(const DxfEntity& e) {
  if (e.kind != DxfEntity::Kind::text) return std::nullopt;
  static const std::set<std::string> keys{"PIECE NAME",       "SIZE",
                                          "QUANTITY",         "MATERIAL",
                                          "CATEGORY",         "ANNOTATION",
                                          "STYLE NAME",       "UNITS",
                                          "SAMPLE SIZE",      "CREATION DATE",
                                          "CREATION TIME",    "AUTHOR",
                                          "PRODUCT",          "GRADING RULE TABLE",
                                          "VERSION",          "ALTERNATE GRADE RULE TABLE",
                                          "RULE TABLE",       "DESCRIPTION",
                                          "GRADE RULE TABLE", "FABRIC",
                                          "TOLERANCE"};
  const std::size_t colon = e.text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  std::string key = e.text.substr(0, colon);
  while (key.ends_with(' ')) key.pop_back();
  std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return std::toupper(c); });
  if (!keys.contains(key)) return std::nullopt;
  const std::size_t first = e.text.find_first_not_of(' ', colon + 1);
  return std::pair(key, first == std::string::npos ? "" : e.text.substr(first));
}

std::vector<std::string> DxfCounts::words() const {
  std::vector<std::string> out;
  for (const auto& [what, times] : count_)
    out.push_back(fmt::format("{}{}", what, times > 1 ? fmt::format(", {} times", times) : ""));
  return out;
}

Panel panelOf(const std::filesystem::path& file, const DxfBlock& block, double metres, bool unfolds,
              std::vector<std::string>& notes, DxfCounts& dropped) {
  return Piece(file, block, metres, unfolds, notes, dropped).read();
}

}  // namespace gambeson
