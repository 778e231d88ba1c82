#include "core/motion/supports.hpp"

#include <algorithm>
#include <cmath>

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

std::span<const double> flat(std::span<const Vec3> v) { return {&v.data()->x, 3 * v.size()}; }
std::span<double> flat(std::span<Vec3> v) { return {&v.data()->x, 3 * v.size()}; }

/// Of a matrix that is positive: each point has a mass.
std::unique_ptr<SymmetricFactor> factorOf(const SymmetricMatrix& M) {
  auto factor = std::make_unique<SymmetricFactor>(M);
  factor->factorise(M);
  return factor;
}

/// Steps that divide a time equally differ by rounding.
constexpr double kSameStep = 1e-9;

std::vector<double> valuesAt(const Structure& s, double t) { return programValues(s, t, ProgramEnds::constant); }

}  // namespace

Supports::Supports(const Structure& structure, std::span<const double> mass_kg,
                   std::span<const double> damping_kg_per_s)
    : s_(structure),
      dofs_(pointsOf(structure.dofs)),
      mass_kg_(mass_kg.begin(), mass_kg.end()),
      damping_kg_per_s_(damping_kg_per_s.begin(), damping_kg_per_s.end()) {
  const DofMap& dofs = dofs_;
  const SparseRows& C = dofs.C;
  std::vector<char> own(static_cast<std::size_t>(C.rows()), 0);
  for (const int component : dofs.component) own[static_cast<std::size_t>(component)] = 1;
  std::vector<int> users(static_cast<std::size_t>(dofs.unknowns()), 0);
  for (const int column : C.columns) ++users[static_cast<std::size_t>(column)];
  for (int i = 0; i < C.rows() / 3; ++i) {
    int guided = 0, fixed = 0, shared = 0;
    for (int r = 3 * i; r < 3 * i + 3; ++r) {
      const int entries = C.offsets[r + 1] - C.offsets[r];
      if (!own[static_cast<std::size_t>(r)]) guided_.push_back(r), ++guided;
      fixed += entries == 0;
      for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) shared += users[static_cast<std::size_t>(C.columns[k])] > 1;
    }
    held_.push_back(fixed == 3);
    binds_.push_back(guided > 0 || shared > 0);
    if (binds_.back()) bound_.push_back(i);
    couples_ = couples_ || (fixed != 3 && binds_.back());
  }
  damps_ = std::any_of(damping_kg_per_s_.begin(), damping_kg_per_s_.end(), [](double d) { return d != 0; });
  for (const std::vector<double>& shift : dofs.shift)
    moves_ = moves_ || std::any_of(shift.begin(), shift.end(), [](double v) { return v != 0; });
  findTurned();
  if (!couples_) return;
  diagonal_ = true;  // no component follows two others
  for (int r = 0; r < C.rows(); ++r) diagonal_ = diagonal_ && C.offsets[r + 1] - C.offsets[r] <= 1;
  if (diagonal_) {
    squares_ = dofs.Ct;
    for (double& v : squares_.values) v *= v;
  }
  mobility_ = mobilityRows();
}

void Supports::findTurned() {
  if (s_.cloth->turnsInner()) {
    directors_ = HeldDirectors(s_);
    return;
  }
  const DofMap& all = s_.dofs;
  std::vector<char> own(static_cast<std::size_t>(all.C.rows()), 0);
  for (const int component : all.component) own[static_cast<std::size_t>(component)] = 1;
  std::vector<double> start(s_.cloth->innerValues());
  s_.cloth->startInner(start);
  for (int k = 0; k < static_cast<int>(all.inner_length_m.size()); ++k) {
    const int r = 3 * all.points + k;
    if (own[static_cast<std::size_t>(r)]) continue;
    Turned turned{k, start[static_cast<std::size_t>(k)], {}, {}};
    for (int e = all.C.offsets[r]; e < all.C.offsets[r + 1]; ++e)
      turned.terms.emplace_back(all.component[static_cast<std::size_t>(all.C.columns[e])], all.C.values[e]);
    for (const std::vector<double>& shift : all.shift)
      turned.shift.push_back(shift.empty() ? 0 : shift[static_cast<std::size_t>(r)]);
    turned_.push_back(std::move(turned));
  }
}

void Supports::placeInner(double t, std::span<const Vec3> p, std::span<double> inner) const {
  directors_.place(s_, t, inner);
  if (turned_.empty()) return;
  const std::vector<int>& home = s_.cloth->map().home;
  const std::vector<double> value = valuesAt(s_, t);
  for (const Turned& turned : turned_) {
    double sum = turned.start;
    for (const auto& [component, coefficient] : turned.terms)
      sum += coefficient * (p[component / 3][component % 3] - s_.cloth->rest()[home[component / 3]][component % 3]);
    for (std::size_t k = 0; k < value.size(); ++k) sum += value[k] * turned.shift[k];
    inner[static_cast<std::size_t>(turned.inner)] = sum;
  }
}

