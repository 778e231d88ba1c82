#include "cases/cad/tidy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/quadrature.hpp"
#include "core/nurbs/trim_arcs.hpp"
#include "core/nurbs/trim_faces.hpp"

namespace gambeson {
namespace {

constexpr double kLargest_m = 1000;         ///< coordinates, as of meshes
constexpr double kSameArea = 1e-3;          ///< of OpenCASCADE's area
constexpr double kNear = 1e-7;              ///< of the patch's range: nothing
constexpr double kFar = 1e-2;               ///< of it: more than a tolerance can explain
constexpr std::size_t kMostCurves = 20000;  ///< of a face

void turn(CadFace& f) {
  NurbsPatch p{f.patch.v, f.patch.u, {}, {}};
  for (int j = 0; j < p.v.count(); ++j)
    for (int i = 0; i < p.u.count(); ++i) {
      const auto from = static_cast<std::size_t>(f.patch.index(j, i));
      p.points.push_back(f.patch.points[from]);
      p.weights.push_back(f.patch.weights[from]);
    }
  f.patch = std::move(p);
  for (TrimLoop& loop : f.loops) {
    std::reverse(loop.begin(), loop.end());
    for (NurbsCurve& c : loop) {
      c = reversed(c);
      for (Vec2& x : c.points) std::swap(x.x, x.y);
    }
  }
  f.inside_out = false;
}

/// What is near the border of a patch, in its parameters.
class Border {
 public:
  explicit Border(const CadFace& f)
      : patch_(f.patch),
        tolerance_m_(std::max(f.tolerance_m, 1e-7)),
        low_{f.patch.u.front(), f.patch.v.front()},
        high_{f.patch.u.back(), f.patch.v.back()} {}

  Vec2 range() const { return {high_.x - low_.x, high_.y - low_.y}; }
  /// Lengths in u and in v that the tolerance is at a point.
  Vec2 nearAt(Vec2 p) const {
    const auto d = surfaceDerivatives(patch_, std::clamp(p.x, low_.x, high_.x), std::clamp(p.y, low_.y, high_.y));
    const Vec2 r = range();
    const auto length = [&](double speed, double whole) {
      return std::clamp(tolerance_m_ / std::max(speed, 1e-300), kNear * whole, 0.1 * kFar * whole);
    };
    return {length(norm(d[1]), r.x), length(norm(d[2]), r.y)};
  }
  Vec2 snapped(Vec2 p) const {
    const Vec2 near = nearAt(p);
    return {snapped(p.x, low_.x, high_.x, near.x), snapped(p.y, low_.y, high_.y, near.y)};
  }
  /// A curve that runs along the border lies on it, all of it.
  void lay(NurbsCurve& c) const {
    const Vec2 near = nearAt(c.points.front());
    for (const double at : {low_.x, high_.x})
      if (std::all_of(c.points.begin(), c.points.end(), [&](Vec2 p) { return std::abs(p.x - at) <= near.x; }))
        for (Vec2& p : c.points) p.x = at;
    for (const double at : {low_.y, high_.y})
      if (std::all_of(c.points.begin(), c.points.end(), [&](Vec2 p) { return std::abs(p.y - at) <= near.y; }))
        for (Vec2& p : c.points) p.y = at;
  }
  /// Points that the tolerance puts outside of the patch come back.
  void keepInside(NurbsCurve& c) const {
    for (Vec2& p : c.points) {
      const Vec2 near = nearAt(p);
      const auto kept = [](double x, double low, double high, double most) {
        return x < low && x > low - most ? low : x > high && x < high + most ? high : x;
      };
      p = {kept(p.x, low_.x, high_.x, 10 * near.x), kept(p.y, low_.y, high_.y, 10 * near.y)};
    }
  }
  bool has(const NurbsCurve& c) const {
    const auto all = [&](auto on) { return std::all_of(c.points.begin(), c.points.end(), on); };
    return all([&](Vec2 p) { return p.x == low_.x; }) || all([&](Vec2 p) { return p.x == high_.x; }) ||
           all([&](Vec2 p) { return p.y == low_.y; }) || all([&](Vec2 p) { return p.y == high_.y; });
  }

 private:
  static double snapped(double x, double low, double high, double near) {
    return std::abs(x - low) <= near ? low : std::abs(x - high) <= near ? high : x;
  }
  const NurbsPatch& patch_;
  double tolerance_m_;
  Vec2 low_, high_;
};

void closeLoop(const Border& border, TrimLoop& loop) {
  for (NurbsCurve& c : loop) {
    border.lay(c);
    border.keepInside(c);
  }
  for (std::size_t k = 0; k < loop.size(); ++k) {
    Vec2 &end = loop[k].points.back(), &start = loop[(k + 1) % loop.size()].points.front();
    const Vec2 whole = border.range();
    if (std::abs(end.x - start.x) > kFar * whole.x || std::abs(end.y - start.y) > kFar * whole.y)
      throw InputError({"", 0, ""}, "has a border that is open in the parameters of its surface");
    end = start = border.snapped({0.5 * (end.x + start.x), 0.5 * (end.y + start.y)});
  }
}

void check(const CadFace& f) {
  for (const Vec3& x : f.patch.points)
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(x[c]) <= kLargest_m))
        throw InputError({"", 0, ""}, fmt::format("has a control point at {:g} m; allowed: within 1000 m of the origin "
                                                  "(does the file say the right unit?)",
                                                  x[c]));
  validate(f.patch);
  std::size_t curves = 0;
  for (const TrimLoop& loop : f.loops) curves += loop.size();
  if (curves > kMostCurves) throw InputError({"", 0, ""}, "has a border of more than 20,000 curves");
}

}  // namespace

