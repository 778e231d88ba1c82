#include "tryon/pattern/flat/flatten_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/cloth/draft/part_seam.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

constexpr double straight_m = 1e-6, border = 1e-9, notched_m = 0.02;
constexpr int per_curve = 24;  ///< points on a segment of what is trimmed

[[noreturn]] void reject(const std::string& reason) { throw InputError({"", 0, "flat"}, reason); }

/// An edge of a panel: points, and where it lies on a side of its patch, where each point has a share of the side's
/// parameter.
struct Piece {
  std::optional<Side> side;
  std::vector<double> share;
  std::vector<Vec2> points;

  std::vector<double> lengths() const {
    std::vector<double> out{0};
    for (std::size_t k = 1; k < points.size(); ++k)
      out.push_back(out.back() + std::hypot(points[k].x - points[k - 1].x, points[k].y - points[k - 1].y));
    return out;
  }
  /// Share of the length at one of the side's parameter.
  double fractionAt(double s) const {
    const std::vector<double> at = lengths();
    const bool up = share.back() > share.front();
    std::size_t k = 1;
    while (k + 1 < share.size() && (up ? share[k] < s : share[k] > s)) ++k;
    const double f = std::clamp((s - share[k - 1]) / (share[k] - share[k - 1]), 0.0, 1.0);
    return (at[k - 1] + f * (at[k] - at[k - 1])) / at.back();
  }
};

/// A panel being made of a patch.
class Cut {
 public:
  Cut(const NurbsPatch& patch, const Trim& trim) : patch_(patch), flat_(flattenPatch(patch)) {
    for (const TrimLoop& loop : trim.loops) {
      double area = 0;  // signed, in the parameters
      std::vector<Vec2> around;
      for (const NurbsCurve& c : loop)
        for (const Vec2& p : sampled(c)) around.push_back(p);
      for (std::size_t k = 0; k < around.size(); ++k) {
        const Vec2 &a = around[k], &b = around[(k + 1) % around.size()];
        area += 0.5 * (a.x * b.y - a.y * b.x);
      }
      if (area > 0 && outer_) reject("a patch has several trimmed parts; they are no one panel");
      (area > 0 ? outer_ : holes_.emplace_back()) = &loop;
    }
  }

