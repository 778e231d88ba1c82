#include "cases/fabric/drape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "cases/fabric/shadow.hpp"
#include "cases/structure/build.hpp"
#include "cases/structure/self_crossings.hpp"
#include "core/error.hpp"
#include "core/statics/newton.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson::laboratory {
namespace {

constexpr double kGravity_m_per_s2 = 9.80665, kUneven = 0.02;
constexpr double kHanging = 1, kEven = 2;  ///< where the programs are: with all of the uneven weight, and without

/// Where the rings of cells begin, as shares of the width: their widths grow fivefold from the support outwards. There
/// cloth without folds turns into cloth with folds, in a seam of some sqrt(radius sqrt(12 B/A)) = 1 to 5 mm (A: of
/// stretch or shear), which wide cells cannot follow: they keep the specimen up.
std::vector<double> ringsOf(int cells) {
  constexpr double kGrowth = 5;
  std::vector<double> knots;
  for (int i = 1; i < cells; ++i) knots.push_back((std::pow(kGrowth, double(i) / cells) - 1) / (kGrowth - 1));
  return knots;
}

StructureCase ringOf(const Fabric& fabric, const Specimen& s, const DrapeTester& tester) {
  StructureCase c;
  c.name = "specimen";
  AnnulusShape ring;
  ring.inner_radius_m = 0.5 * tester.support_m;
  ring.outer_radius_m = 0.5 * tester.specimen_m;
  c.sheet.shape = ring;
  c.sheet.cells_u = 1;
  c.sheet.refine_u = ringsOf(std::max(2, s.cells / 2));
  c.sheet.cells_v = 6 * s.cells / 4 * 4;
  c.sheet.degree = s.degree;
  c.sheet.cloth = s.cloth;
  c.sheet.cloth.rule = CellRule::assumed;  // quadratic cells: the others lock in folds (95 % for 55 %)
  c.material.law = fabric;
  c.programs = {{"weight", {0, 1, 2}, {0, 1, 1}}, {"uneven", {0, 1, 2}, {0, 1, 0}}};
  StructureSupport discs;
  discs.where = EdgeAt{-1, Side::u0};
  discs.hold = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  discs.clamp = true;
  c.supports.push_back(discs);
  StructureLoad weight;
  weight.sort = LoadSort::gravity;
  weight.vector = {0, 0, -kGravity_m_per_s2};
  weight.program = "weight";
  c.loads.push_back(weight);
  return c;
}

/// A smooth pattern around the axis, the same on all meshes: waves 2 to 16, with phases that repeat nowhere. Each start
/// has it turned against the grain, by the golden angle.
double pattern(const Vec3& x, int start) {
  constexpr int kFrom = 2, kTo = 16;
  constexpr double kGolden = 2.399963229728653;
  const double angle = std::atan2(x.y, x.x) + start * kGolden;
  double sum = 0;
  for (int n = kFrom; n <= kTo; ++n) sum += std::cos(n * angle + kGolden * n * n);
  return sum / std::sqrt(kTo - kFrom + 1);
}

/// The forces of one step: g(y, t) + M (y - y0)/s, M the mass [kg], s a time squared.
class Sinking : public Equations {
 public:
  Sinking(StructureSystem& system, const SymmetricMatrix& mass)
      : system_(system), mass_(mass), moved_(static_cast<std::size_t>(system.size())), drag_(moved_.size()) {}

  void begin(const std::vector<double>& from, double t, double s_s2) { from_ = from, t_ = t, s_s2_ = s_s2; }

  double residual(std::span<const double> y, std::span<double> r) override {
    const double force = system_.residual(y, t_, r);
    for (std::size_t i = 0; i < moved_.size(); ++i) moved_[i] = y[i] - from_[i];
    multiply(mass_, moved_, drag_);
    for (std::size_t i = 0; i < moved_.size(); ++i) r[i] += drag_[i] / s_s2_;
    return force;
  }
  void tangent(std::span<const double> y, SymmetricMatrix& K) override {
    system_.stiffness(y, t_, K);
    for (std::size_t i = 0; i < K.values.size(); ++i) K.values[i] += mass_.values[i] / s_s2_;
  }
  void retract(std::span<const double> y, std::span<const double> dy, double s, std::span<double> out) const override {
    system_.retract(y, dy, s, t_, out);
  }

 private:
  StructureSystem& system_;
  const SymmetricMatrix& mass_;
  std::vector<double> from_, moved_, drag_;
  double t_ = 0, s_s2_ = 1;
};

/// Lets the ring sink until it rests; counts the steps.
class Fall {
 public:
  explicit Fall(const Structure& structure)
      : structure_(structure),
        system_(structure, ProgramEnds::extended),
        mass_(system_.sparsity()),
        K_(system_.sparsity()),
        factor_(K_),
        y_(system_.start()) {
    system_.mass(true, mass_);
  }

