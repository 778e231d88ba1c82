/// Whether a garment hinders or helps, and what a sign means.

#include "cases/wear/results/joint_words.hpp"

#include <gtest/gtest.h>

namespace gambeson {
namespace {

/// The muscles' added torque does work on the joint where both have one sign: that is against the garment.
TEST(JointWords, TheGarmentHindersWhereTheAddedTorqueDoesWork) {
  for (const double torque : {-2.0, 3.0})
    for (const double rate : {-1.0, 0.5})
      EXPECT_EQ(pushOf(torque, rate), torque * rate > 0 ? Push::against : Push::along) << torque << " " << rate;
  EXPECT_EQ(pushOf(3, 0.01), Push::held);
  EXPECT_EQ(pushOf(0, 1), Push::held);
  EXPECT_STREQ(nameOf(Push::against), "against the motion");
  EXPECT_STREQ(nameOf(Push::along), "with the motion");
}

TEST(JointWords, TheSignIsToldInTheMovementsOwnWords) {
  EXPECT_EQ(signOf("flexion"),
            "Above 0 the muscles must pull more towards flexion because of the garment, below 0 more towards "
            "extension. So above 0 it hinders while the joint flexes and helps while it extends; below 0 the other "
            "way round.");
  EXPECT_NE(signOf("rotation").find("while the joint turns inwards"), std::string::npos);
  EXPECT_NE(signOf("").find("towards higher joint values"), std::string::npos);
}

TEST(JointWords, EveryTaskSaysWhatItsNaturalMomentIs) {
  EXPECT_EQ(naturalMeaning(Task::none), "");
  EXPECT_NE(naturalMeaning(Task::natural_walk).find("same on both sides"), std::string::npos);
  EXPECT_NE(naturalMeaning(Task::natural_stairs).find("stair ascent"), std::string::npos);
  EXPECT_NE(naturalMeaning(Task::aiming).find("bears more weight"), std::string::npos);
}

}  // namespace
}  // namespace gambeson
