// Rows and springs of sewn seams: fractions of length, what rigid motions and moments say, what is refused.
#include "core/cloth/draft/sewing.hpp"

#include <gtest/gtest.h>

#include "core/cloth/draft/sewn_length.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(SewnLength, OfCirclesAndSidesIsTheirs) {
  Garment g = garmentOf({panelPatch(7, 5, {0, 0}, {0.4, 0.3})}, {}, plainFabric());
  g.trims.resize(1);
  g.trims[0].loops = {{circle({0.2, 0.15}, 0.1, 0.1, true)}};
  const SewnEdge hole{loopPart(g, 0, 0, 0)};
  EXPECT_NEAR(lengthOf(g, hole), 2 * kPi * 0.1, 1e-11);
  const SewnLength length(g, hole, "");
  for (const double s : {0.0, 0.11, 0.25, 0.6180339, 1.0}) {  // clockwise from its first point
    const Vec2 at = length.at(s).uv;
    EXPECT_NEAR(at.x, 0.2 + 0.1 * std::cos(2 * kPi * s), 1e-11);
    EXPECT_NEAR(at.y, 0.15 - 0.1 * std::sin(2 * kPi * s), 1e-11);
    EXPECT_NEAR(length.at(s).tangent.x, -std::sin(2 * kPi * s), 1e-9);
  }
  EXPECT_NEAR(lengthOf(g, {sidePart(g, {0, Side::u1}, 0.25, 1)}), 0.225, 1e-14);
  EXPECT_NEAR(lengthOf(g, {sidePart(g, {0, Side::u1}, 0.25, 1), sidePart(g, {0, Side::v0}, 1, 0)}), 0.625, 1e-14);
  const SewnEdge two{sidePart(g, {0, Side::u1, true}, 0, 0.5), sidePart(g, {0, Side::v0, true}, 0, 1)};
  const SewnLength both(g, two, "");
  EXPECT_NEAR(both.at(0.1).uv.y, 0.3 - 0.055, 1e-13);
  EXPECT_NEAR(both.at(0.6).uv.x, 0.4 - (0.6 * 0.55 - 0.15), 1e-13);
  EXPECT_NEAR(both.corners()[1], 0.15 / 0.55, 1e-14);
}

TEST(SewnLength, BackwardsIsTheSameCurveFromItsEnd) {
  const Garment g = CutSheet{}.garment(plainFabric());
  const SewnEdge there{loopPart(g, 0, 0, 1)}, back{loopPart(g, 0, 0, 1, true)};
  const SewnLength a(g, there, ""), b(g, back, "");
  EXPECT_NEAR(a.length_m(), b.length_m(), 1e-14);
  for (const double s : {0.0, 0.3, 0.77, 1.0}) {
    EXPECT_NEAR(norm(a.at(s).tangent + b.at(1 - s).tangent), 0, 1e-9);
    EXPECT_NEAR(a.at(s).uv.x, b.at(1 - s).uv.x, 1e-13);
    EXPECT_NEAR(a.at(s).uv.y, b.at(1 - s).uv.y, 1e-13);
  }
}

TEST(Sewing, RowsSumToNothingAndCloseOnTheSheet) {
  for (const bool apart : {false, true}) {
    CutSheet sheet;
    sheet.apart = apart;
    const Garment g = sheet.garment(plainFabric());
    const SewnRows rows = buildSewnRows(g, SeamHold::weak);
    EXPECT_TRUE(buildSewnRows(g, SeamHold::projected).empty());
    ASSERT_GT(rows.rows(), 10);
    std::vector<Vec3> q = restPoints(g);
    if (apart) {
      q.clear();
      for (const auto& patch : g.placed) q.insert(q.end(), patch.begin(), patch.end());
    }
    const Mat3 turn = rotationAbout(normalized(Vec3{1, 2, 3}), 2.5);
    for (Vec3& x : q) x = turn * x + Vec3{3, -1, 2};
    std::vector<Vec3> gap(rows.rows()), pair(rows.pairs.rows());
    rows.C.multiply<Vec3>(q, gap);
    rows.pairs.multiply<Vec3>(q, pair);
    for (const Vec3& x : gap) EXPECT_LT(norm(x), 1e-13);
    for (const Vec3& x : pair) EXPECT_LT(norm(x), 1e-12);
    double length = 0;
    for (const double l : rows.length_m) length += l;
    EXPECT_NEAR(length, lengthOf(g, g.sewn_seams[0].a), 1e-12);
    for (int r = 0; r < rows.rows(); ++r) {
      double sum = 0;
      for (int k = rows.C.offsets[r]; k < rows.C.offsets[r + 1]; ++k) sum += rows.C.values[k];
      EXPECT_NEAR(sum, 0, 1e-14);
    }
  }
}

