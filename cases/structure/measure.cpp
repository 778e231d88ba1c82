#include "cases/structure/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/structure/director_moments.hpp"
#include "cases/structure/stiffness_damping.hpp"
#include "core/math/carried_error.hpp"
#include "core/math/parallel.hpp"
#include "core/motion/cloth_damping.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

/// Of components of the free points, and what inner unknowns are behind them.
std::span<const Vec3> asPoints(const Structure& s, const std::vector<double>& u) {
  return {reinterpret_cast<const Vec3*>(u.data()), s.cloth->map().home.size()};
}

double largest(std::span<const Vec3> v) {
  double most = 0;
  for (const Vec3& x : v) most = std::max(most, norm(x));
  return most;
}

double sizeOf(std::span<const Vec3> v) {
  Vec3 low = v[0], high = v[0];
  for (const Vec3& x : v)
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], x[c]);
      high[c] = std::max(high[c], x[c]);
    }
  return norm(high - low);
}

std::vector<Vec3> restPlus(const Structure& s, const std::vector<double>& u, double scale) {
  std::vector<Vec3> q(s.cloth->rest().size());
  s.cloth->map().T.multiply<Vec3>(asPoints(s, u), q);
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = s.cloth->rest()[i] + scale * q[i];
  return q;
}

std::vector<Vec3> pulledBack(const Structure& s, const std::vector<Vec3>& f) {
  std::vector<Vec3> free(s.cloth->map().home.size());
  s.cloth->map().Tt.multiply<Vec3>(f, free);
  return free;
}

/// The elastic stiffness at rest times displacements of the free points and changes of inner unknowns.
std::vector<double> linearForce(const Structure& s, const std::vector<double>& u) {
  BlockMatrix K = s.tangent->sparsity();
  ClothWork work;
  s.tangent->assemble(s.cloth->rest(), work, K);
  std::vector<double> f(u.size());
  multiply(K, u, f);
  return f;
}

/// Second differences of the programs over the last step; 0 where there was none.
std::vector<double> secondRates(const Structure& s, double t, double dt) {
  std::vector<double> second(s.programs.size(), 0.0);
  if (!(dt > 0)) return second;
  const std::vector<double> after = programValues(s, t + dt, ProgramEnds::constant),
                            now = programValues(s, t, ProgramEnds::constant),
                            before = programValues(s, t - dt, ProgramEnds::constant);
  for (std::size_t k = 0; k < second.size(); ++k) second[k] = (after[k] - 2 * now[k] + before[k]) / (dt * dt);
  return second;
}

const char* const axes[] = {"x", "y", "z"};

void addVector(std::vector<std::string>& columns, const std::string& name, const char* letter, const char* unit) {
  for (const char* axis : axes) columns.push_back(fmt::format("{}_{}{}_{}", name, letter, axis, unit));
}

void addVector(std::vector<double>& values, const Vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

}  // namespace

MeasuredState measureStatic(const Structure& s, std::span<const double> y, double factor, bool linear,
                            std::span<const double> history) {
  MeasuredState m;
  m.at = factor;
  m.small = linear;
  if (!linear) {
    m.q = controlPoints(s, y, factor, ProgramEnds::extended);
    m.reaction_N = pulledBack(s, reactions(s, y, factor, ProgramEnds::extended, history));
    m.turning_Nm = directorMoments(s, {m.q, innerValues(s, y, factor, ProgramEnds::extended), history},
                                   programValues(s, factor, ProgramEnds::extended));
    m.strain_energy_J = strainEnergy(s, y, factor, ProgramEnds::extended, history);
    m.history.assign(history.begin(), history.end());
    return m;
  }
  const std::vector<double> programs = programValues(s, factor, ProgramEnds::extended);
  const std::vector<double> u = freeDisplacements(s, y, programs);
  m.q = restPlus(s, u, 1);
  const std::vector<double> pull = linearForce(s, u);
  m.reaction_N.assign(asPoints(s, pull).begin(), asPoints(s, pull).end());
  for (std::size_t k = 0; k < u.size(); k += 3)
    m.strain_energy_J += 0.5 * dot(Vec3{u[k], u[k + 1], u[k + 2]}, Vec3{pull[k], pull[k + 1], pull[k + 2]});
  std::vector<Vec3> external(s.cloth->rest().size());
  s.loads.add(s.cloth->rest(), programs, external);
  const std::vector<Vec3> load = pulledBack(s, external);
  for (std::size_t f = 0; f < load.size(); ++f) m.reaction_N[f] -= load[f];
  m.turning_Nm = directorMoments(s, std::span(pull).subspan(3 * load.size()), programs);
  return m;
}