bool isWhole(const CadFace& f) {
  if (f.loops.empty()) return true;
  if (f.loops.size() > 1) return false;
  const Border border(f);
  if (!std::all_of(f.loops[0].begin(), f.loops[0].end(), [&](const NurbsCurve& c) { return border.has(c); }))
    return false;
  double twice = 0;  // its corners lie on the border, so its area is that of straight lines
  for (const NurbsCurve& c : f.loops[0]) {
    const Vec2 a = c.points.front(), b = c.points.back();
    twice += a.x * b.y - b.x * a.y;
  }
  const Vec2 r = border.range();
  return std::abs(0.5 * twice - r.x * r.y) <= 1e-9 * r.x * r.y;
}

Trim trimOf(const CadFace& f) { return isWhole(f) ? Trim{} : Trim{f.loops}; }

std::vector<CadFace> cadFaces(const std::string& name, const NurbsPatch& patch, const Trim& trim) {
  std::vector<CadFace> out;
  for (const Trim& face : facesOf(patch, trim)) {
    CadFace& f = out.emplace_back();
    f.name = name;
    f.patch = patch;
    const bool holes_alone = !face.loops.empty() && trimBoundary(patch, face).rectangle_is_outline;
    if (holes_alone) {
      const double u0 = patch.u.front(), u1 = patch.u.back(), v0 = patch.v.front(), v1 = patch.v.back();
      const Vec2 corners[] = {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
      f.loops.push_back(polygon(corners));
    }
    f.loops.insert(f.loops.end(), face.loops.begin(), face.loops.end());
  }
  return out;
}

double areaOf(const NurbsPatch& p, const Trim& given) {
  Trim trim = given;
  const int n = std::max(p.u.degree, p.v.degree) + 6;
  trim.points_per_piece = std::min(n, 20);
  const Quadrature rule = gaussLegendre(n);
  const std::vector<double> us = breakpoints(p.u), vs = breakpoints(p.v);
  const auto at = [&](double u, double v) {
    const auto d = surfaceDerivatives(p, u, v);
    return norm(cross(d[1], d[2]));
  };
  double area = 0;
  std::size_t k = 0;
  for (const TrimmedCell& cell : trimCells(p, trim)) {
    const std::size_t i = k % (us.size() - 1), j = k / (us.size() - 1);
    ++k;
    for (const CellPoint& g : cell.points) area += g.weight * at(g.u, g.v);
    if (cell.kind != CellKind::inside) continue;
    const double du = us[i + 1] - us[i], dv = vs[j + 1] - vs[j];
    for (std::size_t a = 0; a < rule.points.size(); ++a)
      for (std::size_t b = 0; b < rule.points.size(); ++b)
        area +=
            du * dv * rule.weights[a] * rule.weights[b] * at(us[i] + du * rule.points[a], vs[j] + dv * rule.points[b]);
  }
  return area;
}

void tidyFaces(CadShape& shape) {
  for (CadSeam& s : shape.seams)
    for (CadSide* side : {&s.a, &s.b}) {
      const CadFace& f = shape.faces.at(static_cast<std::size_t>(side->face));
      const TrimLoop& loop = f.loops.at(static_cast<std::size_t>(side->loop));
      if (f.inside_out) side->curve = static_cast<int>(loop.size()) - 1 - side->curve;
    }
  for (std::size_t k = 0; k < shape.faces.size(); ++k) {
    CadFace& f = shape.faces[k];
    try {
      check(f);
      if (f.inside_out) turn(f);
      const Border border(f);
      for (TrimLoop& loop : f.loops) {
        for (const NurbsCurve& c : loop) validate(c);
        closeLoop(border, loop);
      }
      const double area = areaOf(f.patch, trimOf(f));
      if (!(std::abs(area - f.area_m2) <= kSameArea * f.area_m2))
        throw InputError({"", 0, ""}, fmt::format("has {:.6g} cm^2 within its border, and {:.6g} cm^2 for OpenCASCADE: "
                                                  "its border does not fit its surface",
                                                  1e4 * area, 1e4 * f.area_m2));
    } catch (const InputError& e) {
      std::string key = fmt::format("face {}", k + 1);
      if (!f.name.empty()) key += " (" + f.name + ")";
      if (!e.where().key.empty()) key += ": " + e.where().key;
      throw InputError({"", 0, key}, e.reason());
    }
  }
}

}  // namespace gambeson
