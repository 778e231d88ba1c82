/// Contact impulses of a step against closed forms: Zheng 2013, eq. 3.17 to 3.20 and 3.35, the latter with the
/// effective mass 1 / sum(N^2/m) (the printed one holds for equal masses only).

#include "core/contact/response.hpp"
#include "core/cloth/draft/areas.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>
#include <bit>
#include <cmath>
#include <random>
#include <utility>

#include "core/contact/contact_rows.hpp"
#include "core/contact/halving.hpp"
#include "core/contact/row_order.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

constexpr double rho = 0.144, dt = 1e-3;

/// Rows of W T by hand.
SparseRows rowsOf(int columns, const std::vector<std::vector<std::pair<int, double>>>& rows) {
  SparseRows W;
  W.column_count = columns;
  for (const auto& row : rows) {
    for (auto [c, v] : row) W.add(c, v);
    W.endRow();
  }
  return W;
}

struct Problem {
  SparseRows W;
  std::vector<double> mass, area;
  std::vector<int> place;
  std::vector<Vec3> velocity;
  std::vector<ContactRow> rows;
  ContactParameters parameters{1e-3, 0.3, 0.01, 1e-9, 4000};

  std::vector<Vec3> impulses;
  ContactWork work;
  ContactSolve solve(const Vec3& warm_start = {}) {
    std::vector<double> inverse;
    for (double m : mass) inverse.push_back(m > 0 ? 1 / m : 0);
    std::vector<Vec3> warm(rows.size(), warm_start);
    work = {};
    const std::vector<double> density(area.size(), rho);
    return solveContacts(rows, W, inverse, area, density, place, parameters, dt, velocity, warm, impulses, work);
  }
  Vec3 sampleVelocity(int s) const {
    Vec3 v{};
    for (int k = W.offsets[s]; k < W.offsets[s + 1]; ++k) v += W.values[k] * velocity[W.columns[k]];
    return v;
  }
};

ContactRow row(int sample, const Vec3& n, double target, const Vec3& body = {}) {
  Contact c;
  c.sample = sample;
  c.normal = normalized(n);
  return bodyRow(c, body, target, false);
}

/// One sample on three control points of unequal mass; the masses are those of samples around it as well.
Problem oneSample(const Vec3& v) {
  Problem p;
  p.W = rowsOf(3, {{{0, 0.2}, {1, 0.5}, {2, 0.3}}});
  p.area = {1e-4};
  p.mass = {3 * rho * 0.2e-4, 2 * rho * 0.5e-4, 5 * rho * 0.3e-4};
  p.velocity = {v + Vec3{0.5, 0, 0}, v, v + Vec3{-0.2 / 0.3 * 0.5, 0, 0}};  // the sample moves with v
  return p;
}

double effectiveMass(const Problem& p) { return 1 / (0.04 / p.mass[0] + 0.25 / p.mass[1] + 0.09 / p.mass[2]); }

TEST(Response, OneContactTakesTheEffectiveMassTimesTheVelocityChange) {
  Problem p = oneSample({0, 0, -2});
  p.rows = {row(0, {0, 0, 1}, 0.05, {0, 0, 0.3})};
  const std::vector<Vec3> before = p.velocity;
  ASSERT_TRUE(p.solve().converged);
  const double exact = effectiveMass(p) * (2 + 0.3 + 0.05);
  EXPECT_NEAR(p.impulses[0].z, exact, 1e-9 * exact);
  EXPECT_NEAR(p.sampleVelocity(0).z, 0.35, 1e-9);
  // Control point I gets N_I i, and nobody else anything: the free ones' momentum changes by the impulse.
  const double N[] = {0.2, 0.5, 0.3};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(p.mass[i] * (p.velocity[i].z - before[i].z), N[i] * exact, 1e-9 * exact);
}

TEST(Response, FrictionSticksWithinTheConeAndSlipsOnIt) {
  for (double slip : {0.3, 3.0}) {  // mu times the normal change is 0.6
    Problem p = oneSample({slip, 0, -2});
    p.parameters.friction = 0.3;
    p.rows = {row(0, {0, 0, 1}, 0)};
    ASSERT_TRUE(p.solve().converged);
    const double m = effectiveMass(p), tangential = std::min(slip, 0.6);
    EXPECT_NEAR(p.impulses[0].z, 2 * m, 1e-8 * m) << slip;
    EXPECT_NEAR(p.impulses[0].x, -tangential * m, 1e-8 * m) << slip;
    EXPECT_NEAR(p.impulses[0].y, 0, 1e-12 * m) << slip;
    EXPECT_NEAR(p.sampleVelocity(0).x, slip - tangential, 1e-8) << slip;
  }
}

