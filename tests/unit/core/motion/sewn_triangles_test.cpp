/// Flat panels of triangles, sewn vertex to vertex: their meshes, and how they move.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>

#include "core/cloth/triangles/draft_mesh.hpp"
#include "core/cloth/triangles/sewn_mesh.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "core/error.hpp"
#include "core/motion/sewing.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

CutSheet sewnSheet(bool apart) {
  CutSheet sheet;
  sheet.hold = SeamHold::projected;
  sheet.apart = apart;
  return sheet;
}

std::shared_ptr<const Cloth> trianglesOf(const Garment& g, BendingElements bending = BendingElements::hinge) {
  MeshDraft draft = meshDraft(g, MeshKind::single);
  draft.bending = bending;
  return std::make_shared<TriangleCloth>(std::vector<MeshDraft>{std::move(draft)});
}

/// A square [-half, half]^2 without the wedge of this angle about the x axis, its tip in the middle; one panel.
Garment dartSheet(double half, double dart, int cells, double lean = 0) {
  Garment g = garmentOf({panelPatch(cells, cells, {-half, -half}, {half, half})}, {}, sheetFabric());
  const double up = half * std::tan(dart / 2 + lean), down = half * std::tan(dart / 2 - lean);
  g.trims.resize(1);
  g.trims[0].loops = {polygon(std::vector<Vec2>{
      {0, 0}, {half, up}, {half, half}, {-half, half}, {-half, -half}, {half, -half}, {half, -down}})};
  g.sewn_seams = {{{loopPart(g, 0, 0, 0)}, {loopPart(g, 0, 0, 6, true)}}};
  return g;
}

TEST(SewnTriangles, BothSidesOfASeamHaveAsManyVertices) {
  const Garment g = sewnSheet(false).garment(sheetFabric());
  const MeshDraft draft = meshDraft(g, MeshKind::single);
  ASSERT_GT(draft.ties.size(), 8u);
  std::array<std::set<int>, 2> seen;
  double length = 0;
  for (const MeshTie& tie : draft.ties) {
    EXPECT_EQ(tie.seam, 0);
    const Vec3 &a = draft.mesh.vertices[static_cast<std::size_t>(tie.vertex[0])],
               &b = draft.mesh.vertices[static_cast<std::size_t>(tie.vertex[1])];
    EXPECT_LT(norm(a - b), 1e-9);
    EXPECT_TRUE(seen[0].insert(tie.vertex[0]).second);
    EXPECT_TRUE(seen[1].insert(tie.vertex[1]).second);
    length += tie.length_m;
  }
  EXPECT_NEAR(length, lengthOf(g, g.sewn_seams[0].a), 1e-9);
  double area = 0;
  for (const auto& t : draft.mesh.triangles) {
    const auto at = [&](int k) {
      return draft.mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
    };
    area += 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
  }
  EXPECT_NEAR(area, 0.3 * 0.2, 1e-9);
}

/// Sides of unequal length, of more parts than one, with corners that lie over no corner.
TEST(SewnTriangles, VerticesLieAtEqualFractionsWhereNoCornerIsNear) {
  Garment g =
      garmentOf({panelPatch(10, 10, {0, 0}, {0.4, 0.4}), panelPatch(15, 10, {0, 1}, {0.6, 1.4})}, {}, sheetFabric());
  // The upper side of the first in two parts, 0.13 m and the rest, onto the lower one of the second, which is longer.
  g.sewn_seams = {{{sidePart(g, {0, Side::v1, false}, 0, 0.325), sidePart(g, {0, Side::v1, false}, 0.325, 1)},
                   {sidePart(g, {1, Side::v0, false})}}};
  const MeshDraft draft = meshDraft(g, MeshKind::single);
  ASSERT_GT(draft.ties.size(), 10u);
  bool corner = false;
  for (const MeshTie& tie : draft.ties) {
    const Vec3 &a = draft.mesh.vertices[static_cast<std::size_t>(tie.vertex[0])],
               &b = draft.mesh.vertices[static_cast<std::size_t>(tie.vertex[1])];
    EXPECT_NEAR(a.x / 0.4, b.x / 0.6, 1e-9);
    corner = corner || std::abs(a.x - 0.13) < 1e-9;
  }
  EXPECT_TRUE(corner);
  // Another seam, of a third of the second panel's other side: a part of an edge, cells of its own.
  g.patches.push_back(panelPatch(5, 5, {2, 0}, {2.2, 0.2}));
  g.patch_names.clear();
  g.weft.push_back(g.weft[0]);
  const double end = 0.2 / 0.6;
  g.sewn_seams.push_back({{sidePart(g, {1, Side::v1, false}, 0, end)}, {sidePart(g, {2, Side::v0, false})}});
  const MeshDraft more = meshDraft(g, MeshKind::single);
  int of_second = 0;
  for (const MeshTie& tie : more.ties) of_second += tie.seam == 1;
  EXPECT_EQ(of_second, 6);
}

