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

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

double sizeOf(std::span<const Vec3> v) {
  double sum = 0;
  for (const Vec3& f : v) sum += norm2(f);
  return std::sqrt(sum);
}

}  // namespace

std::vector<double> freeDisplacements(const Structure& s, std::span<const double> y, std::span<const double> value) {
  std::vector<double> u(s.dofs.C.rows());
  s.dofs.C.multiply<double>(y.first(static_cast<std::size_t>(s.dofs.unknowns())), u);
  addShifts(s.dofs, value, u);
  return u;
}

namespace {

/// What becomes of inner values along the components u of all blocks, `times` over.
std::vector<double> movedInner(const Structure& s, std::span<const double> from, std::span<const double> u,
                               double times) {
  std::vector<double> to(from.size());
  s.cloth->advance(from, u.subspan(3 * s.cloth->map().home.size(), s.cloth->innerRates()), times, to);
  return to;
}

/// The motion of supports alone.
std::vector<double> shifts(const Structure& s, std::span<const double> value) {
  std::vector<double> u(static_cast<std::size_t>(s.dofs.C.rows()), 0.0);
  addShifts(s.dofs, value, u);
  return u;
}

}  // namespace

std::vector<double> innerValues(const Structure& s, std::span<const double> y, std::span<const double> value) {
  std::vector<double> start(s.cloth->innerValues());
  if (start.empty()) return start;
  s.cloth->startInner(start);
  if (!s.cloth->turnsInner()) return movedInner(s, start, freeDisplacements(s, y, value), 1);
  const auto unknowns = static_cast<std::size_t>(s.dofs.unknowns());
  if (y.size() == unknowns)
    start = movedInner(s, start, freeDisplacements(s, y, std::vector<double>(value.size(), 0.0)), 1);
  else
    start.assign(y.begin() + static_cast<long>(unknowns), y.end());
  return moves(s.dofs) ? movedInner(s, start, shifts(s, value), 1) : start;
}

std::vector<double> turnedValues(const Structure& s, std::span<const double> inner, std::span<const double> value) {
  if (!s.cloth->turnsInner()) return {};
  if (!moves(s.dofs)) return {inner.begin(), inner.end()};
  return movedInner(s, inner, shifts(s, value), -1);
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
  inner_f_.resize(structure.cloth->innerRates());
  inner_external_.resize(inner_f_.size());
  free_.resize(static_cast<std::size_t>(structure.dofs.C.rows()));
  history_.resize(structure.cloth->historySize());
  trial_.resize(history_.size());
  structure.cloth->startHistory(history_);
}

std::vector<double> StructureSystem::start() const {
  std::vector<double> y(static_cast<std::size_t>(size()), 0.0);
  if (!structure_.cloth->turnsInner()) return y;
  y.resize(y.size() + structure_.cloth->innerValues());
  structure_.cloth->startInner(std::span(y).subspan(static_cast<std::size_t>(size())));
  return y;
}

void StructureSystem::retract(std::span<const double> y, std::span<const double> dy, double s, double t,
                              std::span<double> out) const {
  const auto unknowns = static_cast<std::size_t>(size());
  if (structure_.cloth->turnsInner()) {
    const std::vector<double> value = programValues(structure_, t, ends_);
    std::vector<double> change(static_cast<std::size_t>(structure_.dofs.C.rows()));
    structure_.dofs.C.multiply<double>(dy, change);
    const std::vector<double> now = movedInner(structure_, innerValues(structure_, y, value), change, s),
                              behind = turnedValues(structure_, now, value);
    std::copy(behind.begin(), behind.end(), out.begin() + static_cast<long>(unknowns));
  }
  System::retract(y.first(unknowns), dy, s, t, out);
}

void StructureSystem::dropIdle(std::span<const double> y, double t, std::span<double> rate) const {
  if (!structure_.cloth->turnsInner()) return;
  std::vector<double> u(static_cast<std::size_t>(structure_.dofs.C.rows()));
  structure_.dofs.C.multiply<double>(rate, u);
  structure_.cloth->dropIdle(
      innerValues(structure_, y, programValues(structure_, t, ends_)),
      std::span(u).subspan(3 * structure_.cloth->map().home.size(), structure_.cloth->innerRates()));
  for (int j = 0; j < size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    rate[k] = structure_.dofs.unknownOf(j, u[static_cast<std::size_t>(structure_.dofs.component[k])]);
  }
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
    std::vector<double> unused(static_cast<std::size_t>(size()));
    residual(y, t, unused);
  }
  history_.swap(trial_);
  committed_t_ = t;
  lost_q_.clear();
  residual_y_.clear();
  at_y_.clear();
  return energy_.lost;
}

