// Belt, shirt and skirt on the manikins: counts, sizes, distances, seams.
#include "tryon/pattern/armour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/join_garments.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/cloth/shell/shell.hpp"
#include "core/contact/crossing.hpp"
#include "core/contact/proximity.hpp"
#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/skin/make_skin.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/pattern.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

constexpr double shorts_thickness_m = 0.762e-3, belt_thickness_m = 2.29e-3, shirt_thickness_m = 3e-3;

Fabric soft(double thickness_m) {
  Fabric f;
  f.thickness_m = thickness_m;
  f.young_weft_Pa = f.young_warp_Pa = 1.44e6;
  f.shear_Pa = 1.44e6 / 2.6;
  f.poisson = 0.3;
  f.density_kg_per_m3 = 1440;
  f.law = ZhengBending{{0.00371, 0.00371}, 30, 1};
  return f;
}

/// The three garments, coarse.
struct Armour {
  Human human;
  BodyForm form;
  Garment shorts, belt, shirt;
  ShirtPattern pattern;
  BeltPattern belt_pattern;

  explicit Armour(const char* manikin, double ease = 0.06, double cell_m = 0.026)
      : Armour(makeManikin(manikin), ease, ease, cell_m) {}
  Armour(Human wearer, double ease, double shorts_ease, double cell_m) : human(std::move(wearer)), form(human) {
    ShortsPattern s;
    s.cell_m = 0.03;
    s.ease = shorts_ease;
    s.waist_ease = 0.01;
    shorts = makeShorts(s, form);
    shorts.fabric = soft(shorts_thickness_m);
    belt_pattern.cell_m = cell_m;
    const Worn first[]{{&shorts, shorts_thickness_m}};
    belt = makeBelt(belt_pattern, form, soft(belt_thickness_m), belt_thickness_m, first);
    belt.fabric = soft(belt_thickness_m);
    pattern.ease = ease;
    pattern.cell_m = cell_m;
    const Worn both[]{{&shorts, shorts_thickness_m}, {&belt, belt_thickness_m}};
    shirt = makeShirt(pattern, form, shirt_thickness_m, both);
    shirt.fabric = soft(shirt_thickness_m);
  }
};

std::vector<Vec3> startOf(const Garment& g) {
  std::vector<Vec3> q;
  for (std::size_t p = 0; p < g.patches.size(); ++p) {
    const auto& points = !g.placed.empty() && !g.placed[p].empty() ? g.placed[p] : g.patches[p].points;
    q.insert(q.end(), points.begin(), points.end());
  }
  return q;
}

/// Contact samples as the garment starts.
struct Sampled {
  Surface surface;
  std::vector<Vec3> x;
  explicit Sampled(const Garment& g, int per_cell = 2)
      : surface(buildSurface(g, buildFreeMap(g), per_cell)), x(surface.size()) {
    surface.W.multiply<Vec3>(startOf(g), x);
  }
  TriangleMesh mesh() const { return {x, surface.triangles}; }
};

double leastToBody(const Human& human, const std::vector<Vec3>& x) {
  const auto obstacles = obstaclesOf(human);
  const Posture p = standing(human);
  const auto placed = placementsOf(human, linkPoses(human.skeleton, p.q, p.root));
  const ProximityQuery query(obstacles);
  double least = HUGE_VAL;
  for (const Vec3& s : x)
    for (std::size_t o = 0; o < obstacles.size(); ++o)
      least = std::min(least, query.signedDistance(static_cast<int>(o), placed[o], s));
  return least;
}

double pointTriangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const Vec3 p = x - dot(x - a, n) / norm2(n) * n;
  if (dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0)
    return norm(x - p);
  const auto edge = [&](const Vec3& s, const Vec3& e) {
    return norm(x - (s + std::clamp(dot(x - s, e - s) / norm2(e - s), 0.0, 1.0) * (e - s)));
  };
  return std::min({edge(a, b), edge(b, c), edge(c, a)});
}

