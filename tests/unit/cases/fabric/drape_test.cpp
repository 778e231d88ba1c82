// Cusick's tester: a stiff ring sinks as a plate does, a rigid one not at all; a limp one folds.
#include "cases/fabric/drape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/cloth/card_library.hpp"
#include "cases/fabric/lab_test.hpp"
#include "cases/runs/results_folder.hpp"
#include "core/material/hysteresis.hpp"

namespace gambeson {
namespace {

using laboratory::Draped;
using laboratory::DrapeSeries;
using laboratory::Specimen;

Fabric evenCloth(double rigidity_Nm, double weight_kg_per_m2) {
  Fabric f;
  f.thickness_m = 1e-3;
  f.density_kg_per_m3 = weight_kg_per_m2 / f.thickness_m;
  f.young_weft_Pa = f.young_warp_Pa = 1e7;
  f.shear_Pa = 5e6;
  f.law = LinearBending{GivenRigidities{rigidity_Nm, rigidity_Nm, 0.5 * rigidity_Nm}};
  return f;
}

Specimen ring(int cells, int degree) {
  Specimen s;
  s.cells = cells;
  s.degree = degree;
  return s;
}

double lowest(const Draped& d) {
  double z = 0;
  for (const Vec3& x : d.points) z = std::min(z, x.z);
  return -z;
}

/// The same with friction between its fibres: so much stiffer when new, all of it overcome at `span_per_m`.
Fabric rubbingCloth(double rigidity_Nm, double weight_kg_per_m2, double times, double span_per_m) {
  Fabric f = evenCloth(rigidity_Nm, weight_kg_per_m2);
  FrictionInBending law;
  law.shape = stopsOf<kStops>(curveOver(1, 0, 1)).shape;
  law.weft_Nm = law.warp_Nm = rigidity_Nm;
  law.twist_Nm = 0.5 * rigidity_Nm;
  law.first_Nm = {times * rigidity_Nm, times * rigidity_Nm, 0.5 * times * rigidity_Nm};
  law.span_per_m.fill(span_per_m);
  f.law = IsotropicHysteresisBending{law};
  return f;
}

Draped restingAt(double coefficient, int nodes = 4) {
  Draped d;
  d.coefficient = coefficient;
  d.nodes = nodes;
  d.at_rest = true;
  return d;
}

/// Deflection at the rim of a ring under a load q per area, clamped at a and free at b, of a plate without contraction
/// (nu = 0): D w = q r^4/64 + C1 + C2 ln r + C3 r^2 + C4 r^2 ln r, no shear force and no moment at b. Timoshenko and
/// Woinowsky-Krieger, Theory of plates and shells, 2nd ed., art. 15 to 17.
double rimOfPlate(double q, double D, double a, double b) {
  const double C4 = -q * b * b / 8;
  // Slope at a: C2/a + 2 a C3 = p; curvature at b: -C2/b^2 + 2 C3 = s.
  const double p = -q * a * a * a / 16 - C4 * (2 * a * std::log(a) + a);
  const double s = -3 * q * b * b / 16 - C4 * (2 * std::log(b) + 3);
  const double C2 = (p - a * s) / (1 / a + a / (b * b)), C3 = 0.5 * (s + C2 / (b * b));
  const auto w = [&](double r) {
    return q * r * r * r * r / 64 + C2 * std::log(r) + C3 * r * r + C4 * r * r * std::log(r);
  };
  return (w(b) - w(a)) / D;
}

TEST(Drape, ARigidDiscStaysAndAStiffOneSinksAsAPlate) {
  useThreads(1);
  const double weight = 0.2, q = 9.80665 * weight;
  const Draped rigid = laboratory::drape(evenCloth(1e3, weight), ring(8, 2));
  EXPECT_NEAR(rigid.coefficient, 1, 1e-9);
  EXPECT_EQ(rigid.nodes, 0);
  // So stiff that hoops are not stretched (sqrt(12 D/A) = 35 mm against 4 um).
  const Draped stiff = laboratory::drape(evenCloth(1, weight), ring(16, 2));
  const double plate = rimOfPlate(q, 1, 0.09, 0.15);
  EXPECT_NEAR(lowest(stiff), plate, 0.01 * plate);
  EXPECT_NEAR(stiff.coefficient, 1, 1e-6);
  EXPECT_EQ(stiff.nodes, 0);
  EXPECT_TRUE(stiff.at_rest);
  EXPECT_LT(stiff.unbalanced, 1e-4);
  // JIS L 1096: 25.4 cm on 12.7 cm.
  const Draped small = laboratory::drape(evenCloth(1, weight), ring(16, 2), {0.254, 0.127, 0});
  const double smaller = rimOfPlate(q, 1, 0.0635, 0.127);
  EXPECT_NEAR(lowest(small), smaller, 0.01 * smaller);
}

// Friction that no curvature overcomes is rigidity: 1.5 times of it sink by two thirds.
TEST(Drape, FrictionThatHoldsIsRigidity) {
  useThreads(1);
  const double weight = 0.2;
  const Draped held = laboratory::drape(rubbingCloth(1, weight, 1.5, 200), ring(16, 2));
  const double plate = rimOfPlate(9.80665 * weight, 1.5, 0.09, 0.15);
  EXPECT_NEAR(lowest(held), plate, 0.01 * plate);
}

// Beyond the friction the rigidity is the same: folds that slip are held by what friction leaves, and rest.
TEST(Drape, FrictionHoldsFolds) {
  useThreads(1);
  const Draped elastic = laboratory::drape(evenCloth(2e-5, 0.2), ring(8, 2)),
               rubbing = laboratory::drape(rubbingCloth(2e-5, 0.2, 3, 50), ring(8, 2));
  EXPECT_GT(rubbing.coefficient, elastic.coefficient + 0.03);
  EXPECT_TRUE(elastic.at_rest);
  EXPECT_TRUE(rubbing.at_rest);
  EXPECT_LT(elastic.unbalanced, 1e-4);
  EXPECT_LT(rubbing.unbalanced, 1e-4);
}

// Nothing is said that starts, mesh or unrest leave open.
TEST(Drape, TheVerdictSaysWhatIsKnown) {
  DrapeSeries s;
  s.starts = {restingAt(0.40), restingAt(0.42), restingAt(0.44)};
  s.coarser = {restingAt(0.41), restingAt(0.42), restingAt(0.46)};
  EXPECT_NEAR(s.coefficient(), 0.42, 1e-15);
  EXPECT_NEAR(s.spread(), 0.02, 1e-15);
  EXPECT_NEAR(s.mesh(), -0.01, 1e-15);
  EXPECT_EQ(drapeVerdict(s, 0.45).rfind("within 8 points of the card: it is 3.0 off", 0), 0u) << drapeVerdict(s, 0.45);
  EXPECT_EQ(drapeVerdict(s, 0.55).rfind("not within 8 points", 0), 0u);
  EXPECT_EQ(drapeVerdict(s, 0.48).rfind("whether it is within 8 points of the card is not known: it is", 0), 0u);
  EXPECT_EQ(drapeVerdict(s, 0.52).rfind("whether it is within 8 points of the card is not known: it is", 0), 0u);
  s.coarser[1].at_rest = false;
  EXPECT_FALSE(s.atRest());
  EXPECT_EQ(drapeVerdict(s, 0.42).rfind("whether it is within 8 points of the card is not known: not all", 0), 0u);
}

// A start turns what the specimen's weight is uneven by, so that soft cloth takes other folds, and about the same
// shadow.
TEST(Drape, StartsTurnThePattern) {
  useThreads(1);
  const Draped a = laboratory::drape(evenCloth(2e-5, 0.2), ring(8, 2)),
               b = laboratory::drape(evenCloth(2e-5, 0.2), ring(8, 2), {.start = 1});
  EXPECT_NE(a.coefficient, b.coefficient);
  EXPECT_NEAR(a.coefficient, b.coefficient, 0.1);
}

// What a disc does depends on B/(w R^3) and A/(w R) alone: of half the size, with an eighth of B and half of A and G
// under the same weight per area, it takes the same folds and has the same shadow.
TEST(Drape, LimpDiscsAreAlikeAtEverySize) {
  useThreads(1);
  const double B = 2e-5;
  Fabric half = evenCloth(B / 8, 0.2);
  for (double* modulus : {&half.young_weft_Pa, &half.young_warp_Pa, &half.shear_Pa}) *modulus /= 2;
  const Draped a = laboratory::drape(evenCloth(B, 0.2), ring(8, 2)),
               b = laboratory::drape(half, ring(8, 2), {.specimen_m = 0.15, .support_m = 0.09});
  EXPECT_LT(a.coefficient, 0.95);
  EXPECT_GE(a.nodes, 2);
  EXPECT_EQ(b.nodes, a.nodes);
  EXPECT_NEAR(b.coefficient, a.coefficient, 1e-5);
  EXPECT_NEAR(lowest(b), 0.5 * lowest(a), 1e-6);
}

TEST(Drape, SofterClothFoldsAndHasLessShadow) {
  useThreads(1);
  double before = 1;
  for (const double rigidity : {2e-4, 2e-5}) {
    const Draped d = laboratory::drape(evenCloth(rigidity, 0.2), ring(8, 2));
    EXPECT_LT(d.coefficient, before) << rigidity;
    before = d.coefficient;
    EXPECT_EQ(d.crossings, 0);
    if (rigidity < 1e-4) {
      EXPECT_GE(d.nodes, 2);
    }
  }
  EXPECT_LT(before, 0.95);
}

TEST(Drape, TheCardsCoefficientStandsBesideTheSimulatedOne) {
  useThreads(1);
  FabricCard card = readCard("petrak_m6_cotton_twill");
  EXPECT_EQ(testsOf(card).back(), LabTest::drape);
  card.bending.rigidity.weft = card.bending.rigidity.warp = 1e-2;
  card.drape->nodes = 0;
  const MeasuredTest test = measureTest(LabTest::drape, 0, card, fabricOf(card), ring(8, 2));
  EXPECT_EQ(test.stem(), "drape");
  ASSERT_EQ(test.readings.size(), 2u);
  EXPECT_DOUBLE_EQ(*test.readings[0].card, 0.549);
  EXPECT_TRUE(test.readings[0].share);
  EXPECT_GT(test.readings[0].measured, 0.999);
  EXPECT_EQ(*test.readings[1].card, 0);
  const std::vector<Draped>& starts = test.drapes->starts;
  ASSERT_EQ(starts.size(), 3u);
  EXPECT_EQ(test.drapes->coarser_cells, 5);
  EXPECT_EQ(test.drapes->coarser.size(), 3u);
  EXPECT_NEAR(test.readings[0].measured, (starts[0].coefficient + starts[1].coefficient + starts[2].coefficient) / 3,
              1e-15);
  EXPECT_EQ(test.drawn().coefficient, starts[1].coefficient) << "the middle one";
  EXPECT_EQ(test.loop.size(), test.drawn().outline.size() + 1) << "a closed outline";
}

}  // namespace
}  // namespace gambeson