void StructureSystem::place(std::span<const double> y, double t) {
  value_ = programValues(structure_, t, ends_);
  u_ = freeDisplacements(structure_, y, value_);
  const std::span<const Vec3> u(reinterpret_cast<const Vec3*>(u_.data()), structure_.cloth->map().home.size());
  structure_.cloth->map().T.multiply<Vec3>(u, q_);
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] += structure_.cloth->rest()[i];
  inner_ = innerValues(structure_, y, value_);
}

void StructureSystem::pullBack(const std::vector<Vec3>& f, std::span<const double> inner,
                               std::vector<double>& out) const {
  const std::size_t points = structure_.cloth->map().home.size();
  structure_.cloth->map().Tt.multiply<Vec3>(f, std::span(reinterpret_cast<Vec3*>(out.data()), points));
  std::copy(inner.begin(), inner.end(), out.begin() + static_cast<long>(3 * points));
}

double StructureSystem::residual(std::span<const double> y, double t, std::span<double> g) {
  place(y, t);
  structure_.cloth->force(stateAt(t), {f_, inner_f_, trial_, history_.empty() ? nullptr : &energy_}, work_);
  residual_y_.assign(y.begin(), y.end());
  residual_t_ = t;
  std::fill(external_.begin(), external_.end(), Vec3{});
  std::fill(inner_external_.begin(), inner_external_.end(), 0.0);
  structure_.loads.add(q_, value_, external_);
  structure_.loads.addInner(value_, inner_external_);
  // How large they are is said of the points: forces of inner unknowns are small beside those wherever these are not.
  const std::span<const Vec3> of_points(reinterpret_cast<const Vec3*>(free_.data()),
                                        structure_.cloth->map().home.size());
  pullBack(f_, inner_f_, free_);
  double size = sizeOf(of_points);
  pullBack(external_, inner_external_, free_);
  size = std::max(size, sizeOf(of_points));
  // But moments on directors may be all that acts (pure bending): as forces on the arm of the whole.
  if (structure_.cloth->turnsInner())
    size = std::max({size, norm(inner_f_) / length_, norm(inner_external_) / length_});
  for (std::size_t i = 0; i < f_.size(); ++i) f_[i] += external_[i];
  for (std::size_t i = 0; i < inner_f_.size(); ++i) inner_f_[i] += inner_external_[i];
  pullBack(f_, inner_f_, free_);
  structure_.dofs.Ct.multiply<double>(free_, g);
  for (double& v : g) v = -v;
  if (!std::isfinite(norm(free_))) ++lost_tries_, lost_q_ = q_, lost_inner_ = inner_;
  return size;
}

LawRange StructureSystem::unanswered() const {
  return lost_q_.empty() ? LawRange{} : structure_.cloth->lawRange({lost_q_, lost_inner_, history_});
}

std::string StructureSystem::whyNotFinite() const {
  const LawRange range = unanswered();
  return range.first ? unansweredInWords(range) : std::string();
}

void StructureSystem::assemble(std::span<const double> y, double t) {
  if (at_t_ == t && std::equal(y.begin(), y.end(), at_y_.begin(), at_y_.end())) return;
  place(y, t);
  structure_.tangent->assemble(stateAt(t), work_, K_);
  structure_.tangent->holdIdle(stateAt(t), K_);
  if (structure_.loads.follow()) structure_.loads.addStiffness(q_, value_, structure_.cloth->map(), K_);
  at_y_.assign(y.begin(), y.end());
  at_t_ = t;
}

void StructureSystem::assemble(std::span<const double> y, double t, const ForceTerms& terms) {
  place(y, t);
  structure_.tangent->assemble(stateAt(t), work_, K_, terms);
  at_y_.clear();
}

void StructureSystem::stiffnessInMotion(std::span<const double> y, double t, SymmetricMatrix& K) {
  if (!structure_.cloth->turnsInner()) return stiffness(y, t, K);
  assemble(y, t, ForceTerms{});
  if (structure_.loads.follow()) structure_.loads.addStiffness(q_, value_, structure_.cloth->map(), K_);
  structure_.reduction.reduce(K_, K);
}

