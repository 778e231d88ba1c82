/// Beams and loops of triangles that bend by their tensor of curvature: clamps, moments, directions, memory.

#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <cmath>
#include <numbers>

#include "core/material/hysteresis.hpp"
#include "core/statics/path.hpp"
#include "core/statics/statics.hpp"
#include "triangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Fabric sheet(const BendingLaw& law) {
  Fabric f;
  f.thickness_m = 1e-3;
  f.density_kg_per_m3 = 500;
  f.young_weft_Pa = f.young_warp_Pa = 1e7;
  f.poisson = 0;
  f.shear_Pa = 0.5e7;
  f.law = law;
  return f;
}

constexpr double kB = 1e-5;  ///< [N m]
BendingLaw isotropic() { return LinearBending{{kB, kB, 0.5 * kB}}; }

std::unique_ptr<TriangleCloth> strip(BendingElements bending, int cells, int across, double length, double width,
                                     const BendingLaw& law, MeshKind kind, double jitter = 0) {
  MeshDraft g = flatTriangles(cells, across, length, width, sheet(law), kind, jitter);
  g.bending = bending;
  std::vector<MeshDraft> all;
  all.push_back(std::move(g));
  return std::make_unique<TriangleCloth>(std::move(all));
}

StructureOptions clamped(const Cloth& c) {
  StructureOptions o;
  const PatchEdge clamp{0, Side::u0, false};
  const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  o.constraints = c.mounting().holdEdge(clamp, all, {});
  for (LinearConstraint& l : c.mounting().clampEdge(clamp)) o.constraints.push_back(std::move(l));
  return o;
}

/// Tip of a cantilever under a small load at its end, over that of the beam, F L^3/(3 B b).
double tipOverBeam(int cells, MeshKind kind, double jitter) {
  const double length = 0.2, width = 0.05, force = 1e-7;
  auto c = strip(BendingElements::midedge, cells, std::max(1, cells / 4), length, width, isotropic(), kind, jitter);
  StructureOptions o = clamped(*c);
  const PatchEdge tip{0, Side::u1, false};
  o.dead = {{c->mounting().edgeForce(tip, {0, 0, force / width}), 0}};
  const std::vector<int> end = c->sidePoints(tip);
  const auto s = buildStructure(std::move(c), o);
  double w = 0;
  const StaticReport r = solveStatic(*s, {.steps = 1}, [&](const StaticPoint& p) {
    const std::vector<Vec3> q = controlPoints(*s, p.y, p.factor);
    w = 0;
    for (const int point : end) w += q[static_cast<std::size_t>(point)].z / static_cast<double>(end.size());
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  return w / (force * length * length * length / (3 * kB * width));
}

TEST(BendingTriangles, ACantileverConvergesToTheBeam) {
  for (const auto& [kind, jitter] : {std::pair(MeshKind::single, 0.0), std::pair(MeshKind::alternating, 0.0),
                                     std::pair(MeshKind::equilateral, 0.0), std::pair(MeshKind::single, 0.15)}) {
    std::vector<double> off;
    for (const int cells : {8, 16, 32}) off.push_back(std::abs(tipOverBeam(cells, kind, jitter) - 1));
    EXPECT_LT(off[2], 5e-3);
    EXPECT_GT(std::log2(off[0] / off[2]) / 2, 1.6);
  }
}

/// A moment at the end rolls a strip up: a circle, whose clamp and end know no boundary layer. (The faces of meshes
/// without lines along its axis are on no cylinder: equilateral ones are off by some per cent where cells are coarse.)
TEST(BendingTriangles, AMomentRollsAStripToACircle) {
  const double length = 0.2, width = 0.03, turn = std::numbers::pi;
  for (const MeshKind kind : {MeshKind::single, MeshKind::alternating}) {
    auto c = strip(BendingElements::midedge, 24, 3, length, width, isotropic(), kind);
    StructureOptions o = clamped(*c);
    const PatchEdge tip{0, Side::u1, false};
    o.moments = {{tip, kB * turn / length, 0}};
    const std::vector<int> end = c->sidePoints(tip);
    const Cloth* const cloth = c.get();
    const auto s = buildStructure(std::move(c), o);
    Vec3 x{};
    double least = 1e9, most = 0;
    const StaticReport r = solveStatic(*s, {.steps = 10}, [&](const StaticPoint& p) {
      const std::vector<Vec3> q = controlPoints(*s, p.y, p.factor);
      const std::vector<double> inner = innerValues(*s, p.y, p.factor);
      x = {};
      for (const int point : end) x += q[static_cast<std::size_t>(point)] / static_cast<double>(end.size());
      least = 1e9, most = 0;
      for (const auto& [patch, place] : cloth->lawPlaces()) {
        const double k = std::abs(cloth->stateAt({q, inner, {}}, patch, place).curvature_change.x) * length / turn;
        least = std::min(least, k), most = std::max(most, k);
      }
      return true;
    });
    ASSERT_TRUE(r.reached) << r.why;
    EXPECT_NEAR(least, 1, 0.005);
    EXPECT_NEAR(most, 1, 0.005);
    EXPECT_NEAR(x.x / length, 0, 0.002);
    EXPECT_NEAR(std::abs(x.z) / (2 * length / turn), 1, 0.002);
  }
}

/// Solves for the inner unknowns at given points, the committed history held.
void settle(const TriangleCloth& c, std::span<const Vec3> q, std::span<const double> committed,
            std::vector<double>& inner) {
  if (inner.empty()) return;
  const auto tangent = c.tangent();
  BlockMatrix K = tangent->sparsity();
  const int points = c.map().T.column_count, n = static_cast<int>(inner.size());
  ClothWork work;
  ForceTerms bending;
  bending.membrane = false;
  std::vector<Vec3> f(q.size());
  std::vector<double> g(inner.size());
  for (int round = 0; round < 30; ++round) {
    c.force({q, inner, committed}, {f, g, {}, nullptr}, work, bending);
    tangent->assemble({q, inner, committed}, work, K, bending);
    std::vector<Eigen::Triplet<double>> entries;
    for (int r = points; r < K.rows(); ++r)
      for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r + 1)]; ++k)
        for (int e = 0; e < 9; ++e) {
          const int a = 3 * (r - points) + e / 3, b = 3 * (K.columns[static_cast<std::size_t>(k)] - points) + e % 3;
          const double v = K.values[static_cast<std::size_t>(9 * k + e)];
          if (a >= n || b >= n || v == 0) continue;
          entries.emplace_back(a, b, v);
          if (a / 3 != b / 3) entries.emplace_back(b, a, v);
        }
    Eigen::SparseMatrix<double> A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(A);
    const Eigen::VectorXd d = solver.solve(Eigen::Map<const Eigen::VectorXd>(g.data(), n));
    double most = 0;
    for (int k = 0; k < n; ++k) inner[static_cast<std::size_t>(k)] += d(k), most = std::max(most, std::abs(d(k)));
    if (most < 1e-13) return;
  }
}

