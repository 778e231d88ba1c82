// Cloth sewn of flat panels at rest: weak seams and springs against sheets in one piece and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/cloth/patches/patch_loads.hpp"
#include "core/cloth/patches/patch_supports.hpp"
#include "core/cloth/shell/weak_seam.hpp"
#include "core/error.hpp"
#include "core/motion/structure_motion.hpp"
#include "core/statics/statics.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Fabric linen() {
  Fabric f;
  f.thickness_m = 5e-4;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = f.young_warp_Pa = 2e6;
  f.poisson = 0.3;
  f.shear_Pa = 2e6 / 2.6;
  f.law = LinearBending{{5e-5, 5e-5, 5e-5}};
  return f;
}

enum class Load { pull, hang, drape };

/// Where the points of the far edge go.
std::vector<Vec3> edgeOf(const Garment& g, int far_patch, double length, double width, Load load) {
  StructureOptions o;
  o.constraints = supportEdge(g, {0, Side::u0}, axes);
  const auto clamp = clampRotation(g, {0, Side::u0});
  o.constraints.insert(o.constraints.end(), clamp.begin(), clamp.end());
  if (load == Load::pull)
    o.dead = {{edgeForce(g, {far_patch, Side::u1}, {20, 4, 0}), 0}};
  else
    o.dead = {{weightForce(g, load == Load::hang ? Vec3{400, 0, 0} : Vec3{0, 0, -0.05}), 0}};
  const auto s = buildStructure(g, o);
  StaticOptions so;
  so.steps = load == Load::drape ? 4 : 1;
  std::vector<double> y;
  const StaticReport r = solveStatic(*s, so, [&](const StaticPoint& p) { return y = p.y, true; });
  EXPECT_TRUE(r.reached) << r.why;
  const std::vector<Vec3> q = controlPoints(*s, y, 1);
  std::vector<Vec3> out;
  for (const double v : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
    out.push_back(pointOf(g, far_patch, {length, v * width}, q) - Vec3{length, v * width, 0});
  return out;
}

TEST(SewnShell, ASheetCutByAnSHangsAndPullsLikeTheWholeOne) {
  for (const Load load : {Load::pull, Load::hang, Load::drape}) {
    std::vector<double> error;
    for (const int cells : {8, 16}) {
      CutSheet sheet;
      sheet.cells = cells;
      // Pressed open: it bends as the cloth does, but for a twentieth of a cell.
      sheet.stiffness_N = 20 * 5e-5 / (sheet.width / cells);
      const auto sewn = edgeOf(sheet.garment(linen()), 1, sheet.length, sheet.width, load);
      const auto whole = edgeOf(sheet.whole(linen(), cells), 0, sheet.length, sheet.width, load);
      double most = 0, off = 0;
      for (std::size_t k = 0; k < sewn.size(); ++k) {
        most = std::max(most, norm(whole[k]));
        off = std::max(off, norm(sewn[k] - whole[k]));
      }
      error.push_back(off / most);
      std::printf("load %d, %d cells: edge goes %.5f m, off by %.3f %%\n", static_cast<int>(load), cells, most,
                  100 * error.back());
    }
    EXPECT_LT(error[0], 0.01);
    EXPECT_LT(error[1], 0.6 * error[0] + 1e-3);
  }
}

TEST(SewnShell, ForceOfSeamsIsTheGradientOfTheirEnergy) {
  CutSheet sheet;
  sheet.cells = 4;
  sheet.stiffness_N = 0.02;
  sheet.apart = true;
  Garment g = sheet.garment(linen());
  g.sewn_seams[0].rest_angle_rad = 0.5;
  g.sewn_seams[0].factor = 0.1;
  const WeakPoints points{weakSewnRows(g), buildSewnHinges(g)};
  ASSERT_FALSE(points.gaps.empty());
  std::vector<Vec3> q = g.placed[0];
  q.insert(q.end(), g.placed[1].begin(), g.placed[1].end());
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] += 0.01 * Vec3{std::sin(40 * q[i].y), std::cos(30 * q[i].x), std::sin(25 * q[i].x + 20 * q[i].y)};
  std::vector<Vec3> f(q.size()), scratch(q.size());
  addWeakForce(points, q, f);
  double size = 0;
  for (const Vec3& v : f) size = std::max(size, norm(v));
  for (std::size_t i = 0; i < q.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      auto plus = q, minus = q;
      plus[i][axis] += 1e-6, minus[i][axis] -= 1e-6;
      EXPECT_NEAR(f[i][axis], -(addWeakForce(points, plus, scratch) - addWeakForce(points, minus, scratch)) / 2e-6,
                  1e-6 * size);
    }
  // Sewn, turned and shifted: nothing but the rest angle.
  Garment flat = sheet.garment(linen());
  const WeakPoints none{weakSewnRows(flat), buildSewnHinges(flat)};
  std::vector<Vec3> x = flat.placed[0];
  x.insert(x.end(), flat.placed[1].begin(), flat.placed[1].end());
  for (Vec3& p : x) p = rotationAbout(normalized(Vec3{1, 2, 3}), 2.5) * p + Vec3{3, -1, 2};
  EXPECT_LT(addWeakForce(none, x, scratch), 1e-15);
}

