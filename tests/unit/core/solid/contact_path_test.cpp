/// Solids that touch: each way to enforce contact, friction, the groove of Man's fig. 14, Hertz.

#include "core/solid/contact_path.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "unit/core/solid/solid_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const Vec3 kAxes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// A block over an obstacle of rigid facets.
struct Scene {
  SolidMesh mesh;
  std::vector<Facet> obstacle;
  SolidSupports supports;
  std::vector<ContactSide> sides;
  std::unique_ptr<SolidBody> body;
  std::unique_ptr<SolidSystem> solids;

  explicit Scene(SolidMesh m) : mesh(std::move(m)) {}

  void addObstacle(const std::vector<Vec3>& nodes, const std::vector<Facet>& facets) {
    const int first = static_cast<int>(mesh.nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      mesh.nodes.push_back(nodes[i]);
      for (const Vec3& axis : kAxes) supports.constraints.push_back(prescribed(first + static_cast<int>(i), axis));
    }
    for (const Facet& f : facets) obstacle.push_back({f[0] + first, f[1] + first, f[2] + first, f[3] + first});
  }
  void hold(const std::vector<int>& nodes, const Vec3& axis, double amount = 0, int program = -1) {
    for (const int i : nodes) supports.constraints.push_back(prescribed(i, axis, amount, program));
  }
  std::vector<int> where(const std::function<bool(const Vec3&)>& at) const { return nodesWhere(mesh, at); }

  /// The skin where `at` holds must not pass the obstacle.
  SolidContact build(const SolidContactLaw& law, const std::function<bool(const Vec3&)>& at) {
    body = std::make_unique<SolidBody>(mesh);
    solids = std::make_unique<SolidSystem>(*body, supports);
    std::vector<Facet> skin;
    for (const Facet& f : boundaryFacets(mesh))
      if (std::all_of(f.begin(), f.end(), [&](int node) { return at(mesh.nodes[node]); })) skin.push_back(f);
    return SolidContact({contactSide(skin, FacetSurface(obstacle, static_cast<int>(mesh.nodes.size())), mesh.nodes)},
                        law, mesh.nodes);
  }
};

struct Path {
  ContactReport report;
  std::vector<ContactStep> steps;
  const ContactStep& last() const { return steps.back(); }
};

Path followed(Scene& s, const SolidContact& contact, const ContactPathOptions& options) {
  Path path;
  ContactState state = contactStart(*s.solids);
  path.report = followContact(*s.solids, contact, options, state, [&](const ContactStep& step) {
    path.steps.push_back(step);
    return true;
  });
  return path;
}