void Supports::handInner(std::span<double> inner_force, std::span<Vec3> f) const {
  directors_.hold(inner_force);
  for (const Turned& turned : turned_) {
    double& force = inner_force[static_cast<std::size_t>(turned.inner)];
    for (const auto& [component, coefficient] : turned.terms) f[component / 3][component % 3] += coefficient * force;
    force = 0;
  }
}

SymmetricMatrix Supports::matrix(double h) const {
  SparseRows weighted = dofs_.C;
  for (int r = 0; r < weighted.rows(); ++r) {
    const auto i = static_cast<std::size_t>(r / 3);
    for (int k = weighted.offsets[r]; k < weighted.offsets[r + 1]; ++k)
      weighted.values[k] *= mass_kg_[i] + h * damping_kg_per_s_[i];
  }
  return lowerTriangle(multiply(dofs_.Ct, weighted));
}

double Supports::massOf(int unknown, double h) const {
  double mass = 0;
  for (int k = squares_.offsets[unknown]; k < squares_.offsets[unknown + 1]; ++k) {
    const auto i = static_cast<std::size_t>(squares_.columns[k] / 3);
    mass += squares_.values[k] * (mass_kg_[i] + h * damping_kg_per_s_[i]);
  }
  return mass;
}

void Supports::addShifts(std::span<const double> value, std::span<Vec3> u) const {
  const std::span<double> components = flat(u);
  for (std::size_t k = 0; k < value.size(); ++k) {
    const std::vector<double>& shift = dofs_.shift[k];
    if (shift.empty() || value[k] == 0) continue;
    for (const int r : guided_) components[r] += value[k] * shift[r];
  }
}

void Supports::place(double t, std::span<Vec3> p) const {
  const SparseRows& C = dofs_.C;
  const std::vector<int>&home = s_.cloth->map().home, &component = dofs_.component;
  const auto rest = [&](int r) { return s_.cloth->rest()[home[r / 3]][r % 3]; };
  const std::span<double> x = flat(p);
  for (const int r : guided_) {
    double u = 0;
    for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) {
      const int of = component[C.columns[k]];
      u += C.values[k] * (x[of] - rest(of));
    }
    x[r] = rest(r) + u;
  }
  addShifts(valuesAt(s_, t), p);
}

void Supports::drive(double t0, double t1, std::span<Vec3> v) const {
  const SparseRows& C = dofs_.C;
  const std::span<double> x = flat(v);
  for (const int r : guided_) {
    double sum = 0;
    for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) sum += C.values[k] * x[dofs_.component[C.columns[k]]];
    x[r] = sum;
  }
  if (!moves_) return;
  std::vector<double> rate = valuesAt(s_, t1);
  const std::vector<double> before = valuesAt(s_, t0);
  for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = (rate[k] - before[k]) / (t1 - t0);
  addShifts(rate, v);
}

void Supports::addPrescribed(double t, double dt, std::span<Vec3> a) const {
  if (!moves_ || !(dt > 0)) return;
  std::vector<double> second = valuesAt(s_, t + dt);
  const std::vector<double> now = valuesAt(s_, t), before = valuesAt(s_, t - dt);
  for (std::size_t k = 0; k < second.size(); ++k) second[k] = (second[k] - 2 * now[k] + before[k]) / (dt * dt);
  addShifts(second, a);
}

void Supports::Solver::accelerations(const Supports& s, double h, std::span<const Vec3> f, std::span<Vec3> a) {
  if (!s.couples_) {
    for (std::size_t i = 0; i < a.size(); ++i)
      a[i] = s.held_[i] ? Vec3{} : f[i] / (s.mass_kg_[i] + h * s.damping_kg_per_s_[i]);
    return;
  }
  const DofMap& dofs = s.dofs_;
  right_.resize(static_cast<std::size_t>(dofs.unknowns()));
  solution_.resize(right_.size());
  dofs.Ct.multiply<double>(flat(f), right_);
  if (s.diagonal_) {
    for (std::size_t j = 0; j < right_.size(); ++j) solution_[j] = right_[j] / s.massOf(static_cast<int>(j), h);
  } else {
    const double wanted = s.damps_ ? h : 0;
    if (of_ != &s || !(std::abs(wanted - h_s_) <= kSameStep * wanted)) {
      factor_ = factorOf(s.matrix(wanted));
      of_ = &s;
      h_s_ = wanted;
    }
    factor_->solve(right_, solution_);
  }
  s.dofs_.C.multiply<double>(solution_, flat(a));
}

