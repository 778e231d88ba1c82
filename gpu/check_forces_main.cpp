/// Detail of check_forces.hpp.
#include "check_forces.hpp"

#include <fmt/format.h>

#include "gpu/scenes/force_scenes.hpp"
#include "unit/gpu/force_cloths.hpp"

namespace gambeson::gpu {
namespace {

/// f, T^T f and what the laws would remember.
struct Answers {
  std::vector<Vec3> f, free;
  std::vector<double> history;
  bool operator==(const Answers& o) const { return f == o.f && free == o.free && history == o.history; }
};

std::unique_ptr<Forces> make(const Cloth& cloth, bool cuda, const ForceOptions& options) {
  return cuda ? forcesOnCuda(cloth, options) : forcesOnReference(cloth, options);
}

Answers answersOf(Forces& forces, std::span<const Vec3> p, std::span<const double> committed = {}) {
  forces.setHistory(committed, 3e-3);
  forces.setFree(p);
  forces.placePoints();
  forces.evaluate();
  forces.freeForces();
  return {forces.force(), forces.freeForce(), forces.history()};
}

std::string nameOf(const ForceOptions& o) {
  return (o.path == QuadPath::tiles ? "tiles of " : "strips of ") +
         quadSizes(o.path)[static_cast<std::size_t>(o.size)] +
         (o.strip_rows > 0 ? fmt::format(", {} rows", o.strip_rows) : "");
}

std::vector<ForceOptions> allWays(const std::vector<int>& rows) {
  std::vector<ForceOptions> ways;
  for (const QuadPath path : {QuadPath::tiles, QuadPath::strips})
    for (int size = 0; size < static_cast<int>(quadSizes(path).size()); ++size)
      for (const int count : path == QuadPath::strips ? rows : std::vector<int>{0}) {
        ForceOptions options;
        options.path = path;
        options.size = size;
        options.strip_rows = count;
        ways.push_back(options);
      }
  return ways;
}

/// The reference's, and that CUDA gives the same in every way; new cloth and cloth that has been so once.
int compare(const std::string& name, const Cloth& cloth, std::span<const Vec3> p, bool cuda, Answers& reference) {
  const auto on_host = make(cloth, false, {});
  reference = answersOf(*on_host, p);
  int different = 0;
  if (!cuda) return 0;
  const auto expect = [&](const std::string& what, bool same) {
    different += !same;
    if (!same) fmt::print("  DIFFERENT: {}, {}\n", name, what);
  };
  const auto on_device = make(cloth, true, {});
  expect("CUDA", answersOf(*on_device, p) == reference);
  const auto again = answersOf(*on_device, p, reference.history);
  expect("CUDA with a history", again == answersOf(*on_host, p, reference.history));
  for (const ForceOptions& options : allWays({0, 5}))
    expect(nameOf(options), answersOf(*make(cloth, true, options), p) == reference);
  ForceOptions general;
  general.general_cells = true;
  expect("cells by groups", answersOf(*make(cloth, true, general), p) == answersOf(*make(cloth, false, general), p));
  return different;
}

/// Springs, stitches, gravity and drag: the same accelerations on both devices.
int compareMotion(const ForceScene& scene) {
  const int n = static_cast<int>(scene.p.size());
  PointLoads loads;
  loads.mass_kg.assign(scene.p.size(), 1e-3);
  loads.drag_kg_per_s.assign(scene.p.size(), 2e-3);
  loads.held.assign(scene.p.size(), 0);
  loads.held[3] = 1;
  loads.gravity_m_per_s2 = {0, 0, -9.81};
  loads.springs.column_count = n;
  for (int k = 0; k + 40 < n; k += 7) {
    for (int e = 0; e < 9; ++e) loads.springs.add(k + 3 * e, 1.0 / 9);
    loads.springs.endRow();
    loads.stiffness_N_per_m.push_back(10 + k % 5);
  }
  loads.anchored = loads.springs.rows() / 2;
  const auto answers = [&](bool cuda) {
    const auto forces = make(*scene.cloth, cuda, {});
    forces->setLoads(loads);
    const std::vector<Vec3> anchors(static_cast<std::size_t>(loads.anchored), Vec3{0.1, 0.2, 0.3}),
        normals(anchors.size(), Vec3{0, 0, 1});
    forces->setAnchors(anchors, normals);
    forces->setVelocities(scene.p);
    forces->setFree(scene.p);
    forces->placePoints();
    forces->evaluate();
    forces->freeForces();
    forces->accelerate({1, 2, 3}, 1e-4);
    return std::pair(forces->acceleration(), forces->velocity());
  };
  const bool same = answers(false) == answers(true);
  if (!same) fmt::print("  DIFFERENT: accelerations of {}\n", scene.name);
  return !same;
}

/// Of G4: control points, as gpu/DECISIONS.md counts them.
int timeSheet(int cells_u, int cells_v, bool rational, bool cuda, int passes) {
  const ForceScene scene = forceSheet(cells_u, cells_v, rational);
  const int n = scene.cloth->points();
  fmt::print("forces of a {}: {} control points, {} Gauss points\n", scene.name, n, 4L * cells_u * cells_v);
  ClothWork work;
  std::vector<Vec3> core(static_cast<std::size_t>(n));
  scene.cloth->force(scene.p, core, work);
  const auto reference = answersOf(*make(*scene.cloth, false, {}), scene.p);
  const double off = farthest(reference.f, core) / largest(core);
  std::fflush(stdout);
  fmt::print("  off core's by {:.1e} of the largest\n", off);
  int different = !(off <= 1e-13);
  if (!cuda) return different;
  const bool many = n > 500000;
  for (const ForceOptions& options : many ? allWays({0, 64}) : allWays({0})) {
    if (many && options.path == QuadPath::tiles && options.size > 0) continue;
    const auto forces = make(*scene.cloth, true, options);
    const bool same = answersOf(*forces, scene.p) == reference;
    const double us = forces->medianMicroseconds(passes);
    different += !same;
    fmt::print("  {:<44} {:9.2f} us  {:5.2f} G points/s  the reference's bits: {}\n", nameOf(options), us,
               1e-3 * n / us, same ? "yes" : "NO");
  }
  std::fflush(stdout);
  return different;
}

}  // namespace

ForceCheck checkForces(bool cuda, int passes, bool large) {
  ForceCheck check;
  Answers answers;
  int cloths = 0;
  for (const auto& list : {quadCloths(), otherCloths()})
    for (const ForceCloth& c : list) check.different += compare(c.name, *c.cloth, c.p, cuda, answers), ++cloths;
  for (const ForceScene& scene : manifestForceScenes()) {
    check.different += compare(scene.name, *scene.cloth, scene.p, cuda, answers), ++cloths;
    if (cuda) check.different += compareMotion(scene);
    check.hashes.emplace_back(scene.name, hashOfForces(answers.free));
  }
  fmt::print("forces of {} cloths, in all ways: {} differ\n", cloths, check.different);
  check.different += timeSheet(78, 79, true, cuda, passes);
  check.different += timeSheet(78, 79, false, cuda, passes);
  if (large) {
    check.different += timeSheet(316, 316, true, cuda, passes);
    check.different += timeSheet(1000, 1000, true, cuda, passes);
    check.different += timeSheet(1000, 1000, false, cuda, passes);
  }
  return check;
}

}  // namespace gambeson::gpu
