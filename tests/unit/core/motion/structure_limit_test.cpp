/// Strain limits of structures: the same motion as that of worn cloth, supports by components, supports that couple
/// points, and both sides of seams.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/cloth/patches/patch_loads.hpp"
#include "core/cloth/patches/patch_supports.hpp"
#include "core/error.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/core/motion/structure_moves.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Vec3 gravity{0, 0, -9.81};

StructureOptions hanging(const Garment& g) {
  StructureOptions o;
  o.programs = {{{0}, {1}}};
  o.dead = {{weightForce(g, gravity), 0}};
  o.drag_kg_per_m2s = 0.3;
  return o;
}

/// What the limits came to.
struct Limited {
  long projections = 0, missed = 0, steps = 0;
  double residual = 0;
  void operator()(const State&, const State&, const StepReport& r) {
    ++steps;
    projections += r.limit.projections;
    missed += !r.limit.converged;
    residual = std::max(residual, r.limit.residual);
  }
};

/// A sheet that falls about one held edge: both integrators, step for step.
TEST(StructureLimit, MovesAsWornCloth) {
  for (const StrainLimit& limit :
       {StrainLimit{}, StrainLimit{LimitMode::equality, 0, 1e-3}, StrainLimit{LimitMode::upper_limit, 0.005, 1e-3}}) {
    const Garment g = squareSheet(6, 0.2, 0);
    const int count = 300;
    const double dt = 4e-4;
    ModelOptions worn;
    for (int j = 0; j < g.patches[0].v.count(); ++j) worn.held_control_points.push_back(g.patches[0].index(0, j));
    worn.strain_limit = limit;
    Motion m(g, {gravity, 0.3}, {}, worn);
    long projections = 0;
    for (int s = 0; s < count; ++s) projections += m.step(dt).limit.projections;

    StructureOptions o = hanging(g);
    o.constraints = supportEdge(g, {0, Side::u0}, axes);
    const auto structure = buildStructure(g, o);
    ExplicitSteps steps(*structure, limit);
    Limited limited;
    steps.run(count * dt, dt, std::ref(limited));
    const State& state = steps.state;
    EXPECT_EQ(limited.steps, count);
    EXPECT_EQ(limited.projections, projections);
    EXPECT_EQ(limited.missed, 0);
    EXPECT_LE(limited.residual, limit.tolerance);
    const std::vector<Vec3>&p = state.p, &v = state.v;
    double apart = 0, faster = 0, fallen = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
      apart = std::max(apart, norm(p[k] - m.state.p[k]));
      faster = std::max(faster, norm(v[k] - m.state.v[k]));
      fallen = std::max(fallen, -p[k].z);
    }
    EXPECT_LT(apart, 1e-9);
    EXPECT_LT(faster, 1e-7);
    EXPECT_GT(fallen, 0.05);
    if (limit.mode != LimitMode::none) {
      EXPECT_GT(projections, 100);
      ASSERT_EQ(state.limit_J.size(), m.state.limit_J.size());
      double most = 0, difference = 0;
      for (std::size_t i = 0; i < state.limit_J.size(); ++i) {
        most = std::max(most, std::abs(state.limit_J[i]));
        difference = std::max(difference, std::abs(state.limit_J[i] - m.state.limit_J[i]));
      }
      EXPECT_GT(most, 0);
      EXPECT_LT(difference, 1e-5 * most);
    }
  }
}

struct Supported {
  Garment garment;
  StructureOptions options;
};

/// Rollers: an edge that is held along z and y, a corner that is held whole: numbers become tensors.
Supported rollers() {
  Supported s{squareSheet(5, 0.3, 0), {}};
  s.options = hanging(s.garment);
  s.options.constraints = supportEdge(s.garment, {0, Side::v1}, std::vector<Vec3>{axes[1], axes[2]});
  for (LinearConstraint& l : supportPoint(s.garment, 0, {0, 1}, axes)) s.options.constraints.push_back(std::move(l));
  return s;
}

/// A bar: an edge whose points move alike; a point inside the patch that is held: unknowns share masses.
Supported bar() {
  Supported s{squareSheet(5, 0.3, 0), {}};
  s.options = hanging(s.garment);
  for (const Vec3& axis : axes)
    for (LinearConstraint& l : tieEdge(s.garment, {0, Side::v0}, axis)) s.options.constraints.push_back(std::move(l));
  for (const Vec2& at : {Vec2{0.37, 0.81}, Vec2{0.71, 0.93}})
    for (LinearConstraint& l : supportPoint(s.garment, 0, at, axes)) s.options.constraints.push_back(std::move(l));
  return s;
}