constexpr double kFirst = 7.6e-6, kLast = 2.6e-6, kSpan = 65.8;  ///< of Wong 2014, figure 4.7, in N m and 1/m

BendingLaw loopLaw() {
  const Stops<kStops> s = stopsOf<kStops>(curveOver(kFirst, kLast, kSpan));
  IsotropicHysteresisBending law;
  law.weft_Nm = law.warp_Nm = s.last_Nm;
  law.twist_Nm = 0.5 * s.last_Nm;
  law.shape = s.shape;
  law.first_Nm = {s.first_Nm, s.first_Nm, 0.5 * s.first_Nm};
  law.span_per_m = {s.span_per_m, s.span_per_m, s.span_per_m};
  return law;
}

/// B and 2HB as KES-FB2 reads them: the slope between 0.5 and 1.5/cm, and the width of the loop at 1/cm.
struct Kes {
  double B = 0, width = 0;
};

/// A sheet on a cylinder about an axis at an angle to its warp, to 2.5/cm, back and up again; moments of its inner
/// triangles about that axis.
Kes kesOf(BendingElements bending, MeshKind kind, double jitter, double degrees) {
  constexpr int cells = 10;
  constexpr double size = 0.01, inside = 0.25 * size;
  const auto c = strip(bending, cells, cells, size, size, loopLaw(), kind, jitter);
  const Vec2 d{std::cos(degrees * std::numbers::pi / 180), std::sin(degrees * std::numbers::pi / 180)};
  std::vector<double> committed(c->historySize()), trial = committed, inner(c->innerValues());
  std::vector<Vec3> f(c->rest().size());
  ClothWork work;
  const auto momentAt = [&](double k) {
    std::vector<Vec3> q;
    for (const Vec3& X : c->rest()) {
      const double s = d.x * (X.x - 0.5 * size) + d.y * (X.y - 0.5 * size),
                   t = -d.y * (X.x - 0.5 * size) + d.x * (X.y - 0.5 * size);
      const bool flat = std::abs(k) < 1e-9;
      const double a = flat ? s : std::sin(k * s) / k, z = flat ? 0 : (1 - std::cos(k * s)) / k;
      q.push_back({d.x * a - d.y * t, d.y * a + d.x * t, z});
    }
    settle(*c, q, committed, inner);
    c->force({q, inner, committed}, {f, {}, trial, nullptr}, work, {});
    double sum = 0, area = 0;
    const auto& triangles = c->elements().triangles();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      Vec3 middle{};
      for (const int p : triangles[i].corner) middle += c->rest()[static_cast<std::size_t>(p)] / 3;
      if (std::abs(middle.x - 0.5 * size) > inside || std::abs(middle.y - 0.5 * size) > inside) continue;
      const Vec3 m = c->elements().stateOf(static_cast<int>(i), {q, inner, committed}).m;
      sum += triangles[i].area_m2 * (d.x * d.x * m.x + d.y * d.y * m.y + 2 * d.x * d.y * m.z);
      area += triangles[i].area_m2;
    }
    committed = trial;
    return sum / area;
  };
  std::vector<double> way;
  for (int i = 0; i <= 10; ++i) way.push_back(25.0 * i);
  for (int i = 9; i >= -10; --i) way.push_back(25.0 * i);
  for (int i = -9; i <= 6; ++i) way.push_back(25.0 * i);
  std::vector<double> m;
  for (const double k : way) m.push_back(momentAt(k));
  const auto down = [&](int k) { return m[static_cast<std::size_t>(20 - k)]; };  // at 25 k
  const auto up = [&](int k) { return m[static_cast<std::size_t>(40 + k)]; };
  return {(up(6) - up(2)) / 100, up(4) - down(4)};
}

