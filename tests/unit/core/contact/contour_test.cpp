#include "core/contact/contour.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "unit/core/contact/tangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace testing_shapes;

std::vector<Contour> contoursOf(const Tangled& s) { return traceContours(s.mesh, s.x, findCrossings(s.mesh, s.x)); }

/// Unit normal by the order of corners.
Vec3 normalOf(const Tangled& s, int face) {
  const auto& [a, b, c] = s.mesh.triangles[face];
  return normalized(cross(s.x[b] - s.x[a], s.x[c] - s.x[a]));
}

bool hasEdge(const ContactMesh& mesh, int face, int edge) {
  const auto& e = mesh.face_edges[face];
  return std::find(e.begin(), e.end(), edge) != e.end();
}

/// What every contour must fulfil, also in soups: each pair of crossing triangles is one segment, each crossing one
/// point (one for each triangle at an edge that has not two), neighbours fit, ends are where the mesh says.
void expectConsistent(const Tangled& s) {
  const auto crossings = findCrossings(s.mesh, s.x);
  const auto contours = traceContours(s.mesh, s.x, crossings);
  std::set<std::pair<int, int>> pairs, seen;
  for (const auto& c : crossings)
    for (int f : s.mesh.edge_faces[c.edge]) pairs.insert(std::minmax(f, c.triangle));
  std::map<std::pair<int, int>, int> visits;
  for (const auto& c : contours) {
    ASSERT_EQ(c.points.size(), c.segments.size() + (c.cyclic ? 0 : 1));
    for (int i = 0; i < static_cast<int>(c.segments.size()); ++i) {
      const auto& seg = c.segments[i];
      EXPECT_TRUE(seen.insert(std::minmax(seg.face[0], seg.face[1])).second) << "a pair twice";
      for (int k : {i, c.next(i)}) {
        const ContourPoint& p = c.points[k];
        if (p.vertex >= 0) {
          for (int f : seg.face) {
            const auto& t = s.mesh.triangles[f];
            EXPECT_TRUE(std::find(t.begin(), t.end(), p.vertex) != t.end());
          }
          EXPECT_TRUE(!c.cyclic && (k == 0 || k == static_cast<int>(c.points.size()) - 1));
        } else {
          // Where the surfaces are exchanged by a cycle the names at its start fit one of the two segments only.
          const bool exchanged = c.cyclic && k == 0 && i > 0 && !c.closed[0] && !c.closed[1];
          const int owner = exchanged && seg.face[1 - p.owner] != p.triangle ? 1 - p.owner : p.owner;
          EXPECT_TRUE(hasEdge(s.mesh, seg.face[owner], p.edge));
          EXPECT_EQ(seg.face[1 - owner], p.triangle);
        }
      }
    }
    for (int i = 0; i < static_cast<int>(c.points.size()); ++i) {
      const ContourPoint& p = c.points[i];
      if (p.vertex >= 0) continue;
      ++visits[{p.edge, p.triangle}];
      const bool end = !c.cyclic && (i == 0 || i + 1 == static_cast<int>(c.points.size()));
      EXPECT_EQ(end, s.mesh.edge_faces[p.edge].size() != 2) << "goes on exactly where two triangles meet";
      double sum = 0;
      for (double w : p.triangle_weight) {
        EXPECT_TRUE(w >= 0 && w <= 1);
        sum += w;
      }
      EXPECT_NEAR(sum, 1, 1e-14);
      // Also of an exact contact the point lies on both (but a triangle without area has no inside).
      const auto& [a, b, d] = s.mesh.triangles[p.triangle];
      Vec3 on_triangle;
      for (int k = 0; k < 3; ++k) on_triangle += p.triangle_weight[k] * s.x[s.mesh.triangles[p.triangle][k]];
      if (norm(cross(s.x[b] - s.x[a], s.x[d] - s.x[a])) > 0) {
        EXPECT_LT(norm(on_triangle - p.x), 1e-13);
      }
      EXPECT_TRUE(p.edge_weight[1] >= 0 && p.edge_weight[1] <= 1);
      EXPECT_EQ(p.edge_weight[0] + p.edge_weight[1], 1);
    }
  }
  EXPECT_EQ(pairs, seen);
  ASSERT_EQ(visits.size(), crossings.size());
  for (const auto& c : crossings) {
    const int faces = static_cast<int>(s.mesh.edge_faces[c.edge].size());
    EXPECT_EQ((visits[{c.edge, c.triangle}]), faces == 2 ? 1 : faces);
  }
}

