#include "core/contact/crossing.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>

#include "core/contact/orientation.hpp"
#include "core/error.hpp"
#include "unit/core/contact/tangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace testing_shapes;

/// A polynomial in the infinitely small eps: exponent -> integer coefficient. The oracle: literally moved points.
using Polynomial = std::map<std::uint64_t, std::int64_t>;

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  Polynomial c = a;
  for (const auto& [e, k] : b) c[e] -= k;
  return c;
}
Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial c;
  for (const auto& [e, k] : a)
    for (const auto& [f, l] : b) c[e + f] += k * l;
  return c;
}

/// Integer coordinates; at most 20 vertices (exponents in 64 bits).
int oracle(std::span<const Vec3> x, const std::array<int, 4>& v) {
  const auto coordinate = [&](int k, int c) {
    return Polynomial{{0, static_cast<std::int64_t>(x[v[k]][c])}, {std::uint64_t{1} << (3 * v[k] + 2 - c), 1}};
  };
  std::array<std::array<Polynomial, 3>, 3> m;
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c) m[k][c] = coordinate(k + 1, c) - coordinate(0, c);
  const auto minor = [&](int i, int j) { return m[1][i] * m[2][j] - m[1][j] * m[2][i]; };
  const Polynomial det = (m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2)) - (m[0][2] * minor(1, 0));
  for (const auto& [e, k] : det)
    if (k != 0) return k > 0 ? 1 : -1;
  return 0;
}

/// Every order of four vertices, on grids so coarse that most quadruples are degenerate, down to four equal points.
TEST(Orientation, IsThatOfMovedPoints) {
  std::mt19937 random(1);
  int flat = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int size = trial % 4;
    std::vector<Vec3> x(20);
    for (auto& p : x)
      for (int c = 0; c < 3; ++c) p[c] = static_cast<double>(random() % (size + 1)) - 1;
    std::array<int, 4> v{};
    for (int k = 0; k < 4; ++k) do
        v[k] = static_cast<int>(random() % 20);
      while (std::find(v.begin(), v.begin() + k, v[k]) != v.begin() + k);
    const Vec3 &a = x[v[0]], n = cross(x[v[1]] - a, x[v[2]] - a);
    flat += dot(n, x[v[3]] - a) == 0;
    ASSERT_EQ(orientation(x, v), oracle(x, v)) << trial;
  }
  EXPECT_GT(flat, 1500);
}

/// Sign of a polynomial at 2^18, by carrying from the lowest digit.
int signAtBase(const Polynomial& digits) {
  std::int64_t carry = 0;
  bool zero = true;
  for (std::uint64_t e = 0; e <= digits.rbegin()->first; ++e) {
    const auto it = digits.find(e);
    carry += it == digits.end() ? 0 : it->second;
    if (e == digits.rbegin()->first) break;
    const std::int64_t low = carry & ((1 << 18) - 1);
    zero = zero && low == 0;
    carry = (carry - low) >> 18;
  }
  return carry > 0 ? 1 : carry < 0 ? -1 : zero ? 0 : 1;
}

/// Points within the last bits of a plane, where doubles cannot tell: compared with long integers (coordinates of 53
/// bits as three digits of 18).
TEST(Orientation, IsExactNextToThePlane) {
  std::mt19937_64 random(2);
  int unsure = 0, wrong = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    std::vector<Vec3> x(4);
    const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 12), -52); };  // [0, 1), 52 bits
    for (int k = 0; k < 3; ++k) x[k] = {1 + number(), 1 + number(), 1 + number()};
    const double s = 0.5 * number(), t = 0.5 * number();
    x[3] = x[0] + s * (x[1] - x[0]) + t * (x[2] - x[0]);
    std::array<std::array<Polynomial, 3>, 3> m;
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) {
        std::int64_t d =
            static_cast<std::int64_t>(std::ldexp(x[k + 1][c], 52)) - static_cast<std::int64_t>(std::ldexp(x[0][c], 52));
        for (std::uint64_t e = 0; e < 3; ++e, d /= 1 << 18) m[k][c][e] = d % (1 << 18);
      }
    const auto minor = [&](int i, int j) { return m[1][i] * m[2][j] - m[1][j] * m[2][i]; };
    const int sign = signAtBase((m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2)) - (m[0][2] * minor(1, 0)));
    if (sign == 0) continue;
    const double plain = dot(cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]);
    unsure += std::abs(plain) < 1e-15;
    wrong += plain * sign <= 0;
    ASSERT_EQ(orientation(x, {0, 1, 2, 3}), sign) << trial;
  }
  EXPECT_GT(unsure, 4000);
  EXPECT_GT(wrong, 300);  // plain doubles would not do
}

