// Seams: the map T (Zheng 2013, eq. 2.35), corners, refusals, rotational springs.
#include "core/cloth/draft/seams.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

void expectValid(const Garment& g, const FreeMap& map) {
  const std::vector<Vec3> q = restPoints(g);
  ASSERT_EQ(map.T.rows(), static_cast<int>(q.size()));
  ASSERT_EQ(map.T.column_count, static_cast<int>(map.home.size()));
  for (int r = 0; r < map.T.rows(); ++r) {
    double sum = 0;
    for (int k = map.T.offsets[r]; k < map.T.offsets[r + 1]; ++k) sum += map.T.values[k];
    EXPECT_NEAR(sum, 1, 1e-14) << "row " << r;
  }
  for (int i = 0; i < map.T.column_count; ++i) {  // a free point is the control point that it is
    const int r = map.home[i];
    ASSERT_EQ(map.T.offsets[r + 1] - map.T.offsets[r], 1);
    EXPECT_EQ(map.T.columns[map.T.offsets[r]], i);
  }
  std::vector<Vec3> p;
  for (int i : map.home) p.push_back(q[i]);
  const std::vector<Vec3> back = controlsOf(map, p);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_LT(norm(back[i] - q[i]), 1e-12);
}

Vec2 edgePoint(const NurbsPatch& s, const PatchEdge& e, double t) {
  const double f = e.reversed ? 1 - t : t;
  const double u = s.u.front() + f * (s.u.back() - s.u.front()), v = s.v.front() + f * (s.v.back() - s.v.front());
  switch (e.side) {
    case Side::u0:
      return {s.u.front(), v};
    case Side::u1:
      return {s.u.back(), v};
    case Side::v0:
      return {u, s.v.front()};
    default:
      return {u, s.v.back()};
  }
}

/// The largest gap and the largest sine of the angle between the normals along a seam, in the state q.
std::array<double, 2> seamError(const Garment& g, const Seam& seam, const std::vector<Vec3>& q, double from = 0,
                                double to = 1) {
  const auto offsets = controlOffsets(g);
  double gap = 0, sine = 0;
  for (int k = 0; k <= 20; ++k) {
    std::array<Vec3, 2> x, n;
    for (int side : {0, 1}) {
      const PatchEdge& e = side == 0 ? seam.a : seam.b;
      NurbsPatch s = g.patches[e.patch];
      s.points.assign(q.begin() + offsets[e.patch], q.begin() + offsets[e.patch + 1]);
      const Vec2 uv = edgePoint(s, e, from + (to - from) * k / 20);
      const auto d = surfaceDerivatives(s, uv.x, uv.y);
      x[side] = d[0];
      n[side] = normalized(cross(d[1], d[2]));
    }
    gap = std::max(gap, norm(x[0] - x[1]));
    sine = std::max(sine, norm(cross(n[0], n[1])));
  }
  return {gap, sine};
}

class SeamDegrees : public testing::TestWithParam<std::tuple<int, bool>> {};
INSTANTIATE_TEST_SUITE_P(Degrees, SeamDegrees, testing::Combine(testing::Values(2, 3), testing::Bool()));

/// Four patches cut from one surface: the seams cross at a corner that is G1 in every state.
TEST_P(SeamDegrees, FourPatchesStaySmoothInEveryState) {
  const auto [p, rational] = GetParam();
  const Garment g = fourPatches(p, p, rational, SeamKind::G1, 0, plainFabric());
  const FreeMap map = buildFreeMap(g);
  expectValid(g, map);
  const std::vector<Vec3> q = controlsOf(map, deformedFree(g, map, 0.05));
  for (const Seam& seam : g.seams) {
    const auto [gap, sine] = seamError(g, seam, q);
    EXPECT_LT(gap, 1e-13);
    EXPECT_LT(sine, 1e-11);
  }
  const int nu = curvedPatch(p, p, false).u.count(), nv = curvedPatch(p, p, false).v.count();
  if (p == 2) {
    EXPECT_EQ(map.T.column_count, nu * nv);
  }  // a cut at a simple knot of degree 2 adds nothing
}

TEST_P(SeamDegrees, C0SeamsJoinPositionsOnly) {
  const auto [p, rational] = GetParam();
  const Garment g = fourPatches(p, p, rational, SeamKind::C0, 1, plainFabric());
  const FreeMap map = buildFreeMap(g);
  expectValid(g, map);
  const std::vector<Vec3> q = controlsOf(map, deformedFree(g, map, 0.05));
  for (const Seam& seam : g.seams) {
    const auto [gap, sine] = seamError(g, seam, q);
    EXPECT_LT(gap, 1e-13);
    EXPECT_GT(sine, 1e-3);
  }
}

