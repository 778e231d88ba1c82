// Garments at rest: seams that fit, girths against the body's, and nets without flaws.
#include "tryon/pattern/pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/wrap.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

template <class F>
std::string rejectedKey(F f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.where().key;
  }
  return "accepted";
}

Vec3 along(const Garment& g, const PatchEdge& e, double t) {
  if (e.reversed) t = 1 - t;
  const NurbsPatch& p = g.patches[e.patch];
  switch (e.side) {
    case Side::u0:
      return surfaceDerivatives(p, 0, t)[0];
    case Side::u1:
      return surfaceDerivatives(p, 1, t)[0];
    case Side::v0:
      return surfaceDerivatives(p, t, 0)[0];
    default:
      return surfaceDerivatives(p, t, 1)[0];
  }
}

double worstGap(const Garment& g) {
  double worst = 0;
  for (const Seam& s : g.seams)
    for (int k = 0; k <= 200; ++k) worst = std::max(worst, norm(along(g, s.a, k / 200.0) - along(g, s.b, k / 200.0)));
  return worst;
}

/// Least and largest area of the cell that the parameters stretch over, relative to the garment's mean.
struct CellAreas {
  double least = std::numeric_limits<double>::infinity(), largest = 0;
};
CellAreas cellAreas(const NurbsPatch& p) {
  CellAreas out;
  const auto bu = breakpoints(p.u), bv = breakpoints(p.v);
  for (std::size_t i = 0; i + 1 < bu.size(); ++i)
    for (std::size_t j = 0; j + 1 < bv.size(); ++j)
      for (double a : {0.0, 0.5, 0.999})
        for (double b : {0.0, 0.5, 0.999}) {
          const double hu = bu[i + 1] - bu[i], hv = bv[j + 1] - bv[j];
          const auto x = surfaceDerivatives(p, bu[i] + a * hu, bv[j] + b * hv);
          const double area = norm(cross(x[1], x[2])) * hu * hv;
          out.least = std::min(out.least, area);
          out.largest = std::max(out.largest, area);
        }
  return out;
}

TEST(Sheet, IsThePlaneItSays) {
  SheetPattern s;
  s.width_m = 0.3;
  s.height_m = 0.5;
  s.cells_u = 4;
  s.cells_v = 7;
  s.degree = 3;
  s.corner = {1, 2, 3};
  s.axis_u = {0, 1, 0};
  s.axis_v = {0, 0, 1};
  const Garment g = makeSheet(s);
  validate(g);
  EXPECT_EQ(g.patches[0].size(), 7 * 10);
  for (double u : {0.0, 0.3, 1.0})
    for (double v : {0.0, 0.77, 1.0}) {
      const auto x = surfaceDerivatives(g.patches[0], u, v);
      EXPECT_LT(norm(x[0] - Vec3{1, 2 + 0.3 * u, 3 + 0.5 * v}), 1e-15);
      EXPECT_LT(norm(x[1] - Vec3{0, 0.3, 0}), 1e-14);
    }
}

TEST(Disc, HasTheAreaAndTheMomentsOfOne) {
  const double r = 0.06;
  for (const int cells : {4, 7, 16}) {
    const Garment g = makeDisc({r, cells, 2, {0.1, -0.2, 0.3}, {0, 1, 0}, {0, 0, 1}});
    const std::vector<double> area = controlAreas(g);
    const NurbsPatch& p = g.patches[0];
    const double side = 2 * r * (cells + 1) / cells;
    double sum = 0, second = 0;
    Vec3 first{};
    for (int j = 0; j < p.v.count(); ++j)
      for (int i = 0; i < p.u.count(); ++i) {
        const auto k = static_cast<std::size_t>(p.index(i, j));
        const Vec3 d = p.points[k] - Vec3{0.1, -0.2, 0.3};
        sum += area[k];
        first += area[k] * d;
        EXPECT_NEAR(d.x, 0, 1e-15);
        // The blossom: products of neighbouring knots are the coefficients of u^2 and v^2.
        const double u2 = p.u.knots[i + 1] * p.u.knots[i + 2], v2 = p.v.knots[j + 1] * p.v.knots[j + 2];
        second += area[k] * (side * side * (u2 + v2) - side * (d.y + d.z) - 0.5 * side * side);
      }
    EXPECT_NEAR(sum / (std::numbers::pi * r * r), 1, 1e-6) << cells;
    EXPECT_LT(norm(first) / (sum * r), 1e-12);
    EXPECT_NEAR(second / (sum * 0.5 * r * r), 1, 1e-6) << cells;
  }
  EXPECT_EQ(rejectedKey([] { makeDisc({0, 8}); }), "radius_m");
  EXPECT_EQ(rejectedKey([] { makeDisc({1, 1}); }), "cells");
  EXPECT_EQ(rejectedKey([] { makeDisc({1, 8, 2, {}, {1, 0, 0}, {1, 0, 0}}); }), "axis_v");
}