TEST(Sewing, ProjectionIsThatOfTheMassesAndKeepsMomenta) {
  CutSheet sheet;
  sheet.hold = SeamHold::projected;
  sheet.rows_per_cell = 2;  // none of which follows from others
  const Garment g = sheet.garment(plainFabric());
  const SewnRows rows = buildSewnRows(g, SeamHold::projected);
  const std::vector<Vec3> x = restPoints(g);
  std::vector<double> mass, inverse;
  std::vector<Vec3> v, impulse(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    mass.push_back(1 + 0.5 * std::sin(3.0 * static_cast<double>(i)));
    inverse.push_back(1 / mass.back());
    v.push_back({std::sin(1.0 * i), std::cos(2.0 * i), std::sin(0.7 * i)});
  }
  const SewnProjection projection(rows.C, inverse);
  EXPECT_EQ(projection.dependent(), 0);
  SewnProjection::Work work;
  const std::vector<Vec3> before = v;
  projection.project(v, {}, impulse, work);
  std::vector<Vec3> gap;
  projection.gaps(v, gap);
  for (const Vec3& r : gap) EXPECT_LT(norm(r), 1e-14);
  Vec3 linear{}, angular{};
  double size = 0, across = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_LT(norm(v[i] - before[i] - inverse[i] * impulse[i]), 1e-13);
    linear += impulse[i], angular += cross(x[i], impulse[i]), size += norm(impulse[i]);
    across += mass[i] * dot(v[i], v[i] - before[i]);  // nearest: at right angles
  }
  EXPECT_GT(size, 1);
  EXPECT_LT(norm(linear), 1e-14 * size);
  EXPECT_LT(norm(angular), 1e-14 * size);
  EXPECT_NEAR(across, 0, 1e-12 * size);
}

TEST(Sewing, WhatFollowsFromOtherRowsIsNoTrouble) {
  // Four panels around a point, sewn along four sides: three of the corner's conditions are enough.
  Garment g = garmentOf({panelPatch(3, 3, {0, 0}, {1, 1}), panelPatch(4, 4, {1, 0}, {2, 1}),
                         panelPatch(4, 4, {0, 1}, {1, 2}), panelPatch(3, 3, {1, 1}, {2, 2})},
                        {}, plainFabric());
  const auto sew = [&](PatchEdge a, PatchEdge b) { g.sewn_seams.push_back({{sidePart(g, a)}, {sidePart(g, b)}}); };
  sew({0, Side::u1}, {1, Side::u0});
  sew({2, Side::u1}, {3, Side::u0});
  sew({0, Side::v1}, {2, Side::v0});
  sew({1, Side::v1}, {3, Side::v0});
  g.sewn_seams.push_back(g.sewn_seams[0]);  // and one seam twice
  const SewnRows rows = buildSewnRows(g, SeamHold::projected);
  const std::vector<Vec3> x = restPoints(g);
  const SewnProjection projection(rows.C, std::vector<double>(x.size(), 1.0));
  EXPECT_GE(projection.dependent(), 5);
  std::vector<Vec3> v, gap;
  for (std::size_t i = 0; i < x.size(); ++i) v.push_back({std::sin(1.0 * i), std::cos(2.0 * i), std::sin(0.7 * i)});
  SewnProjection::Work work;
  projection.project(v, {}, {}, work);
  projection.gaps(v, gap);
  for (const Vec3& r : gap) EXPECT_LT(norm(r), 1e-3);  // of those that are left out
}