/// Nodes and facets of a plane square of n by n facets.
void addPlane(Scene& s, int n) {
  std::vector<Vec3> nodes;
  std::vector<Facet> facets;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) nodes.push_back({-0.57 + 2.2 * i / n, -0.61 + 2.2 * j / n, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j;
      facets.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  s.addObstacle(nodes, facets);
}

/// A soft cube on a plane, pressed by 5 % in the first half of the path. Its top is free to spread, or else it is held
/// and pulled aside in the second half.
Scene cubeOnPlane(int cells, bool free, double aside = 0) {
  SolidMesh m = block(cells, cells, cells, [](const Vec3& p) { return p; });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  Scene s(m);
  s.supports.programs = {{{0, 0.5}, {0, 1}}, {{0.5, 1}, {0, 1}}};
  const std::vector<int> top = s.where([](const Vec3& X) { return X.z > 0.999; });
  s.hold(top, kAxes[2], -0.05, 0);
  for (int d = 0; d < 2; ++d)
    s.hold(free ? s.where([&](const Vec3& X) { return X[d] < 1e-9; }) : top, kAxes[d], d == 0 ? aside : 0, 1);
  addPlane(s, 6);
  return s;
}

bool atBottom(const Vec3& X) { return X.z < 1e-9; }

SolidContactLaw lawOf(double normal_Pa_per_m, double friction = 0, FrictionBound bound = FrictionBound::symmetrised) {
  SolidContactLaw law{normal_Pa_per_m, 1e7, friction, bound, {}};
  law.touch.reach_m = 0.3;
  return law;
}

ContactPathOptions optionsOf(SolidContactMethod method, int steps) {
  ContactPathOptions o;
  o.method = method;
  o.steps = steps;
  o.deepest_m = 1e-6;
  return o;
}

constexpr SolidContactMethod kMethods[] = {SolidContactMethod::penalty, SolidContactMethod::multipliers,
                                           SolidContactMethod::augmented};

/// The last Newton step squares the residual, as far as rounding lets it.
void expectQuadratic(const std::vector<double>& residuals) {
  ASSERT_GE(residuals.size(), 3u);
  const double before = residuals[residuals.size() - 2], last = residuals.back();
  EXPECT_LT(before, 1e-2);
  EXPECT_LT(last, std::max(10 * before * before, 1e-11));
}

TEST(ContactPath, AUniformPressureIsUniform) {
  for (const SolidContactMethod method : kMethods) {
    Scene s = cubeOnPlane(3, true);
    const SolidContact c = s.build(lawOf(2e7), atBottom);
    const Path p = followed(s, c, optionsOf(method, 2));
    ASSERT_TRUE(p.report.reached) << p.report.why;
    ASSERT_EQ(p.last().points.size(), 16u);
    double pressed = 0, reaction = 0;
    const double pressure = p.last().points[0].pressure_Pa;
    for (const ContactPoint& q : p.last().points) {
      pressed += q.area_m2 * q.pressure_Pa;
      EXPECT_NEAR(q.pressure_Pa, pressure, 1e-7 * pressure);
      if (method == SolidContactMethod::penalty) {
        EXPECT_NEAR(q.over.gap_m, pressure / 2e7, 1e-12);
      }
      if (method == SolidContactMethod::multipliers) {
        EXPECT_LT(std::abs(q.over.gap_m), 1e-14);
      }
    }
    EXPECT_LE(p.last().deepest_m, method == SolidContactMethod::penalty ? 1 : 1e-6);
    const std::vector<Vec3> forces = s.solids->reactions(p.last().state.y, 1);
    for (const int i : s.where([](const Vec3& X) { return X.z > 0.999; })) reaction -= forces[i].z;
    EXPECT_GT(pressure, 4e4);
    EXPECT_NEAR(pressed, reaction, 1e-7 * reaction);
    expectQuadratic(p.steps.front().residuals);
  }
}

TEST(ContactPath, WhatIsReleasedIsAsBefore) {
  for (const SolidContactMethod method : kMethods) {
    Scene s = cubeOnPlane(2, true);
    s.supports.programs[0] = {{0, 0.5, 1}, {0, 1, -0.2}};
    const SolidContact c = s.build(lawOf(2e7), atBottom);
    const Path p = followed(s, c, optionsOf(method, 4));
    ASSERT_TRUE(p.report.reached) << p.report.why;
    EXPECT_EQ(p.steps[1].points.size(), 9u);
    EXPECT_TRUE(p.last().points.empty());
    EXPECT_TRUE(p.last().state.multipliers.empty());
    EXPECT_LT(s.solids->energy(p.last().state.y, 1), 1e-12 * s.solids->energy(p.steps[1].state.y, 0.5));
  }
}

/// A block whose lower edge stands in the groove z = slope |x| of two facets (Man 2006, fig. 14), a little off its
/// middle.
Scene groove(double aside, double slope = 1) {
  SolidMesh m = block(4, 1, 3, [&](const Vec3& p) {
    const double x = p.x - 0.5, bottom = 1.5 * std::abs(x);
    return Vec3{x + aside, 0.25 * p.y, bottom + (1.2 - bottom) * p.z};
  });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  Scene s(m);
  s.hold(s.where([](const Vec3&) { return true; }), kAxes[1]);
  const std::vector<int> top = s.where([](const Vec3& X) { return X.z > 1.199; });
  s.hold(top, kAxes[2], -0.08, 0);
  s.hold(top, kAxes[0]);
  s.addObstacle({{-1, -1, slope}, {0, -1, 0}, {1, -1, slope}, {-1, 1, slope}, {0, 1, 0}, {1, 1, slope}},
                {{0, 1, 4, 3}, {1, 2, 5, 4}});
  return s;
}

SolidContact grooveContact(Scene& s, double aside, bool simultaneous) {
  SolidContactLaw law = lawOf(1e8);
  law.touch.simultaneous = simultaneous;
  return s.build(law, [=](const Vec3& X) { return X.z < 1.5 * std::abs(X.x - aside) + 1e-9; });
}

TEST(ContactPath, ABlockSettlesInAGroove) {
  for (const SolidContactMethod method : kMethods)
    for (const double aside : {0.0, 0.013}) {
      Scene s = groove(aside);
      const SolidContact c = grooveContact(s, aside, true);
      ContactPathOptions o = optionsOf(method, 1);
      o.halvings = 0;
      const Path p = followed(s, c, o);
      ASSERT_TRUE(p.report.reached) << p.report.why;
      EXPECT_LE(p.last().iterations, 8);
      ASSERT_EQ(p.last().points.size(), 4u);  // two nodes, each on both facets
      double push = 0, way = 0;
      for (const ContactPoint& q : p.last().points) {
        EXPECT_GT(q.pressure_Pa, 4e4);
        push += q.area_m2 * q.pressure_Pa * q.over.normal.x;
        way += q.facet == 0 ? 1 : -1;
      }
      EXPECT_EQ(way, 0);
      if (aside == 0) {
        EXPECT_NEAR(push, 0, 1e-6);
      }
    }
}

TEST(ContactPath, ABlockSettlesOnTwoFacetsThatMeetAtNearlyNoAngle) {
  for (const SolidContactMethod method : kMethods)
    for (const double slope : {1e-2, 1e-5}) {
      SolidMesh m = block(2, 2, 2, [](const Vec3& p) { return p; });
      m.materials = {{isotropicLaw(1e6, 0.3), 0}};
      Scene s(m);
      const std::vector<int> top = s.where([](const Vec3& X) { return X.z > 0.999; });
      s.hold(top, kAxes[2], -0.05, 0);
      for (int d = 0; d < 2; ++d) s.hold(top, kAxes[d]);
      const double rise = 1.5 * slope;
      s.addObstacle({{-1, -1, rise}, {0.5, -1, 0}, {2, -1, rise}, {-1, 2, rise}, {0.5, 2, 0}, {2, 2, rise}},
                    {{0, 1, 4, 3}, {1, 2, 5, 4}});
      const SolidContact c = s.build(lawOf(2e7), atBottom);
      const Path p = followed(s, c, optionsOf(method, 2));
      ASSERT_TRUE(p.report.reached) << p.report.why;
      double pressed = 0, reaction = 0;
      for (const ContactPoint& q : p.last().points) pressed += q.area_m2 * q.pressure_Pa * q.over.normal.z;
      const std::vector<Vec3> forces = s.solids->reactions(p.last().state.y, 1);
      for (const int i : top) reaction -= forces[i].z;
      EXPECT_NEAR(pressed, reaction, 1e-7 * reaction);
    }
}

TEST(ContactPath, WithOneFacetAtATimeABlockGoesToAndFroInAGroove) {
  for (const SolidContactMethod method : kMethods) {
    Scene s = groove(0.013);
    const SolidContact c = grooveContact(s, 0.013, false);
    ContactPathOptions o = optionsOf(method, 1);
    o.halvings = 0;
    EXPECT_FALSE(followed(s, c, o).report.reached);
  }
  // His positions 1 and 2: held by one facet, the edge lies nearest to the other, again and again.
  Scene s = groove(0.013);
  const SolidContact c = grooveContact(s, 0.013, false);
  TangentSolver solver;
  ContactSystem system(*s.solids, c, solver, 1, s.mesh.nodes);
  std::vector<double> y(s.solids->size(), 0.0);
  std::vector<int> held;
  std::vector<ContactPoint> passed = system.points({}, y);
  for (int trial = 0; trial < 6; ++trial) {
    std::vector<ContactMultipliers> pairs;
    for (const ContactPoint& q : passed) pairs.push_back({q.side, q.slave, q.facet, q.facet, 0, {}});
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_EQ(pairs[0].facet, pairs[1].facet);
    held.push_back(pairs[0].facet);
    ASSERT_TRUE(system.solveTogether(pairs, {30, 1e-9, 0}, y).converged);
    passed = system.points({}, y);
  }
  for (int trial = 1; trial < 6; ++trial) EXPECT_EQ(held[trial], 1 - held[trial - 1]);
}

/// Both triangles as a full matrix.
std::vector<double> fullMatrix(const std::vector<MatrixEntry>& entries, std::size_t n) {
  std::vector<double> K(n * n, 0.0);
  for (const MatrixEntry& e : entries) K[n * e.row + e.column] += e.value;
  return K;
}

double asymmetry(const std::vector<double>& K, std::size_t n) {
  double most = 0, error = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      most = std::max(most, std::abs(K[n * i + j]));
      error = std::max(error, std::abs(K[n * i + j] - K[n * j + i]));
    }
  return error / most;
}

