/// Ten sheets in a stack (cases/library/stack_of_ten.json, stack_mixed.json): at rest each interface carries the weight
/// of the sheets above it, measured from the impulses of the steps. Here with coarser sheets, so that it takes seconds.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "scene.hpp"

namespace gambeson {
namespace {

struct Stack {
  std::vector<double> carried_N;  ///< by interface k, between sheets k and k + 1, counted from below; 0: the table
  std::vector<double> above_N;    ///< weight of the sheets above it
  std::vector<double> gap_m;      ///< mean distance there at the end
  double sideways_N = 0;          ///< of all interfaces together
  long unconverged = 0, steps = 0, zones = 0;
  AuditWatch audit;
};

Stack stack(Case c, const std::vector<int>& cells, double end_s, double mean_s) {
  for (std::size_t k = 0; k < c.garments.size(); ++k) {
    auto& sheet = std::get<SheetGarment>(c.garments[k].shape);
    sheet.cells_u = sheet.cells_v = cells[k % cells.size()];
  }
  SceneRun scene(c);
  const Model& m = scene.model;
  const std::vector<int>& layer = m.collisions.cloth.layer;
  const std::size_t count = c.garments.size();
  Stack s;
  s.carried_N.resize(count);
  std::vector<Vec3> sums(count);
  bool last = false;
  const auto watch = [&](const State&, const State&, const StepReport& r, const StepWork& w, const Frequency&) {
    s.audit(r);
    ++s.steps;
    s.zones += r.zones;
    s.unconverged += !r.contact.converged;
    if (!last) return;
    for (std::size_t i = 0; i < w.rows.size(); ++i) {
      const ContactRow& row = w.rows[i];
      if (row.contact.obstacle >= 0) {
        sums[0] += w.impulses[i];
        continue;
      }
      // Positive weights are those of one side, on which the impulse acts as it is.
      int side[2] = {-1, -1};
      for (int k = 0; k < row.stencil.count; ++k)
        if (row.stencil.weight[k] != 0) side[row.stencil.weight[k] < 0] = layer[row.stencil.sample[k]];
      ASSERT_EQ(std::abs(side[0] - side[1]), 1) << "contact past a sheet";
      sums[static_cast<std::size_t>(std::max(side[0], side[1]))] += (side[0] > side[1] ? 1.0 : -1.0) * w.impulses[i];
    }
  };
  scene.run(end_s - mean_s, watch);
  last = true;
  scene.run(end_s, watch);
  double above = 0;
  s.above_N.resize(count);
  for (std::size_t k = count; k-- > 0;) {
    const auto& sheet = std::get<SheetGarment>(c.garments[k].shape);
    above += fabricOf(c, c.garments[k]).surfaceDensity() * sheet.width_m * sheet.height_m * norm(c.gravity_m_per_s2);
    s.above_N[k] = above;
    s.carried_N[k] = sums[k].z / mean_s;
    s.sideways_N = std::max(s.sideways_N, std::hypot(sums[k].x, sums[k].y) / mean_s);
  }
  std::vector<Vec3> x(m.surface.size());
  m.surface.WT.multiply<Vec3>(scene.state.p, x);
  std::vector<double> height(count + 1, 0);
  std::vector<int> samples(count + 1, 0);
  for (int i = 0; i < m.surface.size(); ++i) {
    height[static_cast<std::size_t>(layer[i]) + 1] += x[i].z;
    ++samples[static_cast<std::size_t>(layer[i]) + 1];
  }
  for (std::size_t k = 1; k <= count; ++k) height[k] /= samples[k];
  for (std::size_t k = 0; k < count; ++k) s.gap_m.push_back(height[k + 1] - height[k]);
  std::printf("[ measured ] carried over weight above:");
  for (std::size_t k = 0; k < count; ++k) std::printf(" %.5f", s.carried_N[k] / s.above_N[k]);
  std::printf("; gaps [mm]:");
  for (double g : s.gap_m) std::printf(" %.4f", 1e3 * g);
  std::printf("; sideways %.2g of the weight; %ld steps, %ld unconverged, %ld zones, audit %.2g\n",
              s.sideways_N / s.above_N[0], s.steps, s.unconverged, s.zones, s.audit.worst);
  return s;
}

void expectWeights(const Stack& s) {
  for (std::size_t k = 0; k < s.carried_N.size(); ++k) {
    SCOPED_TRACE("interface " + std::to_string(k));
    EXPECT_NEAR(s.carried_N[k] / s.above_N[k], 1, 0.01);
    EXPECT_NEAR(s.gap_m[k], 1e-3, 0.1e-3);
  }
  EXPECT_LT(s.sideways_N / s.above_N[0], 1e-3);
  EXPECT_LT(s.audit.worst, 1e-9);
}

TEST(Stack, EachInterfaceOfIdenticalSheetsCarriesTheWeightAbove) {
  expectWeights(stack(libraryCase("stack_of_ten"), {4}, 0.3, 0.05));
}

TEST(Stack, EachInterfaceOfUnlikeMeshesCarriesTheWeightAbove) {
  expectWeights(stack(libraryCase("stack_mixed"), {4, 5}, 0.3, 0.05));
}

TEST(Stack, LibraryCasesCarryTheWeightAbove) {
  if (!std::getenv("GAMBESON_LONG")) GTEST_SKIP() << "minutes long: set GAMBESON_LONG to run it";
  expectWeights(stack(libraryCase("stack_of_ten"), {18}, 1, 0.2));
  expectWeights(stack(libraryCase("stack_mixed"), {18, 25}, 1, 0.2));
}

}  // namespace
}  // namespace gambeson
