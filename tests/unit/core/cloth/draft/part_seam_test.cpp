// A short edge sewn to a part of a long one, exactly.
#include "core/cloth/draft/part_seam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/cloth/draft/seams.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "core/motion/model.hpp"
#include "core/nurbs/curve.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

/// A sheet of 8 x 4 cells of 1 cm, and a strip of 3 x 5 cells of 1 cm upward from cells 2, 3 and 4 of its upper edge.
/// Reversed: the strip's u runs the other way.
Garment sheetWithStrip(int degree, bool reversed = false, double stiffness_N = 0) {
  Garment g;
  NurbsPatch sheet{uniformKnots(degree, 8), uniformKnots(degree, 4), {}, {}},
      strip{uniformKnots(degree, 3), uniformKnots(degree, 5), {}, {}};
  for (const double v : grevillePoints(sheet.v))
    for (const double u : grevillePoints(sheet.u)) sheet.points.push_back({0.08 * u, 0.04 * v, 0});
  for (const double v : grevillePoints(strip.v))
    for (const double u : grevillePoints(strip.u))
      strip.points.push_back({reversed ? 0.05 - 0.03 * u : 0.02 + 0.03 * u, 0.04 + 0.05 * v, 0});
  sheet.weights.assign(sheet.points.size(), 1);
  strip.weights.assign(strip.points.size(), 1);
  g.patches = {sheet, strip};
  g.weft = {{1, 0, 0}, {1, 0, 0}};
  g.fabric.thickness_m = 1e-3;
  g.fabric.young_weft_Pa = g.fabric.young_warp_Pa = 1e6;
  g.fabric.density_kg_per_m3 = 1000;
  // Reversed or not, the sense of both edges is that of x.
  g.seams = {{{1, Side::v0, reversed}, {0, Side::v1}, SeamKind::C0, stiffness_N, 2}};
  return g;
}

Vec3 at(const Garment& g, const std::vector<Vec3>& q, int patch, double u, double v) {
  const SurfaceBasis b = surfaceBasis(g.patches[patch], u, v);
  const int offset = controlOffsets(g)[patch];
  Vec3 x{};
  for (std::size_t k = 0; k < b.columns.size(); ++k) x += b.values[0][k] * q[offset + b.columns[k]];
  return x;
}

TEST(PartSeam, HoldsTheEdgesTogetherWhateverMoves) {
  for (const int degree : {1, 2, 3, 4})
    for (const bool reversed : {false, true}) {
      const Garment g = sheetWithStrip(degree, reversed);
      const FreeMap map = buildFreeMap(g);
      EXPECT_EQ(map.T.column_count, g.patches[0].size() + g.patches[1].size() - (3 + degree));
      std::mt19937 random(7);
      std::uniform_real_distribution<double> any(-1, 1);
      std::vector<Vec3> p(map.T.column_count), q(map.T.rows());
      for (Vec3& x : p) x = {any(random), any(random), any(random)};
      map.T.multiply<Vec3>(p, q);
      for (int k = 0; k <= 90; ++k) {
        const double s = k / 90.0;
        EXPECT_LT(norm(at(g, q, 1, reversed ? 1 - s : s, 0) - at(g, q, 0, 0.25 + 0.375 * s, 1)), 1e-14)
            << degree << " " << s;
      }
    }
}

TEST(PartSeam, SamplesOnItAreShared) {
  for (const bool reversed : {false, true}) {
    const Garment g = sheetWithStrip(2, reversed);
    const Surface s = buildSurface(g, buildFreeMap(g), 2);
    EXPECT_EQ(s.size(), 17 * 9 + 7 * 11 - 7);
    const auto strip = edgeSamples(s, {1, Side::v0, reversed}), sheet = edgeSamples(s, {0, Side::v1});
    for (std::size_t k = 0; k < strip.size(); ++k) EXPECT_EQ(strip[k], sheet[4 + k]);
    double area = 0;
    for (const double a : s.area_m2) area += a;
    EXPECT_NEAR(area, 0.08 * 0.04 + 0.03 * 0.05, 1e-12);
    EXPECT_THROW(buildSurface(g, buildFreeMap(g), 0), InputError);
  }
}

TEST(PartSeam, SpringTurnsWithTheStrip) {
  // The strip turned by phi about the edge: energy 1/2 k phi^2 L, L = 3 cm.
  for (const bool reversed : {false, true}) {
    const Garment g = sheetWithStrip(2, reversed, 0.3);
    std::vector<Vec3> q;
    for (const NurbsPatch& p : g.patches) q.insert(q.end(), p.points.begin(), p.points.end());
    const double phi = 0.4;
    for (std::size_t i = g.patches[0].points.size(); i < q.size(); ++i) {
      const double up = q[i].y - 0.04;
      q[i] = {q[i].x, 0.04 + std::cos(phi) * up, std::sin(phi) * up};
    }
    double energy = 0;
    for (const HingePoint& h : buildHinges(g)) {
      const double turn = hingeAngle(h, q, nullptr) - h.theta0;
      EXPECT_NEAR(std::abs(turn), phi, 1e-12);
      energy += 0.5 * h.stiffness_length * turn * turn;
    }
    EXPECT_NEAR(energy, 0.5 * 0.3 * phi * phi * 0.03, 1e-12);
  }
}