TEST(ContactPath, Box7AnswersAsBox6WithASymmetricTangent) {
  const double mu = 0.3;
  for (const double aside : {0.02, 0.2}) {  // a part slips, all slips over several facets
    Path path[2];
    std::vector<Vec3> x[2];
    for (const FrictionBound bound : {FrictionBound::coupled, FrictionBound::symmetrised}) {
      const int k = bound == FrictionBound::symmetrised;
      Scene s = cubeOnPlane(2, false, aside);
      const SolidContact c = s.build(lawOf(2e7, mu, bound), atBottom);
      ContactPathOptions o = optionsOf(SolidContactMethod::augmented, 6);
      o.change = 1e-7;
      path[k] = followed(s, c, o);
      ASSERT_TRUE(path[k].report.reached) << path[k].report.why;
      const ContactStep& last = path[k].last();
      x[k] = s.solids->positions(last.state.y, 1);
      double slipping = 0, most = 0;
      for (const ContactPoint& q : last.points) most = std::max(most, q.pressure_Pa), slipping += q.slips;
      for (const ContactPoint& q : last.points) {
        EXPECT_LE(q.tractionSize(), mu * q.pressure_Pa + 1e-6 * mu * most);
        if (q.slips) {
          EXPECT_NEAR(q.tractionSize(), mu * q.pressure_Pa, 1e-6 * mu * most);
        }
      }
      EXPECT_GT(slipping, 0);
      EXPECT_EQ(slipping == 9, aside == 0.2);
      EXPECT_LE(last.deepest_m, 1e-3);  // of the cube's side; here b = 1
      expectQuadratic(last.residuals);

      // The tangent where the path ends, its multipliers those of the last step.
      const ContactStep& before = path[k].steps[path[k].steps.size() - 2];
      TangentSolver solver;
      ContactSystem system(*s.solids, c, solver, 1, s.solids->positions(before.state.y, before.state.factor));
      const std::size_t n = last.state.y.size();
      const double skew = asymmetry(fullMatrix(system.tangent(last.state.multipliers, last.state.y), n), n);
      if (bound == FrictionBound::symmetrised)
        EXPECT_LT(skew, 1e-12);
      else
        EXPECT_GT(skew, 1e-3);
    }
    double apart = 0;
    for (std::size_t i = 0; i < x[0].size(); ++i) apart = std::max(apart, norm(x[0][i] - x[1][i]));
    EXPECT_LT(apart, 1e-4 * 0.05);  // of what the cube is pressed by
    const std::vector<ContactPoint>&a = path[0].last().points, &b = path[1].last().points;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_NEAR(a[k].pressure_Pa, b[k].pressure_Pa, 1e-4 * a[k].pressure_Pa);
      EXPECT_NEAR(a[k].tractionSize(), b[k].tractionSize(), 1e-4 * mu * a[k].pressure_Pa);
    }
  }
}

