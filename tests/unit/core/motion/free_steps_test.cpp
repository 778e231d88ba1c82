/// The schemes beside velocity Verlet, without contact: growth a step, stability, orders.

#include "core/motion/free_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/core/motion/empty_stage.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/core/motion/spring_points.hpp"

namespace gambeson {
namespace {

using namespace shapes;
using Vector = SpringPoints::Vector;

constexpr MotionScheme kSchemes[] = {MotionScheme::euler,          MotionScheme::symplectic_euler,
                                     MotionScheme::midpoint,       MotionScheme::runge_kutta,
                                     MotionScheme::implicit_euler, MotionScheme::semi_implicit};

StepControl fixedSteps(double dt) {
  StepControl control;
  control.fixed_s = dt;
  return control;
}

struct Oscillator {
  std::unique_ptr<Model> model;
  EmptyStage stage;
  StepWork work;
  Frequency frequency;
  State state;

  explicit Oscillator(SpringPoints::Law law, double x, double v = 0, double damping = 0) {
    ModelOptions o;
    o.self_contact = false;
    model = buildModel(std::make_unique<SpringPoints>(1, std::move(law)), o, {Vec3{}, damping}, {}, {});
    state = initialState(*model, stage, 0, work);
    state.p[0].x = x;
    state.v[0].x = v;
    attachSprings(*model, stage, state, work);
  }

