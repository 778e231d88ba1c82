/// Forces of contact and their slopes, against differences; what is conserved; what is refused.

#include "core/solid/solid_contact.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// A crooked sheet of 3 by 3 facets and nodes that have passed it a little, or are a little above.
struct Scene {
  std::vector<Vec3> rest, start, x;
  std::vector<Facet> facets;
  std::vector<int> nodes;
  std::vector<ContactMultipliers> multipliers;

  Scene() {
    std::mt19937 random(5);
    const auto d = [&](double size) { return std::uniform_real_distribution<double>(-size, size)(random); };
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) rest.push_back({i + d(0.1), j + d(0.1), 0.15 * std::sin(2.0 * i + j)});
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int a = i + 4 * j;
        facets.push_back({a, a + 1, a + 5, a + 4});
      }
    const FacetSurface surface(facets, 16);
    for (int f = 0; f < 9; ++f) {
      const Vec2 at{d(0.8), d(0.8)};
      const FacetCorners c = surface.corners(f, rest);
      nodes.push_back(static_cast<int>(rest.size()));
      rest.push_back(facetPosition(c, at) + (d(0.02) - 0.02) * facetNormal(c, at));
      multipliers.push_back({0, f, f, f, 60 + d(40), {d(20), d(20)}});
    }
    multipliers.erase(multipliers.begin() + 4);  // one node is new
    for (const Vec3& X : rest) {
      start.push_back(X + Vec3{d(0.01), d(0.01), d(0.002)});
      x.push_back(start.back() + Vec3{d(0.03), d(0.03), d(0.005)});
    }
  }

  ContactSide side() const {
    return {nodes, std::vector<double>(nodes.size(), 0.7), FacetSurface(facets, static_cast<int>(rest.size()))};
  }
  SolidContact contact(double friction, FrictionBound bound) const {
    SolidContactLaw law{3000, 2000, friction, bound, {}};
    law.touch.reach_m = 0.4;
    return SolidContact({side()}, law, rest);
  }
};

std::vector<Vec3> forceOf(const SolidContact& c, const Scene& s, const std::vector<Vec3>& x) {
  std::vector<Vec3> f(x.size());
  c.addForce(c.points(x, s.start, s.multipliers), f);
  return f;
}

/// The tangent as a full matrix.
std::vector<double> tangentOf(const SolidContact& c, const Scene& s) {
  const std::size_t n = 3 * s.x.size();
  std::vector<double> K(n * n, 0.0);
  for (const ContactBlock& b : c.tangent(s.x, c.points(s.x, s.start, s.multipliers)))
    for (int i = 0; i < 15; ++i)
      for (int j = 0; j < 15; ++j)
        K[n * (3 * b.rows[i / 3] + i % 3) + 3 * b.columns[j / 3] + j % 3] += b.values[15 * i + j];
  return K;
}

struct Errors {
  double slope = 0, asymmetry = 0;
};

Errors errorsOf(const SolidContact& c, const Scene& s) {
  const std::vector<double> K = tangentOf(c, s);
  const std::size_t n = 3 * s.x.size();
  double most = 0;
  for (const double k : K) most = std::max(most, std::abs(k));
  Errors errors;
  const double h = 1e-6;
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = [&](double way) {
      std::vector<Vec3> x = s.x;
      x[j / 3][static_cast<int>(j % 3)] += way * h;
      return forceOf(c, s, x);
    };
    const auto m2 = at(-2), m1 = at(-1), p1 = at(1), p2 = at(2);
    for (std::size_t i = 0; i < n; ++i) {
      const int d = static_cast<int>(i % 3);
      const double slope = (8 * (p1[i / 3][d] - m1[i / 3][d]) - (p2[i / 3][d] - m2[i / 3][d])) / (12 * h);
      errors.slope = std::max(errors.slope, std::abs(slope - K[n * i + j]) / most);
      errors.asymmetry = std::max(errors.asymmetry, std::abs(K[n * i + j] - K[n * j + i]) / most);
    }
  }
  return errors;
}

