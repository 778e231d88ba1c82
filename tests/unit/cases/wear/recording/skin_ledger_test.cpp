/// What contact on a skin is at the joints: against the torques of rigid segments, and where the border between
/// segments decides.

#include "cases/wear/recording/skin_ledger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/torque.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/walk.hpp"
#include "human/skin/make_skin.hpp"

namespace gambeson {
namespace {

/// A walking human whose skin belongs whole to one link at each vertex, and moves with it.
std::unique_ptr<Scenario> rigidlySkinned(Counting counting, const Human& human, const Skin& skin) {
  auto s = std::make_unique<Scenario>();
  s->human = human;
  Skin rigid = skin;
  rigid.bends.clear();
  rigid.runs.clear();
  rigid.creases.clear();
  rigid.first = {0};
  rigid.link.clear();
  for (const int l : rigid.segment) {
    rigid.link.push_back(l);
    rigid.first.push_back(static_cast<int>(rigid.link.size()));
  }
  rigid.weight.assign(rigid.link.size(), 1);
  s->human->skin = std::make_shared<const Skin>(std::move(rigid));
  s->motion = makeWalk(*s->human, {});
  s->stage = std::make_unique<CaseStage>();
  s->definition.analysis.counting = counting;
  return s;
}

class OnASkin : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    human_ = new Human(makeManikin("male_p50"));
    skin_ = new Skin(makeSkin(*human_, {0.016, 0.003}));
  }
  static void TearDownTestSuite() {
    delete human_;
    delete skin_;
    human_ = nullptr;
    skin_ = nullptr;
  }
  static Human* human_;
  static Skin* skin_;
};
Human* OnASkin::human_ = nullptr;
Skin* OnASkin::skin_ = nullptr;

TEST_F(OnASkin, ARigidSkinHasTheTorquesOfItsSegments) {
  constexpr double window = 0.01, middle = 0.9;
  for (const Counting counting : {Counting::all_distal, Counting::distal_segment}) {
    const auto s = rigidlySkinned(counting, *human_, *skin_);
    const Skin& skin = *s->human->skin;
    const Posture posture = s->motion->at(middle);
    const std::vector<Pose> X_WL = linkPoses(s->human->skeleton, posture.q, posture.root);
    std::vector<Vec3> x(skin.rest.vertices.size());
    skinPositions(skin, X_WL, x);
    SkinLedger ledger(*s);
    std::vector<LinkImpulse> links(X_WL.size());
    std::mt19937 rng(3);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 400; ++k) {
      const auto& t = skin.rest.triangles[rng() % skin.rest.triangles.size()];
      const Vec3 J{normal(rng), normal(rng), normal(rng)};
      MaterialPoint p;
      const double weights[] = {0.2, 0.5, 0.3};
      for (std::size_t i = 0; i < 3; ++i) {
        p.add(t[i], weights[i]);
        const auto v = static_cast<std::size_t>(t[i]), l = static_cast<std::size_t>(skin.segment[v]);
        links[l].force_Ns += weights[i] * J;
        links[l].moment_Nms += cross(x[v] - X_WL[l].origin, weights[i] * J);
      }
      ledger.add(p, J, {0, 0, 1});
    }
    const std::vector<int> joints = movingJoints(s->human->skeleton);
    const std::vector<double> expected =
        contactTorques(*s->human, posture, links, window, joints,
                       counting == Counting::all_distal ? TorqueCounting::all_distal : TorqueCounting::distal_segment);
    const std::vector<double> row = ledger.row(middle);
    ASSERT_EQ(row.size(), SkinLedger::kPerJoint * joints.size());
    ASSERT_EQ(SkinLedger::columns(*s).size(), row.size());
    double scale = 0;
    for (const double e : expected) scale = std::max(scale, std::abs(e));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      EXPECT_NEAR(row[SkinLedger::kPerJoint * j] / window, expected[j], 1e-6 * scale) << j;  // differences
      EXPECT_NEAR(row[SkinLedger::kPerJoint * j + 1] / window, expected[j], 1e-11 * scale) << j;
    }
    double sum = 0;
    for (const double n : ledger.normal()) sum += n;
    EXPECT_NEAR(sum, 400, 1e-9);
    ledger.clear();
    for (const double r : ledger.row(middle)) EXPECT_EQ(r, 0);
  }
}

