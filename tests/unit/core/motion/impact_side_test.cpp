/// Impacts of cloth with the surface of a body from inside of it are left out, and no others: of all that would meet on
/// straight paths, asked pair by pair, the first of each triangle of cloth stays.

#include "core/motion/impact_side.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <set>

#include "core/contact/certified_impact.hpp"
#include "core/contact/mesh_surface.hpp"
#include "core/motion/collisions.hpp"
#include "unit/core/contact/mesh_shapes.hpp"

namespace gambeson {
namespace {

using Triangle = std::array<Vec3, 3>;

/// A pair of vertices and triangles, or of edges, as findImpacts names them.
using Pair = std::tuple<bool, int, int>;

/// Triangles of cloth that share no corners, each of which goes straight somewhere in a step, around a body.
struct Flight {
  Obstacle obstacle;
  CollisionModel model;
  CollisionWork work;
  std::vector<PairHit> hits;

  Flight(const TriangleMesh& body, const std::vector<Triangle>& from, const std::vector<Triangle>& to)
      : obstacle{body, "body"} {
    Surface s;
    std::vector<Vec3> x0, x1;
    for (std::size_t t = 0; t < from.size(); ++t) {
      const int first = static_cast<int>(3 * t);
      s.triangles.push_back({first, first + 1, first + 2});
      x0.insert(x0.end(), from[t].begin(), from[t].end());
      x1.insert(x1.end(), to[t].begin(), to[t].end());
    }
    s.triangle_patch.assign(from.size(), 0);
    s.triangle_cell.assign(from.size(), 0);
    s.patch_grid.resize(1);
    s.patch_grid_size.resize(1);
    s.area_m2.assign(x0.size(), 1);
    const std::vector<Placement> still(1);
    model = buildCollisions(s, x0, std::vector<int>(x0.size(), 0), std::vector<double>(x0.size(), 1e-3), {&obstacle, 1},
                            still, false);
    const DeformedVertices none;
    placeVertices(model, 0, 1e-3, x0, {still, still, none, none}, work);
    x1.resize(static_cast<std::size_t>(model.mesh.vertex_count));
    std::copy(work.x1.begin() + static_cast<std::ptrdiff_t>(x0.size()), work.x1.end(),
              x1.begin() + static_cast<std::ptrdiff_t>(x0.size()));
    moveVertices(x1, work);
    work.tangle.assign(x1.size(), Tangle::kFree);
    findImpacts(model, 1e-3, std::vector<char>(x0.size(), 0), work, hits);
  }

  int samples() const { return model.cloth.cloth_vertices; }
  ImpactSurfaces surfaces() const { return {viewOf(model.mesh), samples(), work.x0.data(), work.x1.data()}; }

  /// All pairs of triangle t of the cloth and the body that would meet, whatever the side.
  std::vector<ImpactPair> meeting(int t) const {
    std::vector<ImpactPair> found;
    const auto ask = [&](bool edges, int a, int b, const std::array<int, 4>& vertex) {
      ImpactPair pair{edges, a, b, vertex, {}, {}};
      for (std::size_t k = 0; k < 4; ++k) {
        pair.x0[k] = work.x0[static_cast<std::size_t>(vertex[k])];
        pair.x1[k] = work.x1[static_cast<std::size_t>(vertex[k])];
      }
      const auto at = edges ? edgeEdgeImpact(pair.x0, pair.x1, kImpactSeparation_m)
                            : pointTriangleImpact(pair.x0, pair.x1, kImpactSeparation_m);
      if (!at) return;
      pair.time = at->time, pair.u = at->u, pair.v = at->v;
      found.push_back(pair);
    };
    const ContactMesh& mesh = model.mesh;
    const auto of = [](int v) { return v / 3; };
    for (int f = model.cloth_triangles; f < static_cast<int>(mesh.triangles.size()); ++f)
      for (int v = 3 * t; v < 3 * t + 3; ++v) {
        const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(f)];
        ask(false, v, f, {v, a, b, c});
      }
    for (int v = samples(); v < mesh.vertex_count; ++v) ask(false, v, t, {v, 3 * t, 3 * t + 1, 3 * t + 2});
    for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) {
      const auto& [a, b] = mesh.edges[static_cast<std::size_t>(e)];
      if (a >= samples() || of(a) != t) continue;
      for (int f = 0; f < static_cast<int>(mesh.edges.size()); ++f) {
        const auto& [c, d] = mesh.edges[static_cast<std::size_t>(f)];
        if (c >= samples()) ask(true, e, f, {a, b, c, d});
      }
    }
    return found;
  }
};

/// Triangles of 1 to 3 cm that start outside of a body and go through some of it.
Flight flightThrough(const TriangleMesh& body, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> even(-1, 1);
  const auto anywhere = [&](double size) { return size * Vec3{even(random), even(random), even(random)}; };
  const MeshSurface surface(body);
  std::vector<Triangle> from, to;
  while (static_cast<int>(from.size()) < count) {
    const Vec3 middle = anywhere(0.1);
    Triangle start{anywhere(0.015), anywhere(0.015), anywhere(0.015)}, end;
    double reach = 0;
    for (const Vec3& x : start) reach = std::max(reach, norm(x));
    const auto near = surface.nearest(middle, 1);
    if (!near || !(near->distance_m > reach + 1e-4)) continue;  // all of it is outside
    const Vec3 way = 2 * (near->position - middle) + anywhere(0.03);
    for (std::size_t k = 0; k < 3; ++k) {
      start[k] += middle;
      end[k] = start[k] + way + anywhere(0.01);
    }
    from.push_back(start);
    to.push_back(end);
  }
  return {body, from, to};
}

