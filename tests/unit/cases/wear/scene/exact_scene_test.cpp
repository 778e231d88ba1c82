/// No triangle of the cloth intersects another, of the cloth or of a body, by exact predicates that share nothing with
/// the contact solver; and without self-contact the same scenes do.

#include <gtest/gtest.h>

#include <cstdlib>

#include "unit/cases/wear/scene/exact_scene.hpp"

namespace gambeson {
namespace {

Case coarseDrape() { return libraryCase("sphere_drape", {"garment.sheet.cells_u=16", "garment.sheet.cells_v=16"}); }

TEST(ExactScene, FlagIsFreeOfIntersectionsAfterEveryStep) {
  const ExactRun run = runExactly(libraryCase("flag"), 1, Looks::every_step);
  EXPECT_EQ(run.intersecting, 0) << run.first;
  EXPECT_EQ(run.looks, run.steps + 1);
  EXPECT_GT(run.steps_with_cloth_contact, 100);
}

TEST(ExactScene, FlagWithoutSelfContactPassesThroughItself) {
  const ExactRun run = runExactly(libraryCase("flag"), 0.7, Looks::every_frame, false);
  EXPECT_GT(run.intersecting, 3);
  EXPECT_EQ(run.steps_with_cloth_contact, 0);
}

TEST(ExactScene, CoarseDrapeIsFreeOfIntersectionsAtEveryFrame) {
  const ExactRun run = runExactly(coarseDrape(), 1, Looks::every_frame);
  EXPECT_EQ(run.intersecting, 0) << run.first;
  EXPECT_EQ(run.looks, 51);
}

/// The checker sees the body: a sphere that stands where the cloth is.
TEST(ExactScene, CheckerSeesTheBody) {
  SceneRun scene(coarseDrape());
  const exact::SceneIntersections check(scene.model, scene.stage);
  EXPECT_TRUE(check.at(scene.state).none());
  for (Vec3& p : scene.state.p) p.z -= 0.01;
  const exact::Intersections found = check.at(scene.state);
  ASSERT_FALSE(found.pairs.empty());
  EXPECT_TRUE(found.collapsed.empty());
  for (const exact::IntersectingPair& p : found.pairs) {
    EXPECT_LT(p.a, static_cast<int>(scene.model.surface.triangles.size()));
    EXPECT_NE(check.name(p).find("with sphere"), std::string::npos) << check.name(p);
  }
}

TEST(ExactScene, LongLibraryDrapeIsFreeOfIntersectionsAfterEveryStep) {
  if (!std::getenv("GAMBESON_LONG")) GTEST_SKIP() << "two minutes long: set GAMBESON_LONG to run it";
  const ExactRun run = runExactly(libraryCase("sphere_drape"), 1, Looks::every_step);
  EXPECT_EQ(run.intersecting, 0) << run.first;
  EXPECT_GT(run.steps_with_cloth_contact, 100);
  const ExactRun through = runExactly(libraryCase("sphere_drape"), 0.3, Looks::every_frame, false);
  EXPECT_GT(through.intersecting, 3);
}

TEST(ExactScene, LongFlagIsFreeOfIntersectionsAfterEveryStep) {
  if (!std::getenv("GAMBESON_LONG")) GTEST_SKIP() << "half a minute long: set GAMBESON_LONG to run it";
  const ExactRun run = runExactly(libraryCase("flag"), 3, Looks::every_step);
  EXPECT_EQ(run.intersecting, 0) << run.first;
}

}  // namespace
}  // namespace gambeson