/// Virtual work: turning a joint a little does the work tau dq on the forces, however the skin bends, and where folds
/// are bridged too.
TEST_F(OnASkin, TheGeneralisedForceIsTheWorkOfTheForces) {
  auto s = rigidlySkinned(Counting::all_distal, *human_, *skin_);
  s->human->skin = std::make_shared<const Skin>(*skin_);
  constexpr double middle = 0.9, turn = 1e-3;
  BridgedFolds& folds = s->stage->bridged;
  for (int v = 0; v < static_cast<int>(skin_->rest.vertices.size()); v += 2) folds.vertex.push_back(v);
  folds.first = {0, static_cast<int>(folds.vertex.size())};
  folds.way.assign(folds.vertex.size(), {0.03, -0.02, 0.05});
  SkinLedger ledger(*s);
  std::mt19937 rng(5);
  std::normal_distribution<double> normal;
  std::vector<Vec3> force(skin_->rest.vertices.size());
  for (std::size_t v = 0; v < force.size(); v += 3) {
    force[v] = {normal(rng), normal(rng), normal(rng)};
    MaterialPoint p;
    p.add(static_cast<int>(v), 1);
    ledger.add(p, force[v], -0.5 * force[v]);
  }
  const Posture posture = s->motion->at(middle);
  const std::vector<double> row = ledger.row(middle);
  const std::vector<int> joints = movingJoints(s->human->skeleton);
  int compared = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto work = [&](double by) {
      std::vector<double> q = posture.q;
      q[static_cast<std::size_t>(joints[j])] += by;
      std::vector<Vec3> x(force.size());
      const std::vector<Pose> X_WL = linkPoses(s->human->skeleton, q, posture.root);
      skinPositions(*skin_, X_WL, x);
      bridge(folds, *skin_, X_WL, middle, x);
      double sum = 0;
      for (std::size_t v = 0; v < x.size(); ++v) sum += dot(force[v], x[v]);
      return sum;
    };
    const double tau = (8 * (work(turn) - work(-turn)) - (work(2 * turn) - work(-2 * turn))) / (12 * turn);
    EXPECT_NEAR(row[SkinLedger::kPerJoint * j], tau, 1e-4 + 1e-4 * std::abs(tau)) << j;
    EXPECT_NEAR(row[SkinLedger::kPerJoint * j + 4], -0.5 * tau, 1e-4 + 1e-4 * std::abs(tau)) << j;  // the pressing part
    compared += std::abs(tau) > 0.1;
  }
  EXPECT_GT(compared, 6);
}

TEST_F(OnASkin, TheBorderOfASegmentDecidesWithin2Centimetres) {
  const auto s = rigidlySkinned(Counting::all_distal, *human_, *skin_);
  const Skeleton& skeleton = s->human->skeleton;
  const int joint = skeleton.joint("hip_flexion_left"), child = skeleton.joints[static_cast<std::size_t>(joint)].child;
  const std::vector<int> moving = movingJoints(skeleton);
  const auto column = static_cast<std::size_t>(std::find(moving.begin(), moving.end(), joint) - moving.begin());
  const auto distal = [&](int v) {
    return skeleton.isDistal(s->human->skin->segment[static_cast<std::size_t>(v)], child);
  };
  SkinLedger ledger(*s);
  // Across an edge that crosses the border, and far from it.
  bool crossed = false;
  for (const auto& t : skin_->rest.triangles) {
    if (crossed) break;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const double length =
          norm(skin_->rest.vertices[static_cast<std::size_t>(a)] - skin_->rest.vertices[static_cast<std::size_t>(b)]);
      if (!distal(a) || distal(b) || length > SkinLedger::kBorder_m) continue;
      crossed = true;
      for (const int v : {a, b}) {
        ledger.clear();
        MaterialPoint p;
        p.add(v, 1);
        ledger.add(p, {1, 0, 0}, {});
        const std::vector<double> row = ledger.row(0);
        const double* r = &row[SkinLedger::kPerJoint * column];
        EXPECT_EQ(r[1] != 0, v == a);
        EXPECT_NE(r[2], 0);  // the border nearer to the trunk: both are distal
        EXPECT_EQ(r[3], 0);  // farther: neither
      }
      break;
    }
  }
  EXPECT_TRUE(crossed);
}

}  // namespace
}  // namespace gambeson
