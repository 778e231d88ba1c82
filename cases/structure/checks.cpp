#include "cases/structure/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/cloth/fabric.hpp"

namespace gambeson {
namespace {

/// NaN where any is.
double largestOf(const std::vector<double>& values) {
  double most = 0;
  for (double v : values)
    if (!(v <= most)) most = v;
  return most;
}

AuditCheck finiteCheck(const PathTable& path, const MeshShape& shape) {
  long count = 0;
  const auto look = [&](double v) { count += !std::isfinite(v); };
  for (const auto& row : path.rows) std::for_each(row.begin(), row.end(), look);
  for (const Vec3& x : shape.x) look(x.x + x.y + x.z);
  for (const PrincipalStress& s : shape.stress)
    for (double v : {s.principal1_N_per_m, s.principal2_N_per_m, s.strain1, s.strain2}) look(v);
  return {"Finite numbers",
          static_cast<double>(count),
          0,
          "",
          "numbers of the result that are not finite",
          fmt::format("{} numbers of the result are not finite, so that it is no state of this sheet", count)};
}

AuditCheck residualCheck(const StructureCase& c, const PathTable& path, const std::vector<ModeRow>& modes) {
  if (c.kind == StructureKind::modal) {
    double most = 0;
    for (const ModeRow& m : modes) most = std::max(most, m.residual);
    return {"Residual",
            most,
            1e-6,
            "",
            "how far, relative, a natural frequency's square may be from the nearest exact one of this mesh",
            fmt::format("modes are known to {} only", formatNumber(most, 2))};
  }
  const double most = largestOf(path.column("residual"));
  return {"Residual",
          most,
          std::max(c.statics.tolerance, 1e-6),
          "",
          "forces out of balance at a point of the path, of the forces that balance; the largest",
          fmt::format("forces do not balance: up to {} of them is left", formatNumber(most, 2))};
}

/// Energy that appears: how far the total rises above what it was before, but for what contact does on the sheet.
/// Damping and numerical damping lower it.
AuditCheck energyCheck(const PathTable& path) {
  const std::vector<double> kinetic = path.column("kinetic_energy_J"), strain = path.column("strain_energy_J"),
                            loads = path.column("external_energy_J"), contact = path.column(contact_work_column);
  std::vector<double> total = path.column("total_energy_J");
  for (std::size_t k = 0; k < contact.size(); ++k) total[k] -= contact[k];
  double lowest = total.empty() ? 0 : total.front(), rise = 0, size = 0;
  for (std::size_t k = 0; k < total.size(); ++k) {
    lowest = std::min(lowest, total[k]);
    rise = std::isfinite(total[k]) ? std::max(rise, total[k] - lowest) : total[k];
    const double touching = contact.empty() ? 0 : std::abs(contact[k]);
    size = std::max(size, std::abs(kinetic[k]) + std::abs(strain[k]) + std::abs(loads[k] - loads[0]) + touching);
  }
  const double part = rise == 0 ? 0 : 100 * rise / size;
  return {"Energy",
          part,
          5,
          "%",
          fmt::format("the largest rise of the total energy (kinetic, strain, less the work of the loads{}), of the "
                      "largest sum of its parts",
                      contact.empty() ? "" : " and of contact"),
          fmt::format("{} % of the energy appears from nowhere", formatNumber(part, 2))};
}

bool hasEnergy(const MaterialCase& m) { return m.energy_source.has_value(); }
bool isCell(const MaterialCase& m) { return m.energy_source && m.energy_source->isCell(); }

AuditCheck lawCheck(const StructureCase& c, const LawRange& range) {
  const double part = 100.0 * static_cast<double>(range.beyond) / static_cast<double>(range.points);
  if (isCell(c.material) || std::any_of(c.other_materials.begin(), c.other_materials.end(), isCell))
    return {"Law range",
            part,
            0,
            "%",
            "share of the points of the sheet whose cell of yarns finds no equilibrium (or that are strained beyond a "
            "table), in the state where most do not, or beyond which the path does not go on",
            range.first
                ? unansweredInWords(range)
                : fmt::format("{} of {} points are strained beyond the range of the law: stress there is a guess",
                              range.beyond, range.points)};
  return {"Law range",
          part,
          0,
          "%",
          "share of the points of the sheet that are strained beyond the range of its law, in the state where most are",
          fmt::format("{} of {} points are strained beyond the range of the law: stress there is a guess",
                      range.beyond, range.points)};
}

bool isFabric(const MaterialCase& m) { return std::holds_alternative<Fabric>(m.law); }

AuditCheck strainCheck(const StructureCase& c, const MeshShape& shape) {
  const bool fabric = isFabric(c.material) || std::any_of(c.other_materials.begin(), c.other_materials.end(), isFabric);
  std::vector<double> strains;
  for (const PrincipalStress& s : shape.stress) {
    strains.push_back(s.strain1);
    if (!c.material.tension_field) strains.push_back(-s.strain2);
  }
  const double most = 100 * largestOf(strains), limit = 100 * (fabric ? kStrainOfLaw : kStrainOfLinearLaw);
  return {"Strain",
          most,
          limit,
          "%",
          fmt::format("the largest strain of the last shape{}, against the range in which {}",
                      c.material.tension_field ? "" : " or compression",
                      fabric ? "the source of the fabric's law takes it for a straight line (Zheng 2013, eq. 2.13)"
                             : "laws that are linear in different measures of strain agree within 15 %"),
          fmt::format("the sheet strains by up to {} %, beyond what its law is meant for: stress there is extrapolated",
                      formatNumber(most, 2))};
}

double largestMove(const StructureCase& c) {
  double most = 0;
  for (const StructureSupport& s : c.supports)
    if (s.move_m) most = std::max(most, norm(*s.move_m));
  return most;
}

AuditCheck sizeCheck(const StructureCase& c, const StructureModel& model, const MeasuredState& last) {
  const std::vector<Vec3>& rest = model.structure->cloth->rest();
  Vec3 low = rest.front(), high = low;
  double moved = 0;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], rest[k][d]), high[d] = std::max(high[d], rest[k][d]);
    const double u = norm(last.q[k] - rest[k]);
    if (!(u <= moved)) moved = u;
  }
  const bool linear = c.kind == StructureKind::statics && c.statics.linear;
  const double size = norm(high - low), part = moved / (size + largestMove(c));
  const std::string times = formatNumber(part, 2);
  return {"Size",
          part,
          linear ? 0.1 : 10.,
          "",
          linear ? "the largest displacement, of the sheet's size: a linear solution is that of small ones"
                 : "the largest displacement, of the sheet's size and what supports move",
          linear ? fmt::format("displacements are {} times the sheet's size, which a linear solution takes for small",
                               times)
                 : fmt::format("the sheet moves by {} times its size, although it is held", times)};
}

