/// The factors of a case do what they say, measured on the model that is built: masses, forces of the shell, weight,
/// contact distance, drag.

#include "cases/wear/case/factors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cases/wear/results/measure.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/wear/scene/scene.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

/// Two sheets at an angle in a garment of their own: membrane, bending (Zheng's law) and a seam that springs.
Case folded(const std::vector<std::string>& overrides = {}) {
  static const Folder folder;
  const auto patch = [](const char* points) {
    return std::string(R"({"degree": [2, 2], "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1],
      "weft": [1, 0, 0.1], "points_m": [)") +
           points + "]}";
  };
  folder.write("fold.json", R"({"format": "gambeson garment 1", "name": "fold", "patches": [)" +
                                patch("[0,0,0],[0.05,0,0],[0.1,0,0],[0,0.05,0],[0.05,0.05,0],[0.1,0.05,0],"
                                      "[0,0.1,0],[0.05,0.1,0],[0.1,0.1,0]") +
                                "," +
                                patch("[0.1,0,0],[0.15,0,0.04],[0.2,0,0.08],[0.1,0.05,0],[0.15,0.05,0.04],"
                                      "[0.2,0.05,0.08],[0.1,0.1,0],[0.15,0.1,0.04],[0.2,0.1,0.08]") +
                                R"(], "seams": [{"a": {"patch": 0, "side": "u1"}, "b": {"patch": 1, "side": "u0"},
                                    "kind": "C0", "stiffness_N": 0.1}]})");
  const auto file = folder.write("case.json", R"({"name": "fold", "garment": {"file": {"path": "fold.json"}},
    "fabric": {"thickness": "0.8 mm", "density": "1440 kg/m^3", "young_weft": "1.4 MPa", "young_warp": "2 MPa",
               "shear": "0.5 MPa", "poisson": 0.3,
               "bending": {"law": "zheng", "rigidity_weft": "0.02 N m", "rigidity_warp": "0.015 N m",
                           "kappa0": "30 1/m", "twist": "1e-4 N m"}},
    "obstacles": [{"name": "floor", "plane": {"point": [0, 0, -1]}}],
    "contact": {"layer": "1 mm", "friction": 0.3}, "air": {"drag": 4}, "time": {"duration": 0.1}})");
  return readCase(file, overrides);
}

std::vector<Vec3> forceOf(const Model& m) {
  std::mt19937 random(7);  // its numbers, unlike those of distributions, are the same everywhere
  std::vector<Vec3> q;
  for (const NurbsPatch& p : shellOf(m).garment().patches) q.insert(q.end(), p.points.begin(), p.points.end());
  for (Vec3& x : q)
    for (int c = 0; c < 3; ++c) x[c] += 4e-3 * (static_cast<double>(random()) / 4294967295.0 - 0.5);
  std::vector<Vec3> f(q.size());
  ClothWork work;
  m.cloth->force(q, f, work);
  return f;
}

double size(const std::vector<Vec3>& f) {
  double s = 0;
  for (const Vec3& v : f) s += dot(v, v);
  return std::sqrt(s);
}

std::vector<Vec3> combined(double a, const std::vector<Vec3>& f, double b, const std::vector<Vec3>& g) {
  std::vector<Vec3> h;
  for (std::size_t i = 0; i < f.size(); ++i) h.push_back(a * f[i] + b * g[i]);
  return h;
}

double massOf(const Scenario& s) {
  double m = 0;
  for (const double x : s.model->mass_kg) m += x;
  return m;
}

/// The force is membrane + bending, each linear in its stiffness: the differences that the factors make say what each
/// of them scales, thickness t x membrane + t^3 x bending.
TEST(Factors, MembraneAndBendingMakeUpTheForceAndThicknessTakesBoth) {
  const auto f = [](const std::string& factor) {
    return forceOf(*buildScenario(folded({"factors." + factor}))->model);
  };
  const std::vector<Vec3> plain = forceOf(*buildScenario(folded())->model);
  const std::vector<Vec3> membrane = combined(1, f("membrane=2"), -1, plain);
  const std::vector<Vec3> bending = combined(1, f("bending=2"), -1, plain);
  EXPECT_GT(size(membrane), 0.05 * size(plain));
  EXPECT_GT(size(bending), 0.05 * size(plain));
  EXPECT_LT(size(combined(1, combined(1, membrane, 1, bending), -1, plain)), 1e-9 * size(plain));
  for (const double t : {0.5, 0.75, 2.0}) {
    const std::vector<Vec3> expected = combined(t, membrane, t * t * t, bending);
    const std::vector<Vec3> got = f("thickness=" + std::to_string(t));
    EXPECT_LT(size(combined(1, got, -1, expected)), 1e-9 * size(expected)) << t;
  }
  for (const char* other : {"weight=2", "inertia=2", "drag=2"})
    EXPECT_EQ(size(combined(1, f(other), -1, plain)), 0) << other;
}

