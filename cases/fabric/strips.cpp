#include "cases/fabric/strips.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "cases/fabric/bench.hpp"
#include "core/error.hpp"

namespace gambeson::laboratory {
namespace {

constexpr double kPulledLength_m = 0.05, kGravity_m_per_s2 = 9.80665;

Loop pulled(const Fabric& fabric, const Specimen& specimen, const Course& strain, bool free_sides) {
  StructureCase c = caseOf(fabric, specimen, kPulledLength_m);
  const std::vector<double> values = strain.values();
  NamedProgram way{"way", {0}, {0}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    way.at.push_back(1 + static_cast<double>(i));
    way.value.push_back(values[i]);
  }
  c.programs = {way};
  c.supports.back().hold = {{1, 0, 0}};  // the rest is said below
  StructureSupport moving;
  moving.where = EdgeAt{-1, Side::u1};
  moving.hold = {{1, 0, 0}};
  moving.move_m = Vec3{kPulledLength_m, 0, 0};
  moving.program = "way";
  c.supports.push_back(moving);
  Bench bench(c, ProgramEnds::constant, [&](const Cloth& cloth, Constraints& constraints) {
    keepFrom(cloth, {0, 0, 1}, constraints);
    if (!free_sides) {
      keepFrom(cloth, {0, 1, 0}, constraints);
      return;
    }
    LinearConstraint still = supportEquation("the side", {0, 1, 0}, {});
    still.terms = {{cloth.mounting().edgePoints({0, Side::u0}).front(), Vec3{0, 1, 0}}};
    constraints.push_back(std::move(still));
    tieAcross(cloth, {1, 0, 0}, constraints);
  });
  const Cloth& cloth = *bench.structure().cloth;
  const std::vector<int> clamped = cloth.mounting().edgePoints({0, Side::u1});
  const double width_m = cloth.mounting().edgeLength({0, Side::u1});
  Loop loop{{0, 0, 0}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    bench.settle(1 + static_cast<double>(i));
    bench.accept();
    const std::vector<Vec3> force = bench.reactionForces();
    double pull_N = 0;
    for (const int p : clamped) pull_N += force[static_cast<std::size_t>(p)].x;
    loop.push_back({values[i], pull_N / width_m, bench.lost_J_per_m2()});
  }
  return loop;
}

/// The slope of the chord of an overhang, and its shape.
std::pair<double, std::vector<Vec3>> overhang(const Fabric& fabric, const Specimen& specimen, double length_m) {
  constexpr int kSteps = 8, kShape = 50;
  StructureCase c = caseOf(fabric, specimen, length_m);
  c.supports.back().clamp = true;
  StructureLoad weight;
  weight.sort = LoadSort::gravity;
  weight.vector = {0, 0, -kGravity_m_per_s2};
  c.loads.push_back(weight);
  Bench bench(c, ProgramEnds::extended, [](const Cloth& cloth, Constraints& constraints) {
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
      tieAcross(cloth, direction, constraints);
  });
  for (int i = 1; i <= kSteps; ++i) {
    bench.settle(static_cast<double>(i) / kSteps);
    bench.accept();
  }
  const std::vector<Vec3> q = bench.points();
  std::vector<Vec3> shape;
  for (int i = 0; i <= kShape; ++i)
    shape.push_back(PlaceGauge(*bench.structure().cloth, static_cast<double>(i) / kShape)(q));
  const Vec3 chord = shape.back() - shape.front();
  return {std::atan2(-chord.z, chord.x), std::move(shape)};
}

}  // namespace

Loop pull(const Fabric& fabric, const Specimen& specimen, const Course& strain) {
  return pulled(fabric, specimen, strain, false);
}
Loop pullFree(const Fabric& fabric, const Specimen& specimen, const Course& strain) {
  return pulled(fabric, specimen, strain, true);
}

Droop droop(const Fabric& fabric, const Specimen& specimen, double expected_m) {
  constexpr int kTrials = 40;
  constexpr double kTolerance_rad = 1e-6;
  double low = 0.2 * expected_m, high = 20 * expected_m;  // overhangs, twice the lengths
  double length = 2 * expected_m;
  std::optional<std::pair<double, double>> before;  // length and what its slope misses
  for (int trial = 0; trial < kTrials; ++trial) {
    auto [slope, shape] = overhang(fabric, specimen, length);
    const double missed = slope - kDroop_rad;
    if (std::abs(missed) < kTolerance_rad) return {0.5 * length, std::move(shape)};
    (missed > 0 ? high : low) = length;
    double next = before ? length - missed * (length - before->first) / (missed - before->second)
                         : length * std::cbrt(std::tan(kDroop_rad) / std::tan(std::min(slope, 1.5)));
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    before = {length, missed};
    length = next;
  }
  throw RunError(
      fmt::format("no overhang from {:.4g} to {:.4g} m droops by 41.5 degrees", 0.2 * expected_m, 20 * expected_m));
}

}  // namespace gambeson::laboratory