TEST(SolidContact, TheTangentIsTheSlopeOfTheForce) {
  const Scene s;
  for (const double friction : {0.0, 0.15, 0.5, 50.0}) {
    for (const FrictionBound bound : {FrictionBound::coupled, FrictionBound::symmetrised}) {
      const SolidContact c = s.contact(friction, bound);
      const std::vector<ContactPoint> points = c.points(s.x, s.start, s.multipliers);
      ASSERT_GE(points.size(), 6u);
      const long slipping = std::count_if(points.begin(), points.end(), [](const ContactPoint& p) { return p.slips; });
      if (friction == 0.15) {
        ASSERT_GT(slipping, 3);
      }
      if (friction == 50) {
        ASSERT_EQ(slipping, 0);
      }
      const Errors e = errorsOf(c, s);
      EXPECT_LT(e.slope, 1e-7) << friction;
      if (bound == FrictionBound::symmetrised || slipping == 0)
        EXPECT_LT(e.asymmetry, 1e-12) << friction;
      else
        EXPECT_GT(e.asymmetry, 1e-3) << friction;
    }
  }
}

TEST(SolidContact, PressureIsTheGradientOfItsEnergy) {
  const Scene s;
  const SolidContact c = s.contact(0, FrictionBound::symmetrised);
  const auto energy = [&](const std::vector<Vec3>& x) { return c.energy(c.points(x, s.start, s.multipliers)); };
  const std::vector<Vec3> f = forceOf(c, s, s.x);
  double most = 0;
  for (const Vec3& v : f) most = std::max(most, norm(v));
  for (std::size_t i = 0; i < s.x.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      std::vector<Vec3> up = s.x, down = s.x;
      up[i][d] += 1e-6, down[i][d] -= 1e-6;
      EXPECT_NEAR((energy(up) - energy(down)) / 2e-6, f[i][d], 1e-7 * most);
    }
}

TEST(SolidContact, KeepsMomentumAndAngularMomentum) {
  const Scene s;
  const SolidContact c = s.contact(0.3, FrictionBound::symmetrised);
  const std::vector<Vec3> f = forceOf(c, s, s.x);
  Vec3 force{}, moment{};
  double size = 0;
  for (std::size_t i = 0; i < f.size(); ++i) force += f[i], moment += cross(s.x[i], f[i]), size += norm(f[i]);
  EXPECT_GT(size, 100);
  EXPECT_LT(norm(force), 1e-14 * size);
  EXPECT_LT(norm(moment), 1e-13 * size);
}

TEST(SolidContact, TractionGoesWithWhatTurns) {
  Scene s;
  const SolidContact c = s.contact(50, FrictionBound::symmetrised);
  const std::vector<Vec3> f = forceOf(c, s, s.x);
  const Mat3 R = rotationAbout(normalized(Vec3{1, 3, -2}), 1.1);
  for (Vec3& x : s.x) x = R * x + Vec3{1, 2, 3};
  const std::vector<Vec3> turned = forceOf(c, s, s.x);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LT(norm(turned[i] - R * f[i]), 1e-10);
}

TEST(SolidContact, ANewContactOfBox7DoesNotRubInItsFirstPass) {
  const Scene s;
  for (const FrictionBound bound : {FrictionBound::coupled, FrictionBound::symmetrised}) {
    const SolidContact c = s.contact(0.3, bound);
    for (const ContactPoint& p : c.points(s.x, s.start, {})) {
      EXPECT_EQ(p.rubs, bound == FrictionBound::coupled);
      EXPECT_GT(p.pressure_Pa, 0);
    }
  }
}