/// A cylinder sewn of one flat panel, its seam opposite the line x = 0, z = 0.
TEST(SewnShell, ACylinderOfOnePanelHasTheMomentOfABentPlate) {
  const double radius = 0.1, length = 2 * kPi * radius, width = 0.15;
  for (const int cells : {12, 24}) {
    Garment g = garmentOf({panelPatch(cells, 4, {-length / 2, 0}, {length / 2, width})}, {}, linen());
    SewnSeam seam{{sidePart(g, {0, Side::u0})}, {sidePart(g, {0, Side::u1})}, SeamHold::weak};
    seam.stiffness_N = 1e3 * 5e-5 / (length / cells);
    g.sewn_seams = {seam};
    // A rigid body's six motions: the line that touches z = 0 stays where it is.
    StructureOptions o;
    const auto hold = [&](double u, double v, const std::vector<Vec3>& along) {
      const auto more = supportPoint(g, 0, {u, v}, along);
      o.constraints.insert(o.constraints.end(), more.begin(), more.end());
    };
    hold(0, width / 2, axes);
    hold(0, width, {{1, 0, 0}, {0, 0, 1}});
    LinearConstraint level;
    level.name = "level";
    for (const double side : {-1.0, 1.0}) {
      const SurfaceBasis b = surfaceBasis(g.patches[0], side * 0.1 * length, width / 2);
      for (std::size_t k = 0; k < b.columns.size(); ++k)
        level.terms.push_back({b.columns[k], {0, 0, side * b.values[0][k]}});
    }
    o.constraints.push_back(level);
    const auto s = buildStructure(g, o);
    // Rolled up: control points of a polygon about the circle.
    std::vector<double> y(s->dofs.unknowns());
    const std::vector<Vec3>& rest = s->cloth->rest();
    for (int j = 0; j < s->dofs.unknowns(); ++j) {
      const int c = s->dofs.component[j], point = s->cloth->map().home[c / 3];
      const Vec3 X = rest[point];
      const Vec3 x{radius * std::sin(X.x / radius), X.y, radius * (1 - std::cos(X.x / radius))};
      y[j] = (x - X)[c % 3];
    }
    std::vector<double> found;
    const StaticReport r = solveStatic(
        *s, {.steps = 1}, [&](const StaticPoint& p) { return found = p.y, p.negative_pivots == 0; }, y);
    ASSERT_FALSE(found.empty()) << r.why;
    const std::vector<Vec3> q = controlPoints(*s, found, 0);
    double worst = 0, mean = 0, count = 0;
    const NurbsShell& shell = shellOf(*s);
    for (const auto& [patch, uv] : shell.lawPlaces()) {
      if (uv.y < 0.3 * width || uv.y > 0.7 * width) continue;  // free edges bend the other way (anticlastic)
      const double m = std::abs(shell.stateAt(ClothState(q), patch, uv).m.x) * radius / 5e-5;
      worst = std::max(worst, std::abs(m - 1)), mean += m, count += 1;
    }
    std::printf("cylinder, %d cells: moment over B/R %.5f, at worst off by %.3f %%\n", cells, mean / count,
                100 * worst);
    EXPECT_NEAR(mean / count, 1, 0.01);
    EXPECT_LT(worst, cells == 12 ? 0.04 : 0.01);
  }
}

TEST(SewnShell, StaticsAndImplicitStepsAskForWeakSeams) {
  CutSheet sheet;
  sheet.hold = SeamHold::projected;
  const Garment g = sheet.garment(linen());
  StructureOptions o;
  o.constraints = supportEdge(g, {0, Side::u0}, axes);
  const auto s = buildStructure(g, o);
  EXPECT_THROW(solveStatic(*s, {}, [](const StaticPoint&) { return true; }), InputError);
  EXPECT_NO_THROW(untouchedModel(*s));
  EXPECT_THROW(untouchedModel(*s, {.mode = LimitMode::upper_limit, .limit = 0.01}), InputError);
}

}  // namespace
}  // namespace gambeson