MeasuredState measureDynamic(const StructureModel& model, const State& state, bool lumped_mass, double step_s) {
  const Structure& s = *model.structure;
  MeasuredState m;
  m.at = state.time_s;
  m.q = controlPoints(s, state);
  m.strain_energy_J = strainEnergy(s, {m.q, state.inner, state.history});
  m.reaction_N = pulledBack(s, reactions(s, {m.q, state.inner, state.history}, state.time_s, ProgramEnds::constant));
  const std::size_t n = state.v.size();
  // What supports push with, beyond what the sheet pulls with: inertia and damping. The acceleration of the state is
  // without what supports prescribe.
  const std::vector<double> none(static_cast<std::size_t>(s.dofs.unknowns()), 0.0),
      prescribed = freeDisplacements(s, none, secondRates(s, state.time_s, step_s));
  std::vector<Vec3> inertia(n), force(n);
  for (std::size_t f = 0; f < n; ++f)
    inertia[f] = state.a[f] + asPoints(s, prescribed)[f] + s.rayleigh_mass_per_s * state.v[f];
  if (lumped_mass)
    for (std::size_t f = 0; f < n; ++f) force[f] = s.lumped_kg[f] * inertia[f];
  else
    s.consistent_kg.multiply<Vec3>(inertia, force);
  for (std::size_t f = 0; f < n; ++f) m.reaction_N[f] += force[f] + s.drag_kg_per_m2s * s.area_m2[f] * state.v[f];
  const std::vector<Vec3> damping_N = clothDamping(*s.cloth, m.q, state.v);
  for (std::size_t f = 0; f < damping_N.size(); ++f) m.reaction_N[f] -= damping_N[f];
  std::vector<double> turning(prescribed.begin() + static_cast<long>(3 * n), prescribed.end());
  for (std::size_t k = 0; k < state.inner_acceleration.size(); ++k) turning[k] += state.inner_acceleration[k];
  m.turning_Nm =
      directorMoments(s, {m.q, state.inner, state.history}, programValues(s, state.time_s, ProgramEnds::constant),
                      state.inner_rate, turning);
  if (s.rayleigh_stiffness_s > 0) {
    const std::vector<double> damping = stiffnessDamping(s, state, m.q);
    for (std::size_t f = 0; f < n; ++f) m.reaction_N[f] += asPoints(s, damping)[f];
    for (std::size_t k = 0; k < 3 * m.turning_Nm.size(); ++k)
      m.turning_Nm[k / 3][static_cast<int>(k % 3)] += damping[3 * n + k];
  }
  if (!state.limit_J.empty()) {
    // The acceleration of the state is without the limits': what they push on free points is inertia there.
    const StrainRows& rows = model.motion->strain_rows;
    std::vector<Vec3> pull(n), moved(n);
    limitForce(rows, state.p, state.limit_J, pull);
    applyMobility(rows.mobility, pull, moved);
    for (std::size_t f = 0; f < n; ++f) m.reaction_N[f] += s.lumped_kg[f] * moved[f] - pull[f];
    m.limit_N_per_m = limitStress(rows, state.limit_J);
  }
  m.velocity.resize(s.cloth->rest().size());
  s.cloth->map().T.multiply<Vec3>(state.v, m.velocity);
  return m;
}

MeasuredState measureMode(const Structure& s, std::span<const double> y, double factor, std::span<const double> shape,
                          double amplitude_m) {
  MeasuredState m;
  m.small = true;
  const std::vector<double> u = freeDisplacements(s, shape, std::vector<double>(s.programs.size(), 0.0));
  std::vector<Vec3> d = restPlus(s, u, 1);
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= s.cloth->rest()[i];
  const double most = largest(d);
  m.q = y.empty() ? s.cloth->rest() : controlPoints(s, y, factor, ProgramEnds::extended);
  for (std::size_t i = 0; i < d.size(); ++i) m.q[i] += (most > 0 ? amplitude_m / most : 0) * d[i];
  return m;
}

