#include "core/contact/untangle.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "core/contact/contour_region.hpp"
#include "core/error.hpp"
#include "unit/core/contact/tangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace testing_shapes;

Contour only(const Tangled& s, std::span<const Vec3> x) {
  auto contours = traceContours(s.mesh, x, findCrossings(s.mesh, x));
  EXPECT_EQ(contours.size(), 1u);
  return contours.at(0);
}

double length(const Contour& c) {
  double sum = 0;
  for (std::size_t i = 0; i < c.segments.size(); ++i)
    sum += norm(c.points[c.next(static_cast<int>(i))].x - c.points[i].x);
  return sum;
}

double areaPlus(const Tangled& s, std::span<const Vec3> x, const Contour& c, int surface) {
  FloodWork work;
  work.label.resize(x.size());
  const ContourRegion r = floodRegion(s.mesh, x, CutSurface(s.mesh, std::array{ContourPath{&c, surface}}), 0, 1, work);
  EXPECT_TRUE(r.found);
  return r.area_m2;
}

/// f(x) under translations of surface 1 of the contour.
template <class F>
Vec3 differences(const Tangled& s, const Contour& c, F&& f) {
  constexpr double h = 1e-6;
  const int moving = s.pieceOfFace(c.segments[0].face[1]);
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    Vec3 d;
    d[k] = h;
    g[k] = (f(s.moved(moving, d)) - f(s.moved(moving, -d))) / (2 * h);
  }
  return g;
}

Piece wavySheet() {
  return sheet(9, 8, [](double u, double v) { return Vec3{u, v, 0.05 * std::sin(5 * u + 3 * v)}; });
}
Piece wavyTube() {
  return mapped(tube({{0.25, -0.4}, {0.3, -0.13}, {0.28, 0.07}, {0.22, 0.5}}, 11), [](const Vec3& p) {
    return Vec3{p.x + 0.5 + 0.3 * p.z, p.y + 0.48 + 0.05 * std::sin(9 * p.x), p.z + 0.1 * p.x};
  });
}
Piece wavyStrip(double u0, double u1) {
  return sheet(7, 6, [=](double u, double v) {
    return Vec3{u0 + (u1 - u0) * u, 0.5 + 0.08 * std::sin(6 * u) + 0.2 * v, v - 0.45 + 0.03 * u};
  });
}

/// Every kind of contour, each surface once as 0 and once as 1.
std::vector<Tangled> scenes() {
  const Piece spike = mapped(tube({{0.05, -0.04}, {0, 0.05}}, 5), [](const Vec3& p) {
    return Vec3{p.x + 0.49, p.y + 0.53, p.z - 0.02};  // inside two triangles
  });
  std::vector<Tangled> all;
  for (const Piece& other : {wavyTube(), wavyStrip(0.2, 0.7), wavyStrip(0.3, 1.2), spike}) {
    all.push_back(join({wavySheet(), other}));
    all.push_back(join({other, wavySheet()}));
  }
  const Piece tip = mapped(tube({{0.04, -0.02}, {0, 0.03}}, 5), [](const Vec3& p) {
    return Vec3{p.x + 0.407, p.y + 0.292, p.z + 0.05 * std::sin(5 * 0.407 + 3 * 0.292)};  // inside one
  });
  all.push_back(join({wavySheet(), tip}));
  return all;
}

TEST(Untangle, LengthGradientByDifferences) {
  for (const Tangled& s : scenes()) {
    const Contour c = only(s, s.x);
    const Vec3 g = lengthGradient(s.mesh, s.x, c);
    const Vec3 d = differences(s, c, [&](const std::vector<Vec3>& y) { return length(only(s, y)); });
    EXPECT_LT(norm(g - d), 1e-7 * norm(g)) << norm(g);
  }
}