TEST(ContactPath, WhatIsNewInBox7RubsAfterTwoAugmentations) {
  Scene s = cubeOnPlane(2, false);
  const SolidContact c = s.build(lawOf(2e7, 0.3), atBottom);
  ContactPathOptions o = optionsOf(SolidContactMethod::augmented, 2);
  o.change = 10;  // no multiplier is asked to stay
  o.deepest_m = 1;
  const Path p = followed(s, c, o);
  ASSERT_TRUE(p.report.reached) << p.report.why;
  EXPECT_EQ(p.steps[0].passes, 3);
  ASSERT_EQ(p.steps[0].points.size(), 9u);
  for (const ContactPoint& q : p.steps[0].points) EXPECT_TRUE(q.rubs);
}

TEST(ContactPath, WhatWouldSlipToAndFroComesToRest) {
  // Box 7: what spreads without friction in the first pass is drawn back through its stick zone in the second.
  Scene s = cubeOnPlane(3, false);
  const SolidContact c = s.build(lawOf(2e7, 0.3), atBottom);
  ContactPathOptions o = optionsOf(SolidContactMethod::augmented, 10);
  o.halvings = 0;
  const Path p = followed(s, c, o);
  EXPECT_TRUE(p.report.reached) << p.report.why;
}

TEST(ContactPath, WhatSlidesIsDraggedByCoulombsForce) {
  for (const SolidContactMethod method : {SolidContactMethod::penalty, SolidContactMethod::augmented}) {
    Scene s = cubeOnPlane(2, false, 0.3);
    const SolidContact c = s.build(lawOf(2e7, 0.2, FrictionBound::coupled), atBottom);
    const Path p = followed(s, c, optionsOf(method, 6));
    ASSERT_TRUE(p.report.reached) << p.report.why;
    const std::vector<Vec3> forces = s.solids->reactions(p.last().state.y, 1);
    Vec3 pull{};
    for (const int i : s.where([](const Vec3& X) { return X.z > 0.999; })) pull += forces[i];
    EXPECT_LT(pull.z, -4e4);
    EXPECT_NEAR(pull.x, -0.2 * pull.z, 1e-3 * std::abs(pull.z));  // sideways tractions of what spreads are lost to it
  }
}