TEST(Response, FrictionIsThatOfTheMotionRelativeToTheBody) {
  Problem p = oneSample({1, 0.2, -2});
  p.rows = {row(0, {0, 0, 1}, 0, {1, 0.2, 0})};
  ASSERT_TRUE(p.solve().converged);
  EXPECT_LT(std::hypot(p.impulses[0].x, p.impulses[0].y), 1e-12);
}

TEST(Response, SeparatingContactGetsNothing) {
  Problem p = oneSample({0.4, 0, 0.1});
  p.rows = {row(0, {0, 0, 1}, 0.05)};
  const std::vector<Vec3> before = p.velocity;
  ASSERT_TRUE(p.solve().converged);
  EXPECT_EQ(p.impulses[0], Vec3{});
  EXPECT_EQ(p.velocity, before);
}

/// Two samples that share control points, normals 40 degrees apart: A lambda = target - v, two by two.
Problem twoSamples(const Vec3& v0, const Vec3& v1) {
  Problem p;
  p.W = rowsOf(3, {{{0, 0.6}, {1, 0.4}}, {{1, 0.3}, {2, 0.7}}});
  p.area = {1e-4, 2e-4};
  p.mass = {rho * 0.9e-4, 1.1 * rho * (0.4e-4 + 0.6e-4), rho * 1.6e-4};
  p.velocity = {v0, {}, v1};
  p.parameters.friction = 0;
  p.rows = {row(0, {0, 0, 1}, 0.1), row(1, {std::sin(0.7), 0, std::cos(0.7)}, 0.2)};
  return p;
}

TEST(Response, ContactsThatShareControlPointsAreSolvedTogether) {
  Problem p = twoSamples({0, 0, -2}, {0, 0, -1});
  const Vec3 n0 = p.rows[0].contact.normal, n1 = p.rows[1].contact.normal;
  Eigen::Matrix2d A;
  A(0, 0) = 0.36 / p.mass[0] + 0.16 / p.mass[1];
  A(1, 1) = 0.09 / p.mass[1] + 0.49 / p.mass[2];
  A(0, 1) = A(1, 0) = dot(n0, n1) * 0.4 * 0.3 / p.mass[1];
  const Eigen::Vector2d b(0.1 - dot(p.sampleVelocity(0), n0), 0.2 - dot(p.sampleVelocity(1), n1));
  const Eigen::Vector2d exact = A.inverse() * b;
  ASSERT_TRUE(p.solve().converged);
  ASSERT_GT(exact.minCoeff(), 0);
  EXPECT_NEAR(dot(p.impulses[0], n0), exact(0), 1e-8 * exact(0));
  EXPECT_NEAR(dot(p.impulses[1], n1), exact(1), 1e-8 * exact(1));
  EXPECT_GT(std::abs(exact(0) / (b(0) / A(0, 0)) - 1), 0.01);  // one by one it would be something else
}

TEST(Response, AContactThatAnotherOneOpensGetsNothing) {
  // Alone, the second would need an impulse; the first one's lifts it off.
  Problem p = twoSamples({0, 0, -40}, {0.15, 0, 0.2});
  p.velocity[1] = {0, 0, -0.5};
  const Vec3 n1 = p.rows[1].contact.normal;
  ASSERT_LT(dot(p.sampleVelocity(1), n1), 0.2);
  ASSERT_TRUE(p.solve().converged);
  EXPECT_GT(p.impulses[0].z, 0);
  EXPECT_EQ(p.impulses[1], Vec3{});
  EXPECT_GT(dot(p.sampleVelocity(1), n1), 0.2);
}