void Supports::hold(std::span<Vec3> change) const {
  if (!couples_) {
    for (std::size_t i = 0; i < change.size(); ++i)
      if (held_[i]) change[i] = {};
    return;
  }
  std::vector<Vec3> impulse(change.size());
  for (std::size_t i = 0; i < change.size(); ++i) impulse[i] = mass_kg_[i] * change[i];
  mobility_.multiply<double>(flat(std::span<const Vec3>(impulse)), flat(change));
}

double Supports::givesWay(std::span<const int> points, std::span<const double> weight, const Vec3& n) const {
  double whole = 0, left = 0;
  for (std::size_t a = 0; a < points.size(); ++a) {
    whole += weight[a] * weight[a] / mass_kg_[points[a]];
    for (int d = 0; d < 3; ++d) {
      const int r = 3 * points[a] + d;
      for (int k = mobility_.offsets[r]; k < mobility_.offsets[r + 1]; ++k) {
        const auto at = std::find(points.begin(), points.end(), mobility_.columns[k] / 3);
        if (at == points.end()) continue;
        left += weight[a] * n[d] * mobility_.values[k] * weight[at - points.begin()] * n[mobility_.columns[k] % 3];
      }
    }
  }
  return left / whole;
}

SparseRows Supports::holdOf(std::span<const int> points) const {
  std::vector<int> slot(held_.size(), -1);
  for (std::size_t k = 0; k < points.size(); ++k) slot[points[k]] = static_cast<int>(k);
  SparseRows rows;
  rows.column_count = static_cast<int>(3 * points.size());
  for (const int point : points)
    for (int r = 3 * point; r < 3 * point + 3; ++r) {
      for (int k = mobility_.offsets[r]; k < mobility_.offsets[r + 1]; ++k)
        if (const int of = mobility_.columns[k] / 3; slot[of] >= 0)
          rows.add(3 * slot[of] + mobility_.columns[k] % 3, mobility_.values[k] * mass_kg_[of]);
      rows.endRow();
    }
  return rows;
}

Mobility Supports::mobility() const {
  if (couples_) return mobilityOf(mobility_);
  Mobility whole;
  for (std::size_t i = 0; i < held_.size(); ++i) whole.inverse_mass.push_back(held_[i] ? 0 : 1 / mass_kg_[i]);
  return whole;
}

SparseRows Supports::mobilityRows() const {
  const SparseRows& C = dofs_.C;
  SparseRows columns;  // of M^-1 Cᵀ
  columns.column_count = C.column_count;
  std::unique_ptr<const SymmetricFactor> factor;
  std::vector<char> alone(static_cast<std::size_t>(C.column_count), 1);  // its mass is no other unknown's
  std::vector<double> own(alone.size());
  const SymmetricMatrix M = matrix(0);
  for (int c = 0; c < M.size; ++c)
    for (int k = M.offsets[c]; k < M.offsets[c + 1]; ++k) {
      if (M.rows[k] == c) own[c] = M.values[k];
      if (M.rows[k] != c && M.values[k] != 0) alone[c] = alone[M.rows[k]] = 0;
    }
  std::vector<double> f(alone.size()), x(f.size());
  for (int r = 0; r < C.rows(); ++r) {
    bool simple = true;
    for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) simple = simple && alone[C.columns[k]];
    if (simple) {
      for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) columns.add(C.columns[k], C.values[k] / own[C.columns[k]]);
      columns.endRow();
      continue;
    }
    if (!factor) factor = factorOf(M);
    std::fill(f.begin(), f.end(), 0.0);
    for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) f[C.columns[k]] = C.values[k];
    factor->solve(f, x);
    double most = 0;
    for (double v : x) most = std::max(most, std::abs(v));
    for (int i = 0; i < C.column_count; ++i)
      if (std::abs(x[i]) > 1e-14 * most) columns.add(i, x[i]);
    columns.endRow();
  }
  return multiply(C, transpose(columns));
}

void SupportHold::hold(std::span<Vec3> change) const {
  supports_.hold(change);
  if (limits_) limits_->hold(change);
}

void SupportHold::touch(std::span<const int> points) {
  points_.assign(points.begin(), points.end());
  if (!limits_) touched_ = supports_.holdOf(points_);
}

void SupportHold::holdTouched(std::span<Vec3> change) const {
  if (!limits_) {
    all_.assign(change.begin(), change.end());
    touched_.multiply<double>(flat(std::span<const Vec3>(all_)), flat(change));
    return;
  }
  all_.assign(supports_.held().size(), Vec3{});
  for (std::size_t k = 0; k < points_.size(); ++k) all_[points_[k]] = change[k];
  hold(all_);
  for (std::size_t k = 0; k < points_.size(); ++k) change[k] = all_[points_[k]];
}

}  // namespace gambeson
