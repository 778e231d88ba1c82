#include "cases/fabric/laboratory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "cases/fabric/bench.hpp"
#include "core/error.hpp"

namespace gambeson::laboratory {
namespace {

constexpr double kBendingLength_m = 0.01, kShearLength_m = 0.05, kTension_N_per_m = 9.80665;

/// Reads the curvature of the middle of a specimen: how far the chords over two cells turn between one cell from
/// either clamp. Exact where it is bent to a circle, by a smooth surface or by facets.
class CurvatureGauge {
 public:
  CurvatureGauge(const Cloth& cloth, int cells, double length_m) : length_m_(length_m * (cells - 2) / cells) {
    for (const int at : {0, 2, cells - 2, cells}) places_.emplace_back(cloth, static_cast<double>(at) / cells);
  }
  double operator()(const std::vector<Vec3>& q) {
    std::vector<Vec3> x;
    for (const PlaceGauge& place : places_) x.push_back(place(q));
    const Vec3 a = x[1] - x[0], b = x[3] - x[2];
    return std::atan2(a.z * b.x - a.x * b.z, a.x * b.x + a.z * b.z) / length_m_;
  }

 private:
  std::vector<PlaceGauge> places_;
  double length_m_;
};

/// Turns the moment until the gauge shows the curvature: secants, held between bounds once these are known.
class Turner {
 public:
  Turner(Bench& bench, CurvatureGauge gauge, double steepest_Nm)
      : bench_(bench), gauge_(std::move(gauge)), steepest_Nm_(steepest_Nm), slope_Nm_(steepest_Nm) {}

  void turnTo(double target) {
    constexpr int kTrials = 40;
    constexpr double kTolerance = 1e-6;  // of the step
    const double from_m = bench_.load(), from_k = reached_, way = target > from_k ? 1 : -1;
    if (way * way_ < 0) slope_Nm_ = steepest_Nm_;  // behind a turn all stops hold
    way_ = way;
    const double close = kTolerance * std::abs(target - from_k) + 1e-12 * std::abs(target);
    struct Point {
      double m, k;
    };
    std::optional<Point> below, above;
    Point at{from_m, from_k};
    double slope = slope_Nm_;
    for (int trial = 0; trial < kTrials; ++trial) {
      double m = at.m + slope * (target - at.k);
      if (below && above && !((m - below->m) * (m - above->m) < 0)) m = 0.5 * (below->m + above->m);
      bench_.settle(m);
      const Point now{m, gauge_(bench_.points())};
      if (std::abs(now.k - target) <= close) {
        slope_Nm_ = (m - from_m) / (now.k - from_k);
        reached_ = now.k;
        return;
      }
      (now.k < target ? below : above) = now;
      if (below && above)
        slope = (above->m - below->m) / (above->k - below->k);
      else if (const double secant = (now.m - at.m) / (now.k - at.k); secant > 0 && std::isfinite(secant))
        slope = std::min(secant, steepest_Nm_);
      at = now;
    }
    throw RunError(fmt::format("the specimen is not bent to {:.6g} 1/m: it stays at {:.6g} 1/m after {} trials", target,
                               at.k, kTrials));
  }