StressState::StressState(const StructureModel& model, const MeasuredState& state, bool everywhere)
    : model_(model), q_(state.q), history_(state.history), limit_(state.limit_N_per_m) {
  const Structure& structure = *model.structure;
  if (state.small) {
    // Principal values are homogeneous of degree one in small displacements: taken from a part of them so small that
    // the quadratic terms are below 1e-5 of the linear ones.
    for (std::size_t i = 0; i < q_.size(); ++i) q_[i] -= structure.cloth->rest()[i];
    const double most = largest(q_);
    part_ = most > 0 ? std::min(1.0, 1e-7 * sizeOf(structure.cloth->rest()) / most) : 1;
    for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = structure.cloth->rest()[i] + part_ * q_[i];
  }
  if (everywhere) means_ = model.stress->means({q_, {}, history_}, more());
}

StressView::More StressState::more() const {
  if (limit_.empty()) return {};
  return [this](int patch, Vec2 uv) {
    return model_.structure->cloth->limitStressAt(model_.motion->strain_rows, limit_, patch, uv);
  };
}

PrincipalStress StressState::at(int patch, Vec2 uv) const {
  PrincipalStress stress = model_.stress->at({q_, {}, history_}, patch, uv, means_, more());
  stress.principal1_N_per_m /= part_;
  stress.principal2_N_per_m /= part_;
  stress.strain1 /= part_;
  stress.strain2 /= part_;
  return stress;
}

Probes::Probes(const StructureCase& c, const StructureModel& model, const StructureOptions& options)
    : model_(&model),
      structure_(model.structure.get()),
      with_velocity_(c.kind == StructureKind::dynamics),
      displacements_only_(c.kind == StructureKind::modal) {
  const Structure& s = *structure_;
  const Mounting& mounting = s.cloth->mounting();
  // Free points that a control point moves.
  const auto freeOf = [&](int control, std::set<int>& into) {
    for (int e = s.cloth->map().T.offsets[control]; e < s.cloth->map().T.offsets[control + 1]; ++e)
      into.insert(s.cloth->map().T.columns[e]);
  };
  // A support that moves several points as one pushes on all of them: between them its forces are inner ones.
  std::vector<std::set<int>> ties;
  for (const LinearConstraint& l : options.constraints) {
    std::set<int> tied;
    for (const auto& [control, coefficient] : l.terms) freeOf(control, tied);
    if (tied.size() > 1) ties.push_back(std::move(tied));
  }
  const auto withTies = [&](std::set<int>& points) {
    for (std::size_t before = 0; before != points.size();) {
      before = points.size();
      for (const std::set<int>& tied : ties)
        if (std::any_of(tied.begin(), tied.end(), [&](int f) { return points.contains(f); }))
          points.insert(tied.begin(), tied.end());
    }
  };
  for (const OutputPoint& p : c.output.points) {
    PointProbe probe;
    std::tie(probe.patch, probe.uv) = locate(model.sheet, p.where);
    probe.uv = s.cloth->placeOfDraft(probe.patch, probe.uv);
    const PlaceRow at = mounting.place(probe.patch, probe.uv);
    std::set<int> free;
    for (std::size_t k = 0; k < at.columns.size(); ++k) {
      if (at.value[k] == 0) continue;
      probe.control.emplace_back(at.columns[k], at.value[k]);
      freeOf(at.columns[k], free);
    }
    withTies(free);
    probe.free.assign(free.begin(), free.end());
    points_.push_back(std::move(probe));
    addVector(columns_, p.name, "u", "m");
    if (with_velocity_) addVector(columns_, p.name, "v", "m_per_s");
    if (displacements_only_) continue;
    for (const char* what : {"n1_N_per_m", "n2_N_per_m", "e1", "e2"}) columns_.push_back(p.name + "_" + what);
    addVector(columns_, p.name, "r", "N");
  }
  for (const OutputEdge& e : c.output.edges) {
    EdgeProbe probe;
    probe.weight.assign(static_cast<std::size_t>(s.cloth->points()), 0.0);
    std::set<int> on_edge, of_this, of_others;
    double length = 0;
    const std::vector<PatchEdge> edges = edgesOf(model.sheet, e.where);
    for (const PatchEdge& edge : edges) {
      const std::vector<Vec3> line = mounting.edgeForce(edge, {1, 0, 0});
      for (std::size_t k = 0; k < line.size(); ++k) {
        probe.weight[k] += line[k].x;
        length += line[k].x;
      }
      for (const int control : mounting.edgePoints(edge)) freeOf(control, on_edge);
    }
    for (double& w : probe.weight) w /= length;
    // A clamp pushes on the row beside the edge as well; what another support holds there is not the edge's.
    for (std::size_t i = 0; i < c.supports.size(); ++i) {
      bool mine = false;
      if (const auto* at = std::get_if<EdgeAt>(&c.supports[i].where))
        for (const PatchEdge& a : edgesOf(model.sheet, *at))
          for (const PatchEdge& b : edges) mine = mine || (a.patch == b.patch && a.side == b.side);
      const std::string name = fmt::format("supports[{}]", i);
      for (const LinearConstraint& l : options.constraints)
        if (l.name == name)
          for (const auto& [control, coefficient] : l.terms) freeOf(control, mine ? of_this : of_others);
    }
    for (const int f : of_this)
      if (!of_others.contains(f)) on_edge.insert(f);
    probe.free.assign(on_edge.begin(), on_edge.end());
    probe.directors = directorsOn(*s.cloth, edges);
    edges_.push_back(std::move(probe));
    addVector(columns_, e.name, "u", "m");
    addVector(columns_, e.name, "r", "N");
    addVector(columns_, e.name, "m", "Nm");
  }
}

