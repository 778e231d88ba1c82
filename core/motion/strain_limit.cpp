#include "core/motion/strain_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kRegular = 1e-4;  ///< of the diagonal, see the header
constexpr double kLargestTurn = 0.5;
constexpr double kTurnOfFactor = 0.05;  ///< of an F D, from which on the matrix is made anew

void constraints(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> e, std::vector<double>& C) {
  const double at = limit.mode == LimitMode::upper_limit ? limit.limit : 0;
  C.resize(rows.rows());
  for (int i = 0; i < rows.rows(); ++i) C[i] = rows.live[i] ? strainOf(e[i]) - at : 0;
}

/// Largest change of an F D.
double turnOf(std::span<const Vec3> e, std::span<const Vec3> before) {
  double most2 = 0;
  for (std::size_t i = 0; i < e.size(); ++i) most2 = std::max(most2, norm2(e[i] - before[i]));
  return std::sqrt(most2);
}

/// F D of all rows that the threads pull along at the iterate.
const std::vector<Vec3>& pullsAlong(const LimitWork& w) { return w.along.empty() ? w.e : w.along; }

double residualOf(const StrainRows& rows, const StrainLimit& limit, std::span<const double> C) {
  double most = 0;
  for (int i = 0; i < rows.rows(); ++i) {
    if (!rows.live[i]) continue;
    const double c = limit.mode == LimitMode::upper_limit ? C[i] : std::abs(C[i]);
    if (!(c <= most)) most = c;  // NaN stays
  }
  return most;
}

/// J M^-1 J^T at e, and what threads yield.
void assemble(const StrainRows& rows, std::span<const Vec3> e, std::span<const double> yields, SymmetricMatrix& A) {
  if (A.size != rows.S.size) A = rows.S;
  for (int c = 0; c < A.size; ++c)
    for (int k = A.offsets[c]; k < A.offsets[c + 1]; ++k) {
      const int r = A.rows[k];
      if (!rows.live[c]) continue;  // alone, 1
      A.values[k] = r == c ? rows.S.values[k] * kRegular : 0;
      if (r == c && !yields.empty()) A.values[k] += yields[c];
      if (rows.tensors.empty()) {
        A.values[k] += rows.S.values[k] * dot(e[c], e[r]);
      } else {
        const std::array<double, 9>& t = rows.tensors[k];
        const Vec3 &a = e[r], &b = e[c];
        A.values[k] += a.x * (t[0] * b.x + t[1] * b.y + t[2] * b.z) + a.y * (t[3] * b.x + t[4] * b.y + t[5] * b.z) +
                       a.z * (t[6] * b.x + t[7] * b.y + t[8] * b.z);
      }
    }
}

class Projection {
 public:
  Projection(const StrainRows& rows, const StrainLimit& limit, LimitReport& report, LimitWork& work)
      : rows_(rows), limit_(limit), report_(report), w_(work) {
    if (!w_.factor) w_.factor = std::make_unique<SymmetricFactor>(rows.S);
  }

  void assembleHere() {
    assemble(rows_, pullsAlong(w_), w_.yields, w_.A);
    w_.factored_e = pullsAlong(w_);
  }

  void factoriseHere() {
    assembleHere();
    factorise(w_.A);
  }

  /// New total multipliers into w.solution. `fresh`: A has changed since the last factorisation.
  bool solve(bool fresh) { return limit_.mode == LimitMode::equality ? solveEquality(fresh) : solveLimited(fresh); }

 private:
  bool solveEquality(bool fresh) {
    if (fresh && !factorise(w_.A)) return false;
    if (w_.yields.empty())
      w_.factor->solve(w_.C, w_.solution);
    else
      w_.factor->solveOnce(w_.C, w_.solution);  // far from singular
    for (int i = 0; i < rows_.rows(); ++i) w_.solution[i] += w_.multiplier[i];
    return true;
  }

  bool factorise(const SymmetricMatrix& A) {
    ++report_.factorisations;
    w_.factor->factorise(A);
    return w_.factor->solvable();
  }

  /// A with the rows outside the active set replaced by those of the identity.
  bool factoriseActive() {
    if (w_.active_A.size != w_.A.size) w_.active_A = w_.A;
    SymmetricMatrix& A = w_.active_A;
    for (int c = 0; c < A.size; ++c)
      for (int k = A.offsets[c]; k < A.offsets[c + 1]; ++k) {
        const int r = A.rows[k];
        A.values[k] = w_.active[c] && w_.active[r] ? w_.A.values[k] : r == c ? 1.0 : 0.0;
      }
    w_.factored_active = w_.active;
    return factorise(A);
  }