/// Nothing is warm, and the second contact, a ceiling, is clear of the cloth's free motion; the impulse of the first
/// one drives the cloth into it. Both conditions then hold with equality, as in a system of two equations.
TEST(Response, AContactThatAnotherOneClosesIsFound) {
  Problem p = twoSamples({0, 0, -20}, {0, 0, 0});
  p.velocity[1] = {0, 0, -0.5};
  p.rows[1] = row(1, {0, 0, -1}, 0);
  ASSERT_GT(-p.sampleVelocity(1).z, 0.1);
  Eigen::Matrix2d A;
  A(0, 0) = 0.36 / p.mass[0] + 0.16 / p.mass[1];
  A(1, 1) = 0.09 / p.mass[1] + 0.49 / p.mass[2];
  A(0, 1) = A(1, 0) = -0.4 * 0.3 / p.mass[1];
  const Eigen::Vector2d b(0.1 - p.sampleVelocity(0).z, p.sampleVelocity(1).z), exact = A.inverse() * b;
  ASSERT_GT(exact.minCoeff(), 0);
  ASSERT_TRUE(p.solve().converged);
  EXPECT_NEAR(p.impulses[0].z, exact(0), 1e-8 * exact(0));
  EXPECT_NEAR(-p.impulses[1].z, exact(1), 1e-8 * exact(1));
}

/// Whatever the number of feet, the samples of both sides of two sheets together stand for the area once: a uniform
/// pressure is then the same traction in all rows.
TEST(Response, EachSideOfASampleStandsForHalfItsAreaWhateverTheNumberOfFeet) {
  const auto on = [](int s, int t, double up) {
    ContactRow r;
    r.contact.sample = s;
    r.contact.obstacle = -1;
    r.contact.kind = ContactKind::sample_on_cloth;
    r.contact.normal = normalized(Vec3{0.02 * t, 0, up});
    r.stencil.add(s, 1);
    r.stencil.add(t, -1);
    return r;
  };
  // Sample 0 lies on 1, 2 and 3, under 4, which is nearest to it as it is to 4; 4 lies under 5 and 6 as well.
  std::vector<ContactRow> rows{on(0, 1, 1), on(0, 2, 1), on(0, 3, 1), on(0, 4, -1), on(4, 5, -1), on(4, 6, -1)};
  rows[3].partner = 4;
  SparseRows W;
  W.column_count = 7;
  for (int s = 0; s < 7; ++s) {
    W.add(s, 1);
    W.endRow();
  }
  const std::vector<double> area{6, 1, 1, 1, 8, 1, 1}, inverse(7, 1);
  ContactWork work;
  shareAreas(rows, W, area, inverse, work);
  EXPECT_EQ(work.area_of, (std::vector<double>{1, 1, 1, 3 + 4, 2, 2}));
}

/// A problem beside another one that shares no point with it: the rows of both, in turn.
Problem beside(const Problem& a, const Problem& b) {
  Problem p = a;
  const int samples = a.W.rows(), columns = a.W.column_count;
  p.W.column_count += b.W.column_count;
  for (int s = 0; s < b.W.rows(); ++s) {
    for (int k = b.W.offsets[s]; k < b.W.offsets[s + 1]; ++k) p.W.add(columns + b.W.columns[k], b.W.values[k]);
    p.W.endRow();
  }
  p.area.insert(p.area.end(), b.area.begin(), b.area.end());
  p.mass.insert(p.mass.end(), b.mass.begin(), b.mass.end());
  p.velocity.insert(p.velocity.end(), b.velocity.begin(), b.velocity.end());
  p.rows.clear();
  for (std::size_t i = 0; i < std::max(a.rows.size(), b.rows.size()); ++i) {
    if (i < a.rows.size()) p.rows.push_back(a.rows[i]);
    if (i >= b.rows.size()) continue;
    p.rows.push_back(b.rows[i]);
    p.rows.back().contact.sample += samples;
    p.rows.back().stencil.sample[0] += samples;
  }
  return p;
}

/// Two islands of contact that no point ties together are solves of their own, to the last bit: neither waits for the
/// other, nor shares its restarts. A held point that both touch ties nothing.
TEST(Response, IslandsAreSolvedAsIfAlone) {
  for (const bool held : {false, true}) {
    Problem one = twoSamples({0, 0, -20}, {0, 0, 0}), other = twoSamples({0.3, 0, -2}, {0, 0.1, -1});
    one.velocity[1] = {0, 0, -0.5};
    one.rows[1] = row(1, {0, 0, -1}, 0);
    Problem both = beside(one, other);
    if (held) {  // the first point of the first, the last of the second
      both.W.columns.back() = 0;
      both.mass[0] = one.mass[0] = other.mass[2] = 0;
      both.velocity[0] = one.velocity[0] = other.velocity[2] = {};
    }
    const ContactSolve a = one.solve(), b = other.solve(), together = both.solve();
    ASSERT_TRUE(a.converged && b.converged && together.converged);
    ASSERT_NE(a.iterations, b.iterations);
    EXPECT_EQ(together.iterations, std::max(a.iterations, b.iterations));
    EXPECT_EQ(together.residual_m_per_s, std::max(a.residual_m_per_s, b.residual_m_per_s));
    EXPECT_EQ(both.impulses,
              (std::vector<Vec3>{one.impulses[0], other.impulses[0], one.impulses[1], other.impulses[1]}));
  }
}

