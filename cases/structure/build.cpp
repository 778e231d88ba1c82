#include "cases/structure/build.hpp"

#include <fmt/format.h>

#include "cases/cloth/make_cloth.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// Runs f; an InputError of it is said at this key of the case.
template <class F>
auto at(const std::string& key, F f) {
  try {
    return f();
  } catch (const InputError& e) {
    throw InputError({"", 0, key}, e.reason());
  }
}

/// Program 0 is the one that loads without a name follow.
int programIndex(const StructureCase& c, const std::string& name) {
  if (name.empty()) return 0;
  for (std::size_t i = 0; i < c.programs.size(); ++i)
    if (c.programs[i].name == name) return static_cast<int>(i) + 1;
  throw InputError({"", 0, "program"}, fmt::format("there is no program \"{}\"", name));
}

/// The direction of hold that is not any other's: a motion is split over the held directions.
std::vector<LinearConstraint> supportOf(const StructureCase& c, const Sheet& sheet, const Cloth& cloth,
                                        const StructureSupport& s) {
  const Mounting& mounting = cloth.mounting();
  std::vector<LinearConstraint> all;
  const auto add = [&](std::vector<LinearConstraint> more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  Prescribed motion;
  if (s.move_m) motion = {*s.move_m, programIndex(c, s.program)};
  if (const auto* point = std::get_if<PointAt>(&s.where)) {
    const auto [patch, uv] = locate(sheet, *point);
    add(mounting.holdPlace(patch, cloth.placeOfDraft(patch, uv), s.hold, motion));
    return all;
  }
  for (const PatchEdge& e : edgesOf(sheet, std::get<EdgeAt>(s.where))) {
    if (!s.hold.empty()) add(mounting.holdEdge(e, s.hold, motion));
    if (s.clamp) add(mounting.clampEdge(e));
    if (s.symmetry) add(mounting.mirrorEdge(e, *s.symmetry));
    if (s.tie) add(mounting.tieEdge(e, *s.tie));
  }
  return all;
}

void addForce(StructureOptions& o, std::vector<Vec3> force, int program) {
  for (DeadLoad& d : o.dead)
    if (d.program == program) {
      for (std::size_t i = 0; i < force.size(); ++i) d.force_N[i] += force[i];
      return;
    }
  o.dead.push_back({std::move(force), program});
}

void addLoad(const StructureCase& c, const Sheet& sheet, const Cloth& cloth, const StructureLoad& l,
             StructureOptions& o) {
  const Mounting& mounting = cloth.mounting();
  const int program = programIndex(c, l.program);
  const int patches = static_cast<int>(cloth.patches().size());
  if (l.patch && *l.patch >= patches)
    throw InputError({"", 0, "patch"}, fmt::format("there is no patch {}; allowed: 0 to {}", *l.patch, patches - 1));
  const auto forPatches = [&](auto f) {
    for (int k = 0; k < patches; ++k)
      if (!l.patch || *l.patch == k) f(k);
  };
  const auto edge = [&] { return edgesOf(sheet, std::get<EdgeAt>(l.where)); };
  const auto length = [&] { return edgeLength(sheet, std::get<EdgeAt>(l.where)); };
  switch (l.sort) {
    case LoadSort::force:
      if (const auto* point = std::get_if<PointAt>(&l.where)) {
        const auto [patch, uv] = locate(sheet, *point);
        addForce(o, mounting.placeForce(patch, cloth.placeOfDraft(patch, uv), l.vector), program);
      } else {
        for (const PatchEdge& e : edge()) addForce(o, mounting.edgeForce(e, l.vector / length()), program);
      }
      break;
    case LoadSort::force_per_length:
      for (const PatchEdge& e : edge()) addForce(o, mounting.edgeForce(e, l.vector), program);
      break;
    case LoadSort::moment:
    case LoadSort::moment_per_length:
      for (const PatchEdge& e : edge())
        o.moments.push_back({e, l.sort == LoadSort::moment ? l.amount / length() : l.amount, program});
      break;
    case LoadSort::force_per_area:
      forPatches([&](int k) { addForce(o, mounting.surfaceForce(k, l.vector), program); });
      break;
    case LoadSort::pressure:
      forPatches([&](int k) { o.pressure.push_back({k, l.amount, program}); });
      break;
    case LoadSort::gravity:
      addForce(o, mounting.weightForce(l.vector), program);
      break;
  }
}

}  // namespace

Sheet sheetOf(const StructureCase& c) {
  const auto build = [&] {
    try {
      Sheet sheet = buildSheet(c.sheet);
      buildFreeMap(sheet.garment);
      sheet.garment.fabric = fabricOf(c.material);
      for (const MaterialCase& m : c.other_materials) sheet.garment.other_fabrics.push_back(fabricOf(m));
      validateFields(sheet.garment);
      return sheet;
    } catch (const InputError& e) {
      std::string key = e.where().key;
      const bool own = std::holds_alternative<NurbsShape>(c.sheet.shape);
      if (own && key.starts_with("seams[")) {
        // The n-th seam that is not weak.
        const auto& seams = std::get<NurbsShape>(c.sheet.shape).seams;
        std::size_t wanted = std::stoul(key.substr(6)), k = 0;
        for (; k < seams.size(); ++k)
          if (!seams[k].weak && wanted-- == 0) break;
        key = fmt::format("nurbs.seams[{}]", k);
      }
      if (!e.where().file.empty()) throw;  // a file that the case names says it itself
      throw InputError({"", 0, key.empty() ? "sheet" : "sheet." + key}, e.reason());
    }
  };
  Sheet sheet = build();
  sheet.garment.name = c.name;
  return sheet;
}

std::unique_ptr<const Cloth> clothOf(const StructureCase& c, const Sheet& sheet) {
  const ClothSource source{sheet.garment, c.sheet.cloth, nullptr, "sheet"};
  return makeCloth({&source, 1});
}

StructureOptions optionsOf(const StructureCase& c, const Sheet& sheet, const Cloth& cloth) {
  StructureOptions o;
  // Static: the load factor. Else: on from the start.
  if (c.kind == StructureKind::dynamics)
    o.programs.push_back({{0}, {1}});
  else
    o.programs.push_back({{0, 1}, {0, 1}});
  for (const NamedProgram& p : c.programs) o.programs.push_back({p.at, p.value});
  for (std::size_t i = 0; i < c.supports.size(); ++i) {
    const std::string key = fmt::format("supports[{}]", i);
    std::vector<LinearConstraint> more = at(key, [&] { return supportOf(c, sheet, cloth, c.supports[i]); });
    for (LinearConstraint& l : more) {
      l.name = key;
      o.constraints.push_back(std::move(l));
    }
  }
  if (withLoads(c))
    for (std::size_t i = 0; i < c.loads.size(); ++i)
      at(fmt::format("loads[{}]", i), [&] { addLoad(c, sheet, cloth, c.loads[i], o); });
  o.rayleigh_mass_per_s = c.damping.mass_per_s;
  o.rayleigh_stiffness_s = c.damping.stiffness_s;
  o.drag_kg_per_m2s = c.damping.drag_kg_per_m2s;
  return o;
}

}  // namespace gambeson
