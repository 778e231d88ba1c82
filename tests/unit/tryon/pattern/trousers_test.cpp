/// Trousers: what four rectangles sewn together are, at rest and as they start.

#include "tryon/pattern/trousers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/fit.hpp"

namespace gambeson {
namespace {

class Trousers : public testing::TestWithParam<const char*> {
 protected:
  Human human = makeManikin(GetParam());
  BodyForm form{human};
  TrousersPattern pattern;
  Garment garment = makeTrousers(pattern, form);

  static double widthOf(const Garment& g) {
    double length = 0;
    for (int i = 0; i < 400; ++i) length += norm(surfaceDerivatives(g.patches[0], (i + 0.5) / 400, 0.5)[1]) / 400;
    return length;
  }
  double width() const { return widthOf(garment); }
  double crotch() const { return garment.patches[0].points[0].z; }
  NurbsPatch started(int k) const {
    NurbsPatch p = garment.patches[static_cast<std::size_t>(k)];
    p.points = garment.placed[static_cast<std::size_t>(k)];
    return p;
  }
};

TEST_P(Trousers, EveryEdgeIsSewnOrFreeOnce) {
  ASSERT_EQ(garment.patches.size(), 8u);
  std::map<std::pair<int, Side>, int> uses;
  for (const Seam& s : garment.seams)
    for (const PatchEdge& e : {s.a, s.b}) ++uses[{e.patch, e.side}];
  for (const NamedEdge& named : garment.edges)
    for (const PatchEdge& e : named.edges) ++uses[{e.patch, e.side}];
  EXPECT_EQ(uses.size(), 32u);
  for (const auto& [edge, count] : uses) EXPECT_EQ(count, 1) << edge.first;
  EXPECT_NO_THROW(validate(garment));
  for (const Seam& s : garment.seams) {
    if (s.kind == SeamKind::G1) {
      EXPECT_LT(g1Residual(garment, s), 1e-12);
    } else {
      EXPECT_EQ(s.stiffness_N, 0);
    }
  }
}

// Man 2006, 5.4: four rectangles. The metric of a rectangle is the same everywhere: |X_u| = w, |X_v| its height, at a
// right angle. A spline goes around a circle with a speed that is even to the square of a cell's angle.
TEST_P(Trousers, PanelsAreRectangles) {
  const int cells = static_cast<int>(breakpoints(garment.patches[0].u).size()) - 1;
  const double w = width();
  for (std::size_t k = 0; k < 8; ++k) {
    const double height = k < 4 ? pattern.rise_m : crotch() - pattern.hem_m;
    double length = 0;
    constexpr int n = 400;
    for (int i = 0; i < n; ++i) {
      const auto x = surfaceDerivatives(garment.patches[k], (i + 0.5) / n, 0.37);
      length += norm(x[1]) / n;
      EXPECT_NEAR(norm(x[2]), height, 1e-12);
      EXPECT_NEAR(dot(x[1], x[2]), 0, 1e-12);
      EXPECT_NEAR(norm(x[1]) / w, 1, std::pow(std::numbers::pi / cells, 2));
    }
    EXPECT_NEAR(length / w, 1, 1e-12);
  }
}

// All four panels meet in one point, which eight corners of patches share: there nothing is smooth.
TEST_P(Trousers, MeetAtTheCrotch) {
  const FreeMap map = buildFreeMap(garment);
  std::map<int, int> corners;
  const std::vector<int> offsets = controlOffsets(garment);
  double low = HUGE_VAL;
  for (const BodyShape& s : human.shapes)
    if (s.link == 0) {
      const Posture p = standing(human);
      const Pose X = linkPoses(human.skeleton, p.q, p.root)[0] * s.X_LS;
      low = std::min(low, (X * lowestPoint(s.shape, X.rotation)).z);
    }
  int shared = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    const NurbsPatch& p = garment.patches[k];
    for (const int i : {0, p.u.count() - 1})
      for (const int j : {0, p.v.count() - 1}) {
        const Vec3 x = p.points[static_cast<std::size_t>(p.index(i, j))];
        if (std::abs(x.z - (low - pattern.crotch_ease_m)) > 1e-9 || std::abs(x.y) > 1e-9) continue;
        const int c = offsets[k] + p.index(i, j);
        EXPECT_EQ(map.T.offsets[c + 1] - map.T.offsets[c], 1);  // a free point itself
        ++corners[map.T.columns[map.T.offsets[c]]], ++shared;
      }
  }
  EXPECT_EQ(shared, 8);
  EXPECT_EQ(corners.size(), 1u);
}

// The waist edge starts as a level ring that is as long as the cloth, outside of what the body shows from above.
TEST_P(Trousers, StartOpenAroundTheBody) {
  const Posture standing_ = standing(human);
  const std::vector<Pose> links = linkPoses(human.skeleton, standing_.q, standing_.root);
  double waist = 0, length = 0;
  std::vector<Vec2> ring;
  for (const int k : {hips_front_right, hips_front_left, hips_back_left, hips_back_right}) {
    const NurbsPatch p = started(k);
    Vec3 last = surfaceDerivatives(p, 0, 1)[0];
    waist = last.z;
    for (int i = 1; i <= 200; ++i) {
      const Vec3 x = surfaceDerivatives(p, i / 200.0, 1)[0];
      EXPECT_NEAR(x.z, waist, 1e-9);
      length += norm(x - last);
      ring.push_back({x.x, x.y});
      last = x;
    }
  }
  EXPECT_NEAR(length, 4 * width(), 0.02 * length);
  const ClosedCurve opening(convexHull(ring));
  for (const BodyShape& s : human.shapes) {
    const bool leg = s.name.starts_with("thigh") || s.name.starts_with("knee") || s.name.starts_with("shank");
    if (s.link != 0 && !leg) continue;
    const Pose X = links[static_cast<std::size_t>(s.link)] * s.X_LS;
    for (double z = 0.12; z < waist; z += 0.01)
      for (const Vec2& x : crossSection(s.shape, {X.rotation, X.origin, 1}, z)) {
        const Vec2 c = opening.centroid();
        const Vec2 edge = opening.point(opening.crossing(c, {x.x - c.x, x.y - c.y}));
        EXPECT_GT(std::hypot(edge.x - c.x, edge.y - c.y), std::hypot(x.x - c.x, x.y - c.y)) << s.name << " at " << z;
      }
  }
}

// They start bent, and sheared, but hardly stretched: rows and columns of the panels are as long as at rest, but for
// rows that rise towards the crotch, which the opening lifts.
TEST_P(Trousers, StartUnstretched) {
  const auto lengthOf = [](const NurbsPatch& p, bool row, double at) {
    double length = 0;
    for (int i = 0; i < 200; ++i) {
      const double a = (i + 0.5) / 200;
      length += norm(surfaceDerivatives(p, row ? a : at, row ? at : a)[row ? 1 : 2]) / 200;
    }
    return length;
  };
  for (int k = 0; k < 8; ++k)
    for (const double at : {0.0, 0.2, 0.5, 0.8, 1.0}) {
      const NurbsPatch p = started(k);
      const double height = k < 4 ? pattern.rise_m : crotch() - pattern.hem_m;
      EXPECT_NEAR(lengthOf(p, true, at) / width(), 1, 0.08) << k << " row " << at;
      EXPECT_NEAR(lengthOf(p, false, at) / height, 1, 0.04) << k << " column " << at;
    }
}

TEST_P(Trousers, AreTheirOwnMirrorImage) {
  for (const int k : {0, 2, 4, 6}) {
    const NurbsPatch left = started(k), right = started(k + 1);
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j) {
        const Vec3 a = surfaceDerivatives(left, i / 20.0, j / 20.0)[0];
        const Vec3 b = surfaceDerivatives(right, 1 - i / 20.0, j / 20.0)[0];
        EXPECT_LT(norm(a - Vec3{b.x, 2 * form.medianY() - b.y, b.z}), 1e-4) << k;
      }
  }
}

