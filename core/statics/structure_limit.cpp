#include "core/statics/structure_limit.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/motion/closest_projection.hpp"
#include "core/motion/time_integration.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

SymmetricMatrix lowerTriangle(const SparseRows& a) {
  SymmetricMatrix m;
  m.size = a.rows();
  for (int c = 0; c < m.size; ++c) {
    for (int k = a.offsets[c]; k < a.offsets[c + 1]; ++k)  // symmetric: row c is column c
      if (a.columns[k] >= c) m.rows.push_back(a.columns[k]), m.values.push_back(a.values[k]);
    m.offsets.push_back(static_cast<int>(m.rows.size()));
  }
  return m;
}

/// M^-1 C^T with M = C^T diag(mass) C.
SparseRows releaseOf(const DofMap& dofs, std::span<const double> lumped_kg) {
  SparseRows weighted = dofs.C;
  for (int r = 0; r < weighted.rows(); ++r)
    for (int k = weighted.offsets[r]; k < weighted.offsets[r + 1]; ++k) weighted.values[k] *= lumped_kg[r / 3];
  const SymmetricMatrix M = lowerTriangle(multiply(dofs.Ct, weighted));
  const MassSolver solver(M);
  SparseRows columns;  // of the release
  columns.column_count = M.size;
  std::vector<double> f(static_cast<std::size_t>(M.size)), x(f.size());
  const bool diagonal = static_cast<int>(M.rows.size()) == M.size;
  for (int r = 0; r < dofs.C.rows(); ++r) {
    if (diagonal) {
      for (int k = dofs.C.offsets[r]; k < dofs.C.offsets[r + 1]; ++k)
        columns.add(dofs.C.columns[k], dofs.C.values[k] / M.values[dofs.C.columns[k]]);
      columns.endRow();
      continue;
    }
    std::fill(f.begin(), f.end(), 0.0);
    for (int k = dofs.C.offsets[r]; k < dofs.C.offsets[r + 1]; ++k) f[dofs.C.columns[k]] = dofs.C.values[k];
    solver.solve(f, x);
    double most = 0;
    for (double v : x) most = std::max(most, std::abs(v));
    for (int i = 0; i < M.size; ++i)
      if (std::abs(x[i]) > 1e-14 * most) columns.add(i, x[i]);
    columns.endRow();
  }
  return transpose(columns);
}

/// Numbers where every point moves freely or not at all.
Mobility mobilityOf(SparseRows P) {
  Mobility m;
  for (int r = 0; r < P.rows(); ++r) {
    const int entries = P.offsets[r + 1] - P.offsets[r];
    const double w = entries == 0 ? 0 : P.values[P.offsets[r]];
    const bool own = entries == 0 || (entries == 1 && P.columns[P.offsets[r]] == r);
    if (r % 3 == 0) m.inverse_mass.push_back(w);
    if (!own || std::abs(w - m.inverse_mass.back()) > 1e-14 * std::abs(w)) return {{}, std::move(P)};
  }
  return m;
}

class StructureMotionLimit : public MotionLimit {
 public:
  explicit StructureMotionLimit(const Structure& s) : s_(s), limit_(*s.limit) {}

  LimitReport project(double t, double dt, std::span<double> y, std::span<double> change,
                      std::vector<double>& multiplier_J) override {
    LimitReport report;
    std::vector<Vec3> p = freePoints(s_, y, t);
    startProjection(limit_.rows, multiplier_J, work_);
    if (limit_.limit.method == LimitMethod::closest)
      projectClosest(limit_.rows, limit_.limit, p, report, work_);
    else
      projectStrain(limit_.rows, limit_.limit, limit_.limit.always, p, report, work_);
    limitMultipliers(limit_.rows, p, dt, multiplier_J, work_);
    release(work_.pull, change);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += change[i] = -change[i];
    return report;
  }

  void acceleration(std::span<const double> y, double t, std::span<const double> multiplier_J,
                    std::span<double> a) override {
    const std::vector<Vec3> p = freePoints(s_, y, t);
    force_.resize(p.size());
    limitForce(limit_.rows, p, multiplier_J, force_);
    release(force_, a);
  }

 private:
  void release(const std::vector<Vec3>& impulse, std::span<double> velocity) const {
    limit_.release.multiply<double>({&impulse.data()->x, 3 * impulse.size()}, velocity);
  }

  const Structure& s_;
  const StructureLimit& limit_;
  LimitWork work_;
  std::vector<Vec3> force_;
};

}  // namespace

StructureLimit buildStructureLimit(const Cloth& cloth, const DofMap& dofs, std::span<const double> lumped_kg,
                                   const StrainLimit& limit) {
  checkLimit(limit);
  SparseRows release = releaseOf(dofs, lumped_kg);
  Mobility mobility = mobilityOf(multiply(dofs.C, release));
  if (limit.method == LimitMethod::closest && mobility.P.rows() > 0)
    throw InputError({"", 0, "strain_limit.method"}, "closest goes with supports that hold points whole");
  return {limit, cloth.strainRows(std::move(mobility), limit.points), std::move(release)};
}

std::unique_ptr<MotionLimit> motionLimit(const Structure& s) {
  return s.limit ? std::make_unique<StructureMotionLimit>(s) : nullptr;
}

void refuseLimit(const Structure& s) {
  if (s.limit) throw InputError({"", 0, "strain_limit"}, "goes with explicit steps alone");
}

void limitForce(const StrainRows& rows, std::span<const Vec3> p, std::span<const double> multiplier_J,
                std::span<Vec3> force) {
  std::vector<Vec3> e;
  strainVectors(rows, p, e);
  for (std::size_t i = 0; i < e.size(); ++i) e[i] *= -multiplier_J[i];
  rows.Bt.multiply<Vec3>(e, force);
}

std::vector<Vec3> freePoints(const Structure& s, std::span<const double> y, double t) {
  const std::vector<double> u = freeDisplacements(s, y, programValues(s, t, ProgramEnds::constant));
  std::vector<Vec3> p(s.cloth->map().home.size());
  for (std::size_t k = 0; k < p.size(); ++k)
    p[k] = s.cloth->rest()[s.cloth->map().home[k]] + Vec3{u[3 * k], u[3 * k + 1], u[3 * k + 2]};
  return p;
}

}  // namespace gambeson
