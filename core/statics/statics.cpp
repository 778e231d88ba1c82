#include "core/statics/statics.hpp"

#include <algorithm>
#include <cmath>

#include "core/statics/path.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {

namespace {

/// Whether a fabric without moment when flat is bent at rest: its moments are unbalanced from the start.
bool springsAtRest(const Structure& s) {
  const Garment& g = s.shell.garment();
  if (hasRestCurvature(g.fabric)) return false;
  const double size = StructureSystem(s, ProgramEnds::extended).length();
  for (int p = 0; p < static_cast<int>(g.patches.size()); ++p)
    for (double u : grevillePoints(g.patches[p].u))
      for (double v : grevillePoints(g.patches[p].v)) {
        const Vec3 k = s.shell.curvatureAt(p, {u, v}, s.rest);
        if (std::max({std::abs(k.x), std::abs(k.y), std::abs(k.z)}) * size > 1e-6) return true;
      }
  return false;
}

}  // namespace

StaticReport solveStatic(const Structure& structure, const StaticOptions& options, const StaticObserver& observe,
                         std::vector<double> start) {
  refuseLimit(structure);
  StructureSystem system(structure, ProgramEnds::extended);
  StaticReport report = followPath(system, options, observe, std::move(start));
  if (report.no_start && springsAtRest(structure))
    report.why +=
        "; likeliest cause: the sheet is curved, and its fabric has no moment when it is flat (bending rest: zero), so "
        "that it springs open without any load: let it count bending from its shape (rest: shape), or let a dynamic "
        "case with damping find where it comes to rest";
  return report;
}

std::vector<Vec3> controlPoints(const Structure& s, std::span<const double> y, double t, ProgramEnds ends) {
  const std::vector<double> u = freeDisplacements(s, y, programValues(s, t, ends));
  std::vector<Vec3> q(s.rest.size());
  s.map.T.multiply<Vec3>({reinterpret_cast<const Vec3*>(u.data()), u.size() / 3}, q);
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += s.rest[i];
  return q;
}

std::vector<Vec3> reactions(const Structure& s, std::span<const double> y, double t, ProgramEnds ends) {
  const std::vector<Vec3> q = controlPoints(s, y, t, ends);
  std::vector<Vec3> f(q.size()), external(q.size());
  ShellWork work;
  s.shell.force(q, f, work);
  s.loads.add(q, programValues(s, t, ends), external);
  for (std::size_t i = 0; i < q.size(); ++i) f[i] = -(f[i] + external[i]);
  return f;
}

double strainEnergy(const Structure& s, std::span<const double> y, double t, ProgramEnds ends) {
  const std::vector<Vec3> q = controlPoints(s, y, t, ends);
  std::vector<Vec3> f(q.size());
  ShellWork work;
  double energy = 0;
  s.shell.force(q, f, work, &energy);
  return energy;
}

}  // namespace gambeson