/// Tiny and huge coordinates together, as in a sheet whose flat direction holds rounding noise. Exact by hand: with a =
/// 0 the sign is that of the 3 x 3 determinant, of which only one product is left.
TEST(Orientation, HoldsOverSixtyDecades) {
  const std::vector<Vec3> x{{0, 0, 0}, {1e-60, 0, 0}, {1e59, 1e-59, 0}, {1e59, 1e59, -1e-60}};
  EXPECT_EQ(orientation(x, {0, 1, 2, 3}), -1);
  EXPECT_EQ(orientation(x, {1, 0, 2, 3}), 1);
}

/// All edges against all triangles: the moved edge meets the moved triangle where five orientations say so.
std::vector<Crossing> everyPair(const Tangled& s) {
  std::vector<Crossing> out;
  for (int e = 0; e < static_cast<int>(s.mesh.edges.size()); ++e)
    for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t) {
      const auto& [v, w] = s.mesh.edges[e];
      const auto& [a, b, c] = s.mesh.triangles[t];
      if (v == a || v == b || v == c || w == a || w == b || w == c) continue;
      const int back = oracle(s.x, {a, b, c, v}), front = oracle(s.x, {a, b, c, w});
      const int p = oracle(s.x, {v, w, a, b}), q = oracle(s.x, {v, w, b, c}), r = oracle(s.x, {v, w, c, a});
      if (back != front && p == q && q == r) out.push_back({e, t, front});
    }
  return out;
}

/// Number of crossings of each pair of triangles, of each's edges with the other.
std::map<std::pair<int, int>, int> crossingsOfPairs(const ContactMesh& mesh, std::span<const Crossing> crossings) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& c : crossings)
    for (int f : mesh.edge_faces[c.edge]) ++count[std::minmax(f, c.triangle)];
  return count;
}

int shared(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  int n = 0;
  for (int v : a)
    for (int w : b) n += v == w;
  return n;
}

/// Soups on coarse grids: most edges touch something exactly. The tree against all pairs by the oracle; and what makes
/// contours possible: two triangles without a common vertex cross at 0 or 2 places, with one at 0 or 1, with more at
/// none.
TEST(Crossing, SoupsAreConsistent) {
  std::mt19937 random(3);
  std::size_t total = 0;
  int ends_at_vertices = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Tangled s = soup(random, 9 + trial % 11, 14, 1 + trial % 5);
    const auto found = findCrossings(s.mesh, s.x);
    ASSERT_EQ(found, everyPair(s)) << trial;
    total += found.size();
    for (const auto& [pair, count] : crossingsOfPairs(s.mesh, found)) {
      const int common = shared(s.mesh.triangles[pair.first], s.mesh.triangles[pair.second]);
      ASSERT_EQ(count, common == 0 ? 2 : common == 1 ? 1 : 0) << trial;
      ends_at_vertices += common == 1;
    }
  }
  EXPECT_GT(total, 1000u);
  EXPECT_GT(ends_at_vertices, 100);
}

/// Where nothing is degenerate the answer is that of plain geometry: the point in which the edge meets the plane, by
/// exact fractions, lies inside the triangle.
TEST(Crossing, AgreesWithExactFractions) {
  std::mt19937 random(4);
  using Integer = std::int64_t;
  struct I3 {
    Integer x, y, z;
  };
  const auto sub = [](const I3& a, const I3& b) { return I3{a.x - b.x, a.y - b.y, a.z - b.z}; };
  const auto mul = [](const I3& a, const I3& b) {
    return I3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const auto in = [](const I3& a, const I3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  int compared = 0, crossing = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Tangled s = soup(random, 40, 60, 40);
    std::vector<I3> x;
    for (const auto& p : s.x) x.push_back({Integer(p.x), Integer(p.y), Integer(p.z)});
    const auto found = findCrossings(s.mesh, s.x);
    for (int e = 0; e < static_cast<int>(s.mesh.edges.size()); ++e)
      for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t) {
        const I3 &p = x[s.mesh.edges[e][0]], &q = x[s.mesh.edges[e][1]];
        const auto& corner = s.mesh.triangles[t];
        const I3& a = x[corner[0]];
        const I3 n = mul(sub(x[corner[1]], a), sub(x[corner[2]], a));
        const Integer hp = in(n, sub(p, a)), hq = in(n, sub(q, a)), d = hp - hq;
        if (hp == 0 || hq == 0) continue;
        bool meets = (hp > 0) != (hq > 0), edge_on = false;
        for (int k = 0; k < 3 && meets; ++k) {  // d (point - corner), to the left of each side
          const I3 &u = x[corner[k]], &v = x[corner[(k + 1) % 3]], pu = sub(p, u), pq = sub(q, p);
          const I3 r{d * pu.x + hp * pq.x, d * pu.y + hp * pq.y, d * pu.z + hp * pq.z};
          const Integer side = in(n, mul(sub(v, u), r));
          edge_on = edge_on || side == 0;
          meets = (side > 0) == (d > 0);
        }
        if (edge_on) continue;
        ++compared;
        crossing += meets;
        const bool listed =
            std::any_of(found.begin(), found.end(), [&](const Crossing& c) { return c.edge == e && c.triangle == t; });
        ASSERT_EQ(listed, meets) << trial << " " << e << " " << t;
      }
  }
  EXPECT_GT(compared, 100000);
  EXPECT_GT(crossing, 1000);
}

