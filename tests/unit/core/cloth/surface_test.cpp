// Surface samples: rows of W, rank, consistent areas, and what must agree between samples and nodes (ARCHITECTURE, "One
// small interface for every cloth").
#include "core/cloth/patches/surface.hpp"
#include "core/cloth/draft/areas.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Eigen::MatrixXd dense(const SparseRows& rows) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows.rows(), rows.column_count);
  for (int r = 0; r < rows.rows(); ++r)
    for (int k = rows.offsets[r]; k < rows.offsets[r + 1]; ++k) m(r, rows.columns[k]) += rows.values[k];
  return m;
}

std::vector<double> unevenEnds() { return {0, 0.02, 0.1, 0.15, 0.5, 0.95, 1}; }

struct Case {
  std::string name;
  Garment garment;
  std::vector<int> works, negative = {}, blind = {};  ///< samples per cell: fine, refused for a negative area, too few
};

/// Degree, rational or not, even and uneven knots, one and four patches, both kinds of seam, corners of 3 to 5. The
/// Greville points (0) leave no choice, and their areas turn negative where neighbouring cells or weights differ much;
/// 2 and 3 per cell give positive areas but for degree 3 on cells that jump seven- and ninefold (0.05, 0.35, 0.45,
/// 0.05).
std::vector<Case> zoo() {
  std::vector<Case> z;
  using List = std::vector<int>;
  for (int p : {2, 3}) {
    const std::string degree = "degree " + std::to_string(p) + " ";
    // A patch of one cell has 3 samples across at 2 per cell: too few for degree 3.
    const List cut = p == 2 ? List{0, 2, 3} : List{0, 3}, blind = p == 2 ? List{} : List{2};
    for (bool rational : {false, true}) {
      const std::string kind = degree + (rational ? "rational " : "");
      z.push_back({kind + "one", garmentOf({curvedPatch(p, p, rational)}, {}, plainFabric()),
                   rational ? List{2, 3} : List{0, 2, 3}, rational ? List{0} : List{}});
      z.push_back({kind + "four G1", fourPatches(p, p, rational, SeamKind::G1, 0, plainFabric()), cut, {}, blind});
      z.push_back({kind + "four C0", fourPatches(p, p, rational, SeamKind::C0, 1, plainFabric()), cut, {}, blind});
    }
    z.push_back({degree + "even",
                 garmentOf({flatPatch(uniformKnots(p, 6), uniformKnots(p, 5), 1, 1)}, {}, plainFabric()),
                 {0, 2, 3}});
    z.push_back(
        {degree + "growing",
         garmentOf({flatPatch(knotsAt(p, {0, 1, 2.5, 4.75, 8.1, 13.2}), uniformKnots(p, 4), 1, 1)}, {}, plainFabric()),
         {0, 2, 3}});
    z.push_back({degree + "uneven",
                 garmentOf({flatPatch(knotsAt(p, unevenEnds()), uniformKnots(p, 4), 1, 1)}, {}, plainFabric()),
                 p == 2 ? List{2, 3} : List{4}, p == 2 ? List{0} : List{0, 2, 3}});
  }
  for (int n : {3, 4, 5})
    for (SeamKind kind : {SeamKind::G1, SeamKind::C0}) {
      const bool hard = n != 4 && kind == SeamKind::G1;
      z.push_back({"star " + std::to_string(n) + (kind == SeamKind::G1 ? " G1" : " C0"), star(n, kind, plainFabric()),
                   hard ? List{2, 3} : List{0, 2, 3}, hard ? List{0} : List{}});
    }
  return z;
}

std::vector<double> freeAreas(const Garment& g, const FreeMap& map) {
  std::vector<double> a(map.home.size());
  map.Tt.multiply<double>(controlAreas(g), a);
  return a;
}