  /// x >= 0, s = A x - (C + A multiplier) >= 0, x s = 0.
  bool solveLimited(bool fresh) {
    const int n = rows_.rows();
    w_.right.resize(n);
    w_.moved.resize(n);
    multiply(w_.A, w_.multiplier, w_.right);
    for (int i = 0; i < n; ++i) w_.right[i] += w_.C[i];
    int least_bad = n + 1, patience = 3;
    for (int pivots = 0; pivots < 20 + 4 * n; ++pivots) {
      if ((fresh && pivots == 0) || w_.active != w_.factored_active)
        if (!factoriseActive()) return false;
      for (int i = 0; i < n; ++i) w_.moved[i] = w_.active[i] ? w_.right[i] : 0;
      w_.factor->solve(w_.moved, w_.solution);
      double largest = 0;
      for (int i = 0; i < n; ++i) {
        if (!w_.active[i]) w_.solution[i] = 0;
        largest = std::max(largest, std::abs(w_.solution[i]));
      }
      multiply(w_.A, w_.solution, w_.moved);
      int bad = 0, last = -1;
      const auto isBad = [&](int i) {
        if (!rows_.live[i]) return false;
        return w_.active[i] ? w_.solution[i] < -1e-12 * largest : w_.moved[i] - w_.right[i] < -1e-12;
      };
      for (int i = 0; i < n; ++i)
        if (isBad(i)) ++bad, last = i;
      if (bad == 0) {
        for (double& x : w_.solution) x = std::max(x, 0.0);
        return true;
      }
      bool single = false;
      if (bad < least_bad) {
        least_bad = bad;
        patience = 3;
      } else if (--patience < 0) {
        single = true;
      }
      std::vector<int> flip;
      for (int i = 0; i < n; ++i)
        if ((!single || i == last) && isBad(i)) flip.push_back(i);
      for (int i : flip) w_.active[i] = !w_.active[i];
    }
    return false;
  }

  const StrainRows& rows_;
  const StrainLimit& limit_;
  LimitReport& report_;
  LimitWork& w_;
};

}  // namespace

void checkLimit(const StrainLimit& limit) {
  const auto reject = [](const char* key, const char* reason) {
    throw InputError({"", 0, std::string("strain_limit.") + key}, reason);
  };
  if (!(limit.limit >= 0)) reject("limit", "must be >= 0");
  if (!(limit.tolerance >= 1e-10)) reject("tolerance", "must be >= 1e-10");
  if (!(limit.max_projections > 0)) reject("max_projections", "must be > 0");
  if (!(limit.max_rounds > 0)) reject("max_rounds", "must be > 0");
  if (!(limit.restore_per_s > 0)) reject("restore_per_s", "must be > 0");
  if (!(limit.stiffness_N_per_m > 0)) reject("stiffness", "must be > 0");
}

void startProjection(const StrainRows& rows, std::span<const double> warm, LimitWork& w) {
  w.multiplier.assign(rows.rows(), 0);
  w.solution.assign(rows.rows(), 0);
  w.force.assign(rows.rows(), {});
  w.pull.assign(rows.B.column_count, {});
  w.contact_change.assign(rows.B.column_count, {});
  w.active.assign(rows.rows(), 0);
  w.factored_active.clear();
  w.factored_e.clear();
  w.left.clear();
  w.yields.clear();
  w.along.clear();
  for (std::size_t i = 0; i < warm.size(); ++i) w.active[i] = rows.live[i] && warm[i] > 0;
}

void leaveStrain(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p,
                 std::span<const double> warm_J, double dt, LimitWork& w) {
  if (!std::isfinite(limit.stiffness_N_per_m)) return;
  strainVectors(rows, p, w.e);
  w.along = w.e;
  constraints(rows, limit, w.e, w.left);
  // Crossings of a trimming loop may stand for next to no area; their threads hold all the same.
  const double least = 0.1 * *std::max_element(rows.area_m2.begin(), rows.area_m2.end());
  w.yields.resize(rows.rows());
  for (int i = 0; i < rows.rows(); ++i) {
    const double yields_J = 1 / (limit.stiffness_N_per_m * std::max(least, rows.area_m2[i]));
    w.yields[i] = yields_J / (dt * dt);
    if (!warm_J.empty()) w.left[i] -= yields_J * warm_J[i];
  }
  for (double& c : w.left) {
    const double size = std::abs(c), rest = std::max(0.0, size - limit.restore_per_s * dt);
    c = size <= 0.5 * limit.tolerance ? 0 : c > 0 ? rest : limit.mode == LimitMode::equality ? -rest : 0;
  }
}