  const FlatPatch& flat() const { return flat_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

  Panel panel(const std::string& name) {
    Panel out;
    out.name = name;
    if (outer_)
      for (const NurbsCurve& c : *outer_) pieces_.push_back({{}, {}, mapped(c)});
    else
      for (const Side side : {Side::v0, Side::u1, Side::v1, Side::u0}) walk(side);
    for (const Piece& p : pieces_) out.outline.push_back(edgeFrom(p));
    for (const TrimLoop* hole : holes_) {
      PanelLoop& loop = out.cutouts.emplace_back();
      for (const NurbsCurve& c : *hole) loop.push_back(edgeFrom({{}, {}, mapped(c)}));
    }
    return out;
  }

 private:
  static bool alongU(Side s) { return s == Side::v0 || s == Side::v1; }
  /// Parameters of the place with this share on a side.
  Vec2 placeOn(Side side, double share) const {
    const double u = patch_.u.front() + share * (patch_.u.back() - patch_.u.front());
    const double v = patch_.v.front() + share * (patch_.v.back() - patch_.v.front());
    if (alongU(side)) return {u, side == Side::v0 ? patch_.v.front() : patch_.v.back()};
    return {side == Side::u0 ? patch_.u.front() : patch_.u.back(), v};
  }
  double shareOf(Side side, Vec2 uv) const {
    return alongU(side) ? (uv.x - patch_.u.front()) / (patch_.u.back() - patch_.u.front())
                        : (uv.y - patch_.v.front()) / (patch_.v.back() - patch_.v.front());
  }
  bool liesOn(Side side, const NurbsCurve& c) const {
    return std::all_of(c.points.begin(), c.points.end(), [&](const Vec2& p) {
      const Vec2 q = placeOn(side, shareOf(side, p));
      return std::hypot(q.x - p.x, q.y - p.y) < border;
    });
  }

  /// A side in the direction of the outline, with what holes at it leave.
  void walk(Side side) {
    const bool up = side == Side::v0 || side == Side::u1;
    struct Gap {
      double from, to;
      const TrimLoop* hole;
      std::size_t curve;
    };
    std::vector<Gap> gaps;
    for (auto h = holes_.begin(); h != holes_.end();) {
      const auto on = std::find_if((*h)->begin(), (*h)->end(), [&](const NurbsCurve& c) { return liesOn(side, c); });
      if (on == (*h)->end()) {
        ++h;
        continue;
      }
      const double a = shareOf(side, on->points.front()), b = shareOf(side, on->points.back());
      gaps.push_back({up ? std::min(a, b) : std::max(a, b), up ? std::max(a, b) : std::min(a, b), *h,
                      static_cast<std::size_t>(on - (*h)->begin())});
      h = holes_.erase(h);
    }
    std::sort(gaps.begin(), gaps.end(),
              [&](const Gap& a, const Gap& b) { return up ? a.from < b.from : a.from > b.from; });
    double at = up ? 0 : 1;
    for (const Gap& g : gaps) {
      addSide(side, at, g.from);
      // A hole runs clockwise, so the curves after the one on the side lead from its far end... back to its start.
      for (std::size_t k = 1; k < g.hole->size(); ++k)
        pieces_.push_back({{}, {}, mapped((*g.hole)[(g.curve + k) % g.hole->size()])});
      at = g.to;
    }
    addSide(side, at, up ? 1 : 0);
  }
  void addSide(Side side, double from, double to) {
    if (std::abs(from - to) < border) return;
    Piece piece{side, {from}, {}};
    const std::vector<double>& lines = alongU(side) ? flat_.u : flat_.v;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double line = lines[from < to ? k : lines.size() - 1 - k];
      const double s = shareOf(side, alongU(side) ? Vec2{line, 0} : Vec2{0, line});
      if (s > std::min(from, to) + border && s < std::max(from, to) - border) piece.share.push_back(s);
    }
    piece.share.push_back(to);
    for (const double s : piece.share) piece.points.push_back(flat_.at(placeOn(side, s)));
    pieces_.push_back(std::move(piece));
  }

  /// Points along a curve, in the parameters, its end left out.
  static std::vector<Vec2> sampled(const NurbsCurve& c) {
    std::vector<Vec2> out;
    for (const BezierSegment& s : bezierSegments(c))
      for (int k = 0; k < per_curve; ++k) out.push_back(s.at(static_cast<double>(k) / per_curve).point);
    return out;
  }
  std::vector<Vec2> mapped(const NurbsCurve& c) const {
    std::vector<Vec2> out = sampled(c);
    out.push_back(bezierSegments(c).back().at(1).point);
    for (Vec2& p : out) p = flat_.at(p);
    return out;
  }
  static PanelEdge edgeFrom(const Piece& piece) {
    const std::vector<Vec2>& x = piece.points;
    const Vec2 chord{x.back().x - x.front().x, x.back().y - x.front().y};
    const double length = std::hypot(chord.x, chord.y);
    bool straight = true;
    for (const Vec2& p : x)
      straight =
          straight && std::abs(chord.x * (p.y - x.front().y) - chord.y * (p.x - x.front().x)) <= straight_m * length;
    PanelEdge edge{"", x.front(), StraightEdge{}};
    if (!straight) edge.curve = PolylineEdge{{x.begin() + 1, x.end() - 1}};
    return edge;
  }

  const NurbsPatch& patch_;
  FlatPatch flat_;
  const TrimLoop* outer_ = nullptr;
  std::vector<const TrimLoop*> holes_;
  std::vector<Piece> pieces_;
};

