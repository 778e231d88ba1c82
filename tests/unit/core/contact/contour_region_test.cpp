#include "core/contact/contour_region.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/contact/untangle.hpp"
#include "unit/core/contact/tangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace testing_shapes;

std::vector<Contour> contoursOf(const Tangled& s) { return traceContours(s.mesh, s.x, findCrossings(s.mesh, s.x)); }

/// The surface of the only contour that is on the given piece.
int sideOf(const Tangled& s, const Contour& c, int piece) {
  return s.pieceOfFace(c.segments[0].face[0]) == piece ? 0 : 1;
}

ContourRegion region(const Tangled& s, const Contour& c, int piece, int sign) {
  FloodWork work;
  work.label.resize(s.x.size());
  const ContourRegion r =
      floodRegion(s.mesh, s.x, CutSurface(s.mesh, std::array{ContourPath{&c, sideOf(s, c, piece)}}), 0, sign, work);
  for (auto l : work.label) EXPECT_EQ(l, 0) << "labels are cleaned";
  return r;
}

/// Area of a plane polygon.
double polygonArea(const std::vector<Vec3>& p) {
  Vec3 sum;
  for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p[i] - p[0], p[(i + 1) % p.size()] - p[0]);
  return 0.5 * norm(sum);
}

const Vec3 kAxis = normalized(Vec3{0.2, -0.3, 0.7});
Vec3 tilted(const Vec3& p) { return rotationAbout(kAxis, 0.4) * p + Vec3{0.1, 0.2, -0.3}; }

Piece unitSheet(int n, int m) {
  return sheet(n, m, [](double u, double v) {
    return tilted({u + 0.02 * std::sin(9 * v) * u * (1 - u), v + 0.03 * std::sin(7 * u) * v * (1 - v), 0});
  });
}

/// A strip through a wider sheet: on the strip both parts are rectangles, whatever its mesh.
TEST(ContourRegion, StripThroughPlane) {
  const double u0 = 0.2, u1 = 0.71, v0 = 0.31, slope = 0.8;
  const Piece strip = sheet(5, 11, [&](double u, double v) {
    const double w = v + 0.03 * std::sin(8 * u) * v * (1 - v);
    return tilted({u0 + (u1 - u0) * u, 0.4 + slope * (w - v0), 1.5 * (w - v0)});
  });
  const Tangled s = join({unitSheet(7, 6), strip});
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  const Contour& c = contours[0];
  EXPECT_FALSE(c.closed[sideOf(s, c, 0)]);
  const double height = std::hypot(slope, 1.5), lower = (u1 - u0) * v0 * height, upper = (u1 - u0) * (1 - v0) * height;
  const ContourRegion smaller = region(s, c, 1, 0);
  ASSERT_TRUE(smaller.found);
  EXPECT_NEAR(smaller.area_m2, lower, 1e-14);
  const ContourRegion other = region(s, c, 1, -smaller.sign);
  EXPECT_NEAR(other.area_m2, upper, 1e-14);
  EXPECT_EQ(region(s, c, 1, smaller.sign).vertices, smaller.vertices);
  // The vertices are those below the plane, and all others.
  std::vector<int> below, above;
  for (int v = 0; v < static_cast<int>(s.x.size()); ++v)
    if (s.piece[v] == 1)
      (transposeTimes(rotationAbout(kAxis, 0.4), s.x[v] - Vec3{0.1, 0.2, -0.3}).z < 0 ? below : above).push_back(v);
  EXPECT_EQ(smaller.vertices, below);
  EXPECT_EQ(other.vertices, above);
}

/// A prism through a sheet: its cross-section on the sheet, perimeter times length on the prism.
TEST(ContourRegion, PrismThroughPlane) {
  const int n = 7;
  const double r = 0.23;
  const Piece prism = mapped(tube({{r, -0.3}, {r, -0.11}, {r, 0.13}, {r, 0.5}}, n), [](const Vec3& p) {
    return tilted(p + Vec3{0.5, 0.47, 0});
  });
  const Tangled s = join({unitSheet(9, 8), prism});
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  const Contour& c = contours[0];
  EXPECT_TRUE(c.cyclic);
  const double section = 0.5 * n * r * r * std::sin(2 * M_PI / n), perimeter = 2 * n * r * std::sin(M_PI / n);
  const ContourRegion inside = region(s, c, 0, 0), end = region(s, c, 1, 0);
  ASSERT_TRUE(inside.found && end.found);
  EXPECT_NEAR(inside.area_m2, section, 1e-14);
  EXPECT_NEAR(region(s, c, 0, -inside.sign).area_m2, 1 - section, 1e-13);
  EXPECT_NEAR(end.area_m2, perimeter * 0.3, 1e-14);
  EXPECT_NEAR(region(s, c, 1, -end.sign).area_m2, perimeter * 0.5, 1e-14);
  EXPECT_EQ(end.vertices.size(), 2u * n);  // two rings below the sheet
}

