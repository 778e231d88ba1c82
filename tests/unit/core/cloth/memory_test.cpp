/// Cloth whose law remembers: energy, what steps commit and what they do not, on every kind of cloth.

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/cloth/degenerated/degenerated_shell.hpp"
#include "core/material/hysteresis.hpp"
#include "core/motion/implicit.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "core/statics/path.hpp"
#include "core/statics/structure_system.hpp"
#include "unit/core/cloth/triangles/triangle_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kSide_m = 0.2, kRigidity_Nm = 2e-5, kYield_N = 1e-4;  // it yields at a curvature of 5 1/m

BendingLaw stopLaw() { return StopBending{{kRigidity_Nm, kRigidity_Nm, 0.5 * kRigidity_Nm}, kYield_N}; }
double stopLoss(double K) { return 4 * kYield_N * (K - kYield_N / kRigidity_Nm); }

/// Friction is overcome at 8 1/m.
template <class L>
L loop(double setting, double fatigue) {
  const Stops<kStops> stops = stopsOf<kStops>(curveOver(kRigidity_Nm, 0.3 * kRigidity_Nm, 8));
  L law;
  law.weft_Nm = law.warp_Nm = stops.last_Nm;
  law.twist_Nm = 0.5 * stops.last_Nm;
  law.shape = stops.shape;
  law.first_Nm = {stops.first_Nm, stops.first_Nm, 0.5 * stops.first_Nm};
  law.span_per_m = {8, 8, 8};
  law.setting = setting;
  law.fatigue = fatigue;
  law.cycle_per_m = 20;
  return law;
}
BendingLaw loopLaw() { return loop<IsotropicHysteresisBending>(0, 0); }
double loopLoss(double K) { return 0.7 * kRigidity_Nm * cycleLoss(loop<IsotropicHysteresisBending>(0, 0).shape, 8, K); }
BendingLaw ageingLaw() { return loop<HysteresisBending>(0.3, 0.1); }
BendingLaw recoveringLaw() {
  auto law = loop<Recovering<IsotropicHysteresisBending>>(0, 0);
  law.part = 0.5;
  law.time_s = 0.01;
  return law;
}

enum class Of { nurbs, triangles, shell };

/// A law on a kind of cloth.
struct Remembers {
  const char* name;
  Of kind;
  BendingLaw (*law)();
  std::size_t doubles;               ///< that a point remembers
  double (*loss)(double) = nullptr;  ///< of a cycle to a curvature and back [J/m^2], where that has a closed form
  BendingElements bending = BendingElements::hinge;  ///< of triangles
};

class Memory : public testing::TestWithParam<Remembers> {
 protected:
  std::unique_ptr<const Cloth> cloth() const {
    Fabric fabric = sheetFabric();
    fabric.law = GetParam().law();
    if (GetParam().kind == Of::nurbs) return std::make_unique<NurbsShell>(squareSheet(12, kSide_m, 0, fabric));
    // As soft across as it bends, so that differences show both; the sheet is flat enough not to feel it.
    if (GetParam().kind == Of::shell)
      return std::make_unique<DegeneratedShell>(squareSheet(8, kSide_m, 0, fabric),
                                                DegeneratedOptions{.shear_factor = 1e-3});
    std::vector<MeshDraft> garments{flatTriangles(12, 12, kSide_m, kSide_m, fabric, MeshKind::equilateral)};
    garments[0].bending = GetParam().bending;
    return std::make_unique<TriangleCloth>(std::move(garments));
  }
};
INSTANTIATE_TEST_SUITE_P(
    Kinds, Memory,
    testing::Values(Remembers{"Shell", Of::nurbs, stopLaw, StopBending::history_size, stopLoss},
                    Remembers{"Triangles", Of::triangles, stopLaw, StopBending::history_size, stopLoss},
                    Remembers{"LoopOnShell", Of::nurbs, loopLaw, IsotropicHysteresisBending::history_size, loopLoss},
                    Remembers{"LoopOnTriangles", Of::triangles, loopLaw, IsotropicHysteresisBending::history_size, loopLoss},
                    Remembers{"AgeingOnShell", Of::nurbs, ageingLaw, HysteresisBending::history_size},
                    Remembers{"AgeingOnTriangles", Of::triangles, ageingLaw, HysteresisBending::history_size},
                    Remembers{"RecoveringOnShell", Of::nurbs, recoveringLaw, Recovering<IsotropicHysteresisBending>::history_size},
                    Remembers{"RecoveringOnTriangles", Of::triangles, recoveringLaw,
                              Recovering<IsotropicHysteresisBending>::history_size},
                    Remembers{"DegeneratedShell", Of::shell, stopLaw, StopBending::history_size, stopLoss},
                    Remembers{"LoopOnDegeneratedShell", Of::shell, loopLaw, IsotropicHysteresisBending::history_size,
                              loopLoss},
                    Remembers{"AgeingOnDegeneratedShell", Of::shell, ageingLaw, HysteresisBending::history_size},
                    Remembers{"RecoveringOnDegeneratedShell", Of::shell, recoveringLaw,
                              Recovering<IsotropicHysteresisBending>::history_size},
                    Remembers{"LoopOnMidedge", Of::triangles, loopLaw, IsotropicHysteresisBending::history_size, loopLoss,
                              BendingElements::midedge},
                    Remembers{"AgeingOnMidedge", Of::triangles, ageingLaw, HysteresisBending::history_size, nullptr,
                              BendingElements::midedge},
                    Remembers{"LoopOnTensors", Of::triangles, loopLaw, IsotropicHysteresisBending::history_size, loopLoss,
                              BendingElements::triangle}),
    [](const auto& i) { return std::string(i.param.name); });

