#include "human/motion/inverse_statics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

constexpr double g = 9.81;

/// A revolute chain that hangs from the root: axes -y, so positive values swing the links' -z ends to +x.
Human twoLinks(double l1, double l2, double m1, double m2) {
  Human h;
  h.skeleton.links = {{"root", -1, 0, {}}, {"upper", 0, m1, {0, 0, -0.4 * l1}}, {"lower", 1, m2, {0, 0, -0.6 * l2}}};
  Joint a, b;
  a.type = b.type = JointType::revolute;
  a.parent = 0, a.child = 1, b.parent = 1, b.child = 2;
  a.axis = b.axis = {0, -1, 0};
  b.X_PJ.origin = {0, 0, -l1};
  h.skeleton.joints = {a, b};
  return h;
}

// Closed form: x of the centres of mass 0.4 l1 sin a; l1 sin a + 0.6 l2 sin(a + b); lifting by dq raises them by x dq,
// so the moment is g m x.
TEST(InverseStatics, TwoLinks) {
  const double l1 = 0.4, l2 = 0.5, m1 = 3, m2 = 2, load = 1.5;
  const Human h = twoLinks(l1, l2, m1, m2);
  const std::vector<CarriedMass> carried{{2, {0, 0, -l2}, load}};
  for (const double a : {-0.4, 0.3, 1.2})
    for (const double b : {-0.7, 0.0, 2.0}) {
      const auto X = linkPoses(h.skeleton, std::vector<double>{a, b}, {});
      const auto tau = jointMoments(h, X, carried, {});
      const double lower = g * (m2 * 0.6 * l2 + load * l2) * std::sin(a + b);
      EXPECT_NEAR(tau[1], lower, 1e-12);
      EXPECT_NEAR(tau[0], g * (m1 * 0.4 * l1 + (m2 + load) * l1) * std::sin(a) + lower, 1e-12);
    }
}

// A force from below at the end of the chain, as under a foot: moments -F x.
TEST(InverseStatics, TwoLinksOnTheGround) {
  const Human h = twoLinks(0.4, 0.5, 0, 0);
  const auto X = linkPoses(h.skeleton, std::vector<double>{0.3, -0.8}, {});
  const Vec3 end = X[2] * Vec3{0, 0, -0.5};
  const auto tau = jointMoments(h, X, {}, {{{2, end, 100}}, 0});
  EXPECT_NEAR(tau[0], -100 * end.x, 1e-12);
  EXPECT_NEAR(tau[1], -100 * (end.x - 0.4 * std::sin(0.3)), 1e-12);
}

/// A posture with every joint away from zero, in which both feet stand within `reach`.
struct Crouch {
  Human human = makeManikin("female_p50");
  Posture posture = standing(human);
  std::vector<CarriedMass> carried;
  Crouch() {
    for (std::size_t j = 0; j < posture.q.size(); ++j) posture.q[j] += 0.2 * std::sin(1.0 + static_cast<double>(j));
    posture.root.rotation = rotationAbout(normalized({1, 2, 3}), 0.3);
    carried.push_back({human.skeleton.link("hand_left"), {0.01, 0.02, -0.05}, 3.5});
  }
  double potential(const std::vector<double>& q, const GroundReaction& ground, const std::vector<Vec3>& at_L) const {
    const auto X = linkPoses(human.skeleton, q, posture.root);
    double V = 0;
    for (std::size_t l = 0; l < X.size(); ++l)
      V += g * human.skeleton.links[l].mass_kg * (X[l] * human.skeleton.links[l].center_of_mass).z;
    for (const CarriedMass& c : carried) V += g * c.mass_kg * (X[c.link] * c.point_L).z;
    for (std::size_t f = 0; f < ground.feet.size(); ++f)
      V -= ground.feet[f].force_N * (X[ground.feet[f].link] * at_L[f]).z;
    return V;
  }
};