/// Whether the point at distance `off_m` along the normal of an impact, on the side from which the cloth came, lies
/// inside of the body.
bool comesOutOf(const MeshSurface& body, const Flight& flight, const ImpactPair& pair, double off_m) {
  const ImpactPlace at = placeOf(pair);
  const bool a_is_body = pair.vertex[0] >= flight.samples();
  Vec3 x{};  // the point of the body
  for (std::size_t k = 0; k < 4; ++k)
    if (pair.vertex[k] >= flight.samples()) x += std::abs(at.weight[k]) * at.x[k];
  const auto near = body.nearest(x + (a_is_body ? -off_m : off_m) * at.normal, 1);
  return near && near->distance_m < 0;
}

struct Counts {
  int meet = 0, from_inside = 0, edges = 0, faces = 0, corners = 0, at_ends = 0;
};

void lookAt(const TriangleMesh& mesh, Counts& seen) {
  const MeshSurface body(mesh);
  constexpr int kTriangles = 250;
  const Flight flight = flightThrough(mesh, kTriangles, 3);
  std::vector<std::set<Pair>> kept(kTriangles);
  for (const PairHit& hit : flight.hits) {
    const int cloth = hit.edges                  ? flight.model.mesh.edges[static_cast<std::size_t>(hit.a)][0] / 3
                      : hit.a < flight.samples() ? hit.a / 3
                                                 : hit.b;
    kept[static_cast<std::size_t>(cloth)].insert({hit.edges, hit.a, hit.b});
  }
  for (int t = 0; t < kTriangles; ++t) {
    const std::set<Pair>& of_triangle = kept[static_cast<std::size_t>(t)];
    double first = 2, first_kept = 2;
    std::size_t stays = 0;
    for (const ImpactPair& pair : flight.meeting(t)) {
      ++seen.meet;
      first = std::min(first, pair.time);
      if (of_triangle.contains({pair.edges, pair.a, pair.b})) {
        ++stays;
        first_kept = std::min(first_kept, pair.time);
        continue;
      }
      ++seen.from_inside;
      ++(pair.edges ? seen.edges : pair.vertex[0] < flight.samples() ? seen.faces : seen.corners);
      // Where the nearest points are ends of edges or borders of triangles another pair has them too.
      const double inner = std::min({pair.u, pair.v, 1 - pair.u - (pair.edges ? 0 : pair.v), 1 - pair.v});
      if (inner < 1e-2)
        ++seen.at_ends;
      else
        EXPECT_TRUE(comesOutOf(body, flight, pair, 1e-5)) << pair.edges << " " << pair.a << " " << pair.b;
    }
    EXPECT_EQ(stays, of_triangle.size());
    EXPECT_NEAR(first_kept, first, 1e-6) << "triangle " << t;
  }
}

TEST(ImpactSide, WhatIsLeftOutComesFromInsideAndTheFirstImpactOfAllClothStays) {
  Counts seen;
  lookAt(testing_shapes::box({0.04, 0.03, 0.02}), seen);
  lookAt(testing_shapes::box({0.01, 0.008, 0.006}), seen);
  lookAt(testing_shapes::sphere(0.03, 0), seen);
  lookAt(testing_shapes::torus(0.05, 0.02, 8, 5), seen);
  std::printf("[ measured ] %d pairs meet, %d from inside: %d edges, %d faces, %d corners of bodies; %d at ends\n",
              seen.meet, seen.from_inside, seen.edges, seen.faces, seen.corners, seen.at_ends);
  EXPECT_GT(seen.meet - seen.from_inside, 2000);
  EXPECT_GT(seen.edges, 500);
  EXPECT_GT(seen.faces, 200);
  EXPECT_GT(seen.corners, 20);
  EXPECT_LT(seen.at_ends, seen.from_inside / 10);
}

/// An edge of cloth that slides over the corner of a box: it would pass through both edges of the top and then, from
/// inside, through the upright one, whose row would hold it in the box.
TEST(ImpactSide, TheEdgeAtWhichClothWouldLeaveACornerIsNoContact) {
  const Triangle from{Vec3{0.075, 0.015, 0.0505}, Vec3{0.015, 0.075, 0.0505}, Vec3{0.03, 0.03, 0.09}};
  Triangle to = from;
  for (Vec3& x : to) x += Vec3{0.02, 0.02, -0.003};
  const Flight flight(testing_shapes::box({0.05, 0.05, 0.05}), {from}, {to});
  int outwards = 0;
  for (const ImpactPair& pair : flight.meeting(0)) outwards += pair.edges && placeOf(pair).normal.z < 0.5;
  EXPECT_EQ(outwards, 1);
  ASSERT_EQ(flight.hits.size(), 2u);
  for (const PairHit& hit : flight.hits) EXPECT_NEAR(hit.row.contact.normal.z, 1, 1e-9);
}

/// A plate without thickness has borders, which cloth may meet from anywhere.
TEST(ImpactSide, TheBorderOfAnOpenSurfaceHasNoInside) {
  TriangleMesh plate = testing_shapes::plane(2);
  for (Vec3& x : plate.vertices) x = 0.1 * (x - Vec3{0.5, 0.5, 0});
  // Across the border x = 0.05, from outside and below.
  const Triangle from{Vec3{0.054, -0.01, -0.02}, Vec3{0.066, 0.012, 0.02}, Vec3{0.09, 0, 0}};
  Triangle to = from;
  for (Vec3& x : to) x += Vec3{-0.02, 0, 0};
  const Flight flight(plate, {from}, {to});
  ASSERT_EQ(flight.hits.size(), 1u);
  EXPECT_TRUE(flight.hits[0].edges);
  EXPECT_GT(flight.hits[0].row.contact.normal.x, 0.9);
  EXPECT_LT(flight.hits[0].row.contact.normal.z, -0.1);
}

}  // namespace
}  // namespace gambeson