/// All points on a cylinder about y of a curvature, without strain.
std::vector<Vec3> rolled(const Cloth& c, double curvature) {
  std::vector<Vec3> q;
  for (const Vec3& X : c.rest()) {
    const double angle = curvature * X.x;
    q.push_back(std::abs(curvature) < 1e-9 ? Vec3{X.x, X.y, 0.5 * curvature * X.x * X.x}
                                           : Vec3{std::sin(angle) / curvature, X.y, (1 - std::cos(angle)) / curvature});
  }
  return q;
}

/// Directors of that cylinder; empty for cloth that has none.
std::vector<double> rolledInner(const Cloth& c, double curvature) {
  const auto* shell = dynamic_cast<const DegeneratedShell*>(&c);
  std::vector<double> inner(shell ? c.innerValues() : 0);
  for (std::size_t i = 0; shell && i < c.rest().size(); ++i) {
    const double angle = curvature * c.rest()[i].x;
    double* d = inner.data() + 3L * shell->directors().of_point[i];
    d[0] = -std::sin(angle), d[1] = 0, d[2] = std::cos(angle);
  }
  return inner;
}

/// The spins from one such state to the next, about -y.
std::vector<double> rolledWay(const Cloth& c, double from, double to) {
  std::vector<double> way = rolledInner(c, 0);
  for (std::size_t i = 0; !way.empty() && i < c.rest().size(); ++i) {
    double* w = way.data() + 3L * dynamic_cast<const DegeneratedShell&>(c).directors().of_point[i];
    w[0] = w[2] = 0, w[1] = -(to - from) * c.rest()[i].x;
  }
  return way;
}

std::vector<double> newHistory(const Cloth& c) {
  std::vector<double> history(c.historySize());
  c.startHistory(history);
  return history;
}