TEST(ContactPath, ACylinderOnAPlanePressesAsHertzSays) {
  // Plane strain; R = 4, contact 0.13 wide on a block of side 1, cells of 0.008 in the middle. Johnson, Contact
  // mechanics (1985), eq. 4.43, 4.45: a^2 = 4 P R/(pi E*), p0 = sqrt(P E*/(pi R)), p = p0 sqrt(1 - (x/a)^2).
  const double R = 4, stiffness = 1e6 / (1 - 0.09), width = 0.1;
  const int n = 16;
  const auto bottomOf = [&](double x) { return R - std::sqrt(R * R - x * x); };
  const auto grade = [](double v) { return std::expm1(3.5 * v) / std::expm1(3.5); };
  SolidMesh m = block(n, 1, n, [&](const Vec3& p) {
    const double x = grade(p.x), bottom = bottomOf(x);
    return Vec3{x, width * p.y, bottom + (1 - bottom) * grade(p.z)};
  });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  Scene s(m);
  s.hold(s.where([](const Vec3&) { return true; }), kAxes[1]);
  s.hold(s.where([](const Vec3& X) { return X.x < 1e-9; }), kAxes[0]);
  s.hold(s.where([](const Vec3& X) { return X.z > 0.999; }), kAxes[2], -0.006, 0);
  s.addObstacle({{-1, -1, 0}, {2, -1, 0}, {2, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}});
  const SolidContact c = s.build(lawOf(2e8), [&](const Vec3& X) { return X.z < bottomOf(X.x) + 1e-9 && X.x < 0.5; });
  const Path p = followed(s, c, optionsOf(SolidContactMethod::augmented, 3));
  ASSERT_TRUE(p.report.reached) << p.report.why;
  double force_N_per_m = 0, largest = 0, reaches = 0;
  for (const ContactPoint& q : p.last().points) {
    force_N_per_m += 2 * q.area_m2 * q.pressure_Pa / width;  // of both halves
    largest = std::max(largest, q.pressure_Pa);
    reaches = std::max(reaches, s.mesh.nodes[q.node].x);
  }
  const double p0 = std::sqrt(force_N_per_m * stiffness / (std::numbers::pi * R));
  const double a = std::sqrt(4 * force_N_per_m * R / (std::numbers::pi * stiffness));
  EXPECT_NEAR(largest, p0, 0.01 * p0);
  EXPECT_NEAR(reaches, a, 0.025);  // a cell there
  for (const ContactPoint& q : p.last().points) {
    const double at = s.mesh.nodes[q.node].x / a;
    if (at < 0.7) {
      EXPECT_NEAR(q.pressure_Pa, p0 * std::sqrt(1 - at * at), 0.05 * p0);
    }
  }
  EXPECT_LE(p.last().deepest_m, 1e-6);
  expectQuadratic(p.last().residuals);
}

