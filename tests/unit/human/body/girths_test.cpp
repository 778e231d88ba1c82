/// Girths where a tailor takes them, against ellipses in closed form, in any posture.

#include "human/body/girths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "human/body/section.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

const GirthPlane& named(const std::vector<GirthPlane>& planes, const std::string& zone) {
  for (const GirthPlane& p : planes)
    if (p.zone == zone) return p;
  throw std::runtime_error("no " + zone);
}

TEST(Girths, OfAnUpperArmIsThatOfItsCircleHoweverItIsHeld) {
  const Human h = makeManikin("male_p50");
  Posture p = standing(h);
  for (const double raised_deg : {20.0, 85.0}) {
    p.q[static_cast<std::size_t>(h.skeleton.joint("shoulder_abduction_left"))] = raised_deg * rad_per_deg;
    const std::vector<Pose> X = linkPoses(h.skeleton, p.q, p.root);
    double radius = 0;
    for (const BodyShape& s : h.shapes)
      if (s.name == "upper_arm_left") radius = std::get<Ellipsoid>(s.shape).semi_axes.x;
    const double girth = tapeGirth(bodySection(h, named(girthPlanes(h, X), "upper_arm_left"), X, {}));
    // The data's ellipsoid is round and its middle is where the girth is taken; 720 points of the circle.
    EXPECT_NEAR(girth, 2 * std::numbers::pi * radius, 1e-4 * girth);
  }
}

TEST(Girths, AreTakenFromHeadToKneeInTheirOrder) {
  const Human h = makeManikin("female_p50");
  const Posture p = standing(h);
  const std::vector<Pose> X = linkPoses(h.skeleton, p.q, p.root);
  const std::vector<GirthPlane> planes = girthPlanes(h, X);
  ASSERT_EQ(planes.size(), 7u);
  EXPECT_LT(named(planes, "thigh_left").origin.z, named(planes, "hip").origin.z);
  EXPECT_LT(named(planes, "hip").origin.z, named(planes, "waist").origin.z);
  EXPECT_LT(named(planes, "waist").origin.z, named(planes, "chest").origin.z);
  // ANSUR II (human/data/manikins.json): waist at 0.9789 m, chest at 1.1700 m of the median woman. The chest's plane
  // is a share of the trunk, the same for all: 2.2 cm off on her.
  EXPECT_NEAR(named(planes, "waist").origin.z, 0.9789, 0.02);
  EXPECT_NEAR(named(planes, "chest").origin.z, 1.1700, 0.025);
}

TEST(Girths, PiecesOfATetrahedronsLevelHaveItsLength) {
  const std::vector<Vec3> x{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const std::vector<std::array<int, 3>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const GirthPlane level{"", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {}};
  double length = 0;
  for (const auto& [a, b] : cutPieces(level, x, faces)) length += std::hypot(b.x - a.x, b.y - a.y);
  EXPECT_NEAR(length, 2 + std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace gambeson
