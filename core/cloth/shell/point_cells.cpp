#include "core/cloth/shell/point_cells.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cloth/patches/rest_frame.hpp"
#include "core/cloth/shell/shell_pack.hpp"
#include "core/cloth/tensile.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr std::array<double, 36> kNotAsked{};

using Slopes = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// Derivatives in the parameters, turned to the physical basis.
template <class T>
std::array<T, 5> physical(const RestFrame& G, const T& d1, const T& d2, const T& d11, const T& d22, const T& d12) {
  return {G.G11 * d1 + G.G21 * d2, G.G12 * d1 + G.G22 * d2,
          G.G11 * G.G11 * d11 + 2 * G.G11 * G.G21 * d12 + G.G21 * G.G21 * d22,
          G.G12 * G.G12 * d11 + 2 * G.G12 * G.G22 * d12 + G.G22 * G.G22 * d22,
          G.G11 * G.G12 * d11 + (G.G11 * G.G22 + G.G21 * G.G12) * d12 + G.G21 * G.G22 * d22};
}

Vec2 fractionOf(const NurbsPatch& patch, double u, double v) {
  const auto part = [](const KnotVector& k, double t) {
    const std::vector<double> ends = breakpoints(k);
    return (t - ends.front()) / (ends.back() - ends.front());
  };
  return {part(patch.u, u), part(patch.v, v)};
}

/// The nearest positive semidefinite slopes, in units of the diagonal.
void takePositivePart(std::array<double, 36>& slope) {
  Eigen::Matrix<double, 6, 1> unit;
  for (int i = 0; i < 6; ++i) {
    const double size = std::abs(slope[static_cast<std::size_t>(7 * i)]);
    unit[i] = size > 0 ? std::sqrt(size) : 1;
  }
  const Slopes scaled = unit.cwiseInverse().asDiagonal() * Slopes(slope.data()) * unit.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Slopes> solver(scaled);
  if (solver.eigenvalues()[0] >= 0) return;
  Eigen::Map<Slopes>(slope.data()) = unit.asDiagonal() * solver.eigenvectors() *
                                     solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose() *
                                     unit.asDiagonal();
}

/// a - b of all that an answer has.
SheetAnswer without(const SheetAnswer& a, const SheetAnswer& b) {
  SheetAnswer out = a;
  out.energy_J_per_m2 -= b.energy_J_per_m2;
  for (std::size_t i = 0; i < 3; ++i) out.resultant[i] -= b.resultant[i], out.moment[i] -= b.moment[i];
  for (std::size_t i = 0; i < 36; ++i) out.slope[i] -= b.slope[i];
  return out;
}

/// The energy of the strain alone.
void dropMoments(SheetAnswer& a) {
  a.moment = {};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      if (i > 2 || j > 2) a.slope[6 * i + j] = 0;
}

SheetAnswer linear(const std::array<double, 36>& slope, const SheetStrain& at, const ForceTerms& terms) {
  SheetAnswer out;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      if (!((i < 3 ? terms.membrane : terms.bending) && (j < 3 ? terms.membrane : terms.bending))) continue;
      out.slope[6 * i + j] = slope[6 * i + j];
      const double part = slope[6 * i + j] * (j < 3 ? at.strain[j] : at.curvature[j - 3]);
      (i < 3 ? out.resultant[i] : out.moment[i - 3]) += part;
      out.energy_J_per_m2 += 0.5 * part * (i < 3 ? at.strain[i] : at.curvature[i - 3]);
    }
  return out;
}

}  // namespace

/// The physical basis of a deformed point.
struct PointCells::Deformed {
  Vec3 e1, e2, y11, y22, y12, n, dual1, dual2;
  SheetStrain strain;
};

struct PointCells::Work {
  std::vector<Deformed> deformed;
  std::vector<SheetStrain> strains;
  std::vector<SheetAnswer> answers, flat;
  std::vector<double> history, remembered;
};