TEST(Contour, SoupsOnCoarseGrids) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 400; ++trial) {
    expectConsistent(soup(random, 6 + trial % 30, 16 + trial % 25, 1 + trial % 5));
    ASSERT_FALSE(HasFailure()) << trial;
  }
}

/// Sheets rounded to a coarse grid: manifold, with folds, coinciding points, coplanar overlaps and exact touches by the
/// hundred. Here every closed contour also enters and leaves each triangle equally often.
TEST(Contour, CrumpledSheetsOnCoarseGrids) {
  std::mt19937 random(7);
  int cyclic = 0, open = 0, at_vertex = 0, one_sided = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const int levels = 2 + trial % 7;
    std::vector<Piece> pieces;
    for (int k = 0; k < 1 + trial % 3; ++k)
      pieces.push_back(sheet(7, 6, [&](double u, double v) {
        const auto jitter = [&] { return static_cast<double>(random() % 1000) / 1000; };
        const Vec3 p{u + 0.3 * jitter(), v + 0.3 * jitter(), 0.4 * jitter()};
        return Vec3{std::round(p.x * levels), std::round(p.y * levels), std::round(p.z * levels)};
      }));
    const Tangled s = join(pieces);
    expectConsistent(s);
    ASSERT_FALSE(HasFailure()) << trial;
    for (const auto& c : contoursOf(s)) {
      cyclic += c.cyclic;
      open += !c.cyclic && !c.closed[0] && !c.closed[1];
      one_sided += c.closed[0] != c.closed[1];
      at_vertex += c.points.front().vertex >= 0 || c.points.back().vertex >= 0;
      for (int side = 0; side < 2; ++side) {
        if (!c.closed[side]) continue;
        int segments = 0;
        for (const auto& part : subchains(c, side)) {
          EXPECT_NE(part.type, Subchain::kEnds);
          EXPECT_EQ(part.type == Subchain::kNoEdge,
                    part.segments == static_cast<int>(c.segments.size()) && subchains(c, side).size() == 1 && c.cyclic);
          segments += part.segments;
        }
        EXPECT_EQ(segments, static_cast<int>(c.segments.size()));
      }
    }
  }
  EXPECT_GT(cyclic, 10);
  EXPECT_GT(open, 10);
  EXPECT_GT(one_sided, 10);
  EXPECT_GT(at_vertex, 10);
}

/// Zheng 2013, fig. 4.7 to 4.9: a tube through a sheet is closed on both; a strip through a wider sheet on the strip
/// only; two sheets that each cut the other's border at one end on neither.
TEST(Contour, ClosedMixedAndOpen) {
  const Piece flat = sheet(6, 5, [](double u, double v) { return Vec3{u, v, 0}; });
  const auto upright = [](double from, double to) {
    return sheet(4, 5, [=](double u, double v) { return Vec3{from + (to - from) * u, 0.43 + 0.1 * v, v - 0.47}; });
  };
  const Piece pipe = mapped(tube({{0.2, -0.5}, {0.2, 0.1}, {0.2, 0.6}}, 9), [](const Vec3& p) {
    return Vec3{p.x + 0.5, p.y + 0.5 + 0.2 * p.z, p.z};
  });
  struct Case {
    Piece other;
    bool cyclic, on_flat, on_other;
  };
  for (const auto& [other, cyclic, on_flat, on_other] :
       {Case{pipe, true, true, true}, Case{upright(0.2, 0.7), false, false, true},
        Case{upright(-0.3, 1.2), false, true, false}, Case{upright(0.3, 1.2), false, false, false}}) {
    const Tangled s = join({flat, other});
    expectConsistent(s);
    const auto contours = contoursOf(s);
    ASSERT_EQ(contours.size(), 1u);
    const Contour& c = contours[0];
    EXPECT_EQ(c.cyclic, cyclic);
    const int flat_side = s.pieceOfFace(c.segments[0].face[0]) == 0 ? 0 : 1;
    EXPECT_EQ(c.closed[flat_side], on_flat);
    EXPECT_EQ(c.closed[1 - flat_side], on_other);
  }
}

