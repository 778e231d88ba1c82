/// Cloths of different kinds as one say what each of them says.

#include <gtest/gtest.h>

#include "core/cloth/joined_cloth.hpp"
#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure.hpp"
#include "unit/core/cloth/triangles/triangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

std::unique_ptr<const Cloth> patchOfNurbs() {
  Fabric f = plainFabric();
  f.jam_area = 0;
  return std::make_unique<NurbsShell>(garmentOf({patchOf(uniformKnots(2, 3), uniformKnots(2, 4),
                                                         [](double a, double b) {
                                                           return Vec3{0.3 * a, 0.4 * b, 0};
                                                         })},
                                                {}, f));
}

std::unique_ptr<const Cloth> patchOfTriangles() {
  std::vector<MeshDraft> g{flatTriangles(4, 3, 0.4, 0.3, plainFabric(), MeshKind::equilateral, 0.1)};
  for (Vec3& x : g[0].mesh.vertices) x.z += 0.1;
  return std::make_unique<TriangleCloth>(std::move(g));
}

/// Shell inside, triangles outside.
struct Both {
  std::unique_ptr<const Cloth> inner = patchOfNurbs(), outer = patchOfTriangles();
  std::unique_ptr<const Cloth> joined;
  int split = inner->points();

  Both() {
    std::vector<std::unique_ptr<const Cloth>> parts;
    parts.push_back(patchOfNurbs());
    parts.push_back(patchOfTriangles());
    joined = std::make_unique<const JoinedCloth>(std::move(parts));
  }
  std::vector<Vec3> moved() const {
    std::vector<Vec3> q = joined->rest();
    for (std::size_t i = 0; i < q.size(); ++i)
      q[i] += 0.01 * Vec3{std::sin(3.0 * static_cast<double>(i)), std::cos(1.0 * static_cast<double>(i)),
                          std::sin(0.7 * static_cast<double>(i))};
    return q;
  }
};

TEST(JoinedCloth, ForcesAreThoseOfTheParts) {
  const Both b;
  const std::vector<Vec3> q = b.moved();
  const std::span<const Vec3> all(q), first = all.first(static_cast<std::size_t>(b.split)),
                                      second = all.subspan(static_cast<std::size_t>(b.split));
  std::vector<Vec3> f(q.size()), one(first.size()), two(second.size());
  ClothWork work, work1, work2;
  double e = 0, e1 = 0, e2 = 0;
  b.joined->force(q, f, work, &e);
  b.inner->force(first, one, work1, &e1);
  b.outer->force(second, two, work2, &e2);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_EQ(f[i], i < one.size() ? one[i] : two[i - one.size()]);
  EXPECT_EQ(e, e1 + e2);
  const auto K = b.joined->tangent();
  BlockMatrix joined = K->sparsity(), own = b.outer->tangent()->sparsity();
  K->assemble(q, work, joined);
  b.outer->tangent()->assemble(ClothState(second), work2, own);
  for (std::size_t k = 0; k < own.values.size(); ++k)
    EXPECT_EQ(joined.values[joined.values.size() - own.values.size() + k], own.values[k]);
}

TEST(JoinedCloth, SamplesPlacesAndStress) {
  const Both b;
  const std::vector<int> per_cell{2, 1};
  const Surface s = b.joined->surface(per_cell), inner = b.inner->surface(std::vector{2});
  ASSERT_EQ(b.joined->patches().size(), 2u);
  EXPECT_EQ(b.joined->patches()[1].garment, 1);
  EXPECT_EQ(s.size(), inner.size() + b.outer->points());
  std::vector<Vec3> x(static_cast<std::size_t>(s.size()));
  s.W.multiply<Vec3>(b.joined->rest(), x);
  for (int i = 0; i < s.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(s.patch[k], i < inner.size() ? 0 : 1);
    const PlaceRow row = b.joined->mounting().place(s.patch[k], s.parameters[k]);
    EXPECT_LT(norm(combine(row.columns, row.value, b.joined->rest()) - x[k]), 1e-14);
  }
  const std::vector<Vec3> q = b.moved();
  const auto view = b.joined->stress(), own = b.outer->stress();
  const auto means = view->means(q);
  EXPECT_EQ(means.size(), view->cells());
  const std::span<const Vec3> second = std::span<const Vec3>(q).subspan(static_cast<std::size_t>(b.split));
  const auto last = static_cast<std::size_t>(s.size() - 1);
  EXPECT_EQ(view->at(q, 1, s.parameters[last], means).principal1_N_per_m,
            own->at(second, 0, s.parameters[last], own->means(second)).principal1_N_per_m);
  EXPECT_EQ(b.joined->bulges(s, per_cell).of_sample.rows(), s.size());
  EXPECT_EQ(edgeSamples(s, {1, Side::u0, false}).size(), 5u);
  EXPECT_EQ(edgeSamples(s, {1, Side::u0, false})[0] >= inner.size(), true);
}

TEST(JoinedCloth, StrainRowsAndMasses) {
  const Both b;
  const std::vector<double> w(b.joined->map().home.size(), 1.0);
  const StrainRows rows = b.joined->strainRows({w, {}});
  const StrainRows outer = b.outer->strainRows({std::vector<double>(b.outer->map().home.size(), 1.0), {}});
  std::vector<Vec3> p, e;
  for (int home : b.joined->map().home) p.push_back(1.1 * b.joined->rest()[static_cast<std::size_t>(home)]);
  strainVectors(rows, p, e);
  for (const Vec3& d : e) EXPECT_NEAR(strainOf(d), 0.105, 1e-12);
  EXPECT_EQ(rows.points.back().patch, 1);
  std::vector<double> multiplier(static_cast<std::size_t>(rows.rows()), 0);
  multiplier.back() = 3;
  const std::vector<Vec2> field = limitStress(rows, multiplier);
  EXPECT_NEAR(b.joined->limitStressAt(rows, field, 1, outer.points.back().uv).y, 3 / outer.points.back().area_m2, 1e-9);
  EXPECT_EQ(b.joined->limitStressAt(rows, field, 0, {0.5, 0.5}).y, 0);
  double mass = 0, parts = 0;
  for (double m : b.joined->masses()) mass += m;
  for (double m : b.inner->masses()) parts += m;
  for (double m : b.outer->masses()) parts += m;
  EXPECT_NEAR(mass, parts, 1e-15);
}

// Both hang by an edge of their own, solved as one.
TEST(JoinedCloth, AStructureOfBoth) {
  const auto solve = [](std::unique_ptr<const Cloth> c, std::vector<int> patches) {
    StructureOptions o;
    const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int patch : patches)
      for (LinearConstraint& l : c->mounting().holdEdge({patch, Side::v1, false}, all, {}))
        o.constraints.push_back(std::move(l));
    o.dead = {{c->mounting().weightForce({0, -1, 0}), 0}};
    const auto s = buildStructure(std::move(c), o);
    double e = 0;
    const StaticReport r = solveStatic(*s, {.steps = 1}, [&](const StaticPoint& p) {
      e = strainEnergy(*s, p.y, p.factor);
      return true;
    });
    EXPECT_TRUE(r.reached) << r.why;
    return e;
  };
  std::vector<std::unique_ptr<const Cloth>> parts;
  parts.push_back(patchOfNurbs());
  parts.push_back(patchOfTriangles());
  const double both = solve(std::make_unique<JoinedCloth>(std::move(parts)), {0, 1});
  EXPECT_NEAR(both, solve(patchOfNurbs(), {0}) + solve(patchOfTriangles(), {0}), 1e-6 * both);
}

}  // namespace
}  // namespace gambeson
