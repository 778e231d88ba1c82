#include "cases/pattern/cad_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "cases/cad/tidy.hpp"
#include "core/error.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

/// The plane of a face: parameters to metres in it.
struct Plane {
  PanelPlace place;
  Vec2 start, along_u, along_v;  ///< of the parameters; what a 1 of u and a 1 of v are in the panel

  explicit Plane(const NurbsPatch& p) {
    const auto d = surfaceDerivatives(p, p.u.front(), p.v.front());
    const Vec3 x = normalized(d[1]), y = cross(normalized(cross(d[1], d[2])), x);
    place = {d[0], x, y};
    start = {p.u.front(), p.v.front()};
    along_u = {norm(d[1]), 0};
    along_v = {dot(d[2], x), dot(d[2], y)};
  }
  Vec2 operator()(Vec2 uv) const {
    const double u = uv.x - start.x, v = uv.y - start.y;
    return {u * along_u.x + v * along_v.x, v * along_v.y};
  }
};

EdgeCurve edgeCurve(const NurbsCurve& c, const Plane& plane) {
  std::vector<Vec2> inner;
  for (std::size_t k = 1; k + 1 < c.points.size(); ++k) inner.push_back(plane(c.points[k]));
  const bool even = std::all_of(c.weights.begin(), c.weights.end(), [&](double w) { return w == c.weights[0]; });
  if (c.knots.degree == 1 && even) {
    if (inner.empty()) return StraightEdge{};
    return PolylineEdge{inner};
  }
  return SplineEdge{c.knots.degree, c.knots.knots, inner, even ? std::vector<double>{} : c.weights};
}

PanelLoop loopOf(const TrimLoop& curves, const Plane& plane) {
  PanelLoop loop;
  for (const NurbsCurve& c : curves) loop.push_back({"", plane(c.points.front()), edgeCurve(c, plane)});
  return loop;
}

}  // namespace

bool isFlat(const CadShape& shape) {
  return std::all_of(shape.faces.begin(), shape.faces.end(), [](const CadFace& f) { return f.plane; });
}

std::vector<std::string> namesOf(const CadShape& shape) {
  std::map<std::string, int> often;
  for (const CadFace& f : shape.faces) ++often[f.name];
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t k = 0; k < shape.faces.size(); ++k) {
    const std::string& given = shape.faces[k].name;
    std::string name = given;
    if (given.empty() || often[given] > 1) name = fmt::format("{}_{}", given.empty() ? "face" : given, k + 1);
    while (!taken.insert(name).second) name += "_";
    names.push_back(name);
  }
  return names;
}

ImportedPattern panelsOf(const CadShape& shape) {
  ImportedPattern out;
  out.notes = shape.notes;
  out.dropped = shape.dropped;
  const std::vector<std::string> names = namesOf(shape);
  std::vector<std::vector<int>> first_edge;  // of each loop of each face
  for (std::size_t k = 0; k < shape.faces.size(); ++k) {
    const CadFace& f = shape.faces[k];
    const Plane plane(f.patch);
    Panel panel;
    panel.name = names[k];
    panel.placement = plane.place;
    std::vector<PanelLoop> loops;
    std::size_t outline = 0;
    for (const TrimLoop& loop : f.loops) loops.push_back(loopOf(loop, plane));
    for (std::size_t l = 0; l < loops.size(); ++l)
      if (areaOf(loops[l]) > areaOf(loops[outline])) outline = l;
    panel.outline = loops[outline];
    int edges = static_cast<int>(panel.outline.size());
    std::vector<int>& first = first_edge.emplace_back(loops.size(), 0);
    for (std::size_t l = 0; l < loops.size(); ++l) {
      if (l == outline) continue;
      first[l] = edges;
      edges += static_cast<int>(loops[l].size());
      panel.cutouts.push_back(std::move(loops[l]));
    }
    out.pattern.panels.push_back(std::move(panel));
  }
  for (const CadSeam& s : shape.seams) {
    const auto part = [&](const CadSide& side, bool reversed) {
      const int edge =
          first_edge[static_cast<std::size_t>(side.face)][static_cast<std::size_t>(side.loop)] + side.curve;
      return SeamPart{side.face, edge, reversed ? 1.0 : 0.0, reversed ? 0.0 : 1.0};
    };
    out.pattern.seams.push_back(
        {fmt::format("s{}", out.pattern.seams.size() + 1), {part(s.a, false)}, {part(s.b, s.reversed)}});
  }
  checkPattern(out.pattern);
  return out;
}