TEST(Tube, IsRoundAndG1ForAnyCut) {
  for (int degree : {2, 3, 4})
    for (int patches : {1, 2, 3, 4}) {
      TubePattern t;
      t.radius_m = 0.06;
      t.length_m = 0.5;
      t.degree = degree;
      t.patches = patches;
      t.cells_along = 5;
      t.start = {0.1, 0.2, 0.3};
      t.axis = normalized({1, 2, -2});
      const Garment g = makeTube(t);
      validate(g);
      EXPECT_EQ(g.seams.size(), static_cast<std::size_t>(patches));
      EXPECT_EQ(worstGap(g), 0);
      for (const Seam& s : g.seams) EXPECT_LT(g1Residual(g, s), 1e-16);
      for (const NurbsPatch& p : g.patches)
        for (double u : {0.0, 0.123, 0.5, 0.87, 1.0})
          for (double v : {0.0, 0.4, 1.0}) {
            const auto x = surfaceDerivatives(p, u, v);
            const Vec3 from_axis = x[0] - t.start - v * t.length_m * t.axis;
            EXPECT_NEAR(dot(from_axis, t.axis), 0, 1e-15);
            // Twice the bound of the header, whose leading term it is.
            const double round = t.radius_m * std::pow(std::numbers::pi / t.cells_around, 4) / 4;
            EXPECT_NEAR(norm(from_axis), t.radius_m, round);
            EXPECT_GT(dot(cross(x[1], x[2]), from_axis), 0) << "normal inward";
          }
    }
}

TEST(Tube, CutDoesNotChangeTheShape) {
  TubePattern t;
  t.radius_m = 0.06;
  t.length_m = 0.5;
  const Garment one = makeTube(t);
  t.patches = 4;
  const Garment four = makeTube(t);
  for (int k = 0; k <= 100; ++k) {
    const double s = k / 100.0, u = std::min(4 * s, 3.999999);
    const int n = static_cast<int>(u);
    EXPECT_LT(norm(surfaceDerivatives(one.patches[0], (n + (u - n)) / 4, 0.3)[0] -
                   surfaceDerivatives(four.patches[n], u - n, 0.3)[0]),
              1e-15);
  }
}