TEST(Untangle, AreaGradientByDifferences) {
  int checked = 0;
  for (const Tangled& s : scenes()) {
    const Contour c = only(s, s.x);
    for (int surface = 0; surface < 2; ++surface) {
      if (!c.closed[surface]) continue;
      ++checked;
      const Vec3 g = areaGradient(s.mesh, s.x, c, surface);
      const Vec3 d = differences(s, c, [&](const std::vector<Vec3>& y) {
        const Contour moved = only(s, y);
        const double a = areaPlus(s, y, moved, surface);
        return a;
      });
      EXPECT_LT(norm(g - d), 1e-7 * norm(g)) << surface << " " << norm(g);
    }
  }
  EXPECT_EQ(checked, 12);
}

/// M = a (x) b applied to the transpose: M^T r = b (a.r).
struct Motion {
  double identity;  ///< J = identity I + a (x) n / (a.n) * sign
  Vec3 a, n;
  double sign;
  Vec3 transposed(const Vec3& r) const { return identity * r + (sign * dot(a, r) / dot(a, n)) * n; }
};

/// dx_P/dd, eq. 4.1 for edges of element II and a' (x) n' / (a'.n') for those of element I, by the same derivation.
Motion motion(const Tangled& s, const ContourPoint& p) {
  const auto& [v, w] = s.mesh.edges[p.edge];
  const auto& [i, j, k] = s.mesh.triangles[p.triangle];
  const Vec3 n = normalized(cross(s.x[j] - s.x[i], s.x[k] - s.x[i]));
  return p.owner == 0 ? Motion{0, s.x[w] - s.x[v], n, 1} : Motion{1, s.x[w] - s.x[v], n, -1};
}

/// Eq. 4.12 and 4.13 as they are written, with a reference point O for each subchain by its type and the product rule
/// (4.14 to 4.18, both edge cases): the same as the closed form, to rounding.
TEST(Untangle, AreaGradientIsTheThesissSumOverSubchains) {
  int types = 0;
  for (const Tangled& s : scenes()) {
    const Contour c = only(s, s.x);
    for (int surface = 0; surface < 2; ++surface) {
      if (!c.closed[surface]) continue;
      Vec3 sum;
      for (const Subchain& part : subchains(c, surface)) {
        types |= 1 << part.type;
        const auto& corner = s.mesh.triangles[part.face];
        const int last = (part.first_segment + part.segments) % static_cast<int>(c.points.size());
        Vec3 o = s.x[corner[0]];
        if (part.type == Subchain::kOneEdge) o = s.x[s.mesh.edges[c.points[last].edge][0]];
        if (part.type == Subchain::kTwoEdges)
          for (int v : s.mesh.edges[c.points[last].edge])
            for (int w : s.mesh.edges[c.points[part.first_segment].edge])
              if (v == w) o = s.x[v];
        for (int q = 0, i = part.first_segment; q < part.segments; ++q, i = c.next(i)) {
          const ContourPoint &p0 = c.points[i], &p1 = c.points[c.next(i)];
          const Vec3 n = c.segments[i].normal[surface] *
                         normalized(cross(s.x[corner[1]] - s.x[corner[0]], s.x[corner[2]] - s.x[corner[0]]));
          // 1/2 n . (OP x P0P1), with OP moving by J0 on surface 0 and by J0 - I on surface 1
          const Motion j0 = motion(s, p0), j1 = motion(s, p1);
          const Vec3 by_start = cross(p1.x - p0.x, n), by_step = cross(n, p0.x - o);
          sum += 0.5 * (j0.transposed(by_start) - static_cast<double>(surface) * by_start + j1.transposed(by_step) -
                        j0.transposed(by_step));
        }
      }
      const Vec3 g = areaGradient(s.mesh, s.x, c, surface);
      EXPECT_LT(norm(sum - g), 1e-11 * norm(g));
    }
  }
  EXPECT_EQ(types, 1 << Subchain::kTwoEdges | 1 << Subchain::kOneEdge | 1 << Subchain::kNoEdge);
}

