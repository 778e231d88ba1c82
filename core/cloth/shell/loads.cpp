#include "core/cloth/shell/loads.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/cloth/shell/edge.hpp"
#include "core/cloth/shell/fields.hpp"
#include "core/cloth/shell/free_blocks.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

void checkFinite(const Vec3& v, const char* key) {
  if (!std::isfinite(v.x + v.y + v.z)) throw InputError({"", 0, key}, "must be finite");
}

void checkPatch(const Garment& garment, int patch, const char* key) {
  if (patch < 0 || patch >= static_cast<int>(garment.patches.size()))
    throw InputError({"", 0, key}, "patch " + std::to_string(patch) + " does not exist");
}

/// Adds ∫ N b dA over one patch at rest; b(uv) [N/m^2].
template <class F>
void addSurface(const Garment& garment, int patch, F&& b, std::vector<Vec3>& force) {
  const NurbsPatch& p = garment.patches[patch];
  const int offset = controlOffsets(garment)[patch];
  for (const SheetCell& cell : sheetCells(garment)) {
    if (cell.patch != patch) continue;
    for (const CellPoint& point : cellRule(cell, p.u.degree + 1, p.v.degree + 1)) {
      const SurfaceBasis basis = surfaceBasis(p, point.u, point.v);
      const Vec3 area =
          cross(combine(basis.columns, basis.values[1], p.points), combine(basis.columns, basis.values[2], p.points));
      const Vec3 f = norm(area) * point.weight * b(Vec2{point.u, point.v});
      for (std::size_t k = 0; k < basis.columns.size(); ++k) force[offset + basis.columns[k]] += basis.values[0][k] * f;
    }
  }
}

std::vector<Vec3> zeroForce(const Garment& garment) { return std::vector<Vec3>(controlOffsets(garment).back()); }

/// a bᵀ, added.
void addOuter(std::array<double, 9>& m, double scale, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[3 * i + j] += scale * a[i] * b[j];
}

}  // namespace

std::vector<Vec3> edgeForce(const Garment& garment, const PatchEdge& edge, const Vec3& force_N_per_m) {
  checkEdge(garment, edge, "edge load");
  checkFinite(force_N_per_m, "edge load");
  std::vector<Vec3> force = zeroForce(garment);
  for (const EdgePoint& point : edgePoints(garment, edge)) {
    const EdgeBasis basis = edgeBasis(garment, edge, point.t);
    for (std::size_t k = 0; k < basis.columns.size(); ++k)
      force[basis.columns[k]] += basis.value[k] * point.length_m * force_N_per_m;
  }
  return force;
}

std::vector<Vec3> surfaceForce(const Garment& garment, int patch, const Vec3& force_N_per_m2) {
  checkPatch(garment, patch, "surface load");
  checkFinite(force_N_per_m2, "surface load");
  std::vector<Vec3> force = zeroForce(garment);
  addSurface(
      garment, patch, [&](Vec2) { return force_N_per_m2; }, force);
  return force;
}

std::vector<Vec3> garmentForce(const Garment& garment, const Vec3& force_N_per_m2) {
  checkFinite(force_N_per_m2, "surface load");
  std::vector<Vec3> force = zeroForce(garment);
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p)
    addSurface(
        garment, p, [&](Vec2) { return force_N_per_m2; }, force);
  return force;
}

std::vector<Vec3> pointForce(const Garment& garment, int patch, Vec2 uv, const Vec3& force_N) {
  checkPoint(garment, patch, uv, "point load");
  checkFinite(force_N, "point load");
  const SurfaceBasis basis = surfaceBasis(garment.patches[patch], uv.x, uv.y);
  const int offset = controlOffsets(garment)[patch];
  std::vector<Vec3> force = zeroForce(garment);
  for (std::size_t k = 0; k < basis.columns.size(); ++k)
    force[offset + basis.columns[k]] += basis.values[0][k] * force_N;
  return force;
}

std::vector<Vec3> weightForce(const Garment& garment, const Vec3& gravity_m_per_s2) {
  checkFinite(gravity_m_per_s2, "gravity");
  std::vector<Vec3> force = zeroForce(garment);
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p)
    addSurface(
        garment, p, [&](Vec2 uv) { return surfaceDensityAt(garment, p, uv) * gravity_m_per_s2; }, force);
  return force;
}

std::vector<PressureLoad> garmentPressure(const Garment& garment, double pressure_Pa, int program) {
  std::vector<PressureLoad> loads;
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p) loads.push_back({p, pressure_Pa, program});
  return loads;
}

/// `n` is N (pressure only); `d1`, `d2` are the derivatives in u and v of a pressed patch, or along and into the patch
/// at an edge.
struct Loads::Point {
  std::vector<double> n, d1, d2;
  double weight = 0;  ///< pressure: p du dv [Pa]; moment: m ds [N m]
};

