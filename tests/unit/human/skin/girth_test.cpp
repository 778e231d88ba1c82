/// The skins of all manikins: folds, and girths by the tape against the ellipsoids of the data
/// (human/data/manikins.json), triangles, volume and area, for all manikins.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/mesh_topology.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/skin/make_skin.hpp"
#include "unit/human/skin/postures.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

/// Length of the convex hull of points in a plane: what a tape measures (Andrew's monotone chain).
double tape(std::vector<Vec2> points) {
  const auto turns = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && turns(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  double length = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    length += std::hypot(a.x - b.x, a.y - b.y);
  }
  return length;
}

bool ofArm(const Human& h, const Skin& s, int v) {
  const std::string& name = h.skeleton.links[s.segment[v]].name;
  return name.find("arm") != std::string::npos || name.starts_with("hand");
}

/// Girth where the plane z = 0 of frame X cuts the skin, arms excluded; of the left leg alone where `left`.
double girth(const Human& h, const Skin& s, const Pose& X, bool left) {
  std::vector<Vec2> points;
  for (const auto& t : s.rest.triangles) {
    if (ofArm(h, s, t[0]) || ofArm(h, s, t[1]) || ofArm(h, s, t[2])) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = s.rest.vertices[t[k]], b = s.rest.vertices[t[(k + 1) % 3]];
      if (left && (a.y < 0 || b.y < 0)) continue;
      const Vec3 p = transposeTimes(X.rotation, a - X.origin), q = transposeTimes(X.rotation, b - X.origin);
      if ((p.z < 0) == (q.z < 0)) continue;
      const Vec3 c = p + p.z / (p.z - q.z) * (q - p);
      points.push_back({c.x, c.y});
    }
  }
  return tape(points);
}

double perimeter(double a, double b) {
  if (a < b) std::swap(a, b);
  return 4 * a * std::comp_ellint_2(std::sqrt(1 - b * b / (a * a)));
}

class SkinOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Manikins, SkinOf, testing::ValuesIn(manikinsAsked()), [](const auto& i) { return i.param; });

TEST_P(SkinOf, HasTheGirthsOfTheDataGoodTrianglesAndCleanFolds) {
  const Human h = makeManikin(GetParam());
  const Skin s = makeSkin(h);
  for (const BodyShape& part : h.shapes) {
    const bool left = part.name == "thigh_left";
    if (!left && part.name != "pelvis" && part.name != "waist" && part.name != "chest") continue;
    const Vec3 e = std::get<Ellipsoid>(part.shape).semi_axes;
    const double wanted = perimeter(e.x, e.y), got = girth(h, s, s.bind[part.link] * part.X_LS, left);
    EXPECT_NEAR(got, wanted, 0.04 * wanted) << part.name;
    RecordProperty(part.name, std::to_string(got));
  }

  EXPECT_GE(s.rest.triangles.size(), 20000u);
  double least_cosine = -1, volume = 0, area = 0;
  std::vector<double> edges;
  for (const auto& t : s.rest.triangles) {
    const Vec3 x[3] = {s.rest.vertices[t[0]], s.rest.vertices[t[1]], s.rest.vertices[t[2]]};
    volume += dot(x[0], cross(x[1], x[2])) / 6;
    area += 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = x[(k + 1) % 3] - x[k], v = x[(k + 2) % 3] - x[k];
      least_cosine = std::max(least_cosine, dot(u, v) / (norm(u) * norm(v)));
      const std::string& name = h.skeleton.links[s.segment[t[k]]].name;
      if (name == "pelvis" || name == "torso" || name.starts_with("thigh") || name.starts_with("upper_arm"))
        edges.push_back(norm(u));
    }
  }
  EXPECT_LT(least_cosine, std::cos(20 * std::numbers::pi / 180));
  std::sort(edges.begin(), edges.end());
  EXPECT_GT(edges[edges.size() / 20], 0.009);  // 9 of 10 edges of the garment regions
  EXPECT_LT(edges[edges.size() / 20 * 19], 0.015);
  // A body's density: 0.95 to 1.15 (ours has no lungs and a plain trunk). Its area by Du Bois (1916): 0.007184
  // kg^0.425 cm^0.725, within 15 %.
  EXPECT_NEAR(h.mass_kg / volume, 1050, 100);
  const double du_bois = 0.007184 * std::pow(h.mass_kg, 0.425) * std::pow(100 * h.stature_m, 0.725);
  EXPECT_NEAR(area, du_bois, 0.15 * du_bois);
  EXPECT_TRUE(meshTopology(s.rest).closed);

  for (const Angles& angles : {stairs, aiming, folded}) {
    const std::vector<Vec3> x = posed(h, s, angles);
    EXPECT_EQ(crossings(s, x), 0u);
    EXPECT_GE(narrowest(s, x), s.crease_gap_m);
  }

  // Symmetric to the bit.
  std::vector<std::array<double, 3>> points, mirrored;
  for (const Vec3& x : s.rest.vertices) {
    points.push_back({x.x, x.y, x.z});
    mirrored.push_back({x.x, x.y == 0 ? 0 : -x.y, x.z});
  }
  std::sort(points.begin(), points.end());
  std::sort(mirrored.begin(), mirrored.end());
  EXPECT_EQ(points, mirrored);
}

}  // namespace
}  // namespace gambeson