  void run(MotionScheme scheme, double end, const StepControl& control,
           const std::function<void(const State&, const State&, const StepReport&)>& watch = {}) {
    MotionOptions o{scheme, 1, 1e-14};
    makeIntegrator(o, *model, stage, control, frequency, work)
        ->advance(end, state,
                  [&](const State& before, const State& now, const StepReport& r, const StepResult&, const Frequency&) {
                    if (watch) watch(before, now, r);
                  });
  }
};

SpringPoints::Law spring(double omega) {
  return [omega](const Vector& x) -> Vector { return omega * omega * x; };
}

/// Wong 2014, section 3.2: what each scheme multiplies v^2 + omega^2 x^2 by.
TEST(FreeSteps, AnOscillatorGrowsAsTheSchemeSays) {
  const double omega = 3;
  for (const double z : {0.1, 0.7, 1.5}) {
    const double z2 = z * z;
    const auto expected = [&](MotionScheme s) {
      return s == MotionScheme::euler         ? 1 + z2
             : s == MotionScheme::midpoint    ? 1 + z2 * z2 / 4
             : s == MotionScheme::runge_kutta ? 1 - std::pow(z, 6) / 72 + std::pow(z, 8) / 576
                                              : 1 / (1 + z2);
    };
    for (const MotionScheme s :
         {MotionScheme::euler, MotionScheme::midpoint, MotionScheme::runge_kutta, MotionScheme::implicit_euler}) {
      Oscillator o(spring(omega), 0.4, -1.1);
      int steps = 0;
      o.run(s, 12 * z / omega, fixedSteps(z / omega), [&](const State& a, const State& b, const StepReport&) {
        const auto energy = [&](const State& x) { return norm2(x.v[0]) + omega * omega * norm2(x.p[0]); };
        EXPECT_NEAR(energy(b) / energy(a), expected(s), 1e-10) << static_cast<int>(s) << " " << z;
        ++steps;
      });
      EXPECT_EQ(steps, 12);
    }
  }
}

/// Man 2006, eq. 2.2: the velocity goes first, and v^2 + omega^2 x^2 - dt omega^2 x v stays.
TEST(FreeSteps, SymplecticEulerKeepsAnInvariantUpToTwo) {
  const double omega = 5;
  for (const double z : {0.3, 1.5, 1.99, 2.01}) {
    Oscillator o(spring(omega), 0.4, -1.1);
    const double dt = z / omega;
    const auto kept = [&](const State& x) {
      return norm2(x.v[0]) + omega * omega * (norm2(x.p[0]) - dt * x.p[0].x * x.v[0].x);
    };
    const double first = kept(o.state);
    double most = 0;
    o.run(MotionScheme::symplectic_euler, 400 * dt, fixedSteps(dt),
          [&](const State& a, const State& b, const StepReport&) {
            EXPECT_NEAR(b.v[0].x, a.v[0].x - dt * omega * omega * a.p[0].x, 1e-12 * (1 + std::abs(b.v[0].x)));
            EXPECT_NEAR(b.p[0].x, a.p[0].x + dt * b.v[0].x, 1e-12 * (1 + std::abs(b.p[0].x)));
            if (z < 2) {
              EXPECT_NEAR(kept(b), first, 1e-10 * first);
            }
            most = std::max(most, std::abs(b.p[0].x));
          });
    if (z < 2)
      EXPECT_LT(most, 10);
    else
      EXPECT_GT(most, 1e10);
  }
  EXPECT_EQ(longestStableStep(RungeKuttaOrder::symplectic, omega, 0), 2 / omega);
}

/// The toy's law has no energy that could be asked for: all that its kinetic energy changes by is the scheme's own.
TEST(FreeSteps, AnOscillatorsEnergyIsTheSchemesOwn) {
  for (const MotionScheme s : kSchemes) {
    Oscillator o([](const Vector& x) -> Vector { return x.array() + x.array().cube(); }, 1.2, 0.3);
    o.run(s, 1, fixedSteps(0.01), [&](const State& a, const State& b, const StepReport& r) {
      EXPECT_NEAR(r.work.integrator, 0.5 * (norm2(b.v[0]) - norm2(a.v[0])), 1e-13) << static_cast<int>(s);
    });
  }
}

/// 2 sqrt(2) = 2.828.
TEST(FreeSteps, RungeKuttaIsStableUpToTwoRootTwo) {
  for (const double z : {2.8, 2.9}) {
    Oscillator o(spring(5), 1);
    double most = 0;
    o.run(MotionScheme::runge_kutta, 400 * z / 5, fixedSteps(z / 5),
          [&](const State&, const State& b, const StepReport&) { most = std::max(most, std::abs(b.p[0].x)); });
    if (z < 2.85)
      EXPECT_LT(most, 1.01);
    else
      EXPECT_GT(most, 100);
  }
}

/// With drag the longest stable steps of Euler and of the midpoint rule are what they say: just below motion dies, at
/// twice that it grows.
TEST(FreeSteps, DragGivesEulerAndMidpointAStableStep) {
  for (const RungeKuttaOrder order : {RungeKuttaOrder::euler, RungeKuttaOrder::midpoint}) {
    const double omega = 20, damping = 0.4, dt = longestStableStep(order, omega, damping);
    const MotionScheme s = order == RungeKuttaOrder::euler ? MotionScheme::euler : MotionScheme::midpoint;
    for (const double part : {0.9, 2.0}) {
      Oscillator o(spring(omega), 1, 0, damping);
      o.run(s, 20, fixedSteps(part * dt));
      const double size = std::hypot(o.state.p[0].x, o.state.v[0].x / omega);
      if (part < 1)
        EXPECT_LT(size, 0.9) << static_cast<int>(order);
      else
        EXPECT_GT(size, 3) << static_cast<int>(order);
    }
    Oscillator o(spring(omega), 1, 0, damping);
    o.run(s, 1, {0.9, 1});  // takes its own step
    EXPECT_NEAR(o.state.last_step_s, 0.9 * dt, 0.05 * dt);
  }
}

TEST(FreeSteps, RefusesEulerWithoutDragAndWithoutAStep) {
  for (const MotionScheme s : {MotionScheme::euler, MotionScheme::midpoint}) {
    Oscillator o(spring(1), 1);
    EXPECT_THROW(o.run(s, 1, {}), InputError);
  }
}

/// One point on a spring, and an inner unknown that a second spring ties to it: the law of two points, of which no
/// sample sees the second.
class PointWithInner : public SpringPoints {
 public:
  explicit PointWithInner(Law law) : SpringPoints(1, law), both_(std::move(law)) {}
  std::size_t innerValues() const override { return 1; }
  std::size_t innerRates() const override { return 1; }
  void startInner(std::span<double> value) const override { value[0] = 0; }
  void innerMasses(std::span<double> mass) const override { mass[0] = 1; }
  void force(const ClothState& s, const ClothForce& out, ClothWork&, const ForceTerms&) const override {
    const Vector pull = both_(Vector{{s.q[0].x, s.inner[0]}});
    out.points[0] = {-pull(0), 0, 0};
    if (!out.inner.empty()) out.inner[0] = -pull(1);
  }
  std::unique_ptr<ClothTangent> tangent() const override { return std::make_unique<Both>(both_); }

 private:
  class Both : public ClothTangent {
   public:
    explicit Both(const Law& law) : law_(law) {
      sparsity_.columns = {0, 1, 1};
      sparsity_.offsets = {0, 2, 3};
      sparsity_.values.assign(27, 0.0);
    }
    const BlockMatrix& sparsity() const override { return sparsity_; }
    void assemble(const ClothState&, ClothWork&, BlockMatrix& K, const ForceTerms&) const override {
      K = sparsity_;
      const Vector first = law_(Vector{{1, 0}}), second = law_(Vector{{0, 1}});
      K.values[0] = first(0), K.values[9] = second(0), K.values[18] = second(1);
    }