TEST(Surface, RowsSumToOneAndSeeEveryFreePoint) {
  for (const auto& [name, g, works, negative, blind] : zoo())
    for (int per_cell : works) {
      SCOPED_TRACE(name + ", " + std::to_string(per_cell) + " per cell");
      const FreeMap map = buildFreeMap(g);
      Surface s;
      ASSERT_NO_THROW(s = buildSurface(g, map, per_cell));
      const Eigen::MatrixXd W = dense(s.W), WT = dense(s.WT);
      EXPECT_LT((W.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
      EXPECT_LT((WT.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
      EXPECT_LT((WT - W * dense(map.T)).cwiseAbs().maxCoeff(), 1e-15);
      EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(WT).rank(), WT.cols());
      EXPECT_LT((dense(s.WTt) - WT.transpose()).cwiseAbs().maxCoeff(), 1e-300);
    }
}

TEST(Surface, AreasArePositiveAndConsistent) {
  for (const auto& [name, g, works, negative, blind] : zoo())
    for (int per_cell : works) {
      SCOPED_TRACE(name + ", " + std::to_string(per_cell) + " per cell");
      const FreeMap map = buildFreeMap(g);
      Surface s;
      ASSERT_NO_THROW(s = buildSurface(g, map, per_cell));
      const Eigen::Map<const Eigen::VectorXd> a(s.area_m2.data(), s.size());
      const std::vector<double> A = freeAreas(g, map);
      const Eigen::Map<const Eigen::VectorXd> expected(A.data(), static_cast<long>(A.size()));
      const Eigen::MatrixXd WT = dense(s.WT);
      EXPECT_GT(a.minCoeff(), 0);
      EXPECT_LT((WT.transpose() * a - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
      // The minimum-norm solution lies in the range of W T.
      const Eigen::VectorXd y = WT.colPivHouseholderQr().solve(a);
      EXPECT_LT((WT * y - a).norm(), 1e-11 * a.norm());
    }
}

/// Closed forms: the integral of a B-spline is (its support) / (p + 1), The NURBS Book, section 2.4; a whole cylinder
/// is 2 pi R L.
TEST(Surface, ControlAreasAreTheIntegralsOfTheBasis) {
  for (int p : {2, 3}) {
    const KnotVector u = knotsAt(p, unevenEnds()), v = uniformKnots(p, 3);
    const std::vector<double> area = controlAreas(garmentOf({flatPatch(u, v, 2, 3)}, {}, plainFabric()));
    for (int j = 0; j < v.count(); ++j)
      for (int i = 0; i < u.count(); ++i)
        EXPECT_NEAR(area[i + u.count() * j],
                    6 * (u.knots[i + p + 1] - u.knots[i]) * (v.knots[j + p + 1] - v.knots[j]) / ((p + 1) * (p + 1)),
                    1e-14);
  }
  NurbsPatch quarter{
      uniformKnots(2, 1), uniformKnots(1, 1), {}, {}};  // exact: weight 1/sqrt(2), The NURBS Book, section 7.3
  for (double z : {0.0, 0.5}) {
    quarter.points.insert(quarter.points.end(), {{0.2, 0, z}, {0.2, 0.2, z}, {0, 0.2, z}});
    quarter.weights.insert(quarter.weights.end(), {1, std::sqrt(0.5), 1});
  }
  quarter = insertKnots(quarter, Direction::u, std::vector<double>{0.25, 0.5, 0.75});
  double total = 0;
  for (double a : controlAreas(garmentOf({quarter}, {}, plainFabric()))) total += a;
  EXPECT_NEAR(total, 0.5 * kPi * 0.2 * 0.5, 1e-9);
}

TEST(Surface, VirtualWorkTotalForceAndMomentAgree) {
  for (const auto& [name, g, works, negative, blind] : zoo())
    for (int per_cell : works) {
      SCOPED_TRACE(name);
      const FreeMap map = buildFreeMap(g);
      const Surface s = buildSurface(g, map, per_cell);
      const std::vector<Vec3> p = deformedFree(g, map, 0.02, 1), dp = deformedFree(g, map, 1, 2);
      std::mt19937 random(9);
      std::normal_distribution<double> d;
      std::vector<Vec3> fs(s.size()), fq(p.size()), xs(s.size()), dxs(s.size()), from_controls(s.size());
      for (Vec3& f : fs) f = {d(random), d(random), d(random)};
      s.WTt.multiply<Vec3>(fs, fq);
      s.WT.multiply<Vec3>(p, xs);
      s.WT.multiply<Vec3>(dp, dxs);
      s.W.multiply<Vec3>(controlsOf(map, p), from_controls);
      double work = 0, size = 0;
      Vec3 force{}, moment{};
      for (int i = 0; i < s.size(); ++i) {
        EXPECT_LT(norm(xs[i] - from_controls[i]), 1e-14);
        work += dot(fs[i], dxs[i]);
        force += fs[i];
        moment += cross(xs[i], fs[i]);
        size += norm(fs[i]);
      }
      for (std::size_t i = 0; i < p.size(); ++i) {
        work -= dot(fq[i], dp[i]);
        force -= fq[i];
        moment -= cross(p[i], fq[i]);
      }
      EXPECT_LT(std::abs(work), 1e-13 * size);
      EXPECT_LT(norm(force), 1e-13 * size);
      EXPECT_LT(norm(moment), 1e-13 * size);
    }
}

/// A uniform pressure on consistent areas is the consistent nodal load: what a Voronoi share would miss.
TEST(Surface, UniformPressureOnAFlatSheetIsTheConsistentLoad) {
  const Garment g =
      garmentOf({flatPatch(uniformKnots(2, 8), knotsAt(2, {0, 0.1, 0.3, 0.6, 1}), 0.4, 0.3)}, {}, plainFabric());
  const FreeMap map = buildFreeMap(g);
  for (int per_cell : {0, 2, 3}) {
    const Surface s = buildSurface(g, map, per_cell);
    std::vector<double> load(map.home.size());
    s.WTt.multiply<double>(s.area_m2, load);
    const std::vector<double> A = freeAreas(g, map);
    for (std::size_t i = 0; i < A.size(); ++i) EXPECT_NEAR(load[i], A[i], 1e-12 * 0.12);
    double total = 0;
    for (double a : s.area_m2) total += a;
    EXPECT_NEAR(total, 0.12, 1e-14);
  }
}

/// One sample on each joined edge; triangles cover the sheet once with one orientation.
TEST(Surface, SamplesOfJoinedEdgesAreOneAndTrianglesCoverTheSheet) {
  const Garment g = star(5, SeamKind::C0, plainFabric());
  const FreeMap map = buildFreeMap(g);
  const Surface s = buildSurface(g, map, 2);
  EXPECT_EQ(s.size(), 5 * 8 * 8 + 5 * 8 + 1);  // 9 x 9 a patch
  for (const Seam& seam : g.seams) EXPECT_EQ(edgeSamples(s, seam.a), edgeSamples(s, seam.b));
  std::vector<Vec3> x(s.size());
  s.W.multiply<Vec3>(restPoints(g), x);
  double area = 0, expected = 0;
  for (const auto& t : s.triangles) {
    const double a = 0.5 * cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]).z;
    EXPECT_GT(a, 0);
    area += a;
  }
  for (double a : controlAreas(g)) expected += a;
  EXPECT_NEAR(area, expected, 0.02 * expected);
  for (int i = 0; i < s.size(); ++i) {
    const auto at = surfaceDerivatives(g.patches[s.patch[i]], s.parameters[i].x, s.parameters[i].y)[0];
    EXPECT_LT(norm(at - x[i]), 1e-14);
  }
}

/// A sampling that would give a pressure of the wrong sign, or that a mode of the sheet could hide from, is refused.
TEST(Surface, BadSamplingIsRefused) {
  const auto refusal = [](const Garment& g, int per_cell) -> std::string {
    try {
      buildSurface(g, buildFreeMap(g), per_cell);
    } catch (const InputError& e) {
      return e.reason();
    }
    return "accepted";
  };
  for (const auto& [name, g, works, negative, blind] : zoo()) {
    for (int n : negative)
      EXPECT_NE(refusal(g, n).find("would carry the area -"), std::string::npos) << name << ", " << n;
    for (int n : blind)
      EXPECT_NE(refusal(g, n).find("do not see every control point"), std::string::npos) << name << ", " << n;
  }
  // 4 x 4 samples, 6 x 6 control points.
  EXPECT_NE(refusal(garmentOf({flatPatch(uniformKnots(3, 3), uniformKnots(3, 3), 1, 1)}, {}, plainFabric()), 1)
                .find("do not see"),
            std::string::npos);
}

}  // namespace
}  // namespace gambeson