PointCells::PointCells(const Garment& garment, const std::vector<int>& offsets, const std::vector<SheetCell>& cells,
                       std::array<int, 2> rule, BlockLayout layout, std::shared_ptr<const PointEnergy> energy,
                       bool of_shape)
    : layout_(std::move(layout)), energy_(std::move(energy)) {
  for (const SheetCell& from : cells) {
    const NurbsPatch& patch = garment.patches[static_cast<std::size_t>(from.patch)];
    const int p = patch.u.degree, q = patch.v.degree;
    Cell& cell = cells_.emplace_back();
    for (int k = 0; k < (p + 1) * (q + 1); ++k)
      cell.nodes.push_back(offsets[static_cast<std::size_t>(from.patch)] +
                           patch.index(from.su - p + k % (p + 1), from.sv - q + k / (p + 1)));
    for (const CellPoint& at : cellRule(from, rule[0], rule[1])) {
      const CellBasis basis = cellBasis(patch, from, at.u, at.v);
      const auto& d = basis.rest;
      const RestFrame G = restFrame(d[1], d[2], garment.weft[static_cast<std::size_t>(from.patch)],
                                    fibreAngleAt(garment, from.patch, {at.u, at.v}));
      Point& point = cell.points.emplace_back();
      point.area_m2 = G.area * at.weight;
      point.patch = from.patch;
      point.fraction = fractionOf(patch, at.u, at.v);
      if (of_shape) {
        const Vec3 k = curvature(G, d[1], d[2], d[3], d[4], d[5]);
        point.rest_curvature = {k.x, k.y, 2 * k.z};
      }
      const auto& N = basis.rational;
      for (std::size_t k = 0; k < cell.nodes.size(); ++k)
        point.shapes.push_back(physical(G, N[1][k], N[2][k], N[3][k], N[4][k], N[5][k]));
    }
  }
}

PointCells::Deformed PointCells::deformed(const Cell& cell, const Point& point, std::span<const Vec3> q) const {
  Deformed d{};
  for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
    const Vec3& x = q[static_cast<std::size_t>(cell.nodes[k])];
    const std::array<double, 5>& N = point.shapes[k];
    d.e1 += N[0] * x;
    d.e2 += N[1] * x;
    d.y11 += N[2] * x;
    d.y22 += N[3] * x;
    d.y12 += N[4] * x;
  }
  const double C11 = dot(d.e1, d.e1), C22 = dot(d.e2, d.e2), C12 = dot(d.e1, d.e2);
  const Vec3 normal_j = cross(d.e1, d.e2);
  const double inv_j2 = 1 / dot(normal_j, normal_j);
  d.n = std::sqrt(inv_j2) * normal_j;
  d.dual1 = inv_j2 * (C22 * d.e1 - C12 * d.e2);
  d.dual2 = inv_j2 * (C11 * d.e2 - C12 * d.e1);
  d.strain.strain = {0.5 * (C11 - 1), 0.5 * (C22 - 1), C12};
  d.strain.curvature = {dot(d.n, d.y11), dot(d.n, d.y22), 2 * dot(d.n, d.y12)};
  for (std::size_t i = 0; i < 3; ++i) d.strain.curvature[i] -= point.rest_curvature[i];
  return d;
}

long PointCells::historyOf(std::size_t cell, std::size_t point) const {
  const auto lanes = static_cast<std::size_t>(layout_.lanes);
  const std::size_t first = static_cast<std::size_t>(layout_.first_point[cell / lanes]) + point;
  return layout_.history_first + static_cast<long>(first * energy_->historySize() * lanes + cell % lanes);
}

void PointCells::answer(std::size_t cell, const ClothState& state, const ForceTerms& terms, SheetParts parts,
                        bool remember, const std::array<double, 36>& steepest, Work& w) const {
  const Cell& c = cells_[cell];
  const std::size_t n = c.points.size(), each = energy_->historySize();
  w.deformed.clear();
  w.strains.clear();
  for (const Point& point : c.points) {
    w.deformed.push_back(deformed(c, point, state.q));
    w.strains.push_back(w.deformed.back().strain);
  }
  w.answers.assign(n, {});
  if (terms.steepest) {
    for (std::size_t i = 0; i < n; ++i) w.answers[i] = linear(steepest, w.strains[i], terms);
    return;
  }
  w.history.clear();
  if (!state.history.empty() && each > 0)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < each; ++k)
        w.history.push_back(
            state.history[static_cast<std::size_t>(historyOf(cell, i)) + k * static_cast<std::size_t>(layout_.lanes)]);
  w.remembered.assign(remember ? n * each : 0, 0.0);
  if (terms.bending) energy_->evaluate(w.strains, parts, w.history, w.remembered, w.answers);
  if (terms.membrane && terms.bending) return;
  for (SheetStrain& s : w.strains) s.curvature = {};
  w.flat.assign(n, {});
  energy_->evaluate(w.strains, parts, w.history, {}, w.flat);
  for (std::size_t i = 0; i < n; ++i) {
    dropMoments(w.flat[i]);
    w.answers[i] = terms.membrane ? w.flat[i] : without(w.answers[i], w.flat[i]);
  }
}

