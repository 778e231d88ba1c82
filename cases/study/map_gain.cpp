/// Detail of optimise.hpp: what a map is worth.

#include <algorithm>
#include <cmath>

#include "cases/study/optimise.hpp"

namespace gambeson::study {
namespace {

/// 1 - best / start.
double torqueGain(const MapRun& start, const MapRun& best) { return 1 - best.torque_Nm / start.torque_Nm; }

/// What moves from pair to pair.
double numberOf(Aim aim, const MapRun& start, const MapRun& best, double reference_Nm) {
  return aim == Aim::torque ? torqueGain(start, best) : best.torque_Nm / reference_Nm;
}

}  // namespace

std::vector<const MapRegion*> Optimise::free() const {
  std::vector<const MapRegion*> all;
  for (const MapRegion& r : regions)
    if (!r.kept) all.push_back(&r);
  return all;
}

MapGain gainOf(const Optimise& o) {
  const FoundMap& f = o.found;
  const double reference_Nm = f.found().torque_Nm;
  const double here = numberOf(o.aim, f.start(), f.found(), reference_Nm);
  MapGain g;
  g.gain = o.aim == Aim::torque ? here : 1 - f.found().mass_kg / f.start().mass_kg;
  for (const MapPair& p : f.repeats)
    g.scattered = g.scattered || p.start.torque_Nm != f.start().torque_Nm || p.best.torque_Nm != f.found().torque_Nm;
  for (const MapPair& p : f.repeats)
    g.noise = std::max(g.noise, std::abs(numberOf(o.aim, p.start, p.best, reference_Nm) - here));
  if (f.finer) {
    g.mesh = std::abs(numberOf(o.aim, f.finer->start, f.finer->best, reference_Nm) - here);
    g.finer = o.aim == Aim::torque ? torqueGain(f.finer->start, f.finer->best) : f.finer->best.torque_Nm;
  }
  if (o.aim == Aim::torque)
    g.sure = f.best > 0 && g.scattered && g.gain > g.bar() && (!g.finer || *g.finer > g.noise);
  else
    g.sure = g.scattered && f.found().torque_Nm * (1 + g.bar()) <= o.limit_Nm;
  // The first run that no later one is better than by more than the noise.
  const double best_Nm = f.found().torque_Nm, scatter_Nm = g.noise * f.start().torque_Nm;
  const auto good = [&](const MapRun& r) {
    return o.aim == Aim::torque ? r.torque_Nm <= best_Nm + scatter_Nm
                                : r.torque_Nm <= o.limit_Nm && r.mass_kg <= f.found().mass_kg * (1 + 1e-3);
  };
  g.helps_until = f.best;
  for (std::size_t i = 0; i < f.best; ++i)
    if (good(f.runs[i])) {
      g.helps_until = i;
      break;
    }
  return g;
}

}  // namespace gambeson::study
