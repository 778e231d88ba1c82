#include "analysis/tables.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "analysis/series.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

/// 110 windows a period of 1.1 s, three periods.
std::vector<double> windowTimes() {
  std::vector<double> t;
  for (int i = 0; i < 330; ++i) t.push_back(0.005 + 0.01 * i);
  return t;
}

template <class F>
std::vector<double> values(const std::vector<double>& t, F f) {
  std::vector<double> v;
  for (const double x : t) v.push_back(f(x));
  return v;
}

const double kOmega = 2 * std::numbers::pi / 1.1;

TEST(Series, PeakRmsAmplitude) {
  const std::vector<double> t{0, 1, 2, 3}, v{1, -3, 3, 0};
  EXPECT_EQ(peakOf(t, v).value, -3);
  EXPECT_EQ(peakOf(t, v).time_s, 1);
  EXPECT_DOUBLE_EQ(rms(v), std::sqrt(19.0 / 4));
  EXPECT_EQ(amplitude(v), 3);
  EXPECT_EQ(noiseRatio(v, std::vector<double>{0.1, 0.5}), 3 / 0.2);
  EXPECT_EQ(rms({}), 0);
  EXPECT_THROW(peakOf(t, std::vector<double>{1}), std::logic_error);
}

// A sine over whole periods has RMS A/sqrt(2); repeated it is like itself; shifted by an angle phi its correlation is
// cos phi and the RMS of the difference 2 sin(phi/2) times its own.
TEST(Series, StridesOfASine) {
  const auto t = windowTimes();
  const auto right = values(t, [](double x) { return 2 * std::sin(kOmega * x); });
  const Likeness again = compareShifted(t, right, right, 1.1, 0, 1.1);
  EXPECT_EQ(again.samples, 110);
  EXPECT_NEAR(again.correlation, 1, 1e-12);
  EXPECT_NEAR(again.rms_difference, 0, 1e-12);
  const double phi = 0.3;
  const auto late = values(t, [&](double x) { return 2 * std::sin(kOmega * x - phi); });
  const Likeness other = compareShifted(t, right, late, 1.1, 1.1, 2.2);
  EXPECT_NEAR(other.correlation, std::cos(phi), 1e-9);
  EXPECT_NEAR(other.relative, 2 * std::sin(phi / 2), 1e-9);
  EXPECT_NEAR(other.rms_difference, std::numbers::sqrt2 * 2 * std::sin(phi / 2), 1e-9);
  // Left is right half a period later.
  const auto left = values(t, [](double x) { return 2 * std::sin(kOmega * (x - 0.55)); });
  EXPECT_NEAR(compareShifted(t, right, left, 0.55, 0, 1.1).correlation, 1, 1e-12);
  EXPECT_NEAR(compareShifted(t, right, left, 0, 0, 1.1).correlation, -1, 1e-12);
}

TEST(Series, ShiftsBetweenSamplesInterpolateAndNeverExtrapolate) {
  const std::vector<double> t{0, 1, 2, 3}, v{0, 1, 2, 3};
  const Likeness half = compareShifted(t, v, v, 0.5, 0, 10);
  EXPECT_EQ(half.samples, 3);  // 3.5 is not known
  EXPECT_DOUBLE_EQ(half.rms_difference, 0.5);
  EXPECT_TRUE(std::isnan(compareShifted(t, v, v, 9, 0, 10).correlation));
  const std::vector<double> flat{1, 1, 1, 1};
  EXPECT_TRUE(std::isnan(compareShifted(t, flat, v, 0, 0, 10).correlation));
}

TEST(Series, OtherSide) {
  EXPECT_EQ(otherSide("hip_flexion_left"), "hip_flexion_right");
  EXPECT_EQ(otherSide("hip_flexion_right"), "hip_flexion_left");
  EXPECT_EQ(otherSide("neck"), "");
}

/// A trunk and a thigh on a hip, and a massless link without a shape between them.
Human twoSegments() {
  Human human;
  human.skeleton.links = {{"trunk", -1, 1, {}}, {"between", 0, 0, {}}, {"thigh", 1, 1, {}}};
  Joint first, second;
  first.name = "hip_flexion_left";
  first.type = second.type = JointType::revolute;
  first.parent = 0;
  first.child = second.parent = 1;
  second.name = "slide";
  second.type = JointType::prismatic;
  second.child = 2;
  human.skeleton.joints = {first, second};
  human.shapes = {{2, "thigh", Ellipsoid{{1, 1, 1}}, {}}, {0, "trunk", Ellipsoid{{1, 1, 1}}, {}}};
  return human;
}

std::vector<ContactWindow> twoWindows() {
  std::vector<ContactWindow> w{{0, 0.01, std::vector<LinkImpulse>(3)}, {0.01, 0.03, std::vector<LinkImpulse>(3)}};
  w[0].links[0].force_Ns = {0.03, 0.04, 0};  // 5 N
  w[1].links[0].force_Ns = {0, 0, -0.05};    // 2.5 N
  w[1].links[2].force_Ns = {0.3, 0, 0};      // 15 N
  return w;
}