/// Zheng 2013, fig. 4.3 (b), (c), (d): pyramids through one triangle, through an edge, and a ridge over three
/// triangles: sections that hold no vertex at all, or one, with several subchains in a triangle. The section of a
/// pyramid halfway up is the half base.
TEST(ContourRegion, SubchainsOfAllTypes) {
  const Piece ground{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {-1, 0.5, 0}, {0.5, -1, 0}, {-1, -1, 0}},
                     {{0, 1, 2}, {3, 2, 1}, {0, 2, 4}, {1, 0, 5}, {0, 4, 6}, {0, 6, 5}}};
  double ground_area = 0;
  for (const auto& [a, b, c] : ground.triangles) ground_area += polygonArea({ground.x[a], ground.x[b], ground.x[c]});
  const std::vector<std::array<double, 2>> star{
      {0.45, 0.45}, {-0.09, 0.3}, {-0.06, -0.09}, {0.24, -0.12}, {0.12, 0.09}};
  const std::vector<std::array<double, 2>> dart{{0.03, 0.54}, {0.6, 0.06}, {0.63, 0.3}, {0.54, 0.48}, {0.33, 0.63}};
  struct Case {
    std::vector<std::array<double, 2>> base;  // polygon about `centre`, twice the section
    Vec3 centre;
    std::size_t vertices;
  };
  const std::vector<std::array<double, 2>> small{{0.2, 0}, {0, 0.2}, {-0.2, 0.03}, {-0.02, -0.2}};
  for (const auto& [base, centre, inside] : {Case{small, {0.3, 0.3, 0}, 0},    // type III
                                             Case{small, {0.51, 0.52, 0}, 0},  // type II, on two triangles
                                             Case{small, {0.02, 0.03, 0}, 1},  // type I, around a vertex
                                             Case{star, {0.02, 0.02, 0}, 1}, Case{dart, {0.03, 0.03, 0}, 0}}) {
    Piece pyramid;
    std::vector<Vec3> section;
    for (const auto& [x, y] : base) {
      pyramid.x.push_back(centre + Vec3{2 * x, 2 * y, -0.2});
      section.push_back(centre + Vec3{x, y, 0});
    }
    const int n = static_cast<int>(base.size());
    pyramid.x.push_back(centre + Vec3{0, 0, 0.2});
    for (int i = 0; i < n; ++i) pyramid.triangles.push_back({i, (i + 1) % n, n});
    for (const bool first : {true, false}) {
      const Tangled s = first ? join({ground, pyramid}) : join({pyramid, ground});
      const auto contours = contoursOf(s);
      ASSERT_EQ(contours.size(), 1u);
      const Contour& c = contours[0];
      const ContourRegion r = region(s, c, first ? 0 : 1, 0);
      ASSERT_TRUE(r.found);
      EXPECT_NEAR(r.area_m2, polygonArea(section), 1e-15);
      EXPECT_EQ(r.vertices.size(), inside);
      EXPECT_NEAR(region(s, c, first ? 0 : 1, -r.sign).area_m2, ground_area - polygonArea(section), 1e-14);
    }
  }
}

/// The smaller part where the larger one has far more vertices and where it has fewer: area decides, not their number.
TEST(ContourRegion, AreaDecidesNotTheNumberOfVertices) {
  for (const double power : {0.3, 3.0}) {  // fine rows at one end or at the other
    const Piece strip = sheet(3, 30, [&](double u, double v) {
      return Vec3{0.3 + 0.4 * u, 0.5, std::pow(v, power) - 0.4};
    });
    const Tangled s = join({sheet(2, 2, [](double u, double v) { return Vec3{u, v, 0}; }), strip});
    const auto contours = contoursOf(s);
    ASSERT_EQ(contours.size(), 1u);
    const ContourRegion r = region(s, contours[0], 1, 0);
    ASSERT_TRUE(r.found);
    EXPECT_NEAR(r.area_m2, 0.4 * 0.4, 1e-14);
    EXPECT_EQ(r.vertices.size() > s.x.size() / 2, power > 1);
  }
}