struct Loads::Element {
  int program = 0;
  bool pressure = false;
  std::vector<int> columns;
  std::vector<Point> points;

  void add(std::span<const Vec3> q, double value, std::span<Vec3> f) const;
  /// Adds - value df_I/dq_J, not symmetrised, to blocks[I * n + J].
  void addStiffness(std::span<const Vec3> q, double value, std::vector<std::array<double, 9>>& blocks) const;
};

namespace {

/// What an edge moment needs at a point. With t = x,t/|x,t| along the edge, x,c into the patch, k = x,c . x,t/|x,t|^2
/// and n = (x,t x x,c)/J, J = |x,t x x,c|, the conormal into the patch is b = n x t, and the surface derivative of N
/// along b is  g = |x,t|/J (N,c - k N,t).
struct EdgeKinematics {
  Vec3 xt, xc, n, contra_t, contra_c;  ///< contravariant base vectors
  double length, J, k;
  EdgeKinematics(const Vec3& along, const Vec3& inward) : xt(along), xc(inward) {
    const Vec3 area = cross(xt, xc);
    J = norm(area);
    n = area / J;
    length = norm(xt);
    k = dot(xc, xt) / (length * length);
    contra_t = cross(xc, n) / J;
    contra_c = cross(n, xt) / J;
  }
};

}  // namespace

/// Pressure: f_I = p ∫ N_I (x,u x x,v) du dv, as a3 dA = x,u x x,v du dv.
/// Moment: dw = (t x a3) . da3 with da3 = - a^a (a3 . da_a). The product does not change where n, which is a3 or - a3,
/// takes the place of a3; with t x n = - b it is  dw = sum_I g_I n . dq_I,  so that  f_I = m ∫ g_I n ds.
void Loads::Element::add(std::span<const Vec3> q, double value, std::span<Vec3> f) const {
  for (const Point& point : points) {
    const Vec3 x1 = combine(columns, point.d1, q), x2 = combine(columns, point.d2, q);
    if (pressure) {
      const Vec3 push = value * point.weight * cross(x1, x2);
      for (std::size_t k = 0; k < columns.size(); ++k) f[columns[k]] += point.n[k] * push;
    } else {
      const EdgeKinematics e(x1, x2);
      const Vec3 push = value * point.weight * e.length / e.J * e.n;
      for (std::size_t k = 0; k < columns.size(); ++k) f[columns[k]] += (point.d2[k] - e.k * point.d1[k]) * push;
    }
  }
}

/// Pressure: d(x,u x x,v) = N_J,u dq x x,v + x,u x N_J,v dq.
/// Moment: with t_J = N_J,a a^a: dn = - t_J (n . dq_J),
/// dJ = J t_J . dq, d|x,t| = N_J,t t . dq, dk = ((N_J,c x,t + N_J,t x,c) - 2 k N_J,t x,t) . dq/|x,t|^2.
void Loads::Element::addStiffness(std::span<const Vec3> q, double value,
                                  std::vector<std::array<double, 9>>& blocks) const {
  const std::size_t n = columns.size();
  for (const Point& point : points) {
    const Vec3 x1 = combine(columns, point.d1, q), x2 = combine(columns, point.d2, q);
    const double w = value * point.weight;
    if (pressure) {
      for (std::size_t J = 0; J < n; ++J) {
        const Vec3 a = point.d2[J] * x1 - point.d1[J] * x2;  // d(x1 x x2) = a x dq_J
        for (std::size_t I = 0; I < n; ++I) {
          const double s = -w * point.n[I];
          std::array<double, 9>& m = blocks[I * n + J];
          m[1] -= s * a.z, m[2] += s * a.y;
          m[3] += s * a.z, m[5] -= s * a.x;
          m[6] -= s * a.y, m[7] += s * a.x;
        }
      }
      continue;
    }
    const EdgeKinematics e(x1, x2);
    const double factor = e.length / e.J, length2 = e.length * e.length;
    for (std::size_t J = 0; J < n; ++J) {
      const Vec3 tJ = point.d1[J] * e.contra_t + point.d2[J] * e.contra_c;
      const Vec3 scale = point.d1[J] / length2 * e.xt - tJ;  // d(factor)/factor
      const Vec3 dk = ((point.d2[J] - 2 * e.k * point.d1[J]) * e.xt + point.d1[J] * e.xc) / length2;
      for (std::size_t I = 0; I < n; ++I) {
        const double g = factor * (point.d2[I] - e.k * point.d1[I]);
        std::array<double, 9>& m = blocks[I * n + J];
        addOuter(m, -w, e.n, g * scale - factor * point.d1[I] * dk);
        addOuter(m, w * g, tJ, e.n);
      }
    }
  }
}

