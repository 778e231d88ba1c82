/// Ten sheets in a stack (cases/library/stack_of_ten.json, stack_mixed.json): at rest each interface carries the weight
/// of the sheets above it, measured from the impulses of the steps, in total, at single samples and in the mean over
/// 3 x 3 cells. Here with coarser sheets, so that it takes seconds.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

struct Stack {
  std::vector<double> carried_N;  ///< by interface k, between sheets k and k + 1, counted from below; 0: the table
  std::vector<double> above_N;    ///< weight of the sheets above it
  std::vector<double> gap_m;      ///< mean distance there at the end
  double sideways_N = 0;          ///< of all interfaces together
  // Relative to the weight above, root mean square of an interface, the worst of all.
  double single = 0;      ///< pressure at single samples of the upper sheet
  double block = 0;       ///< mean pressure over 3 x 3 cells, wherever they lie, of either sheet
  double iterations = 0;  ///< per step
  long unconverged = 0, steps = 0, impact_zones = 0;
  AuditWatch audit;
};

/// sum F / sum (a p) - 1 over the samples of 3 x 3 cells (two samples along a cell), whose border counts half; all
/// places of the block on a sheet.
double blockError(const Surface& surface, int patch, const std::vector<double>& force_Ns, double impulse_per_m2) {
  constexpr int kSpan = 3 * 2;
  const auto [nu, nv] = surface.patch_grid_size[patch];
  double sum2 = 0;
  int count = 0;
  for (int j = 0; j + kSpan < nv; j += 2)
    for (int i = 0; i + kSpan < nu; i += 2, ++count) {
      double force = 0, area = 0;
      for (int y = 0; y <= kSpan; ++y)
        for (int x = 0; x <= kSpan; ++x) {
          const double part = (x % kSpan == 0 ? 0.5 : 1) * (y % kSpan == 0 ? 0.5 : 1);
          const int s = surface.patch_grid[patch][i + x + nu * (j + y)];
          force += part * force_Ns[s];
          area += part * surface.area_m2[s];
        }
      sum2 += std::pow(force / (area * impulse_per_m2) - 1, 2);
    }
  return std::sqrt(sum2 / count);
}

