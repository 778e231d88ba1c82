#include "core/solid/contact_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gambeson {
namespace {

double diagonalRounding(std::span<const MatrixEntry> entries, int size, double reach_m) {
  std::vector<double> diagonal(size, 0.0);
  for (const MatrixEntry& e : entries)
    if (e.row == e.column) diagonal[e.row] += e.value;
  return std::numeric_limits<double>::epsilon() * norm(diagonal) * reach_m;
}

/// Moves to a point of the line: the whole step, halved while that has no forces; with `search`, if the slope of the
/// energy G(s) has changed its sign there and is not small, to where |G(s)| <= 0.8 |G(0)|, by regula falsi (as
/// core/statics/newton.hpp does). False where no point has forces. `finite`: false where one had none.
template <class SlopeAt>
bool takeStep(const SlopeAt& slopeAt, double slope0, bool search, bool& finite) {
  constexpr int kHalvings = 10, kSearches = 12;
  constexpr double kRatio = 0.8;
  double right = 1, slope = slopeAt(1);
  for (int k = 0; !std::isfinite(slope) && k < kHalvings; ++k) finite = false, slope = slopeAt(right *= 0.5);
  if (!std::isfinite(slope)) return false;
  double left = 0, slope_left = slope0, slope_right = slope;
  for (int k = 0; search && k < kSearches && slope * slope0 < 0 && std::abs(slope) > kRatio * std::abs(slope0); ++k) {
    const double s = std::clamp(left + (right - left) * slope_left / (slope_left - slope_right),
                                left + 0.1 * (right - left), right - 0.1 * (right - left));
    slope = slopeAt(s);
    if (!std::isfinite(slope)) return false;
    if (slope * slope0 > 0) {
      left = s, slope_left = slope, slope_right *= 0.5;  // Illinois
    } else {
      right = s, slope_right = slope, slope_left *= 0.5;
    }
  }
  return true;
}

/// Newton for r(z) = 0: `residual(z, r)` returns the size of the forces, `entries(z)` is the tangent.
template <class Residual, class Entries>
NewtonReport iterate(std::vector<double>& z, const ContactNewton& options, TangentSolver& solver, bool symmetric,
                     bool search, double reach_m, const Residual& residual, const Entries& entries) {
  NewtonReport report;
  std::vector<double> r(z.size()), next(z.size()), step(z.size());
  double force = residual(z, r), rounding = 0;
  for (;; ++report.iterations) {
    const double size = norm(r);
    report.force = std::max(force, options.least_force);
    report.residual = size == 0 ? 0 : size / report.force;
    report.residuals.push_back(report.residual);
    if (!std::isfinite(size)) {
      report.finite = false;
      return report;
    }
    const bool balanced = size <= options.tolerance * report.force;
    if (balanced || endsByRounding(size, report.force, rounding, false)) {
      report.converged = true;
      report.rounded = !balanced;
      return report;
    }
    if (report.iterations == options.iterations) return report;
    const std::vector<MatrixEntry> K = entries(z);
    rounding = diagonalRounding(K, static_cast<int>(z.size()), reach_m);
    ++report.factorisations;
    if (!solver.factorise(K, static_cast<int>(z.size()), symmetric, options.raise)) {
      report.singular = true;
      return report;
    }
    report.negative_pivots = solver.negativePivots();
    solver.solve(r, step);
    const auto slopeAt = [&](double s) {
      for (std::size_t i = 0; i < z.size(); ++i) next[i] = z[i] - s * step[i];
      force = residual(next, r);
      return -dot(step, r);
    };
    const double slope = -dot(step, r);
    if (!takeStep(slopeAt, slope, search, report.finite)) {
      report.finite = false;
      return report;
    }
    z.swap(next);
  }
}

}  // namespace

bool ContactSystem::symmetric() const {
  return contact_.law().friction == 0 || contact_.law().bound == FrictionBound::symmetrised;
}

std::vector<ContactPoint> ContactSystem::points(std::span<const ContactMultipliers> multipliers,
                                                std::span<const double> y, bool all) const {
  return contact_.points(solids_.positions(y, t_), start_, multipliers, all);
}