/// An upright strip through a level sheet that is wider: C = width and C' = 0; on the strip A = width * depth, so
/// moving it up by d frees width * d: G = 1 along z. By length alone nothing would move.
TEST(Untangle, StripThroughPlane) {
  const Piece strip = sheet(5, 9, [](double u, double v) { return Vec3{0.21 + 0.5 * u, 0.53, v - 0.31}; });
  const Tangled s = join({sheet(6, 7, [](double u, double v) { return Vec3{u, v, 0}; }), strip});
  const auto found = untangle(s.mesh, s.x, {}, {}, {0.7, 3});
  ASSERT_EQ(found.size(), 1u);
  const Untangling& u = found[0];
  EXPECT_NEAR(u.length_m, 0.5, 1e-15);
  EXPECT_TRUE(u.closed[1]);
  EXPECT_FALSE(u.closed[0]);
  EXPECT_NEAR(u.wrong_area_m2[1], 0.5 * 0.31, 1e-15);
  EXPECT_NEAR(norm(u.G - Vec3{0, 0, 1}), 0, 1e-13);
  EXPECT_NEAR(norm(u.direction - Vec3{0, 0, 1}), 0, 1e-13);
  EXPECT_NEAR(u.speed_mps, 0.7 / std::sqrt(10.0), 1e-13);  // h0 |G| / sqrt(|G|^2 + g0^2)
  EXPECT_NEAR(norm(u.G_side[0]), 0, 1e-13);
  const auto by_length = untangle(s.mesh, s.x, {}, {}, {0.5, 1, UntangleBy::kLength});
  EXPECT_NEAR(norm(by_length[0].G), 0, 1e-13);
}

/// Open on both: G = -2 dC/dd (eq. 4.19') on both sides, by differences. Of the two sides' gradients the longer is
/// taken (eq. 4.20).
TEST(Untangle, OpenContoursShrink) {
  int open = 0, mixed = 0;
  for (const Tangled& s : scenes()) {
    const auto found = untangle(s.mesh, s.x);
    ASSERT_EQ(found.size(), 1u);
    const Untangling& u = found[0];
    const Vec3 d = -2 * differences(s, u.contour, [&](const std::vector<Vec3>& y) { return length(only(s, y)); });
    open += !u.closed[0] && !u.closed[1];
    mixed += u.closed[0] != u.closed[1];
    for (int side = 0; side < 2; ++side) {
      if (!u.closed[side]) {
        EXPECT_LT(norm(u.G_side[side] - d), 1e-7 * norm(d));
      }
      EXPECT_GE(norm(u.G), norm(u.G_side[side]));
    }
    EXPECT_TRUE(u.G == u.G_side[0] || u.G == u.G_side[1]);
  }
  EXPECT_EQ(open, 2);
  EXPECT_EQ(mixed, 2);
}

/// A contour that starts at the vertex of both its triangles. Taken apart, the triangles move by d against each other
/// and the start by half of it: the gradient of the distance along the line of the two planes.
TEST(Untangle, LengthGradientAtASharedVertex) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, -0.5, 0.1}, {1, 0.5, 0}, {0.6, 0.1, 0.5}, {0.6, 0.05, -0.5}};
  const Tangled fan = join({Piece{x, {{0, 1, 2}, {0, 3, 4}}}});
  const Contour c = only(fan, fan.x);
  ASSERT_EQ(c.points.size(), 2u);
  const int end = c.points[0].vertex == 0 ? 1 : 0;
  const Vec3 r = normalized(c.points[end].x);
  const int moving = c.segments[0].face[1];  // triangle 0 or 1
  Vec3 d;
  constexpr double h = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const auto distance = [&](double by) {
      Vec3 shift;
      shift[k] = by;
      const auto at = [&](int v, int triangle) { return triangle == moving ? x[v] + shift : x[v]; };
      // The edge 3-4 of triangle 1 through the plane of triangle 0.
      const Vec3 n = cross(at(1, 0) - at(0, 0), at(2, 0) - at(0, 0)), p = at(3, 1), q = at(4, 1);
      const double t = dot(n, at(0, 0) - p) / dot(n, q - p);
      return dot(r, p + t * (q - p) - 0.5 * shift);
    };
    d[k] = (distance(h) - distance(-h)) / (2 * h);
  }
  EXPECT_LT(norm(lengthGradient(fan.mesh, fan.x, c) - d), 1e-8);
}

