// Sleeves of the drafted shirt: on every manikin down to the wrist, around the arm, clear of body and shirt.
#include "tryon/pattern/sleeve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/seams.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/contact/contact_mesh.hpp"
#include "core/contact/crossing.hpp"
#include "core/contact/proximity.hpp"
#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/skin/make_skin.hpp"
#include "tryon/pattern/check.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

constexpr double sleeve_layer_m = 1e-3;

/// Where a sleeve ends, by the joints of the arm.
enum class SleeveEnd { short_, elbow, wrist };

class Sleeves : public testing::TestWithParam<const char*> {
 protected:
  Human human = makeManikin(GetParam());
  BodyForm form{human};
  ShirtPattern pattern;

  Sleeves() { pattern.cell_m = 0.03; }

  double armLength() const {
    const Links arm = form.links({"upper_arm_left", "hand_left"}, "arm");
    return norm(form.origin(arm[0]) - form.origin(arm[1]));
  }
  double upperArm() const {
    const Links arm = form.links({"upper_arm_left", "forearm_left"}, "arm");
    return norm(form.origin(arm[0]) - form.origin(arm[1]));
  }
  double lengthOf(SleeveEnd end) const {
    return end == SleeveEnd::short_ ? 0.75 * upperArm() : end == SleeveEnd::elbow ? upperArm() : armLength() - 1e-3;
  }
  Garment shirt(double length_m) {
    pattern.sleeve_length_m = length_m;
    return makeShirt(pattern, form, sleeve_layer_m, {});
  }
};

/// Contact samples of a draft.
struct SleeveSamples {
  Surface surface;
  std::vector<Vec3> x;
  explicit SleeveSamples(const Garment& g, int per_cell = 2)
      : surface(buildSurface(g, buildFreeMap(g), per_cell)), x(static_cast<std::size_t>(surface.size())) {
    std::vector<Vec3> q;
    for (const NurbsPatch& p : g.patches) q.insert(q.end(), p.points.begin(), p.points.end());
    surface.W.multiply<Vec3>(q, x);
  }
};

/// Length of the closed line at height v around the four strips of the left sleeve.
double around(const Garment& g, double v) {
  double length = 0;
  for (int n = sleeve_front_left; n <= sleeve_under_left; ++n) {
    Vec3 before = surfaceDerivatives(g.patches[static_cast<std::size_t>(n)], 0, v)[0];
    for (int i = 1; i <= 60; ++i) {
      const Vec3 x = surfaceDerivatives(g.patches[static_cast<std::size_t>(n)], i / 60.0, v)[0];
      length += norm(x - before);
      before = x;
    }
  }
  return length;
}

TEST_P(Sleeves, AreWornOnEveryArmAtAnyLength) {
  for (const SleeveEnd end : {SleeveEnd::short_, SleeveEnd::elbow, SleeveEnd::wrist}) {
    const Garment g = shirt(lengthOf(end));
    EXPECT_NO_THROW(validate(g));
    ASSERT_EQ(g.patches.size(), 14u);
    const SleeveSamples s(g);
    EXPECT_EQ(findCrossings(contactMesh(s.surface.size(), s.surface.triangles), s.x).size(), 0u);
    const auto obstacles = obstaclesOf(human);
    const Posture p = standing(human);
    const auto placed = placementsOf(human, linkPoses(human.skeleton, p.q, p.root));
    const ProximityQuery query(obstacles);
    double least = HUGE_VAL;
    Vec3 where{};
    for (const Vec3& x : s.x)
      for (std::size_t o = 0; o < obstacles.size(); ++o)
        if (const double d = query.signedDistance(static_cast<int>(o), placed[o], x); d < least) least = d, where = x;
    EXPECT_GE(least, sleeve_layer_m) << static_cast<int>(end) << ": " << where.x << " " << where.y << " " << where.z;
  }
}

TEST_P(Sleeves, EndWhereTheirLengthSays) {
  const Links arm = form.links({"upper_arm_left", "hand_left"}, "arm");
  const Vec3 shoulder = form.origin(arm[0]), down = normalized(form.origin(arm[1]) - shoulder);
  for (const SleeveEnd end : {SleeveEnd::short_, SleeveEnd::elbow, SleeveEnd::wrist}) {
    const Garment g = shirt(lengthOf(end));
    for (int n = sleeve_front_left; n <= sleeve_under_left; ++n)
      for (int i = 0; i <= 10; ++i) {
        const Vec3 x = surfaceDerivatives(g.patches[static_cast<std::size_t>(n)], i / 10.0, 0)[0];
        EXPECT_NEAR(dot(x - shoulder, down), lengthOf(end), 1e-9);
      }
  }
}