TEST(ContactPath, TwoSoftBodiesPushEachOtherAlike) {
  // Two blocks whose meshes do not match, each side's nodes against the other's facets with half of their areas.
  SolidMesh m = block(3, 3, 2, [](const Vec3& p) { return Vec3{p.x + 0.21, p.y + 0.17, p.z}; });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  const int upper_cells = static_cast<int>(m.cells.size());
  SolidMesh lower = block(2, 2, 2, [](const Vec3& p) { return Vec3{1.5 * p.x, 1.5 * p.y, p.z - 1}; });
  lower.materials = {{isotropicLaw(2e6, 0.2), 0}};
  append(m, lower);
  Scene s(m);
  s.hold(s.where([](const Vec3& X) { return X.z < -0.999; }), kAxes[2]);
  for (int d = 0; d < 2; ++d) s.hold(s.where([](const Vec3& X) { return X.z < -0.999 || X.z > 0.999; }), kAxes[d]);
  s.hold(s.where([](const Vec3& X) { return X.z > 0.999; }), kAxes[2], -0.06, 0);
  s.body = std::make_unique<SolidBody>(m);
  s.solids = std::make_unique<SolidSystem>(*s.body, s.supports);
  const auto skin = [&](int first, int end, double at) {
    std::vector<Facet> facets;
    for (const Facet& f : boundaryFacets(m, first, end))
      if (std::all_of(f.begin(), f.end(), [&](int node) { return std::abs(m.nodes[node].z - at) < 1e-9; }))
        facets.push_back(f);
    return facets;
  };
  const int nodes = static_cast<int>(m.nodes.size());
  const std::vector<Facet> above = skin(0, upper_cells, 0),
                           below = skin(upper_cells, static_cast<int>(m.cells.size()), 0);
  const SolidContact c({contactSide(above, FacetSurface(below, nodes), m.nodes, 0.5),
                        contactSide(below, FacetSurface(above, nodes), m.nodes, 0.5)},
                       lawOf(5e7), m.nodes);
  ContactPathOptions o = optionsOf(SolidContactMethod::augmented, 2);
  o.deepest_m = 1e-3;
  o.change = 1e-3;
  const Path p = followed(s, c, o);
  ASSERT_TRUE(p.report.reached) << p.report.why;
  const std::vector<Vec3> forces = s.solids->reactions(p.last().state.y, 1);
  double pressed = 0;
  for (const ContactPoint& q : p.last().points) pressed += q.area_m2 * q.pressure_Pa;
  EXPECT_GT(pressed, 1e4);
  double down = 0, up = 0;
  for (const int i : s.where([](const Vec3& X) { return X.z > 0.999; })) down -= forces[i].z;
  for (const int i : s.where([](const Vec3& X) { return X.z < -0.999; })) up += forces[i].z;
  EXPECT_NEAR(down, up, 1e-8 * up);
  EXPECT_NEAR(down, pressed, 1e-3 * pressed);  // facets are a little off the horizontal
}