 private:
  Bench& bench_;
  CurvatureGauge gauge_;
  double steepest_Nm_, slope_Nm_;
  double reached_ = 0, way_ = 1;
};

/// The steepest slope of a fabric's law of bending.
double steepestOf(const Fabric& fabric) {
  return std::visit(
      []<class L>(const L& law) {
        if constexpr (L::is_solid)
          return 1e-5;
        else
          return steepestSlope(law, std::max(law.most_Nm(), 1e-12));
      },
      fabric.law);
}

/// KES-FB2 leads its clamp so that the arc between the clamps keeps its length; here the clamp is free of force, and of
/// a free shell the moment shortens the arc, as curvatures of a shell are per length at rest:
///   E = -B k^2/A,   M = B k (1 + 2 E),
/// 1e-5 of woven cloth at 2.5/cm, but 8 % of a soft knit, whose M/k would be lower by twice that. So the membrane is
/// stiffened until E is within kShortening. Laws that are an energy have no membrane of their own: they stay.
Fabric heldInLength(Fabric fabric, double rigidity_Nm, double curvature_per_m) {
  constexpr double kShortening = 1e-3;
  if (fabric.energy) return fabric;
  const double soft = std::min(fabric.young_weft_Pa, fabric.young_warp_Pa) * fabric.thickness(),
               wanted = rigidity_Nm * curvature_per_m * curvature_per_m / kShortening;
  if (!(soft < wanted)) return fabric;
  fabric.young_weft_Pa *= wanted / soft;
  fabric.young_warp_Pa *= wanted / soft;
  fabric.shear_Pa *= wanted / soft;
  return fabric;
}

}  // namespace

std::vector<double> Course::values() const {
  std::vector<double> all;
  double from = 0;
  for (const double to : turns) {
    const double way = to > from ? 1 : -1;
    std::vector<double> leg;
    // On multiples of the step, so that both ways meet the same places.
    for (double n = std::ceil(std::min(from, to) / step - 1e-9); n * step < std::max(from, to) + 1e-9 * step; ++n)
      leg.push_back(n * step);
    leg.insert(leg.end(), also.begin(), also.end());
    leg.push_back(to);
    std::sort(leg.begin(), leg.end(), [&](double a, double b) { return way * a < way * b; });
    double last = from;
    for (const double v : leg) {
      if (!(way * (v - last) > 1e-9 * step) || way * (v - to) > 1e-9 * step) continue;
      all.push_back(v);
      last = v;
    }
    all.back() = to;
    from = to;
  }
  return all;
}

Loop bend(const Fabric& fabric, const Specimen& specimen, const Course& curvature_per_m) {
  const std::vector<double> values = curvature_per_m.values();
  double most = 0;
  for (const double k : values) most = std::max(most, std::abs(k));
  const double steepest_Nm = steepestOf(fabric);
  StructureCase c = caseOf(heldInLength(fabric, steepest_Nm, most), specimen, kBendingLength_m);
  c.supports.back().clamp = true;
  StructureLoad moment;
  moment.sort = LoadSort::moment_per_length;
  moment.where = EdgeAt{-1, Side::u1};
  moment.amount = 1;  // upwards
  c.loads.push_back(moment);
  Bench bench(c, ProgramEnds::extended, [](const Cloth& cloth, Constraints& constraints) {
    tieAcross(cloth, {1, 0, 0}, constraints);
    tieAcross(cloth, {0, 1, 0}, constraints);
    tieAcross(cloth, {0, 0, 1}, constraints);
  });
  Turner turner(bench, CurvatureGauge(*bench.structure().cloth, specimen.cells, kBendingLength_m), steepest_Nm);
  Loop loop{{0, 0, 0}};
  for (const double target : values) {
    turner.turnTo(target);
    bench.accept();
    loop.push_back({target, bench.load(), bench.lost_J_per_m2()});
  }
  return loop;
}

Loop shear(const Fabric& fabric, const Specimen& specimen, const Course& angle_rad) {
  StructureCase c = caseOf(fabric, specimen, kShearLength_m);
  const std::vector<double> values = angle_rad.values();
  NamedProgram tension{"tension", {0, 1}, {0, 1}}, sideways{"sideways", {0, 1}, {0, 0}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    sideways.at.push_back(2 + static_cast<double>(i));
    sideways.value.push_back(std::tan(values[i]));
  }
  c.programs = {tension, sideways};
  StructureSupport moving;
  moving.where = EdgeAt{-1, Side::u1};
  moving.hold = {{0, 1, 0}};
  moving.move_m = Vec3{0, kShearLength_m, 0};
  moving.program = "sideways";
  c.supports.push_back(moving);
  StructureLoad pull;
  pull.sort = LoadSort::force_per_length;
  pull.where = EdgeAt{-1, Side::u1};
  pull.vector = {kTension_N_per_m, 0, 0};
  pull.program = "tension";
  c.loads.push_back(pull);
  Bench bench(c, ProgramEnds::constant, [](const Cloth& cloth, Constraints& constraints) {
    keepFrom(cloth, {0, 0, 1}, constraints);
    tieAcross(cloth, {1, 0, 0}, constraints);
    tieAcross(cloth, {0, 1, 0}, constraints);
  });
  const Cloth& cloth = *bench.structure().cloth;
  const std::vector<int> clamped = cloth.mounting().edgePoints({0, Side::u1});
  const double width_m = cloth.mounting().edgeLength({0, Side::u1});
  const PlaceGauge still(cloth, 0), led(cloth, 1);
  bench.settle(1);
  bench.accept();
  Loop loop{{0, 0, bench.lost_J_per_m2()}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    bench.settle(2 + static_cast<double>(i));
    bench.accept();
    const std::vector<Vec3> force = bench.reactionForces();
    double sideways_N = 0;
    for (const int p : clamped) sideways_N += force[static_cast<std::size_t>(p)].y;
    // The tension pulls along the specimen, which it has made longer: soft knits by a fifth.
    const std::vector<Vec3> q = bench.points();
    const Vec3 along = led(q) - still(q);
    loop.push_back({values[i], sideways_N / width_m - kTension_N_per_m * along.y / along.x, bench.lost_J_per_m2()});
  }
  return loop;
}

double loadAt(const Loop& loop, int leg, double at) {
  int now = -1;
  double way = 0;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    const double step = loop[i].at - loop[i - 1].at;
    if (step * way <= 0) ++now;
    way = step;
    if (now != leg || (loop[i].at - at) * (loop[i - 1].at - at) > 0) continue;
    return loop[i - 1].load + (loop[i].load - loop[i - 1].load) * (at - loop[i - 1].at) / step;
  }
  throw RunError(fmt::format("the loop does not pass {:.4g} on its way {}", at, leg + 1));
}

double slopeBetween(const Loop& loop, double from, double to) {
  const double up = loadAt(loop, 2, to) - loadAt(loop, 2, from), down = loadAt(loop, 1, -from) - loadAt(loop, 1, -to);
  return 0.5 * (up + down) / (to - from);
}

double widthAt(const Loop& loop, double at) {
  return 0.5 * (loadAt(loop, 2, at) - loadAt(loop, 1, at) + loadAt(loop, 2, -at) - loadAt(loop, 1, -at));
}

}  // namespace gambeson::laboratory
