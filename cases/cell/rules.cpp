/// Detail of fields.hpp: rules between the parts of a cell's case.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/cell/engine.hpp"
#include "cases/cell/fields.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/yarns/rules.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

Entry memberOf(const Entry& parent, const std::string& key) { return parent.member(*parent.node.find(key)); }
Entry itemOf(const Entry& parent, const std::string& list, std::size_t i) { return memberOf(parent, list).item(i); }

void checkPath(const Entry& path, const CellCase& c, const PathCase& p) {
  const std::string word = wordOf(p.load);
  const Entry load = memberOf(path, word);
  if (c.yarns == YarnModel::truss && word != "biaxial" && word != "uniaxial")
    load.fail("a truss carries loads along its yarns; allowed with yarns truss: biaxial or uniaxial");
  if (c.yarns == YarnModel::solid && word == "bending")
    load.fail("cells of solids stay flat; allowed with yarns solid: biaxial, uniaxial, compression, shear or trellis");
  if (const auto* bending = std::get_if<BendingPath>(&p.load)) {
    if (c.holds_faces) load.fail("held faces do not bend; allowed with faces glide");
    if (c.quarter) load.fail("a quarter does not bend; allowed with extent full");
    double half = 0;
    for (const int d : {along_weft, along_warp})
      half = std::max(half, c.yarn(d).shape.amplitude_m + c.yarn(d).shape.half_thickness_m);
    if (!(std::abs(bending->curvature_per_m) * half < 1))
      load.failAt("curvature", fmt::format("{:g} 1/m is out of range; allowed: below 1 over half of the cloth's "
                                           "thickness, {:.6g} 1/m",
                                           bending->curvature_per_m, 1 / half));
  }
  if (const auto* biaxial = std::get_if<BiaxialPath>(&p.load); biaxial && biaxial->ratio * biaxial->extension <= -0.5)
    load.failAt("ratio", fmt::format("shortens the warp by {:g}; allowed: by less than 0.5",
                                     -biaxial->ratio * biaxial->extension));
  if (const auto* shear = std::get_if<ShearPath>(&p.load); shear && !(std::abs(shear->shear) < 1 + shear->extension))
    load.failAt("shear", fmt::format("{:g} turns the cloth over; allowed: below 1 + extension = {:g}", shear->shear,
                                     1 + shear->extension));
  for (const double t : partsOf(p)) {
    try {
      checkLoad(targetOf(p.load, t).load);
    } catch (const InputError& e) {
      load.fail(fmt::format("is of no plane cloth at {:g} of its way: {} {}", t, e.where().key, e.reason()));
    }
    if (t == 1) break;
  }
}

void checkUnused(const Entry& entry, const std::string& name, std::set<std::string>& names) {
  if (!names.insert(name).second)
    entry.failAt("name", fmt::format("\"{}\" is used twice; allowed: a name of its own", name));
}

/// Of a load, which pictures are called by.
void checkFileName(const Entry& entry, const std::string& name) {
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") != std::string::npos)
    entry.failAt("name", "is the name of files; allowed: letters, digits, _ and -");
}

void checkPictures(const Entry& root, const CellCase& c, const std::set<std::string>& names) {
  if (c.output.shapes == CellShapesKept::none && !c.output.pictures.empty())
    memberOf(root, "output").failAt("pictures", "need a shape; allowed with shapes last or all");
  for (std::size_t i = 0; i < c.output.pictures.size(); ++i) {
    const std::string& path = c.output.pictures[i].path;
    if (c.output.pictures[i].field == CellField::pressure && c.yarns != YarnModel::solid)
      itemOf(memberOf(root, "output"), "pictures", i)
          .failAt("field", "pressure is of surfaces that touch; allowed with yarns rod or truss: stress or direction");
    if (path.empty() || names.contains(path)) continue;
    itemOf(memberOf(root, "output"), "pictures", i)
        .failAt("path",
                fmt::format("there is no load \"{}\"; allowed: {}", path,
                            names.empty() ? "none, the case has no loads" : joined({names.begin(), names.end()})));
  }
}

}  // namespace

void applyCellRules(const Entry& root, CellCase& c) {
  constexpr std::size_t kPaths = 1000;
  applyDesignRules(root, c);
  if (c.paths.size() > kPaths)
    memberOf(root, "loads").fail(fmt::format("{} are too many; allowed: at most {}", c.paths.size(), kPaths));
  try {
    makeEngine(c);
  } catch (const InputError& e) {
    sayAt(root, e);
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < c.paths.size(); ++i) {
    checkPath(itemOf(root, "loads", i), c, c.paths[i]);
    checkFileName(itemOf(root, "loads", i), c.paths[i].name);
    checkUnused(itemOf(root, "loads", i), c.paths[i].name, names);
  }
  checkPictures(root, c, names);
  std::set<std::string> bars;
  for (std::size_t i = 0; i < c.bars.size(); ++i) checkUnused(itemOf(root, "bars", i), c.bars[i].name, bars);
}

}  // namespace gambeson::schema