TEST(Patterns, RejectBadNumbers) {
  const double nan = std::nan("");
  const auto tube = [](auto damage) {
    TubePattern t;
    t.radius_m = 0.06;
    t.length_m = 0.5;
    damage(t);
    return rejectedKey([&] { makeTube(t); });
  };
  EXPECT_EQ(tube([](auto&) {}), "accepted");
  EXPECT_EQ(tube([&](auto& t) { t.radius_m = nan; }), "radius_m");
  EXPECT_EQ(tube([](auto& t) { t.patches = 5; }), "patches");
  EXPECT_EQ(tube([](auto& t) { t.patches = 0; }), "patches");
  EXPECT_EQ(tube([](auto& t) { t.axis = {1, 1, 0}; }), "axis");
  EXPECT_EQ(tube([](auto& t) { t.degree = 1; }), "degree");
  EXPECT_EQ(tube([](auto& t) { t.cells_around = 2; }), "cells_around");
  SheetPattern s;
  s.width_m = 1;
  EXPECT_EQ(rejectedKey([&] { makeSheet(s); }), "height_m");
  EXPECT_EQ(rejectedKey([&] { sheetEdge("waist"); }), "edge");
  const Human human = makeManikin("male_p50");
  const auto shorts = [&](auto damage) {
    ShortsPattern p;
    damage(p);
    return rejectedKey([&] { makeShorts(p, human); });
  };
  EXPECT_EQ(shorts([&](auto& p) { p.ease = nan; }), "ease");
  EXPECT_EQ(shorts([](auto& p) { p.cell_m = 1e-9; }), "cell_m");
  EXPECT_EQ(shorts([](auto& p) { p.cell_m = 0; }), "cell_m");
  EXPECT_EQ(shorts([](auto& p) { p.inseam_m = 3; }), "inseam_m");
  EXPECT_EQ(shorts([](auto& p) { p.rise_m = 3; }), "rise_m");
  EXPECT_EQ(shorts([](auto& p) { p.gusset_share = 1.2; }), "gusset_share");
  EXPECT_EQ(rejectedKey([&] { makeShorts({}, Human{}); }), "garment.shorts");
}

class Shorts : public testing::TestWithParam<const char*> {
 protected:
  Human human = makeManikin(GetParam());
  ShortsPattern pattern;
  Garment garment = makeShorts(pattern, human);
};

TEST_P(Shorts, SixPatchesOfTheOrderedSize) {
  ASSERT_EQ(garment.patches.size(), 6u);
  EXPECT_EQ(garment.seams.size(), 9u);
  int points = 0;
  for (const NurbsPatch& p : garment.patches) points += p.size();
  EXPECT_GE(points, 1000);
  EXPECT_LE(points, std::string(GetParam()) == "male_p50" ? 1500 : 1600);
}

TEST_P(Shorts, SeamsCoincideAndAreG1) {
  EXPECT_LT(worstGap(garment), 1e-12);
  int g1 = 0;
  for (const Seam& s : garment.seams)
    if (s.kind == SeamKind::G1) {
      EXPECT_LT(g1Residual(garment, s), 1e-15);
      ++g1;
    }
  EXPECT_EQ(g1, 6);
  EXPECT_NO_THROW(validate(garment));
}

TEST_P(Shorts, IsClosedSaveAtWaistAndHems) {
  std::map<std::pair<int, Side>, int> uses;
  for (const Seam& s : garment.seams)
    for (const PatchEdge& e : {s.a, s.b}) ++uses[{e.patch, e.side}];
  for (const char* name : {"waist", "hem_left", "hem_right"})
    for (const PatchEdge& e : shortsEdge(name)) ++uses[{e.patch, e.side}];
  EXPECT_EQ(uses.size(), 24u);
  for (const auto& [edge, count] : uses) EXPECT_EQ(count, 1) << edge.first;
}

TEST_P(Shorts, NormalsPointOutwardAndNoCellIsDegenerate) {
  const Posture posture = standing(human);
  const auto links = linkPoses(human.skeleton, posture.q, posture.root);
  const double crotch = along(garment, {trunk_left, Side::v0}, 0).z;
  double least = 1, largest = 0;
  for (int n = 0; n < 6; ++n) {
    const NurbsPatch& p = garment.patches[n];
    const CellAreas a = cellAreas(p);
    least = std::min(least, a.least);
    largest = std::max(largest, a.largest);
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 30; ++j) {
        const auto x = surfaceDerivatives(p, i / 60.0, j / 30.0);
        // Outward is away from the axis of the trunk, or of the thigh where the patch is a leg's.
        Vec3 axis{links[0].origin.x, 0, x[0].z};
        if (n >= outer_left) {
          const int thigh = human.skeleton.link(n % 2 == 0 ? "thigh_left" : "thigh_right");
          const Vec3 down = links[thigh].rotation * Vec3{0, 0, -1};
          axis = links[thigh].origin + (links[thigh].origin.z - x[0].z) / -down.z * down;
        }
        EXPECT_GT(dot(cross(x[1], x[2]), x[0] - axis), 0) << n << " " << i << " " << j << " crotch at " << crotch;
      }
  }
  EXPECT_GT(least, 0.4 * pattern.cell_m * pattern.cell_m);
  EXPECT_LT(largest / least, 3);
}