   private:
    Law law_;
    BlockMatrix sparsity_;
  };
  Law both_;
};

TEST(FreeSteps, InnerUnknownsMoveAsPointsDo) {
  const SpringPoints::Law law = [](const Vector& x) -> Vector {
    return Vector{{9 * x(0) - 4 * (x(1) - x(0)), 4 * (x(1) - x(0))}};
  };
  for (const MotionScheme s : {MotionScheme::euler, MotionScheme::symplectic_euler, MotionScheme::midpoint,
                               MotionScheme::runge_kutta, MotionScheme::implicit_euler}) {
    std::vector<Vec3> end[2];
    for (const bool inner : {false, true}) {
      ModelOptions o;
      o.self_contact = false;
      std::unique_ptr<Cloth> cloth = std::make_unique<SpringPoints>(2, law);
      if (inner) cloth = std::make_unique<PointWithInner>(law);
      const auto model = buildModel(std::move(cloth), o, {Vec3{}, 0}, {}, {});
      EmptyStage stage;
      StepWork work;
      Frequency frequency;
      State state = initialState(*model, stage, 0, work);
      state.p[0].x = 1;
      attachSprings(*model, stage, state, work);
      makeIntegrator({s, 1, 1e-14}, *model, stage, fixedSteps(0.02), frequency, work)
          ->advance(1, state,
                    [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
      end[inner] = {state.p[0], state.v[0], {inner ? state.inner[0] : state.p[1].x, 0, 0}};
    }
    for (int k = 0; k < 3; ++k) EXPECT_LT(norm(end[0][k] - end[1][k]), 1e-12) << static_cast<int>(s) << " " << k;
    EXPECT_GT(std::abs(end[0][2].x), 0.01);
  }
}

/// A sheet that hangs from an edge and is set swinging; positions after 20 ms against a fine solution.
struct Hanging : Motion {
  Hanging() : Motion(squareSheet(4, 0.2, 0), {{0, 0, -9.81}, 0.5}, {}, held()) {
    for (int i = 0; i < model->freeCount(); ++i) {
      const Vec3 x = state.p[i] / 0.2;
      if (!model->held[i]) state.v[i] = 0.5 * Vec3{x.x * std::cos(2 * x.y), 0.3 * x.x * x.y, x.x * x.x};
    }
    restart();
  }
  static ModelOptions held() {
    ModelOptions o;
    o.self_contact = false;
    const Garment g = squareSheet(4, 0.2, 0);
    for (int j = 0; j < g.patches[0].v.count(); ++j) o.held_control_points.push_back(g.patches[0].index(0, j));
    return o;
  }
  std::vector<Vec3> after(MotionScheme s, double dt, int substeps = 1) {
    Frequency f;
    makeIntegrator({s, substeps, 1e-13}, *model, stage, fixedSteps(dt), f, work)
        ->advance(0.02, state,
                  [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
    return state.p;
  }
};

TEST(FreeSteps, OrdersOnAHangingSheet) {
  const std::vector<Vec3> exact = Hanging().after(MotionScheme::runge_kutta, 2e-5);
  const auto error = [&](MotionScheme s, double dt, int substeps) {
    const std::vector<Vec3> p = Hanging().after(s, dt, substeps);
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += norm2(p[i] - exact[i]);
    return std::sqrt(sum);
  };
  const auto order = [&](MotionScheme s, double dt, int substeps = 1) {
    return std::log2(error(s, dt, substeps) / error(s, dt / 2, substeps));
  };
  EXPECT_NEAR(order(MotionScheme::euler, 4e-6), 1, 0.1);
  EXPECT_NEAR(order(MotionScheme::symplectic_euler, 5e-5), 1, 0.1);
  EXPECT_NEAR(order(MotionScheme::midpoint, 5e-5), 2, 0.1);
  EXPECT_NEAR(order(MotionScheme::runge_kutta, 4e-4), 4, 0.1);
  EXPECT_NEAR(order(MotionScheme::implicit_euler, 2e-5), 1, 0.1);
  EXPECT_NEAR(order(MotionScheme::semi_implicit, 2e-5, 1), 1, 0.1);
  EXPECT_NEAR(order(MotionScheme::semi_implicit, 2e-5, 3), 1, 0.1);
}

}  // namespace
}  // namespace gambeson