void PointCells::force(const ClothState& state, const ClothForce& out, const ForceTerms& terms, const StrainBox& within,
                       double* slots) const {
  const std::array<double, 36> steepest = terms.steepest ? energy_->steepest(within) : kNotAsked;
  std::vector<double> stored(out.energy ? cells_.size() : 0);
  const bool remember = !out.history.empty() && energy_->historySize() > 0 && terms.bending && !terms.steepest;
  forAllWith<Work>(Each::much, 0, static_cast<int>(cells_.size()), [&](Work& w, int number) {
    const auto cell = static_cast<std::size_t>(number), lanes = static_cast<std::size_t>(layout_.lanes);
    const Cell& c = cells_[cell];
    answer(cell, state, terms, SheetParts::resultants, remember, steepest, w);
    std::vector<Vec3> f(c.nodes.size());
    double energy = 0;
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const Deformed& d = w.deformed[i];
      const SheetAnswer& a = w.answers[i];
      const double dA = c.points[i].area_m2;
      energy += dA * a.energy_J_per_m2;
      const auto& [n, m] = std::pair(a.resultant, a.moment);
      const double g1 = m[0] * dot(d.y11, d.dual1) + m[1] * dot(d.y22, d.dual1) + 2 * m[2] * dot(d.y12, d.dual1);
      const double g2 = m[0] * dot(d.y11, d.dual2) + m[1] * dot(d.y22, d.dual2) + 2 * m[2] * dot(d.y12, d.dual2);
      const Vec3 f1 = dA * (n[0] * d.e1 + n[2] * d.e2 - g1 * d.n), f2 = dA * (n[2] * d.e1 + n[1] * d.e2 - g2 * d.n);
      const Vec3 bent = dA * d.n;
      for (std::size_t k = 0; k < f.size(); ++k) {
        const std::array<double, 5>& N = c.points[i].shapes[k];
        f[k] += N[0] * f1 + N[1] * f2 + (m[0] * N[2] + m[1] * N[3] + 2 * m[2] * N[4]) * bent;
      }
      for (std::size_t h = 0; remember && h < energy_->historySize(); ++h)
        out.history[static_cast<std::size_t>(historyOf(cell, i)) + h * lanes] =
            w.remembered[i * energy_->historySize() + h];
    }
    double* to = slots + (cell / lanes) * f.size() * 3 * lanes + cell % lanes;
    for (std::size_t k = 0; k < f.size(); ++k)
      for (int x = 0; x < 3; ++x) to[(3 * k + static_cast<std::size_t>(x)) * lanes] = f[k][x];
    if (out.energy) stored[cell] = energy;
  });
  for (double e : stored) out.energy->stored += e;
}