/// From the samples of either to the triangles of the other.
double leastBetween(const Sampled& a, const Sampled& b) {
  double least = HUGE_VAL;
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}})
    for (const auto& [i, j, k] : to->surface.triangles) {
      const Vec3 &p = to->x[i], &q = to->x[j], &r = to->x[k];
      for (const Vec3& x : from->x)
        if (std::abs(x.z - p.z) < 0.05 && norm2(x - p) < 0.0025) least = std::min(least, pointTriangle(x, p, q, r));
    }
  return least;
}

double edgeToEdge(const NurbsPatch& p, double v) {
  double length = 0;
  Vec3 before = surfaceDerivatives(p, 0, v)[0];
  for (int i = 1; i <= 100; ++i) {
    const Vec3 x = surfaceDerivatives(p, i / 100.0, v)[0];
    length += norm(x - before);
    before = x;
  }
  return length;
}

class ArmourOn : public testing::TestWithParam<const char*> {};

TEST_P(ArmourOn, IsFreeOfTheBodyAndOfItself) {
  for (const double ease : {0.02, 0.12}) {
    const Armour a(GetParam(), ease);
    const Sampled shorts(a.shorts), belt(a.belt), shirt(a.shirt);
    EXPECT_GE(leastToBody(a.human, belt.x), belt_thickness_m);
    EXPECT_GE(leastToBody(a.human, shirt.x), shirt_thickness_m) << ease;
    EXPECT_GT(leastToBody(a.human, shorts.x), 0);
    // Garments keep half the sum of their thicknesses.
    EXPECT_GE(leastBetween(shorts, belt), 0.5 * (shorts_thickness_m + belt_thickness_m));
    EXPECT_GE(leastBetween(shorts, shirt), 0.5 * (shorts_thickness_m + shirt_thickness_m));
    EXPECT_GE(leastBetween(belt, shirt), 0.5 * (belt_thickness_m + shirt_thickness_m));
    const std::vector<Garment> all{a.shorts, a.belt, a.shirt};
    const Garment joined = joinGarments(all);
    const Sampled s(joined);
    EXPECT_EQ(findCrossings(contactMesh(s.surface.size(), s.surface.triangles), s.x).size(), 0u) << ease;
  }
}

TEST_P(ArmourOn, GirthsAreTheBodysPlusEase) {
  const Armour a(GetParam());
  const Links trunk = a.form.links({"torso", "pelvis", "thigh_left", "thigh_right"}, "");
  const NurbsPatch &front_patch = a.shirt.patches[front], &wrap = a.shirt.patches[side_wrap];
  const double hem = front_patch.points[0].z, top = surfaceDerivatives(front_patch, 0, 1)[0].z;
  const Wrap body = a.form.wrap(hem - a.pattern.belly_length_m, top, trunk, "", 129);
  for (const double v : {0.5, 0.75, 1.0}) {  // above what belt and shorts lift
    const double z = surfaceDerivatives(wrap, 0.5, v)[0].z;
    std::vector<Vec2> points;
    for (int k = 0; k <= 400; ++k) {
      const Vec3 x = surfaceDerivatives(wrap, k / 400.0, v)[0];
      const Vec3 y = surfaceDerivatives(front_patch, k / 400.0, (z - hem) / (top - hem))[0];
      points.push_back({x.x, x.y});
      points.push_back({y.x, y.y});
    }
    EXPECT_NEAR(ClosedCurve(convexHull(points)).length() / body.girth(z), 1.06, 0.006) << v;
  }
}

TEST_P(ArmourOn, StrapLegsAddUpTo15cm) {
  const Armour a(GetParam());
  double sum = 0;
  for (const ShirtPatch strap : {strap_left, strap_right}) {
    const NurbsPatch& p = a.shirt.patches[strap];
    for (const double v : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0})
      EXPECT_NEAR(edgeToEdge(p, v), 0.0385, 0.0012) << strap << " " << v;
    sum += edgeToEdge(p, 0.2) + edgeToEdge(p, 0.8);
  }
  EXPECT_NEAR(sum, 0.154, 0.002);
}