std::vector<double> Probes::values(const MeasuredState& state) const {
  const Structure& s = *structure_;
  std::vector<double> row;
  const StressState stresses(*model_, state, false);
  for (const PointProbe& p : points_) {
    Vec3 u, v, r;
    for (const auto& [control, value] : p.control) {
      const auto k = static_cast<std::size_t>(control);
      u += value * (state.q[k] - s.cloth->rest()[k]);
      if (!state.velocity.empty()) v += value * state.velocity[k];
    }
    // A force F at the point is N F on the control points, and N sums to 1.
    if (!state.reaction_N.empty())
      for (const int f : p.free) r += state.reaction_N[static_cast<std::size_t>(f)];
    addVector(row, u);
    if (with_velocity_) addVector(row, v);
    if (displacements_only_) continue;
    const PrincipalStress stress = stresses.at(p.patch, p.uv);
    row.insert(row.end(), {stress.principal1_N_per_m, stress.principal2_N_per_m, stress.strain1, stress.strain2});
    addVector(row, r);
  }
  for (const EdgeProbe& e : edges_) {
    Vec3 u, middle, force, moment;
    for (std::size_t k = 0; k < e.weight.size(); ++k) {
      u += e.weight[k] * (state.q[k] - s.cloth->rest()[k]);
      middle += e.weight[k] * (state.small ? s.cloth->rest()[k] : state.q[k]);
    }
    for (const int f : e.free) {
      const auto home = static_cast<std::size_t>(s.cloth->map().home[static_cast<std::size_t>(f)]);
      const Vec3& r = state.reaction_N[static_cast<std::size_t>(f)];
      force += r;
      moment += cross((state.small ? s.cloth->rest()[home] : state.q[home]) - middle, r);
    }
    for (const int d : e.directors) moment += state.turning_Nm[static_cast<std::size_t>(d)];
    addVector(row, u);
    addVector(row, force);
    addVector(row, moment);
  }
  return row;
}

MeshShape shapeOf(const StructureModel& model, const PlaceMesh& mesh, const MeasuredState& state) {
  const Structure& s = *model.structure;
  const int n = static_cast<int>(mesh.uv.size());
  const StressState stresses(model, state, true);
  MeshShape shape;
  shape.rest.resize(mesh.uv.size());
  shape.x.resize(mesh.uv.size());
  shape.normal.resize(mesh.uv.size());
  shape.stress.resize(mesh.uv.size());
  CarriedError error;
  const auto sample = [&](std::size_t k) {
    const PlaceRow at = s.cloth->mounting().place(mesh.patch[k], mesh.uv[k]);
    shape.rest[k] = combine(at.columns, at.value, s.cloth->rest());
    shape.x[k] = combine(at.columns, at.value, state.q);
    const Vec3 a = cross(combine(at.columns, at.d1, state.q), combine(at.columns, at.d2, state.q));
    shape.normal[k] = norm(a) > 0 ? normalized(a) : Vec3{0, 0, 1};
    shape.stress[k] = stresses.at(mesh.patch[k], mesh.uv[k]);
  };
  forAll(Each::much, n, [&](int i) { error.guard(i, [&] { sample(static_cast<std::size_t>(i)); }); });
  error.rethrow();
  return shape;
}

}  // namespace gambeson
