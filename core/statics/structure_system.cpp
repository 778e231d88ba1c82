#include "core/statics/structure_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gambeson {

std::vector<double> programValues(const Structure& s, double t, ProgramEnds ends) {
  std::vector<double> value;
  for (const Program& p : s.programs) value.push_back(ends == ProgramEnds::constant ? p(t) : p.extended(t));
  return value;
}

namespace {

void addShifts(const DofMap& dofs, std::span<const double> value, std::span<double> u) {
  for (std::size_t k = 0; k < dofs.shift.size(); ++k) {
    if (dofs.shift[k].empty() || value[k] == 0) continue;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += value[k] * dofs.shift[k][i];
  }
}

bool moves(const DofMap& dofs) {
  return std::any_of(dofs.shift.begin(), dofs.shift.end(), [](const auto& s) { return !s.empty(); });
}

std::span<const double> flat(const std::vector<Vec3>& v) { return {&v.data()->x, 3 * v.size()}; }

double sizeOf(const std::vector<Vec3>& v) {
  double sum = 0;
  for (const Vec3& f : v) sum += norm2(f);
  return std::sqrt(sum);
}

}  // namespace

std::vector<double> freeDisplacements(const Structure& s, std::span<const double> y, std::span<const double> value) {
  std::vector<double> u(s.dofs.C.rows());
  s.dofs.C.multiply<double>(y, u);
  addShifts(s.dofs, value, u);
  return u;
}

StructureSystem::StructureSystem(const Structure& structure, ProgramEnds ends) : structure_(structure), ends_(ends) {
  Vec3 low = structure.cloth->rest().front(), high = low;
  for (const Vec3& x : structure.cloth->rest())
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  length_ = norm(high - low);
  reach_ = length_;
  for (const Vec3& x : structure.cloth->rest()) reach_ = std::max(reach_, norm(x));
  K_ = structure.tangent->sparsity();
  K_.values.resize(9 * K_.columns.size());
  q_.resize(structure.cloth->rest().size());
  f_.resize(q_.size());
  external_.resize(q_.size());
  free_.resize(structure.cloth->map().home.size());
  history_.resize(structure.cloth->historySize());
  trial_.resize(history_.size());
  structure.cloth->startHistory(history_);
}

void StructureSystem::setHistory(std::span<const double> history, double t) {
  history_.assign(history.begin(), history.end());
  committed_t_ = t;
  residual_y_.clear();
  at_y_.clear();
}

double StructureSystem::commit(std::span<const double> y, double t) {
  if (history_.empty()) return 0;
  if (residual_t_ != t || !std::equal(y.begin(), y.end(), residual_y_.begin(), residual_y_.end())) {
    std::vector<double> unused(y.size());
    residual(y, t, unused);
  }
  history_.swap(trial_);
  committed_t_ = t;
  residual_y_.clear();
  at_y_.clear();
  return energy_.lost;
}

void StructureSystem::place(std::span<const double> y, double t) {
  value_ = programValues(structure_, t, ends_);
  u_ = freeDisplacements(structure_, y, value_);
  const std::span<const Vec3> u(reinterpret_cast<const Vec3*>(u_.data()), u_.size() / 3);
  structure_.cloth->map().T.multiply<Vec3>(u, q_);
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] += structure_.cloth->rest()[i];
}

double StructureSystem::residual(std::span<const double> y, double t, std::span<double> g) {
  place(y, t);
  structure_.cloth->force(stateAt(t), {f_, {}, trial_, history_.empty() ? nullptr : &energy_}, work_);
  residual_y_.assign(y.begin(), y.end());
  residual_t_ = t;
  std::fill(external_.begin(), external_.end(), Vec3{});
  structure_.loads.add(q_, value_, external_);
  structure_.cloth->map().Tt.multiply<Vec3>(f_, free_);
  double size = sizeOf(free_);
  for (std::size_t i = 0; i < f_.size(); ++i) f_[i] += external_[i];
  structure_.cloth->map().Tt.multiply<Vec3>(external_, free_);
  size = std::max(size, sizeOf(free_));
  structure_.cloth->map().Tt.multiply<Vec3>(f_, free_);
  structure_.dofs.Ct.multiply<double>(flat(free_), g);
  for (double& v : g) v = -v;
  return size;
}

void StructureSystem::assemble(std::span<const double> y, double t) {
  if (at_t_ == t && std::equal(y.begin(), y.end(), at_y_.begin(), at_y_.end())) return;
  place(y, t);
  structure_.tangent->assemble(stateAt(t), work_, K_);
  if (structure_.loads.follow()) structure_.loads.addStiffness(q_, value_, structure_.cloth->map(), K_);
  at_y_.assign(y.begin(), y.end());
  at_t_ = t;
}

