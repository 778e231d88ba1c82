// Every law of core/material/laws: its resultants are the gradient of its energy, its slope theirs.
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "core/material/laws/friction.hpp"
#include "core/material/laws/point_law.hpp"
#include "unit/core/material/law_check.hpp"

namespace gambeson {
namespace {

using Three = std::array<double, 3>;

const Voigt aniso = reducedStiffness({1, 500, 100, 60, 0.3, 0.4});  // N/m, say
const std::vector<Three> strains{{0.012, -0.007, 0.02}, {-0.09, 0.03, -0.05}, {0.2, 0.11, 0.07}};
/// Below kr, between kr and k0, and beyond, of either sign [1/m].
constexpr double k0 = 200, kr = 8;
const std::vector<Three> curvatures{{3, -5, 2}, {-40, 90, 7}, {350, -280, -60}, {-1, 500, 0.5}};

template <class S>
std::array<S, 6> spreadAll(const Voigt& A) {
  std::array<S, 6> out;
  for (int i = 0; i < 6; ++i) out[i] = A[i];
  return out;
}

/// All points of a law, in steps of that share of the largest strain.
template <int N, class Law>
void expectDerivatives(const char* name, const Law& law, const std::vector<std::array<double, N>>& points,
                       double tolerance = 1e-8, double dual_tolerance = 1e-13, bool has_potential = true) {
  for (const auto& x : points) {
    double size = 0;
    for (double v : x) size = std::max(size, std::abs(v));
    const LawErrors e = lawErrors<N>(law, x, 1e-4 * size, has_potential);
    EXPECT_LT(e.gradient, tolerance) << name << " at " << x[0];
    EXPECT_LT(e.slope, tolerance) << name << " at " << x[0];
    EXPECT_LT(e.dual, dual_tolerance) << name << " at " << x[0];
  }
}

TEST(Laws, Membrane) {
  const auto general = []<class S>(const S* e) {
    Answer<S, 3> a{};
    stVenantKirchhoff<all_parts>(aniso.data(), e, a);
    return evaluated(a);
  };
  const auto orthotropic = []<class S>(const S* e) {
    Answer<S, 3> a{};
    stVenantKirchhoff<all_parts>(OrthotropicStiffness<double>{200, 100, 25, 45}, e, a);
    return evaluated(a);
  };
  expectDerivatives<3>("membrane", general, strains);
  expectDerivatives<3>("orthotropic membrane", orthotropic, strains);
}

/// A11 of nu = 0 is E h; of a Poisson's ratio, the strain across under a tension is - nu times that along.
TEST(Laws, PlaneStressIsThatOfItsModuli) {
  double A[6];
  planeStress(200.0, 100.0, 45.0, 0.25, 0.01, A);
  const double e[3] = {0.02, -0.25 * 0.02, 0};
  Answer<double, 3> a;
  stVenantKirchhoff<only_resultants>(A, e, a);
  EXPECT_NEAR(a.resultant[0], 200 * 0.01 * 0.02, 1e-15);
  EXPECT_NEAR(a.resultant[1], 0, 1e-16);
}

TEST(Laws, LinearBending) {
  const auto law = []<class S>(const S* k) {
    Answer<S, 3> a{};
    linearMoment<all_parts>(DiagonalStiffness<double>{0.3, 0.2, 0.1}, k, a);
    return evaluated(a);
  };
  expectDerivatives<3>("linear bending", law, curvatures);
}

TEST(Laws, ZhengBending) {
  const auto law = []<class S>(const S* k) {
    const double D[3] = {3e-6, 2e-6, 1e-6}, numbers[2] = {k0, kr};
    Answer<S, 3> a{};
    ZhengBending::bend<all_parts>(D, numbers, k, History<S>{}, a);
    return evaluated(a);
  };
  expectDerivatives<3>("Zheng, one parameter for all lanes", law, curvatures);
  const auto by_lane = []<class S>(const S* k) {
    const S D[3] = {3e-6, 2e-6, 1e-6}, numbers[2] = {k0, kr};
    Answer<S, 3> a{};
    ZhengBending::bend<all_parts>(D, numbers, k, History<S>{}, a);
    return evaluated(a);
  };
  expectDerivatives<3>("Zheng, parameters by lane", by_lane, curvatures);
}

/// On a membrane crushed to 0.5 and 0.65 of its area; J0 = 0.7.
TEST(Laws, Jamming) {
  const auto law = []<class S>(const S* e) {
    Answer<S, 3> a{};
    addJamming<all_parts>(jamStiffness(aniso), 0.49, e, a);
    return evaluated(a);
  };
  expectDerivatives<3>("jamming", law, {{-0.3, -0.05, 0.04}, {-0.2, -0.13, -0.1}});
}

/// Taut and wrinkled; where no direction stretches there is nothing.
TEST(Laws, TensionField) {
  const auto law = []<class S>(const S* e) {
    const TensionFieldOf<S> field = tensionField(spreadAll<S>(aniso).data(), e);
    Answer<S, 3> a{};
    a.energy = field.energy;
    for (int i = 0; i < 3; ++i) a.resultant[i] = field.n[i];
    for (int i = 0; i < 6; ++i) a.slope[i] = field.slope[i];
    return evaluated(a);
  };
  // The dual numbers go through a Newton iteration that ends when the angle, not its derivative, stands still.
  expectDerivatives<3>("tension field", law, {{0.1, 0.05, 0.02}, {0.1, -0.2, 0.05}, {-0.04, 0.06, 0.11}}, 1e-7, 1e-6);
}

/// Coulomb's law, and viscosity beside it, have no potential; their slope is not symmetric. Sticking, slipping; parted
/// surfaces bear nothing.
TEST(Laws, Friction) {
  const double n[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
  for (const double drag : {0.0, 0.05}) {
    const auto law = [&]<class S>(const S* p) {
      Evaluated<S, 3> e;
      coulombImpulse<all_parts>(0.3, drag, n, p, e.resultant, &e.slope[0][0]);
      return e;
    };
    expectDerivatives<3>("friction", law, {{0.4, 0.65, 0.7}, {0.9, 0.3, 0.1}, {-1, 2, 0.1}}, 1e-8, 1e-13, false);
    const double away[3] = {-1, -1, 0.5};
    const auto parted = law(away);
    for (double i : parted.resultant) EXPECT_EQ(i, 0);
    // On the cone: |p_t| = mu p_n + drag, the normal part as it was.
    const double slides[3] = {0.9, 0.3, 0.1};
    const auto cut = law(slides);
    double normal = 0, kept = 0, size2 = 0;
    for (int i = 0; i < 3; ++i) normal += slides[i] * n[i], kept += cut.resultant[i] * n[i];
    for (int i = 0; i < 3; ++i) size2 += std::pow(cut.resultant[i] - kept * n[i], 2);
    EXPECT_NEAR(kept, normal, 1e-15);
    EXPECT_NEAR(std::sqrt(size2), 0.3 * normal + drag, 1e-15);
  }
}

/// All laws of a point together, with coupling of membrane and bending, and with a law of the list. Six strains: E and
/// curvature changes.
TEST(Laws, APointOfALaminateThatJams) {
  const Voigt B{3, -2, 1, 0.5, 0.3, -0.4}, D{4, 3, 1, 0.6, 0.2, -0.1};
  const auto law = [&]<class S>(const S* x) {
    PointNumbers<S> l{};
    for (int i = 0; i < 6; ++i) l.A[i] = aniso[i], l.B[i] = B[i], l.D[i] = D[i];
    l.jam = jamStiffness(aniso);
    l.jam_s = 0.49;
    PointAnswer<S> a;
    evaluateLaws<all_parts>({0, false, true}, l, x, x + 3, History<S>{}, a);
    constexpr int voigt[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    Evaluated<S, 6> e;
    e.potential = a.energy;
    for (int i = 0; i < 3; ++i) {
      e.resultant[i] = a.membrane.resultant[i];
      e.resultant[3 + i] = a.bending.resultant[i];
      for (int j = 0; j < 3; ++j) {
        e.slope[i][j] = a.membrane.slope[voigt[i][j]];
        e.slope[i][3 + j] = e.slope[3 + i][j] = B[voigt[i][j]];
        e.slope[3 + i][3 + j] = a.bending.slope[voigt[i][j]];
      }
    }
    return e;
  };
  expectDerivatives<6>("laminate", law, {{0.02, 0.01, -0.03, 1, -2, 0.7}, {-0.3, -0.05, 0.04, 0.4, 0.2, -0.1}});
}

TEST(Laws, APointTakesTheLawOfItsKind) {
  constexpr double kind = BendingLaws::kind<ZhengBending>;
  for (const double own : {0.0, kind}) {
    PointLaw point;
    point.section.D = {3e-6, 2e-6, 1e-6};
    point.kind = own;
    point.numbers = {k0, kr};
    for (const Three& k : curvatures) {
      PointNumbers<double> l{};
      for (int i = 0; i < 6; ++i) l.D[i] = point.section.D[i];
      l.kind = own;
      std::copy(point.numbers.begin(), point.numbers.end(), l.numbers);
      PointAnswer<double> a;
      const double flat[3] = {0, 0, 0};
      evaluateLaws<all_parts>({1u << static_cast<int>(kind), false, false}, l, flat, k.data(), {}, a);
      Answer<double, 3> expected;
      if (own == 0)
        linearMoment<all_parts>(point.section.D.data(), k.data(), expected);
      else
        ZhengBending::bend<all_parts>(point.section.D.data(), point.numbers.data(), k.data(), {}, expected);
      EXPECT_EQ(a.energy, expected.energy);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(a.bending.resultant[i], expected.resultant[i]);
      for (int i = 0; i < 6; ++i) EXPECT_EQ(a.bending.slope[i], expected.slope[i]);
    }
  }
}

TEST(Laws, AStopAnswersFromWhatWasCommitted) {
  const double D[3] = {3, 2, 1}, yield[1] = {0.15}, committed[3] = {0.2, -0.1, 0.05};
  const auto law = [&]<class S>(const S* k) {
    double own[3], trial[3];
    std::copy(committed, committed + 3, own);
    Answer<S, 3> a{};
    StopBending::bend<all_parts>(D, yield, k, History<S>{own, trial, 1, true}, a);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(own[i] == committed[i]) << "a law does not commit";
    return evaluated(a);
  };
  expectDerivatives<3>("stop", law, {{0.21, -0.12, 0.07}, {0.4, -0.3, 0.1}, {-0.3, 0.4, -0.02}});
}

/// Without rigidity there is no moment and nothing is remembered; a new cloth remembers zeros.
TEST(Laws, AStopOfNoRigidityIsSlack) {
  const double D[3] = {0, 2, 0}, yield[1] = {0.1}, k[3] = {5, 0.04, -3};
  double trial[3];
  Answer<double, 3> a{};
  StopBending::bend<all_parts>(D, yield, k, {nullptr, trial, 1, true}, a);
  EXPECT_EQ(a.resultant[0], 0);
  EXPECT_DOUBLE_EQ(a.resultant[1], 0.08);
  EXPECT_EQ(a.resultant[2], 0);
  for (double set : trial) EXPECT_EQ(set, 0);
  EXPECT_EQ(a.lost, 0);
}

/// Of points that lie side by side only those remember whose law does.
TEST(Laws, APointOfAnotherLawWritesNoHistory) {
  PointNumbers<double> point{};
  point.D[0] = point.D[1] = point.D[2] = 1;
  point.numbers[0] = 0.1;
  point.numbers[1] = 0.05;
  const LawUse use{1u << BendingLaws::kind<ZhengBending> | 1u << BendingLaws::kind<StopBending>, false, false};
  const double k[3] = {4, -3, 2}, committed[3] = {};
  for (const bool stops : {false, true}) {
    point.kind = stops ? BendingLaws::kind<StopBending> : BendingLaws::kind<ZhengBending>;
    double trial[3] = {7, 7, 7};
    Answer<double, 3> a{};
    evaluateBending<only_resultants>(use, point, k, History<double>{committed, trial}, a);
    EXPECT_EQ(trial[0] == 7, !stops);
  }
}

/// Around a closed path of curvature, what the moment works is what the law has lost.
TEST(Laws, AStopLosesWhatItsLoopEncloses) {
  const double D[3] = {3, 2, 1}, yield[1] = {0.3};
  for (const int steps : {7, 400}) {
    double committed[3] = {}, trial[3], lost = 0, work = 0, moment = 0, before = 0;
    for (int s = 1; s <= 2 * steps; ++s) {
      const double angle = 2 * std::numbers::pi * s / steps, k[3] = {0.5 * std::sin(angle), 0, 0};
      Answer<double, 3> a{};
      StopBending::bend<all_parts>(D, yield, k, {committed, trial, 1, true}, a);
      EXPECT_GE(a.lost, 0);
      if (s > steps) {
        lost += a.lost;
        work += 0.5 * (a.resultant[0] + moment) * (k[0] - before);
      }
      moment = a.resultant[0];
      before = k[0];
      std::copy(trial, trial + 3, committed);
    }
    if (steps == 400) {
      EXPECT_NEAR(lost, 4 * 0.3 * (0.5 - 0.1), 1e-12) << "the yield moment times twice the way that it slips each way";
      EXPECT_NEAR(work, lost, 1e-3 * lost);
    }
  }
}

/// The check itself: a resultant or a slope that is off by a thousandth, and an energy that misses a part, are seen.
TEST(Laws, ABrokenLawFailsTheCheck) {
  const auto broken = [](double resultant, double slope, double energy) {
    return [=]<class S>(const S* k) {
      const double D[3] = {3e-6, 2e-6, 1e-6}, numbers[2] = {k0, kr};
      Answer<S, 3> a{};
      ZhengBending::bend<all_parts>(D, numbers, k, History<S>{}, a);
      a.resultant[1] = resultant * a.resultant[1];
      a.slope[0] = slope * a.slope[0];
      a.energy = energy * a.energy;
      return evaluated(a);
    };
  };
  for (const Three& k : curvatures) {
    const auto errors = [&](const auto& law) { return lawErrors<3>(law, k, 1e-4 * std::abs(k[1])); };
    EXPECT_LT(errors(broken(1, 1, 1)).gradient, 1e-8);
    EXPECT_GT(errors(broken(1.001, 1, 1)).gradient, 1e-6);
    EXPECT_GT(errors(broken(1, 1.001, 1)).slope, 1e-6);
    EXPECT_GT(errors(broken(1, 1.001, 1)).dual, 1e-6);
    EXPECT_GT(errors(broken(1, 1, 1.001)).gradient, 1e-6);
  }
}

}  // namespace
}  // namespace gambeson