TEST(SolidContact, AugmentedTractionsKeepCoulomb) {
  const Scene s;
  const SolidContact c = s.contact(0.15, FrictionBound::symmetrised);
  const std::vector<ContactPoint> points = c.points(s.x, s.start, s.multipliers);
  std::vector<ContactMultipliers> next = c.augmented(points);
  int at_bound = 0;
  for (const ContactMultipliers& m : next) {
    const ContactPoint& p =
        *std::find_if(points.begin(), points.end(), [&](const ContactPoint& q) { return q.slave == m.slave; });
    EXPECT_EQ(m.pressure_Pa, p.pressure_Pa);
    if (!p.rubs) continue;
    const auto& M = p.metric_m2;
    const Vec2 t = m.traction_N_per_m;
    const double size =
        std::sqrt((M[1] * t.x * t.x + M[0] * t.y * t.y - 2 * M[2] * t.x * t.y) / (M[0] * M[1] - M[2] * M[2]));
    EXPECT_LE(size, 0.15 * p.pressure_Pa * (1 + 1e-12));
    at_bound += size > 0.15 * p.pressure_Pa * (1 - 1e-12);
  }
  EXPECT_GT(at_bound, 2);
}

TEST(SolidContact, TractionIsTheSameInTheFrameOfTheNextFacet) {
  // Two facets of a plane, their frames turned against each other.
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 0}, {1.1, 0.4, -0.01}};
  SolidContactLaw law{1000, 1000, 0.5, FrictionBound::symmetrised, {}};
  law.touch.reach_m = 0.5;
  const SolidContact c({{{6}, {1}, FacetSurface({{0, 1, 4, 3}, {2, 5, 4, 1}}, 7)}}, law, x);
  // T of the first facet: (1/2, 0, 0) and (0, 1/2, 0). A traction of (3, -4, 0) Pa.
  const std::vector<ContactMultipliers> moved = c.settled(x, {{0, 0, 1, 0, 10, {1.5, -2}}});
  ASSERT_EQ(moved[0].rub_facet, 1);
  const FacetCorners second = c.cornersOf(0, 1, x);
  const std::array<Vec3, 2> T = facetTangents(second, *projectOnFacet(second, x[6], 2));
  EXPECT_NEAR(moved[0].traction_N_per_m.x, dot(T[0], Vec3{3, -4, 0}), 1e-12);
  EXPECT_NEAR(moved[0].traction_N_per_m.y, dot(T[1], Vec3{3, -4, 0}), 1e-12);
}

TEST(SolidContact, MultipliersGoAlongOverAnEdge) {
  const std::vector<FacetTouch> touches{{7, {}, 0}, {3, {}, 0}};
  const auto on = [](int facet) { return ContactMultipliers{0, 0, facet, facet, 1, {}}; };
  const std::vector<ContactMultipliers> both{on(3), on(7)}, one{on(3)}, gone{on(5)}, mixed{on(3), on(5)};
  EXPECT_EQ(matchTouches(touches, both), (std::vector<int>{1, 0}));
  EXPECT_EQ(matchTouches(touches, one), (std::vector<int>{-1, 0}));
  EXPECT_EQ(matchTouches(touches, gone), (std::vector<int>{0, -1}));
  EXPECT_EQ(matchTouches(touches, mixed), (std::vector<int>{1, 0}));
  EXPECT_EQ(matchTouches(touches, {}), (std::vector<int>{-1, -1}));
}

