#include "cases/structure/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cases/cloth/arc.hpp"
#include "cases/structure/shapes.hpp"
#include "core/cloth/draft/trim_loops.hpp"
#include "core/error.hpp"
#include "core/math/quadrature.hpp"
#include "tryon/pattern/garment_file.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

/// Runs f; an InputError of it gets this key before its own.
template <class F>
auto under(const std::string& key, F f) {
  try {
    return f();
  } catch (const InputError& e) {
    reject(key, (e.where().key.empty() ? "" : e.where().key + ": ") + e.reason());
  }
}

double atFraction(const KnotVector& k, double f) { return f == 1 ? k.back() : k.front() + f * (k.back() - k.front()); }

/// k-refinement: first the degree, then the knots.
NurbsPatch refined(NurbsPatch p, const SheetCase& c, int cells_u, int cells_v) {
  if (p.u.degree < c.degree) p = elevateDegree(p, Direction::u, c.degree - p.u.degree);
  if (p.v.degree < c.degree) p = elevateDegree(p, Direction::v, c.degree - p.v.degree);
  const auto insert = [&](Direction d, int cells, const std::vector<double>& more, const char* key) {
    const KnotVector& k = d == Direction::u ? p.u : p.v;
    std::vector<double> knots;
    const std::vector<double> ends = breakpoints(k);
    for (std::size_t s = 0; s + 1 < ends.size(); ++s)
      for (int i = 1; i < cells; ++i) knots.push_back(ends[s] + (ends[s + 1] - ends[s]) * i / cells);
    for (const double f : more) knots.push_back(atFraction(k, f));
    std::sort(knots.begin(), knots.end());
    if (!knots.empty()) p = under(key, [&] { return insertKnots(p, d, knots); });
  };
  insert(Direction::u, cells_u, c.refine_u, "refine_u");
  insert(Direction::v, cells_v, c.refine_v, "refine_v");
  return p;
}

int piecesOf(double angle_rad, int cells, const char* key) {
  const int n = arcPieces(angle_rad, cells);
  if (n == 0)
    reject(key, fmt::format("{} is out of range; allowed: at least {} for this arc, one per quarter of a turn", cells,
                            std::ceil(angle_rad / (std::numbers::pi / 2) - 1e-9)));
  return n;
}

bool isTurn(double angle_rad) { return angle_rad > 2 * std::numbers::pi * (1 - 1e-9); }

/// The grid of a shape, and its patches.
struct Builder {
  const SheetCase& c;
  Sheet& sheet;
  Vec3 weft{1, 0, 0};

  template <class Piece>
  void fill(const Grid& g, Piece piece) {
    sheet.grid = true;
    sheet.count_u = g.count_u;
    sheet.count_v = g.count_v;
    sheet.closed_u = g.closed_u;
    sheet.closed_v = g.closed_v;
    sheet.angle_u_rad = g.angle_u_rad;
    sheet.angle_v_rad = g.angle_v_rad;
    const auto index = [&](int i, int j) { return i % g.count_u + g.count_u * (j % g.count_v); };
    for (int j = 0; j < g.count_v; ++j)
      for (int i = 0; i < g.count_u; ++i)
        sheet.garment.patches.push_back(refined(piece(i, j), c, *c.cells_u / g.count_u, *c.cells_v / g.count_v));
    for (int j = 0; j < g.count_v; ++j)
      for (int i = 0; i < g.count_u; ++i) {
        if (i + 1 < g.count_u || g.closed_u)
          sheet.garment.seams.push_back({{index(i, j), Side::u1}, {index(i + 1, j), Side::u0}, SeamKind::G1, 0});
        if (j + 1 < g.count_v || g.closed_v)
          sheet.garment.seams.push_back({{index(i, j), Side::v1}, {index(i, j + 1), Side::v0}, SeamKind::G1, 0});
      }
    sheet.garment.weft.assign(sheet.garment.patches.size(), weft);
  }