void addContactChecks(const StructureFacts& facts, std::vector<AuditCheck>& checks) {
  const ContactFacts& k = *facts.contact;
  checks.push_back({"Contacts", 100.0 * static_cast<double>(k.unsolved) / static_cast<double>(facts.points), 1, "%",
                    "share of the steps whose contacts were not solved within the tolerance",
                    "contact forces are not solved in too many steps"});
  checks.push_back({"Penetration", 1e3 * k.deepest_m, 0.2, "mm",
                    "how deep a sample of the sheet was inside an obstacle, at most",
                    fmt::format("the sheet was {} mm inside an obstacle", formatNumber(1e3 * k.deepest_m, 2))});
  checks.push_back(
      {"Let through", static_cast<double>(k.pinched), 0, "",
       "steps in which a part of the sheet was let through something, because no step was short enough",
       fmt::format("in {} steps a part of the sheet was let through something that it should touch", k.pinched)});
  checks.push_back({"Crossings", static_cast<double>(k.crossings), 0, "",
                    "places where the sheet passes through itself or through a mesh at the start of the last step",
                    fmt::format("the sheet passes through itself or through a mesh at {} places", k.crossings)});
}

}  // namespace

std::vector<AuditCheck> structureChecks(const StructureCase& c, const StructureModel& model, const PathTable& path,
                                        const std::vector<ModeRow>& modes, const MeasuredState& last,
                                        const MeshShape& shape, const StructureFacts& facts) {
  std::vector<AuditCheck> checks{finiteCheck(path, shape)};
  if (c.kind == StructureKind::dynamics) {
    if (largestMove(c) == 0) checks.push_back(energyCheck(path));
  } else {
    checks.push_back(residualCheck(c, path, modes));
  }
  if (c.kind == StructureKind::modal) {
    double most = 0;
    for (const ModeRow& m : modes) most = std::max(most, m.rounding);
    checks.push_back({"Rounding", 100 * most, 1, "%",
                      "what the rounding of the stiffness leaves open of a natural frequency's square; the largest",
                      fmt::format("rounding leaves open up to {} % of a frequency's square: the sheet is too thin, or "
                                  "too far from the origin, for double precision",
                                  formatNumber(100 * most, 2))});
    return checks;
  }
  if (facts.law_range.points > 0) checks.push_back(lawCheck(c, facts.law_range));
  if (!hasEnergy(c.material) || !std::all_of(c.other_materials.begin(), c.other_materials.end(), hasEnergy))
    checks.push_back(strainCheck(c, shape));
  if (!c.supports.empty()) checks.push_back(sizeCheck(c, model, last));
  if (c.kind == StructureKind::statics && c.statics.arc_length)
    checks.push_back({"Path", static_cast<double>(facts.jumps), 0, "",
                      "places between two points of the path where it bends more than the arcs could follow",
                      fmt::format("at {} places the path between two points is not known", facts.jumps)});
  if (facts.contact && facts.points > 0) addContactChecks(facts, checks);
  if (c.strain_limit && facts.points > 0)
    checks.push_back({"Strain limit",
                      100.0 * static_cast<double>(facts.limits_missed) / static_cast<double>(facts.points), 1, "%",
                      "share of the steps at whose end the strain missed its limit by more than the tolerance",
                      "the strain limit is not kept"});
  return checks;
}

}  // namespace gambeson