/// Zheng 2013, fig. 4.5 and 4.6, acceptance C3: a waisted sleeve stuck at its neck. The length is stationary there, the
/// area on the sleeve's side is not: it pulls the sleeve back by its axis, |G| = 1.
TEST(Untangle, WaistedSleeveAtItsNeck) {
  const int n = 24;
  const Piece flat = sheet(9, 9, [](double u, double v) { return Vec3{0.2 * u - 0.1003, 0.2 * v - 0.0991, 0.0001}; });
  const Tangled s = join({flat, waistedSleeve(n)});
  const auto found = untangle(s.mesh, s.x);
  ASSERT_EQ(found.size(), 1u);
  const Untangling& u = found[0];
  EXPECT_TRUE(u.closed[0] && u.closed[1]);
  const double r = 0.020;
  EXPECT_NEAR(u.length_m, 2 * n * r * std::sin(M_PI / n), 1e-15);
  EXPECT_LT(norm(lengthGradient(s.mesh, s.x, u.contour)), 1e-13);
  EXPECT_NEAR(u.wrong_area_m2[0], 0.5 * n * r * r * std::sin(2 * M_PI / n), 1e-15);
  EXPECT_LT(norm(u.G_side[0]), 1e-13);
  EXPECT_LT(norm(u.G_side[1] - Vec3{0, 0, -1}), 1e-12);
  EXPECT_EQ(u.G, u.G_side[1]);
  const auto by_length = untangle(s.mesh, s.x, {}, {}, {0.5, 1, UntangleBy::kLength});
  EXPECT_LT(norm(by_length[0].G), 1e-13);
  // The neck is a minimum of the length: pulled either way, the contour minimisation would bring it back.
  for (const double z : {-0.01, 0.01}) {
    const auto moved = untangle(s.mesh, s.moved(1, {0, 0, z}), {}, {}, {0.5, 1, UntangleBy::kLength});
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_LT(moved[0].G.z * z, 0);
    EXPECT_LT(untangle(s.mesh, s.moved(1, {0, 0, z}))[0].G.z, -0.5);
  }
}

/// Follows -G from many starts: a step along G shortens the wrong area (of the side whose G is used), and in the end
/// the sheets are free. Quasi-static, all of one piece moved by the same step.
TEST(Untangle, FollowingGFrees) {
  const Piece flat = sheet(9, 9, [](double u, double v) { return Vec3{0.2 * u - 0.1003, 0.2 * v - 0.0991, 0.0001}; });
  const Piece strip = sheet(4, 5, [](double u, double v) { return Vec3{0.08 * u - 0.03, 0.02 * v, 0.1 * v - 0.041}; });
  const Piece corner = sheet(4, 5, [](double u, double v) { return Vec3{0.1 * u + 0.05, 0.02 * v, 0.1 * v - 0.041}; });
  for (const Piece& other : {waistedSleeve(16), strip, corner}) {
    const Tangled s = join({flat, other});
    std::vector<Vec3> x = s.x;
    int steps = 0;
    for (; steps < 400; ++steps) {
      const auto found = untangle(s.mesh, x);
      if (found.empty()) break;
      ASSERT_EQ(found.size(), 1u);
      const int moving = s.pieceOfFace(found[0].contour.segments[0].face[1]);
      ASSERT_GT(found[0].speed_mps, 0);
      for (std::size_t v = 0; v < x.size(); ++v)
        if (s.piece[v] == moving) x[v] += 0.5e-3 * found[0].direction;
    }
    EXPECT_LT(steps, 400) << "0.2 m";
    EXPECT_GT(steps, 50);
  }
}