TEST(PartSeam, TrimmingMayCutTheRestOfTheEdge) {
  const auto notched = [](double from, double to) {
    Garment g = sheetWithStrip(2);
    const std::vector<Vec2> corners{{from, 1}, {to, 1}, {to, 0.6}, {from, 0.6}};
    g.trims = {Trim{{polygon(corners)}}, {}};
    return g;
  };
  const Garment g = notched(0.7, 0.85);
  const Surface s = buildSurface(g, buildFreeMap(g), 2);
  const auto strip = edgeSamples(s, {1, Side::v0}), sheet = edgeSamples(s, {0, Side::v1});
  for (std::size_t k = 0; k < strip.size(); ++k)
    EXPECT_NE(std::find(sheet.begin(), sheet.end(), strip[k]), sheet.end());
  EXPECT_THROW(buildFreeMap(notched(0.6, 0.8)), InputError);  // takes a stretch of the joined part
}

/// Two sheets side by side, and a strip upward from each, both up to the line where the sheets meet; the strips are
/// joined along it.
Garment twoStrips(int degree, bool sheets_joined) {
  Garment g = sheetWithStrip(degree);
  g.patches = {g.patches[0], g.patches[0], g.patches[1], g.patches[1]};
  for (Vec3& x : g.patches[1].points) x.x += 0.08;
  for (Vec3& x : g.patches[2].points) x.x += 0.03;
  for (Vec3& x : g.patches[3].points) x.x += 0.06;
  g.weft.assign(4, {1, 0, 0});
  g.seams = {{{2, Side::v0}, {0, Side::v1}, SeamKind::C0, 0, 5},
             {{3, Side::v0}, {1, Side::v1}, SeamKind::C0, 0, 0},
             {{2, Side::u1}, {3, Side::u0}, SeamKind::C0, 0}};
  if (sheets_joined) g.seams.push_back({{0, Side::u1}, {1, Side::u0}, SeamKind::C0, 0});
  return g;
}

TEST(PartSeam, MeetsAnotherAtACorner) {
  for (const int degree : {1, 2, 3}) {
    const Garment g = twoStrips(degree, true);
    const FreeMap map = buildFreeMap(g);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<Vec3> p(map.T.column_count), q(map.T.rows());
    for (Vec3& x : p) x = {any(random), any(random), any(random)};
    map.T.multiply<Vec3>(p, q);
    for (int k = 0; k <= 30; ++k) {
      const double s = k / 30.0;
      EXPECT_LT(norm(at(g, q, 2, s, 0) - at(g, q, 0, 0.625 + 0.375 * s, 1)), 1e-14);
      EXPECT_LT(norm(at(g, q, 3, s, 0) - at(g, q, 1, 0.375 * s, 1)), 1e-14);
      EXPECT_LT(norm(at(g, q, 2, 1, s) - at(g, q, 3, 0, s)), 1e-14);
    }
  }
  // Sheets that are not joined would part the strips at their corner.
  try {
    buildFreeMap(twoStrips(2, false));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "seams[1]");
    EXPECT_NE(e.reason().find("contradict"), std::string::npos) << e.reason();
  }
}

TEST(PartSeam, BadInputIsRefused) {
  const auto refused = [](const std::function<void(Garment&)>& damage, const char* key = "seams[0]") {
    Garment g = sheetWithStrip(2);
    damage(g);
    try {
      buildFreeMap(g);
    } catch (const InputError& e) {
      return e.where().key == key;
    }
    return false;
  };
  EXPECT_FALSE(refused([](Garment&) {}));
  EXPECT_TRUE(refused([](Garment& g) { g.seams[0].first_cell = 6; }));  // ends beyond
  EXPECT_TRUE(refused([](Garment& g) { g.seams[0].first_cell = 3; }));  // elsewhere at rest
  EXPECT_TRUE(refused([](Garment& g) { g.seams[0].kind = SeamKind::G1; }));
  EXPECT_TRUE(refused([](Garment& g) { g.patches[0].weights.back() = 2; }));
  EXPECT_TRUE(refused([](Garment& g) { g.seams[0].a.side = Side::u0; }));  // five cells
  EXPECT_TRUE(refused([](Garment& g) { g.seams[0].b.patch = 2; }));
  EXPECT_TRUE(refused([](Garment& g) { g.seams[0].a.reversed = true; }));  // the wrong way round
  EXPECT_TRUE(refused([](Garment& g) { g.patches[1].u.knots[4] += 0.01; }));
  EXPECT_TRUE(refused([](Garment& g) { g.seams.push_back(g.seams[0]); }, "seams[1]"));
}

}  // namespace
}  // namespace gambeson