namespace {

/// The side of a patch that a curve of its border is, in its sense.
PatchEdge sideOf(const NurbsPatch& p, const NurbsCurve& c, int patch) {
  const Vec2 a = c.points.front(), b = c.points.back();
  if (a.x == b.x) return {patch, a.x == p.u.front() ? Side::u0 : Side::u1, b.y < a.y};
  return {patch, a.y == p.v.front() ? Side::v0 : Side::v1, b.x < a.x};
}

/// Why a side cannot be held from end to end; empty where it can.
std::string sideFault(const CadFace& f, const CadSide& side) {
  if (!isWhole(f)) return "runs along a trimmed border";
  if (f.loops[static_cast<std::size_t>(side.loop)].size() != 4) return "is a part of a patch's side";
  return "";
}

/// Whether a garment may have the seam.
bool fits(const Garment& g, Seam seam) {
  Garment pair;
  for (PatchEdge* edge : {&seam.a, &seam.b}) {
    const auto k = static_cast<std::size_t>(edge->patch);
    pair.patches.push_back(g.patches[k]);
    pair.weft.push_back(g.weft[k]);
    edge->patch = static_cast<int>(pair.patches.size()) - 1;
  }
  pair.seams = {seam};
  try {
    validate(pair);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace

CadGarment garmentOf(const CadShape& shape) {
  CadGarment out;
  Garment& g = out.garment;
  g.patch_names = namesOf(shape);
  bool trimmed = false;
  for (const CadFace& f : shape.faces) {
    g.patches.push_back(f.patch);
    g.trims.push_back(trimOf(f));
    trimmed = trimmed || !g.trims.back().loops.empty();
    // The weft runs along u in the middle of the patch.
    const Vec3 along = surfaceDerivatives(f.patch, 0.5 * (f.patch.u.front() + f.patch.u.back()),
                                          0.5 * (f.patch.v.front() + f.patch.v.back()))[1];
    if (!(norm(along) > 0))
      throw InputError({"", 0, "face " + g.patch_names[g.patches.size() - 1]}, "has no tangent in its middle");
    g.weft.push_back(normalized(along));
  }
  if (!trimmed) g.trims.clear();
  for (const CadSeam& s : shape.seams) {
    const auto face = [&](const CadSide& side) -> const CadFace& {
      return shape.faces[static_cast<std::size_t>(side.face)];
    };
    const auto curve = [&](const CadSide& side) -> const NurbsCurve& {
      return face(side).loops[static_cast<std::size_t>(side.loop)][static_cast<std::size_t>(side.curve)];
    };
    const auto word = [&](const CadSide& side) {
      int edge = side.curve;
      for (int l = 0; l < side.loop; ++l)
        edge += static_cast<int>(face(side).loops[static_cast<std::size_t>(l)].size());
      return fmt::format("{}.{}", g.patch_names[static_cast<std::size_t>(side.face)], edge);
    };
    CadSeamUse use{word(s.a), word(s.b), s.length_m, sideFault(face(s.a), s.a)};
    if (use.reason.empty()) use.reason = sideFault(face(s.b), s.b);
    if (use.reason.empty()) {
      Seam seam{sideOf(face(s.a).patch, curve(s.a), s.a.face), sideOf(face(s.b).patch, curve(s.b), s.b.face),
                SeamKind::C0};
      seam.b.reversed = seam.b.reversed != s.reversed;
      if (fits(g, seam))
        g.seams.push_back(seam);
      else
        use.reason = "joins sides whose knots or control points differ";
    }
    out.seams.push_back(std::move(use));
  }
  validate(g);
  return out;
}

}  // namespace gambeson