void ContactSystem::addForce(std::span<const ContactPoint> points, std::span<double> r) const {
  std::vector<Vec3> f(start_.size());
  contact_.addForce(points, f);
  std::vector<double> pulled(r.size());
  solids_.dofs().Ct.multiply<double>({reinterpret_cast<const double*>(f.data()), 3 * f.size()}, pulled);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] += pulled[i];
}

double ContactSystem::residual(std::span<const ContactMultipliers> multipliers, std::span<const double> y,
                               std::span<double> r) {
  const double size = solids_.residual(y, t_, r);
  addForce(points(multipliers, y), r);
  return size;
}

void ContactSystem::addSolids(std::span<const double> y, std::vector<MatrixEntry>& entries) {
  SymmetricMatrix K = solids_.sparsity();
  solids_.stiffness(y, t_, K);
  for (int c = 0; c < K.size; ++c)
    for (int k = K.offsets[c]; k < K.offsets[c + 1]; ++k) {
      entries.push_back({K.rows[k], c, K.values[k]});
      if (K.rows[k] != c) entries.push_back({c, K.rows[k], K.values[k]});
    }
}

void ContactSystem::addBlock(const ContactBlock& block, std::vector<MatrixEntry>& entries) const {
  const SparseRows& C = solids_.dofs().C;
  for (int i = 0; i < kProjectionSize; ++i)
    for (int j = 0; j < kProjectionSize; ++j) {
      const int row = 3 * block.rows[i / 3] + i % 3, column = 3 * block.columns[j / 3] + j % 3;
      for (int a = C.offsets[row]; a < C.offsets[row + 1]; ++a)
        for (int b = C.offsets[column]; b < C.offsets[column + 1]; ++b)
          entries.push_back(
              {C.columns[a], C.columns[b], C.values[a] * C.values[b] * block.values[kProjectionSize * i + j]});
    }
}

std::vector<MatrixEntry> ContactSystem::tangent(std::span<const ContactMultipliers> multipliers,
                                                std::span<const double> y) {
  return tangentOf(points(multipliers, y), y);
}

std::vector<MatrixEntry> ContactSystem::tangentOf(std::span<const ContactPoint> points, std::span<const double> y) {
  std::vector<MatrixEntry> entries;
  addSolids(y, entries);
  for (const ContactBlock& block : contact_.tangent(solids_.positions(y, t_), points)) addBlock(block, entries);
  return entries;
}

void ContactSystem::keepFacets(std::span<const double> y) {
  for (const ContactPoint& p : points(known_, y))
    if (!p.known) known_.push_back({p.side, p.slave, p.facet, p.facet, 0, {}});
}

NewtonReport ContactSystem::solve(std::span<const ContactMultipliers> multipliers, const ContactNewton& options,
                                  std::vector<double>& y) {
  known_.assign(multipliers.begin(), multipliers.end());
  return iterate(
      y, options, solver_, symmetric(), true, solids_.reach(),
      [&](const std::vector<double>& z, std::vector<double>& r) { return residual(known_, z, r); },
      [&](const std::vector<double>& z) {
        if (contact_.law().touch.keep > 0) keepFacets(z);
        return tangent(known_, z);
      });
}

