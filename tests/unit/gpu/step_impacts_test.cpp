/// The impacts of a step on the reference device: hits and rows are core's to the last bit, round by round, for any
/// width of a group, with too little room.
#include <gtest/gtest.h>

#include <cstdio>

#include "gpu/device/reference.hpp"
#include "gpu/step/impact_step_on.hpp"
#include "tools/impacts_by_core.hpp"

namespace gambeson::gpu {
namespace {

std::string text(const HostRows& rows, std::size_t i) {
  char line[400];
  const ContactFacts& f = rows.facts[i];
  const RowTerms& t = rows.terms[i];
  std::snprintf(
      line, sizeof line,
      "row %zu: kind %d sample %d obstacle %d feature %d gap %.17g layer %.17g target %.17g impact %d pair %d "
      "%d %d stencil of %d, first %d %.17g",
      i, f.kind, f.sample, f.obstacle, f.feature, f.gap_m, f.layer_m, t.target_m_per_s, t.impact, t.pair[0], t.pair[1],
      t.pair[2], rows.stencil[i].count, rows.stencil[i].sample[0], rows.stencil[i].weight[0]);
  return line;
}

void expectSameRows(const HostRows& got, const HostRows& truth, const std::string& where) {
  ASSERT_EQ(got.size(), truth.size()) << where;
  for (std::size_t i = 0; i < got.size(); ++i)
    ASSERT_TRUE(sameRow(got, truth, i)) << where << "\n" << text(got, i) << "\n" << text(truth, i);
}

void expectSameHits(std::vector<StepHit> got, const std::vector<StepHit>& truth, const std::string& where) {
  for (StepHit& hit : got) hit.u = hit.v = 0;
  ASSERT_EQ(got.size(), truth.size()) << where;
  for (std::size_t i = 0; i < got.size(); ++i)
    ASSERT_EQ(got[i], truth[i]) << where << ", hit " << i << ": " << got[i].kind << " " << got[i].first << " "
                                << got[i].second << ", core has " << truth[i].kind << " " << truth[i].first << " "
                                << truth[i].second;
}

/// What a step has been through.
struct Seen {
  ImpactCounts counts;
  unsigned long long replaced = 0;            ///< rows that hits replaced
  unsigned long long of_near = 0, sharp = 0;  ///< of these, of samples near ellipsoids; on sharp parts of bodies
};

/// All rounds of a step beside core.
template <class Device>
void goThrough(const Hurried& hurried, const ImpactSizes& room, unsigned long long row_room, Seen& seen,
               int* repeats = nullptr) {
  CoreImpacts core(*hurried.scene);
  core.bearSome();
  ImpactStepOn<Device> step(core.model(), core.x0(), room);
  HostRows before = core.rows();
  step.setRows(before, std::max<unsigned long long>(row_room, before.size()));
  for (int round = 1; round <= static_cast<int>(hurried.ends.size()); ++round) {
    const std::string where = hurried.scene->name + ", round " + std::to_string(round);
    core.find(hurried.ends[static_cast<std::size_t>(round - 1)]);
    step.setMotion(core.motion());
    const ImpactCounts counts = step.find(round % 2 == 0 ? Trees::refitted : Trees::rebuilt);
    EXPECT_EQ(counts, core.counts()) << where;
    expectSameHits(step.hits(), core.hits(), where);
    core.addRows(round);
    step.addRows(core.terms(round));
    const HostRows truth = core.rows();
    expectSameRows(step.rows(), truth, where);
    if (testing::Test::HasFatalFailure()) return;
    seen.counts.samples += counts.samples, seen.counts.points += counts.points, seen.counts.edges += counts.edges;
    seen.counts.touching += counts.touching;
    seen.replaced += counts.all() - (truth.size() - before.size());
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before.terms[i].impact == 0 && truth.terms[i].impact != 0)
        ++(before.facts[i].kind == kEdgeOnBody ? seen.sharp : seen.of_near);
    before = truth;
  }
  if (repeats) *repeats = step.repeats() + step.rowRepeats();
}

template <class Device>
Seen seenOn(const Hurried& hurried) {
  Seen seen;
  goThrough<Device>(hurried, roomForImpacts(hurried.scene->collisions), 1 << 16, seen);
  return seen;
}

TEST(StepImpacts, HitsAndRowsAreThoseOfCoreToTheLastBit) {
  Seen all;
  for (const Hurried& hurried : hurriedSteps()) {
    const Seen seen = seenOn<Reference>(hurried);
    std::printf(
        "[ measured ] %s: %llu samples into ellipsoids, %llu points, %llu edges, %llu touching; %llu rows replaced, "
        "%llu of samples near ellipsoids, %llu on sharp parts\n",
        hurried.scene->name.c_str(), seen.counts.samples, seen.counts.points, seen.counts.edges, seen.counts.touching,
        seen.replaced, seen.of_near, seen.sharp);
    all.counts.samples += seen.counts.samples, all.counts.points += seen.counts.points;
    all.counts.edges += seen.counts.edges, all.counts.touching += seen.counts.touching;
    all.replaced += seen.replaced, all.of_near += seen.of_near, all.sharp += seen.sharp;
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(all.counts.samples, 300u);
  EXPECT_GT(all.counts.points, 2000u);
  EXPECT_GT(all.counts.edges, 6000u);
  EXPECT_GT(all.counts.touching, 10u);
  EXPECT_GT(all.replaced, 1000u);
  EXPECT_GT(all.of_near, 20u);
  EXPECT_GT(all.sharp, 5u);
}

TEST(StepImpacts, AnyWidthOfAGroupGivesTheSameBits) {
  for (const Hurried& hurried : hurriedSteps()) {
    seenOn<ReferenceOf<5>>(hurried);
    seenOn<ReferenceOf<32>>(hurried);
    if (HasFatalFailure()) return;
  }
}

/// Lists and rows alike.
TEST(StepImpacts, TooLittleRoomIsRepeatedWithMore) {
  for (const auto& make : {+[] { return twoLayers(18); }, +[] { return sheetsAmongAll(18); }}) {
    Hurried hurried{make(), {}};
    hurried.ends = hurriedEnds(*hurried.scene, 1e-3, {0, 0, 2e-3}, 2);
    ImpactSizes ample = roomForImpacts(hurried.scene->collisions);
    for (auto& room : ample) room *= 8;
    CoreImpacts core(*hurried.scene);
    core.moveTo(hurried.ends[0]);
    const auto first = impactStepOnReference(core.model(), core.x0(), ample);
    first->setMotion(core.motion());
    first->find(Trees::rebuilt);
    EXPECT_EQ(first->repeats(), 0);
    for (int k = 0; k < kImpactLists; ++k) {
      if (first->sizes()[static_cast<std::size_t>(k)] < 4) continue;
      ImpactSizes room = ample;
      room[static_cast<std::size_t>(k)] = 3;
      Seen seen;
      int repeats = 0;
      goThrough<ReferenceOf<5>>(hurried, room, 1 << 16, seen, &repeats);
      EXPECT_GE(repeats, 1) << hurried.scene->name << ", list " << k;
    }
    ImpactSizes none;
    none.fill(1);
    Seen seen;
    int repeats = 0;
    goThrough<Reference>(hurried, none, 0, seen, &repeats);
    EXPECT_GE(repeats, 2) << hurried.scene->name;
    EXPECT_GT(seen.counts.all(), 100u);
  }
}

/// Samples that are inside of a body pass through its skin, and through nothing else.
TEST(StepImpacts, WhatIsInsideOfABodyIsNotStoppedByItsSkin) {
  Hurried hurried{sheetOnSolids(24, true), {}};
  hurried.ends = hurriedEnds(*hurried.scene, 1e-3, {0, 0, -1e-3}, 1);
  CoreImpacts core(*hurried.scene);
  core.find(hurried.ends[0]);
  const auto step = impactStepOnReference(core.model(), core.x0(), roomForImpacts(hurried.scene->collisions));
  step->setMotion(core.motion());
  const ImpactCounts some = step->find(Trees::rebuilt);
  ImpactMotion motion = core.motion();
  const std::vector<char> none(core.exempt().size(), 0), all(core.exempt().size(), 1);
  motion.exempt = none;
  step->setMotion(motion);
  EXPECT_GT(step->find(Trees::refitted).all(), some.all() + 20);
  motion.exempt = all;
  step->setMotion(motion);
  step->find(Trees::refitted);
  const int samples = hurried.scene->collisions.cloth.cloth_vertices;
  for (const StepHit& hit : step->hits()) {
    const auto& mesh = hurried.scene->collisions.mesh;
    const auto second = static_cast<std::size_t>(hit.second);
    EXPECT_LT(hit.kind == kPointHit ? mesh.triangles[second][0] : mesh.edges[second][0], samples);
  }
}

/// Vertices of a body that no triangle has are none of its surface.
TEST(StepImpacts, VerticesWithoutATriangleMeetNothing) {
  auto scene = sheetOnSolids(16, true);
  const auto& mesh = scene->collisions.mesh;
  TriangleMesh solid = std::get<TriangleMesh>(scene->obstacles[0].shape);
  // Beside each sample, far from the solid, a vertex that it will run into.
  for (const Vec3& x : scene->x0) solid.vertices.push_back(x + Vec3{0, 0, -5e-4});
  SheetPart part{16, 16, scene->collisions.cloth.rest, scene->x0, scene->x1, 0, 1.2e-3};
  auto with = dressed("vertices alone", {part}, {{solid, "solid", true}}, std::vector<Placement>(1));
  ASSERT_GT(with->collisions.mesh.vertex_count, mesh.vertex_count - 400);
  Hurried hurried{std::move(with), {}};
  hurried.ends.assign(2, hurried.scene->x0);
  for (auto& end : hurried.ends)
    for (Vec3& x : end) x.z -= 1e-3;
  Seen seen;
  goThrough<Reference>(hurried, roomForImpacts(hurried.scene->collisions), 1 << 14, seen);
}

TEST(StepImpacts, ClothThatDoesNotMeetItselfIsNotAsked) {
  for (const auto& make : {+[] { return twoLayers(14); }, +[] { return sheetOnSkin(16); }}) {
    Hurried hurried{make(), {}};
    hurried.ends = hurriedEnds(*hurried.scene, 1e-3, {0, 0, 2e-3}, 2);
    const unsigned long long before = seenOn<Reference>(hurried).counts.all();
    hurried.scene->collisions.self = false;
    const unsigned long long after = seenOn<Reference>(hurried).counts.all();
    EXPECT_LT(2 * after, before) << hurried.scene->name;
  }
}

}  // namespace
}  // namespace gambeson::gpu