  /// Steps move points by about `step_m`; at rest they move by no more than `rest_m` in a step that a fall of 100 m
  /// would take. Forces balance within `tolerance`. Returns whether it rests.
  bool sink(double t, double step_m, double rest_m, double tolerance) {
    constexpr int kSteps = 4000;
    constexpr double kLong_s2 = 10;
    Sinking equations(system_, mass_);
    NewtonOptions options;
    options.tolerance = tolerance;
    options.iterations = 20;
    options.descend = true;
    options.length_m = system_.reach();
    double s_s2 = step_m / kGravity_m_per_s2;
    std::vector<Vec3> q = controlPoints(structure_, y_, t, ProgramEnds::extended);
    for (int count = 0; count < kSteps; ++count) {
      equations.begin(y_, t, s_s2);
      std::vector<double> y = y_;
      const NewtonReport report = solveNewton(equations, options, y, K_, factor_);
      double moved = 0;
      std::vector<Vec3> now;
      if (report.converged) {
        now = controlPoints(structure_, y, t, ProgramEnds::extended);
        for (std::size_t i = 0; i < q.size(); ++i) moved = std::max(moved, norm(now[i] - q[i]));
      }
      if (!report.converged || moved > 4 * step_m) {
        s_s2 *= 0.25;
        if (!(s_s2 > 1e-12)) break;
        continue;
      }
      ++steps;
      y_ = std::move(y);
      q = std::move(now);
      system_.commit(y_, t);
      if (s_s2 >= kLong_s2 && moved < rest_m) return true;
      s_s2 = std::min(s_s2 * std::clamp(step_m / std::max(moved, 1e-12), 0.5, 3.0), 1e3 * kLong_s2);
    }
    return false;
  }

  /// Sum of the sizes of all forces that nothing balances [N].
  double unbalanced(double t) {
    std::vector<double> r(y_.size());
    system_.residual(y_, t, r);
    double sum = 0;
    for (const double force : r) sum += std::abs(force);
    return sum;
  }

  const std::vector<double>& state() const { return y_; }
  int steps = 0;

 private:
  const Structure& structure_;
  StructureSystem system_;
  SymmetricMatrix mass_, K_;
  SymmetricFactor factor_;
  std::vector<double> y_;
};

}  // namespace

Draped drape(const Fabric& fabric, const Specimen& specimen, const DrapeTester& tester) {
  constexpr int kRays = 1440, kPerCell = 4;
  constexpr double kFirst = 0.01, kMore = 1.35;
  constexpr double kOnTheWay = 1e-4, kAtRest = 1e-6;  // of forces
  constexpr double kBalanced = 1e-3;                  // of the weight
  constexpr double kNode = 0.05;                      // of the ring's width
  const StructureCase c = ringOf(fabric, specimen, tester);
  const Sheet sheet = sheetOf(c);
  const std::shared_ptr<const Cloth> cloth = clothOf(c, sheet);
  StructureOptions options = optionsOf(c, sheet, *cloth);
  DeadLoad uneven{cloth->mounting().weightForce({0, 0, -kGravity_m_per_s2}), 2};
  for (std::size_t i = 0; i < uneven.force_N.size(); ++i)
    uneven.force_N[i] = kUneven * pattern(cloth->rest()[i], tester.start) * uneven.force_N[i];
  options.dead.push_back(std::move(uneven));
  const std::unique_ptr<Structure> structure = buildStructure(cloth, options);

  Fall fall(*structure);
  const double support_m = 0.5 * tester.support_m, ring_m = 0.5 * tester.specimen_m - support_m, step_m = ring_m / 15;
  const auto hang = [&](double weight) {
    if (!fall.sink(weight, step_m, 0.02 * step_m, kOnTheWay))
      throw RunError(fmt::format(
          "the draped specimen finds no equilibrium under {:.3g} of its weight in {} steps; take more cells, or "
          "another model",
          weight, fall.steps));
  };
  for (double weight = kFirst; weight < kHanging; weight *= kMore) hang(weight);
  hang(kHanging);

  Draped out;
  const bool still = fall.sink(kEven, step_m, 1e-6, kAtRest);
  out.steps = fall.steps;
  out.unbalanced = fall.unbalanced(kEven) /
                   (kGravity_m_per_s2 * fabric.surfaceDensity() * std::numbers::pi * ring_m * (ring_m + 2 * support_m));
  out.at_rest = still && out.unbalanced < kBalanced;
  const PlaceMesh mesh = cloth->placeMesh(kPerCell);
  out.triangles = mesh.triangles;
  const std::vector<Vec3> q = controlPoints(*structure, fall.state(), kEven, ProgramEnds::extended);
  std::vector<Vec3> flat;
  for (std::size_t i = 0; i < mesh.uv.size(); ++i) {
    const PlaceRow row = cloth->mounting().place(mesh.patch[i], mesh.uv[i]);
    Vec3 x{}, X{};
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
      x += row.value[k] * q[static_cast<std::size_t>(row.columns[k])];
      X += row.value[k] * cloth->rest()[static_cast<std::size_t>(row.columns[k])];
    }
    out.points.push_back(x);
    flat.push_back(X);
  }
  const Shadow shadow = shadowOf(out.points, out.triangles, support_m, kRays);
  out.coefficient = shadow.area_m2 / shadowOf(flat, out.triangles, support_m, kRays).area_m2;
  out.nodes = nodesOf(shadow.reach_m, kNode * ring_m);
  for (int k = 0; k < kRays; ++k) {
    const double reach = shadow.reach_m[static_cast<std::size_t>(k)];
    const Vec2 ray = rayAt(k, kRays);
    out.outline.push_back({reach * ray.x, reach * ray.y});
  }
  out.crossings = selfCrossings(out.points, out.triangles);
  return out;
}

}  // namespace gambeson::laboratory