/// Rolled back and forth: what the laws lose is what their loop encloses, never negative, and what the force works.
TEST_P(Memory, ALoopOfBendingLosesWhatItEncloses) {
  const auto c = cloth();
  ASSERT_GT(c->historySize(), 0u);
  for (const HistoryPlace& p : c->historyPlaces()) {
    EXPECT_EQ(p.count, GetParam().doubles);
    EXPECT_LT(p.first + (p.count - 1) * p.stride, c->historySize());
  }
  const double largest = 20;
  std::vector<double> committed = newHistory(*c), trial = committed;
  std::vector<Vec3> before, force_before, force(c->rest().size());
  std::vector<double> torque_before, torque(rolledInner(*c, 0).size());
  double at = 0;
  double lost = 0, work = 0, stored = 0;
  ClothWork scratch;
  const int steps = 200;
  ForceTerms bending;
  bending.membrane = false;
  for (int s = 0; s <= 2 * steps; ++s) {
    const double last = std::exchange(at, largest * std::sin(2 * std::numbers::pi * s / steps));
    const std::vector<Vec3> q = rolled(*c, at);
    const std::vector<double> inner = rolledInner(*c, at), way = rolledWay(*c, last, at);
    ClothEnergy energy;
    c->force({q, inner, committed}, {force, torque, trial, &energy}, scratch, bending);
    EXPECT_GE(energy.lost, 0);
    if (s == steps) stored -= energy.stored;
    if (s == 2 * steps) stored += energy.stored;
    if (s > steps) {
      lost += energy.lost;
      for (std::size_t i = 0; i < q.size(); ++i) work -= 0.5 * dot(force[i] + force_before[i], q[i] - before[i]);
      for (std::size_t k = 0; k < way.size(); ++k) work -= 0.5 * (torque[k] + torque_before[k]) * way[k];
    }
    before = q, force_before = force, torque_before = torque;
    committed = trial;
  }
  EXPECT_NEAR(work, stored + lost, 0.01 * lost);
  if (!GetParam().loss) return;
  const std::vector<Vec3> rolled_up = rolled(*c, largest);
  const std::vector<double> rolled_inner = rolledInner(*c, largest);
  const double reached = c->bendAt({rolled_up, rolled_inner, {}}, 0, c->placeOfDraft(0, {0.5, 0.5}));
  // Hinges yield each by itself, at other curvatures than the plate that they make up; more of them in small loops.
  const bool stop = GetParam().law == stopLaw;
  const double off = GetParam().kind != Of::triangles ? 0.05 : stop ? 0.1 : 0.15;
  EXPECT_NEAR(lost, GetParam().loss(reached) * kSide_m * kSide_m, off * lost);
}

/// f = - d(stored + lost)/dq and the tangent its derivative, the committed history held.
TEST_P(Memory, ForceAndTangentAreOfTheCommittedHistory) {
  const auto c = cloth();
  ForceTerms bending;  // rolled cloth has no strain: what differences leave of its membrane would hide the rest
  bending.membrane = false;
  std::vector<double> committed = newHistory(*c);
  std::vector<Vec3> q = rolled(*c, 12), f(q.size()), back(q.size());
  std::vector<double> inner = rolledInner(*c, 12), torque(inner.size()), torque_back(inner.size());
  ClothWork work;
  {
    std::vector<double> trial = committed;
    c->force({q, inner, committed}, {f, {}, trial, nullptr}, work, bending);
    ASSERT_NE(trial, committed) << "it has slipped";
    committed = trial;
  }
  const std::vector<double> kept = committed;
  q = rolled(*c, 0.5);  // 11 1/m back: it slips the other way
  inner = rolledInner(*c, 0.5);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1, 1);
  std::vector<Vec3> free_way(c->map().home.size()), way(q.size());
  for (Vec3& v : free_way) v = {noise(random), noise(random), noise(random)};
  c->map().T.multiply<Vec3>(free_way, way);
  std::vector<double> spin(inner.size());
  for (double& w : spin) w = noise(random) / kSide_m;
  c->dropIdle(inner, spin);
  const auto at = [&](double h, std::vector<Vec3>& force, std::vector<double>& of_spin) {
    std::vector<Vec3> moved = q;
    for (std::size_t i = 0; i < q.size(); ++i) moved[i] += h * way[i];
    std::vector<double> turned = inner;
    if (!inner.empty()) c->advance(inner, spin, h, turned);
    ClothEnergy energy;
    c->force({moved, turned, committed}, {force, of_spin, {}, &energy}, work, bending);
    return energy.stored + energy.lost;
  };
  const double h = 1e-7;
  const double slope = (at(h, f, torque) - at(-h, back, torque_back)) / (2 * h);
  double of_force = 0, differences = 0;
  for (std::size_t i = 0; i < q.size(); ++i) differences += dot((back[i] - f[i]) / (2 * h), way[i]);
  for (std::size_t k = 0; k < spin.size(); ++k) differences += (torque_back[k] - torque[k]) / (2 * h) * spin[k];
  at(0, f, torque);
  for (std::size_t i = 0; i < q.size(); ++i) of_force -= dot(f[i], way[i]);
  for (std::size_t k = 0; k < spin.size(); ++k) of_force -= torque[k] * spin[k];
  EXPECT_NEAR(slope, of_force, 1e-6 * std::abs(of_force));
  const auto tangent = c->tangent();
  BlockMatrix K = tangent->sparsity();
  tangent->assemble({q, inner, committed}, work, K, bending);
  std::vector<double> x(&free_way.data()->x, &free_way.data()->x + 3 * free_way.size());
  x.insert(x.end(), spin.begin(), spin.end());
  x.resize(3 * static_cast<std::size_t>(K.rows()));  // inner unknowns of others stay
  std::vector<double> Kx(x.size());
  multiply(K, x, Kx);
  double stiffness = 0;
  for (std::size_t i = 0; i < free_way.size(); ++i)
    for (int d = 0; d < 3; ++d) stiffness += Kx[3 * i + static_cast<std::size_t>(d)] * free_way[i][d];
  for (std::size_t k = 0; k < spin.size(); ++k) stiffness += Kx[3 * free_way.size() + k] * spin[k];
  EXPECT_NEAR(stiffness, differences, 1e-5 * std::abs(stiffness));
  EXPECT_EQ(committed, kept);
  // With another history it is another force.
  const std::vector<double> none = newHistory(*c);
  c->force({q, inner, none}, {back, torque_back, {}, nullptr}, work, bending);
  double change = 0, size = 0;
  for (std::size_t i = 0; i < q.size(); ++i) change += norm2(back[i] - f[i]), size += norm2(f[i]);
  for (std::size_t k = 0; k < spin.size(); ++k)
    change += std::pow((torque_back[k] - torque[k]) / kSide_m, 2), size += std::pow(torque[k] / kSide_m, 2);
  EXPECT_GT(change, 1e-4 * size);
}