/// Between garments their order decides, not the size: a tube that is to stay outside a sheet, and inside it.
TEST(Untangle, GarmentOrderDecides) {
  const Piece flat = sheet(6, 7, [](double u, double v) { return Vec3{u, v, 0}; });  // normal +z
  const Piece strip = sheet(5, 9, [](double u, double v) { return Vec3{0.21 + 0.5 * u, 0.53, v - 0.31}; });  // -y
  for (const bool swap : {false, true}) {
    const Tangled s = swap ? join({strip, flat}) : join({flat, strip});
    const int strip_piece = swap ? 0 : 1;
    for (const int strip_number : {0, 2}) {
      std::vector<int> garment(s.x.size());
      for (std::size_t v = 0; v < garment.size(); ++v) garment[v] = s.piece[v] == strip_piece ? strip_number : 1;
      const auto found = untangle(s.mesh, s.x, garment);
      ASSERT_EQ(found.size(), 1u);
      const Untangling& u = found[0];
      const int side = s.pieceOfFace(u.contour.segments[0].face[0]) == strip_piece ? 0 : 1;
      // Higher than the sheet, the strip's part behind it (z < 0) is wrong; lower, the part in front of it.
      EXPECT_NEAR(u.wrong_area_m2[side], 0.5 * (strip_number == 2 ? 0.31 : 0.69), 1e-14);
      for (int v : u.wrong_vertices[side]) EXPECT_EQ(s.x[v].z < 0, strip_number == 2);
      // Surface 1 against surface 0: the strip goes up where it is the higher garment.
      EXPECT_NEAR(u.direction.z, (side == 1 ? 1 : -1) * (strip_number == 2 ? 1 : -1), 1e-13);
    }
  }
}

/// Two tubes, the inner shifted sideways through the outer: two straight cuts along them, none of which divides a tube
/// alone, together bound the lens of the inner one that is outside. Numbers or not, G pushes it in.
TEST(Untangle, ShiftedNestedTubes) {
  const int n = 24;
  const double r = 0.100, R = 0.103, shift = 0.008, length = 0.28;
  const Piece inner = mapped(tube({{r, 0.01}, {r, 0.1}, {r, 0.2}, {r, 0.01 + length}}, n), [=](const Vec3& p) {
    return p + Vec3{shift, 0, 0};
  });
  const Piece outer = tube({{R, 0}, {R, 0.13}, {R, 0.3}}, n);
  const Tangled s = join({inner, outer});
  // By hand: the arc of the inner polygon outside the outer one, between the two points where they meet.
  double arc = 0;
  const auto at = [&](double radius, int i, double dx) {
    const double a = 0.1 + 2 * M_PI * i / n;
    return Vec3{radius * std::cos(a) + dx, radius * std::sin(a), 0};
  };
  const double apothem = R * std::cos(M_PI / n);
  constexpr int kParts = 4000;
  for (int i = 0; i < n; ++i) {
    const Vec3 p = at(r, i, shift), q = at(r, i + 1, shift);
    for (int k = 0; k < kParts; ++k) {
      const Vec3 m = p + ((k + 0.5) / kParts) * (q - p);
      double out = -1;  // beyond one of the outer polygon's sides
      for (int j = 0; j < n; ++j) {
        const double b = 0.1 + 2 * M_PI * (j + 0.5) / n;
        out = std::max(out, m.x * std::cos(b) + m.y * std::sin(b) - apothem);
      }
      if (out > 0) arc += norm(q - p) / kParts;
    }
  }
  for (const bool numbered : {true, false}) {
    const auto found = untangle(s.mesh, s.x, numbered ? std::span<const int>(s.piece) : std::span<const int>{});
    ASSERT_EQ(found.size(), 2u);
    Vec3 push;
    for (const auto& u : found) {
      const int on_inner = s.pieceOfFace(u.contour.segments[0].face[0]) == 0 ? 0 : 1;
      EXPECT_TRUE(u.closed[on_inner]);
      EXPECT_NEAR(u.length_m, length, 1e-12);
      EXPECT_NEAR(u.wrong_area_m2[on_inner], arc * length, 1e-3 * arc * length);
      EXPECT_EQ(u.wrong_vertices[on_inner], found[0].wrong_vertices[on_inner]);
      for (int v : u.wrong_vertices[on_inner]) EXPECT_GT(std::hypot(s.x[v].x, s.x[v].y), apothem);
      // Moving the outer tube by d is moving the inner by -d.
      push += (on_inner == 1 ? 1 : -1) * u.direction;
      EXPECT_GT(norm(u.G), 1);
    }
    EXPECT_LT(push.x, -0.5);
  }
}