/// The tape around rows of constant v of some patches, the rows being horizontal.
double girth(const Garment& g, std::initializer_list<int> patches, double v) {
  std::vector<Vec2> points;
  for (const int n : patches)
    for (int k = 0; k <= 400; ++k) {
      const Vec3 x = surfaceDerivatives(g.patches[n], k / 400.0, v)[0];
      points.push_back({x.x, x.y});
    }
  return ClosedCurve(convexHull(points)).length();
}

TEST_P(Shorts, GirthsAreTheBodysPlusEase) {
  const Posture posture = standing(human);
  const auto placements = placementsOf(human, linkPoses(human.skeleton, posture.q, posture.root));
  const auto tape = [&](std::initializer_list<const char*> links, double z) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < human.shapes.size(); ++i)
      for (const char* name : links)
        if (human.skeleton.links[human.shapes[i].link].name == name)
          for (const Vec2& p : crossSection(human.shapes[i].shape, placements[i], z)) points.push_back(p);
    return ClosedCurve(convexHull(points)).length();
  };
  const auto height = [&](int patch, double v) { return surfaceDerivatives(garment.patches[patch], 0.5, v)[0].z; };
  // Trunk: the convex hull of the body between crotch and waist, found here from the chords of a cloud of its points.
  const double low = height(trunk_left, 0), high = height(trunk_left, 1);
  std::vector<Vec3> cloud;
  for (int k = 0; k <= 15; ++k)
    for (std::size_t i = 0; i < human.shapes.size(); ++i) {
      const std::string& name = human.skeleton.links[human.shapes[i].link].name;
      if (name != "pelvis" && name != "torso" && !name.starts_with("thigh")) continue;
      const double z = low + (high - low) * k / 15;
      const auto points = crossSection(human.shapes[i].shape, placements[i], z);
      for (std::size_t n = 0; n < points.size(); n += 18) cloud.push_back({points[n].x, points[n].y, z});
    }
  for (int k = 0; k <= 5; ++k) {
    const double z = low + (high - low) * k / 5;
    std::vector<Vec2> chords;
    for (const Vec3& a : cloud)
      for (const Vec3& b : cloud)
        if (a.z <= z + 1e-12 && b.z >= z - 1e-12) {
          const double t = b.z - a.z > 1e-9 ? (z - a.z) / (b.z - a.z) : 0;
          chords.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    const double body = ClosedCurve(convexHull(chords)).length();
    EXPECT_NEAR(girth(garment, {trunk_left, trunk_right}, k / 5.0) / body, 1.06, 0.005) << z;
  }
  // Legs: the thigh's below the blend; above it between the thigh's and the fork's.
  for (int k = 0; k <= 20; ++k) {
    const double v = k / 20.0, below = (1 - v) * pattern.inseam_m;
    for (const auto& [outer, inner, thigh] :
         {std::tuple{outer_left, inner_left, "thigh_left"}, std::tuple{outer_right, inner_right, "thigh_right"}}) {
      const double ratio = girth(garment, {outer, inner}, v) / tape({thigh}, height(outer, v));
      if (below >= pattern.blend_m + pattern.cell_m)
        EXPECT_NEAR(ratio, 1.06, 0.002) << v;
      else
        EXPECT_TRUE(ratio > 1.02 && ratio < 1.2) << v << " " << ratio;
    }
  }
}

TEST_P(Shorts, LegsStayOnTheirSides) {
  for (const int n : {outer_left, inner_left})
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j < 40; ++j)
        EXPECT_GT(surfaceDerivatives(garment.patches[n], i / 60.0, j / 40.0)[0].y, 0) << n << " " << i << " " << j;
}

