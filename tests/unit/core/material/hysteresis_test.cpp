// Measured loops of bending as sums of stops: Wong 2014, chapter 4, and what an instrument reads.
#include "core/material/hysteresis.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/material/laws/bending_laws.hpp"
#include "unit/core/material/law_check.hpp"

namespace gambeson {
namespace {

/// Wong 2014, fig. 4.7, in his numbers (curvature in 1/cm).
constexpr double b1 = 0.76, b2 = 0.26, c1 = -0.38, K0 = (b2 - b1) / (2 * c1), M0 = 0.5 * (b1 - b2) * K0, Km = 2.5;

template <int N>
BentLine<N> thesisLine(double setting = 0, double fatigue = 0) {
  return BentLine<N>(stopsOf<N>(quadraticCurve(b1, b2, c1)), {setting, fatigue, Km});
}

struct Way {
  double work = 0, moment = 0, at = 0;
  std::vector<double> k, m;
};
/// Bends the line from where it is through all curvatures, each in that many steps.
template <int N>
Way bendThrough(BentLine<N>& line, double from, const std::vector<double>& turns, int steps = 400) {
  Way way;
  way.at = from;
  way.moment = line.bend(from);
  for (const double to : turns) {
    const double start = way.at;
    for (int s = 1; s <= steps; ++s) {
      const double k = start + (to - start) * s / steps, m = line.bend(k);
      way.work += 0.5 * (m + way.moment) * (k - way.at);
      way.at = k;
      way.moment = m;
      way.k.push_back(k);
      way.m.push_back(m);
    }
  }
  return way;
}

/// Eq. 4.2, and from a reversal at Km on eq. 4.4 with 4.8: the quadratic over 2 K0, then the line.
double virgin(double k) { return k <= K0 ? b1 * k + c1 * k * k : M0 + b2 * k; }
double reversed(double k) {
  const double way = Km - k, top = virgin(Km);
  return way <= 2 * K0 ? top - (b1 * way + 0.5 * c1 * way * way) : b2 * k - M0;
}

TEST(Hysteresis, TheLoopOfTheThesisIsASumOfStops) {
  auto line = thesisLine<8>();
  const Way up = bendThrough(line, 0, {Km}), loop = bendThrough(line, Km, {-Km, Km}, 4000);
  for (std::size_t i = 0; i < up.k.size(); ++i) EXPECT_NEAR(up.m[i], virgin(up.k[i]), 0.02 * M0) << up.k[i];
  for (std::size_t i = 0; i < loop.k.size() / 2; ++i)
    EXPECT_NEAR(loop.m[i], reversed(loop.k[i]), 0.02 * M0) << loop.k[i];
  EXPECT_NEAR(loop.work / (4 * M0 * (Km - 2 * K0 / 3)), 1, 2e-3);
  EXPECT_NEAR(stopsOf<8>(quadraticCurve(b1, b2, c1)).frictionMoment() / M0, 1, 1e-14);
  EXPECT_NEAR(stopsOf<8>(quadraticCurve(b1, b2, c1)).first_Nm, b1, 1e-14);
}

TEST(Hysteresis, AFoldStaysWhereTheMomentIsZero) {
  for (const auto& [to, expected] : {std::pair{1.0, 0.329}, {1.5, 0.540}, {2.5, 0.633}}) {
    auto line = thesisLine<8>();
    line.bend(to);
    double low = 0, high = to;  // bisection from copies: a line is its history
    for (int i = 0; i < 60; ++i) {
      auto tried = line;
      const double mid = 0.5 * (low + high);
      (tried.bend(mid) > 0 ? high : low) = mid;
    }
    EXPECT_NEAR(low, expected, 0.01) << "after " << to;
  }
}

TEST(Hysteresis, InnerLoopsClose) {
  auto line = thesisLine<8>();
  const Way way = bendThrough(line, 0, {1.5, 0.6, 1.2, 0.9, 1.2, 0.9, 1.2, 0.9, 1.2, 0.9, 1.2, 0.9, 1.2, 0.9, 1.2}, 30);
  const auto at = [&](int turn) { return way.m[static_cast<std::size_t>(30 * (turn + 1) - 1)]; };
  for (int turn = 4; turn < 15; turn += 2) EXPECT_NEAR(at(turn), at(2), 1e-12);
  for (int turn = 5; turn < 14; turn += 2) EXPECT_NEAR(at(turn), at(3), 1e-12);
  EXPECT_NEAR(line.bend(1.5), at(0), 1e-12) << "and the outer branch goes on as if they had not been";
}

TEST(Hysteresis, ASmallCycleLosesTheCubeOfItsWidth) {
  for (const double A : {0.1 * K0, 0.3 * K0, 0.6 * K0}) {
    auto line = thesisLine<64>();
    bendThrough(line, 0, {A, -A, A}, 200);
    const double before = line.lost();
    const Way cycle = bendThrough(line, A, {-A, A}, 2000);
    const double closed = 2.0 / 3 * (b1 - b2) * A * A * A / K0;
    EXPECT_NEAR((line.lost() - before) / closed, 1, 0.01) << A / K0;
    EXPECT_NEAR(cycle.work / closed, 1, 0.01) << A / K0;
  }
}

TEST(Hysteresis, AWayIsTheSameInOneStepOrAThousand) {
  for (const double to : {0.05, 0.4, 2.0}) {
    auto once = thesisLine<8>(), often = thesisLine<8>();
    const double in_one = once.bend(to), in_many = bendThrough(often, 0, {to}, 1000).moment;
    EXPECT_NEAR(in_one, in_many, 1e-13);
    EXPECT_NEAR(once.lost(), often.lost(), 1e-12);
    EXPECT_NEAR(once.stored(), often.stored(), 1e-12);
  }
}

TEST(Hysteresis, WhatTheMomentWorksIsStoredOrLost) {
  for (const auto& [setting, fatigue, gap] : {std::tuple{0.0, 0.0, 1e-6}, {0.3, 0.1, 2e-4}}) {
    auto line = thesisLine<8>(setting, fatigue);
    double before = 0;
    const Way way = bendThrough(line, 0, {Km, -Km, 0.4, -0.2, 1.0, 0.0}, 4000);
    EXPECT_NEAR(way.work, line.stored() + line.lost(), gap * line.lost());
    auto again = thesisLine<8>(setting, fatigue);
    for (const double k : way.k) {
      again.bend(k);
      EXPECT_GE(again.lost(), before);
      before = again.lost();
    }
  }
}

TEST(Hysteresis, ACycleOfReferenceTakesItsShareOfTheFriction) {
  const double mu = 0.1, lambda = 0.15;
  auto line = thesisLine<8>(lambda, mu);
  line.bend(Km);
  double before = line.friction();
  for (int n = 0; n < 20; ++n) {
    bendThrough(line, Km, {-Km, Km}, 800);
    EXPECT_NEAR(line.friction() / before, 1 - mu, 1e-4);
    EXPECT_LT(std::abs(line.set()), 0.04 * Km) << "bent as far either way";
    before = line.friction();
  }
}

TEST(Hysteresis, RepeatedFoldsSetLessAndLess) {
  auto line = thesisLine<8>(0.3, 0.1);
  double set = 0, added = Km;
  for (int n = 0; n < 60; ++n) {
    bendThrough(line, 0, {Km, 0}, 400);
    EXPECT_LT(line.set(), Km);
    if (n > 0) {
      EXPECT_GT(line.set(), set);
      EXPECT_LT(line.set() - set, added);
    }
    added = line.set() - set;
    set = line.set();
  }
}

// Wong 2014, section 4.5.4: folded again and again, the initial stiffness goes from b1 to b2. A small bend after each
// fold has the slope b2 + phi (b1 - b2), of the law and of what it says of its friction phi alike.
TEST(Hysteresis, FoldsSoftenFromTheFirstSlopeToTheLast) {
  auto line = thesisLine<8>(0.15, 0.1);
  const auto slope = [&] {
    auto probe = line;
    const double dk = 1e-3 * K0, m = probe.bend(0);
    return (probe.bend(dk) - m) / dk;
  };
  // Of a polygon of eight stops the first side is a little softer than the tangent.
  const double first = (line.bend(1e-3 * K0) - line.bend(0)) / (1e-3 * K0);
  EXPECT_NEAR(first, b1, 0.1 * (b1 - b2));
  double before = first;
  for (int n = 0; n < 100; ++n) {
    bendThrough(line, 0, {Km, 0}, 200);
    EXPECT_NEAR(slope(), b2 + line.friction() * (first - b2), 1e-9) << n;
    EXPECT_LT(slope(), before);
    before = slope();
  }
  EXPECT_LT(before, b2 + 0.05 * (b1 - b2));
}

TEST(Hysteresis, VibrationsNeitherSetNorTire) {
  auto line = thesisLine<64>(0.1, 0.02);
  bendThrough(line, 0, {1.5}, 200);
  const double set = line.set(), friction = line.friction();
  for (int n = 0; n < 1000; ++n) bendThrough(line, 1.5, {1.49, 1.51, 1.5}, 5);
  EXPECT_LT(std::abs(line.set() - set), 1e-3);
  EXPECT_LT(std::abs(line.friction() - friction), 1e-3);
}

TEST(Hysteresis, KesReadsWhatItWasMadeOf) {
  const KesBending read{1e-4, 8e-4};
  const StopShape<8> quadratic = stopsOf<8>(curveOver(1, 0, 1)).shape;
  for (const double span : {20.0, 65.0, 120.0}) {
    const Stops<8> stops = stopsOfKes(quadratic, read, span);
    const KesBending again = readKes(stops);
    EXPECT_NEAR(again.rigidity_Nm, read.rigidity_Nm, 1e-12 * read.rigidity_Nm);
    EXPECT_NEAR(again.hysteresis_N, read.hysteresis_N, 1e-12 * read.hysteresis_N);
    if (span < 50) {
      EXPECT_NEAR(stops.last_Nm, read.rigidity_Nm, 1e-15);
      EXPECT_NEAR(2 * stops.frictionMoment(), read.hysteresis_N, 1e-15);
    }
  }
  EXPECT_THROW(stopsOfKes(quadratic, {1e-7, 8e-4}, 200), InputError) << "so wide a loop is steeper than that";
}

TEST(Hysteresis, APolygonIsMetAtItsCorners) {
  const std::vector<std::pair<double, double>> points{{20, 0.004}, {60, 0.007}, {100, 0.009}, {200, 0.012}};
  BentLine<8> line(stopsOf<8>(measuredCurve(points)));
  for (const auto& [k, m] : points) EXPECT_NEAR(line.bend(k), m, 1e-15);
  std::vector<std::pair<double, double>> many;
  for (int i = 1; i <= 40; ++i) many.push_back({5.0 * i, 1e-4 * std::sqrt(5.0 * i)});
  BentLine<8> coarse(stopsOf<8>(measuredCurve(many)));
  for (const auto& [k, m] : many) EXPECT_NEAR(coarse.bend(k), m, 0.1 * many.back().second) << k;
  EXPECT_THROW(measuredCurve({{10, 1}, {20, 3}}), InputError) << "steeper";
  EXPECT_THROW(measuredCurve({{10, 1}, {9, 2}}), InputError);
  EXPECT_THROW(measuredCurve({{10, 1}}), InputError);
}

TEST(Hysteresis, ZhengsCurveHasAMemoryToo) {
  const VirginCurve curve = zhengVirginCurve(1e-3, 30, 1);
  BentLine<64> line(stopsOf<64>(curve));
  for (double k = 0.1; k <= 60; k *= 1.3) {
    Answer<double, 1> zheng{};
    zhengCurve<all_parts>(1e-3, 30.0, 1.0, k, zheng);
    EXPECT_NEAR(line.bend(k), zheng.resultant[0], 0.02 * curve.moment(30)) << k;
  }
}

TEST(Hysteresis, RefusesWhatIsNoLoop) {
  EXPECT_THROW(quadraticCurve(0.26, 0.76, -0.38), InputError) << "b1 < b2";
  EXPECT_THROW(quadraticCurve(0.76, 0.26, 0.38), InputError) << "c1 > 0";
  EXPECT_THROW(curveOver(1, 0, 0), InputError);
}

/// The laws of a point: along each line of the cloth, or of the whole tensor.
template <class L>
L lawOf(double setting, double fatigue) {
  const Stops<8> stops = stopsOf<8>(curveOver(3e-4, 1e-4, 60));
  L law;
  law.weft_Nm = law.warp_Nm = 1e-4;
  law.twist_Nm = 0.5e-4;
  law.shape = stops.shape;
  law.first_Nm = {3e-4, 3e-4, 1.5e-4};
  law.span_per_m = {60, 60, 60};
  law.setting = setting;
  law.fatigue = fatigue;
  if constexpr (requires { law.part; }) law.part = 0.7, law.time_s = 2;
  law.check([](const std::string& key, const std::string& why) { FAIL() << key << " " << why; });
  return law;
}

template <class L>
void expectLaw(const char* name) {
  const L law = lawOf<L>(0.3, 0.1);
  const auto numbers = law.numbers();
  const double D[3] = {law.weft_Nm, law.warp_Nm, law.twist_Nm};
  std::array<double, L::history_size> memory{}, next{};
  // Some way into a history.
  for (const std::array<double, 3>& k : {std::array{40.0, -30.0, 25.0}, {-10.0, 55.0, 5.0}}) {
    Answer<double, 3> a{};
    L::template bend<all_parts>(D, numbers.data(), k.data(), History<double>{memory.data(), next.data(), 1, true}, a);
    memory = next;
  }
  const auto answer = [&]<class S>(const S* k) {
    double trial[L::history_size];
    Answer<S, 3> a{};
    History<S> history{memory.data(), trial, 1, true};
    history.elapsed_s = 0.5;
    L::template bend<all_parts>(D, numbers.data(), k, history, a);
    return evaluated(a);
  };
  for (const std::array<double, 3>& k :
       {std::array{-9.3, 54.2, 5.7}, {41.0, 13.0, -7.0}, {-150.0, 90.0, 70.0}, {3.0, 200.0, -100.0}}) {
    const LawErrors e = lawErrors<3>(answer, k, 1e-3);
    EXPECT_LT(e.gradient, 1e-8) << name << " " << k[0];
    EXPECT_LT(e.slope, 1e-8) << name << " " << k[0];
    EXPECT_LT(e.dual, 1e-12) << name << " " << k[0];
  }
}

TEST(Hysteresis, ResultantsAreTheGradientOfWhatIsStoredAndLost) {
  expectLaw<HysteresisBending>("apart");
  expectLaw<IsotropicHysteresisBending>("isotropic");
  expectLaw<CyclicHysteresisBending>("cycles");
  expectLaw<Recovering<HysteresisBending>>("recovering");
  expectLaw<Recovering<IsotropicHysteresisBending>>("recovering, isotropic");
}

/// A law that is bent along weft, step by step.
template <class L>
class BentSheet {
 public:
  explicit BentSheet(const L& law) : law_(law), numbers_(law.numbers()) {}
  double bend(double k, double elapsed_s = 0) {
    const double D[3] = {law_.weft_Nm, law_.warp_Nm, law_.twist_Nm}, to[3] = {k, 0, 0};
    std::array<double, L::history_size> trial{};
    History<double> history{memory.data(), trial.data(), 1, true};
    history.elapsed_s = elapsed_s;
    out = {};
    L::template bend<all_parts>(D, numbers_.data(), to, history, out);
    memory = trial;
    lost += out.lost;
    return out.resultant[0];
  }
  std::array<double, L::history_size> memory{};
  Answer<double, 3> out{};
  double lost = 0;