TEST(Factors, MassWeightInertiaDragAndLayer) {
  const auto plain = buildScenario(folded());
  const double mass = massOf(*plain), g = norm(plain->model->environment.gravity_m_per_s2);
  // Both sheets by hand: 0.1 x 0.1 and 0.1 x hypot(0.1, 0.08) m2.
  EXPECT_NEAR(mass, 1440 * 0.8e-3 * 0.1 * (0.1 + std::hypot(0.1, 0.08)), 1e-9);
  const auto check = [&](const char* factor, double mass_by, double gravity_by, double drag_by, double layer_by) {
    const auto s = buildScenario(folded({std::string("factors.") + factor}));
    EXPECT_NEAR(massOf(*s), mass_by * mass, 1e-12) << factor;
    EXPECT_NEAR(norm(s->model->environment.gravity_m_per_s2), gravity_by * g, 1e-12) << factor;
    EXPECT_NEAR(s->model->environment.drag_kg_per_m2s, drag_by * 4, 1e-12) << factor;
    for (const double layer : s->model->layer_m) EXPECT_NEAR(layer, layer_by * 1e-3, 1e-15) << factor;
  };
  check("thickness=0.5", 0.5, 1, 1, 0.5);
  check("weight=1.1", 1, 1.1, 1, 1);
  check("inertia=1.25", 1.25, 0.8, 1, 1);  // the weight stays
  check("drag=0.9", 1, 1, 0.9, 1);
  check("bending=3", 1, 1, 1, 1);
  check("membrane=3", 1, 1, 1, 1);
  const std::vector<GarmentMeasure> garments = garmentMeasuresOf(*buildScenario(folded({"factors.thickness=0.5"})));
  ASSERT_EQ(garments.size(), 1u);
  EXPECT_NEAR(garments[0].mass_kg, 0.5 * mass, 1e-12);
  EXPECT_NEAR(garments[0].thickness_m, 0.4e-3, 1e-15);
  EXPECT_EQ(garments[0].control_points, 18);
}

/// With bodies, with cloth, and where a garment or an obstacle has its own.
TEST(Factors, FrictionTakesAllThatResistsSliding) {
  const Case c = libraryCase("sphere_drape", {"factors.friction=1.5", "contact.friction={\"kinetic\": 0.2, \"static\": 0.4, "
                                              "\"viscosity\": 2}", "contact.friction_cloth=0.3", "garment.friction=0.1",
                                              "obstacles[0].friction=0.6"});
  const Case with = withFactors(c);
  EXPECT_DOUBLE_EQ(with.contact.friction.kinetic, 0.3);
  EXPECT_DOUBLE_EQ(with.contact.friction.still, 0.6);
  EXPECT_DOUBLE_EQ(with.contact.friction.viscosity, 3);
  EXPECT_DOUBLE_EQ(with.contact.friction_cloth->kinetic, 0.45);
  EXPECT_DOUBLE_EQ(with.garments[0].friction->kinetic, 0.15);
  EXPECT_DOUBLE_EQ(with.obstacles[0].friction->still, 0.9);
  EXPECT_EQ(factorsText(c.factors), "friction x 1.5");
  // A case without it is written as it always was: its hash stays, and what was begun goes on.
  EXPECT_EQ(writeCase(libraryCase("sphere_drape")).find("\"friction\": 1\n"), std::string::npos);
}

/// A membrane of triangles that the case gives numbers of its own scales as the fabric's would.
TEST(Factors, ScaleAMembraneOfItsOwn) {
  Case c = libraryCase("sphere_drape", {"factors.thickness=0.5", "factors.membrane=3", "garment.model=triangles",
                                        "garment.membrane_elements=springs", "garment.spring_stiffness=100",
                                        "garment.stretch_damping=0.2"});
  const MembraneModel& m = withFactors(c).garments[0].cloth.membrane;
  EXPECT_DOUBLE_EQ(m.spring_N_per_m, 150);
  EXPECT_DOUBLE_EQ(m.stretch_damping_Ns_per_m, 0.1);
}

/// Without a layer of the case, the contact distance is the thickness, which has its factor.
/// A law scales its own numbers as it says: the yield moment of a sheet goes with the square of its thickness, and with
/// what makes it stiffer.
TEST(Factors, ALawScalesItsOwnNumbers) {
  const auto stopOf = [](double thickness, double bending) {
    Case c;
    c.fabric.law = StopBending{{1e-4, 2e-4, 0}, 5e-5};
    c.factors.thickness = thickness;
    c.factors.bending = bending;
    return std::get<StopBending>(withFactors(c).fabric.law);
  };
  EXPECT_DOUBLE_EQ(stopOf(2, 1).weft_Nm, 8e-4);
  EXPECT_DOUBLE_EQ(stopOf(2, 1).yield_N, 2e-4);
  EXPECT_DOUBLE_EQ(stopOf(1, 3).warp_Nm, 6e-4);
  EXPECT_DOUBLE_EQ(stopOf(1, 3).yield_N, 1.5e-4);
}

TEST(Factors, TheLayerIsTheThicknessWhereNoneIsGiven) {
  const Case c = libraryCase("sphere_drape", {"factors.thickness=0.5"});
  const auto s = buildScenario(c);
  const double expected = c.contact.layer_m ? 0.5 * *c.contact.layer_m : 0.5 * fabricOf(c, c.garments[0]).thickness_m;
  for (const double layer : s->model->layer_m) EXPECT_NEAR(layer, expected, 1e-15);
}

TEST(Factors, AreCheckedWrittenOutAndPartOfTheIdentity) {
  EXPECT_EQ(folded().factors, FactorsCase{});
  const Case thin = folded({"factors.thickness=50 %"});
  EXPECT_EQ(thin.factors.thickness, 0.5);
  EXPECT_NE(writeCase(thin).find("\"thickness\": 0.5"), std::string::npos);
  EXPECT_NE(caseIdentity(thin), caseIdentity(folded()));
  EXPECT_EQ(factorsText(thin.factors), "thickness x 0.5");
  for (const char* bad : {"factors.thickness=0", "factors.bending=-1", "factors.weight=101", "factors.drag=\"1 m\"",
                          "factors.mass=1", "factors=2"})
    EXPECT_THROW(folded({bad}), InputError) << bad;
}

}  // namespace
}  // namespace gambeson
