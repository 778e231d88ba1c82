/// Contact detection of one step: 4,000 samples of a pair of shorts-like tubes, against 20 ellipsoids of a body and
/// against a mesh of 40,960 triangles. The time per step is the time of an iteration; `per_sample` divides it.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>

#include "core/contact/proximity.hpp"
#include "core/contact/scene_check.hpp"

namespace gambeson {
namespace {

struct Scene {
  std::vector<Obstacle> obstacles;
  std::vector<Placement> start, end;
  std::vector<Vec3> x0, x1;
  std::vector<double> reach_m;
};

void add(Scene& s, Shape shape, const Vec3& origin, double tilt_rad) {
  s.obstacles.emplace_back();
  s.obstacles.back().shape = std::move(shape);
  s.start.push_back({rotationAbout({1, 0, 0}, tilt_rad), origin, 1});
  // A step of 0.1 ms at walking speed.
  s.end.push_back({rotationAbout({1, 0, 0}, tilt_rad + 3e-4), origin + Vec3{1.4e-4, 0, 0}, 1});
}

/// Two tubes of 40 x 50 samples around the thighs, wavy, so that some 30 % lie within reach of the skin.
void addSamples(Scene& s, double reach_m) {
  for (double side : {-1.0, 1.0})
    for (int row = 0; row < 40; ++row)
      for (int k = 0; k < 50; ++k) {
        const double a = 2 * M_PI * k / 50, z = 0.56 + 0.26 * row / 39.0;
        const double zeta = (z - 0.72) / 0.25;
        const double skin = 0.085 * std::sqrt(std::max(0.1, 1 - zeta * zeta));
        const double gap = 0.014 + 0.013 * std::sin(3 * a + 9 * z);
        s.x0.push_back({side * 0.1 + (skin + gap) * std::cos(a), (skin + gap) * std::sin(a), z});
        s.x1.push_back(s.x0.back() + Vec3{1.2e-4, 2e-5 * std::sin(5 * a), -1e-4 * std::cos(a)});
        s.reach_m.push_back(reach_m);
      }
}

Scene bodyScene() {
  Scene s;
  const auto ellipsoid = [&](double a, double b, double c, double x, double y, double z, double tilt) {
    add(s, Ellipsoid{{a, b, c}}, {x, y, z}, tilt);
  };
  ellipsoid(0.17, 0.11, 0.12, 0, 0, 0.97, 0);    // pelvis
  ellipsoid(0.15, 0.1, 0.14, 0, 0, 1.14, 0);     // abdomen
  ellipsoid(0.18, 0.12, 0.2, 0, 0, 1.35, 0);     // thorax
  ellipsoid(0.06, 0.06, 0.09, 0, 0, 1.53, 0);    // neck
  ellipsoid(0.08, 0.1, 0.12, 0, 0, 1.68, 0);     // head
  ellipsoid(0.12, 0.1, 0.1, 0, -0.05, 0.92, 0);  // seat
  for (double side : {-1.0, 1.0}) {
    ellipsoid(0.085, 0.085, 0.25, side * 0.1, 0, 0.72, 0);     // thigh
    ellipsoid(0.06, 0.06, 0.22, side * 0.1, 0, 0.3, 0.1);      // shank
    ellipsoid(0.05, 0.13, 0.04, side * 0.1, 0.05, 0.04, 0);    // foot
    ellipsoid(0.05, 0.05, 0.17, side * 0.24, 0, 1.3, 0.1);     // upper arm
    ellipsoid(0.04, 0.04, 0.15, side * 0.27, 0.02, 1.0, 0.3);  // forearm
    ellipsoid(0.04, 0.02, 0.09, side * 0.28, 0.1, 0.8, 0.2);   // hand
    ellipsoid(0.06, 0.06, 0.06, side * 0.1, 0, 0.5, 0);        // knee
  }
  addSamples(s, 0.006);
  return s;
}

/// Both thighs as one closed mesh.
Scene meshScene() {
  TriangleMesh both;
  for (double side : {-1.0, 1.0}) {
    const TriangleMesh thigh = ellipsoidMesh({{0.085, 0.085, 0.25}}, 5);  // 20 * 4^5 triangles
    const int n = static_cast<int>(both.vertices.size());
    for (const Vec3& v : thigh.vertices) both.vertices.push_back(v + Vec3{side * 0.1, 0, 0});
    for (const auto& [a, b, c] : thigh.triangles) both.triangles.push_back({n + a, n + b, n + c});
  }
  Scene s;
  add(s, both, {0, 0, 0.72}, 0);
  addSamples(s, 0.006);
  return s;
}

void near(benchmark::State& state, const Scene& s, int threads) {
  omp_set_num_threads(threads);
  const ProximityQuery query(s.obstacles);
  std::vector<Contact> out;
  for (auto _ : state) {
    query.near(s.start, s.end, s.x0, s.reach_m, out);
    benchmark::DoNotOptimize(out.data());
  }
  std::size_t samples = 0;
  for (std::size_t i = 0; i < out.size(); ++i) samples += i == 0 || out[i].sample != out[i - 1].sample;
  const double n = static_cast<double>(s.x0.size());
  state.counters["near_fraction"] = static_cast<double>(samples) / n;
  state.counters["contacts"] = static_cast<double>(out.size());
  state.counters["per_sample"] =
      benchmark::Counter(n, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void impacts(benchmark::State& state, const Scene& s, int threads) {
  omp_set_num_threads(threads);
  const ProximityQuery query(s.obstacles);
  std::vector<SampleHit> out;
  for (auto _ : state) {
    query.impacts(s.start, s.end, s.x0, s.x1, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["contacts"] = static_cast<double>(out.size());
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(s.x0.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void NearEllipsoids(benchmark::State& st) { near(st, bodyScene(), static_cast<int>(st.range(0))); }
void NearMesh(benchmark::State& st) { near(st, meshScene(), static_cast<int>(st.range(0))); }
void ImpactEllipsoids(benchmark::State& st) { impacts(st, bodyScene(), static_cast<int>(st.range(0))); }

BENCHMARK(NearEllipsoids)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(NearMesh)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(ImpactEllipsoids)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gambeson