/// A ribbon that widens along the loop x = t^3 - t, z = t^2 and passes through itself at t = -1 and 1, at a right
/// angle: closed on the narrow pass, whose end t < -1 is the smaller part and is pulled back along the ribbon, (1, 0,
/// -1)/sqrt(2).
TEST(Untangle, RibbonThroughItself) {
  const auto at = [](double u) { return -1.3 + 2.6 * u; };
  const Tangled s = join({sheet(61, 4, [&](double u, double v) {
    const double t = at(u);
    return Vec3{t * t * t - t, (0.5 + 0.15 * t) * (v - 0.47), t * t};
  })});
  const auto found = untangle(s.mesh, s.x);
  ASSERT_EQ(found.size(), 1u);
  const Untangling& u = found[0];
  const int narrow = u.closed[0] ? 0 : 1;
  EXPECT_TRUE(u.closed[narrow]);
  EXPECT_FALSE(u.closed[1 - narrow]);
  EXPECT_NEAR(u.length_m, 0.35, 0.01);
  std::vector<int> end;
  for (int v = 0; v < static_cast<int>(s.x.size()); ++v)
    if (at((v % 62) / 61.0) < -1) end.push_back(v);
  EXPECT_EQ(u.wrong_vertices[narrow], end);
  const Vec3 back = (narrow == 1 ? 1 : -1) * Vec3{1, 0, -1} / std::sqrt(2.0);
  EXPECT_GT(dot(u.G_side[narrow], back), 0.95);
  EXPECT_LT(norm(u.G_side[narrow]), 1.1);
}

/// The rows see a rigid motion of surface 1 against surface 0 with its speed along G, a common motion not at all, and
/// vanish on the positions themselves (the two points of a row coincide).
TEST(Untangle, RowsMeasureSurfaceOneAgainstSurfaceZero) {
  for (const Tangled& s : scenes()) {
    const auto found = untangle(s.mesh, s.x);
    ASSERT_EQ(found.size(), 1u);
    const Untangling& u = found[0];
    const auto rows = restoringRows(s.mesh, u);
    EXPECT_EQ(rows.size(), u.contour.points.size());
    const int moving = s.pieceOfFace(u.contour.segments[0].face[1]);
    const Vec3 together{0.3, -0.7, 0.2}, apart{-0.1, 0.5, 0.4};
    for (const RestoringRow& row : rows) {
      double speed = 0;
      Vec3 gap;
      for (int k = 0; k < 5; ++k) {
        const int v = row.vertex[k];
        speed += row.weight[k] * dot(row.direction, s.piece[v] == moving ? together + apart : together);
        gap += row.weight[k] * s.x[v];
      }
      EXPECT_NEAR(speed, dot(apart, u.direction), 1e-14);
      EXPECT_LT(norm(gap), 1e-15);
      EXPECT_EQ(row.speed_mps, u.speed_mps);
    }
  }
}

/// Three nested tubes, each shifted 8 mm sideways in the next: moved along G, half of a step each, they come free in
/// the order of their garments, and stand clear of one another: where each is longer than the one inside, and where
/// their rims are flush, so that contours run from the rim of one to the rim of another.
class NestedTubes : public testing::TestWithParam<double> {};