/// Shear of a shell with directors is as stiff as its membrane, so that the rounding of a turn of the whole is of the
/// membrane's: at most 6e-12 of it on 4 to 40 cells along an edge. A clamped sheet has 2e-11 at a thickness of 1e-5 of
/// its length, and goes with the square.
double StructureSystem::looseness() const { return structure_.cloth->turnsInner() ? 1e-11 : System::looseness(); }

void StructureSystem::stiffness(std::span<const double> y, double t, SymmetricMatrix& K, bool steepest) {
  if (steepest) {
    ForceTerms terms;
    terms.steepest = true;
    assemble(y, t, terms);
  } else {
    assemble(y, t);
  }
  structure_.reduction.reduce(K_, K);
}

void StructureSystem::change(std::span<const double> y, double t0, double t1, std::span<double> dg) {
  std::vector<double> difference = programValues(structure_, t1, ends_);
  const std::vector<double> before = programValues(structure_, t0, ends_);
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= before[k];
  std::vector<double> force(free_.size(), 0.0);
  if (moves(structure_.dofs)) {
    assemble(y, t0);
    std::vector<double> shift(force.size(), 0.0);
    addShifts(structure_.dofs, difference, shift);
    multiply(K_, shift, force);
  }
  place(y, t0);
  std::fill(external_.begin(), external_.end(), Vec3{});
  std::fill(inner_external_.begin(), inner_external_.end(), 0.0);
  structure_.loads.add(q_, difference, external_);
  structure_.loads.addInner(difference, inner_external_);
  pullBack(external_, inner_external_, free_);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] -= free_[i];
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
  for (std::size_t k = 0; k < structure_.inner_mass.size(); ++k)
    M.values[9 * M.offsets[structure_.lumped_kg.size() + k / 3] + 4 * (k % 3)] = structure_.inner_mass[k];
  for (int r = 0; r < static_cast<int>(structure_.lumped_kg.size()); ++r) {
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
  for (int r = 0; r < static_cast<int>(structure_.area_m2.size()); ++r)
    for (int d = 0; d < 3; ++d)
      damping_K_.values[9 * damping_K_.offsets[r] + 4 * d] += structure_.drag_kg_per_m2s * structure_.area_m2[r];
  if (const std::vector<double>& inner = structure_.inner_mass; !inner.empty()) {
    const double drag = structure_.innerDrag();
    for (std::size_t k = 0; k < inner.size(); ++k)
      damping_K_.values[9 * damping_K_.offsets[structure_.area_m2.size() + k / 3] + 4 * (k % 3)] += drag * inner[k];
  }
  if (stiffness_part && structure_.cloth->damps()) {
    BlockMatrix own;
    place(y, t);
    structure_.tangent->assembleDamping(stateAt(t), work_, own);
    for (std::size_t i = 0; i < damping_K_.values.size(); ++i) damping_K_.values[i] += own.values[i];
  }
  if (stiffness_part && structure_.rayleigh_stiffness_s > 0) {
    // Of directors the part of the material alone (Man 2006, eq. 2.85): the stress' would damp turns of the whole.
    if (structure_.cloth->turnsInner()) {
      ForceTerms terms;
      terms.definite = true;
      assemble(y, t, terms);
    } else {
      assemble(y, t);
    }
    for (std::size_t i = 0; i < damping_K_.values.size(); ++i)
      damping_K_.values[i] += structure_.rayleigh_stiffness_s * K_.values[i];
  }
  structure_.reduction.reduce(damping_K_, D);
}

void StructureSystem::supportForce(double t, double dt, bool lumped, SupportForces which, std::span<double> f) {
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
  std::vector<double> velocity(free_.size(), 0.0), acceleration = velocity, force = velocity;
  addShifts(structure_.dofs, v, velocity);
  addShifts(structure_.dofs, a, acceleration);
  if (which != SupportForces::damping) multiply(massBlocks(lumped), acceleration, force);
  if (which != SupportForces::inertia && !damping_K_.values.empty()) {
    multiply(damping_K_, velocity, acceleration);
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += acceleration[i];
  }
  structure_.dofs.Ct.multiply<double>(force, f);
}

}  // namespace gambeson
