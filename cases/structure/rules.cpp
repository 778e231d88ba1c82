/// Detail of fields.hpp: rules between the parts of a structure's case.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/cloth/membrane_fields.hpp"
#include "cases/cloth/rules.hpp"
#include "cases/contact/fields.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/structure/build.hpp"
#include "cases/structure/fields.hpp"
#include "core/cloth/block_law.hpp"
#include "core/error.hpp"
#include "core/motion/structure_motion.hpp"

namespace gambeson::schema {
namespace {

Entry memberOf(const Entry& parent, const std::string& key) { return parent.member(*parent.node.find(key)); }
Entry itemOf(const Entry& parent, const std::string& list, std::size_t i) { return memberOf(parent, list).item(i); }

bool isBuilt(const SheetCase& s) {
  return !std::holds_alternative<NurbsShape>(s.shape) && !std::holds_alternative<SheetFile>(s.shape);
}

/// Also sets what is counted differently in built shapes and in patches of one's own.
void checkSheet(const Entry& root, SheetCase& s) {
  const Entry sheet = memberOf(root, "sheet");
  checkBending(sheet, s.cloth);
  if (isBuilt(s)) {
    if (s.split) sheet.failAt("split", "goes with nurbs and file; give cells_u and cells_v");
    s.cells_u = s.cells_u.value_or(16);
    s.cells_v = s.cells_v.value_or(16);
    constexpr long most = 250000;
    if (static_cast<long>(*s.cells_u) * *s.cells_v > most)
      sheet.failAt("cells_u", fmt::format("{} x {} cells are too many; allowed: at most {} together", *s.cells_u,
                                          *s.cells_v, most));
  } else {
    for (std::size_t i = 0; i < s.trim.size(); ++i)
      if (std::holds_alternative<TrimSpline>(s.trim[i].loop))
        itemOf(sheet, "trim", i).failAt("spline", "goes with a plate; give a loop of curves");
    for (const char* key : {"cells_u", "cells_v"})
      if (sheet.node.find(key)) sheet.failAt(key, "goes with built shapes; patches of your own are refined by split");
    s.split = s.split.value_or(1);
  }
}

std::optional<double> densityOf(const MaterialCase& m) {
  return std::visit(
      [](const auto& law) -> std::optional<double> {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(law)>, Fabric>)
          return law.density_kg_per_m3;
        else
          return law.density_kg_per_m3;
      },
      m.law);
}

void checkMaterial(const Entry& entry, const StructureCase& c, const MaterialCase& m) {
  const auto law = [&] {
    for (const char* key : {"isotropic", "orthotropic", "laminate", "fabric"})
      if (entry.node.find(key)) return memberOf(entry, key);
    return entry;
  }();
  if (c.kind != StructureKind::statics && m.energy_source) refuseCell(law, FabricCase{{}, {}, {}, {}, m.energy_source});
  if (!densityOf(m)) {
    if (c.kind != StructureKind::statics)
      law.failAt("density", fmt::format("is required: mass per volume, in a {} case",
                                        c.kind == StructureKind::modal ? "modal" : "dynamic"));
    for (const StructureLoad& l : c.loads)
      if (l.sort == LoadSort::gravity) law.failAt("density", "is required: mass per volume, for gravity");
  }
  if (const auto* laminate_ = std::get_if<LaminateMaterial>(&m.law); laminate_ && m.tension_field) {
    const Section s = laminate(laminate_->plies);
    double size_b = 0, size_a = 0, size_d = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      size_b = std::max(size_b, std::abs(s.B[k]));
      size_a = std::max(size_a, std::abs(s.A[k]));
      size_d = std::max(size_d, std::abs(s.D[k]));
    }
    if (size_b > 1e-9 * std::sqrt(size_a * size_d))
      entry.failAt("tension_field", "is not possible for a laminate that couples membrane and bending (B is not 0)");
  }
  try {
    checkFabric(fabricOf(m));
  } catch (const InputError& e) {  // "fabric.jam_area"
    const std::string key = keyUnder(law.path, e.where().key.substr(e.where().key.find('.') + 1));
    law.failAt(key.substr(law.path.size() + 1), e.reason());
  }
}

