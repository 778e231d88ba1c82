// The element kernels: one law whatever the instruction set and the number of threads.
#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>

#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

double largest(const std::vector<Vec3>& f) {
  double m = 0;
  for (const Vec3& v : f) m = std::max(m, norm(v));
  return m;
}

/// All sets do the same arithmetic in another order of roundings (multiply-add contracted or not).
TEST(Kernel, EveryInstructionSetGivesTheSameForce) {
  ASSERT_STREQ(availableKernels().back()->name, "sse2");  // runs on any x86-64
  for (int p : {1, 2, 3, 4})
    for (bool rational : {false, true})
      for (Bends law : {Bends::linear, Bends::zheng}) {
        Fabric fabric = plainFabric(law);
        fabric.rest_curvature_of_shape = p == 2;
        const Garment g = garmentOf({curvedPatch(p, p, rational)}, {}, fabric, turnedWeft());
        std::vector<Vec3> q = restPoints(g), reference;
        std::mt19937 random(1);
        std::uniform_real_distribution<double> d(-0.05, 0.05);
        for (Vec3& x : q) x += Vec3{d(random), d(random), d(random)};
        double reference_energy = 0;
        for (const KernelSet* kernels : availableKernels()) {
          double energy = 0;
          const std::vector<Vec3> f = forceOn(Shell(g, *kernels), q, &energy);
          if (reference.empty()) reference = f, reference_energy = energy;
          for (std::size_t i = 0; i < f.size(); ++i)
            EXPECT_LE(norm(f[i] - reference[i]), 1e-12 * largest(reference)) << kernels->name;
          EXPECT_NEAR(energy, reference_energy, 1e-12 * reference_energy) << kernels->name;
        }
      }
}

TEST(Kernel, ForceWithAndWithoutEnergyIsTheSame) {
  const Garment g = garmentOf({curvedPatch(2, 3, true)}, {}, plainFabric(Bends::zheng));
  const Shell shell(g, widestKernels());
  std::vector<Vec3> q = restPoints(g);
  q[7].z += 0.1;
  double energy = 0;
  const auto with = forceOn(shell, q, &energy), without = forceOn(shell, q);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_LE(norm(with[i] - without[i]), 1e-13 * largest(with));
}

/// One fabric of several, as the block's own or by point: with numbers of the laws that differ from the garment's.
TEST(Kernel, APatchOfAnotherFabricIsOfThatFabric) {
  Fabric other = plainFabric(Bends::zheng);
  other.young_weft_Pa *= 3;
  other.thickness_m *= 2;
  const NurbsPatch patch = curvedPatch(2, 2, false);
  const Garment alone = garmentOf({patch}, {}, other, turnedWeft());
  Garment chosen = garmentOf({patch}, {}, plainFabric(), turnedWeft());
  chosen.other_fabrics = {other};
  chosen.fields.resize(1);
  chosen.fields[0].material = PatchField{0, 2, 1, {1, 1}};
  Garment by_point = chosen;
  by_point.fields[0].thickness = PatchField{1, 2, 2, {1, 1, 1, 1}};
  EXPECT_EQ(fabricOfPatch(chosen, 0), 1);
  EXPECT_EQ(fabricOfPatch(by_point, 0), std::nullopt);
  std::vector<Vec3> q = controlsOf(buildFreeMap(alone), deformedFree(alone, buildFreeMap(alone), 0.03));
  const auto f = forceOn(Shell(alone, widestKernels()), q), as_chosen = forceOn(Shell(chosen, widestKernels()), q),
             pointwise = forceOn(Shell(by_point, widestKernels()), q);
  const ForceTerms steepest{true, true, true, true};
  const auto steep = forceOn(Shell(alone, widestKernels()), q, nullptr, steepest),
             steep_pointwise = forceOn(Shell(by_point, widestKernels()), q, nullptr, steepest);
  for (std::size_t i = 0; i < q.size(); ++i) {
    EXPECT_EQ(norm(f[i] - as_chosen[i]), 0);
    EXPECT_LE(norm(f[i] - pointwise[i]), 1e-13 * largest(f));
    EXPECT_LE(norm(steep[i] - steep_pointwise[i]), 1e-13 * largest(steep));
  }
}

/// Parts of the force add up, and each can be left out.
TEST(Kernel, TermsAddUp) {
  const Garment g = fourPatches(2, 2, false, SeamKind::C0, 0.7, plainFabric());
  const Shell shell(g, widestKernels());
  std::vector<Vec3> q = controlsOf(buildFreeMap(g), deformedFree(g, buildFreeMap(g), 0.03));
  double all_energy, sum_energy = 0;
  const auto all = forceOn(shell, q, &all_energy);
  std::vector<Vec3> sum(q.size());
  for (int term = 0; term < 3; ++term) {
    double energy;
    const auto f = forceOn(shell, q, &energy, {term == 0, term == 1, term == 2, false});
    EXPECT_GT(energy, 0) << term;
    sum_energy += energy;
    for (std::size_t i = 0; i < f.size(); ++i) sum[i] += f[i];
  }
  EXPECT_NEAR(sum_energy, all_energy, 1e-12 * all_energy);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_LE(norm(sum[i] - all[i]), 1e-12 * largest(all));
}

/// Patches of different degrees, hinges over the threshold of the parallel loop, more groups than threads share evenly.
TEST(Kernel, TheSameBitsForOneAndTwoThreads) {
  const auto wave = [](double a, double b) { return Vec3{a, b, 0.1 * std::sin(5 * a) * b}; };
  const NurbsPatch left = patchOf(uniformKnots(2, 19), uniformKnots(2, 21), wave);
  NurbsPatch right =
      patchOf(uniformKnots(3, 13), uniformKnots(2, 21), [&](double a, double b) { return wave(1 + a, b); });
  const Garment g =
      garmentOf({left, right}, {{{0, Side::u1}, {1, Side::u0}, SeamKind::C0, 0.5}}, plainFabric(Bends::zheng));
  std::vector<Vec3> q = restPoints(g);
  for (std::size_t i = 0; i < q.size(); ++i) q[i].z += 0.01 * std::sin(37.0 * static_cast<double>(i));
  const int threads = omp_get_max_threads();
  for (const KernelSet* kernels : availableKernels()) {
    const Shell shell(g, *kernels);
    double energy[2];
    std::vector<Vec3> f[2];
    for (int n : {1, 2}) {
      omp_set_num_threads(n);
      f[n - 1] = forceOn(shell, q, &energy[n - 1]);
    }
    EXPECT_EQ(std::memcmp(&energy[0], &energy[1], sizeof(double)), 0);
    EXPECT_EQ(std::memcmp(f[0].data(), f[1].data(), f[0].size() * sizeof(Vec3)), 0);
  }
  omp_set_num_threads(threads);
}

}  // namespace
}  // namespace gambeson
