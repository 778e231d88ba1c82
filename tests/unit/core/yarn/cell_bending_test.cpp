#include "core/yarn/cell_bending.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/yarn/cell_response.hpp"

namespace gambeson {
namespace {

constexpr double kHalf = 0.5 * std::numbers::pi;

RodCellDesign unlike(const Weave& weave) {
  RodCellDesign d;
  d.yarns = {weave, {WovenYarn{1, 0.16, 0.24, 0.16}, WovenYarn{1.2, 0.16, 0.24, 0.16}}};
  d.section = {RodSection{10, 0.5, 0.4, 0.01, 0.03, 0.05}, RodSection{8, 0.3, 0.2, 0.02, 0.04, 0.06}};
  d.compression = {0.1, 3};
  d.pieces_per_spacing = 8;
  return d;
}

double along(const CellBending& b, double t) {
  const double c = std::cos(t), s = std::sin(t);
  const auto& [D11, D22, D33, D12, D13, D23] = b.rigidity_Nm;
  return D11 * std::pow(c, 4) + D22 * std::pow(s, 4) + (2 * D12 + 4 * D33) * c * c * s * s + 4 * D13 * c * c * c * s +
         4 * D23 * c * s * s * s;
}

struct Strained {
  Strained(const RodCellDesign& design, const CellLoad& load)
      : cell(design), work(cell), sections(cell.rest().begin(), cell.rest().end()) {
    EXPECT_TRUE(changeLoad(cell, {}, load, sections, work).converged());
    bending = bendingOf(cell, load, sections, work);
  }
  RodCell cell;
  EquilibriumWork work;
  std::vector<Pose> sections;
  CellBending bending;
};

/// Cells that are bent, in directions that the form was not made from too.
TEST(CellBending, RestBendsAsCylindersDo) {
  const Strained rest(unlike(plainWeave()), {});
  for (const double t : {0.0, kHalf, 0.3, -0.9}) {
    double moment[2];
    for (const int side : {0, 1}) {
      EquilibriumWork work(rest.cell);
      std::vector<Pose> sections(rest.cell.rest().begin(), rest.cell.rest().end());
      const CellLoad load{0, 0, 0, side == 0 ? -1e-3 : 1e-3, t};
      ASSERT_TRUE(changeLoad(rest.cell, {}, load, sections, work).converged());
      moment[side] = resultantsOf(rest.cell, load, sections).moment_N;
    }
    const double bent = (moment[1] - moment[0]) / 2e-3;
    EXPECT_NEAR(along(rest.bending, t), bent, 2e-5 * bent) << t;
  }
}

/// D11 = B/(S spacing) by the length S of a yarn in a spacing; D33 of yarns that twist, GJ/(4 spacing) of each
/// direction.
TEST(CellBending, YarnsBendAndTwistEachByItself) {
  RodCellDesign d = unlike(plainWeave());
  d.contact = false;
  const Strained rest(d, {});
  EXPECT_NEAR(rest.bending.rigidity_Nm[0] * rest.cell.yarnLength_m(along_weft, 0) / 2, 0.03 / 1.0 * 1.2, 1e-4 * 0.03);
  d.yarns.yarn[0].amplitude_m = d.yarns.yarn[1].amplitude_m = 1e-3;
  d.yarns.yarn[0].half_thickness_m = d.yarns.yarn[1].half_thickness_m = 1e-3;
  EXPECT_NEAR(Strained(d, {}).bending.rigidity_Nm[2], 0.25 * (0.01 / 1.0 + 0.02 / 1.2), 1e-5);
}

/// Sheared to the other side the cell is its mirror image: D13 and D23 change their signs. Tension stiffens it.
TEST(CellBending, StrainTurnsItAsTheMirrorSays) {
  const Strained left(unlike(plainWeave()), {0.04, 0.03, 0.2, 0, 0}),
      right(unlike(plainWeave()), {0.04, 0.03, -0.2, 0, 0});
  for (int i = 0; i < 6; ++i) {
    const double sign = i < 4 ? 1 : -1;
    EXPECT_NEAR(left.bending.rigidity_Nm[i], sign * right.bending.rigidity_Nm[i], 1e-5 * left.bending.rigidity_Nm[0]);
  }
  EXPECT_GT(left.bending.rigidity_Nm[4], 0.01 * left.bending.rigidity_Nm[0]);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(left.bending.moment_N[i], 0, 1e-8) << "faces are equal";
}

/// A satin that is stretched curls: b is the moment that keeps it flat.
TEST(CellBending, UnlikeFacesCurl) {
  RodCellDesign d = unlike(satinWeave(5, 2));
  d.pieces_per_spacing = 4;
  const CellLoad load{0.04, 0.03, 0.05, 0, 0};
  const Strained satin(d, load);
  const auto& [b1, b2, b3] = satin.bending.moment_N;
  EXPECT_GT(std::abs(b1) + std::abs(b2), 1e-5);
  for (const double t : {0.4, -1.1}) {
    CellLoad toward = load;
    toward.direction_rad = t;
    const double c = std::cos(t), s = std::sin(t);
    EXPECT_NEAR(resultantsOf(satin.cell, toward, satin.sections).moment_N, b1 * c * c + b2 * s * s + 2 * b3 * c * s,
                1e-12);
  }
}

/// How the unknowns are pushed, by curvature of an arc in a direction; yarns are held at their heights.
std::vector<double> pushOf(const Strained& s, const CellLoad& flat, double direction) {
  const double h = 1e-4;
  std::array<std::vector<double>, 2> r;
  for (const int side : {0, 1}) {
    CellLoad bent = flat;
    bent.curvature_per_m = side == 0 ? -h : h, bent.direction_rad = direction;
    CellAnswer answer;
    s.cell.evaluate(facesOf(s.cell.yarns(), bent), carried(s.sections, flat, bent), answer);
    r[static_cast<std::size_t>(side)] = s.work.residual(answer);
  }
  for (std::size_t i = 0; i < r[0].size(); ++i) r[1][i] = (r[1][i] - r[0][i]) / (2 * h);
  const SparseRows& C = s.cell.freedoms();
  for (const int d : {along_weft, along_warp})
    for (int k = 0; k < s.cell.yarns().count(d); ++k) {
      std::vector<int> heights;
      for (int i = s.cell.firstSection(d, k); i < s.cell.firstSection(d, k) + s.cell.sectionsOf(d); ++i)
        for (int e = C.offsets[6 * i + 2]; e < C.offsets[6 * i + 3]; ++e) heights.push_back(C.columns[e]);
      double sum = 0;
      for (const int column : heights) sum += r[1][column];
      for (const int column : heights) r[1][column] -= sum / static_cast<double>(heights.size());
    }
  return r[1];
}

/// What a bend of the weft does to the bend of the warp, which D12 = 0 leaves out: nothing at rest, and next to nothing
/// where yarns are pressed hard.
TEST(CellBending, YarnsHardlyAnswerEachOthersBend) {
  RodCellDesign d = unlike(plainWeave());
  d.compression = {5, 3};
  d.pieces_per_spacing = 16;
  for (const double stretch : {0.0, 0.06}) {
    const CellLoad load{stretch, stretch, 0, 0, 0};
    Strained s(d, load);
    const std::vector<double> weft = pushOf(s, load, 0), warp = pushOf(s, load, kHalf);
    const std::vector<double> follow = s.work.follow(warp);
    double both = 0;
    for (std::size_t i = 0; i < weft.size(); ++i) both -= weft[i] * follow[i] / s.cell.area_m2();
    EXPECT_LT(std::abs(both), (stretch == 0 ? 1e-9 : 1e-3) * s.bending.rigidity_Nm[0]) << stretch;
  }
}

TEST(CellBending, BentCellsAreRefused) {
  Strained rest(unlike(plainWeave()), {});
  EXPECT_THROW(bendingOf(rest.cell, {0, 0, 0, 0.1, 0}, rest.sections, rest.work), RunError);
}

}  // namespace
}  // namespace gambeson