  void operator()(const PlateShape& s) {
    weft = s.axis_u;
    fill({}, [&](int, int) { return platePatch(s); });
  }
  void operator()(const CylinderShape& s) {
    weft = s.axis;
    const double angle = s.end_angle_rad - s.start_angle_rad;
    Grid g;
    g.count_u = piecesOf(angle, *c.cells_u, "cells_u");
    g.closed_u = isTurn(angle);
    g.angle_u_rad = angle / g.count_u;
    fill(g, [&](int i, int) { return cylinderPatch(s, g, i); });
  }
  void operator()(const SphereShape& s) {
    weft = s.axis;
    const double around = s.longitude_end_rad - s.longitude_start_rad, up = s.latitude_end_rad - s.latitude_start_rad;
    Grid g;
    g.count_u = piecesOf(around, *c.cells_u, "cells_u");
    g.count_v = piecesOf(up, *c.cells_v, "cells_v");
    g.closed_u = isTurn(around);
    g.angle_u_rad = around / g.count_u;
    g.angle_v_rad = up / g.count_v;
    fill(g, [&](int i, int j) { return spherePatch(s, g, i, j); });
  }
  void operator()(const AnnulusShape& s) {
    weft = s.zero;
    const double angle = s.end_angle_rad - s.start_angle_rad;
    Grid g;
    g.count_v = piecesOf(angle, *c.cells_v, "cells_v");
    g.closed_v = isTurn(angle);
    g.angle_v_rad = angle / g.count_v;
    fill(g, [&](int, int j) { return annulusPatch(s, g, j); });
  }
  void operator()(const NurbsShape& s) {
    for (const SeamCase& seam : s.seams)
      if (seam.weak)
        sheet.garment.weak_seams.push_back({seam.seam.a, seam.seam.b, seam.seam.kind, seam.seam.stiffness_N});
      else
        sheet.garment.seams.push_back(seam.seam);
    for (const NurbsPatch& p : s.patches) {
      const std::array<Vec3, 6> middle = surfaceDerivatives(p, atFraction(p.u, 0.5), atFraction(p.v, 0.5));
      if (!(norm(middle[1]) > 0)) reject("nurbs", "a patch has no direction u in its middle: its points coincide");
      sheet.garment.weft.push_back(normalized(middle[1]));
      sheet.garment.patches.push_back(refined(p, c, *c.split, *c.split));
    }
    sheet.grid = s.patches.size() == 1;
  }
  void operator()(const SheetFile& s) {
    sheet.garment = loadGarment(s.path);
    for (NurbsPatch& p : sheet.garment.patches) p = refined(p, c, *c.split, *c.split);
    sheet.grid = sheet.garment.patches.size() == 1;
  }
};

bool isFlat(const SheetCase& c) {
  return std::holds_alternative<PlateShape>(c.shape) || std::holds_alternative<AnnulusShape>(c.shape);
}

void layFields(const SheetCase& c, Garment& g) {
  const bool turned = c.weft_angle_rad != 0;
  applyFields(c.fields, g);
  if (turned && !isFlat(c)) g.fields.resize(g.patches.size());
  if (!turned) return;
  if (isFlat(c)) {
    const std::array<Vec3, 6> x =
        surfaceDerivatives(g.patches[0], atFraction(g.patches[0].u, 0.5), atFraction(g.patches[0].v, 0.5));
    const Mat3 turn = rotationAbout(normalized(cross(x[1], x[2])), c.weft_angle_rad);
    for (Vec3& w : g.weft) w = turn * w;
    return;
  }
  for (PatchFields& f : g.fields) {
    if (!f.fibre_angle) f.fibre_angle = PatchField{0, 1, 1, {0}};
    for (double& v : f.fibre_angle->values) v += c.weft_angle_rad;
  }
}