/// A flat square of nu x nv cells, cut across by two upright sheets.
Tangled cutTwice(int nu, int nv) {
  const auto across = [](double at) {
    return sheet(9, 3, [=](double u, double v) { return Vec3{at + 0.1 * (v - 0.47), 1.4 * u - 0.2, v - 0.47}; });
  };
  return join({sheet(nu, nv, [](double u, double v) { return Vec3{u, v, 0}; }), across(0.23), across(0.71)});
}

std::array<ContourPath, 2> pathsOnSheet(const Tangled& s, const std::vector<Contour>& contours) {
  return {ContourPath{&contours[0], sideOf(s, contours[0], 0)}, ContourPath{&contours[1], sideOf(s, contours[1], 0)}};
}

/// Two cuts across a sheet: with both, what lies beside one ends at the other.
TEST(ContourRegion, TwoCutsBoundARegionTogether) {
  const Tangled s = cutTwice(11, 7);
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 2u);
  FloodWork work;
  work.label.resize(s.x.size());
  const std::array<ContourPath, 2> paths = pathsOnSheet(s, contours);
  for (const bool swap : {false, true}) {
    const CutSurface both(s.mesh, paths), one(s.mesh, std::span(paths).subspan(swap, 1));
    const double cut = paths[swap].contour->points[0].x.x, rest = std::min(cut, 1 - cut);
    std::array<double, 2> area{};
    for (const int sign : {-1, 1}) {
      const ContourRegion r = floodRegion(s.mesh, s.x, both, swap, sign, work);
      ASSERT_TRUE(r.found);
      area[sign > 0] = r.area_m2;
      const bool middle = std::abs(r.area_m2 - 0.48) < 1e-13;
      for (int v : r.vertices) EXPECT_EQ(s.x[v].x > 0.23 && s.x[v].x < 0.71, middle);
      ASSERT_EQ(r.beside.size(), middle ? 2u : 1u);
      for (const auto& [contour, side] : r.beside) {
        EXPECT_TRUE(middle || contour == swap);
        const ContourRegion same = floodRegion(s.mesh, s.x, both, contour, side, work);
        EXPECT_EQ(same.vertices, r.vertices);
        EXPECT_EQ(same.area_m2, r.area_m2);
      }
      const ContourRegion alone = floodRegion(s.mesh, s.x, one, 0, sign, work);
      EXPECT_NEAR(alone.area_m2, middle ? 1 - rest : rest, 1e-13);
    }
    EXPECT_NEAR(std::max(area[0], area[1]), 0.48, 1e-13);
    EXPECT_NEAR(std::min(area[0], area[1]), rest, 1e-13);
  }
}

/// The same where every triangle between them has both cuts: what lies between holds no vertex.
TEST(ContourRegion, TwoCutsInOneTriangle) {
  const Tangled s = cutTwice(1, 5);
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 2u);
  FloodWork work;
  work.label.resize(s.x.size());
  const std::array<ContourPath, 2> paths = pathsOnSheet(s, contours);
  for (const bool swap : {false, true}) {
    const ContourRegion r = floodRegion(s.mesh, s.x, CutSurface(s.mesh, paths), swap, 0, work);
    ASSERT_TRUE(r.found);
    EXPECT_NEAR(r.area_m2, 0.48, 1e-14);
    EXPECT_TRUE(r.vertices.empty());
  }
}

