#include "cases/fabric/lab_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/cloth/card_terms.hpp"
#include "cases/fabric/strips.hpp"
#include "core/error.hpp"
#include "core/material/hysteresis.hpp"

namespace gambeson {
namespace {

constexpr double kGf_N = 9.80665e-3, kDegree = 0.017453292519943295;
constexpr double kMomentUnit_N = kGf_N;             // gf cm/cm
constexpr double kRigidityUnit_Nm = 0.01 * kGf_N;   // gf cm^2/cm
constexpr double kForceUnit_N_per_m = 100 * kGf_N;  // gf/cm
constexpr double kShearFrom = 0.5 * kDegree, kShearTo = 2.5 * kDegree, kShearWide = 5 * kDegree;

/// What the card says of a direction: along weft or warp, or of any where it does not tell them apart.
std::optional<double> cardOf(const CardNumber& n, double direction_deg, bool isotropic) {
  if (!n.any()) return std::nullopt;
  const double turned = std::fmod(std::abs(direction_deg), 180);
  if (turned == 0) return n.of(0);
  if (turned == 90) return n.of(1);
  return isotropic ? std::optional(n.mean()) : std::nullopt;
}

std::vector<Reading> bendingReadings(const FabricCard& card, const MeasuredTest& test, double width_at_per_m) {
  const CardBending& b = card.bending;
  const bool isotropic = !b.rigidity.apart() && !b.hysteresis.apart();
  return {{"B",
           "gf cm^2/cm",
           kRigidityUnit_Nm,
           cardOf(b.rigidity, test.direction_deg, isotropic),
           laboratory::slopeBetween(test.loop, kKesFrom_per_m, kKesTo_per_m),
           kKesFrom_per_m,
           {}},
          {fmt::format("2HB at {}/cm", width_at_per_m / 100),
           "gf cm/cm",
           kMomentUnit_N,
           cardOf(b.hysteresis, test.direction_deg, isotropic),
           laboratory::widthAt(test.loop, width_at_per_m),
           width_at_per_m,
           {}}};
}

std::vector<Reading> shearReadings(const FabricCard& card, const MeasuredTest& test) {
  const CardShear s = card.shear.value_or(CardShear{});
  // Shear along weft and warp is one and the same of a sheet: the fabric has the mean.
  const auto of = [&](const CardNumber& n) {
    const bool along = std::fmod(std::abs(test.direction_deg), 90) == 0;
    return n.any() && along ? std::optional(n.mean()) : std::nullopt;
  };
  return {{"G",
           "gf/(cm deg)",
           kForceUnit_N_per_m / kDegree,
           of(s.rigidity),
           laboratory::slopeBetween(test.loop, kShearFrom, kShearTo),
           kShearFrom,
           {}},
          {"2HG at 0.5 deg",
           "gf/cm",
           kForceUnit_N_per_m,
           of(s.hysteresis),
           laboratory::widthAt(test.loop, kShearFrom),
           kShearFrom,
           {}},
          {"2HG5 at 5 deg",
           "gf/cm",
           kForceUnit_N_per_m,
           of(s.hysteresis_5),
           laboratory::widthAt(test.loop, kShearWide),
           kShearWide,
           {}}};
}

/// The steps of the instruments: a tenth of a unit of curvature, an eighth of a degree.
laboratory::Course bendingCourse(double width_at_per_m) {
  return {{kKesCurvature_per_m, -kKesCurvature_per_m, kKesCurvature_per_m},
          5,
          {-width_at_per_m, width_at_per_m, -kKesFrom_per_m, kKesFrom_per_m, -kKesTo_per_m, kKesTo_per_m}};
}
laboratory::Course shearCourse() { return {{8 * kDegree, -8 * kDegree, 8 * kDegree}, 0.25 * kDegree, {}}; }

/// 0 along the weft, 1 along the warp; none: neither.
std::optional<int> threadOf(double direction_deg) {
  const double turned = std::fmod(std::abs(direction_deg), 180);
  return turned == 0 ? std::optional(0) : turned == 90 ? std::optional(1) : std::nullopt;
}

/// The points of the card's test that its fabric promises: all of a curve, one of a secant. None of moduli.
std::vector<TensilePoint> promised(const CardTensile& t, int direction) {
  if (t.modulus_N_per_m.any()) return {};
  if (t.law == TensileLaw::curve)
    return t.curves.any() ? t.curves.of(direction)
                          : std::vector<TensilePoint>{{t.extension.of(direction), t.load_N_per_m}};
  return {secantPoint(t, direction)};
}

/// The strain at which a loop that only rises first has a load.
double strainAtLoad(const laboratory::Loop& loop, double load) {
  for (std::size_t i = 1; i < loop.size(); ++i)
    if (const auto& a = loop[i - 1], &b = loop[i]; a.load <= load && load <= b.load)
      return a.at + (b.at - a.at) * (load - a.load) / (b.load - a.load);
  throw RunError(fmt::format("the strip was not pulled up to {:.4g} N/m", load));
}

double workUpTo(const laboratory::Loop& loop, double strain) {
  double work = 0;
  for (std::size_t i = 1; i < loop.size() && loop[i].at <= strain * (1 + 1e-12); ++i)
    work += 0.5 * (loop[i].load + loop[i - 1].load) * (loop[i].at - loop[i - 1].at);
  return work;
}

/// Without a card's tension: what is assumed, EMT at 500 gf/cm.
CardTensile tensileOf(const FabricCard& card) {
  CardTensile none;
  none.extension.both = kCardExtension;
  return card.tensile.value_or(none);
}

void measureTension(const FabricCard& card, const Fabric& fabric, const laboratory::Specimen& specimen,
                    MeasuredTest& test) {
  constexpr int kSteps = 200;
  const CardTensile t = tensileOf(card);
  const std::optional<int> thread = threadOf(test.direction_deg);
  const std::vector<TensilePoint> points = promised(t, thread.value_or(0));
  laboratory::Course course;
  for (const TensilePoint& p : points) course.also.push_back(p[0]);
  const double end = points.empty() ? 0.02 : 1.05 * points.back()[0];
  course.turns = {end};
  course.step = end / kSteps;
  test.loop = laboratory::pull(fabric, specimen, course);
  if (points.empty()) {
    constexpr double kAt = 0.01;
    const double load = laboratory::loadAt(test.loop, 0, kAt);
    test.readings.push_back({"modulus",
                             "N/m",
                             1,
                             thread ? std::optional(t.modulus_N_per_m.of(*thread)) : std::nullopt,
                             lab::stiffnessAt(load, kAt),
                             kAt,
                             {}});
    return;
  }
  for (const TensilePoint& p : points) {
    const bool emt = t.extension.any() && p[1] == t.load_N_per_m;
    test.readings.push_back({emt ? "EMT" : fmt::format("e at {:.4g} gf/cm", p[1] / kForceUnit_N_per_m), "%", 0.01,
                             thread && card.tensile ? std::optional(p[0]) : std::nullopt, strainAtLoad(test.loop, p[1]),
                             p[0], p[1]});
  }
  if (t.law == TensileLaw::curve && t.extension.any())
    test.readings.push_back(
        {"WT",
         "gf cm/cm^2",
         kForceUnit_N_per_m,
         thread ? std::optional(t.linearity.of(*thread) * t.extension.of(*thread) * t.load_N_per_m / 2) : std::nullopt,
         workUpTo(test.loop, points.back()[0]),
         points.back()[0],
         {}});
}

/// FAST-3's load on the bias.
void measureBias(const FabricCard& card, const Fabric& fabric, const laboratory::Specimen& specimen,
                 MeasuredTest& test) {
  constexpr int kSteps = 100;
  const double load = lab::kFastLoads_N_per_m[0];
  double end = 1.5 * lab::biasOfShear(fabric.shear_Pa * fabric.thickness());
  for (int trial = 0; trial < 8 && (test.loop.empty() || test.loop.back().load < load); ++trial, end *= 2)
    test.loop = laboratory::pullFree(fabric, specimen, {{end}, end / kSteps, {}});
  const double strain = strainAtLoad(test.loop, load);
  const bool said = card.fast && card.fast->bias && std::abs(std::fmod(test.direction_deg, 90)) == 45;
  test.readings.push_back({"EB5", "%", 0.01, said ? card.fast->bias : std::nullopt, strain, strain, load});
}

void measureDroop(const FabricCard& card, const Fabric& fabric, const laboratory::Specimen& specimen,
                  MeasuredTest& test) {
  const std::optional<int> thread = threadOf(test.direction_deg);
  const double rigidity = thread ? card.bending.rigidity.of(*thread) : card.bending.rigidity.mean();
  const double expected = lab::lengthOfRigidity(rigidity, fabric.surfaceDensity());
  const laboratory::Droop droop = laboratory::droop(fabric, specimen, expected);
  for (const Vec3& x : droop.shape) test.loop.push_back({x.x, -x.z, 0});
  // A loop of bending is stiffer when it begins than B is, so that B says no length.
  const bool linear = std::holds_alternative<LinearBending>(fabric.law) && card.weight_kg_per_m2;
  test.readings.push_back({"c",
                           "cm",
                           0.01,
                           thread && linear ? std::optional(expected) : std::nullopt,
                           droop.length_m,
                           test.loop.back().at,
                           {}});
}

void measureDrape(const FabricCard& card, const Fabric& fabric, const laboratory::Specimen& specimen,
                  MeasuredTest& test) {
  const CardDrape said = card.drape.value_or(CardDrape{});
  test.drapes = laboratory::drapeSeries(fabric, specimen, said.specimen_m, said.support_m);
  const laboratory::DrapeSeries& series = *test.drapes;
  const laboratory::Draped& drawn = test.drawn();
  for (std::size_t i = 0; i <= drawn.outline.size(); ++i) {
    const Vec2& x = drawn.outline[i % drawn.outline.size()];
    test.loop.push_back({x.x, x.y, 0});
  }
  Reading coefficient{"drape coefficient", "%", 0.01, {}, series.coefficient(), 0, {}, true};
  Reading nodes{"nodes", "", 1, {}, series.nodes(), 0, {}};
  if (card.drape) {
    coefficient.card = said.coefficient;
    if (said.nodes) nodes.card = *said.nodes;
    test.notes.push_back(laboratory::drapeVerdict(series, said.coefficient));
    if (!said.source.empty()) test.notes.push_back("card's drape: " + said.source);
  }
  test.readings = {std::move(coefficient), std::move(nodes)};
  std::vector<std::string> starts;
  for (const laboratory::Draped& s : series.starts)
    starts.push_back(fmt::format("{:.1f} % ({} nodes{})", 100 * s.coefficient, s.nodes, s.at_rest ? "" : ", sinking"));
  test.notes.push_back(fmt::format(
      "specimen of {:.4g} cm between discs of {:.4g} cm; means of {} starts: {}, a spread of {:.1f} points to either "
      "side; the middle one is drawn",
      100 * said.specimen_m, 100 * said.support_m, series.starts.size(), fmt::join(starts, ", "),
      100 * series.spread()));
  test.notes.push_back(fmt::format("mesh: {:+.1f} points against {} cells in place of {}", 100 * series.mesh(),
                                   series.coarser_cells, series.cells));
  test.notes.push_back(fmt::format("{}: forces of {:.1g} of the ring's weight are out of balance",
                                   series.atRest() ? "at rest" : "not at rest", series.unbalanced()));
  const bool rubs = !std::holds_alternative<LinearBending>(fabric.law),
             slips = fabric.shear_friction != ShearFriction{};
  test.notes.push_back(rubs && slips ? "held by friction in bending (2HB) and in shear (2HG)"
                       : rubs        ? "held by friction in bending (2HB); 2HG is not known"
                       : slips ? "held by friction in shear (2HG); 2HB is not known, without which folds are too limp"
                               : "elastic: neither 2HB nor 2HG is known, without which folds are too limp");
  if (series.crossings() > 0)
    test.notes.push_back(
        fmt::format("folds pass through each other at {} places: cloth that touches itself keeps a larger shadow",
                    series.crossings()));
}

}  // namespace

const std::vector<LabTestKind>& labTests() {
  static const std::vector<LabTestKind> all{
      {LabTest::bending,
       "bending",
       "KES-FB2 bending",
       "curvature [1/cm]",
       "moment per width [gf cm/cm]",
       100,
       kMomentUnit_N,
       {"curvature_per_cm", "moment_gf_cm_per_cm", "curvature_per_m", "moment_N", "lost_J_per_m2"}},
      {LabTest::shear,
       "shear",
       "KES-FB1 shear",
       "shear angle [degrees]",
       "shear force per width [gf/cm]",
       kDegree,
       kForceUnit_N_per_m,
       {"angle_deg", "force_gf_per_cm", "angle_rad", "force_N_per_m", "lost_J_per_m2"}},
      {LabTest::tension,
       "tension",
       "KES-FB1 tension",
       "strain [%]",
       "force per width [gf/cm]",
       0.01,
       kForceUnit_N_per_m,
       {"strain_percent", "force_gf_per_cm", "strain", "force_N_per_m", "lost_J_per_m2"}},
      {LabTest::bias,
       "bias",
       "FAST-3 extension",
       "strain [%]",
       "force per width [gf/cm]",
       0.01,
       kForceUnit_N_per_m,
       {"strain_percent", "force_gf_per_cm", "strain", "force_N_per_m", "lost_J_per_m2"}},
      {LabTest::cantilever,
       "cantilever",
       "ASTM D1388 cantilever",
       "reach [cm]",
       "droop [cm]",
       0.01,
       0.01,
       {"reach_cm", "droop_cm", "reach_m", "droop_m", "lost_J_per_m2"}},
      {LabTest::drape,
       "drape",
       "Cusick drape",
       "x, along the weft [cm]",
       "y, along the warp [cm]",
       0.01,
       0.01,
       {"x_cm", "y_cm", "x_m", "y_m", "lost_J_per_m2"}}};
  return all;
}

const LabTestKind& kindOf(LabTest test) {
  return *std::find_if(labTests().begin(), labTests().end(), [&](const LabTestKind& k) { return k.test == test; });
}

std::string MeasuredTest::title() const {
  if (test == LabTest::drape) return kindOf(test).title;
  const double turned = std::fmod(std::abs(direction_deg), 180);
  const std::string where = turned == 0    ? "along the weft"
                            : turned == 90 ? "along the warp"
                                           : fmt::format("at {} degrees from the weft", direction_deg);
  return fmt::format("{}, {}", kindOf(test).title, where);
}

std::string MeasuredTest::stem() const {
  if (test == LabTest::drape) return kindOf(test).word;
  return fmt::format("{}_{}", kindOf(test).word, direction_deg);
}

std::vector<LabTest> testsOf(const FabricCard& card) {
  std::vector<LabTest> tests{LabTest::bending};
  if (card.shear) tests.push_back(LabTest::shear);
  if (card.tensile) tests.push_back(LabTest::tension);
  if (card.fast && card.fast->bias) tests.push_back(LabTest::bias);
  if (card.bending.length_m.any()) tests.push_back(LabTest::cantilever);
  if (card.drape) tests.push_back(LabTest::drape);
  return tests;
}

std::vector<double> directionsOf(LabTest test, const FabricCard& card) {
  const CardTensile t = tensileOf(card);
  const bool apart = test == LabTest::tension
                         ? t.extension.apart() || t.curves.apart() || t.modulus_N_per_m.apart() || t.linearity.apart()
                         : card.bending.rigidity.apart() || card.bending.hysteresis.apart();
  if (test == LabTest::bias) return {45};
  if (test == LabTest::drape) return {0};
  return apart ? std::vector<double>{0, 90} : std::vector<double>{0};
}

MeasuredTest measureTest(LabTest kind, double direction_deg, const FabricCard& card, const CardFabric& c,
                         laboratory::Specimen specimen) {
  MeasuredTest test{.test = kind, .direction_deg = direction_deg, .loop = {}, .readings = {}};
  specimen.direction_rad = direction_deg * kDegree;
  const Fabric& fabric = c.fabric;
  switch (kind) {
    case LabTest::bending: {
      const double at = card.bending.hysteresis_at_per_m.value_or(kKesWidthAt_per_m);
      test.loop = laboratory::bend(fabric, specimen, bendingCourse(at));
      test.readings = bendingReadings(card, test, at);
      break;
    }
    case LabTest::shear:
      test.loop = laboratory::shear(fabric, specimen, shearCourse());
      test.readings = shearReadings(card, test);
      break;
    case LabTest::tension:
      measureTension(card, fabric, specimen, test);
      break;
    case LabTest::bias:
      measureBias(card, fabric, specimen, test);
      break;
    case LabTest::cantilever:
      measureDroop(card, fabric, specimen, test);
      break;
    case LabTest::drape:
      measureDrape(card, fabric, specimen, test);
      break;
  }
  return test;
}

}  // namespace gambeson
