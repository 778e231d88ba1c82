#include "core/motion/provot_projection.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// The diagonal of S.
double inverseMassOf(const StrainRows& rows, int row) {
  int k = rows.S.offsets[row];
  while (rows.S.rows[k] != row) ++k;
  return rows.S.values[k];
}

Vec3 strainVector(const StrainRows& rows, int row, std::span<const Vec3> p) {
  Vec3 e{};
  for (int k = rows.B.offsets[row]; k < rows.B.offsets[row + 1]; ++k) e += rows.B.values[k] * p[rows.B.columns[k]];
  return e;
}

void drawTogether(const StrainRows& rows, const StrainLimit& limit, int r, std::span<Vec3> p, LimitWork& w) {
  const Vec3 e = strainVector(rows, r, p);
  const double yields = w.yields.empty() ? 0 : w.yields[r];
  const double C = strainOf(e) - limit.limit - (w.left.empty() ? 0 : w.left[r]) - yields * w.multiplier[r];
  if (!(C > 0)) return;
  const Vec3& along = w.along.empty() ? e : w.along[r];
  const double lambda = C / (inverseMassOf(rows, r) * dot(along, e) + yields);
  const Vec3 pull = lambda * along;
  w.multiplier[r] += lambda;
  w.force[r] += pull;
  for (int k = rows.B.offsets[r]; k < rows.B.offsets[r + 1]; ++k) {
    const int c = rows.B.columns[k];
    w.pull[c] += rows.B.values[k] * pull;
    p[c] -= (rows.mobility.inverse_mass[c] * rows.B.values[k]) * pull;
  }
}

}  // namespace

void projectOneByOne(const StrainRows& rows, const StrainLimit& limit, std::span<Vec3> p, LimitReport& report,
                     LimitWork& w) {
  if (limit.mode != LimitMode::upper_limit || rows.mobility.P.rows() > 0)
    throw InputError({"", 0, "strain_limit.method"},
                     "provot goes with upper limits and supports that hold points whole");
  const double tolerance = unrestoredTolerance(limit, w);
  for (int sweep = 0;; ++sweep) {
    report.residual = unrestored(rows, limit, p, w);
    report.converged = report.solved = report.residual <= tolerance;
    if (report.converged || !std::isfinite(report.residual) || sweep == limit.max_projections) break;
    for (int r = 0; r < rows.rows(); ++r)
      if (rows.live[r]) drawTogether(rows, limit, r, p, w);
    ++report.projections;
  }
  report.active =
      static_cast<int>(std::count_if(w.multiplier.begin(), w.multiplier.end(), [](double x) { return x != 0; }));
}

}  // namespace gambeson