/// Crumpled sheets through each other, with exact touches and without: wherever a contour has two sides they make up
/// the whole piece, each vertex on one of them.
TEST(ContourRegion, TwoSidesMakeUpThePiece) {
  std::mt19937 random(9);
  int checked = 0, without_vertices = 0;
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Piece> pieces;
    for (int k = 0; k < 2; ++k)
      pieces.push_back(sheet(9, 8, [&](double u, double v) {
        const auto jitter = [&] { return static_cast<double>(random() % 1000) / 1000; };
        const Vec3 p{u + 0.05 * jitter(), v + 0.05 * jitter(), 0.15 * jitter()};
        const double levels = trial % 2 ? 40 : 1e6;
        return Vec3{std::round(p.x * levels), std::round(p.y * levels), std::round(p.z * levels)} / levels;
      }));
    const Tangled s = join(pieces);
    std::array<double, 2> total{};
    for (std::size_t f = 0; f < s.mesh.triangles.size(); ++f) {
      const auto& [a, b, c] = s.mesh.triangles[f];
      total[s.piece[a]] += polygonArea({s.x[a], s.x[b], s.x[c]});
    }
    FloodWork work;
    work.label.resize(s.x.size());
    for (const Contour& c : contoursOf(s))
      for (int side = 0; side < 2; ++side) {
        if (!c.closed[side]) continue;
        const CutSurface path(s.mesh, std::array{ContourPath{&c, side}});
        const auto plus = floodRegion(s.mesh, s.x, path, 0, 1, work),
                   minus = floodRegion(s.mesh, s.x, path, 0, -1, work);
        const auto smaller = floodRegion(s.mesh, s.x, path, 0, 0, work);
        ASSERT_EQ(plus.found, minus.found);
        if (!plus.found) continue;  // crosses itself
        ++checked;
        const int piece = s.pieceOfFace(c.segments[0].face[side]);
        EXPECT_NEAR(plus.area_m2 + minus.area_m2, total[piece], 1e-12);
        EXPECT_GT(plus.area_m2, -1e-14);
        EXPECT_GT(minus.area_m2, -1e-14);
        EXPECT_NEAR(smaller.area_m2, std::min(plus.area_m2, minus.area_m2), 1e-14);
        std::set<int> all(plus.vertices.begin(), plus.vertices.end());
        all.insert(minus.vertices.begin(), minus.vertices.end());
        EXPECT_EQ(all.size(), 90u);
        EXPECT_EQ(plus.vertices.size() + minus.vertices.size(), 90u);
        without_vertices += smaller.vertices.empty();
      }
    ASSERT_FALSE(HasFailure()) << trial;
  }
  EXPECT_GT(checked, 300);
  EXPECT_GT(without_vertices, 50);
}

Piece torus(int n, int k) {
  Piece p;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < k; ++j) {
      const double a = 2 * M_PI * (i + 0.3) / n, b = 2 * M_PI * j / k, r = 1 + 0.3 * std::cos(b);
      p.x.push_back({r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b)});
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < k; ++j) {
      const int a = i * k + j, b = (i + 1) % n * k + j, c = i * k + (j + 1) % k, d = (i + 1) % n * k + (j + 1) % k;
      p.triangles.insert(p.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  return p;
}

/// A cycle around a torus, and a cut across a band with half a twist, divide nothing.
TEST(ContourRegion, CurvesThatDivideNothing) {
  const Piece small = sheet(3, 3, [](double u, double v) { return Vec3{0.5 + u, 0.01 * u, v - 0.5}; });
  const Tangled s = join({torus(15, 8), small});
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_TRUE(contours[0].closed[0] && contours[0].closed[1]);
  EXPECT_FALSE(region(s, contours[0], 0, 0).found);
  EXPECT_FALSE(region(s, contours[0], 0, 1).found);
  EXPECT_TRUE(region(s, contours[0], 1, 0).found);
  const auto u = untangle(s.mesh, s.x);
  ASSERT_EQ(u.size(), 1u);
  const int on_torus = sideOf(s, contours[0], 0);
  EXPECT_FALSE(u[0].closed[on_torus]);
  EXPECT_TRUE(u[0].closed[1 - on_torus]);
  EXPECT_GT(u[0].speed_mps, 0);

  Piece band;
  const int n = 24;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 4; ++j) {
      const double a = 2 * M_PI * (i + 0.5) / n, w = 0.1 * (j - 1.5), r = 1 + w * std::cos(a / 2);
      band.x.push_back({r * std::cos(a), r * std::sin(a), w * std::sin(a / 2)});
    }
  const auto at = [&](int i, int j) { return i < n ? 4 * i + j : 3 - j; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 3; ++j)
      band.triangles.insert(band.triangles.end(),
                            {{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
  const Tangled m = join({band, small});
  const auto cut = contoursOf(m);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_TRUE(cut[0].closed[sideOf(m, cut[0], 0)]);
  EXPECT_FALSE(region(m, cut[0], 0, 0).found);
}

}  // namespace
}  // namespace gambeson
