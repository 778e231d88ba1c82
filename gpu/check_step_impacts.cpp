#include "gpu/check_step_impacts.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "gpu/step/impact_step.hpp"
#include "tools/armour_scene.hpp"
#include "tools/impacts_by_core.hpp"

namespace gambeson::gpu {
namespace {

/// Of a round.
struct RoundFacts {
  ImpactCounts counts;
  ImpactSizes lists;
  std::uint64_t hits = 0, rows = 0;
  bool operator==(const RoundFacts&) const = default;
};

std::uint64_t hashOf(const std::vector<StepHit>& hits, bool with_places) {
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    std::uint64_t one = mixed(i);
    const StepHit& h = hits[i];
    for (const int x : {h.kind, h.first, h.second}) one = mixed(one ^ static_cast<std::uint32_t>(x));
    for (const double x : {h.time, with_places ? h.u : 0, with_places ? h.v : 0})
      one = mixed(one ^ std::bit_cast<std::uint64_t>(x));
    hash += one;
  }
  return hash;
}

/// All rounds on a device, from what is near on.
std::vector<RoundFacts> roundsOf(ImpactStep& step, const Hurried& hurried, CoreImpacts core, int* different_to_core) {
  std::vector<RoundFacts> all;
  step.setRows(core.rows(), 4 * core.rows().size() + 16);
  int round = 0;
  for (const std::vector<Vec3>& ends : hurried.ends) {
    ++round;
    core.moveTo(ends);
    step.setMotion(core.motion());
    RoundFacts facts;
    facts.counts = step.find(round == 1 ? Trees::rebuilt : Trees::refitted);
    facts.lists = step.sizes();
    const std::vector<StepHit> hits = step.hits();
    facts.hits = hashOf(hits, true);
    step.addRows(core.terms(round));
    facts.rows = hashOf(step.rows());
    all.push_back(facts);
    if (!different_to_core) continue;
    core.find(ends);
    core.addRows(round);
    *different_to_core += facts.counts != core.counts() || hashOf(hits, false) != hashOf(core.hits(), false) ||
                          facts.rows != hashOf(core.rows());
  }
  return all;
}

int checkStep(const Hurried& hurried, const StepImpactCheck& settings) {
  const DressedScene& scene = *hurried.scene;
  fmt::print("{}: {} samples, {} triangles of cloth, {} of bodies\n", scene.name, scene.x0.size(),
             scene.collisions.cloth_triangles,
             scene.collisions.mesh.triangles.size() - static_cast<std::size_t>(scene.collisions.cloth_triangles));
  const CoreImpacts core(scene);
  const ImpactSizes room = roomForImpacts(scene.collisions);
  const auto make = [&](bool on_cuda, int groups_per_block) {
    return on_cuda ? impactStepOnCuda(core.model(), core.x0(), room, groups_per_block)
                   : impactStepOnReference(core.model(), core.x0(), room);
  };
  const auto first = make(settings.cuda, 4);
  int different = 0;
  const std::vector<RoundFacts> facts = roundsOf(*first, hurried, CoreImpacts(scene), &different);
  for (const RoundFacts& f : facts)
    fmt::print("  {} samples into ellipsoids, {} points, {} edges, {} touching; hits {:016x}, rows {:016x}; lists {}\n",
               f.counts.samples, f.counts.points, f.counts.edges, f.counts.touching, f.hits, f.rows,
               fmt::join(f.lists, ", "));
  const auto expect = [&](const std::string& what, bool same) {
    fmt::print("  the same {}: {}\n", what, same ? "yes" : "NO");
    different += !same;
  };
  expect("as core", different == 0);
  if (first->repeats() > 0) fmt::print("  passes repeated for want of room: {}\n", first->repeats());
  if (!settings.cuda) return different;
  const auto again = [&](ImpactStep& step) { return roundsOf(step, hurried, CoreImpacts(scene), nullptr) == facts; };
  expect("on the reference", again(*make(false, 0)));
  expect("with one group a block", again(*make(true, 1)));
  CoreImpacts still(scene);
  for (std::size_t k = 0; k < hurried.ends.size(); k += hurried.ends.size() - 1) {
    still.moveTo(hurried.ends[k]);
    first->setMotion(still.motion());
    first->setRows(still.rows(), 4 * still.rows().size() + 16);
    const ImpactCounts counts = first->find(Trees::rebuilt);
    fmt::print("  median of {}, {} hits: {:.4f} ms rebuilt, {:.4f} ms refitted, {:.4f} ms with the wait",
               settings.passes, counts.all(), first->medianMilliseconds(Trees::rebuilt, settings.passes),
               first->medianMilliseconds(Trees::refitted, settings.passes),
               first->medianOfFinds(Trees::refitted, settings.passes));
    fmt::print("; rows {:.4f} ms\n", first->medianOfRows(still.terms(1), settings.passes));
    if (settings.stages)
      for (const auto& [name, ms] : first->stageTimes(settings.passes)) fmt::print("    {:<24} {:.4f} ms\n", name, ms);
  }
  expect("after the timing", again(*first));
  return different;
}

}  // namespace

int checkStepImpacts(const StepImpactCheck& settings) {
  int different = 0;
  for (const Hurried& hurried : hurriedSteps()) different += checkStep(hurried, settings);
  if (!std::filesystem::exists(settings.armour)) {
    fmt::print("no recorded armour{}\n", settings.armour.empty() ? "" : " in " + settings.armour);
    return different;
  }
  // A step of the fine walk as it was recorded, and as it would be at many times the speed.
  Hurried walk{armourScene(settings.armour, 20636, 40054, 3.4e-3 / 1.1), {}};
  for (const double times : {1.0, 8.0, 30.0}) {
    walk.ends.emplace_back();
    for (std::size_t s = 0; s < walk.scene->x0.size(); ++s)
      walk.ends.back().push_back(walk.scene->x0[s] + times * (walk.scene->x1[s] - walk.scene->x0[s]));
  }
  return different + checkStep(walk, settings);
}

}  // namespace gambeson::gpu