/// Where 4 patches meet inside everything is G1; where 3 or 5 meet the corner point is free and the rest still G1.
TEST(Seams, CornersOfThreeFourAndFivePatches) {
  for (int n : {3, 4, 5}) {
    const Garment g = star(n, SeamKind::G1, plainFabric());
    const FreeMap map = buildFreeMap(g);
    expectValid(g, map);
    const bool corner_free = std::find(map.home.begin(), map.home.end(), 0) != map.home.end();
    EXPECT_EQ(corner_free, n != 4) << n;
    // 6 x 6 points a patch; each seam takes away both copies of its edge, but for the corner where it is free.
    EXPECT_EQ(map.T.column_count, n * 25 + (n == 4 ? 0 : 1)) << n;
    const std::vector<Vec3> q = controlsOf(map, deformedFree(g, map, 0.01));
    for (const Seam& seam : g.seams) {
      const auto [gap, sine] = seamError(g, seam, q);
      EXPECT_LT(gap, 1e-13);
      if (n == 4) {
        EXPECT_LT(sine, 1e-11);
      }
      // The corner point reaches over the first cell of a seam (degree 2: one quarter).
      EXPECT_LT(seamError(g, seam, q, 0.2501, 1)[1], 1e-11);
    }
  }
}

/// Four patches that meet on the border, as half of eight around a point: the corner point is free as well.
TEST(Seams, FourPatchesOnTheBorder) {
  Garment g = star(8, SeamKind::G1, plainFabric());
  g.patches.resize(4);
  g.weft.resize(4);
  g.seams.resize(3);
  const FreeMap map = buildFreeMap(g);
  expectValid(g, map);
  EXPECT_EQ(map.home[0], 0);
  EXPECT_EQ(map.T.column_count, 4 * 36 - 3 * (6 + 5));  // a seam joins 6 pairs and holds 5 of them by T
}

TEST(Seams, ClosedTubes) {
  const Garment two =
      garmentOf({halfTube(0), halfTube(kPi)}, {{{0, Side::u1}, {1, Side::u0}}, {{1, Side::u1}, {0, Side::u0}}},
                plainFabric(), {0, 0, 1});
  const FreeMap map2 = buildFreeMap(two);
  expectValid(two, map2);
  EXPECT_EQ(map2.T.column_count, 2 * 6 * 5);
  // One patch around: the surface of both halves with a seam on itself.
  NurbsPatch whole = two.patches[0];
  whole.u.knots = {0, 0, 0};
  for (int k = 1; k < 12; ++k) whole.u.knots.insert(whole.u.knots.end(), k == 6 ? 2 : 1, k / 12.0);
  whole.u.knots.insert(whole.u.knots.end(), 3, 1);
  whole.points.clear();
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 15; ++i)
      whole.points.push_back(i < 8 ? two.patches[0].points[i + 8 * j] : two.patches[1].points[i - 7 + 8 * j]);
  whole.weights.assign(whole.points.size(), 1);
  const Garment one = garmentOf({whole}, {{{0, Side::u1}, {0, Side::u0}}}, plainFabric(), {0, 0, 1});
  const FreeMap map1 = buildFreeMap(one);
  expectValid(one, map1);
  EXPECT_EQ(map1.T.column_count, 13 * 5);
  const auto [gap, sine] = seamError(one, one.seams[0], controlsOf(map1, deformedFree(one, map1, 0.05)));
  EXPECT_LT(gap, 1e-13);
  EXPECT_LT(sine, 1e-11);
}

/// The same two pieces whichever sides meet and whichever way they run.
TEST(Seams, AnySideMeetsAnySide) {
  const auto [a, b] = cutU(curvedPatch(2, 2, true), 0.3);
  const std::vector<Vec3> rest = [&] { return restPoints(garmentOf({a, b}, {}, plainFabric())); }();
  const auto turned = [](const NurbsPatch& s) {
    return transposed(flippedU(transposed(flippedU(s))));
  };  // both parameters reversed
  struct Way {
    NurbsPatch a, b;
    PatchEdge ea, eb;
  };
  const std::vector<Way> ways{{a, b, {0, Side::u1}, {1, Side::u0}},
                              {transposed(a), b, {0, Side::v1}, {1, Side::u0}},
                              {a, flippedU(b), {0, Side::u1}, {1, Side::u1}},
                              {a, turned(b), {0, Side::u1}, {1, Side::u1, true}},
                              {turned(a), b, {0, Side::u0, true}, {1, Side::u0}},
                              {turned(a), turned(b), {0, Side::u0, true}, {1, Side::u1, true}},
                              {turned(a), turned(b), {0, Side::u0}, {1, Side::u1}},
                              {transposed(turned(a)), transposed(b), {0, Side::v0, true}, {1, Side::v0}}};
  for (std::size_t w = 0; w < ways.size(); ++w)
    for (SeamKind kind : {SeamKind::G1, SeamKind::C0}) {
      const Garment g = garmentOf({ways[w].a, ways[w].b}, {{ways[w].ea, ways[w].eb, kind, 2.5}}, plainFabric());
      const FreeMap map = buildFreeMap(g);
      expectValid(g, map);
      EXPECT_EQ(map.T.column_count, static_cast<int>(rest.size()) - (kind == SeamKind::G1 ? 2 : 1) * a.v.count()) << w;
      double length = 0;
      for (const HingePoint& h : buildHinges(g)) {
        length += h.stiffness_length / 2.5;
        EXPECT_NEAR(h.theta0, 0, 1e-7) << "smooth at rest, way " << w;
      }
      double chord = 0;  // the seam's length, from a fine polygon
      for (int k = 0; k < 400; ++k) {
        const auto at = [&](int i) { return surfaceDerivatives(a, 0.3, i / 400.0)[0]; };
        chord += norm(at(k + 1) - at(k));
      }
      EXPECT_NEAR(length, chord, 2e-3 * chord) << w;
    }
}