TEST(Response, AContactOnHeldPointsAloneMovesNothingAndLeavesTheOthersAlone) {
  Problem p = twoSamples({0, 0, -2}, {});
  p.mass[1] = p.mass[2] = 0;  // held
  p.velocity[1] = p.velocity[2] = {};
  ASSERT_TRUE(p.solve().converged);
  EXPECT_EQ(p.impulses[1], Vec3{});
  const double exact = p.mass[0] / 0.36 * (0.1 + 0.6 * 2);
  EXPECT_NEAR(p.impulses[0].z, exact, 1e-8 * exact);
}

/// eq. 3.17 with d = layer - gap, k = 1 - exp(-dt/tau): independent of how the time is cut into steps.
TEST(Response, TheLayerIsRestoredWithTheRelaxationTimeWhateverTheStep) {
  ContactParameters c;
  c.layer_m = 1e-3;
  c.relaxation_s = 0.01;
  for (int steps : {1, 7, 100}) {
    double gap = 2e-4;
    for (int k = 0; k < steps; ++k) gap += 0.02 / steps * persistentTarget(gap, 0.02 / steps, c);
    EXPECT_NEAR(gap, 1e-3 - 8e-4 * std::exp(-2), 1e-15) << steps;
  }
  EXPECT_NEAR(3e-3 + 0.5 * persistentTarget(3e-3, 0.5, c), 1e-3, 1e-15);  // may reach the layer, not enter it
}

/// p_m' = (p - p_m)/tau_r for a pressure below that of a weight: p_m = p (1 - exp(-t/tau_r)), however the time is cut.
TEST(Response, APressureThatStaysLastsAfterTheRelaxationTimeWhateverTheStep) {
  ContactParameters c;
  c.relaxation_s = 0.01;
  for (int steps : {1, 7, 100}) {
    double mean = 0;
    for (int k = 0; k < steps; ++k) mean = lastingPressure(mean, 1.0, 0.02 / steps, rho, c);
    EXPECT_NEAR(mean, 1 - std::exp(-2), 1e-14) << steps;
  }
  double large = 0;
  for (int k = 0; k < 200; ++k) large = lastingPressure(large, 1e4, dt, rho, c);
  EXPECT_NEAR(large, 1e4, 1);
}

TEST(Response, AnImpactHardlyCompressesTheLayer) {
  ContactParameters c;
  c.relaxation_s = 0.01;
  // 5 m/s stopped in one step press 720 Pa; they count as a weight of 1.4 Pa.
  const double after = lastingPressure(0, rho * 5 / dt, dt, rho, c);
  EXPECT_NEAR(after, (1 - std::exp(-0.1)) * 9.81 * rho, 1e-12);
}

/// Cloth jammed in a fold changes hands from sample to sample, and no pressure of a sample lasts: what no impact makes
/// compresses the layer at once, by c k of itself in a step.
TEST(Response, ClothThatIsJammedCompressesTheLayerAtOnce) {
  ContactParameters c{1e-3, 0.3, 0.01};
  c.compliance_m_per_Pa = 1e-8;
  const double impact = rho * 5 / dt, k = 1 - std::exp(-dt / 0.01), full = k * k * 1e-8 / (dt * dt);
  ContactRow r = row(0, {0, 0, 1}, 0);
  r.contact.gap_m = 1e-3;
  const auto complianceAt = [&](double pressure) {
    layerUnder(pressure, dt, rho, c, r);
    return r.compliance;
  };
  EXPECT_NEAR(complianceAt(10 * impact), 0.9 * full, 1e-12 * full);
  EXPECT_NEAR(complianceAt(impact), 9.81 * rho / impact * full, 1e-12 * full);  // counts as a weight
}

