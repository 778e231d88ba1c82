/// The contact solve of a step on the reference device: tractions, impulses, velocities and iterations are core's to
/// the last bit, with rows of all kinds, impacts among them, and islands that grow while they are solved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/contact/halving.hpp"
#include "core/contact/row_order.hpp"
#include "gpu/device/reference.hpp"
#include "gpu/step/contact_row.hpp"
#include "gpu/step/step_solve.hpp"
#include "tools/impacts_by_core.hpp"

namespace gambeson::gpu {
namespace {

/// Samples that a lattice of fewer points carries, some of which are held: among them the rows of it that `holds`
/// names, which makes islands.
template <class Holds>
void giveMotion(Model& m, int samples, const Holds& holds) {
  Random random(57);
  const int across = 13, points = samples / 4 + across + 3;
  m.surface.WT.column_count = points;
  for (int s = 0; s < samples; ++s) {
    const double u = 0.1 + 0.8 * std::abs(random.even()), v = 0.1 + 0.8 * std::abs(random.even());
    const int first = s / 4;
    m.surface.WT.add(first, (1 - u) * (1 - v));
    m.surface.WT.add(first + 1, u * (1 - v));
    m.surface.WT.add(first + across, (1 - u) * v);
    m.surface.WT.add(first + across + 1, u * v);
    m.surface.WT.endRow();
    m.surface.area_m2.push_back(1e-5 * (1 + std::abs(random.even())));
    m.density_kg_per_m2.push_back(0.3 + 0.1 * std::abs(random.even()));
  }
  m.surface.WTt = transpose(m.surface.WT);
  std::vector<Vec3> at;
  for (int s = 0; s < samples; ++s)
    at.push_back({s / 4 % across + 0.3 * (s % 2), s / 4 / across + 0.3 * (s / 2 % 2), 0.1 * random.even()});
  m.place = halvedPlaces(at);
  for (int f = 0; f < points; ++f) {
    m.mass_kg.push_back(1e-5 * (1 + std::abs(random.even())));
    const bool held = f % 29 == 7 || holds(f / across);
    m.inverse_mass.push_back(held ? 0 : 1 / m.mass_kg.back());
  }
}

struct Solved {
  ContactSolve report;
  std::vector<Vec3> traction, impulse, velocity;
  int large = 0, phases = 0;  ///< islands of several chunks, and the most phases of one
  int repeats = 0;            ///< of a device, for want of room
};

Solved byCore(const Model& m, const HostRows& rows, const std::vector<Vec3>& velocity, double dt_s) {
  std::vector<ContactRow> all;
  for (std::size_t i = 0; i < rows.size(); ++i)
    all.push_back(contactRow(rows.facts[i], rows.stencil[i], rows.touch[i], rows.terms[i]));
  Solved s{{}, rows.traction, {}, velocity, 0, 0, 0};
  ContactWork work;
  s.report = solveContacts(all, m.surface.WT, m.inverse_mass, m.surface.area_m2, m.density_kg_per_m2, m.place,
                           m.contact, dt_s, s.velocity, s.traction, s.impulse, work, nullptr, {});
  for (const auto& island : work.islands) {
    s.large += island.chunk_end - island.chunk > 1;
    s.phases = std::max(s.phases, work.chunks[island.chunk_end - 1].phase + 1);
  }
  return s;
}

template <class Device>
Solved byDevice(const Model& m, HostRows rows, const std::vector<Vec3>& velocity, double dt_s) {
  typename Device::Queue queue;
  const SlicedRows<Device> WT(queue, m.surface.WT), WTt(queue, m.surface.WTt);
  auto inverse_mass = uploaded<Device>(queue, m.inverse_mass), density = uploaded<Device>(queue, m.density_kg_per_m2);
  StepSolve<Device> solve(queue, m, WT, WTt, inverse_mass, density);
  auto facts = uploaded<Device>(queue, rows.facts);
  auto stencil = uploaded<Device>(queue, rows.stencil);
  auto touch = uploaded<Device>(queue, rows.touch);
  auto terms = uploaded<Device>(queue, rows.terms);
  auto traction = uploaded<Device>(queue, rows.traction);
  auto impulse = uploaded<Device>(queue, rows.impulse);
  Count n = rows.size();
  std::vector<Point4> predicted;
  for (const Vec3& v : velocity) predicted.push_back({v.x, v.y, v.z, 0});
  auto predictor = uploaded<Device>(queue, predicted), solved = predictor;
  using Solve = StepSolve<Device>;
  SolveFacts facts_now;
  do {
    solve.give({facts.data(), stencil.data(), touch.data(), terms.data(), traction.data(), impulse.data(), &n, n}, dt_s,
               predictor, solved);
    facts_now = queue.download(solve.facts(), 1)[0];
  } while (!solve.took(facts_now));
  Solved s{Solve::report(facts_now), queue.download(traction, n), queue.download(impulse, n), {}, 0, 0,
           solve.repeats()};
  for (const Point4& v : queue.download(solved, velocity.size())) s.velocity.push_back(vec(v));
  return s;
}
bool sameBits(const Vec3& a, const Vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
void expectSame(const std::vector<Vec3>& got, const std::vector<Vec3>& truth, const std::string& what) {
  ASSERT_EQ(got.size(), truth.size()) << what;
  for (std::size_t i = 0; i < got.size(); ++i)
    ASSERT_TRUE(sameBits(got[i], truth[i]) || got[i] == truth[i])
        << what << " " << i << ": " << got[i].x << " " << got[i].y << " " << got[i].z << ", core has " << truth[i].x
        << " " << truth[i].y << " " << truth[i].z;
}

/// What all devices find, which is the same as core's.
Solved expectCores(const Model& m, const HostRows& rows, const std::vector<Vec3>& velocity, double dt_s,
                   const std::string& name) {
  Solved truth = byCore(m, rows, velocity, dt_s);
  const Solved got = byDevice<Reference>(m, rows, velocity, dt_s),
               wide = byDevice<ReferenceOf<32>>(m, rows, velocity, dt_s);
  EXPECT_EQ(got.report.iterations, truth.report.iterations) << name;
  EXPECT_EQ(got.report.converged, truth.report.converged) << name;
  EXPECT_EQ(got.report.residual_m_per_s, truth.report.residual_m_per_s) << name;
  expectSame(got.traction, truth.traction, name + ", traction");
  expectSame(got.impulse, truth.impulse, name + ", impulse");
  expectSame(got.velocity, truth.velocity, name + ", velocity");
  expectSame(wide.traction, truth.traction, name + ", groups of 32, traction");
  expectSame(wide.velocity, truth.velocity, name + ", groups of 32, velocity");
  truth.repeats = got.repeats;
  return truth;
}

TEST(StepSolve, EqualsCoreToTheLastBit) {
  int iterations = 0, joined = 0, phases = 0;
  for (const Hurried& hurried : hurriedSteps()) {
    const DressedScene& scene = *hurried.scene;
    CoreImpacts core(scene);
    core.find(hurried.ends[0]);
    core.addRows(1);
    HostRows rows = core.rows();
    Random random(58);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows.traction[i] = i % 3 == 0 ? Vec3{} : 2e-3 * (rows.facts[i].normal + 0.3 * random.evenVec());
    Model m;
    m.obstacles = scene.obstacles;
    m.contact.relaxation_s = 0.01;
    m.contact.friction = 0.3;
    m.contact.on_cloth = 0.15;
    m.contact.of_obstacle = {0.4};
    m.contact.max_iterations = 160;  // of which the last go without momentum
    giveMotion(m, static_cast<int>(scene.x0.size()), [](int row) { return row % 3 == 2; });
    std::vector<Vec3> velocity;
    for (int f = 0; f < m.freeCount(); ++f) velocity.push_back(0.05 * random.evenVec());
    const Solved truth = expectCores(m, rows, velocity, scene.dt_s, scene.name);
    iterations = std::max(iterations, truth.report.iterations);
    phases = std::max(phases, truth.phases);
    for (std::size_t i = 0; i < rows.size(); ++i)
      joined += rows.traction[i] == Vec3{} && !(truth.traction[i] == Vec3{});
  }
  EXPECT_GT(iterations, 20);  // rows have joined on the way
  EXPECT_GT(joined, 50);
  EXPECT_GT(phases, 5);
}

/// Rows on a plane that carry something, but for some, whose samples are tied to each other one by one.
template <class Holds>
Solved onPlane(int samples, int without, const Holds& holds, const std::string& name) {
  Model m;
  m.obstacles = {{Ellipsoid{{1, 1, 1}}, "body"}};
  m.contact.relaxation_s = 0.01;
  m.contact.friction = 0.3;
  giveMotion(m, samples, holds);
  HostRows rows;
  Random random(59);
  for (int s = 0; s < samples; ++s) {
    ContactFacts f;
    f.normal = normalized(Vec3{0.2 * random.even(), 0.2 * random.even(), 1});
    f.obstacle = 0;
    f.sample = s;
    rows.facts.push_back(f);
    rows.stencil.emplace_back().add(s, 1);
    rows.traction.push_back(s % without == without - 1 ? Vec3{} : Vec3{0, 0, 1e-3});
  }
  rows.touch.resize(rows.size()), rows.terms.resize(rows.size()), rows.impulse.resize(rows.size());
  std::vector<Vec3> velocity;
  for (int f = 0; f < m.freeCount(); ++f) velocity.push_back(0.05 * random.evenVec() - Vec3{0, 0, 0.02});
  return expectCores(m, rows, velocity, 1e-4, name);
}

TEST(StepSolve, TakesLargeIslandsBesideSmallOnes) {
  // Three large islands of different sizes, then as many small ones as fit. Where a row of the lattice ends it is tied
  // to the one after the next.
  const auto holds = [](int row) {
    const int of = row / 2 * 2;
    return of == 40 || of == 100 || of == 180 || (of > 180 && of % 6 == 0);
  };
  const Solved truth = onPlane(12000, 5, holds, "islands of all sizes");
  EXPECT_EQ(truth.large, 3);
  EXPECT_GT(truth.phases, 1);
}

TEST(StepSolve, MakesRoomForThePointsOfParts) {
  const Solved truth = onPlane(
      12000, 5, [](int) { return false; }, "one island");
  EXPECT_EQ(truth.large, 1);
  EXPECT_EQ(truth.repeats, 1);
}

/// The largest island that is whole, and the least that is cut.
TEST(StepSolve, CutsIslandsWhereCoreDoes) {
  for (const int rows : {kWholeIsland, kWholeIsland + 1}) {
    const Solved truth = onPlane(
        rows, 1 << 20, [](int) { return false; }, std::to_string(rows) + " rows");
    EXPECT_EQ(truth.large, rows > kWholeIsland);
  }
}

}  // namespace
}  // namespace gambeson::gpu