/// One edge held, thrown upwards: it folds, and keeps a part of it.
struct Thrown {
  std::unique_ptr<Model> model;
  UniformStage stage;
  StepWork work;
  State state;

  explicit Thrown(std::unique_ptr<const Cloth> cloth) {
    ModelOptions o;
    for (int i = 0; i < cloth->points(); ++i)
      if (cloth->rest()[static_cast<std::size_t>(i)].x < 1e-9) o.held_control_points.push_back(i);
    model = buildModel(std::move(cloth), o, {{0, 0, -9.81}, 0}, {}, {});
    state = initialState(*model, stage, 0, work);
    for (std::size_t i = 0; i < state.p.size(); ++i)
      if (!model->held[i]) state.v[i] = {0, 0, 3 * std::pow(state.p[i].x / kSide_m, 2)};
    attachSprings(*model, stage, state, work);
  }
};

/// Steps that are tried and thrown away leave no trace, whatever their length; threads change no bit.
TEST_P(Memory, AnExplicitStepCommitsWhatItAcceptsAndNothingElse) {
  constexpr double dt = 2e-4;
  std::vector<State> ends;
  for (const int tries : {0, 3})
    for (const int threads : {1, 2}) {
      omp_set_num_threads(threads);
      Thrown t(cloth());
      State next, thrown_away;
      for (int s = 0; s < 400; ++s) {
        for (int k = 0; k < tries; ++k) step(*t.model, t.stage, t.state, dt * (0.5 + k), thrown_away, t.work);
        ASSERT_EQ(step(*t.model, t.stage, t.state, dt, next, t.work).failure, StepFailure::none);
        std::swap(t.state, next);
      }
      ends.push_back(t.state);
    }
  omp_set_num_threads(2);
  EXPECT_NE(ends[0].history, newHistory(*cloth())) << "it has folded";
  for (const State& end : ends) {
    EXPECT_EQ(end.history, ends[0].history);
    EXPECT_TRUE(end.p == ends[0].p && end.v == ends[0].v);
    EXPECT_TRUE(end.inner == ends[0].inner && end.inner_rate == ends[0].inner_rate);
  }
}

/// Held at one edge; `load` at the other [N/m], by a program.
std::unique_ptr<Structure> cantilever(std::unique_ptr<const Cloth> cloth, const Vec3& load, Program program) {
  StructureOptions o;
  const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PatchEdge clamp{0, Side::u0, false}, tip{0, Side::u1, false};
  o.constraints = cloth->mounting().holdEdge(clamp, all, {});
  for (LinearConstraint& l : cloth->mounting().clampEdge(clamp)) o.constraints.push_back(std::move(l));
  o.dead = {{cloth->mounting().edgeForce(tip, load), 0}};
  o.programs = {std::move(program)};
  return buildStructure(std::move(cloth), o);
}