// Exactly, whatever the cloth does: the corners hang on two edges each.
TEST_P(Sleeves, StaySewnToTheirArmholes) {
  const Garment g = shirt(lengthOf(SleeveEnd::elbow));
  const FreeMap map = buildFreeMap(g);
  const std::vector<int> offsets = controlOffsets(g);
  std::vector<Vec3> p(static_cast<std::size_t>(map.T.column_count)), q(static_cast<std::size_t>(map.T.rows()));
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = {std::sin(1.7 * static_cast<double>(i)), std::sin(2.9 * static_cast<double>(i)),
            std::cos(4.3 * static_cast<double>(i))};
  map.T.multiply<Vec3>(p, q);
  const auto at = [&](int patch, double u, double v) {
    const SurfaceBasis b = surfaceBasis(g.patches[static_cast<std::size_t>(patch)], u, v);
    Vec3 x{};
    for (std::size_t k = 0; k < b.columns.size(); ++k)
      x += b.values[0][k] * q[static_cast<std::size_t>(offsets[static_cast<std::size_t>(patch)] + b.columns[k])];
    return x;
  };
  const auto cells = [](const KnotVector& k) { return static_cast<double>(breakpoints(k).size()) - 1; };
  const double above = cells(g.patches[sleeve_front_left].u) / cells(g.patches[front].v),
               under = cells(g.patches[sleeve_under_left].u) / cells(g.patches[side_wrap].u);
  for (int k = 0; k <= 40; ++k) {
    const double s = k / 40.0;
    EXPECT_LT(norm(at(sleeve_front_left, s, 1) - at(front, 1, 1 - above + s * above)), 1e-13);
    EXPECT_LT(norm(at(sleeve_top_left, s, 1) - at(strap_left, 1, s)), 1e-13);
    EXPECT_LT(norm(at(sleeve_back_left, s, 1) - at(back, 0, 1 - s)), 1e-13);
    EXPECT_LT(norm(at(sleeve_under_left, s, 1) - at(side_wrap, under * (1 - s), 1)), 1e-13);
    EXPECT_LT(norm(at(sleeve_front_right, s, 1) - at(front, 0, 1 - s * above)), 1e-13);
    EXPECT_LT(norm(at(sleeve_top_right, s, 1) - at(strap_right, 0, 1 - s)), 1e-13);
    EXPECT_LT(norm(at(sleeve_back_right, s, 1) - at(back, 1, s)), 1e-13);
    EXPECT_LT(norm(at(sleeve_under_right, s, 1) - at(side_wrap, 1 - under * s, 1)), 1e-13);
    for (int n = 0; n < 4; ++n) {
      EXPECT_LT(norm(at(sleeve_front_left + n, 1, s) - at(sleeve_front_left + (n + 1) % 4, 0, s)), 1e-13);
      EXPECT_LT(norm(at(sleeve_front_right + n, 0, s) - at(sleeve_front_right + (n + 1) % 4, 1, s)), 1e-13);
    }
  }
}

// What is drafted around the waist does not see them, and a sleeve over another keeps off it.
TEST_P(Sleeves, AreSeenByOtherSleevesAlone) {
  const Garment inner = shirt(lengthOf(SleeveEnd::wrist));
  const Worn under[]{{&inner, sleeve_layer_m}};
  Wrap waist = form.wrap(1.0, 1.1, form.links({"torso"}, ""), "", 5);
  ASSERT_TRUE(wrapOf(under, 0, 0, 1.0, 1.1, 5, waist));
  const Vec3 elbow = form.origin(form.links({"forearm_left"}, "")[0]);
  EXPECT_LT(ClosedCurve(waist.crossSection(1.05)).extent({0, 1}), elbow.y - 0.05);
  SleeveFit fit;
  fit.length_m = lengthOf(SleeveEnd::wrist), fit.ease = 0, fit.gap_m = 1e-3, fit.layer_m = 3e-3;
  const ArmForm over(form, fit, under);
  for (int n = sleeve_front_left; n <= sleeve_under_left; ++n)
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= 8; ++j) {
        const Vec3 x =
            over.toArm() * surfaceDerivatives(inner.patches[static_cast<std::size_t>(n)], i / 8.0, j / 16.0)[0];
        EXPECT_LT(over.kept().beyond(x.z, {x.x, x.y}), -2.5e-3) << n;  // 1 mm and half of both thicknesses, by chords
      }
}