/// Points lie on both surfaces, and the exactly known direction is that of the points.
TEST(Contour, PointsAndDirections) {
  const Tangled s = join({sheet(9, 8,
                                [](double u, double v) {
                                  return Vec3{u, v, 0.1 * std::sin(5 * u + 3 * v)};
                                }),
                          sheet(7, 6, [](double u, double v) {
                            return Vec3{u, 0.5 + 0.1 * std::sin(6 * u) + 0.1 * v, v - 0.45};
                          })});
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  const Contour& c = contours[0];
  EXPECT_GT(c.points.size(), 20u);
  for (const auto& p : c.points) {
    Vec3 on_edge, on_triangle;
    for (int k = 0; k < 2; ++k) on_edge += p.edge_weight[k] * s.x[s.mesh.edges[p.edge][k]];
    for (int k = 0; k < 3; ++k) on_triangle += p.triangle_weight[k] * s.x[s.mesh.triangles[p.triangle][k]];
    EXPECT_LT(norm(on_edge - p.x), 1e-15);
    EXPECT_LT(norm(on_triangle - p.x), 1e-15);
  }
  for (std::size_t i = 0; i < c.segments.size(); ++i) {
    const auto& seg = c.segments[i];
    const Vec3 line = seg.direction * normalized(cross(normalOf(s, seg.face[0]), normalOf(s, seg.face[1])));
    const Vec3 step = c.points[c.next(static_cast<int>(i))].x - c.points[i].x;
    EXPECT_NEAR(dot(line, step), norm(step), 1e-14);
  }
}

/// Normals are carried whatever the order of corners: the same contour on a sheet whose triangles are turned at random.
TEST(Contour, CarriesNormalsAcrossTurnedTriangles) {
  std::mt19937 random(8);
  Piece flat = sheet(6, 5, [](double u, double v) { return Vec3{u, v, 0}; });
  for (auto& t : flat.triangles)
    if (random() % 2) std::swap(t[0], t[1]);
  const Piece pipe = mapped(tube({{0.3, -0.5}, {0.3, 0.6}}, 9), [](const Vec3& p) { return p + Vec3{0.5, 0.5, 0}; });
  const Tangled s = join({flat, pipe});
  expectConsistent(s);
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_TRUE(contours[0].closed[0] && contours[0].closed[1]);
  const int side = s.pieceOfFace(contours[0].segments[0].face[0]) == 0 ? 0 : 1;
  const auto up = [&](const ContourSegment& seg) { return seg.normal[side] * normalOf(s, seg.face[side]).z; };
  for (const auto& seg : contours[0].segments) EXPECT_EQ(up(seg), up(contours[0].segments[0]));
}

