/// Forces on the reference device: against core, the same bits whatever the way and the sizes of blocks, and against
/// differences of the energy.
#include "gpu/forces/forces.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/cloth/joined_cloth.hpp"
#include "core/error.hpp"
#include "force_cloths.hpp"
#include "gpu/forces/basic_number.hpp"
#include "gpu/forces/roots.hpp"
#include "gpu/scenes/force_scenes.hpp"
#include "unit/core/cloth/triangles/triangle_shapes.hpp"

namespace gambeson::gpu {
namespace {

/// f, T^T f and what the laws would remember.
struct All {
  std::vector<Vec3> f, free;
  std::vector<double> history;
  bool operator==(const All& o) const { return f == o.f && free == o.free && history == o.history; }
};

constexpr double kElapsed_s = 3e-3;

All ofDevice(const ForceCloth& c, std::span<const double> committed, const ForceOptions& options = {}) {
  const auto forces = forcesOnReference(*c.cloth, options);
  EXPECT_EQ(forces->points(), c.cloth->points());
  EXPECT_EQ(forces->freePoints(), static_cast<int>(c.p.size()));
  forces->setHistory(committed, kElapsed_s);
  forces->setFree(c.p);
  forces->placePoints();
  forces->evaluate();
  forces->freeForces();
  return {forces->force(), forces->freeForce(), forces->history()};
}

All ofCore(const ForceCloth& c, std::span<const double> committed) {
  const std::vector<Vec3> q = c.q();
  All all;
  all.f.resize(q.size());
  all.history.resize(c.cloth->historySize());
  ClothWork work;
  c.cloth->force(ClothState(q, {}, committed, {}, kElapsed_s), {all.f, {}, all.history, nullptr}, work, {});
  all.free.resize(c.p.size());
  c.cloth->map().Tt.multiply<Vec3>(all.f, all.free);
  return all;
}

void expectCores(const ForceCloth& c, std::span<const double> committed) {
  const All core = ofCore(c, committed), device = ofDevice(c, committed);
  const double most = largest(core.f);
  EXPECT_GT(most, 0) << c.name;
  EXPECT_LT(farthest(device.f, core.f), 1e-13 * most) << c.name;
  EXPECT_LT(farthest(device.free, core.free), 1e-13 * most) << c.name;
  ASSERT_EQ(device.history.size(), core.history.size()) << c.name;
  // Core also fills up its last groups, with points that do not exist.
  double size = 0, off = 0;
  for (const HistoryPlace& place : c.cloth->historyPlaces())
    for (std::size_t k = 0; k < place.count; ++k) {
      const std::size_t at = place.first + k * place.stride;
      size = std::max(size, std::abs(core.history[at]));
      off = std::max(off, std::abs(core.history[at] - device.history[at]));
    }
  EXPECT_LE(off, 1e-12 * size) << c.name;
}

TEST(Forces, AreThoseOfCore) {
  for (const ForceCloth& c : quadCloths()) expectCores(c, {});
  for (const ForceCloth& c : otherCloths()) expectCores(c, {});
}

TEST(Forces, FollowACommittedHistory) {
  for (ForceCloth& c : otherCloths()) {
    if (c.cloth->historySize() == 0) continue;
    const std::vector<double> committed = ofCore(c, {}).history;
    EXPECT_GT(*std::ranges::max_element(committed), 0) << c.name;
    ForceCloth moved = c;
    for (Vec3& p : moved.p) p.z *= 0.7;
    expectCores(moved, committed);
    // Committed on the device.
    const auto forces = forcesOnReference(*c.cloth);
    forces->setHistory({}, kElapsed_s);
    for (const ForceCloth& at : {c, moved}) {
      forces->setFree(at.p);
      forces->placePoints();
      forces->evaluate();
      if (at.p == c.p) forces->commitHistory();
    }
    const All core = ofCore(moved, committed);
    EXPECT_LT(farthest(forces->force(), core.f), 1e-13 * largest(core.f)) << c.name;
    EXPECT_GT(farthest(ofDevice(moved, {}).f, core.f), 1e-3 * largest(core.f)) << c.name;
  }
}

TEST(Forces, AnyWayAndSizeGivesTheSameBits) {
  for (const ForceCloth& c : quadCloths()) {
    const All one = ofDevice(c, {});
    for (const QuadPath path : {QuadPath::tiles, QuadPath::strips})
      for (int size = 0; size < static_cast<int>(quadSizes(path).size()); ++size)
        for (const int rows : {0, 3, 1000}) {
          ForceOptions options;
          options.path = path;
          options.size = size;
          options.strip_rows = rows;
          EXPECT_TRUE(ofDevice(c, {}, options) == one) << c.name << ", " << quadSizes(path)[size] << ", " << rows;
        }
  }
}

/// The ways of quadratic and of all cells share their laws at a point, and nothing else.
TEST(Forces, BothWaysThroughQuadraticCellsAgree) {
  ForceOptions general;
  general.general_cells = true;
  for (const ForceCloth& c : quadCloths()) {
    const All one = ofDevice(c, {}), other = ofDevice(c, {}, general);
    EXPECT_LT(farthest(one.f, other.f), 1e-13 * largest(one.f)) << c.name;
    EXPECT_FALSE(one.f == other.f) << c.name;
  }
}

TEST(Forces, AreTheGradientOfTheEnergy) {
  const std::vector<ForceCloth> quads = quadCloths();
  for (const ForceCloth& c : {quads[1], quads[5], quads[7]}) {
    const All all = ofDevice(c, {});
    ClothWork work;
    std::vector<Vec3> f(all.f.size());
    const auto energy = [&](std::span<const Vec3> q) {
      double e = 0;
      c.cloth->force(q, f, work, &e);
      return e;
    };
    std::vector<Vec3> q = c.q();
    const double step = 1e-6, most = largest(all.f);
    for (std::size_t i = 0; i < q.size(); i += 7)
      for (int k = 0; k < 3; ++k) {
        const double at = q[i][k];
        q[i][k] = at + step;
        const double more = energy(q);
        q[i][k] = at - step;
        const double less = energy(q);
        q[i][k] = at;
        EXPECT_NEAR(all.f[i][k], (less - more) / (2 * step), 2e-7 * most) << c.name << ", point " << i;
      }
  }
}

TEST(Forces, WhatIsNotCarriedIsRefusedByName) {
  const auto refused = [](const Fabric& fabric, const ShellOptions& options, const std::string& name) {
    const ForceCloth c =
        forceCloth(name, shapes::garmentOf({shapes::curvedPatch(2, 2, false)}, {}, fabric), 0.01, options);
    ASSERT_TRUE(notCarried(*c.cloth)) << name;
    EXPECT_NE(notCarried(*c.cloth)->find(name), std::string::npos) << *notCarried(*c.cloth);
    EXPECT_THROW(forcesOnReference(*c.cloth), RunError);
  };
  Fabric fabric = shapes::plainFabric();
  ShellOptions assumed;
  assumed.rule = CellRule::assumed;
  refused(fabric, assumed, "assumed strains");
  Fabric rubbing = fabric;
  rubbing.shear_friction = {1, 0.1, 0};
  refused(rubbing, {}, "friction in shear");
  for (const auto& list : {quadCloths(), otherCloths()})
    for (const ForceCloth& c : list) EXPECT_FALSE(notCarried(*c.cloth)) << c.name;
  const auto triangles = [] {
    return std::make_unique<TriangleCloth>(
        std::vector<MeshDraft>{shapes::flatTriangles(3, 3, 0.1, 0.1, shapes::plainFabric(), MeshKind::equilateral)});
  };
  EXPECT_EQ(notCarried(*triangles()), "cloth of triangles");
  std::vector<std::unique_ptr<const Cloth>> parts;
  parts.push_back(triangles());
  EXPECT_EQ(notCarried(JoinedCloth(std::move(parts))), "cloths of several kinds");
}

TEST(Forces, RootsAndAnglesAreThoseOfTheLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-320, 300), mantissa(1, 10), turn(-3.14159, 3.14159);
  double off[4] = {};
  for (int i = 0; i < 300000; ++i) {
    const double x = mantissa(random) * std::pow(10, i % 3 == 0 ? exponent(random) : 0.1 * exponent(random) / 10);
    const auto ulps = [](double found, double truth) { return std::abs(found - truth) / (std::abs(truth) * 0x1p-52); };
    if (x < 1e-300) continue;
    off[0] = std::max(off[0], ulps(inverseRoot(x), static_cast<double>(1 / std::sqrt(static_cast<long double>(x)))));
    off[1] = std::max(off[1], ulps(quickRoot(x), std::sqrt(x)));
    const double wide = 100 * turn(random);
    off[3] = std::max({off[3], std::abs(sin(Basic(wide)).value - std::sin(wide)) / 0x1p-52,
                       std::abs(cos(Basic(wide)).value - std::cos(wide)) / 0x1p-52});
    const double angle = turn(random), s = std::sin(angle), c = std::cos(angle);
    off[2] = std::max(off[2], ulps(angleOf(s, c), std::atan2(s, c)));
  }
  EXPECT_LE(off[0], 1.5);
  EXPECT_LE(off[1], 2);
  EXPECT_LE(off[2], 3);
  EXPECT_LE(off[3], 2);
  EXPECT_EQ(atan2(Basic(0), Basic(0)).value, 0);
}

/// Hashes that `gambeson_gpu_check --write-manifest` writes.
TEST(Forces, AreThoseOfTheManifest) {
  std::ifstream file(std::string(GAMBESON_SOURCE_DIR) + "/gpu/manifest.json");
  const auto manifest = nlohmann::json::parse(file).at("forces");
  const std::vector<ForceScene> scenes = manifestForceScenes();
  ASSERT_EQ(manifest.size(), scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    EXPECT_EQ(manifest[i].at("name"), scenes[i].name);
    const auto forces = forcesOnReference(*scenes[i].cloth);
    forces->setFree(scenes[i].p);
    forces->placePoints();
    forces->evaluate();
    forces->freeForces();
    EXPECT_EQ(manifest[i].at("hash"), fmt::format("{:016x}", hashOfForces(forces->freeForce()))) << scenes[i].name;
  }
}

TEST(Forces, WithoutCudaSaysHowToGetIt) {
  const ForceCloth c =
      forceCloth("one", shapes::garmentOf({shapes::curvedPatch(2, 2, false)}, {}, shapes::plainFabric()), 0);
  try {
    forcesOnCuda(*c.cloth);
    GTEST_SKIP() << "built with CUDA";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("CUDA"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gambeson::gpu