/// The part of a side of a patch from one share of it to another, in the edge's sense, as parts of the panel's edges.
std::vector<SeamPart> partsOn(const Cut& cut, const PatchEdge& edge, double from, double to) {
  if (edge.reversed) from = 1 - from, to = 1 - to;
  const bool up = to > from;
  std::vector<SeamPart> out;
  bool with_outline = true;
  for (std::size_t k = 0; k < cut.pieces().size(); ++k) {
    const Piece& p = cut.pieces()[k];
    if (p.side != edge.side) continue;
    const double low = std::max(std::min(from, to), std::min(p.share.front(), p.share.back()));
    const double high = std::min(std::max(from, to), std::max(p.share.front(), p.share.back()));
    if (!(high > low + border)) continue;
    SeamPart part{edge.patch, static_cast<int>(k), p.fractionAt(up ? low : high), p.fractionAt(up ? high : low)};
    for (double* f : {&part.from, &part.to})
      if (std::abs(*f - std::round(*f)) < border) *f = std::round(*f);
    with_outline = part.to > part.from;
    out.push_back(part);
  }
  if (!with_outline) std::reverse(out.begin(), out.end());
  return out;
}

/// A mark in the middle of one side of a seam.
void notch(FlatPattern& pattern, const std::vector<SeamPart>& side) {
  const double half = 0.5 * lengthOf(pattern, side);
  double before = 0;
  for (const SeamPart& part : side) {
    Panel& panel = pattern.panels[static_cast<std::size_t>(part.panel)];
    const double whole = lengthOf(panel, part.edge), length = whole * std::abs(part.to - part.from);
    if (before + length < half && &part != &side.back()) {
      before += length;
      continue;
    }
    panel.notches.push_back(
        {part.edge, part.from + (part.to > part.from ? 1 : -1) * (half - before) / whole, NotchKind::slit, 0});
    return;
  }
}

/// Along the warp, through the middle of the patch.
GrainLine grainOf(const NurbsPatch& patch, const Vec3& weft, const FlatPatch& flat) {
  const int i = static_cast<int>(flat.u.size()) / 2, j = static_cast<int>(flat.v.size()) / 2;
  const auto d = surfaceDerivatives(patch, flat.u[i], flat.v[j]);
  // weft = a x_u + b x_v + a normal part
  const double uu = dot(d[1], d[1]), uv = dot(d[1], d[2]), vv = dot(d[2], d[2]), det = uu * vv - uv * uv;
  const double wu = dot(weft, d[1]), wv = dot(weft, d[2]);
  const double a = (vv * wu - uv * wv) / det, b = (uu * wv - uv * wu) / det;
  const auto slope = [&](int di, int dj) {
    const Vec2 &low = flat.at(i - di, j - dj), &high = flat.at(i + di, j + dj);
    const double step = di ? flat.u[i + 1] - flat.u[i - 1] : flat.v[j + 1] - flat.v[j - 1];
    return Vec2{(high.x - low.x) / step, (high.y - low.y) / step};
  };
  const Vec2 xu = slope(1, 0), xv = slope(0, 1), along{a * xu.x + b * xv.x, a * xu.y + b * xv.y};
  const double length = std::hypot(along.x, along.y);
  const Vec2 warp{along.y / length, -along.x / length}, middle = flat.at(i, j);
  const Vec2 left = flat.at(0, j), right = flat.at(static_cast<int>(flat.u.size()) - 1, j);
  const Vec2 low = flat.at(i, 0), high = flat.at(i, static_cast<int>(flat.v.size()) - 1);
  const double half =
      0.2 * std::min(std::hypot(right.x - left.x, right.y - left.y), std::hypot(high.x - low.x, high.y - low.y));
  return {{middle.x - half * warp.x, middle.y - half * warp.y}, {middle.x + half * warp.x, middle.y + half * warp.y}};
}

}  // namespace