/// Zheng 2013, fig. 4.3: spikes through one triangle, through its edge, over its corner, and three edges of one
/// triangle cut at once.
TEST(Contour, SubchainsOfAllTypes) {
  // Corners (0,0), (1,0), (0,1), and a neighbour at each edge.
  const Piece ground{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {-1, 0.5, 0}, {0.5, -1, 0}},
                     {{0, 1, 2}, {3, 2, 1}, {0, 2, 4}, {1, 0, 5}}};
  const auto spike = [](double x, double y, double r) {
    return mapped(tube({{r, -0.1}, {0, 0.1}}, 7, 0.05), [=](const Vec3& p) { return p + Vec3{x, y, 0}; });
  };
  const auto types = [&](const Piece& other) {
    const Tangled s = join({ground, other});
    const auto contours = contoursOf(s);
    EXPECT_EQ(contours.size(), 1u);
    const Contour& c = contours[0];
    const int side = s.pieceOfFace(c.segments[0].face[0]) == 0 ? 0 : 1;
    std::multiset<std::pair<int, int>> out;  // face, type
    for (const auto& part : subchains(c, side)) out.insert({part.face, part.type});
    return out;
  };
  using Types = std::multiset<std::pair<int, int>>;
  EXPECT_EQ(types(spike(0.3, 0.3, 0.2)), (Types{{0, Subchain::kNoEdge}}));
  EXPECT_EQ(types(spike(0.5, 0.5, 0.2)), (Types{{0, Subchain::kOneEdge}, {1, Subchain::kOneEdge}}));
  EXPECT_EQ(types(spike(0.01, 0.013, 0.2)),
            (Types{{0, Subchain::kTwoEdges}, {2, Subchain::kTwoEdges}, {3, Subchain::kTwoEdges}}))
      << "the corner is on the border: an open contour";
}

/// Two triangles of a fan that cross each other: the contour starts at their common vertex.
TEST(Contour, EndsAtSharedVertices) {
  const Piece fan{{{0, 0, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {0.6, 0.1, 0.5}, {0.6, 0.05, -0.5}},
                  {{0, 1, 2}, {0, 3, 4}, {0, 2, 3}}};
  const Tangled s = join({fan});
  expectConsistent(s);
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  const Contour& c = contours[0];
  ASSERT_EQ(c.points.size(), 2u);
  EXPECT_EQ((c.points[0].vertex == 0) + (c.points[1].vertex == 0), 1);
  EXPECT_FALSE(c.closed[0] || c.closed[1]);
  const ContourPoint& p = c.points[c.points[0].vertex == 0 ? 1 : 0];
  EXPECT_EQ(s.mesh.edges[p.edge], (std::array<int, 2>{3, 4}));
  EXPECT_NEAR(p.x.z, 0, 1e-16);
}

/// Two bands with half a twist each, at right angles along their common core: a cycle, but it has no left and right.
TEST(Contour, OneSidedSurfacesAreNotClosed) {
  const auto band = [](int n, double turned) {  // the ends are joined by welding the last column to the turned first
    Piece p;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < 4; ++j) {
        const double a = 2 * M_PI * (i + 0.3 * turned) / n, b = a / 2 + turned, w = 0.1 * (j - 1.5);
        p.x.push_back({(1 + w * std::cos(b)) * std::cos(a), (1 + w * std::cos(b)) * std::sin(a), w * std::sin(b)});
      }
    const auto at = [=](int i, int j) { return i < n ? 4 * i + j : 3 - j; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < 3; ++j)
        p.triangles.insert(p.triangles.end(),
                           {{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    return p;
  };
  const Tangled s = join({band(40, 0), band(40, M_PI / 2)});
  expectConsistent(s);
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_TRUE(contours[0].cyclic);
  EXPECT_FALSE(contours[0].closed[0] || contours[0].closed[1]);
}

/// A band that goes around twice, with half a twist in all: its two passes cross along their core, each becomes the
/// other after one turn. The cycle exchanges the names 0 and 1.
TEST(Contour, SurfacesExchangedByACycleAreNotClosed) {
  Piece p;
  const int n = 61;  // odd: the passes share no vertices
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 4; ++j) {
      const double a = 4 * M_PI * i / n, b = a / 4 + 0.2, w = 0.1 * (j - 1.5);
      p.x.push_back({(1 + w * std::cos(b)) * std::cos(a), (1 + w * std::cos(b)) * std::sin(a), w * std::sin(b)});
    }
  const auto at = [=](int i, int j) { return i < n ? 4 * i + j : 3 - j; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 3; ++j)
      p.triangles.insert(p.triangles.end(),
                         {{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
  const Tangled s = join({p});
  expectConsistent(s);
  const auto contours = contoursOf(s);
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_TRUE(contours[0].cyclic);
  EXPECT_FALSE(contours[0].closed[0] || contours[0].closed[1]);
}

}  // namespace
}  // namespace gambeson
