/// Contact solves on the reference device: the bits of core, for groups of any size, and of gpu/manifest.json.
#include "gpu/solve/contact_sweeps.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/contact/contact_iteration.hpp"
#include "core/error.hpp"
#include "gpu/scenes/random.hpp"
#include "gpu/scenes/solve_facts.hpp"
#include "tools/recorded_solve.hpp"

namespace gambeson::gpu {
namespace {

bool sameNumbers(const std::vector<ContactWork::Quad>& a, const std::vector<ContactWork::Quad>& b) {
  return std::ranges::equal(a, b, [](const ContactWork::Quad& x, const ContactWork::Quad& y) {
    return std::memcmp(x.lane, y.lane, 3 * sizeof(double)) == 0;
  });
}

void expectSame(const ContactWork& core, const ContactWork& device, const std::string& what) {
  EXPECT_TRUE(sameNumbers(core.candidate, device.candidate)) << what;
  EXPECT_TRUE(sameNumbers(core.previous, device.previous)) << what;
  EXPECT_TRUE(sameNumbers(core.moved, device.moved)) << what;
  EXPECT_TRUE(sameNumbers(core.moved_before, device.moved_before)) << what;
  EXPECT_EQ(factsOf(core), factsOf(device)) << what;  // with the islands' states
}

int largestIsland(const ContactWork& w) {
  int most = 0;
  for (const ContactWork::Island& i : w.islands) most = std::max(most, i.row_end - i.row);
  return most;
}

/// Rows alone, pairs, islands of all sizes up to three chunks' and more; frictions from none to much, some with drag
/// through compliance.
std::vector<ContactProblem> problems() {
  std::vector<ContactProblem> all = manifestProblems();
  std::vector<ContactProblem> small;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) small.push_back(contactStack({1, 1, 0.15}, seed));
  for (std::uint64_t seed = 1; seed <= 6; ++seed) small.push_back(contactStack({2, 3, 0.5}, seed));
  all.push_back(besides(small));
  all.push_back(contactStack({3, 7, 1}, 8));     // one chunk of 675 rows
  all.push_back(contactStack({1, 40, 0.5}, 9));  // chunks of 3,300 rows
  Random random(3);
  for (ContactProblem& p : all)
    for (double& mu : p.friction) mu = std::max(0.0, 0.8 * random.even());
  return all;
}

TEST(ContactSweeps, AreCoresToTheLastBitForGroupsOfAnySize) {
  int alone = 0, most = 0, done = 0, islands = 0;
  for (const ContactProblem& p : problems()) {
    const ContactWork core = solved(p, 60, nullptr);
    for (int quads : {1, 8, 16, 64}) {
      const auto device = sweepsOnReference(quads);
      expectSame(core, solved(p, 60, device.get()), p.name + ", quads " + std::to_string(quads));
    }
    for (const ContactWork::Island& i : core.islands) {
      alone += i.row_end - i.row == 1;
      done += i.done;
      ++islands;
    }
    most = std::max(most, largestIsland(core));
  }
  EXPECT_GT(alone, 20);
  EXPECT_GT(most, 3000);
  EXPECT_GT(done, 20);
  EXPECT_LT(done, islands);  // some are cut off
}

/// A goal that nothing meets: the residual stops to fall at rounding, steps become shorter, momentum begins anew, and
/// the last quarter goes without.
TEST(ContactSweeps, TakeTheSafeguardsOfCore) {
  ContactProblem p = contactStack({3, 5, 1}, 4);
  p.goal_m_per_s = 0;
  constexpr int kMost = 1600;
  const auto device = sweepsOnReference();
  ContactWork start;
  startProblem(p, start);
  bool cautious = false, restarted = false, calm = false;
  double momentum = 1;
  for (int last : {3, 40, 200, 700, 1190, 1210, kMost}) {
    ContactWork core = start, other = start;
    iterate(p.goal_m_per_s, last, kMost, core);
    device->set(other);
    device->run(p.goal_m_per_s, last, kMost);
    device->get(other);
    expectSame(core, other, std::to_string(last));
    const ContactWork::Island& island = core.islands[0];
    EXPECT_EQ(island.iterations, last);
    cautious = cautious || island.caution > 1;
    restarted = restarted || island.momentum < momentum;
    calm = calm || (last > kMost * 3 / 4 && island.beta == 0);
    momentum = island.momentum;
  }
  EXPECT_TRUE(cautious);
  EXPECT_TRUE(restarted);
  EXPECT_TRUE(calm);
}

/// An iteration that is left and taken up again, on one device or the other, and a run that is repeated.
TEST(ContactSweeps, GoOnWhereTheyWereLeft) {
  const ContactProblem p = besides({contactStack({2, 6, 0.8}, 1), contactStack({1, 30, 0.5}, 2)});
  ContactWork core, there;
  startProblem(p, core);
  there = core;
  iterate(1e-7, 80, 4000, core);
  const auto device = sweepsOnReference(16);
  iterate(1e-7, 30, 4000, there);
  device->set(there);
  device->run(1e-7, 50, 4000);
  device->get(there);
  device->set(there);
  for (int again = 0; again < 2; ++again) device->run(1e-7, 80, 4000);
  device->get(there);
  expectSame(core, there, "in three pieces");
}

/// Iterations and bits that the device which the manifest names found; `gambeson_gpu_check --write-manifest` writes
/// them.
TEST(ContactSweeps, FindWhatTheManifestHas) {
  std::ifstream file(std::string(GAMBESON_SOURCE_DIR) + "/gpu/manifest.json");
  const auto manifest = nlohmann::json::parse(file);
  const std::vector<ContactProblem> kept = manifestProblems();
  const auto& problems = manifest.at("solves");
  ASSERT_EQ(problems.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto& truth = problems[i];
    const auto device = sweepsOnReference();
    const SweepFacts facts = factsOf(solved(kept[i], kManifestIterations, device.get()));
    EXPECT_EQ(truth.at("name"), kept[i].name);
    EXPECT_EQ(truth.at("rows"), facts.rows) << kept[i].name;
    EXPECT_EQ(truth.at("islands"), facts.islands) << kept[i].name;
    EXPECT_EQ(truth.at("iterations"), facts.iterations) << kept[i].name;
    EXPECT_EQ(truth.at("hash"), fmt::format("{:016x}", facts.hash)) << kept[i].name;
  }
}

/// Solves recorded from a walk in armour, where they are.
TEST(ContactSweeps, RecordedSolvesAreCoresToTheLastBit) {
  const char* folder = std::getenv("GAMBESON_SOLVES");
  const std::filesystem::path solves = folder ? folder : std::string(GAMBESON_SOURCE_DIR) + "/../shared/trials/gpu";
  if (!std::filesystem::exists(solves / "solve0.bin")) GTEST_SKIP() << "no solve0.bin in " << solves;
  for (int k = 0; k < 10; ++k) {
    const ContactProblem p = recordedSolve(solves / fmt::format("solve{}.bin", k));
    const ContactWork core = solved(p, 2000, nullptr);
    const auto device = sweepsOnReference();
    expectSame(core, solved(p, 2000, device.get()), p.name);
    for (const ContactWork::Island& i : core.islands) EXPECT_TRUE(i.done) << p.name;
  }
}

TEST(ContactSweeps, RefuseGroupsThatDoNotDivideTheSums) { EXPECT_THROW(sweepsOnReference(24), RunError); }

}  // namespace
}  // namespace gambeson::gpu