TEST(ContactTable, SharesAndPeaks) {
  const auto shares = contactShares(twoSegments(), twoWindows());
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].segment, "trunk");
  EXPECT_DOUBLE_EQ(shares[0].impulse_Ns, 0.1);
  EXPECT_DOUBLE_EQ(shares[0].share, 0.25);
  EXPECT_DOUBLE_EQ(shares[0].mean_N, 0.1 / 0.03);
  EXPECT_DOUBLE_EQ(shares[0].peak_N, 5);
  EXPECT_DOUBLE_EQ(shares[0].peak_time_s, 0.005);
  EXPECT_EQ(shares[1].segment, "thigh");
  EXPECT_DOUBLE_EQ(shares[1].share, 0.75);
  EXPECT_DOUBLE_EQ(shares[1].peak_N, 15);
  EXPECT_EQ(contactShares(twoSegments(), {})[0].share, 0);
  auto broken = twoWindows();
  broken[1].links.pop_back();
  EXPECT_THROW(contactShares(twoSegments(), broken), std::logic_error);
}

// Of 100 equal weights the values 1 ... 100 have the percentiles that they say; with weight w(v) = v the median of 1
// ... n is the least m with m (m + 1) >= n (n + 1)/2.
TEST(Stress, WeightedPercentiles) {
  std::vector<double> v, equal(100, 0.01), rising;
  for (int i = 100; i >= 1; --i) {
    v.push_back(i);
    rising.push_back(i);
  }
  EXPECT_EQ(weightedPercentile(v, equal, 0.5), 50);
  EXPECT_EQ(weightedPercentile(v, equal, 0.95), 95);
  EXPECT_EQ(weightedPercentile(v, equal, 1), 100);
  EXPECT_EQ(weightedPercentile(v, equal, 0), 1);
  EXPECT_EQ(weightedPercentile(v, rising, 0.5), 71);  // 71 * 72 = 5112 >= 5050 > 70 * 71
  EXPECT_TRUE(std::isnan(weightedPercentile({}, {}, 0.5)));
  const double nan[] = {std::nan("")}, one[] = {1}, minus[] = {-1};
  EXPECT_THROW(weightedPercentile(nan, one, 0.5), RunError);
  EXPECT_THROW(weightedPercentile(one, minus, 0.5), std::logic_error);
  EXPECT_THROW(weightedPercentile(one, one, 1.5), std::logic_error);
}

Regions twoRegions() { return {{"front", "back"}, {0, 1, 0, 1}, {1e-4, 1e-4, 3e-4, 1e-4}}; }

std::vector<StressFrame> twoFrames() {
  return {{0.1, {10, -5, 20, 7}, {0.01f, 0, 0.02f, 0.03f}}, {0.2, {12, 50, 15, 1}, {0.25f, 0, 0, 0}}};
}

TEST(Stress, SummaryPerRegion) {
  const auto s = summarizeStress(twoRegions(), twoFrames());
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0].p50_N_per_m, 15);  // by area: 10 (1), 12 (1), 15 (3), 20 (3) of 8
  EXPECT_EQ(s[0].p95_N_per_m, 20);
  EXPECT_EQ(s[0].max_N_per_m, 20);
  EXPECT_EQ(s[0].max_time_s, 0.1);
  EXPECT_EQ(s[0].max_strain, 0.25);
  EXPECT_EQ(s[0].max_strain_time_s, 0.2);
  EXPECT_EQ(s[1].max_N_per_m, 50);
  EXPECT_EQ(s[1].p50_N_per_m, 1);
  auto broken = twoFrames();
  broken[1].strain[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(summarizeStress(twoRegions(), broken), RunError);
  broken[1].strain.pop_back();
  EXPECT_THROW(summarizeStress(twoRegions(), broken), std::logic_error);
}

std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Tables, AreWrittenWithUnits) {
  std::string name = (fs::temp_directory_path() / "gambeson_tables_XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const fs::path dir = name;
  const Human human = twoSegments();
  const auto windows = twoWindows();
  writeTorques(dir / "torques.csv", human.skeleton, {{0, 1}, {0.005, 0.02}, {{1, 2}, {0.5, -1}}});
  EXPECT_EQ(slurp(dir / "torques.csv"), "time_s,hip_flexion_left_Nm,slide_N\n0.005,1,2\n0.02,0.5,-1\n");
  writeContact(dir / "contact.csv", human, std::span(windows).first(1));
  EXPECT_EQ(
      slurp(dir / "contact.csv"),
      "time_s,trunk_N,trunk_x_N,trunk_y_N,trunk_z_N,thigh_N,thigh_x_N,thigh_y_N,thigh_z_N\n0.005,5,3,4,0,0,0,0,0\n");
  writeStress(dir / "stress.csv", {{"front"}, {0}, {1}}, std::vector<StressFrame>{{0.5, {3}, {0.25f}}});
  EXPECT_EQ(slurp(dir / "stress.csv"),
            "time_s,front_p50_N_per_m,front_p95_N_per_m,front_p99_N_per_m,front_max_N_per_m,front_max_strain\n"
            "0.5,3,3,3,3,0.25\n");
  fs::remove_all(dir);
}

}  // namespace
}  // namespace gambeson