// (1 + ease) the arm's girth by the tape at upper arm and elbow; below it the sleeve hangs, or tapers to its hem.
TEST_P(Sleeves, HaveTheirEaseOverTheArm) {
  const Links all = form.links({"upper_arm_left", "forearm_left", "hand_left"}, "arm");
  SleeveFit fit;
  fit.length_m = armLength() - 1e-3, fit.ease = pattern.sleeve_ease;
  const ArmForm plain(form, fit, {});
  const auto arm = [&](double z) { return tapeGirth(form.across(plain.toArm(), z, all)); };
  const auto girth = [&](const ArmForm& a, double z) { return ClosedCurve(a.at(z)).length(); };
  double widest = 0;  // below the elbow
  for (int k = 0; k <= 20; ++k) widest = std::max(widest, arm(plain.hem() + (plain.elbow() - plain.hem()) * k / 20));
  for (const double z : {0.5 * plain.elbow(), plain.elbow()}) {
    EXPECT_GE(girth(plain, z), (1 + fit.ease) * arm(z) * 0.999) << z;
  }
  EXPECT_NEAR(girth(plain, 0.5 * plain.elbow()), (1 + fit.ease) * arm(0.5 * plain.elbow()), 0.01 * widest);
  EXPECT_NEAR(girth(plain, plain.hem()), (1 + fit.ease) * widest, 0.01 * widest);
  fit.hem_ease = 0.3;
  const ArmForm tapered(form, fit, {});
  EXPECT_NEAR(girth(tapered, tapered.hem()), 1.3 * arm(tapered.hem()), 0.01 * widest);
  EXPECT_GE(girth(tapered, tapered.elbow()), (1 + fit.ease) * arm(tapered.elbow()) * 0.999);
  // And the cloth is what the form says.
  const Garment g = shirt(fit.length_m);
  fit.hem_ease.reset();
  fit.keep_m = sleeve_layer_m + pattern.gap_m + pattern.cell_m * pattern.cell_m / 0.4;
  EXPECT_NEAR(around(g, 0), girth(ArmForm(form, fit, {}), -fit.length_m), 0.01 * widest);
}

TEST_P(Sleeves, EndBetweenArmholeAndWrist) {
  const auto refusal = [&](double length_m) -> std::string {
    try {
      shirt(length_m);
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(armLength() - 1e-3), "accepted");
  EXPECT_EQ(refusal(armLength() + 1e-3), "sleeve_length_m");
  EXPECT_EQ(refusal(0.06), "sleeve_length_m");
  EXPECT_EQ(refusal(-1), "sleeve_length_m");
  pattern.sleeve_ease = std::nan("");
  EXPECT_EQ(refusal(lengthOf(SleeveEnd::elbow)), "sleeve_ease");
  pattern.sleeve_ease = 0.15, pattern.sleeve_hem_ease = -0.1;
  EXPECT_EQ(refusal(lengthOf(SleeveEnd::elbow)), "sleeve_hem_ease");
}

// Nor of themselves: what crosses is freed with a jerk, and a cell that is folded takes steps of a twentieth.
TEST_P(Sleeves, StartClearOfTheSkin) {
  pattern.cell_m = 0.035;
  human.skin = std::make_shared<Skin>(makeSkin(human));
  const BodyForm skinned(human);
  pattern.sleeve_length_m = armLength() - 1e-3;
  const SleeveSamples s(makeShirt(pattern, skinned, sleeve_layer_m, {}), 3);
  TriangleMesh skin{std::vector<Vec3>(human.skin->rest.vertices.size()), human.skin->rest.triangles};
  const Posture p = standing(human);
  skinPositions(*human.skin, linkPoses(human.skeleton, p.q, p.root), skin.vertices);
  const std::vector<Obstacle> obstacles{{skin, "skin"}};
  const ProximityQuery query(obstacles);
  double least = HUGE_VAL;
  for (const Vec3& x : s.x) least = std::min(least, query.signedDistance(0, Placement{}, x));
  EXPECT_GT(least, 0);
  EXPECT_EQ(findCrossings(contactMesh(s.surface.size(), s.surface.triangles), s.x).size(), 0u);
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(Manikins, Sleeves, testing::ValuesIn(manikinsAsked<const char*>()));

}  // namespace gambeson