/// Three exact contacts: a vertex on a face, edge on edge, a triangle on a coplanar one. Whatever is chosen, two
/// crossings or none for two triangles apart.
TEST(Crossing, ExactTouchesAreDecided) {
  const Piece ground{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
  const std::vector<std::vector<Vec3>> touching{
      {{1, 1, 0}, {1, 2, 1}, {2, 1, 1}},    // vertex on face
      {{1, -1, 0}, {1, 1, 0}, {1, 0, 1}},   // edge on edge
      {{2, 0, 0}, {2, 0, 1}, {3, -1, 1}},   // vertex on edge
      {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}},    // coplanar, inside
      {{-1, 1, 0}, {3, 1, 0}, {1, -2, 0}},  // coplanar, overlapping
      {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},    // the same
      {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}},    // a point on the face
      {{0, 0, 0}, {4, 0, 0}, {0, 0, 1}},    // an edge at an edge
  };
  for (const auto& other : touching)
    for (const bool first : {true, false}) {
      const Piece p{other, {{0, 1, 2}}};
      const Tangled s = first ? join({p, ground}) : join({ground, p});
      const auto found = findCrossings(s.mesh, s.x);
      EXPECT_EQ(found, everyPair(s));
      EXPECT_TRUE(found.empty() || found.size() == 2u);
    }
}

/// Obstacles do not hit each other.
TEST(Crossing, ObstaclesAreLeftOut) {
  const Piece flat = sheet(3, 3, [](double u, double v) { return Vec3{u, v, 0}; });
  const auto standing = [&](double at) {
    return sheet(3, 3, [&](double u, double v) { return Vec3{at + 0.01 * v, u - 0.2, v - 0.4}; });
  };
  const Tangled s = join({flat, standing(0.3), standing(0.7)});
  std::vector<char> obstacle(s.x.size());
  for (std::size_t v = 0; v < s.x.size(); ++v) obstacle[v] = s.piece[v] != 1;
  const auto some = findCrossings(s.mesh, s.x, obstacle);
  const auto all = findCrossings(s.mesh, s.x);
  EXPECT_GT(some.size(), 3u);
  std::vector<Crossing> expected;
  for (const auto& c : all)
    if (s.piece[s.mesh.edges[c.edge][0]] == 1 || s.pieceOfFace(c.triangle) == 1) expected.push_back(c);
  EXPECT_EQ(some, expected);
  EXPECT_LT(some.size(), all.size());
}

/// Coordinates far below any length count as zero: the same crossings as with zeros.
TEST(Crossing, VanishingCoordinatesCountAsZero) {
  std::mt19937 random(5);
  const Tangled s = soup(random, 12, 14, 2);
  const auto expected = findCrossings(s.mesh, s.x);
  for (const double tiny : {std::ldexp(1.0, -1070), 1e-150, 0.99e-60}) {
    std::vector<Vec3> x = s.x;
    for (auto& p : x)
      for (int c = 0; c < 3; ++c)
        if (p[c] == 0) p[c] = random() % 2 ? tiny : -tiny;
    EXPECT_EQ(findCrossings(s.mesh, x), expected) << tiny;
  }
}

TEST(Crossing, SameForAnyNumberOfThreads) {
  const auto wavy = [](double phase) {
    return sheet(40, 40, [=](double u, double v) {
      return Vec3{u, v, 0.02 * std::sin(20 * u + phase) * std::cos(17 * v)};
    });
  };
  const Tangled s = join({wavy(0), wavy(1)});
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = findCrossings(s.mesh, s.x);
  omp_set_num_threads(3);
  const auto three = findCrossings(s.mesh, s.x);
  omp_set_num_threads(before);
  EXPECT_GT(one.size(), 500u);
  EXPECT_EQ(one, three);
  EXPECT_TRUE(std::is_sorted(one.begin(), one.end(), [](const Crossing& a, const Crossing& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  }));
}

TEST(Crossing, PositionsMustBeFinite) {
  Tangled s = join({sheet(2, 2, [](double u, double v) { return Vec3{u, v, 0}; })});
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e60}) {
    s.x[4].y = bad;
    EXPECT_THROW(findCrossings(s.mesh, s.x), RunError);
  }
}

}  // namespace
}  // namespace gambeson