TEST(SewnTriangles, RefusesWhatItCannotSew) {
  CutSheet sheet = sewnSheet(false);
  sheet.hold = SeamHold::weak;
  EXPECT_THROW(meshDraft(sheet.garment(sheetFabric()), MeshKind::single), InputError);
  sheet = sewnSheet(false);
  sheet.stiffness_N = -1e-3;
  EXPECT_THROW(meshDraft(sheet.garment(sheetFabric()), MeshKind::single), InputError);
  EXPECT_THROW(meshDraft(sewnSheet(false).garment(sheetFabric()), MeshKind::equilateral), InputError);
  Garment g = sewnSheet(false).garment(sheetFabric());
  g.patches[0].points[5].z += 0.01;
  EXPECT_THROW(meshDraft(g, MeshKind::single), InputError);
  g = sewnSheet(false).garment(sheetFabric());
  g.sewn_seams[0].b = g.sewn_seams[0].a;
  EXPECT_THROW(meshDraft(g, MeshKind::single), InputError);
}

double stableStep(Motion& m) {
  State s = m.state;
  return 2 / largestFrequency(*m.model, m.stage, s, 80, m.work).largest_rad_per_s;
}

/// Free panels that lie apart at rest start where they are placed.
Motion placedMotion(const Garment& g, const Environment& e) {
  ModelOptions o;
  o.self_contact = false;
  const std::shared_ptr<const Cloth> cloth = trianglesOf(g);
  Motion m(cloth, e, {}, o);
  std::vector<Vec3> moved;
  for (std::size_t p = 0; p < g.patches.size(); ++p)
    for (std::size_t i = 0; i < g.patches[p].points.size(); ++i)
      moved.push_back(g.placed[p][i] - g.patches[p].points[i]);
  const std::vector<Vec3> by = cloth->fromDraft(moved);
  for (int i = 0; i < m.model->freeCount(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    m.state.p[at] += by[static_cast<std::size_t>(cloth->map().home[at])];
  }
  m.restart();
  return m;
}

void expectMomentaAndStep(double stiffness_N) {
  CutSheet sheet = sewnSheet(true);
  sheet.stiffness_N = stiffness_N;
  const Garment g = sheet.garment(sheetFabric());
  Motion m = placedMotion(g, {{0, 0, 0}, 0});
  Garment unsewn = g;
  for (SewnSeam& seam : unsewn.sewn_seams) seam.hold = SeamHold::open;
  Motion open = placedMotion(unsewn, {{0, 0, 0}, 0});
  EXPECT_TRUE(open.model->sewing.empty());
  const double dt = 0.4 * stableStep(m);
  EXPECT_GT(stableStep(m), 0.95 * stableStep(open));
  for (std::size_t i = 0; i < m.state.v.size(); ++i) {
    const Vec3 x = m.state.p[i] / 0.3;
    m.state.v[i] = Vec3{0.3 * x.y, 0.4 * std::sin(3 * x.x), 0.8 * std::cos(5 * x.x) * x.y} + Vec3{0.2, 0.1, -0.1};
  }
  m.step(dt);
  const auto momenta = [&](Vec3& linear, Vec3& angular, double& size) {
    linear = angular = {};
    size = 0;
    for (std::size_t i = 0; i < m.state.v.size(); ++i) {
      const Vec3 p = m.model->mass_kg[i] * m.state.v[i];
      linear += p, angular += cross(m.state.p[i], p), size += norm(p);
    }
  };
  Vec3 l0, a0, l1, a1;
  double size = 0, gap = 0;
  momenta(l0, a0, size);
  for (int k = 0; k < 400; ++k) {
    ASSERT_EQ(m.step(dt).failure, StepFailure::none);
    gap = std::max(gap, widestGap(*m.model, m.state.p));
  }
  momenta(l1, a1, size);
  EXPECT_LT(norm(l1 - l0), 1e-9 * size);
  EXPECT_LT(norm(a1 - a0), 1e-9 * 0.3 * size);
  EXPECT_LT(gap, 1e-9);
}

TEST(SewnTriangles, AFreeSheetKeepsItsMomentaAndItsStep) {
  for (const double stiffness_N : {0.0, 1e-3}) expectMomentaAndStep(stiffness_N);
}

/// The same triangles in one piece: vertices that a seam ties are one vertex.
MeshDraft welded(MeshDraft draft) {
  std::vector<int> to(draft.mesh.vertices.size());
  std::iota(to.begin(), to.end(), 0);
  for (const MeshTie& tie : draft.ties) to[static_cast<std::size_t>(tie.vertex[1])] = tie.vertex[0];
  for (auto& t : draft.mesh.triangles)
    for (int& v : t) v = to[static_cast<std::size_t>(v)];
  std::vector<int> number(to.size(), -1);
  std::vector<Vec3> vertices;
  for (auto& t : draft.mesh.triangles)
    for (int& v : t) {
      int& n = number[static_cast<std::size_t>(v)];
      if (n < 0)
        n = static_cast<int>(vertices.size()), vertices.push_back(draft.mesh.vertices[static_cast<std::size_t>(v)]);
      v = n;
    }
  MeshDraft one;
  one.mesh = {vertices,      {"whole"}, draft.mesh.triangles, std::vector<int>(draft.mesh.triangles.size(), 0),
              draft.mesh.uv, {}};
  one.fabrics = draft.fabrics;
  one.bending = draft.bending;
  return one;
}

/// The free edge of a sheet that swings down from its held edge, sewn and in one piece, as parts of its way. The seam
/// is so much stiffer than a cell of the cloth. `own`: the sheet in one piece has vertices of its own masses, where
/// those of sewn panels bear 0.3 of a whole one's at least, corners of the sheet as well.
double swingError(int cells, double stiffer, BendingElements bending, bool own) {
  CutSheet sheet = sewnSheet(false);
  sheet.cells = cells;
  sheet.stiffness_N = stiffer * 2e-4 / (sheet.width / cells);
  Fabric fabric = sheetFabric();
  fabric.law = LinearBending{{2e-4, 2e-4}};
  MeshDraft draft = meshDraft(sheet.garment(fabric), MeshKind::single);
  draft.bending = bending;
  const Environment e{{0, 0, -9.81}, 0.1};
  const auto motionOf = [&](MeshDraft of) {
    ModelOptions o;
    o.self_contact = false;
    const auto cloth = std::make_shared<TriangleCloth>(std::vector<MeshDraft>{std::move(of)});
    for (int i = 0; i < cloth->points(); ++i)
      if (std::abs(cloth->rest()[static_cast<std::size_t>(i)].x) < 1e-9) o.held_control_points.push_back(i);
    return Motion(cloth, e, {}, o);
  };
  Motion sewn = motionOf(draft), whole = motionOf(welded(draft));
  const auto restOf = [](const Motion& m, int i) {
    return m.model->cloth->rest()[static_cast<std::size_t>(m.model->cloth->map().home[static_cast<std::size_t>(i)])];
  };
  for (int i = 0; i < whole.model->freeCount() && !own; ++i) {
    double& mass = whole.model->mass_kg[static_cast<std::size_t>(i)];
    mass = 0;
    for (int k = 0; k < sewn.model->freeCount(); ++k)
      if (norm(restOf(whole, i) - restOf(sewn, k)) < 1e-9) mass += sewn.model->mass_kg[static_cast<std::size_t>(k)];
  }
  const auto edge = [&](const Motion& m) {  // the far corners
    std::array<Vec3, 2> at;
    for (int i = 0; i < m.model->freeCount(); ++i) {
      const Vec3 x = restOf(m, i);
      for (const std::size_t k : {0, 1})
        if (norm(x - Vec3{sheet.length, static_cast<double>(k) * sheet.width, 0}) < 1e-9)
          at[k] = m.state.p[static_cast<std::size_t>(i)];
    }
    return at;
  };
  const std::array<Vec3, 2> start = edge(whole);
  const double seconds = 0.25, dt = 0.5 * std::min(stableStep(sewn), stableStep(whole));
  const int steps = static_cast<int>(std::ceil(seconds / dt));
  double error = 0, way = 0;
  for (int k = 1; k <= steps; ++k) {
    EXPECT_EQ(sewn.step(seconds / steps).failure, StepFailure::none);
    EXPECT_EQ(whole.step(seconds / steps).failure, StepFailure::none);
    const std::array<Vec3, 2> a = edge(sewn), b = edge(whole);
    for (const std::size_t c : {0, 1})
      error = std::max(error, norm(a[c] - b[c])), way = std::max(way, norm(b[c] - start[c]));
  }
  std::printf("swing, %d cells, spring %g times a cell%s: edge goes %.4f m, off by %.2f %%; %d steps\n", cells, stiffer,
              own ? "" : ", masses of the sewn", way, 100 * error / way, steps);
  return error / way;
}

/// The cloth here is stiff for its weight. Without a spring what its own bending does across the seam is missing.
TEST(SewnTriangles, ASheetCutByAnSSwingsLikeTheWholeOne) {
  for (const int cells : {8, 16}) {
    EXPECT_LT(swingError(cells, 20, BendingElements::hinge, true), 0.01);
    EXPECT_LT(swingError(cells, 20, BendingElements::midedge, false), 0.005);
  }
  EXPECT_GT(swingError(8, 0, BendingElements::hinge, true), 0.01);
  EXPECT_GT(swingError(8, 0, BendingElements::midedge, false), 0.01);
}

/// A strip of two panels, folded about their seam: the energy of the spring and of the cloth beside it, in a row.
TEST(SewnTriangles, ASpringAndTheClothBesideItBendInARow) {
  Fabric fabric = sheetFabric();
  fabric.law = LinearBending{{2e-4, 2e-4, 2e-4}};
  Garment g = garmentOf({panelPatch(6, 4, {0, 0}, {0.3, 0.2}), panelPatch(6, 4, {0, 1}, {0.3, 1.2})}, {}, fabric);
  g.sewn_seams = {{{sidePart(g, {0, Side::v1, false})}, {sidePart(g, {1, Side::v0, false})}}};
  g.sewn_seams[0].rest_angle_rad = 0.2;
  for (const double stiffness_N : {1e-4, 1e-2, 1e6}) {
    g.sewn_seams[0].stiffness_N = stiffness_N;
    const std::shared_ptr<const Cloth> cloth = trianglesOf(g);
    const auto& triangles = dynamic_cast<const TriangleCloth&>(*cloth).elements();
    for (const double fold : {0.1, 0.2, 0.5}) {
      std::vector<Vec3> q = cloth->rest();
      for (Vec3& x : q)
        if (x.y > 0.5) x = Vec3{x.x, 0.2, 0} + rotationAbout({1, 0, 0}, fold) * Vec3{0, x.y - 1, 0};
      double expected = 0;
      for (const SeamHinge& hinge : triangles.seamSprings().hinges()) {
        const HingePoint& h = hinge.points;
        double apex = 0;  // the heights of both triangles, from the derivatives into them
        for (std::size_t k = 0; k < h.columns.size(); ++k)
          if (h.t[k] == 0) apex += 1 / (h.a[k] + h.b[k]);
        double length = 0;
        for (std::size_t k = 0; k < h.columns.size(); ++k)
          length += h.t[k] * cloth->rest()[static_cast<std::size_t>(h.columns[k])].x;
        const double turn = fold - 0.2;
        expected += 0.5 * turn * turn * std::abs(length) / (1 / stiffness_N + apex / (2 * 2e-4));
      }
      std::vector<Vec3> f(q.size());
      ClothWork work;
      ClothEnergy energy;
      cloth->force(ClothState(q), {f, {}, {}, &energy}, work, {});
      EXPECT_GT(expected + (fold == 0.2), 1e-9);
      EXPECT_NEAR(energy.stored, expected, 1e-9 * expected + 1e-15) << stiffness_N << " " << fold;
    }
  }
}

/// Of points, and of what edges turn where triangles bend by tensors.
void expectGradientAndTangent(BendingElements bending) {
  CutSheet sheet = sewnSheet(false);
  sheet.cells = 4;
  sheet.stiffness_N = 0.02;
  Fabric fabric = sheetFabric();
  fabric.law = LinearBending{{2e-4, 2e-4}};
  Garment g = sheet.garment(fabric);
  g.sewn_seams[0].rest_angle_rad = 0.4;
  const std::shared_ptr<const Cloth> cloth = trianglesOf(g, bending);
  std::vector<Vec3> q = cloth->rest();
  std::vector<double> inner(cloth->innerValues());
  const auto wave = [](double rate, std::size_t i) { return std::sin(rate * static_cast<double>(i) + 1); };
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += 0.01 * Vec3{wave(7, i), wave(5, i), wave(3, i)};
  for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = 0.1 * wave(4, i);
  const auto value = [&](std::size_t i) -> double& {
    return i < 3 * q.size() ? q[i / 3][static_cast<int>(i % 3)] : inner[i - 3 * q.size()];
  };
  const std::size_t values = 3 * q.size() + inner.size();
  ForceTerms terms;
  terms.membrane = terms.bending = false;
  const auto at = [&](std::vector<double>& f) {
    std::vector<Vec3> points(q.size());
    std::vector<double> turns(inner.size());
    ClothWork work;
    ClothEnergy energy;
    cloth->force(ClothState(q, inner, {}), {points, turns, {}, &energy}, work, terms);
    f.clear();
    for (const Vec3& x : points) f.insert(f.end(), {x.x, x.y, x.z});
    f.insert(f.end(), turns.begin(), turns.end());
    return energy.stored;
  };
  std::vector<double> f, high, low;
  at(f);
  double size = 0, of_turns = 0;
  for (std::size_t i = 0; i < values; ++i)
    (i < 3 * q.size() ? size : of_turns) = std::max(i < 3 * q.size() ? size : of_turns, std::abs(f[i]));
  ASSERT_GT(size, 1e-4);
  EXPECT_EQ(of_turns > 0, bending == BendingElements::midedge);
  const std::unique_ptr<ClothTangent> tangent = cloth->tangent();
  BlockMatrix K;
  ClothWork work;
  tangent->assemble(ClothState(q, inner, {}), work, K, terms);
  const auto placeOf = [&](std::size_t i) {
    const bool point = i < 3 * q.size();
    const std::size_t k = point ? i : i - 3 * q.size();
    return std::pair(point ? cloth->map().T.columns[k / 3] : cloth->map().T.column_count + static_cast<int>(k / 3),
                     k % 3);
  };
  const double h = 1e-6;
  double stiffest = 0, off = 0;
  for (std::size_t i = 0; i < values; ++i) {
    const double was = value(i);
    value(i) = was + h;
    const double up = at(high);
    value(i) = was - h;
    const double down = at(low);
    value(i) = was;
    EXPECT_NEAR(f[i], -(up - down) / (2 * h), 1e-6 * size);
    const auto [row, d] = placeOf(i);
    for (std::size_t k = 0; k < values; ++k) {
      const auto [column, e] = placeOf(k);
      if (column < row) continue;  // the upper half is kept
      const double numeric = -(high[k] - low[k]) / (2 * h);
      const long block = K.find(row, column);
      const double exact = block < 0 ? 0 : K.values[static_cast<std::size_t>(9 * block) + 3 * d + e];
      stiffest = std::max(stiffest, std::abs(numeric)), off = std::max(off, std::abs(numeric - exact));
    }
  }
  EXPECT_GT(stiffest, 1e-2);
  EXPECT_LT(off, 1e-6 * stiffest);
}

TEST(SewnTriangles, ForceOfSpringsIsTheGradientOfTheirEnergyAndTheTangentItsOwn) {
  for (const BendingElements bending : {BendingElements::hinge, BendingElements::midedge})
    expectGradientAndTangent(bending);
}

/// Once closed, both vertices of a pair are one point, which moves as rows would have both move.
TEST(SewnTriangles, ClosedSeamsMoveAsRowsDo) {
  CutSheet sheet = sewnSheet(false);
  sheet.stiffness_N = 1e-3;
  const Garment g = sheet.garment(sheetFabric());
  MeshDraft draft = meshDraft(g, MeshKind::single);
  const auto rows = std::make_shared<TriangleCloth>(std::vector<MeshDraft>{draft});
  draft.closed = true;
  const auto closed = std::make_shared<TriangleCloth>(std::vector<MeshDraft>{draft});
  EXPECT_TRUE(closed->sewnRows().empty());
  EXPECT_EQ(closed->points(), rows->points());
  EXPECT_EQ(closed->map().T.column_count + rows->sewnRows().rows(), rows->map().T.column_count);
  EXPECT_TRUE(closed->surface({}).twins.empty());
  EXPECT_EQ(rows->surface({}).twins.size(), draft.ties.size());
  ModelOptions o;
  o.self_contact = false;
  Motion a(rows, {{0, 0, -9.81}, 0.1}, {}, o), b(closed, {{0, 0, -9.81}, 0.1}, {}, o);
  const auto whirl = [](Motion& m) {
    for (std::size_t i = 0; i < m.state.v.size(); ++i) {
      const Vec3 x = m.state.p[i] / 0.3;
      m.state.v[i] = {0.3 * x.y, 0.4 * std::sin(3 * x.x), 0.8 * std::cos(5 * x.x) * x.y};
    }
    m.restart();
  };
  whirl(a), whirl(b);
  const double dt = 0.4 * stableStep(a);
  for (int k = 0; k < 100; ++k) {
    ASSERT_EQ(a.step(dt).failure, StepFailure::none);
    ASSERT_EQ(b.step(dt).failure, StepFailure::none);
  }
  double off = 0, way = 0;
  for (int i = 0; i < rows->points(); ++i) {
    const auto at = [&](const Motion& m) {
      return m.state.p[static_cast<std::size_t>(m.model->cloth->map().T.columns[static_cast<std::size_t>(i)])];
    };
    off = std::max(off, norm(at(a) - at(b)));
    way = std::max(way, norm(at(b) - rows->rest()[static_cast<std::size_t>(i)]));
  }
  EXPECT_GT(way, 1e-3);
  EXPECT_LT(off, 1e-9);
}

/// A dart closes to a cone, whichever way its legs lean on the grid: nothing gapes, and no cell stretches.
TEST(SewnTriangles, DartsThatLeanClose) {
  for (const double lean : {0.0, 0.1}) {
    ModelOptions o;
    o.self_contact = false;
    Motion m(trianglesOf(dartSheet(0.1, 0.3, 12, lean)), {{0, 0, 0}, 0}, {}, o);
    m.model->sewing_options = {15, 0.5};
    for (std::size_t i = 0; i < m.model->mass_kg.size(); ++i) {
      m.model->drag_kg_per_s[i] = 20 * m.model->mass_kg[i];
      m.state.p[i].z += 0.2 * norm(m.state.p[i]);  // a cone already, or it would crumple
    }
    m.restart();
    const double dt = 0.5 * stableStep(m);
    for (double t = 0; t < 1; t += dt) ASSERT_EQ(m.step(dt).failure, StepFailure::none);
    EXPECT_LT(widestGap(*m.model, m.state.p), 1e-4) << lean;
    const Cloth& cloth = *m.model->cloth;
    double longest = 0;
    for (const NetEdge& e : cloth.net()) {
      const auto at = [&](int i) {
        return m.state.p[static_cast<std::size_t>(cloth.map().T.columns[static_cast<std::size_t>(i)])];
      };
      longest = std::max(longest, std::abs(norm(at(e.first) - at(e.second)) * std::sqrt(e.per_length2) - 1));
    }
    std::printf("dart that leans by %g: gap %.1e cells, strain %.2e\n", lean, widestGap(*m.model, m.state.p), longest);
    EXPECT_LT(longest, 0.02);
  }
}

}  // namespace
}  // namespace gambeson
