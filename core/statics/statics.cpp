#include "core/statics/statics.hpp"

#include "core/statics/path.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {

StaticReport solveStatic(const Structure& structure, const StaticOptions& options, const StaticObserver& observe,
                         std::vector<double> start) {
  refuseProjectedSeams(structure);
  StructureSystem system(structure, ProgramEnds::extended);
  StaticReport report = followPath(system, options, observe, std::move(start));
  report.unanswered = system.unanswered();
  report.unanswered_tries = system.unansweredTries();
  if (report.no_start && structure.cloth->springsAtRest(system.length()))
    report.why +=
        "; likeliest cause: the sheet is curved, and its fabric has no moment when it is flat (bending rest: zero), so "
        "that it springs open without any load: let it count bending from its shape (rest: shape), or let a dynamic "
        "case with damping find where it comes to rest";
  return report;
}

std::vector<Vec3> controlPoints(const Structure& s, std::span<const double> y, double t, ProgramEnds ends) {
  const std::vector<double> u = freeDisplacements(s, y, programValues(s, t, ends));
  std::vector<Vec3> q(s.cloth->rest().size());
  s.cloth->map().T.multiply<Vec3>({reinterpret_cast<const Vec3*>(u.data()), s.cloth->map().home.size()}, q);
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += s.cloth->rest()[i];
  return q;
}

std::vector<Vec3> reactions(const Structure& s, std::span<const double> y, double t, ProgramEnds ends,
                            std::span<const double> history) {
  return reactions(s, {controlPoints(s, y, t, ends), innerValues(s, y, t, ends), history}, t, ends);
}

std::vector<double> innerValues(const Structure& s, std::span<const double> y, double t, ProgramEnds ends) {
  return innerValues(s, y, programValues(s, t, ends));
}

std::vector<Vec3> reactions(const Structure& s, const ClothState& state, double t, ProgramEnds ends) {
  std::vector<Vec3> f(state.q.size()), external(f.size());
  ClothWork work;
  s.cloth->force(state, {f, {}, {}, nullptr}, work);
  s.loads.add(state.q, programValues(s, t, ends), external);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = -(f[i] + external[i]);
  return f;
}

double strainEnergy(const Structure& s, std::span<const double> y, double t, ProgramEnds ends,
                    std::span<const double> history) {
  return strainEnergy(s, {controlPoints(s, y, t, ends), innerValues(s, y, t, ends), history});
}

double strainEnergy(const Structure& s, const ClothState& state) {
  std::vector<Vec3> f(state.q.size());
  ClothWork work;
  ClothEnergy energy;
  s.cloth->force(state, {f, {}, {}, &energy}, work);
  return energy.stored;
}

}  // namespace gambeson