/// A manikin in its closed skin, and the skin as it stands.
struct Skinned {
  Human human;
  TriangleMesh skin;
  explicit Skinned(const char* manikin) : human(makeManikin(manikin)) {
    human.skin = std::make_shared<Skin>(makeSkin(human));
    skin = {std::vector<Vec3>(human.skin->rest.vertices.size()), human.skin->rest.triangles};
    const Posture p = standing(human);
    skinPositions(*human.skin, linkPoses(human.skeleton, p.q, p.root), skin.vertices);
  }
};

TEST_P(ArmourOn, StartsClearOfTheSkinThatItIsDraftedOn) {
  // As in the library: shorts wide enough to reach the other leg's where thighs are near (12 %).
  const Skinned wearer(GetParam());
  const Armour a(wearer.human, 0.06, 0.12, 0.026);
  const std::vector<Garment> all{a.shorts, a.belt, a.shirt};
  const Sampled s(joinGarments(all), 3);
  std::vector<Vec3> x = s.x;
  std::vector<std::array<int, 3>> triangles = s.surface.triangles;
  const int first = static_cast<int>(x.size());
  x.insert(x.end(), wearer.skin.vertices.begin(), wearer.skin.vertices.end());
  for (const auto& [i, j, k] : wearer.skin.triangles) triangles.push_back({first + i, first + j, first + k});
  EXPECT_EQ(findCrossings(contactMesh(static_cast<int>(x.size()), triangles), x).size(), 0u);
  const std::vector<Obstacle> skin{{wearer.skin, "skin"}};
  const ProximityQuery query(skin);
  double least = HUGE_VAL;  // between the samples as well
  for (const Garment& g : all)
    for (const Vec3& y : Sampled(g, 6).x) least = std::min(least, query.signedDistance(0, Placement{}, y));
  EXPECT_GT(least, 0);
  double legs = 0;
  for (const ShirtPatch strap : {strap_left, strap_right})
    legs += edgeToEdge(a.shirt.patches[strap], 0.2) + edgeToEdge(a.shirt.patches[strap], 0.8);
  EXPECT_NEAR(legs, 0.154, 0.002);
}

TEST_P(ArmourOn, ShirtsAreLikeTheirWearersInSize) {
  // Area over girth times height, against the default man's: one cut for all.
  const auto share = [](const char* manikin) {
    const Armour a(manikin);
    double area = 0;
    for (const double c : controlAreas(a.shirt)) area += c;
    const double hem = a.shirt.patches[front].points[0].z, top = surfaceDerivatives(a.shirt.patches[front], 0, 1)[0].z;
    const Links trunk = a.form.links({"torso", "pelvis", "thigh_left", "thigh_right"}, "");
    return area / (a.form.wrap(hem, top, trunk, "", 65).girth(0.5 * (hem + top)) * (top - hem));
  };
  EXPECT_NEAR(share(GetParam()) / share("male_p50"), 1, 0.12);
}