TEST(BendingTriangles, KesIsTheSameInAllDirections) {
  BentLine<kStops> line(stopsOf<kStops>(curveOver(kFirst, kLast, kSpan)));
  std::vector<double> m;
  for (const double k : {250.0, 100.0, -250.0, 50.0, 100.0, 150.0}) m.push_back(line.bend(k));
  const Kes exact{(m[5] - m[3]) / 100, m[4] - m[1]};
  for (const BendingElements bending : {BendingElements::midedge, BendingElements::triangle})
    for (const auto& [kind, jitter] : {std::pair(MeshKind::alternating, 0.0), std::pair(MeshKind::single, 0.15)})
      for (const double degrees : {0.0, 22.5, 45.0, 90.0}) {
        const Kes kes = kesOf(bending, kind, jitter, degrees);
        EXPECT_NEAR(kes.B / exact.B, 1, 0.02) << degrees;
        // Without unknowns of their own, edges of alternating meshes give each triangle another curvature.
        if (bending == BendingElements::midedge || kind == MeshKind::single) {
          EXPECT_NEAR(kes.width / exact.width, 1, 0.02) << degrees;
        }
      }
}

/// Curvature of a line on its way, from the moment: by bisection of copies, a line being its history.
double curvatureFor(BentLine<kStops>& line, double moment) {
  double low = -1e4, high = 1e4;
  for (int i = 0; i < 200; ++i) {
    auto tried = line;
    const double mid = 0.5 * (low + high);
    (tried.bend(mid) > moment ? high : low) = mid;
  }
  line.bend(0.5 * (low + high));
  return 0.5 * (low + high);
}

/// A moment at the end, up, down beyond zero, and up again, so small that the strip stays nearly flat.
TEST(BendingTriangles, AStripFollowsTheInverseOfItsLaw) {
  constexpr double length = 1e-4, largest_N = 3 * kFirst * 30;
  auto c = strip(BendingElements::midedge, 8, 2, length, 0.25 * length, loopLaw(), MeshKind::single);
  StructureOptions o = clamped(*c);
  o.moments = {{{0, Side::u1, false}, largest_N, 0}};
  o.programs = {{{0, 0.3, 0.8, 1}, {0, 1, -0.6, 0.5}}};
  const Cloth* const cloth = c.get();
  const Vec2 middle = c->placeOfDraft(0, {0.5, 0.4});
  const auto s = buildStructure(std::move(c), o);
  BentLine<kStops> line(stopsOf<kStops>(curveOver(kFirst, kLast, kSpan)));
  int looked = 0;
  double sign = 0, worst = 0;
  const StaticReport r = solveStatic(*s, {.steps = 40, .halvings = 8, .iterations = 30}, [&](const StaticPoint& p) {
    const double expected = curvatureFor(line, largest_N * o.programs[0](p.factor));
    const std::vector<Vec3> q = controlPoints(*s, p.y, p.factor);
    const std::vector<double> inner = innerValues(*s, p.y, p.factor);
    const double bent = cloth->stateAt({q, inner, p.history}, 0, middle).curvature_change.x;
    if (sign == 0) sign = bent > 0 ? 1 : -1;
    worst = std::max(worst, std::abs(sign * bent - expected));
    ++looked;
    return true;
  });
  EXPECT_LT(worst, 1e-6 * kSpan);
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_GE(looked, 40);
}

}  // namespace
}  // namespace gambeson