TEST(Sewing, GathersAreEven) {
  // A frill of 0.4 m on a band of 0.2 m.
  Garment g =
      garmentOf({panelPatch(8, 2, {0, 0}, {0.2, 0.05}), panelPatch(16, 4, {0, 0}, {0.4, 0.1})}, {}, plainFabric());
  g.sewn_seams = {{{sidePart(g, {0, Side::v0})}, {sidePart(g, {1, Side::v1})}}};
  std::vector<Vec3> q = restPoints(g);
  for (std::size_t i = g.patches[0].size(); i < q.size(); ++i) q[i] = {0.5 * q[i].x, q[i].y - 0.1, 0};
  std::vector<Vec3> gap(buildSewnRows(g, SeamHold::projected).rows());
  buildSewnRows(g, SeamHold::projected).C.multiply<Vec3>(q, gap);
  for (const Vec3& r : gap) EXPECT_LT(norm(r), 1e-14);
}

TEST(Sewing, SpringsSeeTheAngleBetweenPanels) {
  CutSheet sheet;
  sheet.stiffness_N = 0.3;
  Garment g = sheet.garment(plainFabric());
  std::vector<Vec3> q = restPoints(g);
  double length = 0;
  for (const HingePoint& h : buildSewnHinges(g)) {
    EXPECT_NEAR(hingeAngle(h, q, nullptr), 0, 1e-9);
    length += h.stiffness_length / 0.3;
  }
  EXPECT_NEAR(length, lengthOf(g, g.sewn_seams[0].a), 1e-12);
  // Straight seams fold by the angle that is asked for, whichever way they run.
  for (const bool turned : {false, true}) {
    Garment flat = garmentOf({panelPatch(3, 3, {0, 0}, {1, 1}), panelPatch(4, 4, {0, 0}, {1, 1})}, {}, plainFabric());
    flat.sewn_seams = {{{sidePart(flat, {0, Side::u1, turned})}, {sidePart(flat, {1, Side::u0, turned})}}};
    flat.sewn_seams[0].stiffness_N = 1;
    flat.sewn_seams[0].rest_angle_rad = 0.2;
    std::vector<Vec3> x = restPoints(flat);
    for (std::size_t i = flat.patches[0].size(); i < x.size(); ++i)
      x[i] = rotationAbout({0, -1, 0}, 0.4) * x[i] + Vec3{1, 0, 0};
    for (const HingePoint& h : buildSewnHinges(flat)) {
      EXPECT_NEAR(std::abs(hingeAngle(h, x, nullptr)), 0.4, 1e-12);
      EXPECT_EQ(h.theta0, 0.2);
    }
  }
}

TEST(Sewing, BadSeamsSayWhy) {
  const auto says = [](const Garment& g, const std::string& what) {
    try {
      buildSewnRows(g, SeamHold::weak);
      ADD_FAILURE() << what;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("sewn_seams[0]"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what();
    }
  };
  const Garment good = CutSheet{}.garment(plainFabric());
  Garment g = good;
  g.sewn_seams[0].a[0].patch = 7;
  says(g, "patch 7 does not exist");
  g = good;
  g.sewn_seams[0].a.clear();
  says(g, "no parts");
  g = good;
  g.sewn_seams[0].b = {{1, line({0.2, 0.1}, {0.9, 0.1})}};
  says(g, "leaves patch 1");
  g = good;
  g.sewn_seams[0].b = {{1, line({0.25, 0.03}, {0.25, 0.17})}};
  says(g, "cloth on both sides");
  g = good;
  g.sewn_seams[0].b = {{1, line({0.2, 0}, {0.25, 0})}};
  says(g, "up to 2:1");
  g = good;
  g.sewn_seams[0].a[0].to = 1.5;
  says(g, "from one of its parameters to another");
  g = good;
  g.sewn_seams[0].stiffness_N = -1;
  g.sewn_seams[0].name = "side";
  says(g, "(seam \"side\")");
}

}  // namespace
}  // namespace gambeson