 private:
  L law_;
  std::array<double, L::number_count> numbers_;
};

/// Held bent, its branch relaxes as exp(-t/tau); let go fast, it keeps what has relaxed and opens slowly.
TEST(Hysteresis, AMaxwellBranchRelaxesAndLetsAFoldOpenInTime) {
  const auto law = lawOf<Recovering<HysteresisBending>>(0, 0);
  BentSheet<HysteresisBending> alone(law);
  BentSheet<Recovering<HysteresisBending>> sheet(law);
  const double K = 100, v = 0.7 * law.weft_Nm, at_rest = alone.bend(K);
  EXPECT_NEAR(sheet.bend(K), at_rest + v * K, 1e-15) << "fast";
  double before = sheet.lost;
  for (int i = 0; i < 2000; ++i) {
    sheet.bend(K, 1e-3);
    EXPECT_GE(sheet.lost, before);
    before = sheet.lost;
  }
  EXPECT_NEAR(sheet.out.resultant[0] - at_rest, v * K * std::exp(-1.0), 5e-4 * v * K) << "after tau";
  EXPECT_NEAR(sheet.bend(K, INFINITY), at_rest, 1e-15) << "in statics";
  // The curvature without moment, by bisection of copies: at once, and after 20 tau.
  const auto open = [](auto tried, double elapsed) {
    double low = 0, high = 100;
    for (int i = 0; i < 60; ++i) {
      auto copy = tried;
      (copy.bend(0.5 * (low + high), elapsed) > 0 ? high : low) = 0.5 * (low + high);
    }
    return low;
  };
  const double alone_at = open(alone, 0), at_once = open(sheet, 0), late = open(sheet, INFINITY);
  EXPECT_GT(at_once, 1.2 * alone_at);
  EXPECT_NEAR(late, alone_at, 1e-9 * K);
}

/// Wong 2014, eq. 4.6, 4.7 and 4.11, in his numbers.
CyclicHysteresisBending thesisRule(double lambda, double mu) {
  const Stops<kStops> s = stopsOf<kStops>(quadraticCurve(b1, b2, c1));
  CyclicHysteresisBending law;
  law.weft_Nm = law.warp_Nm = law.twist_Nm = b2;
  law.shape = s.shape;
  law.first_Nm = {b1, b1, b1};
  law.span_per_m = {K0, K0, K0};
  law.setting = lambda;
  law.fatigue = mu;
  law.cycle_per_m = Km;
  return law;
}

TEST(Hysteresis, ThePrintedRuleSetsAtTheEndOfACycle) {
  for (const auto& [to, residual] : {std::pair{0.5, 0.0}, {1.0, 0.329}, {1.5, 0.540}, {2.5, 0.633}}) {
    BentSheet<CyclicHysteresisBending> sheet(thesisRule(0.3, 0.1));
    for (int i = 1; i <= 500; ++i) sheet.bend(to * i / 500);
    EXPECT_EQ(sheet.memory[kStops], 0) << "while it is bent";
    for (int i = 499; sheet.out.resultant[0] > 0; --i) sheet.bend(to * i / 500);
    const double top = virgin(to), xi = std::min(1.0, top / (2 * (M0 + b2 * K0)));
    const bool overcome = to > K0;
    EXPECT_NEAR(sheet.memory[kStops], overcome ? 0.3 * xi * residual : 0, 0.3 * 0.006) << to;
    EXPECT_NEAR(1 - sheet.memory[kStops + 1], overcome ? 1 - 0.1 * xi : 1, 1e-3) << to;
  }
}

/// What the printed rule makes of a vibration of 0.01/cm, and what the stops' own does not.
TEST(Hysteresis, ThePrintedRuleTakesAVibrationForCycles) {
  BentSheet<CyclicHysteresisBending> sheet(thesisRule(0.1, 0.02));
  for (int i = 1; i <= 200; ++i) sheet.bend(1.5 * i / 200);
  for (int n = 0; n < 1000; ++n) {
    for (int i = 1; i <= 10; ++i) sheet.bend(1.5 - 0.01 * std::sin(2 * M_PI * i / 10));
    ASSERT_TRUE(std::isfinite(sheet.out.resultant[0]));
  }
  EXPECT_GT(sheet.memory[kStops], 0.5) << "set, 1/cm (stops: below 1e-3, VibrationsNeitherSetNorTire)";
  EXPECT_LT(1 - sheet.memory[kStops + 1], 0.85);
  EXPECT_GT(virgin(1.5), M0 + b2 * K0) << "friction is overcome, as the rule asks";
}

/// Cloth bent to a cylinder about any axis is one line.
TEST(Hysteresis, TheIsotropicLawIsTheSameAboutAllAxes) {
  const auto law = lawOf<IsotropicHysteresisBending>(0.2, 0.05);
  const auto numbers = law.numbers();
  const double D[3] = {law.weft_Nm, law.warp_Nm, law.twist_Nm};
  constexpr int kSize = IsotropicHysteresisBending::history_size;
  for (const double degrees : {0.0, 22.5, 45.0, 90.0}) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    BentLine<8> line(stopsOf<8>(curveOver(3e-4, 1e-4, 60)), {0.2, 0.05, 250});
    double memory[kSize] = {}, next[kSize];
    for (const double K : {30.0, 120.0, 40.0, -200.0, -10.0, 60.0}) {
      const double k[3] = {K * c * c, K * s * s, 2 * K * c * s}, m = line.bend(K);
      Answer<double, 3> a{};
      IsotropicHysteresisBending::bend<all_parts>(D, numbers.data(), k, History<double>{memory, next, 1, true}, a);
      std::copy(next, next + kSize, memory);
      EXPECT_NEAR(a.resultant[0] * c * c + a.resultant[1] * s * s + 2 * a.resultant[2] * c * s, m, 1e-12 * std::abs(m));
      EXPECT_NEAR(a.resultant[0] * s * s + a.resultant[1] * c * c - 2 * a.resultant[2] * c * s, 0, 1e-12 * std::abs(m));
    }
  }
}

TEST(Hysteresis, ALawIsMixedStiffenedAndThickened) {
  const auto law = lawOf<HysteresisBending>(0.2, 0.05);
  auto other = law;
  other.stiffen(2);
  EXPECT_NEAR(HysteresisBending::mixed(law, other, 0.3).first_Nm[0], 1.3 * law.first_Nm[0], 1e-18);
  other = law;
  other.thicken(2);
  EXPECT_DOUBLE_EQ(other.first_Nm[0], 8 * law.first_Nm[0]);
  EXPECT_DOUBLE_EQ(other.span_per_m[1], law.span_per_m[1] / 2);
  other = law;
  other.stiffen(2);
  EXPECT_DOUBLE_EQ(other.most_Nm(), 2 * law.most_Nm());
  EXPECT_DOUBLE_EQ(steepestSlope(law, law.weft_Nm), 3e-4);
  EXPECT_TRUE(law == law);
  EXPECT_FALSE(other == law);
}

}  // namespace
}  // namespace gambeson