FlattenedDraft flattenDraft(const Garment& garment) {
  if (!garment.weak_seams.empty() || !garment.sewn_seams.empty())
    reject("the garment has seams that do not join edges of its patches; drafts of a case are laid flat");
  FlattenedDraft out;
  FlatPattern& pattern = out.pattern;
  pattern.name = garment.name;
  pattern.source = {"", "gambeson draft", "m"};
  const Trim whole;
  std::vector<Cut> cuts;
  cuts.reserve(garment.patches.size());
  for (std::size_t k = 0; k < garment.patches.size(); ++k) {
    const std::string name = k < garment.patch_names.size() ? garment.patch_names[k] : fmt::format("patch_{}", k);
    try {
      cuts.emplace_back(garment.patches[k], k < garment.trims.size() ? garment.trims[k] : whole);
    } catch (const InputError& e) {
      throw InputError({"", 0, e.where().key}, fmt::format("patch \"{}\": {}", name, e.reason()));
    }
    Panel panel = cuts.back().panel(name);
    const Flattening& f = cuts.back().flat().flattening;
    if (k < garment.weft.size()) panel.grain = grainOf(garment.patches[k], garment.weft[k], cuts.back().flat());
    const FlatPatch& flat = cuts.back().flat();
    panel.annotations.push_back({fmt::format("laid flat with strains of {:.2f} % rms, {:.2f} % at most",
                                             100 * f.rms_strain, 100 * f.largest_strain),
                                 flat.at(static_cast<int>(flat.u.size()) / 2, static_cast<int>(flat.v.size()) / 2)});
    out.flattening.push_back(f);
    pattern.panels.push_back(std::move(panel));
  }
  for (const NamedEdge& named : garment.edges)
    for (const PatchEdge& e : named.edges) {
      const std::vector<Piece>& pieces = cuts[static_cast<std::size_t>(e.patch)].pieces();
      for (std::size_t k = 0; k < pieces.size(); ++k)
        if (pieces[k].side == e.side) pattern.panels[static_cast<std::size_t>(e.patch)].outline[k].name = named.name;
    }
  for (std::size_t k = 0; k < garment.seams.size(); ++k) {
    const Seam& s = garment.seams[k];
    PanelSeam seam;
    seam.name = fmt::format("s{}", k + 1);
    double from = 0, to = 1;
    if (s.onPart()) {
      const EdgePart part = partOf(garment, static_cast<int>(k));
      from = part.from, to = part.to;
    }
    seam.a = partsOn(cuts[static_cast<std::size_t>(s.a.patch)], s.a, 0, 1);
    seam.b = partsOn(cuts[static_cast<std::size_t>(s.b.patch)], s.b, from, to);
    seam.stiffness_N = s.kind == SeamKind::C0 ? s.stiffness_N : 0;
    if (seam.a.empty() || seam.b.empty()) reject(fmt::format("seam {} joins what is trimmed away", k));
    pattern.seams.push_back(std::move(seam));
  }
  for (const PanelSeam& s : pattern.seams)
    if (lengthOf(pattern, s.a) > notched_m) notch(pattern, s.a), notch(pattern, s.b);
  checkPattern(pattern);
  return out;
}

std::string beyondText(const FlattenedDraft& flat, double limit) {
  constexpr double kFarBeyond = 0.3;
  constexpr std::size_t kSaid = 3;
  std::vector<std::size_t> beyond;
  for (std::size_t k = 0; k < flat.flattening.size(); ++k)
    if (const Flattening& f = flat.flattening[k]; f.rms_strain > 2 * limit || f.largest_strain > limit + kFarBeyond)
      beyond.push_back(k);
  std::stable_sort(beyond.begin(), beyond.end(), [&](std::size_t a, std::size_t b) {
    return flat.flattening[a].largest_strain > flat.flattening[b].largest_strain;
  });
  std::string text;
  for (std::size_t k = 0; k < std::min(kSaid, beyond.size()); ++k) {
    const Flattening& f = flat.flattening[beyond[k]];
    text += fmt::format("{}{} by up to {:.2g} % ({:.2g} % in the mean)", text.empty() ? "" : ", ",
                        flat.pattern.panels[beyond[k]].name, 100 * f.largest_strain, 100 * f.rms_strain);
  }
  return text + (beyond.size() > kSaid ? fmt::format(" and {} more", beyond.size() - kSaid) : "");
}

}  // namespace gambeson