TEST_P(Shorts, WideLegsKeepTheirGirthAndTheirSides) {
  for (const double ease : {0.12, 0.25}) {
    ShortsPattern wide = pattern;
    wide.ease = ease;
    const Garment g = makeShorts(wide, human);
    for (const double v : {0.0, 0.25, 0.45})  // below the blend
      EXPECT_NEAR(girth(g, {outer_left, inner_left}, v) / girth(garment, {outer_left, inner_left}, v),
                  (1 + ease) / 1.06, 0.002)
          << v;
    double least = HUGE_VAL;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j < 40; ++j)
        least = std::min(least, surfaceDerivatives(g.patches[inner_left], i / 60.0, j / 40.0)[0].y);
    EXPECT_GT(least, 0) << ease;
  }
}

TEST_P(Shorts, IsItsOwnMirrorImage) {
  for (const int n : {trunk_left, outer_left, inner_left}) {
    const NurbsPatch &l = garment.patches[n], &r = garment.patches[n + 1];
    for (int j = 0; j < l.v.count(); ++j)
      for (int i = 0; i < l.u.count(); ++i) {
        const Vec3 x = l.points[l.index(i, j)], y = r.points[r.index(l.u.count() - 1 - i, j)];
        EXPECT_LT(norm(x - Vec3{y.x, -y.y, y.z}), 1e-15);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Manikins, Shorts, testing::ValuesIn(manikinsAsked<const char*>()));

TEST(ShortsDraft, HigherDegreesKeepSeamsAndGirths) {
  const Human human = makeManikin("male_p50");
  for (int degree : {3, 4}) {
    ShortsPattern p;
    p.degree = degree;
    const Garment g = makeShorts(p, human);
    for (const Seam& s : g.seams)
      if (s.kind == SeamKind::G1) {
        EXPECT_LT(g1Residual(g, s), 1e-15);
      }
    EXPECT_LT(worstGap(g), 1e-12);
    EXPECT_NEAR(girth(g, {outer_left, inner_left}, 0.2), girth(makeShorts({}, human), {outer_left, inner_left}, 0.2),
                1e-3);
  }
}

TEST(CrossSection, OfATiltedEllipsoidAndOfABoxMesh) {
  // An ellipsoid of revolution about its axis, tilted: the cross-section through the centre is an ellipse with the
  // semi-axes a and a c / sqrt(a² sin² + c² cos²), sin and cos of the tilt.
  const double a = 0.1, c = 0.3, tilt = 0.4;
  const Placement X{rotationAbout({1, 0, 0}, tilt), {0.5, -0.2, 1}, 1};
  double wide = 0, deep = 0;
  for (const Vec2& p : crossSection(Ellipsoid{{a, a, c}}, X, 1)) {
    wide = std::max(wide, std::abs(p.x - 0.5));
    deep = std::max(deep, std::abs(p.y + 0.2));
  }
  EXPECT_NEAR(wide, a, 1e-6);
  EXPECT_NEAR(deep, a * c / std::hypot(a * std::sin(tilt), c * std::cos(tilt)), 1e-5);
  EXPECT_TRUE(crossSection(Ellipsoid{{a, a, c}}, X, 1.31).empty());
  const TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const ClosedCurve t(convexHull(crossSection(tetrahedron, {}, 0.5)));
  EXPECT_NEAR(t.length(), 1 + std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(t.centroid().x, 0.5 / 3, 1e-15);
}

TEST(CrossSection, WrapBridgesTheHollowBetweenTwoSpheres) {
  // Two unit spheres 3 apart: between them the hull is the cylinder of radius 1.
  std::vector<std::vector<Vec2>> cross_sections;
  const int n = 61;
  for (int k = 0; k < n; ++k) {
    const double z = 3.0 * k / (n - 1);
    std::vector<Vec2> p{{0, 0}};
    for (const double centre : {0.0, 3.0})
      for (const Vec2& x : crossSection(Ellipsoid{{1, 1, 1}}, {{}, {0, 0, centre}, 1}, z)) p.push_back(x);
    cross_sections.push_back(p);
  }
  const Wrap wrap(cross_sections, 0, 3);
  for (const double z : {0.0, 0.77, 1.5, 3.0})
    EXPECT_NEAR(ClosedCurve(wrap.crossSection(z)).length(), 2 * std::numbers::pi, 2e-4 * 2 * std::numbers::pi);
}

}  // namespace
}  // namespace gambeson
