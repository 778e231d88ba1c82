// The boxes of Man 2006, section 3.3, on a few rows.
#include "core/contact/method.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/penalty.hpp"

namespace gambeson {
namespace {

constexpr double kStep_s = 1e-3;

/// Points of 2 g; each row touches them with its own weights.
struct Rows {
  ContactParameters parameters{1e-3, 0.0, 0.01, 1e-6, 4000};
  std::vector<Obstacle> obstacles{{Ellipsoid{{1, 1, 1}}, "body"}};
  std::vector<Placement> placed{1};
  SparseRows WT;
  std::vector<ContactRow> rows;
  std::vector<RowLayer> layer;
  std::vector<double> inverse, area, density;
  std::vector<int> place;
  std::vector<Vec3> x0, velocity, warm, impulses;
  ContactWork work;
  MethodWork scratch;

  explicit Rows(ContactMethod method, int points) : inverse(points, 500.0), velocity(points) {
    parameters.method = method;
    parameters.penalty_Pa_per_m = 1e6;
    WT.column_count = points;
  }
  /// A sample with a row of its own.
  void add(const std::vector<std::pair<int, double>>& weights, const Vec3& normal, double target, double gap = 2e-3) {
    for (const auto& [point, weight] : weights) WT.add(point, weight);
    WT.endRow();
    place.push_back(static_cast<int>(x0.size()));
    again(static_cast<int>(x0.size()), normal, target, gap);
    x0.push_back({});
    area.push_back(1e-4);
    density.push_back(20);
  }
  void again(int sample, const Vec3& normal, double target, double gap = 2e-3) {
    Contact c;
    c.sample = sample;
    c.normal = normal;
    c.gap_m = gap;
    rows.push_back(bodyRow(c, {}, target, false));
    layer.push_back({1e-3});
    warm.push_back({});
  }
  ContactSolve solve() {
    const MethodStep step{WT, inverse, area, density, place, obstacles, placed, placed, x0, parameters, kStep_s};
    return solveByMethod(*bodyMethod(parameters), step, {rows, layer}, velocity, warm, impulses, work, scratch);
  }
};

/// Of the sample that a row is of.
Vec3 velocityOf(const Rows& r, int row) {
  Vec3 v{};
  const int s = r.rows[row].contact.sample;
  for (int e = r.WT.offsets[s]; e < r.WT.offsets[s + 1]; ++e) v += r.WT.values[e] * r.velocity[r.WT.columns[e]];
  return v;
}

TEST(ForwardIncrement, TwoRowsOfANodeAreSolvedTogether) {
  Rows r(ContactMethod::forward_increment, 1);
  const Vec3 a = normalized(Vec3{1, 0, 2}), b = normalized(Vec3{-1, 0, 1});
  r.add({{0, 1}}, a, 0.5);
  r.again(0, b, 0.25);
  EXPECT_TRUE(r.solve().converged);
  EXPECT_NEAR(dot(r.velocity[0], a), 0.5, 1e-9);
  EXPECT_NEAR(dot(r.velocity[0], b), 0.25, 1e-9);
}

/// Both rows are penetrated by the trial; eq. 3.67 of both holds one of them to the body. It is dropped, and the other
/// is solved alone: 0.9 is more than the 0.5 that the second asks for.
TEST(ForwardIncrement, AMultiplierThatWouldPullIsDropped) {
  const Vec3 a{0, 0, 1}, b{std::sqrt(1 - 0.81), 0, 0.9};
  const double second = (0.5 - 0.9) / (1 - 0.81);
  ASSERT_LT(second, 0);  // of [1 0.9; 0.9 1] lambda = [1; 0.5]
  Rows r(ContactMethod::forward_increment, 1);
  r.add({{0, 1}}, a, 1);
  r.again(0, b, 0.5);
  EXPECT_TRUE(r.solve().converged);
  EXPECT_EQ(r.impulses[1], Vec3{});
  EXPECT_NEAR(norm(r.impulses[0] - Vec3{0, 0, 1.0 / 500}), 0, 1e-12);
}

/// Samples between points: what they ask for holds, and momentum is what the impulses say.
TEST(ForwardIncrement, SamplesBetweenPoints) {
  Rows r(ContactMethod::forward_increment, 4);
  r.parameters.friction = 0.3;
  const Vec3 n{0, 0, 1};
  for (Vec3& v : r.velocity) v = {0.5, 0, -1};
  r.velocity[3] = {0.5, 0.2, 0.5};
  for (int i = 0; i < 3; ++i) r.add({{i, 0.7}, {i + 1, 0.3}}, n, 0);
  r.add({{1, 0.5}, {2, 0.5}}, n, 0);
  const std::vector<Vec3> before = r.velocity;
  EXPECT_TRUE(r.solve().converged);
  Vec3 change{}, sum{};
  for (int i = 0; i < 4; ++i) change += (r.velocity[i] - before[i]) / 500;
  for (std::size_t k = 0; k < r.rows.size(); ++k) {
    sum += r.impulses[k];
    const double pressed = dot(r.impulses[k], n);
    EXPECT_GE(pressed, 0);
    EXPECT_LE(norm(r.impulses[k] - pressed * n), 0.3 * pressed * (1 + 1e-9) + 1e-15);
    EXPECT_GT(dot(velocityOf(r, static_cast<int>(k)), n), -1e-8);
  }
  EXPECT_LT(norm(change - sum), 1e-12 * norm(sum));
  EXPECT_GT(norm(sum), 1e-3);
}

TEST(Penalty, PressesByDepthAndArea) {
  Rows r(ContactMethod::penalty, 2);
  r.add({{0, 1}}, {0, 0, 1}, 0, 0.25e-3);
  r.add({{1, 1}}, {0, 0, 1}, 0, 1.5e-3);  // beyond the layer
  EXPECT_TRUE(r.solve().converged);
  EXPECT_NEAR(r.impulses[0].z, kStep_s * 1e-4 * 1e6 * 0.75e-3, 1e-18);
  EXPECT_EQ(r.impulses[1], Vec3{});
  EXPECT_EQ(r.velocity[1], Vec3{});
  EXPECT_DOUBLE_EQ(penaltyFrequency(r.parameters, std::vector<double>{4, 1, 9}), 1e3);
}

/// What no box takes is solved as ever: here cloth that lies on cloth on a body. The lower sheet bears both.
TEST(Method, ClothOnClothTakesTurnsWithIt) {
  for (const ContactMethod method : {ContactMethod::forward_increment, ContactMethod::projection}) {
    Rows r(method, 2);
    const TriangleMesh floor{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    r.obstacles = {{floor, "floor"}};
    r.add({{0, 1}}, {0, 0, 1}, 0, 1e-3);
    r.x0[0] = {0, 0, 1e-3};
    r.add({{1, 1}}, {0, 0, 1}, 0);
    ContactRow& on_cloth = r.rows[1];
    on_cloth.contact.kind = ContactKind::sample_on_cloth;
    on_cloth.contact.obstacle = -1;
    on_cloth.stencil = {};
    on_cloth.stencil.add(1, 1);
    on_cloth.stencil.add(0, -1);
    const double fall = 9.81 * kStep_s;
    for (Vec3& v : r.velocity) v = {0, 0, -fall};
    EXPECT_TRUE(r.solve().converged);
    EXPECT_NEAR(r.impulses[0].z * 500, 2 * fall, 1e-6);
    EXPECT_NEAR(r.impulses[1].z * 500, fall, 1e-6);
    EXPECT_NEAR(norm(r.velocity[0]) + norm(r.velocity[1]), 0, 1e-7);
  }
}

}  // namespace
}  // namespace gambeson