TEST(SolidContact, FacetsOfAShallowGrooveShareANodeBeyondTheEdge) {
  // Two facets that meet along y; the node has rested on the first and lies 0.2 half widths beyond its edge.
  const std::vector<Vec3> x{{-1, -1, 0.1}, {0, -1, 0}, {1, -1, 0.1}, {-1, 1, 0.1}, {0, 1, 0}, {1, 1, 0.1}, {0.1, 0, 0}};
  SolidContactLaw law{3000, 0, 0, FrictionBound::symmetrised, {}};
  law.touch = {0.4, 0.5, true, 0.3};
  const SolidContact c({{{6}, {1.0}, FacetSurface({{0, 1, 4, 3}, {1, 2, 5, 4}}, 7)}}, law, x);
  std::vector<ContactMultipliers> m{{0, 0, 0, 0, 60, {}}};
  EXPECT_EQ(c.moveOn(x, m, false), 0);
  EXPECT_EQ(c.moveOn(x, m, true), 1);
  ASSERT_EQ(m.size(), 2u);
  EXPECT_EQ(m[0].facet, 0);
  EXPECT_EQ(m[1].facet, 1);
  EXPECT_EQ(m[1].pressure_Pa, 0);
  EXPECT_EQ(c.moveOn(x, m, true), 0);
  EXPECT_EQ(c.points(x, x, m).size(), 2u);
  m[1].pressure_Pa = 20;
  EXPECT_EQ(c.moveOn(x, m, false), 1);
  ASSERT_EQ(m.size(), 1u);
  EXPECT_EQ(m[0].pressure_Pa, 80);
  // Farther on the second holds it alone, with what the first carried.
  std::vector<Vec3> farther = x;
  farther[6].x = 0.3;
  EXPECT_EQ(c.moveOn(farther, m, true), 1);
  ASSERT_EQ(m.size(), 1u);
  EXPECT_EQ(m[0].facet, 1);
  EXPECT_EQ(m[0].pressure_Pa, 80);
}

TEST(SolidContact, ANodeThatSlidesTooFarInAStepHasNoForce) {
  Scene s;
  s.start[s.nodes[0]] += Vec3{-3, 0, 0};
  const std::vector<ContactPoint> points =
      s.contact(0.3, FrictionBound::symmetrised).points(s.x, s.start, s.multipliers);
  EXPECT_TRUE(std::isnan(points.front().pressure_Pa));
}

TEST(SolidContact, SameBitsForAnyNumberOfThreads) {
  const Scene s;
  const SolidContact c = s.contact(0.3, FrictionBound::coupled);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<Vec3> one = forceOf(c, s, s.x);
  omp_set_num_threads(3);
  const std::vector<Vec3> three = forceOf(c, s, s.x);
  omp_set_num_threads(before);
  EXPECT_EQ(one, three);
}

void expectRefused(const std::string& key, const std::function<void(ContactSide&, SolidContactLaw&)>& spoil) {
  const Scene s;
  ContactSide side = s.side();
  SolidContactLaw law{3000, 2000, 0.3, FrictionBound::coupled, {}};
  law.touch.reach_m = 0.4;
  spoil(side, law);
  try {
    const SolidContact c({side}, law, s.rest);
    ADD_FAILURE() << key << " was accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, key);
  }
}

TEST(SolidContact, BadInputIsRefused) {
  expectRefused("normal_Pa_per_m", [](ContactSide&, SolidContactLaw& l) { l.normal_Pa_per_m = 0; });
  expectRefused("tangential_Pa_per_m", [](ContactSide&, SolidContactLaw& l) { l.tangential_Pa_per_m = std::nan(""); });
  expectRefused("friction", [](ContactSide&, SolidContactLaw& l) { l.friction = -0.1; });
  expectRefused("reach_m", [](ContactSide&, SolidContactLaw& l) { l.touch.reach_m = 0; });
  expectRefused("groove_rad", [](ContactSide&, SolidContactLaw& l) { l.touch.groove_rad = 4; });
  expectRefused("areas_m2", [](ContactSide& s, SolidContactLaw&) { s.areas_m2.pop_back(); });
  expectRefused("areas_m2", [](ContactSide& s, SolidContactLaw&) { s.areas_m2[1] = 0; });
  expectRefused("nodes", [](ContactSide& s, SolidContactLaw&) { s.nodes[1] = 25; });
  expectRefused("nodes", [](ContactSide& s, SolidContactLaw&) { s.nodes[1] = 3; });
}

}  // namespace
}  // namespace gambeson