/// A straight yarn of elliptical section, 3 b wide and 2 b high, its middle at the height z.
SolidMesh yarn(bool along_x, double z, double b) {
  SolidMesh m = block(9, 3, 3, [&](const Vec3& p) {
    const double u = 2 * p.y - 1, v = 2 * p.z - 1, along = 6 * b * (p.x - 0.5);
    const double across = 1.5 * b * u * std::sqrt(1 - 0.5 * v * v), up = z + b * v * std::sqrt(1 - 0.5 * u * u);
    return along_x ? Vec3{along, across, up} : Vec3{-across, along, up};
  });
  m.materials = {{kevlar(), 0}};
  m.fibres.assign(m.cells.size(), along_x ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  return m;
}

TEST(ContactPath, AYarnIsPressedOnAnotherAndSlidesAlongIt) {
  const double b = 1e-4, mu = 0.3;
  SolidMesh m = yarn(true, b, b);
  const int upper_cells = static_cast<int>(m.cells.size()), upper_nodes = static_cast<int>(m.nodes.size());
  const SolidMesh lower = yarn(false, -b, b);
  append(m, lower);
  m.fibres.insert(m.fibres.end(), lower.fibres.begin(), lower.fibres.end());
  Scene s(m);
  s.supports.programs = {{{0, 0.5}, {0, 1}}, {{0.5, 1}, {0, 1}}};
  for (int i = 0; i < static_cast<int>(m.nodes.size()); ++i) {
    const bool upper = i < upper_nodes;
    if (std::abs(upper ? m.nodes[i].x : m.nodes[i].y) < 3 * b * (1 - 1e-9)) continue;
    s.hold({i}, kAxes[0]);
    s.hold({i}, kAxes[1], upper ? 0.5 * b : 0, 1);
    s.hold({i}, kAxes[2], upper ? -0.25 * b : 0, 0);
  }
  s.body = std::make_unique<SolidBody>(m);
  s.solids = std::make_unique<SolidSystem>(*s.body, s.supports);
  SolidContactLaw law{1e14, 1.5e13, mu, FrictionBound::symmetrised, {}};
  law.touch.reach_m = 0.5 * b;
  const FacetSurface skin(boundaryFacets(m, upper_cells, static_cast<int>(m.cells.size())),
                          static_cast<int>(m.nodes.size()));
  const SolidContact c({contactSide(boundaryFacets(m, 0, upper_cells), skin, m.nodes)}, law, m.nodes);
  ContactPathOptions o = optionsOf(SolidContactMethod::augmented, 6);
  o.change = 1e-4;
  o.deepest_m = 1e-3 * b;
  const Path p = followed(s, c, o);
  ASSERT_TRUE(p.report.reached) << p.report.why;
  EXPECT_LE(p.last().deepest_m, 1e-3 * b);
  double most = 0;
  for (const ContactPoint& q : p.last().points) most = std::max(most, q.pressure_Pa);
  EXPECT_GE(p.last().points.size(), 4u);
  for (const ContactPoint& q : p.last().points) {
    EXPECT_TRUE(q.slips);
    EXPECT_NEAR(q.tractionSize(), mu * q.pressure_Pa, 1e-4 * mu * most);
  }
  expectQuadratic(p.last().residuals);
  // What drags the upper yarn's ends is friction, and little else: the yarns cross at right angles.
  const std::vector<Vec3> forces = s.solids->reactions(p.last().state.y, 1);
  Vec3 held{};
  for (int i = 0; i < upper_nodes; ++i)
    if (std::abs(m.nodes[i].x) > 3 * b * (1 - 1e-9)) held += forces[i];
  EXPECT_LT(held.z, -0.5);
  EXPECT_NEAR(held.y, -mu * held.z, 0.02 * std::abs(held.z));
}

TEST(ContactPath, SameBitsForAnyNumberOfThreads) {
  std::vector<double> y[2];
  const int before = omp_get_max_threads();
  for (const int k : {0, 1}) {
    omp_set_num_threads(k == 0 ? 1 : 3);
    Scene s = cubeOnPlane(2, false, 0.05);
    const SolidContact c = s.build(lawOf(2e7, 0.3), atBottom);
    y[k] = followed(s, c, optionsOf(SolidContactMethod::augmented, 2)).last().state.y;
  }
  omp_set_num_threads(before);
  EXPECT_EQ(y[0], y[1]);
}

TEST(ContactPath, WhereNodesKeepFacetsTheyComeToTheSameRest) {
  for (const SolidContactMethod method : {SolidContactMethod::penalty, SolidContactMethod::augmented}) {
    std::vector<double> y[2];
    for (const int k : {0, 1}) {
      Scene s = cubeOnPlane(2, false, 0.05);
      SolidContactLaw law = lawOf(2e7);
      law.touch.keep = 0.3 * k;
      const SolidContact c = s.build(law, atBottom);
      const Path p = followed(s, c, optionsOf(method, 2));
      ASSERT_TRUE(p.report.reached) << p.report.why;
      EXPECT_EQ(p.last().points.size(), 9u);
      y[k] = p.last().state.y;
    }
    for (std::size_t i = 0; i < y[0].size(); ++i) EXPECT_NEAR(y[0][i], y[1][i], 1e-7);
  }
}

/// A groove that is too shallow for its facets to hold a node at once; on either alone it would rest beyond the edge,
/// under the other. Where nodes keep their facets both hold it, from the next pass on.
TEST(ContactPath, FacetsOfAShallowGrooveShareANode) {
  constexpr double kAside = 0.003, kSlope = 0.15;
  Scene s = groove(kAside, kSlope);
  SolidContactLaw law = lawOf(1e8);
  law.touch.groove_rad = 0.5;  // they meet at 0.3
  law.touch.keep = 0.3;
  const SolidContact c = s.build(law, [&](const Vec3& X) { return X.z < 1.5 * std::abs(X.x - kAside) + 1e-9; });
  const Path p = followed(s, c, optionsOf(SolidContactMethod::augmented, 1));
  ASSERT_TRUE(p.report.reached) << p.report.why;
  const std::vector<Vec3> x = s.solids->positions(p.last().state.y, 1);
  ASSERT_EQ(p.last().points.size(), 4u);  // two nodes, each on both facets
  for (const ContactPoint& q : p.last().points) {
    EXPECT_GT(q.pressure_Pa, 1e3);
    EXPECT_NEAR(x[q.node].x, 0, 1e-5);
    EXPECT_NEAR(x[q.node].z, 0, 1e-5);
  }
}

/// What slides loses mu times what presses by way, and the work of the supports is what is stored and lost.
TEST(ContactPath, WhatRubsLosesTheWorkThatIsNotStored) {
  for (const auto& [method, bound] : {std::pair(SolidContactMethod::penalty, FrictionBound::coupled),
                                      std::pair(SolidContactMethod::augmented, FrictionBound::coupled),
                                      std::pair(SolidContactMethod::augmented, FrictionBound::symmetrised)}) {
    Scene s = cubeOnPlane(2, false, 0.2);
    const SolidContact c = s.build(lawOf(2e7, 0.3, bound), atBottom);
    ContactPathOptions o = optionsOf(method, 40);
    o.change = 1e-4;
    const Path p = followed(s, c, o);
    ASSERT_TRUE(p.report.reached) << p.report.why;
    const std::vector<int> top = s.where([](const Vec3& X) { return X.z > 0.999; });
    double work = 0, lost = 0, slid = 0, before = 0, energy = 0;
    std::vector<Vec3> x_before, f_before;
    for (const ContactStep& step : p.steps) {
      const std::vector<Vec3> x = s.solids->positions(step.state.y, step.state.factor),
                              f = s.solids->reactions(step.state.y, step.state.factor);
      energy = s.solids->energy(step.state.y, step.state.factor) + c.energy(step.points);
      if (method == SolidContactMethod::penalty) energy += c.held(step.points);
      if (step.state.factor < 0.5 + 1e-9) {
        before = energy;
      } else {
        for (const int i : top) work += 0.5 * dot(f[i] + f_before[i], x[i] - x_before[i]);
        lost += c.lost(step.points);
        for (const ContactPoint& q : step.points) slid += q.slips ? 1 : 0;
      }
      x_before = x, f_before = f;
    }
    const double stored = energy - before;
    EXPECT_GT(slid, 50);
    EXPECT_GT(lost, 0.5 * work);
    EXPECT_NEAR(work, stored + lost, 0.02 * work) << lost;
  }
}

TEST(ContactPath, ABodyThatOnlyContactWouldHoldNeedsARaisedDiagonal) {
  for (const double raise : {0.0, 1e-10}) {
    Scene s = cubeOnPlane(1, true);
    // Nothing holds the cube, and nothing pushes it.
    std::erase_if(s.supports.constraints, [](const LinearConstraint& c) { return c.terms[0].first < 8; });
    const SolidContact c = s.build(lawOf(1e7), atBottom);
    TangentSolver solver;
    ContactSystem system(*s.solids, c, solver, 1, s.mesh.nodes);
    std::vector<double> y(s.solids->size(), 0.0);
    y[2] = 1e-3;
    const NewtonReport report = system.solve({}, {30, 1e-8, 0, raise}, y);
    EXPECT_EQ(report.converged, raise > 0);
    EXPECT_EQ(report.singular, raise == 0);
  }
}

TEST(ContactPath, SaysWhyItStops) {
  Scene s = cubeOnPlane(2, true);
  const SolidContact c = s.build(lawOf(1e4), atBottom);
  ContactPathOptions o = optionsOf(SolidContactMethod::augmented, 1);
  o.halvings = 1;
  o.passes = 2;
  const Path p = followed(s, c, o);
  EXPECT_FALSE(p.report.reached);
  EXPECT_NE(p.report.why.find("after 2 augmentations"), std::string::npos) << p.report.why;
  EXPECT_NE(p.report.why.find("from factor 0 to 0.5"), std::string::npos) << p.report.why;
}

TEST(ContactPath, BadOptionsAreRefused) {
  Scene s = cubeOnPlane(1, true);
  const auto refused = [&](const std::string& key, const SolidContactLaw& law, SolidContactMethod method,
                           const std::function<void(ContactPathOptions&)>& spoil) {
    const SolidContact c = s.build(law, atBottom);
    ContactPathOptions o = optionsOf(method, 1);
    spoil(o);
    try {
      followed(s, c, o);
      ADD_FAILURE() << key << " was accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key);
      EXPECT_NE(e.reason().find("not allowed"), std::string::npos);
    }
  };
  const auto augmented = [&](const std::string& key, const std::function<void(ContactPathOptions&)>& spoil) {
    refused(key, lawOf(1e7), SolidContactMethod::augmented, spoil);
  };
  augmented("steps", [](ContactPathOptions& o) { o.steps = 0; });
  augmented("halvings", [](ContactPathOptions& o) { o.halvings = 21; });
  augmented("raise", [](ContactPathOptions& o) { o.raise = 1; });
  augmented("raise", [](ContactPathOptions& o) { o.raise = -1e-3; });
  augmented("iterations", [](ContactPathOptions& o) { o.iterations = 0; });
  augmented("passes", [](ContactPathOptions& o) { o.passes = 0; });
  augmented("tolerance", [](ContactPathOptions& o) { o.tolerance = std::nan(""); });
  augmented("change", [](ContactPathOptions& o) { o.change = 0; });
  augmented("deepest_m", [](ContactPathOptions& o) { o.deepest_m = 0; });
  const auto nothing = [](ContactPathOptions&) {};
  refused("friction", lawOf(1e7, 0.3), SolidContactMethod::multipliers, nothing);
  refused("bound", lawOf(1e7, 0.3), SolidContactMethod::penalty, nothing);
}

}  // namespace
}  // namespace gambeson