void limitForce(const StrainRows& rows, std::span<const Vec3> p, std::span<const double> multiplier_J,
                std::span<Vec3> force) {
  std::vector<Vec3> e;
  strainVectors(rows, p, e);
  for (std::size_t i = 0; i < e.size(); ++i) e[i] *= -multiplier_J[i];
  rows.Bt.multiply<Vec3>(e, force);
}

void limitMultipliers(const StrainRows& rows, std::span<const Vec3> p, double dt, std::vector<double>& lambda,
                      LimitWork& w) {
  lambda.assign(rows.rows(), 0);
  strainVectors(rows, p, w.e);
  for (int i = 0; i < rows.rows(); ++i) {
    const double size2 = norm2(w.e[i]);
    if (size2 > 0) lambda[i] = dot(w.force[i], w.e[i]) / (size2 * dt * dt);
  }
}

double limitResidual(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p, LimitWork& w) {
  strainVectors(rows, p, w.e);
  constraints(rows, limit, w.e, w.C);
  return residualOf(rows, limit, w.C);
}

double unrestored(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p, LimitWork& w) {
  strainVectors(rows, p, w.e);
  constraints(rows, limit, w.e, w.C);
  for (std::size_t i = 0; i < w.left.size(); ++i) w.C[i] -= w.left[i];
  for (std::size_t i = 0; i < w.yields.size(); ++i) w.C[i] -= w.yields[i] * w.multiplier[i];
  return residualOf(rows, limit, w.C);
}

double unrestoredTolerance(const StrainLimit& limit, const LimitWork& w) {
  return w.left.empty() ? limit.tolerance : 0.05 * limit.tolerance;
}

double tensionFrequency(const StrainRows& rows, std::span<const double> lambda) {
  if (lambda.empty()) return 0;
  std::vector<double> sum(rows.B.column_count, 0.0);
  for (int r = 0; r < rows.rows(); ++r) {
    if (!(lambda[r] > 0)) continue;
    double size = 0;
    for (int k = rows.B.offsets[r]; k < rows.B.offsets[r + 1]; ++k) size += std::abs(rows.B.values[k]);
    for (int k = rows.B.offsets[r]; k < rows.B.offsets[r + 1]; ++k)
      sum[rows.B.columns[k]] += lambda[r] * size * std::abs(rows.B.values[k]);
  }
  double most = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) most = std::max(most, sum[i] * rows.mobility.inverse_mass[i]);
  return std::sqrt(most);
}

void projectStrain(const StrainRows& rows, const StrainLimit& limit, bool at_least_once, std::span<Vec3> p,
                   LimitReport& report, LimitWork& w, int most) {
  const int n = rows.rows();
  const double tolerance = unrestoredTolerance(limit, w);
  Projection projection(rows, limit, report, w);
  const std::vector<Vec3>& along = pullsAlong(w);
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0;; ++iteration) {
    const double residual = report.residual = unrestored(rows, limit, p, w);
    report.converged = report.solved = residual <= tolerance;
    if (!std::isfinite(residual)) return;
    const bool wanted = iteration == 0 && at_least_once && residual > 0;
    if (report.converged && !wanted) break;
    if (iteration == std::min(most, limit.max_projections)) break;
    const bool fresh = w.along.empty()
                           ? iteration == 0 || residual > 0.25 * before || turnOf(w.e, w.factored_e) > kTurnOfFactor
                           : w.factored_e.empty();
    if (fresh) projection.assembleHere();
    if (limit.mode == LimitMode::upper_limit)
      for (int i = 0; i < n; ++i)
        if (rows.live[i] && w.C[i] > 0) w.active[i] = 1;
    if (!projection.solve(fresh)) {
      report.converged = report.solved = false;
      break;
    }
    before = residual;
    ++report.projections;
    // The step in multipliers, shortened where it turns the cloth too far for the linearisation.
    const auto moveBy = [&](double part) {
      w.scaled.resize(n);
      for (int i = 0; i < n; ++i) w.scaled[i] = (part * (w.solution[i] - w.multiplier[i])) * along[i];
      w.end.resize(p.size());
      rows.Bt.multiply<Vec3>(w.scaled, w.end);
    };
    moveBy(1);
    w.velocity.resize(p.size());
    applyMobility(rows.mobility, w.end, w.velocity);
    strainVectors(rows, w.velocity, w.e_next);
    double turn = 0;
    for (const Vec3& d : w.e_next) turn = std::max(turn, norm(d));
    const double part = turn > kLargestTurn ? kLargestTurn / turn : 1;
    if (part < 1) {
      moveBy(part);
      applyMobility(rows.mobility, w.end, w.velocity);
    }
    for (int i = 0; i < n; ++i) {
      w.multiplier[i] += part * (w.solution[i] - w.multiplier[i]);
      w.force[i] += w.scaled[i];
    }
    for (std::size_t k = 0; k < p.size(); ++k) {
      w.pull[k] += w.end[k];
      p[k] -= w.velocity[k];
    }
    if (part < 1) before = 0;  // a new matrix next
  }
  report.active =
      static_cast<int>(std::count_if(w.multiplier.begin(), w.multiplier.end(), [](double x) { return x != 0; }));
}