TEST_P(ArmourOn, IsItsOwnMirrorImageWithNormalsOutward) {
  const Armour a(GetParam());
  for (const auto& [left, right] : {std::pair{front, front}, std::pair{back, back}, std::pair{side_wrap, side_wrap},
                                    std::pair{belly, belly}, std::pair{strap_left, strap_right}}) {
    const NurbsPatch &p = a.shirt.patches[left], &q = a.shirt.patches[right];
    for (int j = 0; j < p.v.count(); ++j)
      for (int i = 0; i < p.u.count(); ++i) {
        const Vec3 x = p.points[p.index(i, j)], y = q.points[q.index(p.u.count() - 1 - i, j)];
        EXPECT_LT(norm(x - Vec3{y.x, 2 * a.form.medianY() - y.y, y.z}), 2e-4) << left << " " << i << " " << j;
      }
  }
  const double x0 = a.form.origin(0).x;
  for (const ShirtPatch patch : {front, back, side_wrap, belly})
    for (const double u : {0.1, 0.5, 0.9})
      for (const double v : {0.1, 0.5, 0.9}) {
        const auto d = surfaceDerivatives(a.shirt.patches[patch], u, v);
        EXPECT_GT(dot(cross(d[1], d[2]), d[0] - Vec3{x0, 0, d[0].z}), 0) << patch;
      }
  for (const ShirtPatch patch : {strap_left, strap_right}) {
    const auto d = surfaceDerivatives(a.shirt.patches[patch], 0.5, 0.5);
    EXPECT_GT(cross(d[1], d[2]).z, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Manikins, ArmourOn, testing::ValuesIn(manikinsAsked<const char*>()));

TEST(Belt, CarriesItsTensionOnTheWaist) {
  // dE/dL of the rest ring drawn out onto the body: nominal tension, Poisson's contraction across allowed.
  Armour a("male_p50");
  for (const double tension : {0.0, 2.0, 20.0}) {
    a.belt_pattern.tension_N = tension;
    const Worn under[]{{&a.shorts, shorts_thickness_m}};
    Garment belt = makeBelt(a.belt_pattern, a.form, soft(belt_thickness_m), belt_thickness_m, under);
    belt.fabric = soft(belt_thickness_m);
    belt.fabric.law = ZhengBending{{1e-9, 1e-9}, 30, 1};
    const Shell shell(belt, widestKernels());
    ClothWork work;
    const NurbsPatch& p = belt.patches[0];
    const double length = edgeToEdge(p, 0.5);
    double area = 0;
    for (const double c : controlAreas(belt)) area += c;
    const double lambda = stretchAt(tension, area / length, belt.fabric);
    const auto energyAt = [&](double s) {
      const double across = std::sqrt(1 - 0.3 * (s * s - 1));
      std::vector<Vec3> q, f(p.points.size());
      for (const Vec3& x : p.points) q.push_back({s * x.x, s * x.y, across * x.z});
      double energy = 0;
      shell.force(q, f, work, &energy);
      return energy;
    };
    const double step = 1e-5;
    EXPECT_NEAR((energyAt(lambda + step) - energyAt(lambda - step)) / (2 * step * length), tension,
                0.01 * tension + 0.01);
    // Drawn out so far it lies on the shorts that lie on the body.
    const Links trunk = a.form.links({"torso", "pelvis", "thigh_left", "thigh_right"}, "");
    const double low = p.points[0].z, high = p.points.back().z;
    const double girth = a.form.wrap(low, high, trunk, "", 17).girth(0.5 * (low + high));
    EXPECT_NEAR(lambda * length,
                girth + 2 * M_PI * (shorts_thickness_m + 0.5 * (shorts_thickness_m + belt_thickness_m)), 2e-4);
    EXPECT_LT(g1Residual(belt, belt.seams[0]), 1e-15);
  }
}

TEST(Shirt, WeighsWhatItsThicknessSays) {
  const Armour a("male_p50");
  double area = 0;
  for (const double x : controlAreas(a.shirt)) area += x;
  // 3.03 mm at 1440 kg/m^3 make the 1.43 kg of Zheng 2013, section 6.4.
  EXPECT_NEAR(area * 1440 * 3.03e-3, 1.43, 0.05 * 1.43);
}

TEST(Shirt, IsDraftedOnASkinAsWell) {
  const Skinned wearer("male_p50");
  const BodyForm form(wearer.human);
  // Arms are not part of the chest.
  const Links torso = form.links({"torso"}, "");
  for (const Vec2& p : form.level(1.2, torso)) EXPECT_LT(std::abs(p.y), 0.2);
  ShirtPattern pattern;
  pattern.cell_m = 0.026;
  const Sampled s(makeShirt(pattern, form, shirt_thickness_m, {}));
  const std::vector<Obstacle> skin{{wearer.skin, "skin"}};
  const ProximityQuery query(skin);
  double least = HUGE_VAL;
  for (const Vec3& y : s.x) least = std::min(least, query.signedDistance(0, Placement{}, y));
  EXPECT_GE(least, shirt_thickness_m);
}

TEST(Skirt, HasEightPanelsAnd960ControlPoints) {
  const Human human = makeManikin("female_p50");
  const BodyForm form(human);
  const Garment g = makeSkirt({}, form, 5e-3, {});
  EXPECT_EQ(g.patches.size(), 8u);
  EXPECT_EQ(controlOffsets(g).back(), 960);
  for (const Seam& s : g.seams) EXPECT_LT(g1Residual(g, s), 1e-15);
  const Sampled s(g);
  EXPECT_GE(leastToBody(human, s.x), 5e-3);
  EXPECT_EQ(findCrossings(contactMesh(s.surface.size(), s.surface.triangles), s.x).size(), 0u);
}

TEST(Armour, RejectsBadNumbers) {
  const Human human = makeManikin("male_p50");
  const BodyForm form(human);
  const auto keyOf = [](const auto& make) -> std::string {
    try {
      make();
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "accepted";
  };
  const double nan = std::nan("");
  const Garment shorts = makeShorts({}, form);
  const Worn under[]{{&shorts, shorts_thickness_m}};
  const auto belt = [&](auto damage) {
    BeltPattern p;
    Fabric f = soft(belt_thickness_m);
    damage(p, f);
    return keyOf([&] { makeBelt(p, form, f, belt_thickness_m, under); });
  };
  EXPECT_EQ(belt([](auto&, auto&) {}), "accepted");
  EXPECT_EQ(belt([&](auto& p, auto&) { p.tension_N = nan; }), "tension_N");
  EXPECT_EQ(belt([](auto& p, auto&) { p.tension_N = 1000; }), "tension_N");
  EXPECT_EQ(belt([](auto& p, auto&) { p.width_m = 0; }), "width_m");
  EXPECT_EQ(belt([](auto& p, auto&) { p.below_waist_m = 2; }), "below_waist_m");  // no body there
  EXPECT_EQ(belt([](auto&, auto& f) { f.young_warp_Pa = 0; }), "fabric");
  const auto shirt = [&](auto damage) {
    ShirtPattern p;
    damage(p);
    return keyOf([&] { makeShirt(p, form, shirt_thickness_m, {}); });
  };
  EXPECT_EQ(shirt([](auto&) {}), "accepted");
  EXPECT_EQ(shirt([&](auto& p) { p.ease = nan; }), "ease");
  EXPECT_EQ(shirt([](auto& p) { p.cell_m = 1e-9; }), "cell_m");
  EXPECT_EQ(shirt([](auto& p) { p.strap_width_m = -1; }), "strap_width_m");
  EXPECT_EQ(shirt([](auto& p) { p.wrap_share = 1; }), "wrap_share");
  EXPECT_EQ(shirt([](auto& p) { p.neck_depth_m = 0; }), "neck_depth_m");
  EXPECT_EQ(shirt([](auto& p) { p.neck_depth_m = 0.5; }), "neck_depth_m");
  EXPECT_EQ(shirt([](auto& p) { p.hem_above_waist_m = 0.5; }), "hem_above_waist_m");
  EXPECT_EQ(keyOf([&] { makeShirt({}, BodyForm(Human{}), shirt_thickness_m, {}); }), "garment.shirt");
  const auto skirt = [&](auto damage) {
    SkirtPattern p;
    damage(p);
    return keyOf([&] { makeSkirt(p, form, 5e-3, {}); });
  };
  EXPECT_EQ(skirt([](auto& p) { p.cells_around = 20; }), "cells_around");
  EXPECT_EQ(skirt([](auto& p) { p.length_m = 3; }), "length_m");
  EXPECT_EQ(skirt([](auto& p) { p.flare_rad = 2; }), "flare_rad");
}

}  // namespace
}  // namespace gambeson