/// What a system remembers that accepts these states, and only these.
struct Accepted {
  std::vector<double> y;
  double t = 0;
  std::vector<double> history;
  double lost_J = 0;
};
void expectOnlyTheseCommitted(const Structure& s, ProgramEnds ends, const std::vector<Accepted>& states) {
  StructureSystem fresh(s, ends);
  double lost = 0;
  for (const Accepted& a : states) {
    lost += fresh.commit(a.y, a.t);
    ASSERT_TRUE(std::equal(a.history.begin(), a.history.end(), fresh.history().begin(), fresh.history().end()));
    EXPECT_EQ(a.lost_J, lost);
  }
  EXPECT_GT(lost, 0);
}

/// Bent beyond its yield moment and let go: it stays bent. Steps that Newton gives up, and the bisections of what looks
/// like a jump, commit nothing.
TEST_P(Memory, LoadStepsCommitWhatTheyAccept) {
  const auto s = cantilever(cloth(), {0, 0, 2.5e-3}, {{0, 0.5, 1}, {0, 1, 0}});
  const Of kind = GetParam().kind;  // directors take iterations of their own
  std::vector<Accepted> points;
  const StaticReport r = solveStatic(*s, {.steps = 8, .halvings = 8, .iterations = kind == Of::shell ? 8 : 4}, [&](const StaticPoint& p) {
    points.push_back({p.y, p.factor, p.history, p.lost_J});
    return true;
  });
  ASSERT_TRUE(r.reached) << r.why;
  EXPECT_GT(points.size(), 8u) << "steps were cut";
  expectOnlyTheseCommitted(*s, ProgramEnds::extended, points);
  double tip = 0;
  for (const Vec3& x : controlPoints(*s, points.back().y, 1)) tip = std::max(tip, x.z);
  EXPECT_GT(tip, 0.01 * kSide_m);
}

/// Pulled, cloth stiffens, and Newton gives steps up; lifted, it yields.
TEST_P(Memory, ImplicitStepsCommitWhatTheyAccept) {
  const auto s = cantilever(cloth(), {3, 0, 1}, {{0, 0.02, 1}, {0, 1, 1}});
  StructureSystem system(*s, ProgramEnds::constant);
  SystemState state;
  std::vector<Accepted> states;
  const ImplicitReport r = integrate(
      system, {.scheme = ImplicitScheme::newmark, .step_s = 0.01, .iterations = GetParam().law == stopLaw && GetParam().kind != Of::shell ? 5 : 3},
      0.05, state, [&](const SystemState& d) {
        states.push_back({d.y, d.time_s, d.history, d.lost_J});
        return true;
      });
  ASSERT_TRUE(r.reached) << r.why;
  EXPECT_GT(states.size(), 5u) << "no step was cut";
  expectOnlyTheseCommitted(*s, ProgramEnds::constant, states);
}

/// A state that was kept goes on as if nothing had been.
TEST_P(Memory, AMotionGoesOnFromAKeptState) {
  const auto s = cantilever(cloth(), {0, 0, 0.1}, {{0, 0.02, 1}, {0, 1, 1}});
  const auto run = [&](std::initializer_list<double> ends) {
    SystemState state;
    for (const double end : ends) {
      StructureSystem system(*s, ProgramEnds::constant);
      integrate(system, {.scheme = ImplicitScheme::newmark, .step_s = 2e-3}, end, state,
                [](const SystemState&) { return true; });
    }
    return state;
  };
  const SystemState whole = run({0.05}), parts = run({0.03, 0.05});
  // Newton solves the acceleration anew where a motion starts: rounding; and set and fatigue of the last step, which
  // act from the next one on, already act there.
  const double tolerance = GetParam().law == ageingLaw ? 1e-3 : 1e-6;
  ASSERT_EQ(whole.history.size(), parts.history.size());
  EXPECT_GT(whole.lost_J, 0);
  EXPECT_NEAR(whole.lost_J, parts.lost_J, tolerance * whole.lost_J);
  double off = 0, size = 0;
  for (std::size_t i = 0; i < whole.history.size(); ++i) {
    off = std::max(off, std::abs(whole.history[i] - parts.history[i]));
    size = std::max(size, std::abs(whole.history[i]));
  }
  EXPECT_LT(off, tolerance * size);
}

}  // namespace
}  // namespace gambeson
