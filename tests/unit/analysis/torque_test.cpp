#include "analysis/torque.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace gambeson {
namespace {

constexpr double kUpper_m = 0.3;

Shape ball() { return Ellipsoid{{0.05, 0.05, 0.05}}; }

/// A planar arm in the x-y plane: a base that may stand anywhere, an upper arm of 0.3 m along x, a forearm. The
/// shoulder is a chain of two axes (z, then y) with a massless link between, as the hips of a manikin; a cuff is fixed
/// to the forearm.
Human arm() {
  Human human;
  Skeleton& s = human.skeleton;
  s.links = {{"base", -1, 10, {}}, {"upper_f1", 0, 0, {}}, {"upper", 1, 2, {}}, {"fore", 2, 1, {}}, {"cuff", 3, 0, {}}};
  const auto joint = [](const char* name, JointType type, int parent, int child, Vec3 at, Vec3 axis) {
    Joint j;
    j.name = name;
    j.type = type;
    j.parent = parent;
    j.child = child;
    j.X_PJ.origin = at;
    j.axis = axis;
    return j;
  };
  s.joints = {joint("shoulder_flexion", JointType::revolute, 0, 1, {0, 0, 1}, {0, 0, 1}),
              joint("shoulder_abduction", JointType::revolute, 1, 2, {}, {0, 1, 0}),
              joint("elbow", JointType::revolute, 2, 3, {kUpper_m, 0, 0}, {0, 0, 1}),
              joint("cuff_mount", JointType::fixed, 3, 4, {0.2, 0, 0}, {1, 0, 0})};
  for (const int link : {0, 2, 3, 4})
    human.shapes.push_back({link, s.links[static_cast<std::size_t>(link)].name, ball(), {}});
  return human;
}

const std::vector<int> kAll{0, 1, 2};

TEST(Torque, CountedLinks) {
  const Human human = arm();
  using C = TorqueCounting;
  EXPECT_EQ(countedLinks(human, 0, C::distal_segment), (std::vector<int>{2}));  // through the massless link
  EXPECT_EQ(countedLinks(human, 1, C::distal_segment), (std::vector<int>{2}));
  EXPECT_EQ(countedLinks(human, 2, C::distal_segment), (std::vector<int>{3, 4}));  // with what is fixed to it
  EXPECT_EQ(countedLinks(human, 0, C::all_distal), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(countedLinks(human, 2, C::all_distal), (std::vector<int>{3, 4}));
  EXPECT_EQ(movingJoints(human.skeleton), kAll);
}

// Statics of a two-link arm: shoulder at alpha, elbow at beta, a force across the forearm at d from the elbow. Elbow: F
// d; shoulder: F (d + L cos beta). Over a window of 10 ms, with the elbow off the world's axes because the base stands
// elsewhere.
TEST(Torque, ForceAcrossTheForearm) {
  const Human human = arm();
  const double alpha = 0.4, beta = 0.9, d = 0.2, F = 5, dt = 0.01;
  for (const double turn : {0.0, 1.3}) {
    Posture posture{{alpha, 0, beta, 0}, {rotationAbout({0, 0, 1}, turn), {3, -2, 0.5}}};
    const double direction = turn + alpha + beta;
    const Vec3 along{std::cos(direction), std::sin(direction), 0}, across{-std::sin(direction), std::cos(direction), 0};
    std::vector<LinkImpulse> impulses(5);
    impulses[3] = {F * dt * across, cross(d * along, F * dt * across)};
    const auto all = contactTorques(human, posture, impulses, dt, kAll, TorqueCounting::all_distal);
    EXPECT_NEAR(all[2], F * d, 1e-14);
    EXPECT_NEAR(all[0], F * (d + kUpper_m * std::cos(beta)), 1e-14);
    EXPECT_NEAR(all[1], 0, 1e-14);
    // The upper arm alone received nothing: Man's counting leaves the forearm to the elbow.
    const auto segment = contactTorques(human, posture, impulses, dt, kAll, TorqueCounting::distal_segment);
    EXPECT_NEAR(segment[2], F * d, 1e-14);
    EXPECT_EQ(segment[0], 0);
  }
}

// With all distal links, tau is the derivative of the virtual work of the contact forces by the joint value: the forces
// held, the points where they act carried along by the links (central differences over linkPoses).
TEST(Torque, IsTheVirtualWorkOfTheContactForces) {
  Human human = arm();
  human.skeleton.joints[2].X_PJ.rotation = rotationAbout(normalized({1, 2, 3}), 0.7);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto vec = [&] { return Vec3{u(random), u(random), u(random)}; };
  for (int trial = 0; trial < 20; ++trial) {
    Posture posture{{u(random), u(random), u(random), 0}, {rotationAbout(normalized(vec()), u(random)), vec()}};
    const auto poses = linkPoses(human.skeleton, posture.q, posture.root);
    std::vector<LinkImpulse> impulses(5);
    std::vector<Vec3> points(5), forces(5);
    const double dt = 0.005;
    for (std::size_t l = 0; l < 5; ++l) {
      points[l] = vec();
      forces[l] = 10 * vec();
      impulses[l] = {dt * forces[l], cross(poses[l].rotation * points[l], dt * forces[l])};
    }
    const auto work = [&](const Posture& p) {
      const auto X = linkPoses(human.skeleton, p.q, p.root);
      double w = 0;
      for (std::size_t l = 0; l < 5; ++l) w += dot(forces[l], X[l] * points[l]);
      return w;
    };
    const auto torques = contactTorques(human, posture, impulses, dt, kAll, TorqueCounting::all_distal);
    for (std::size_t j = 0; j < 3; ++j) {
      Posture plus = posture, minus = posture;
      plus.q[j] += 1e-5;
      minus.q[j] -= 1e-5;
      EXPECT_NEAR(torques[j], (work(plus) - work(minus)) / 2e-5, 1e-8) << "trial " << trial << " joint " << j;
    }
  }
}

TEST(Torque, PrismaticJointsTakeTheForceAlongTheAxis) {
  Human human = arm();
  human.skeleton.joints[2].type = JointType::prismatic;
  std::vector<LinkImpulse> impulses(5);
  impulses[4].force_Ns = {1, 2, 3};
  impulses[4].moment_Nms = {7, 7, 7};
  const Posture posture{{0, 0, 0.1, 0}, {}};
  const int elbow = 2;
  const auto force = contactTorques(human, posture, impulses, 0.01, {&elbow, 1}, TorqueCounting::all_distal);
  EXPECT_NEAR(force[0], 300, 1e-12);
}

TEST(Torque, RefusesWrongSizes) {
  const Human human = arm();
  const Posture posture{{0, 0, 0, 0}, {}};
  std::vector<LinkImpulse> impulses(4);
  EXPECT_THROW(contactTorques(human, posture, impulses, 0.01, kAll, TorqueCounting::all_distal), std::logic_error);
  impulses.resize(5);
  EXPECT_THROW(contactTorques(human, posture, impulses, std::nan(""), kAll, TorqueCounting::all_distal),
               std::logic_error);
}

/// A base that walks along x at 1 m/s and turns its arm by 2 rad/s.
class Swing : public Motion {
 public:
  double duration() const override { return 10; }
  Posture at(double t) const override { return {{2 * t, 0, 0, 0}, {{}, {t, 0, 0}}}; }
};

// A constant downward force (-y) at the elbow of an arm that swings on a moving base: tau = -F L cos(2 t). The link
// impulse is that of the forearm, whose origin is the elbow; the mean over a window of 10 ms differs by (2 dt)²/24
// relative.
TEST(Torque, HistoryFollowsTheMotionOfAMovingBase) {
  const Human human = arm();
  const double F = 4, dt = 0.01, start = 0.5;
  std::vector<ContactWindow> windows;
  for (int w = 0; w < 100; ++w) {
    ContactWindow window{start + w * dt, start + (w + 1) * dt, std::vector<LinkImpulse>(5)};
    window.links[3].force_Ns = {0, -F * dt, 0};
    windows.push_back(window);
  }
  const int shoulder = 0;
  const TorqueSeries h = torqueSeries(human, Swing(), start, windows, {&shoulder, 1}, TorqueCounting::all_distal);
  ASSERT_EQ(h.time_s.size(), 100u);
  const auto torque = h.of(0);
  for (std::size_t w = 0; w < 100; ++w) {
    const double from = 2 * dt * static_cast<double>(w), to = from + 2 * dt;
    const double mean = -F * kUpper_m * (std::sin(to) - std::sin(from)) / (2 * dt);
    EXPECT_NEAR(h.time_s[w], start + (static_cast<double>(w) + 0.5) * dt, 1e-12);
    EXPECT_NEAR(torque[w], mean, F * kUpper_m * std::pow(2 * dt, 2) / 23);
  }
  EXPECT_THROW(h.of(1), std::out_of_range);
}

}  // namespace
}  // namespace gambeson