/// F D_i . S_ij F D_j = dE_i/dy M^-1 dE_j/dy^T, gradients by differences, M = C^T diag(m) C.
TEST(StructureLimit, MobilityIsThatOfTheUnknowns) {
  for (const Supported& with : {rollers(), bar()}) {
    const auto s = buildStructure(with.garment, with.options);
    const auto model = untouchedModel(*s, {LimitMode::equality, 0, 1e-4});
    const StrainRows& rows = model->strain_rows;
    ASSERT_FALSE(rows.tensors.empty());
    const int n = s->dofs.unknowns();
    std::vector<double> y(n);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> d(-0.01, 0.01);
    for (double& v : y) v = d(random);
    std::vector<std::vector<double>> J(rows.rows(), std::vector<double>(n));
    std::vector<Vec3> plus, minus, e;
    for (int k = 0; k < n; ++k) {
      auto z = y;
      const double h = 1e-6;
      z[k] += h;
      strainVectors(rows, structureState(*s, 0, z, {}, {}).p, plus);
      z[k] -= 2 * h;
      strainVectors(rows, structureState(*s, 0, z, {}, {}).p, minus);
      for (int i = 0; i < rows.rows(); ++i) J[i][k] = (strainOf(plus[i]) - strainOf(minus[i])) / (2 * h);
    }
    StructureSystem system(*s, ProgramEnds::constant);
    SymmetricMatrix M = system.sparsity();
    system.mass(true, M);
    SymmetricFactor factor(M);
    factor.factorise(M);
    strainVectors(rows, structureState(*s, 0, y, {}, {}).p, e);
    double largest = 0, worst = 0;
    std::vector<double> x(n);
    for (int c = 0; c < rows.rows(); ++c) {
      std::vector<double> column(rows.rows(), 0.0);
      for (int k = rows.S.offsets[c]; k < rows.S.offsets[c + 1]; ++k) {
        const auto& t = rows.tensors[k];
        const Vec3 &a = e[rows.S.rows[k]], &b = e[c];
        column[rows.S.rows[k]] = dot(a, {dot({t[0], t[1], t[2]}, b), dot({t[3], t[4], t[5]}, b),  //
                                         dot({t[6], t[7], t[8]}, b)});
      }
      if (!rows.live[c]) continue;
      factor.solve(J[c], x);
      for (int r = c; r < rows.rows(); ++r) {
        double exact = 0;
        for (int k = 0; k < n; ++k) exact += J[r][k] * x[k];
        largest = std::max(largest, std::abs(exact));
        worst = std::max(worst, std::abs(exact - column[r]));
      }
    }
    EXPECT_GT(largest, 0);
    EXPECT_LT(worst, 1e-8 * largest);
  }
}

/// Supports stay held, limits are met, and without loads but weight the energy does not grow.
TEST(StructureLimit, ComponentsAndTiesHoldTogetherWithTheLimits) {
  for (LimitMode mode : {LimitMode::equality, LimitMode::upper_limit}) {
    const StrainLimit limit{mode, 0.002, 1e-3};
    for (const Supported& with : {rollers(), bar()}) {
      const auto s = buildStructure(with.garment, with.options);
      ExplicitSteps steps(*s, limit);
      double worst = 0, energy = 0;
      LimitWork work;
      Limited limited;
      steps.run(400 * 4e-4, 4e-4, [&](const State& before, const State& now, const StepReport& r) {
        limited(before, now, r);
        worst = std::max(worst, limitResidual(steps.model->strain_rows, limit, now.p, work));
        energy = std::max(energy, energyOf(*s, now, true).total());
      });
      EXPECT_GT(limited.projections, 100);
      EXPECT_EQ(limited.missed, 0);
      EXPECT_LE(worst, limit.tolerance);
      EXPECT_LT(energy, 1e-6);  // it starts at 0 and the sheet weighs 0.13 N
      const std::vector<Vec3> q = controlPoints(*s, steps.state);
      double moved = 0;
      for (std::size_t i = 0; i < q.size(); ++i) moved = std::max(moved, norm(q[i] - s->cloth->rest()[i]));
      EXPECT_GT(moved, 0.05);
      for (const LinearConstraint& l : with.options.constraints) {
        double sum = 0;
        for (const auto& [control, coefficient] : l.terms)
          sum += dot(coefficient, q[control] - s->cloth->rest()[control]);
        EXPECT_NEAR(sum, 0, 1e-12);
      }
    }
  }
}

/// A held edge that a program lifts carries cloth that keeps its length.
TEST(StructureLimit, FollowsMovingSupports) {
  const Garment g = squareSheet(5, 0.2, 0);
  StructureOptions o = hanging(g);
  o.programs.push_back({{0, 0.1}, {0, 1}});
  o.constraints = supportEdge(g, {0, Side::u0}, axes, {{0, 0.1, 0.1}, 1});
  const auto s = buildStructure(g, o);
  ExplicitSteps steps(*s, {LimitMode::equality, 0, 1e-3});
  Limited limited;
  steps.run(300 * 5e-4, 5e-4, std::ref(limited));
  EXPECT_EQ(limited.missed, 0);
  const std::vector<Vec3> q = controlPoints(*s, steps.state);
  EXPECT_NEAR(norm(q[0] - s->cloth->rest()[0] - Vec3{0, 0.1, 0.1}), 0, 1e-12);
  EXPECT_LE(limited.residual, 1e-3);
}

TEST(StructureLimit, RefusesWhatIsNoLimit) {
  const Supported with = rollers();
  const auto s = buildStructure(with.garment, with.options);
  EXPECT_THROW(untouchedModel(*s, {LimitMode::equality, 0, 0}), InputError);
  EXPECT_THROW(untouchedModel(*s, {LimitMode::upper_limit, std::nan("")}), InputError);
  StrainLimit closest{LimitMode::equality, 0, 1e-3};
  closest.method = LimitMethod::closest;
  EXPECT_THROW(untouchedModel(*s, closest), InputError);
}

}  // namespace
}  // namespace gambeson
