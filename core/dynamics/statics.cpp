#include "core/dynamics/statics.hpp"

#include "core/dynamics/path.hpp"
#include "core/dynamics/structure_system.hpp"

namespace gambeson {

StaticReport solveStatic(const Structure& structure, const StaticOptions& options, const StaticObserver& observe,
                         std::vector<double> start) {
  refuseLimit(structure);
  StructureSystem system(structure, ProgramEnds::extended);
  return followPath(system, options, observe, std::move(start));
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