NurbsPatch square(double x0, double x1, double slope = 0, double skew = 0) {
  return patchOf(uniformKnots(2, 3), uniformKnots(2, 3), [&](double a, double b) {
    return Vec3{x0 + (x1 - x0) * a * (1 + skew * b * (1 - b)), b, slope * (x1 - x0) * a};
  });
}

/// A roof of known angle: 0 where flat, the angle of the fold where not, with a sign; flattened it stores 1/2 k theta^2
/// L.
TEST(Seams, HingeAngleIsTheFold) {
  const double fold = 0.7;
  const std::vector<Vec3> flat = restPoints(garmentOf({square(0, 1), square(1, 2)}, {}, plainFabric()));
  double angle[2];
  for (int up : {0, 1}) {
    const NurbsPatch wing = square(1, 2, (up ? 1 : -1) * std::tan(fold));
    const Garment g = garmentOf({square(0, 1), wing}, {{{0, Side::u1}, {1, Side::u0}, SeamKind::C0, 3}}, plainFabric());
    angle[up] = buildHinges(g)[0].theta0;
    for (const HingePoint& h : buildHinges(g)) EXPECT_NEAR(std::abs(h.theta0), fold, 1e-12);
    double energy;
    forceOn(Shell(g, widestKernels()), flat, &energy, {false, false, true, false});
    EXPECT_NEAR(energy, 0.5 * 3 * fold * fold * 1.0, 1e-12);
  }
  EXPECT_LT(angle[0] * angle[1], 0);
}

std::string refusal(const Garment& g) {
  try {
    buildFreeMap(g);
  } catch (const InputError& e) {
    return e.where().key + ": " + e.reason();
  }
  return "accepted";
}

TEST(Seams, WrongSeamsAreRefusedByName) {
  const Seam good{{0, Side::u1}, {1, Side::u0}};
  const auto with = [&](NurbsPatch b, Seam seam, std::vector<Seam> before = {}) {
    before.push_back(seam);
    return refusal(garmentOf({square(0, 1), std::move(b)}, before, plainFabric()));
  };
  EXPECT_EQ(with(square(1, 2), good), "accepted");
  EXPECT_EQ(with(square(1, 3), good), "accepted");  // a constant ratio of 2
  const auto names = [](const std::string& message, const std::string& reason, int seam = 0) {
    EXPECT_EQ(message.rfind("seams[" + std::to_string(seam) + "]: ", 0), 0u) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
  };
  names(with(square(1, 2, 0.5), good), "crease");
  EXPECT_EQ(with(square(1, 2, 0.5), {good.a, good.b, SeamKind::C0}), "accepted");
  names(with(square(1, 2, 0, 0.5), good), "ratio");
  NurbsPatch other = square(1, 2);
  other.v.knots[3] = 0.3;
  names(with(other, good), "knots along the edge differ");
  names(with(patchOf(uniformKnots(2, 3), uniformKnots(2, 4),
                     [](double a, double b) {
                       return Vec3{1 + a, b, 0};
                     }),
             good),
        "numbers of knots");
  names(with(patchOf(uniformKnots(2, 3), uniformKnots(3, 3),
                     [](double a, double b) {
                       return Vec3{1 + a, b, 0};
                     }),
             good),
        "degrees along");
  names(with(patchOf(uniformKnots(3, 3), uniformKnots(2, 3),
                     [](double a, double b) {
                       return Vec3{1 + a, b, 0};
                     }),
             good),
        "degrees across");
  names(with(square(1.01, 2), good), "do not meet");
  names(with(square(1, 2), {good.a, {1, Side::u0, true}}), "do not meet");
  names(with(square(1, 2), {good.a, {2, Side::u0}}), "does not exist");
  names(with(square(1, 2), {good.a, {-1, Side::u0}}), "does not exist");
  names(with(square(1, 2), {good.a, good.b, SeamKind::C0, -1}), "stiffness");
  names(with(square(1, 2), {good.a, good.b, SeamKind::C0, NAN}), "stiffness");
  other = square(1, 2);
  for (double& w : other.weights) w = 2;
  names(with(other, good), "weights");
  other = square(1, 2);
  other.u.knots = {-0.2, -0.1, 0, 1.0 / 3, 2.0 / 3, 1, 1.1, 1.2};
  names(with(other, good), "clamped");
  names(with(square(1, 2, 0.5), good, {{good.a, good.b, SeamKind::C0}}), "crease", 1);
}

}  // namespace
}  // namespace gambeson
