/// Cloth with friction in shear: what it loses, its force and its tangent, on every kind of cloth.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/material/fabric_law.hpp"
#include "unit/core/cloth/triangles/triangle_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kSide_m = 0.1;
const ShearFriction friction{260, 0.0174, 150};

struct Kind {
  const char* name;
  bool shell;
  BendingLaw law;  ///< beside it
  std::size_t bending;
};

class ShearMemory : public testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<const Cloth> cloth() const {
    Fabric fabric = sheetFabric();
    fabric.shear_friction = friction;
    fabric.law = GetParam().law;
    if (GetParam().shell) return std::make_unique<NurbsShell>(squareSheet(5, kSide_m, 0, fabric));
    return std::make_unique<TriangleCloth>(
        std::vector<MeshDraft>{flatTriangles(5, 5, kSide_m, kSide_m, fabric, MeshKind::single)});
  }
};
INSTANTIATE_TEST_SUITE_P(
    Kinds, ShearMemory,
    testing::Values(Kind{"Shell", true, LinearBending{{1e-5, 1e-5, 5e-6}}, 0},
                    Kind{"Triangles", false, LinearBending{{1e-5, 1e-5, 5e-6}}, 0},
                    Kind{"ShellThatBendsWithStops", true, StopBending{{1e-5, 1e-5, 5e-6}, 1e-4}, 3},
                    Kind{"TrianglesThatBendWithStops", false, StopBending{{1e-5, 1e-5, 5e-6}, 1e-4}, 3}),
    [](const auto& i) { return std::string(i.param.name); });

std::vector<Vec3> sheared(const Cloth& c, double g) {
  std::vector<Vec3> q = c.rest();
  for (Vec3& x : q) x.y += g * x.x;
  return q;
}

TEST_P(ShearMemory, LosesWhatItsLoopEncloses) {
  const auto c = cloth();
  std::size_t with_shear = 0;
  for (const HistoryPlace& p : c->historyPlaces()) {
    EXPECT_LT(p.first + (p.count - 1) * p.stride, c->historySize());
    with_shear += p.count >= static_cast<std::size_t>(kShearHistory);
  }
  EXPECT_GT(with_shear, 0u);
  std::vector<double> committed(c->historySize()), trial = committed;
  std::vector<Vec3> before, force_before, force(c->rest().size());
  double lost = 0, work = 0, stored = 0, point_lost = 0;
  ClothWork scratch;
  const int steps = 400;
  std::array<double, kShearHistory> own{}, next{};
  const double numbers[3] = {friction.rise_N_per_m, friction.span, friction.growth_N_per_m};
  for (int s = 0; s <= 2 * steps; ++s) {
    const double g = 0.12 * std::sin(2 * std::numbers::pi * s / steps);
    const std::vector<Vec3> q = sheared(*c, g);
    ClothEnergy energy;
    c->force({q, {}, committed}, {force, {}, trial, &energy}, scratch, {});
    EXPECT_GE(energy.lost, 0);
    Answer<double, 3> point{};
    addShearFriction<all_parts>(numbers, g, History<double>{own.data(), next.data(), 1, true}, 0, point);
    own = next;
    lost += energy.lost;
    point_lost += point.lost;
    if (s > 0)
      for (std::size_t i = 0; i < q.size(); ++i) work -= 0.5 * dot(force[i] + force_before[i], q[i] - before[i]);
    stored = energy.stored;
    before = q, force_before = force;
    committed = trial;
  }
  EXPECT_NEAR(lost, point_lost * kSide_m * kSide_m, 1e-9 * lost) << "all of it shears alike";
  EXPECT_NEAR(work, stored + lost, 0.01 * lost);
}

TEST_P(ShearMemory, ForceAndTangentAreOfTheCommittedHistory) {
  const auto c = cloth();
  std::vector<double> committed(c->historySize()), trial = committed;
  std::vector<Vec3> q = sheared(*c, 0.1), f(q.size()), back(q.size());
  ClothWork work;
  c->force({q, {}, committed}, {f, {}, trial, nullptr}, work, {});
  ASSERT_NE(trial, committed) << "it has slipped";
  committed = trial;
  q = sheared(*c, 0.06);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1, 1);
  std::vector<Vec3> free_way(c->map().home.size()), way(q.size());
  for (Vec3& v : free_way) v = {noise(random), noise(random), noise(random)};
  c->map().T.multiply<Vec3>(free_way, way);
  const auto at = [&](double h, std::vector<Vec3>& force) {
    std::vector<Vec3> moved = q;
    for (std::size_t i = 0; i < q.size(); ++i) moved[i] += h * way[i];
    ClothEnergy energy;
    c->force({moved, {}, committed}, {force, {}, {}, &energy}, work, {});
    return energy.stored + energy.lost;
  };
  const double h = 1e-7;
  const double slope = (at(h, f) - at(-h, back)) / (2 * h);
  double of_force = 0, differences = 0;
  for (std::size_t i = 0; i < q.size(); ++i) differences += dot((back[i] - f[i]) / (2 * h), way[i]);
  at(0, f);
  for (std::size_t i = 0; i < q.size(); ++i) of_force -= dot(f[i], way[i]);
  EXPECT_NEAR(slope, of_force, 1e-6 * std::abs(of_force));
  const auto tangent = c->tangent();
  BlockMatrix K = tangent->sparsity();
  tangent->assemble({q, {}, committed}, work, K, {});
  std::vector<double> Kx(3 * free_way.size());
  multiply(K, {&free_way.data()->x, 3 * free_way.size()}, Kx);
  double stiffness = 0;
  for (std::size_t i = 0; i < free_way.size(); ++i)
    for (int d = 0; d < 3; ++d) stiffness += Kx[3 * i + static_cast<std::size_t>(d)] * free_way[i][d];
  EXPECT_NEAR(stiffness, differences, 1e-5 * std::abs(stiffness));
  const std::vector<double> none(c->historySize());
  c->force({q, {}, none}, {back, {}, {}, nullptr}, work, {});
  double change = 0, size = 0;
  for (std::size_t i = 0; i < q.size(); ++i) change += norm2(back[i] - f[i]), size += norm2(f[i]);
  EXPECT_GT(change, 1e-4 * size);
  // Tables see what the laws say.
  const PointState state = c->stateAt({q, {}, committed}, 0, c->placeOfDraft(0, {0.5, 0.5}));
  const PointState fresh = c->stateAt({q, {}, none}, 0, c->placeOfDraft(0, {0.5, 0.5}));
  EXPECT_GT(std::abs(state.n.z - fresh.n.z), 0.1) << "N/m";
}

}  // namespace
}  // namespace gambeson