// Leg and hips have their ease: the wider of both decides.
TEST_P(Trousers, EaseWidensThem) {
  const double before = width();
  pattern.ease = 0.5;
  const Garment wide = makeTrousers(pattern, form);
  EXPECT_NEAR(widthOf(wide) / before, 1.5 / 1.06, 1e-4);
  const Links thigh = form.links({"thigh_left"}, "");
  for (double z = crotch() - 0.15; z < crotch(); z += 0.05)
    EXPECT_GE(2 * before, 1.05 * ClosedCurve(form.hull(z, thigh, false, "")).length()) << z;
}

INSTANTIATE_TEST_SUITE_P(All, Trousers, testing::Values("male_p50", "female_p5", "male_p95"));

TEST(TrousersDraft, RefusesNonsense) {
  const Human human = makeManikin("male_p50");
  const BodyForm form(human);
  const auto keyOf = [&](auto change) -> std::string {
    TrousersPattern p;
    change(p);
    try {
      makeTrousers(p, form);
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "accepted";
  };
  EXPECT_EQ(keyOf([](TrousersPattern&) {}), "accepted");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.ease = -0.5; }), "ease");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.rise_m = 0; }), "rise_m");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.hem_m = std::nan(""); }), "hem_m");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.hem_m = 0.9; }), "hem_m");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.crotch_ease_m = 0.3; }), "crotch_ease_m");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.cell_m = -1; }), "cell_m");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.cell_m = 1e-4; }), "cell_m");
  EXPECT_EQ(keyOf([](TrousersPattern& p) { p.degree = 1; }), "degree");
  Human legless = human;
  std::erase_if(legless.shapes, [](const BodyShape& s) { return s.name.starts_with("thigh"); });
  std::erase_if(legless.shapes, [](const BodyShape& s) { return s.name.starts_with("knee"); });
  std::erase_if(legless.shapes, [](const BodyShape& s) { return s.name.starts_with("shank"); });
  const BodyForm without(legless);
  EXPECT_THROW(makeTrousers({}, without), InputError);
}

}  // namespace
}  // namespace gambeson