void PointCells::tangent(const ClothState& state, const ForceTerms& terms, int first, int count, double* pairs) const {
  const int lanes = layout_.lanes, end = std::min((first + count) * lanes, static_cast<int>(cells_.size()));
  const std::array<double, 36> steepest = terms.steepest ? energy_->steepest() : kNotAsked;
  forAllWith<Work>(Each::much, first * lanes, end, [&](Work& w, int number) {
    const auto cell = static_cast<std::size_t>(number);
    const Cell& c = cells_[cell];
    const std::size_t nn = c.nodes.size(), stride = static_cast<std::size_t>(lanes);
    answer(cell, state, terms, SheetParts::slopes, false, steepest, w);
    std::vector<std::array<double, 9>> K(nn * (nn + 1) / 2);
    struct Rows {
      std::array<std::array<double, 3>, 6> of;  ///< of the strains and the curvatures by the node's place
      Vec3 t;
      double mu = 0, p1 = 0, p2 = 0;
    };
    std::vector<Rows> rows(nn);
    std::vector<std::array<std::array<double, 3>, 6>> changes(nn);
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const Deformed& d = w.deformed[i];
      SheetAnswer& a = w.answers[i];
      const double dA = c.points[i].area_m2;
      if (terms.definite) takePositivePart(a.slope);
      std::array<double, 3> n{}, m{};
      for (std::size_t k = 0; k < 3; ++k) n[k] = dA * a.resultant[k], m[k] = dA * a.moment[k];
      std::array<double, 3> spreading = n;
      if (terms.definite) tensilePart(n.data(), spreading.data());
      const double Y = m[0] * dot(d.n, d.y11) + m[1] * dot(d.n, d.y22) + 2 * m[2] * dot(d.n, d.y12);
      for (std::size_t k = 0; k < nn; ++k) {
        const std::array<double, 5>& N = c.points[i].shapes[k];
        Rows& r = rows[k];
        r.p1 = N[0], r.p2 = N[1];
        r.t = N[0] * d.dual1 + N[1] * d.dual2;
        const double bend[3] = {N[2] - dot(d.y11, r.t), N[3] - dot(d.y22, r.t), 2 * (N[4] - dot(d.y12, r.t))};
        r.mu = m[0] * bend[0] + m[1] * bend[1] + m[2] * bend[2];
        const Vec3 s[6] = {N[0] * d.e1,   N[1] * d.e2,   N[0] * d.e2 + N[1] * d.e1,
                           bend[0] * d.n, bend[1] * d.n, bend[2] * d.n};
        for (std::size_t v = 0; v < 6; ++v)
          for (int x = 0; x < 3; ++x) r.of[v][static_cast<std::size_t>(x)] = s[v][x];
        changes[k] = {};
        for (std::size_t v = 0; v < 6; ++v)
          for (std::size_t u = 0; u < 6; ++u)
            for (std::size_t x = 0; x < 3; ++x) changes[k][v][x] += dA * a.slope[6 * v + u] * r.of[u][x];
      }
      std::size_t pair = 0;
      for (std::size_t I = 0; I < nn; ++I)
        for (std::size_t J = I; J < nn; ++J, ++pair) {
          const Rows &r = rows[I], &s = rows[J];
          const double spread =
              spreading[0] * r.p1 * s.p1 + spreading[1] * r.p2 * s.p2 + spreading[2] * (r.p1 * s.p2 + r.p2 * s.p1);
          for (int x = 0; x < 3; ++x)
            for (int y = 0; y < 3; ++y) {
              double sum = x == y ? spread : 0;
              for (std::size_t v = 0; v < 6; ++v)
                sum += r.of[v][static_cast<std::size_t>(x)] * changes[J][v][static_cast<std::size_t>(y)];
              if (!terms.definite)
                sum -= r.mu * s.t[x] * d.n[y] + s.mu * d.n[x] * r.t[y] + Y * dot(r.t, s.t) * d.n[x] * d.n[y];
              K[pair][static_cast<std::size_t>(3 * x + y)] += sum;
            }
        }
    }
    const std::size_t group = cell / stride - static_cast<std::size_t>(first);
    double* to = pairs + group * 9 * K.size() * stride + cell % stride;
    for (const std::array<double, 9>& block : K)
      for (double value : block) *to = value, to += stride;
  });
}

StrainBox PointCells::strains(const ClothState& state) const {
  std::vector<StrainBox> of_cell(cells_.size(), StrainBox::none());
  forAll(Each::element, static_cast<int>(cells_.size()), [&](int number) {
    const Cell& cell = cells_[static_cast<std::size_t>(number)];
    for (const Point& point : cell.points) {
      Vec3 e1, e2;
      for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
        const Vec3& x = state.q[static_cast<std::size_t>(cell.nodes[k])];
        e1 += point.shapes[k][0] * x;
        e2 += point.shapes[k][1] * x;
      }
      const std::array<double, 3> at{0.5 * (dot(e1, e1) - 1), 0.5 * (dot(e2, e2) - 1), dot(e1, e2)};
      of_cell[static_cast<std::size_t>(number)].add({at, at});
    }
  });
  StrainBox all = StrainBox::none();
  for (const StrainBox& own : of_cell) all.add(own);
  return all;
}

LawRange PointCells::range(const ClothState& state) const {
  std::vector<LawRange> of_cell(cells_.size());
  forAllWith<Work>(Each::much, 0, static_cast<int>(cells_.size()), [&](Work& w, int number) {
    const auto cell = static_cast<std::size_t>(number);
    answer(cell, state, {}, SheetParts::resultants, false, kNotAsked, w);
    LawRange& own = of_cell[cell];
    own.points = static_cast<long>(w.answers.size());
    const std::size_t each = energy_->historySize();
    for (std::size_t i = 0; i < w.answers.size(); ++i) {
      const SheetAnswer& a = w.answers[i];
      const bool unanswered = !std::isfinite(a.energy_J_per_m2);
      own.beyond += a.beyond || unanswered;
      own.unanswered += unanswered;
      if (!unanswered || own.first) continue;
      const Point& point = cells_[cell].points[i];
      const std::span<const double> history =
          w.history.empty() ? std::span<const double>() : std::span<const double>(w.history).subspan(i * each, each);
      own.first = {point.patch, point.fraction, w.strains[i], energy_->whyNone(w.strains[i], history)};
    }
  });
  LawRange all;
  for (const LawRange& own : of_cell) all.add(own);
  return all;
}

}  // namespace gambeson