TEST(Response, ALayerUnderALastingPressureRestsThinnerByItsCompliance) {
  ContactParameters c{1e-3, 0.3, 0.01};
  c.compliance_m_per_Pa = 1e-8;
  const double p = 500;
  double gap = 1e-3 * (1 + 1e-12), mean = 0;
  for (int k = 0; k < 400; ++k) {
    ContactRow r = row(0, {0, 0, 1}, 0);
    r.contact.gap_m = gap;
    r.mean_Pa = mean;
    layerUnder(k > 0 ? p : 0, dt, rho, c, r);
    if (k == 0) {
      EXPECT_EQ(r.compliance, 0);  // at the layer: stops at it
    }
    gap += dt * (r.target_m_per_s - r.compliance * p * dt);  // what the solve leaves of a contact that bears p
    mean = lastingPressure(mean, k > 0 ? p : 0, dt, rho, c);
  }
  EXPECT_NEAR(gap, 1e-3 - 1e-8 * p, 1e-12);
}

/// The natural residual |tau - proj(tau - rho r)|/rho of the definition, from the results alone.
double measuredResidual(const Problem& p) {
  double most = 0;
  std::vector<double> count(p.area.size(), 0);
  for (const ContactRow& r : p.rows) count[r.contact.sample] += 1;
  for (std::size_t i = 0; i < p.rows.size(); ++i) {
    const ContactRow& r = p.rows[i];
    const int s = r.contact.sample;
    const Vec3 n = r.contact.normal, tau = p.impulses[i] * (count[s] / p.area[s]);
    const Vec3 to = tau - rho * (p.sampleVelocity(s) - r.body_velocity - r.target_m_per_s * n);
    const double normal = std::max(dot(to, n), 0.0);
    Vec3 t = to - dot(to, n) * n;
    const double mu = p.parameters.friction.kinetic;
    if (norm(t) > mu * normal) t *= norm(t) > 0 ? mu * normal / norm(t) : 0;
    most = std::max(most, norm(tau - (normal * n + t)) / rho);
  }
  return most;
}

/// A sheet on a bumpy ground: neighbours' normals differ, samples outnumber control points, some have two contacts.
Problem sheetOnBumps(double tolerance_m_per_s2, int cells = 8) {
  const Garment g = shapes::squareSheet(cells, 0.2, 0);
  const FreeMap map = buildFreeMap(g);
  const Surface surface = buildSurface(g, map, 2);
  std::vector<double> area(map.T.column_count);
  map.Tt.multiply<double>(controlAreas(g), area);
  Problem p;
  p.W = surface.WT;
  p.area = surface.area_m2;
  std::vector<Vec3> rest(surface.size());
  surface.W.multiply<Vec3>(g.patches[0].points, rest);
  p.place = halvedPlaces(rest);
  for (double a : area) p.mass.push_back(rho * a);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> d(-1, 1);
  for (std::size_t i = 0; i < p.mass.size(); ++i)
    p.velocity.push_back({0.3 * d(random), 0.3 * d(random), d(random) - 0.3});
  for (int s = 0; s < surface.size(); ++s)
    for (int k = 0; k < 1 + (s % 5 == 0); ++k)
      p.rows.push_back(row(s, {0.4 * d(random), 0.4 * d(random), 1}, 0.05 * d(random)));
  p.parameters.tolerance_m_per_s2 = tolerance_m_per_s2;
  return p;
}

TEST(Response, ClaimedResidualIsTheMeasuredOne) {
  for (double tolerance : {1e-1, 1e-2, 1e-4}) {
    Problem p = sheetOnBumps(tolerance);
    const ContactSolve solve = p.solve();
    ASSERT_TRUE(solve.converged);
    const double measured = measuredResidual(p);
    std::printf("[ measured ] tolerance %.3g m/s: claimed %.3g, measured %.3g, %d iterations\n", tolerance * dt,
                solve.residual_m_per_s, measured, solve.iterations);
    EXPECT_LE(measured, tolerance * dt);
    EXPECT_NEAR(measured, solve.residual_m_per_s, 0.5 * solve.residual_m_per_s);
    for (std::size_t i = 0; i < p.rows.size(); ++i) {
      const double normal = dot(p.impulses[i], p.rows[i].contact.normal);
      EXPECT_GE(normal, 0);
      EXPECT_LE(norm(p.impulses[i] - normal * p.rows[i].contact.normal), 0.3 * normal * (1 + 1e-9) + 1e-18);
    }
  }
}