void checkProgram(const Entry& entry, const StructureCase& c, const std::string& name) {
  if (name.empty()) return;
  std::vector<std::string> names;
  for (const NamedProgram& p : c.programs) names.push_back(p.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string near = closest(name, names);
  entry.failAt("program", names.empty()  ? fmt::format("there is no program \"{}\"; the case has no programs", name)
                          : near.empty() ? fmt::format("there is no program \"{}\"; allowed: {}", name, joined(names))
                                         : fmt::format("there is no program \"{}\"; did you mean \"{}\"?", name, near));
}

void checkLoads(const Entry& root, const StructureCase& c) {
  for (std::size_t i = 0; i < c.loads.size(); ++i) checkProgram(itemOf(root, "loads", i), c, c.loads[i].program);
  bool moves = false;
  for (std::size_t i = 0; i < c.supports.size(); ++i) {
    const StructureSupport& s = c.supports[i];
    moves = moves || s.move_m;
    checkProgram(itemOf(root, "supports", i), c, s.program);
    if (s.move_m && s.program.empty() && c.kind == StructureKind::dynamics)
      itemOf(root, "supports", i)
          .failAt("program", "is required: the motion over time, such as \"programs\": {\"ramp\": [[0, 0], [1, 1]]}");
    if (s.move_m && c.kind == StructureKind::modal && !c.modal.at_equilibrium)
      itemOf(root, "supports", i).failAt("move", "does nothing at rest; give \"solver\": {\"at\": \"equilibrium\"}");
  }
  const bool pulled = moves || !c.loads.empty();
  if (c.kind == StructureKind::statics && !pulled)
    root.failAt("loads", "nothing pulls: give a load, or a support with move");
  if (c.kind == StructureKind::modal && !c.modal.at_equilibrium && !c.loads.empty())
    root.failAt("loads", "do nothing at rest; give \"solver\": {\"at\": \"equilibrium\"}");
  if (c.kind == StructureKind::modal && c.modal.at_equilibrium && !pulled)
    memberOf(root, "solver").failAt("at", "there is no load; allowed: rest, or a case with loads");
}

void checkOutput(const Entry& root, const StructureCase& c, const Sheet& sheet) {
  std::vector<std::string> names;
  const auto unique = [&](const Entry& p, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) != names.end())
      p.failAt("name", fmt::format("\"{}\" is used twice; allowed: a name of its own", name));
    if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") != std::string::npos)
      p.failAt("name", "is the name of columns; allowed: letters, digits, _ and -");
    names.push_back(name);
  };
  for (std::size_t i = 0; i < c.obstacles.size(); ++i) unique(itemOf(root, "obstacles", i), c.obstacles[i].name);
  const auto entry = [&](const char* list, std::size_t i) { return itemOf(memberOf(root, "output"), list, i); };
  for (std::size_t i = 0; i < c.output.points.size(); ++i) {
    unique(entry("points", i), c.output.points[i].name);
    try {
      locate(sheet, c.output.points[i].where);
    } catch (const InputError& e) {
      entry("points", i).failAt("patch", e.reason());
    }
  }
  for (std::size_t i = 0; i < c.output.edges.size(); ++i) {
    unique(entry("edges", i), c.output.edges[i].name);
    try {
      edgesOf(sheet, c.output.edges[i].where);
    } catch (const InputError& e) {
      entry("edges", i).failAt("edge", e.reason());
    }
  }
  if (c.output.shapes == ShapesKept::none && !c.output.pictures.empty())
    memberOf(root, "output").failAt("pictures", "need a shape; allowed with shapes last or all");
  for (std::size_t i = 0; i < c.output.pictures.size(); ++i)
    if (c.kind == StructureKind::modal && c.output.pictures[i].mode > c.modal.count)
      entry("pictures", i)
          .failAt("mode", fmt::format("{} is out of range; allowed: at most count = {}", c.output.pictures[i].mode,
                                      c.modal.count));
}