NewtonReport ContactSystem::solveTogether(std::span<ContactMultipliers> pairs, const ContactNewton& options,
                                          std::vector<double>& y) {
  const int n = static_cast<int>(y.size());
  const double eps = contact_.law().normal_Pa_per_m;
  std::vector<double> z = y;
  for (const ContactMultipliers& p : pairs) z.push_back(p.pressure_Pa / eps);
  /// The pairs at x, each over its own facet, continued beyond its edges; false where a node has left it.
  const auto pointsAt = [&](std::span<const Vec3> x, const std::vector<double>& at, std::vector<ContactPoint>& out) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      ContactPoint p;
      p.side = pairs[k].side, p.slave = pairs[k].slave, p.facet = pairs[k].facet;
      p.node = contact_.sides()[p.side].nodes[p.slave];
      p.area_m2 = contact_.sides()[p.side].areas_m2[p.slave];
      p.pressure_Pa = eps * at[n + k];
      const FacetCorners corners = contact_.cornersOf(p.side, p.facet, x);
      const std::optional<Vec2> local = projectOnFacet(corners, x[p.node], kFacetReach);
      if (!local) return false;
      p.over = projectionOf(corners, x[p.node], *local);
      out.push_back(p);
    }
    return true;
  };
  const auto residualAt = [&](const std::vector<double>& at, std::vector<double>& r) {
    const std::span<const double> unknowns(at.data(), n);
    std::vector<ContactPoint> points;
    if (!pointsAt(solids_.positions(unknowns, t_), at, points)) {
      r[0] = std::numeric_limits<double>::quiet_NaN();
      return 0.0;
    }
    const double size = solids_.residual(unknowns, t_, {r.data(), static_cast<std::size_t>(n)});
    addForce(points, {r.data(), static_cast<std::size_t>(n)});
    for (std::size_t k = 0; k < points.size(); ++k) r[n + k] = points[k].area_m2 * eps * points[k].over.gap_m;
    return size;
  };
  const auto entriesAt = [&](const std::vector<double>& at) {
    const std::span<const double> unknowns(at.data(), n);
    const std::vector<Vec3> x = solids_.positions(unknowns, t_);
    std::vector<MatrixEntry> entries;
    addSolids(unknowns, entries);
    std::vector<ContactPoint> points;
    pointsAt(x, at, points);
    const SparseRows& C = solids_.dofs().C;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ContactPoint& p = points[k];
      const std::array<int, 5> nodes = contact_.nodesOf(p.side, p.node, p.facet);
      ContactBlock block{nodes, nodes};
      addGapCurvature(contact_.cornersOf(p.side, p.facet, x), x[p.node], p.over, p.area_m2 * p.pressure_Pa,
                      block.values);
      addBlock(block, entries);
      const int row = n + static_cast<int>(k);
      for (int i = 0; i < kProjectionSize; ++i) {
        const int component = 3 * nodes[i / 3] + i % 3;
        for (int a = C.offsets[component]; a < C.offsets[component + 1]; ++a) {
          const double g = p.area_m2 * eps * C.values[a] * p.over.gap_slope[i];
          entries.push_back({C.columns[a], row, g});
          entries.push_back({row, C.columns[a], g});
        }
      }
    }
    return entries;
  };
  const NewtonReport report = iterate(z, options, solver_, false, false, solids_.reach(), residualAt, entriesAt);
  y.assign(z.begin(), z.begin() + n);
  for (std::size_t k = 0; k < pairs.size(); ++k) pairs[k].pressure_Pa = eps * z[n + k];
  return report;
}

std::vector<double> ContactSystem::ahead(std::span<const ContactMultipliers> multipliers, std::span<const double> y,
                                         double dt, double raise) {
  std::vector<double> dg(y.size());
  solids_.change(y, t_, t_ + dt, dg);
  const std::vector<Vec3> x = solids_.positions(y, t_), moved = solids_.positions(y, t_ + dt);
  std::vector<MatrixEntry> entries;
  addSolids(y, entries);
  std::vector<Vec3> force(x.size());
  for (const ContactBlock& block : contact_.tangent(x, contact_.points(x, start_, multipliers))) {
    addBlock(block, entries);
    for (int i = 0; i < kProjectionSize; ++i)
      for (int j = 0; j < kProjectionSize; ++j) {
        const int node = block.columns[j / 3];
        force[block.rows[i / 3]][i % 3] += block.values[kProjectionSize * i + j] * (moved[node] - x[node])[j % 3];
      }
  }
  std::vector<double> pulled(y.size());
  solids_.dofs().Ct.multiply<double>({reinterpret_cast<const double*>(force.data()), 3 * force.size()}, pulled);
  for (std::size_t i = 0; i < dg.size(); ++i) dg[i] = -(dg[i] + pulled[i]);
  std::vector<double> way(y.size());
  if (!solver_.factorise(entries, static_cast<int>(y.size()), symmetric(), raise)) return {};
  solver_.solve(dg, way);
  return way;
}

}  // namespace gambeson