Stack stack(Case c, const std::vector<int>& cells, double end_s, double mean_s) {
  for (std::size_t k = 0; k < c.garments.size(); ++k) {
    auto& sheet = std::get<SheetGarment>(c.garments[k].shape);
    sheet.cells_u = sheet.cells_v = cells[k % cells.size()];
  }
  SceneRun scene(c);
  const Model& m = scene.model;
  const std::vector<int>& garment = m.collisions.cloth.garment;
  const std::size_t count = c.garments.size();
  Stack s;
  s.carried_N.resize(count);
  std::vector<Vec3> sums(count);
  // Normal impulses of each sample from the sheet below it and the sheet above.
  std::vector<double> from_below(m.surface.size()), from_above(m.surface.size());
  bool last = false;
  const auto watch = [&](const State&, const State&, const StepReport& r, const StepResult& w, const Frequency&) {
    s.audit(r);
    ++s.steps;
    s.impact_zones += r.impact_zones;
    s.unconverged += !r.contact.converged;
    s.iterations += r.contact.iterations;
    if (!last) return;
    for (std::size_t i = 0; i < w.rows.size(); ++i) {
      const ContactRow& row = w.rows[i];
      if (row.contact.obstacle >= 0) {
        sums[0] += w.impulses[i];
        from_below[row.contact.sample] += w.impulses[i].z;
        continue;
      }
      // Positive weights are those of one side, on which the impulse acts as it is.
      int side[2] = {-1, -1};
      for (int k = 0; k < row.stencil.count; ++k)
        if (row.stencil.weight[k] != 0) side[row.stencil.weight[k] < 0] = garment[row.stencil.sample[k]];
      ASSERT_EQ(std::abs(side[0] - side[1]), 1) << "contact past a sheet";
      const int upper = std::max(side[0], side[1]);
      sums[static_cast<std::size_t>(upper)] += (side[0] > side[1] ? 1.0 : -1.0) * w.impulses[i];
      for (int k = 0; k < row.stencil.count; ++k) {
        const int sample = row.stencil.sample[k];
        const double part = row.stencil.weight[k] * w.impulses[i].z;
        if (garment[sample] == upper) from_below[sample] += part;
        if (garment[sample] != upper) from_above[sample] -= part;
      }
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
  for (std::size_t k = 0; k < count; ++k) {
    const int sheet = static_cast<int>(k);
    const auto& shape = std::get<SheetGarment>(c.garments[k].shape);
    const double uniform = s.above_N[k] * mean_s / (shape.width_m * shape.height_m);
    double sum2 = 0;
    for (int i : m.surface.patch_grid[sheet]) sum2 += std::pow(from_below[i] / (m.surface.area_m2[i] * uniform) - 1, 2);
    s.single = std::max(s.single, std::sqrt(sum2 / static_cast<double>(m.surface.patch_grid[sheet].size())));
    s.block = std::max(s.block, blockError(m.surface, sheet, from_below, uniform));
    if (k > 0) s.block = std::max(s.block, blockError(m.surface, sheet - 1, from_above, uniform));
  }
  std::vector<Vec3> x(m.surface.size());
  m.surface.WT.multiply<Vec3>(scene.state.p, x);
  std::vector<double> height(count + 1, 0);
  std::vector<int> samples(count + 1, 0);
  for (int i = 0; i < m.surface.size(); ++i) {
    height[static_cast<std::size_t>(garment[i]) + 1] += x[i].z;
    ++samples[static_cast<std::size_t>(garment[i]) + 1];
  }
  for (std::size_t k = 1; k <= count; ++k) height[k] /= samples[k];
  for (std::size_t k = 0; k < count; ++k) s.gap_m.push_back(height[k + 1] - height[k]);
  std::printf("[ measured ] carried over weight above:");
  for (std::size_t k = 0; k < count; ++k) std::printf(" %.5f", s.carried_N[k] / s.above_N[k]);
  std::printf("; gaps [mm]:");
  for (double g : s.gap_m) std::printf(" %.4f", 1e3 * g);
  s.iterations /= static_cast<double>(s.steps);
  std::printf(
      "; single samples %.4f, 3 x 3 cells %.4f (RMS); sideways %.2g of the weight; %ld steps, %.1f iterations each, "
      "%ld unconverged, %ld impact zones, audit %.2g\n",
      s.single, s.block, s.sideways_N / s.above_N[0], s.steps, s.iterations, s.unconverged, s.impact_zones,
      s.audit.worst);
  return s;
}

void expectWeights(const Stack& s) {
  for (std::size_t k = 0; k < s.carried_N.size(); ++k) {
    SCOPED_TRACE("interface " + std::to_string(k));
    EXPECT_NEAR(s.carried_N[k] / s.above_N[k], 1, 0.01);
    EXPECT_NEAR(s.gap_m[k], 1e-3, 0.1e-3);
  }
  EXPECT_LT(s.block, 0.1);
  EXPECT_LT(s.sideways_N / s.above_N[0], 1e-3);
  EXPECT_LT(s.audit.worst, 1e-9);
}

void expectSingleSamples(const Stack& s) {
  expectWeights(s);
  EXPECT_LT(s.single, 0.1);
}

TEST(Stack, EachInterfaceOfIdenticalSheetsCarriesTheWeightAbove) {
  expectSingleSamples(stack(libraryCase("stack_of_ten"), {6}, 0.3, 0.05));
}

TEST(Stack, EachInterfaceOfUnlikeMeshesCarriesTheWeightAbove) {
  expectWeights(stack(libraryCase("stack_mixed"), {6, 8}, 0.3, 0.05));
}

TEST(Stack, LibraryCasesCarryTheWeightAbove) {
  if (!std::getenv("GAMBESON_LONG")) GTEST_SKIP() << "minutes long: set GAMBESON_LONG to run it";
  expectSingleSamples(stack(libraryCase("stack_of_ten"), {18}, 1, 0.2));
  expectWeights(stack(libraryCase("stack_mixed"), {18, 25}, 1, 0.2));
}

}  // namespace
}  // namespace gambeson