/// A loop in the parameters of its patch: lengths of a plate and fractions of a range become parameters.
TrimLoop loopOf(const SheetCase& c, const TrimCase& t, const NurbsPatch& patch) {
  const PlateShape* plate = std::get_if<PlateShape>(&c.shape);
  const double su = plate ? plate->width_m : 1, sv = plate ? plate->height_m : 1;
  const double range_u = patch.u.back() - patch.u.front(), range_v = patch.v.back() - patch.v.front();
  const auto map = [&](Vec2 x) {
    return Vec2{patch.u.front() + x.x / su * range_u, patch.v.front() + x.y / sv * range_v};
  };
  TrimLoop loop;
  if (const auto* o = std::get_if<TrimCircle>(&t.loop))
    return {circle(map(o->center), o->radius / su * range_u, o->radius / sv * range_v, !t.keep_inside)};
  if (const auto* o = std::get_if<TrimSpline>(&t.loop))
    return splineLoop(patch, o->points, t.keep_inside ? Keep::inside : Keep::outside);
  if (const auto* o = std::get_if<TrimPolygon>(&t.loop))
    for (std::size_t i = 0; i < o->points.size(); ++i)
      loop.push_back(line(map(o->points[i]), map(o->points[(i + 1) % o->points.size()])));
  if (const auto* o = std::get_if<TrimCurves>(&t.loop))
    for (NurbsCurve curve : o->curves) {
      for (Vec2& x : curve.points) x = map(x);
      loop.push_back(std::move(curve));
    }
  const double area = turningArea(loop);
  if (!(std::abs(area) > 1e-12 * range_u * range_v)) reject("", "the loop encloses nothing; allowed: an area above 0");
  if ((area > 0) != t.keep_inside) {
    std::reverse(loop.begin(), loop.end());
    for (NurbsCurve& curve : loop) curve = reversed(curve);
  }
  return loop;
}

void applyTrim(const SheetCase& c, Garment& g) {
  if (c.trim.empty()) return;
  g.trims.resize(g.patches.size());
  std::vector<std::vector<std::size_t>> origin(g.patches.size());  // of each patch's loops: indices in c.trim
  for (std::size_t i = 0; i < c.trim.size(); ++i) {
    const TrimCase& t = c.trim[i];
    if (t.patch >= static_cast<int>(g.patches.size()))
      reject(fmt::format("trim[{}].patch", i),
             fmt::format("there is no patch {}; allowed: 0 to {}", t.patch, g.patches.size() - 1));
    const auto patch = static_cast<std::size_t>(t.patch);
    Trim& trim = g.trims[patch];
    trim.loops.push_back(under(fmt::format("trim[{}]", i), [&] { return loopOf(c, t, g.patches[patch]); }));
    trim.points_per_piece = c.trim_points;
    trim.unused_fraction = c.trim_unused;
    origin[patch].push_back(i);
  }
  for (std::size_t patch = 0; patch < g.patches.size(); ++patch) {
    if (g.trims[patch].loops.empty()) continue;
    try {
      trimCells(g.patches[patch], g.trims[patch]);
    } catch (const InputError& e) {
      // The key is "loops[k]..." where one loop is at fault.
      std::size_t loop = 0;
      const bool named = std::sscanf(e.where().key.c_str(), "loops[%zu]", &loop) == 1 && loop < origin[patch].size();
      reject(named ? fmt::format("trim[{}]", origin[patch][loop]) : "trim", e.reason());
    }
  }
}

}  // namespace

Sheet buildSheet(const SheetCase& c) {
  Sheet sheet;
  std::visit(Builder{c, sheet}, c.shape);
  Garment& g = sheet.garment;
  if (c.weft) std::fill(g.weft.begin(), g.weft.end(), *c.weft);
  layFields(c, g);
  applyTrim(c, g);
  if (c.imperfection) {
    const std::vector<Vec3> d = noiseOf(sheet, *c.imperfection);
    std::size_t k = 0;
    for (NurbsPatch& p : g.patches)
      for (Vec3& x : p.points) x += d[k++];
  }
  return sheet;
}

