#include "core/statics/structure.hpp"

#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace gambeson {

double Structure::innerDrag() const {
  return drag_kg_per_m2s * std::accumulate(area_m2.begin(), area_m2.end(), 0.0) /
         std::accumulate(lumped_kg.begin(), lumped_kg.end(), 0.0);
}

DofMap dofsOf(const Cloth& cloth, std::span<const LinearConstraint> constraints, int programs) {
  std::vector<double> length(cloth.innerRates());
  cloth.innerMasses(length);
  double mean = 0;
  if (!length.empty())
    for (const double m : cloth.masses()) mean += m / cloth.map().T.column_count;
  for (double& l : length) l = std::sqrt(l / mean);
  if (cloth.turnsInner()) {
    const std::vector<double> areas = cloth.areas();
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0) / cloth.map().T.column_count;
    length.assign(length.size(), std::sqrt(area));
  }
  return buildDofMap(cloth.map(), constraints, programs, length);
}

void refuseProjectedSeams(const Structure& structure) {
  if (structure.cloth->sewnRows().empty()) return;
  throw InputError({"", 0, "sewn_seams"},
                   "seams that are projected are held in explicit steps alone; allowed here: seams that are weak");
}

std::unique_ptr<Structure> buildStructure(std::shared_ptr<const Cloth> cloth, const StructureOptions& o) {
  std::vector<Program> programs = o.programs;
  if (programs.empty()) programs.push_back({{0, 1}, {0, 1}});
  checkPrograms(programs);
  const int count = static_cast<int>(programs.size());
  const auto check = [&](const auto& loads, const char* key) {
    for (const auto& load : loads)
      if (load.program < 0 || load.program >= count)
        throw InputError({"", 0, key}, "program " + std::to_string(load.program) + " does not exist");
  };
  check(o.dead, "loads.dead");
  check(o.pressure, "loads.pressure");
  check(o.moments, "loads.moments");
  if (!(o.rayleigh_mass_per_s >= 0)) throw InputError({"", 0, "rayleigh_mass_per_s"}, "must be >= 0");
  if (!(o.rayleigh_stiffness_s >= 0)) throw InputError({"", 0, "rayleigh_stiffness_s"}, "must be >= 0");
  if (!(o.drag_kg_per_m2s >= 0)) throw InputError({"", 0, "drag_kg_per_m2s"}, "must be >= 0");

  const FreeMap& map = cloth->map();
  DofMap dofs = dofsOf(*cloth, o.constraints, count);
  Loads loads(cloth->mounting(), cloth->points(), o.dead, o.pressure, o.moments);
  std::unique_ptr<const ClothTangent> tangent = cloth->tangent();
  Reduction reduction(tangent->sparsity(), dofs.C);
  SparseRows consistent = multiply(multiply(map.Tt, cloth->consistentMass()), map.T);
  std::vector<double> lumped(map.home.size()), area(map.home.size());
  const std::vector<double> ones(map.home.size(), 1.0);
  consistent.multiply<double>(ones, lumped);
  map.Tt.multiply<double>(cloth->areas(), area);
  std::vector<double> inner(cloth->innerRates());
  cloth->innerMasses(inner);
  return std::make_unique<Structure>(Structure{std::move(cloth), std::move(dofs), std::move(loads), std::move(programs),
                                               std::move(tangent), std::move(reduction), o.dead, std::move(lumped),
                                               std::move(consistent), o.rayleigh_mass_per_s, o.rayleigh_stiffness_s,
                                               o.drag_kg_per_m2s, std::move(area), std::move(inner)});
}

}  // namespace gambeson