TEST_P(NestedTubes, ComeFree) {
  std::vector<Piece> tubes;
  for (int k = 0; k < 3; ++k) {
    const double r = 0.100 + 0.003 * k, z = -GetParam() * k;
    tubes.push_back(mapped(tube({{r, z}, {r, 0.11}, {r, 0.2}, {r, 0.3 - z}}, 24), [=](const Vec3& p) {
      return p - Vec3{0.008 * k, 0, 0};
    }));
  }
  const Tangled s = join(tubes);
  std::vector<Vec3> x = s.x;
  int steps = 0;
  for (; steps < 400; ++steps) {
    const auto found = untangle(s.mesh, x, s.piece);
    if (found.empty()) break;
    std::array<Vec3, 3> move;
    for (const auto& u : found)
      for (int side = 0; side < 2; ++side)
        move[s.pieceOfFace(u.contour.segments[0].face[side])] += (side == 1 ? 0.5e-4 : -0.5e-4) * u.direction;
    for (std::size_t v = 0; v < x.size(); ++v) x[v] += move[s.piece[v]];
  }
  EXPECT_LT(steps, 400);
  for (int k = 0; k + 1 < 3; ++k) {  // axes nearer than the play between the inner tube and the outer one's sides
    Vec3 axis;
    for (std::size_t v = 0; v < x.size(); ++v) axis += (s.piece[v] == k + 1 ? 1 : s.piece[v] == k ? -1 : 0) * x[v] / 96;
    EXPECT_LT(std::hypot(axis.x, axis.y), 0.003);
  }
}

INSTANTIATE_TEST_SUITE_P(Rims, NestedTubes, testing::Values(0.005, 0.0));

/// Two garments that differ by noise are through each other in a hundred places. The higher one is a little wider, so
/// that all contours are closed on the lower one: exactly its vertices in front of the higher one are found wrong, and
/// the areas of all wrong parts sum to all that is wrong. On the higher one some contours are open: no vertex is wrong
/// that is not.
TEST(Untangle, HundredsOfContoursBetweenTwoGarments) {
  std::mt19937 random(10);
  constexpr int n = 40;
  const auto noisy = [&](double u, double v) { return Vec3{u, v, 1e-3 * static_cast<double>(random()) / 0x1p32}; };
  const Piece low = sheet(n, n, noisy);
  Piece high = sheet(n, n, noisy);  // the same triangles seen from above, but for the border
  for (auto& p : high.x)
    for (int c = 0; c < 2; ++c) {
      if (p[c] == 0) p[c] = -1e-9;
      if (p[c] == 1) p[c] = 1 + 1e-9;
    }
  const Tangled s = join({low, high});
  const auto found = untangle(s.mesh, s.x, s.piece);
  EXPECT_GT(found.size(), 50u);
  std::vector<char> wrong(s.x.size());
  std::array<std::map<std::vector<int>, double>, 2> areas;
  for (const auto& u : found)
    for (int side = 0; side < 2; ++side) {
      for (int v : u.wrong_vertices[side]) wrong[v] = 1;
      const int piece = s.pieceOfFace(u.contour.segments[0].face[side]);
      if (!u.wrong_vertices[side].empty()) areas[piece][u.wrong_vertices[side]] = u.wrong_area_m2[side];
    }
  const int vertices = static_cast<int>(low.x.size());
  int all = 0;
  for (int v = 0; v < vertices; ++v) {
    const bool turned = low.x[v].z > high.x[v].z;
    EXPECT_EQ(wrong[v], turned) << v;
    EXPECT_LE(wrong[v + vertices], turned) << v;
    all += turned;
  }
  EXPECT_GT(all, vertices / 3);
  // The two sheets lie over each other: on the lower one the wrong area is where the difference of heights is positive.
  double area = 0, sum = 0;
  for (const auto& [a, b, c] : low.triangles) {
    const std::array<double, 3> d{low.x[a].z - high.x[a].z, low.x[b].z - high.x[b].z, low.x[c].z - high.x[c].z};
    const double whole = 0.5 * norm(cross(low.x[b] - low.x[a], low.x[c] - low.x[a]));
    const int over = (d[0] > 0) + (d[1] > 0) + (d[2] > 0);
    double part = 0;  // of the corner that is alone on its side
    for (int k = 0; k < 3; ++k)
      if ((d[k] > 0) == (over == 1)) part = d[k] / (d[k] - d[(k + 1) % 3]) * d[k] / (d[k] - d[(k + 2) % 3]);
    area += whole * (over == 3 ? 1 : over == 0 ? 0 : over == 1 ? part : 1 - part);
  }
  for (const auto& [part, a] : areas[0]) sum += a;
  EXPECT_NEAR(sum, area, 1e-8);  // but for the wider border
}

