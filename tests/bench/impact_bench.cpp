/// The certified impact test: time per query. Early: swept boxes overlap, decided without nearest points where cloth
/// lies on cloth. Hard: queries that meet, or pass within a hair.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "core/contact/certified_impact.hpp"

namespace gambeson {
namespace {

struct Pair {
  FourPoints x0, x1;
};

/// Candidates between two sheets of cells of 1 cm, 1 mm apart and wavy, in a step of 0.1 ms at walking speed;
/// `closing_m` is how far they come towards each other.
std::vector<Pair> sheets(bool edges, double closing_m) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Pair> pairs(4096);
  for (auto& [x0, x1] : pairs) {
    const double h = 0.01;
    const Vec3 at{u(rng), u(rng), 0}, on{at.x + h * (u(rng) - 0.3), at.y + h * (u(rng) - 0.3), 0.001};
    x0 = {on, at, at + Vec3{h, 0, 0}, at + Vec3{0, h, 0}};
    if (edges) x0 = {on, on + Vec3{h, 0.3 * h, 0}, at, at + Vec3{0, h, 0}};
    const Mat3 R = rotationAbout(normalized({u(rng) - 0.5, u(rng) - 0.5, u(rng) - 0.5}), 6 * u(rng));
    const Vec3 drift{1.4e-4 * u(rng), 1e-4 * u(rng), 1e-4 * u(rng)};
    for (int i = 0; i < 4; ++i) {
      const bool upper = edges ? i < 2 : i < 1;
      x0[i].z += 2e-4 * (u(rng) - 0.5);
      const Vec3 move = drift + Vec3{0, 0, upper ? -closing_m : 0.0} + 2e-5 * Vec3{u(rng), u(rng), u(rng)};
      x1[i] = R * (x0[i] + move);
      x0[i] = R * x0[i];
    }
  }
  return pairs;
}

void query(benchmark::State& state, bool edges, double closing_m) {
  const std::vector<Pair> pairs = sheets(edges, closing_m);
  long hits = 0, queries = 0;
  for (auto _ : state) {
    hits = 0;
    for (const auto& [x0, x1] : pairs) {
      const auto hit = edges ? edgeEdgeImpact(x0, x1, 1e-6) : pointTriangleImpact(x0, x1, 1e-6);
      hits += hit.has_value();
    }
    queries += static_cast<long>(pairs.size());
    benchmark::DoNotOptimize(hits);
  }
  state.counters["hit_fraction"] = static_cast<double>(hits) / static_cast<double>(pairs.size());
  state.counters["per_query"] =
      benchmark::Counter(static_cast<double>(queries), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void ImpactEarlyPointTriangle(benchmark::State& st) { query(st, false, 1e-5); }
void ImpactEarlyEdgeEdge(benchmark::State& st) { query(st, true, 1e-5); }
void ImpactHardPointTriangle(benchmark::State& st) { query(st, false, 2e-3); }
void ImpactHardEdgeEdge(benchmark::State& st) { query(st, true, 2e-3); }

BENCHMARK(ImpactEarlyPointTriangle)->Unit(benchmark::kMicrosecond);
BENCHMARK(ImpactEarlyEdgeEdge)->Unit(benchmark::kMicrosecond);
BENCHMARK(ImpactHardPointTriangle)->Unit(benchmark::kMicrosecond);
BENCHMARK(ImpactHardEdgeEdge)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gambeson