void StructureSystem::stiffness(std::span<const double> y, double t, SymmetricMatrix& K, bool steepest) {
  if (steepest) {
    place(y, t);
    ForceTerms terms;
    terms.steepest = true;
    structure_.tangent->assemble(stateAt(t), work_, K_, terms);
    at_y_.clear();
  } else {
    assemble(y, t);
  }
  structure_.reduction.reduce(K_, K);
}

void StructureSystem::change(std::span<const double> y, double t0, double t1, std::span<double> dg) {
  std::vector<double> difference = programValues(structure_, t1, ends_);
  const std::vector<double> before = programValues(structure_, t0, ends_);
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= before[k];
  std::vector<double> force(3 * free_.size(), 0.0);
  if (moves(structure_.dofs)) {
    assemble(y, t0);
    std::vector<double> shift(force.size(), 0.0);
    addShifts(structure_.dofs, difference, shift);
    multiply(K_, shift, force);
  }
  place(y, t0);
  std::fill(external_.begin(), external_.end(), Vec3{});
  structure_.loads.add(q_, difference, external_);
  structure_.cloth->map().Tt.multiply<Vec3>(external_, free_);
  const std::span<const double> external = flat(free_);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] -= external[i];
  structure_.dofs.Ct.multiply<double>(force, dg);
}

std::string StructureSystem::describe(std::span<const double> motion) const {
  return describeMotion(structure_, motion);
}

BlockMatrix StructureSystem::massBlocks(bool lumped) const {
  BlockMatrix M = structure_.tangent->sparsity();
  M.values.assign(9 * M.columns.size(), 0.0);
  const auto set = [&](long k, double m) {
    for (int d = 0; d < 3; ++d) M.values[9 * k + 4 * d] = m;
  };
  const SparseRows& consistent = structure_.consistent_kg;
  for (int r = 0; r < M.rows(); ++r) {
    long k = M.offsets[r];  // of the diagonal block
    if (lumped) {
      set(k, structure_.lumped_kg[r]);
      continue;
    }
    for (int e = consistent.offsets[r]; e < consistent.offsets[r + 1]; ++e) {
      if (consistent.columns[e] < r) continue;
      while (k < M.offsets[r + 1] && M.columns[k] < consistent.columns[e]) ++k;
      assert(k < M.offsets[r + 1] && M.columns[k] == consistent.columns[e]);
      set(k, consistent.values[e]);
    }
  }
  return M;
}

void StructureSystem::mass(bool lumped, SymmetricMatrix& M) { structure_.reduction.reduce(massBlocks(lumped), M); }

void StructureSystem::damping(std::span<const double> y, double t, bool lumped, bool stiffness_part,
                              SymmetricMatrix& D) {
  damping_K_ = massBlocks(lumped);
  for (double& v : damping_K_.values) v *= structure_.rayleigh_mass_per_s;
  for (int r = 0; r < damping_K_.rows(); ++r)
    for (int d = 0; d < 3; ++d)
      damping_K_.values[9 * damping_K_.offsets[r] + 4 * d] += structure_.drag_kg_per_m2s * structure_.area_m2[r];
  if (stiffness_part && structure_.cloth->damps()) {
    BlockMatrix own;
    place(y, t);
    structure_.tangent->assembleDamping(stateAt(t), work_, own);
    for (std::size_t i = 0; i < damping_K_.values.size(); ++i) damping_K_.values[i] += own.values[i];
  }
  if (stiffness_part && structure_.rayleigh_stiffness_s > 0) {
    assemble(y, t);
    for (std::size_t i = 0; i < damping_K_.values.size(); ++i)
      damping_K_.values[i] += structure_.rayleigh_stiffness_s * K_.values[i];
  }
  structure_.reduction.reduce(damping_K_, D);
}

void StructureSystem::supportForce(double t, double dt, bool lumped, std::span<double> f) {
  std::fill(f.begin(), f.end(), 0.0);
  if (!moves(structure_.dofs)) return;
  std::vector<double> v = programValues(structure_, t + dt, ends_), a = v;
  const std::vector<double> now = programValues(structure_, t, ends_),
                            before = programValues(structure_, t - dt, ends_);
  bool still = true;
  for (std::size_t k = 0; k < v.size(); ++k) {
    a[k] = (v[k] - 2 * now[k] + before[k]) / (dt * dt);
    v[k] = (v[k] - before[k]) / (2 * dt);
    still = still && v[k] == 0 && a[k] == 0;
  }
  if (still) return;
  std::vector<double> velocity(3 * free_.size(), 0.0), acceleration = velocity, force = velocity;
  addShifts(structure_.dofs, v, velocity);
  addShifts(structure_.dofs, a, acceleration);
  const BlockMatrix M = massBlocks(lumped);
  multiply(M, acceleration, force);
  if (!damping_K_.values.empty()) {
    multiply(damping_K_, velocity, acceleration);
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += acceleration[i];
  }
  structure_.dofs.Ct.multiply<double>(force, f);
}

}  // namespace gambeson