Loads::Loads(const Garment& garment, std::vector<DeadLoad> dead, std::vector<PressureLoad> pressure,
             std::vector<EdgeMoment> moments)
    : control_count_(controlOffsets(garment).back()), dead_(std::move(dead)) {
  const auto useProgram = [&](int program) {
    if (program < 0) throw InputError({"", 0, "load"}, "needs a program");
    programs_ = std::max(programs_, program + 1);
  };
  for (const DeadLoad& load : dead_) {
    useProgram(load.program);
    if (static_cast<int>(load.force_N.size()) != control_count_)
      throw InputError({"", 0, "load"}, "has " + std::to_string(load.force_N.size()) + " forces for " +
                                            std::to_string(control_count_) + " control points");
    for (const Vec3& f : load.force_N) checkFinite(f, "load");
  }

  const std::vector<int> offsets = controlOffsets(garment);
  std::vector<SheetCell> cells;
  if (!pressure.empty()) cells = sheetCells(garment);
  for (const PressureLoad& load : pressure) {
    checkPatch(garment, load.patch, "pressure");
    useProgram(load.program);
    if (!std::isfinite(load.pressure_Pa)) throw InputError({"", 0, "pressure"}, "must be finite");
    const NurbsPatch& patch = garment.patches[load.patch];
    // N (x,u x x,v) of a polynomial patch has the degree 3p - 1 in u, 3q - 1 in v: integrated exactly, so that the
    // force is the gradient of the enclosed volume to rounding. A rational one converges; it takes a point more.
    const bool rational =
        std::any_of(patch.weights.begin(), patch.weights.end(), [&](double w) { return w != patch.weights.front(); });
    const int gu = std::max(patch.u.degree + 1, (3 * patch.u.degree + 1) / 2) + rational;
    const int gv = std::max(patch.v.degree + 1, (3 * patch.v.degree + 1) / 2) + rational;
    for (const SheetCell& cell : cells) {
      if (cell.patch != load.patch) continue;
      Element element;
      element.program = load.program;
      element.pressure = true;
      for (const CellPoint& point : cellRule(cell, gu, gv)) {
        const SurfaceBasis basis = surfaceBasis(patch, point.u, point.v);
        if (element.columns.empty())
          for (int column : basis.columns) element.columns.push_back(offsets[load.patch] + column);
        element.points.push_back({basis.values[0], basis.values[1], basis.values[2], load.pressure_Pa * point.weight});
      }
      elements_.push_back(std::make_shared<const Element>(std::move(element)));
    }
  }

  for (const EdgeMoment& load : moments) {
    checkEdge(garment, load.edge, "edge moment");
    useProgram(load.program);
    if (!std::isfinite(load.moment_N)) throw InputError({"", 0, "edge moment"}, "must be finite");
    const std::vector<Vec3> Q = restControls(garment);
    std::vector<Element> pieces;
    for (const EdgePoint& point : edgePoints(garment, load.edge)) {
      EdgeBasis basis = edgeBasis(garment, load.edge, point.t);
      const Vec3 xt = combine(basis.columns, basis.along, Q), xc = combine(basis.columns, basis.inward, Q);
      if (!(norm(cross(xt, xc)) > 1e-9 * (norm2(xt) + norm2(xc))))
        throw InputError({"", 0, "edge moment"}, "the rest surface has no normal on " + edgeName(load.edge));
      if (pieces.empty() || pieces.back().columns != basis.columns) {
        pieces.emplace_back();
        pieces.back().program = load.program;
        pieces.back().columns = basis.columns;
      }
      pieces.back().points.push_back(
          {{}, std::move(basis.along), std::move(basis.inward), load.moment_N * point.length_m});
    }
    for (Element& piece : pieces) elements_.push_back(std::make_shared<const Element>(std::move(piece)));
  }
}

void Loads::add(std::span<const Vec3> q, std::span<const double> value, std::span<Vec3> f) const {
  assert(static_cast<int>(q.size()) == control_count_ && q.size() == f.size());
  assert(static_cast<int>(value.size()) >= programs_);
  for (const DeadLoad& load : dead_)
    for (std::size_t i = 0; i < f.size(); ++i) f[i] += value[load.program] * load.force_N[i];
  for (const auto& element : elements_)
    if (value[element->program] != 0) element->add(q, value[element->program], f);
}

void Loads::addStiffness(std::span<const Vec3> q, std::span<const double> value, const FreeMap& map,
                         BlockMatrix& K) const {
  assert(static_cast<int>(value.size()) >= programs_);
  std::vector<std::array<double, 9>> blocks;
  for (const auto& element : elements_) {
    if (value[element->program] == 0) continue;
    blocks.assign(element->columns.size() * element->columns.size(), {});
    element->addStiffness(q, value[element->program], blocks);
    addSymmetrised(map, element->columns, blocks, K);
  }
}

}  // namespace gambeson