/// Edges and points of supports and loads, said at the key that names them.
void checkPlaces(const Entry& root, const StructureCase& c, const Sheet& sheet) {
  const auto check = [&](const Entry& p, const auto& where) {
    try {
      if (const auto* e = std::get_if<EdgeAt>(&where)) edgesOf(sheet, *e);
      if (const auto* q = std::get_if<PointAt>(&where)) locate(sheet, *q);
    } catch (const InputError& e) {
      p.failAt(std::holds_alternative<EdgeAt>(where) ? "edge" : "patch", e.reason());
    }
  };
  for (std::size_t i = 0; i < c.supports.size(); ++i) check(itemOf(root, "supports", i), c.supports[i].where);
  for (std::size_t i = 0; i < c.loads.size(); ++i) check(itemOf(root, "loads", i), c.loads[i].where);
}

/// Contact is a part of explicit steps.
void checkContact(const Entry& root, const StructureCase& c) {
  checkObstacleNames(root, c.obstacles);
  if (!c.obstacles.empty() && !c.contact)
    root.failAt("contact", "is required where there is an obstacle: at least its friction");
  if (!c.contact) return;
  if (!c.dynamics.stepsPoints())
    root.failAt(c.obstacles.empty() ? "contact" : "obstacles",
                "goes with explicit steps; give \"scheme\": \"explicit\"");
  if (c.contact->method != ContactMethod::together)
    memberOf(root, "contact").failAt("method", "goes with worn cloth; allowed: together");
  if (c.strain_limit && c.strain_limit->method == LimitMethod::closest)
    memberOf(root, "strain_limit").failAt("method", "closest goes with a sheet that touches nothing; give fast");
  if (c.obstacles.empty() && !c.contact->self)
    memberOf(root, "contact").failAt("self", "there is nothing to touch; allowed: true, or a case with obstacles");
}

/// Whether this cloth under these supports can be limited so. A mass that is missing is said elsewhere.
void tryLimit(const Structure& structure, const StrainLimit& limit) {
  try {
    untouchedModel(structure, limit);
  } catch (const InputError& e) {
    if (e.where().key.starts_with("strain_limit")) throw;
  }
}

}  // namespace

void applyStructureRules(const Entry& root, StructureCase& c) {
  checkSheet(root, c.sheet);
  checkMaterial(memberOf(root, "material"), c, c.material);
  for (std::size_t i = 0; i < c.other_materials.size(); ++i)
    checkMaterial(itemOf(root, "other_materials", i), c, c.other_materials[i]);
  checkMembrane(memberOf(root, "sheet"), c.sheet.cloth, fabricOf(c.material), c.kind == StructureKind::dynamics);
  for (const MaterialCase& m : c.other_materials)
    checkMembrane(memberOf(root, "sheet"), c.sheet.cloth, fabricOf(m), c.kind == StructureKind::dynamics);
  checkNodes(memberOf(root, "sheet"), c.sheet.cloth, fabricOf(c.material));
  for (const MaterialCase& m : c.other_materials) checkNodes(memberOf(root, "sheet"), c.sheet.cloth, fabricOf(m));
  checkLoads(root, c);
  checkContact(root, c);
  if (c.kind == StructureKind::dynamics && c.dynamics.stepsPoints() && c.damping.stiffness_s > 0)
    memberOf(root, "solver")
        .failAt("rayleigh_stiffness",
                "goes with implicit schemes: it would cut the stable step of explicit ones; allowed: 0");
  if (c.strain_limit && !(c.dynamics.stepsPoints() && c.dynamics.motion.scheme == MotionScheme::verlet))
    root.failAt("strain_limit", "goes with explicit steps; give \"scheme\": \"explicit\"");
  try {
    const Sheet sheet = sheetOf(c);
    checkPlaces(root, c, sheet);
    checkOutput(root, c, sheet);
    const std::shared_ptr<const Cloth> cloth = clothOf(c, sheet);
    const StructureOptions o = optionsOf(c, sheet, *cloth);
    const DofMap dofs = dofsOf(*cloth, o.constraints, static_cast<int>(o.programs.size()));
    if (dofs.unknowns() == 0) root.failAt("supports", "hold everything: nothing is left to move");
    if (c.strain_limit) tryLimit(*buildStructure(cloth, o), limitOf(*c.strain_limit));
  } catch (const InputError& e) {
    sayAt(root, e);
  }
}

}  // namespace gambeson::schema
