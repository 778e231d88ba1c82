#include "core/motion/closest_projection.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kRegular = 1e-4;

/// Entries of a symmetric matrix on and below its diagonal, by columns.
class Entries {
 public:
  explicit Entries(int size) : columns_(static_cast<std::size_t>(size)) {}
  void add(int row, int column, double value) { columns_[std::min(row, column)][std::max(row, column)] += value; }
  SymmetricMatrix matrix() const {
    SymmetricMatrix m;
    m.size = static_cast<int>(columns_.size());
    for (const auto& column : columns_) {
      for (const auto& [row, value] : column) {
        m.rows.push_back(row);
        m.values.push_back(value);
      }
      m.offsets.push_back(static_cast<int>(m.rows.size()));
    }
    return m;
  }

 private:
  std::vector<std::map<int, double>> columns_;
};

/// The matrix of an iterate: coordinates of the free points, then multipliers. Points that are held and rows that no
/// point changes stand alone.
SymmetricMatrix matrixAt(const StrainRows& rows, std::span<const Vec3> e, std::span<const double> mu) {
  const std::vector<double>& inverse = rows.mobility.inverse_mass;
  const int n = static_cast<int>(inverse.size()), m = rows.rows();
  Entries A(3 * n + m);
  for (int k = 0; k < n; ++k)
    for (int c = 0; c < 3; ++c) A.add(3 * k + c, 3 * k + c, inverse[k] > 0 ? 1 / inverse[k] : 1);
  for (int i = 0; i < m; ++i) {
    A.add(3 * n + i, 3 * n + i, -(rows.live[i] ? kRegular * rows.S.values[rows.S.offsets[i]] : 1));
    if (!rows.live[i]) continue;
    for (int a = rows.B.offsets[i]; a < rows.B.offsets[i + 1]; ++a) {
      const int k = rows.B.columns[a];
      if (!(inverse[k] > 0)) continue;
      const double w = rows.B.values[a];
      A.add(3 * n + i, 3 * k, w * e[i].x);
      A.add(3 * n + i, 3 * k + 1, w * e[i].y);
      A.add(3 * n + i, 3 * k + 2, w * e[i].z);
      for (int b = rows.B.offsets[i]; b < rows.B.offsets[i + 1]; ++b) {
        const int j = rows.B.columns[b];
        if (j < k || !(inverse[j] > 0)) continue;
        for (int c = 0; c < 3; ++c) A.add(3 * k + c, 3 * j + c, mu[i] * w * rows.B.values[b]);
      }
    }
  }
  return A.matrix();
}

}  // namespace

void projectClosest(const StrainRows& rows, const StrainLimit& limit, std::span<Vec3> p, LimitReport& report,
                    LimitWork& w) {
  const InputError refused(
      {"", 0, "strain_limit.method"},
      "closest is for mode equality, threads that do not yield and supports that hold points whole");
  if (limit.mode != LimitMode::equality || !w.yields.empty() || rows.mobility.P.rows() > 0) throw refused;
  const std::vector<double>& inverse = rows.mobility.inverse_mass;
  const int n = static_cast<int>(inverse.size()), m = rows.rows();
  const std::vector<Vec3> start(p.begin(), p.end());
  std::vector<double> right(3 * n + m), x(3 * n + m);
  std::vector<Vec3> tension(m), pull(n);
  const auto pullAt = [&] {
    for (int i = 0; i < m; ++i) tension[i] = w.multiplier[i] * w.e[i];
    rows.Bt.multiply<Vec3>(tension, pull);
  };
  for (int iteration = 0;; ++iteration) {
    report.residual = limitResidual(rows, limit, p, w);
    report.converged = report.solved = report.residual <= limit.tolerance;
    if (!std::isfinite(report.residual) || report.residual == 0) break;
    if ((report.converged && iteration > 0) || iteration == limit.max_projections) break;
    pullAt();
    for (int k = 0; k < n; ++k) {
      const Vec3 f = inverse[k] > 0 ? (start[k] - p[k]) / inverse[k] - pull[k] : Vec3{};
      right[3 * k] = f.x;
      right[3 * k + 1] = f.y;
      right[3 * k + 2] = f.z;
    }
    for (int i = 0; i < m; ++i) right[3 * n + i] = rows.live[i] ? -w.C[i] : 0;
    const SymmetricMatrix A = matrixAt(rows, w.e, w.multiplier);
    SymmetricFactor factor(A);
    factor.factorise(A);
    ++report.factorisations;
    if (!factor.solvable()) {
      report.converged = report.solved = false;
      break;
    }
    factor.solve(right, x);
    ++report.projections;
    for (int k = 0; k < n; ++k)
      if (inverse[k] > 0) p[k] += Vec3{x[3 * k], x[3 * k + 1], x[3 * k + 2]};
    for (int i = 0; i < m; ++i)
      if (rows.live[i]) w.multiplier[i] += x[3 * n + i];
  }
  // What has moved the points, in place of the forces at the end: they agree to the tolerance.
  strainVectors(rows, p, w.e);
  pullAt();
  w.force = tension;
  for (int k = 0; k < n; ++k) w.pull[k] = inverse[k] > 0 ? (start[k] - p[k]) / inverse[k] : pull[k];
  report.active =
      static_cast<int>(std::count_if(w.multiplier.begin(), w.multiplier.end(), [](double v) { return v != 0; }));
}

}  // namespace gambeson