// Virtual work: a joint's moment is the derivative of the potential energy of weights and of the ground's (constant)
// forces, by central differences.
TEST(InverseStatics, IsTheDerivativeOfThePotential) {
  const Crouch c;
  const auto X = linkPoses(c.human.skeleton, c.posture.q, c.posture.root);
  const GroundReaction ground = groundReaction(c.human, X, c.carried, 1.0);
  ASSERT_EQ(ground.feet.size(), 2u);
  std::vector<Vec3> at_L;
  for (const auto& f : ground.feet) at_L.push_back(inverse(X[f.link]) * f.centre_W);
  const auto tau = jointMoments(c.human, X, c.carried, ground);
  double largest = 0;
  for (std::size_t j = 0; j < tau.size(); ++j) {
    if (c.human.skeleton.joints[j].type == JointType::fixed) continue;
    constexpr double h = 1e-5;
    auto less = c.posture.q, more = c.posture.q;
    less[j] -= h, more[j] += h;
    EXPECT_NEAR(tau[j], (c.potential(more, ground, at_L) - c.potential(less, ground, at_L)) / (2 * h), 1e-6)
        << c.human.skeleton.joints[j].name;
    largest = std::max(largest, std::abs(tau[j]));
  }
  EXPECT_GT(largest, 20);
}

// The ground carries all weight, below the centre of mass: nothing is left to hold the pelvis.
TEST(InverseStatics, GroundBalancesTheBody) {
  const Crouch c;
  const auto X = linkPoses(c.human.skeleton, c.posture.q, c.posture.root);
  double mass = 3.5;
  for (const Link& l : c.human.skeleton.links) mass += l.mass_kg;
  const Vec3 com = centreOfMass(c.human, X, c.carried);
  for (const double reach : {1.0, 1e-3}) {
    const GroundReaction ground = groundReaction(c.human, X, c.carried, reach);
    EXPECT_EQ(ground.feet.size(), reach == 1.0 ? 2u : 1u);
    double force = 0;
    Vec3 moment;
    for (const auto& f : ground.feet) {
      EXPECT_GE(f.force_N, 0);
      force += f.force_N;
      moment += cross(f.centre_W - com, Vec3{0, 0, f.force_N});
    }
    EXPECT_NEAR(force, g * mass, 1e-9);
    EXPECT_NEAR(norm(moment), 0, 1e-9);
  }
}

// Standing upright on both feet: half the weight under each, small moments at hips and knees, and none that differ
// between left and right.
TEST(InverseStatics, StandingIsEasyAndSymmetric) {
  const Human h = makeManikin("male_p50");
  const Posture p = standing(h);
  const auto X = linkPoses(h.skeleton, p.q, p.root);
  const GroundReaction ground = groundReaction(h, X, {});
  ASSERT_EQ(ground.feet.size(), 2u);
  EXPECT_NEAR(ground.feet[0].force_N, ground.feet[1].force_N, 1e-9);
  EXPECT_LT(ground.shift_m, 0.08);
  const auto tau = jointMoments(h, X, {}, ground);
  for (const std::string joint : {"hip_flexion", "knee_flexion", "ankle_flexion"}) {
    const double right = tau[h.skeleton.joint(joint + "_right")], left = tau[h.skeleton.joint(joint + "_left")];
    EXPECT_NEAR(right, left, 1e-9);
    EXPECT_LT(std::abs(right), 25) << joint;
  }
}

TEST(InverseStatics, RefusesABodyWithoutMassOrFeet) {
  Human h = makeManikin("male_p50");
  const Posture p = standing(h);
  const auto X = linkPoses(h.skeleton, p.q, p.root);
  Human light = h;
  for (Link& l : light.skeleton.links) l.mass_kg = 0;
  EXPECT_THROW(groundReaction(light, X, {}), InputError);
  std::erase_if(h.shapes, [](const BodyShape& s) { return s.name == "foot_left"; });
  EXPECT_THROW(groundReaction(h, X, {}), InputError);
}

}  // namespace
}  // namespace gambeson