/// Chunks of one phase share no point, nor do rows of one colour of a chunk: threads, or lanes, may take them side by
/// side. All rows of an island are in its chunks, each once. Each chunk of a phase shares a point with one of every
/// phase before.
void expectOrder(const ContactWork& w) {
  std::vector<char> seen(w.area_of.size(), 0);
  std::vector<int> phase_of(w.free_points.size()), chunk_of(w.free_points.size()), colour_of(w.free_points.size());
  std::vector<std::uint64_t> phases_at(w.free_points.size(), 0);
  for (const ContactWork::Island& island : w.islands) {
    EXPECT_EQ(w.chunks[island.chunk].row, island.row);
    EXPECT_EQ(w.chunks[island.chunk_end].row, island.row_end);
    for (int f = island.free_point; f < island.free_end; ++f) phase_of[f] = -1;
    int phase = 0;
    for (int c = island.chunk; c < island.chunk_end; ++c) {
      EXPECT_TRUE(w.chunks[c].phase == phase || (c > island.chunk && w.chunks[c].phase == phase + 1));
      phase = w.chunks[c].phase;
      EXPECT_LE(w.chunks[c + 1].row - w.chunks[c].row, kWholeIsland);
      for (int f = island.free_point; f < island.free_end; ++f) colour_of[f] = -1;
      std::uint64_t meets = 0;
      for (int k = w.chunks[c].row; k < w.chunks[c + 1].row; ++k) {
        EXPECT_FALSE(std::exchange(seen[w.order[k]], 1));
        EXPECT_TRUE(k == w.chunks[c].row || w.colour[k] >= w.colour[k - 1]);
        for (int e = w.points.offsets[k]; e < w.points.offsets[k + 1]; ++e) {
          const int f = w.points.columns[e];
          EXPECT_LT(std::exchange(colour_of[f], w.colour[k]), w.colour[k]);
          EXPECT_TRUE(phase_of[f] != phase || chunk_of[f] == c);
          phase_of[f] = phase;
          chunk_of[f] = c;
          meets |= phases_at[f];
          phases_at[f] |= std::uint64_t{1} << phase;
        }
      }
      EXPECT_GE(std::countr_one(meets), phase);
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<int>(w.order.size()));
}

TEST(Response, ChunksOfAPhaseAndRowsOfAColourShareNoPoint) {
  for (int cells : {4, 8, 40}) {
    Problem p = sheetOnBumps(1, cells);
    ASSERT_TRUE(p.solve().converged);
    const ContactWork& w = p.work;
    expectOrder(w);
    EXPECT_EQ(w.colour.empty() ? 0 : w.colour[0], 0);
    const int colours = *std::max_element(w.colour.begin(), w.colour.end()) + 1;
    EXPECT_GE(colours, 9);  // a point of a quadratic sheet reaches the samples of nine cells
    EXPECT_LT(colours, 60);
    const ContactWork::Island& last = w.islands.back();
    if (cells == 8) {
      EXPECT_EQ(last.chunk_end - last.chunk, 1);
    }
    if (cells == 40) {
      EXPECT_GT(last.chunk_end - last.chunk, 4);
      EXPECT_LT(w.chunks[last.chunk_end - 1].phase, 5);  // phases
    }
  }
}

/// An island that all threads share has the same impulses, to the last bit, for any number of them.
TEST(Response, ALargeIslandIsTheSameForAnyNumberOfThreads) {
  const int threads = omp_get_max_threads();
  const auto solved = [](int count) {
    omp_set_num_threads(count);
    Problem p = sheetOnBumps(1, 48);
    EXPECT_TRUE(p.solve().converged);
    std::size_t most = 0;
    for (const ContactWork::Island& i : p.work.islands)
      most = std::max(most, static_cast<std::size_t>(i.row_end - i.row));
    EXPECT_GT(most, 2048u);
    return p.impulses;
  };
  const std::vector<Vec3> one = solved(1);
  EXPECT_EQ(one, solved(2));
  EXPECT_EQ(one, solved(3));
  omp_set_num_threads(threads);
}

/// A solve that starts with impulses of I/rho ends at 1e-6 I/rho, or at ten tolerances.
TEST(Response, LargeImpulsesAreSolvedToTheirSixthDigit) {
  constexpr double tolerance = 1e-4;
  for (const auto& [start, tolerances] : {std::pair(1e2, 1.0), std::pair(5e2, 5.0), std::pair(1e6, 10.0)}) {
    Problem p = sheetOnBumps(tolerance);
    const ContactSolve solve = p.solve({0, 0, start * rho * dt});
    ASSERT_TRUE(solve.converged);
    EXPECT_LE(measuredResidual(p), tolerances * tolerance * dt) << start;
    EXPECT_GT(solve.residual_m_per_s, 0.5 * tolerances * tolerance * dt) << start;
  }
}

}  // namespace
}  // namespace gambeson
