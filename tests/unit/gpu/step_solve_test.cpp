/// The contact solve of a step on the reference device: tractions, impulses, velocities and iterations are core's to
/// the last bit, with rows of all kinds, impacts among them, and islands that grow while they are solved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "gpu/device/reference.hpp"
#include "gpu/step/contact_row.hpp"
#include "gpu/step/step_solve.hpp"
#include "tools/impacts_by_core.hpp"

namespace gambeson::gpu {
namespace {

/// Samples that a lattice of fewer points carries, some of which are held.
void giveMotion(Model& m, int samples) {
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
  for (int f = 0; f < points; ++f) {
    m.mass_kg.push_back(1e-5 * (1 + std::abs(random.even())));
    const bool held = f % 29 == 7 || f / across % 3 == 2;  // islands that a group takes
    m.inverse_mass.push_back(held ? 0 : 1 / m.mass_kg.back());
  }
}

struct Solved {
  ContactSolve report;
  std::vector<Vec3> traction, impulse, velocity;
  int largest_island = 0;
};

Solved byCore(const Model& m, const HostRows& rows, const std::vector<Vec3>& velocity, double dt_s) {
  std::vector<ContactRow> all;
  for (std::size_t i = 0; i < rows.size(); ++i)
    all.push_back(contactRow(rows.facts[i], rows.stencil[i], rows.touch[i], rows.terms[i]));
  Solved s{{}, rows.traction, {}, velocity, 0};
  ContactWork work;
  s.report = solveContacts(all, m.surface.WT, m.inverse_mass, m.surface.area_m2, m.density_kg_per_m2, m.place,
                           m.contact, dt_s, s.velocity, s.traction, s.impulse, work, nullptr, {});
  for (const auto& island : work.islands) s.largest_island = std::max(s.largest_island, island.row_end - island.row);
  return s;
}

/// Nothing where an island is too large.
template <class Device>
std::optional<Solved> byDevice(const Model& m, HostRows rows, const std::vector<Vec3>& velocity, double dt_s) {
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
  typename Solve::Outcome outcome;
  do {
    solve.give({facts.data(), stencil.data(), touch.data(), terms.data(), traction.data(), impulse.data(), &n, n}, dt_s,
               predictor, solved);
    facts_now = queue.download(solve.facts(), 1)[0];
    outcome = solve.outcome(facts_now);
  } while (outcome == Solve::Outcome::no_room);
  if (outcome == Solve::Outcome::too_large) {
    EXPECT_EQ(queue.download(traction, n), rows.traction);
    return std::nullopt;
  }
  Solved s{Solve::report(facts_now), queue.download(traction, n), queue.download(impulse, n), {}, 0};
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

TEST(StepSolve, EqualsCoreToTheLastBit) {
  int iterations = 0, joined = 0, too_large = 0;
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
    giveMotion(m, static_cast<int>(scene.x0.size()));
    std::vector<Vec3> velocity;
    for (int f = 0; f < m.freeCount(); ++f) velocity.push_back(0.05 * random.evenVec());
    const double dt_s = scene.dt_s;
    const Solved truth = byCore(m, rows, velocity, dt_s);
    const auto got = byDevice<Reference>(m, rows, velocity, dt_s),
               wide = byDevice<ReferenceOf<32>>(m, rows, velocity, dt_s);
    const bool fits = truth.largest_island <= kIslandRows;
    ASSERT_EQ(got.has_value(), fits) << scene.name;
    ASSERT_EQ(wide.has_value(), fits) << scene.name;
    too_large += !fits;
    if (!fits) continue;
    EXPECT_EQ(got->report.iterations, truth.report.iterations) << scene.name;
    EXPECT_EQ(got->report.converged, truth.report.converged) << scene.name;
    EXPECT_EQ(got->report.residual_m_per_s, truth.report.residual_m_per_s) << scene.name;
    expectSame(got->traction, truth.traction, scene.name + ", traction");
    expectSame(got->impulse, truth.impulse, scene.name + ", impulse");
    expectSame(got->velocity, truth.velocity, scene.name + ", velocity");
    expectSame(wide->traction, truth.traction, scene.name + ", groups of 32, traction");
    expectSame(wide->velocity, truth.velocity, scene.name + ", groups of 32, velocity");
    iterations = std::max(iterations, truth.report.iterations);
    for (std::size_t i = 0; i < rows.size(); ++i)
      joined += rows.traction[i] == Vec3{} && !(truth.traction[i] == Vec3{});
  }
  EXPECT_GT(iterations, 20);  // rows have joined on the way
  EXPECT_GT(joined, 50);
  EXPECT_LT(too_large, 4);
}

/// Rows on a plane, whose samples are tied to each other one by one.
TEST(StepSolve, LeavesIslandsThatAreTooLarge) {
  for (const int count : {kIslandRows, kIslandRows + 1}) {
    Model m;
    m.obstacles = {{Ellipsoid{{1, 1, 1}}, "body"}};
    m.contact.relaxation_s = 0.01;
    giveMotion(m, count);
    std::fill(m.inverse_mass.begin(), m.inverse_mass.end(), 1e5);
    HostRows rows;
    for (int s = 0; s < count; ++s) {
      ContactFacts f;
      f.normal = {0, 0, 1};
      f.obstacle = 0;
      f.sample = s;
      rows.facts.push_back(f);
      rows.stencil.emplace_back().add(s, 1);
      rows.traction.push_back({0, 0, 1e-3});
    }
    rows.touch.resize(rows.size()), rows.terms.resize(rows.size()), rows.impulse.resize(rows.size());
    const std::vector<Vec3> velocity(static_cast<std::size_t>(m.freeCount()), Vec3{0, 0, -0.01});
    const auto got = byDevice<Reference>(m, rows, velocity, 1e-4);
    ASSERT_EQ(got.has_value(), count == kIslandRows);
    if (!got) continue;
    const Solved truth = byCore(m, rows, velocity, 1e-4);
    EXPECT_EQ(got->report.iterations, truth.report.iterations);
    expectSame(got->velocity, truth.velocity, "velocity");
  }
}

}  // namespace
}  // namespace gambeson::gpu