std::vector<PatchEdge> edgesOf(const Sheet& sheet, const EdgeAt& edge) {
  const int patches = static_cast<int>(sheet.garment.patches.size());
  if (edge.patch >= 0) {
    if (edge.patch >= patches)
      reject("", fmt::format("there is no patch {}; allowed: 0 to {}", edge.patch, patches - 1));
    return {{edge.patch, edge.side}};
  }
  if (!sheet.grid) reject("", fmt::format("the sheet has {} patches; allowed: patch and side such as 0.u0", patches));
  const bool along_v = edge.side == Side::u0 || edge.side == Side::u1;
  if (along_v ? sheet.closed_u : sheet.closed_v)
    reject("", fmt::format("the sheet is closed there and has no such edge; allowed: {}",
                           along_v ? "v0 or v1" : "u0 or u1"));
  std::vector<PatchEdge> edges;
  if (along_v)
    for (int j = 0; j < sheet.count_v; ++j)
      edges.push_back({(edge.side == Side::u0 ? 0 : sheet.count_u - 1) + sheet.count_u * j, edge.side});
  else
    for (int i = 0; i < sheet.count_u; ++i)
      edges.push_back({i + sheet.count_u * (edge.side == Side::v0 ? 0 : sheet.count_v - 1), edge.side});
  return edges;
}

std::pair<int, Vec2> locate(const Sheet& sheet, const PointAt& point) {
  const int patches = static_cast<int>(sheet.garment.patches.size());
  if (point.patch >= patches)
    reject("patch", fmt::format("there is no patch {}; allowed: 0 to {}", point.patch, patches - 1));
  if (point.patch < 0 && !sheet.grid)
    reject("patch", fmt::format("is required: the sheet has {} patches; allowed: 0 to {}", patches, patches - 1));
  int patch = std::max(0, point.patch);
  Vec2 st = point.at;
  if (point.patch < 0) {
    const auto split = [](double& s, int count, double angle) {
      const int i = std::min(static_cast<int>(s * count), count - 1);
      s = arcParameter(angle, s * count - i);
      return i;
    };
    const int i = split(st.x, sheet.count_u, sheet.angle_u_rad), j = split(st.y, sheet.count_v, sheet.angle_v_rad);
    patch = i + sheet.count_u * j;
  }
  const NurbsPatch& p = sheet.garment.patches[static_cast<std::size_t>(patch)];
  return {patch, {atFraction(p.u, st.x), atFraction(p.v, st.y)}};
}

double edgeLength(const Sheet& sheet, const EdgeAt& edge) {
  double length = 0;
  for (const PatchEdge& e : edgesOf(sheet, edge)) {
    const NurbsPatch& p = sheet.garment.patches[static_cast<std::size_t>(e.patch)];
    const bool along_v = e.side == Side::u0 || e.side == Side::u1;
    const KnotVector& k = along_v ? p.v : p.u;
    const double fixed = e.side == Side::u0   ? p.u.front()
                         : e.side == Side::u1 ? p.u.back()
                         : e.side == Side::v0 ? p.v.front()
                                              : p.v.back();
    const std::vector<double> ends = breakpoints(k);
    const Quadrature rule = gaussLegendre(8);
    for (std::size_t s = 0; s + 1 < ends.size(); ++s)
      for (std::size_t i = 0; i < rule.points.size(); ++i) {
        const double t = ends[s] + (ends[s + 1] - ends[s]) * rule.points[i];
        const std::array<Vec3, 6> x = along_v ? surfaceDerivatives(p, fixed, t) : surfaceDerivatives(p, t, fixed);
        length += rule.weights[i] * (ends[s + 1] - ends[s]) * norm(along_v ? x[2] : x[1]);
      }
  }
  return length;
}

}  // namespace gambeson
