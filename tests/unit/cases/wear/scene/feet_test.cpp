/// Feet that are left out until trousers are on.

#include <gtest/gtest.h>

#include "cases/wear/case/case.hpp"
#include "cases/wear/scene/stage.hpp"
#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/foot_ground.hpp"
#include "human/motion/walk.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

TEST(FeetLeftOut, ComeBackAndLeaveTheRestAlone) {
  const Human human = makeManikin("male_p50");
  const auto walk = makeWalk(human, {});
  CaseStage with, without;
  for (CaseStage* stage : {&with, &without}) stage->human = &human, stage->motion = walk.get();
  for (const auto& foot : footShapes(human))
    for (const BodyShape* shape : foot) without.feet.push_back(static_cast<int>(shape - human.shapes.data()));
  ASSERT_EQ(without.feet.size(), 2u);
  without.feet_back_s = 0.5, without.feet_grow_s = 0.3;
  double before = 0;
  for (const double t : {-0.5, 0.0, 0.5, 0.6, 0.7, 0.8, 1.0}) {
    std::vector<Placement> a(human.shapes.size()), b(human.shapes.size());
    with.placements(t, a, {});
    without.placements(t, b, {});
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].origin, b[k].origin);
      EXPECT_EQ(a[k].rotation, b[k].rotation);
      if (!human.shapes[k].name.starts_with("foot")) {
        EXPECT_EQ(b[k].scale, 1);
        continue;
      }
      if (t <= 0.5) {
        EXPECT_LT(b[k].scale, 0.03);
      }
      if (t >= 0.8) {
        EXPECT_EQ(b[k].scale, 1);
      }
      EXPECT_GE(b[k].scale, before - 1e-12);
    }
    before = b[static_cast<std::size_t>(without.feet[0])].scale;
  }
}

TEST(FeetLeftOut, NotOfASkin) {
  EXPECT_NO_THROW(libraryCase("shorts_walk", {R"(human.feet={"back": "1 s"})"}));
  try {
    libraryCase("shorts_walk_skin", {R"(human.feet={"back": "1 s"})"});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "human.feet") << e.what();
  }
}

}  // namespace
}  // namespace gambeson