StrainHold::StrainHold(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p, LimitReport& report,
                       LimitWork& work)
    : rows_(rows), w_(work) {
  if (!w_.factored_e.empty()) return;
  strainVectors(rows, p, w_.e);
  Projection(rows, limit, report, w_).factoriseHere();
}

void StrainHold::multipliersOf(std::span<const Vec3> change) const {
  const int n = rows_.rows();
  strainVectors(rows_, change, w_.e_next);
  w_.right.resize(n);
  w_.solution.resize(n);
  for (int i = 0; i < n; ++i) {
    w_.right[i] = rows_.live[i] ? dot(w_.factored_e[i], w_.e_next[i]) : 0;
  }
  w_.factor->solveOnce(w_.right, w_.solution);
}

void StrainHold::hold(std::span<Vec3> change) const {
  const auto rests = [](const Vec3& d) { return d == Vec3{}; };
  if (!w_.factor->solvable() || std::all_of(change.begin(), change.end(), rests)) return;
  multipliersOf(change);
  const int n = rows_.rows();
  w_.scaled.resize(n);
  for (int i = 0; i < n; ++i) w_.scaled[i] = w_.solution[i] * w_.factored_e[i];
  w_.end.resize(change.size());
  rows_.Bt.multiply<Vec3>(w_.scaled, w_.end);
  w_.velocity.resize(change.size());
  applyMobility(rows_.mobility, w_.end, w_.velocity);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= w_.velocity[k];
}

void StrainHold::touch(std::span<const int> points) {
  rows_of_touched_.clear();
  inverse_mass_.clear();
  touched_t_ = {};
  std::vector<int>& slot = w_.slot;
  slot.assign(rows_.rows(), -1);
  for (const int point : points) {
    inverse_mass_.push_back(rows_.mobility.inverse_mass[point]);
    for (int k = rows_.Bt.offsets[point]; k < rows_.Bt.offsets[point + 1]; ++k) {
      const int row = rows_.Bt.columns[k];
      if (!rows_.live[row]) continue;
      if (slot[row] < 0) {
        slot[row] = static_cast<int>(rows_of_touched_.size());
        rows_of_touched_.push_back(row);
      }
      touched_t_.add(slot[row], rows_.Bt.values[k]);
    }
    touched_t_.endRow();
  }
  touched_t_.column_count = static_cast<int>(rows_of_touched_.size());
  touched_ = transpose(touched_t_);
  w_.factor->want(rows_of_touched_);
}

void StrainHold::holdTouched(std::span<Vec3> change) const {
  if (!w_.factor->solvable()) return;
  const std::size_t n = rows_of_touched_.size();
  stretch_.resize(n);
  right_.resize(n);
  multiplier_.resize(n);
  given_.resize(change.size());
  touched_.multiply<Vec3>(change, stretch_);
  for (std::size_t k = 0; k < n; ++k) right_[k] = dot(w_.factored_e[rows_of_touched_[k]], stretch_[k]);
  w_.factor->solveWanted(right_, multiplier_);
  for (std::size_t k = 0; k < n; ++k) stretch_[k] = multiplier_[k] * w_.factored_e[rows_of_touched_[k]];
  touched_t_.multiply<Vec3>(stretch_, given_);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= inverse_mass_[k] * given_[k];
}

void StrainHold::follow(std::span<const Vec3> moved) {
  if (!w_.factor->solvable()) return;
  multipliersOf(moved);
  const int n = rows_.rows();
  w_.scaled.resize(n);
  for (int i = 0; i < n; ++i) {
    w_.multiplier[i] += w_.solution[i];
    w_.scaled[i] = w_.solution[i] * w_.factored_e[i];
    w_.force[i] += w_.scaled[i];
  }
  w_.end.resize(moved.size());
  rows_.Bt.multiply<Vec3>(w_.scaled, w_.end);
  for (std::size_t k = 0; k < moved.size(); ++k) w_.pull[k] += w_.end[k];
}

}  // namespace gambeson