/// Which vertices impact leaves alone.
TEST(Untangle, TangledVertices) {
  const Piece strip = sheet(5, 9, [](double u, double v) { return Vec3{0.21 + 0.5 * u, 0.53, v - 0.31}; });
  const Tangled s = join({sheet(6, 7, [](double u, double v) { return Vec3{u, v, 0}; }), strip});
  const auto tangle = tangledVertices(s.mesh, untangle(s.mesh, s.x));
  for (std::size_t v = 0; v < s.x.size(); ++v) {
    const Vec3& p = s.x[v];
    if (s.piece[v] == 1) {
      EXPECT_EQ(tangle[v], p.z < 0 ? Tangle::kWrong : p.z < 1.0 / 9 ? Tangle::kBeside : Tangle::kFree) << p.z;
    } else if (std::abs(p.x - 5.0 / 6) > 1e-9) {  // there it depends on a diagonal
      EXPECT_EQ(tangle[v], std::abs(p.y - 0.53) < 1.0 / 7 && p.x > 0.1 && p.x < 0.9 ? Tangle::kBeside : Tangle::kFree)
          << p.x << " " << p.y;
    }
  }
}

/// Exact touches give finite answers: coplanar overlapping sheets, a strip that stands exactly on a sheet's vertices,
/// equal triangles.
TEST(Untangle, DegenerateContactsStayFinite) {
  const auto level = [](double z, double turn) {
    return sheet(4, 4, [=](double u, double v) {
      return rotationAbout({0, 0, 1}, turn) * Vec3{u - 0.5, v - 0.5, 0} + Vec3{0.5, 0.5, z};
    });
  };
  const Piece upright = sheet(4, 4, [](double u, double v) { return Vec3{u, 0.5, v - 0.25}; });
  for (const auto& pieces : {std::vector{level(0, 0), level(0, 0)}, std::vector{level(0, 0), level(0, M_PI / 4)},
                             std::vector{level(0, 0), upright}, std::vector{upright, level(0, M_PI / 4)}}) {
    const Tangled s = join(pieces);
    for (const auto& u : untangle(s.mesh, s.x)) {
      EXPECT_TRUE(std::isfinite(u.length_m) && std::isfinite(norm(u.G)) && std::isfinite(u.speed_mps));
      EXPECT_LE(u.speed_mps, 0.5);
      for (const auto& p : u.contour.points) EXPECT_TRUE(std::isfinite(norm(p.x)));
      for (int side = 0; side < 2; ++side) EXPECT_GE(u.wrong_area_m2[side], -1e-15);
    }
  }
}

TEST(Untangle, ParametersAreChecked) {
  const Tangled s = join({wavySheet()});
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  for (const auto& law : {UntangleLaw{0, 1}, UntangleLaw{nan, 1}, UntangleLaw{infinite, 1}, UntangleLaw{0.5, 0},
                          UntangleLaw{0.5, -1}, UntangleLaw{0.5, nan}})
    EXPECT_THROW(untangle(s.mesh, s.x, {}, {}, law), InputError);
  EXPECT_TRUE(untangle(s.mesh, s.x).empty());
}

}  // namespace
}  // namespace gambeson
