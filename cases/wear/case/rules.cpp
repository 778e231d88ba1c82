#include "cases/wear/case/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cases/cloth/membrane_fields.hpp"
#include "cases/cloth/rules.hpp"
#include "cases/contact/fields.hpp"
#include "cases/input/mistakes.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

/// Complains at the deepest part of `keys` that is written.
[[noreturn]] void failAt(const Entry& entry, std::initializer_list<std::string> keys, const std::string& reason) {
  if (keys.size() == 1) entry.failAt(*keys.begin(), reason);
  const JsonNode* child = entry.node.find(*keys.begin());
  if (child) {
    const std::vector<std::string> rest(keys.begin() + 1, keys.end());
    const Entry inner = entry.member(*child);
    if (rest.size() == 1) inner.failAt(rest[0], reason);
    const JsonNode* next = inner.node.find(rest[0]);
    if (next) inner.member(*next).failAt(rest[1], reason);
    inner.failAt(rest[0], reason);
  }
  std::string path;
  for (const std::string& k : keys) path += (path.empty() ? "" : ".") + k;
  entry.failAt(path, reason);
}

Entry itemOf(const Entry& root, const std::string& list, std::size_t i) {
  return root.member(*root.node.find(list)).item(i);
}

/// The garment that the edge belongs to. Throws InputError where the case does not tell which.
const GarmentCase* garmentOf(const Entry& support, const Case& c, const EdgeCase& edge) {
  std::vector<std::string> names;
  for (const GarmentCase& g : c.garments) {
    if (edge.garment.empty() ? c.garments.size() == 1 : g.name == edge.garment) return &g;
    names.push_back(g.name);
  }
  support.failAt("garment", edge.garment.empty()
                                ? "is required where there are several garments; allowed: " + joined(names)
                                : fmt::format("there is no garment \"{}\"; allowed: {}", edge.garment,
                                              names.size() == 1 && names[0].empty() ? "none, as there is only one"
                                                                                    : joined(names)));
}

void checkEdge(const Entry& support, const Case& c, const EdgeCase& edge) {
  const GarmentCase& garment = *garmentOf(support, c, edge);
  if (!edge.name.empty()) {
    if (kindOf(garment).isRead()) return;  // its file knows (cases/wear/case/references.cpp)
    const std::vector<std::string> names = kindOf(garment).edges(garment);
    if (std::find(names.begin(), names.end(), edge.name) == names.end())
      support.failAt("edge", fmt::format("\"{}\" is not an edge of this garment; allowed: {}", edge.name,
                                         names.empty() ? "patch and side, such as 2.u0" : joined(names)));
    return;
  }
  const int patches = static_cast<int>(kindOf(garment).patches(garment).size());
  if (!kindOf(garment).isRead() && edge.patch >= patches)
    support.failAt(support.node.find("edge") ? "edge" : "patch",
                   fmt::format("there is no patch {}; allowed: 0 to {}", edge.patch, patches - 1));
}

void checkSupports(const Entry& root, const Case& c) {
  for (std::size_t i = 0; i < c.supports.size(); ++i) {
    const Entry entry = itemOf(root, "supports", i);
    const Entry support = entry.member(entry.node.children.front());
    checkEdge(support, c, edgeOf(c.supports[i]));
    if (kindOf(c.supports[i]).link(c.supports[i]) && !c.human)
      support.failAt("link", "springs tie the garment to a human, and the case has none");
  }
}

/// Garment i where it is written.
Entry garmentEntry(const Entry& root, std::size_t i) {
  const JsonNode* list = root.node.find("garments");
  return list ? root.member(*list).item(i) : root.member(*root.node.find("garment"));
}

/// At the part of the garment that the error's key names ("fields[0].thickness.values"), as far as it is written.
[[noreturn]] void failInside(const Entry& entry, const std::string& key, const std::string& reason) {
  const std::size_t end = key.find_first_of(".[");
  if (end == std::string::npos) entry.failAt(key, reason);
  const JsonNode* child = entry.node.find(key.substr(0, end));
  if (!child) entry.failAt(key, reason);
  const Entry inside = entry.member(*child);
  if (key[end] == '.') failInside(inside, key.substr(end + 1), reason);
  const std::size_t close = key.find(']', end);
  const Entry item = inside.item(std::stoul(key.substr(end + 1)));
  if (close + 1 >= key.size()) item.fail(reason);
  failInside(item, key.substr(close + 2), reason);
}

/// Keys that its kind of cloth has no use for.
void checkModel(const Entry& entry, const Case& c, const GarmentCase& g) {
  const GarmentKind& kind = kindOf(g);
  const auto refuse = [&](const char* key, const std::string& reason) {
    if (entry.node.find(key)) entry.failAt(key, reason);
  };
  if (kind.isMesh() && g.cloth.kind != ClothKind::triangles)
    entry.failAt("model", fmt::format("a {} is cloth of triangles; allowed: \"triangles\"", kind.word));
  if (kind.isMesh())
    refuse("mesh", fmt::format("is for drafts; a {} is a mesh already", kind.word));
  else if (g.cloth.kind != ClothKind::triangles)
    refuse("mesh", "is for \"model\": \"triangles\"");
  checkMembrane(entry, g.cloth, fabricOf(c, g), true);
  for (const Fabric& other : otherFabrics(g)) checkMembrane(entry, g.cloth, other, true);
  checkBending(entry, g.cloth);
  checkNodes(entry, g.cloth, fabricOf(c, g));
  for (const Fabric& other : otherFabrics(g)) checkNodes(entry, g.cloth, other);
  if (g.cloth.kind != ClothKind::triangles) return;
  refuse("samples_per_cell", "is for the other models; the samples of triangles are their vertices");
  if (c.strain_limit && wornLimit(*c.strain_limit).mode == LimitMode::equality)
    entry.failAt(
        "model",
        "triangles lock where their threads keep their lengths; allowed: strain_limit with a limit, or \"nurbs\"");
  if (!kind.isMesh()) return;
  for (const char* key : {"fields", "regions", "other_fabrics", "stitching", "seam_stiffness"})
    refuse(key, fmt::format("is for drafted garments, not for a {}", kind.word));
}

void checkFieldsOf(const Entry& entry, const Case& c, const GarmentCase& g) {
  for (std::size_t i = 0; i < g.fields.size(); ++i) {
    try {
      checkFields(g.fields[i], fabricOf(c, g), otherFabrics(g));
    } catch (const InputError& e) {
      failInside(entry, fmt::format("fields[{}].{}", i, e.where().key), e.reason());
    }
  }
  if (!g.other_fabrics.empty() &&
      std::none_of(g.fields.begin(), g.fields.end(), [](const FieldsCase& f) { return f.fields.material.has_value(); }))
    entry.failAt("other_fabrics", "is of no use: no material field of this garment chooses from it");
  const GarmentKind& kind = kindOf(g);
  if (const std::string why = kind.fieldless(g); !why.empty()) {
    if (!g.fields.empty()) entry.failAt("fields", why);
    if (!g.regions.empty()) entry.failAt("regions", why);
  }
  if (kind.isRead()) return;  // its file knows (cases/wear/case/references.cpp)
  Garment patches;
  patches.patch_names = kind.patches(g);
  patches.patches.resize(patches.patch_names.size());
  try {
    applyFields(g.fields, patches);
    applyRegions(g.regions, patches);
  } catch (const InputError& e) {
    failInside(entry, e.where().key, e.reason());
  }
}

/// Names of regions, and fabrics that no region can make thicker.
void checkRegions(const Entry& entry, const Case& c, const GarmentCase& g, std::set<std::string>& names) {
  if (g.regions.empty()) return;
  const Entry list = entry.member(*entry.node.find("regions"));
  if (fabricOf(c, g).energy)
    list.fail("a fabric whose law is a table is one over a whole patch; allowed with regions: moduli and bending");
  for (std::size_t i = 0; i < g.regions.size(); ++i)
    if (!names.insert(g.regions[i].name).second)
      list.item(i).failAt("name",
                          fmt::format("\"{}\" names two regions; allowed: a name of its own", g.regions[i].name));
}

/// Of garments of flat panels: how they are put on, and keys that they have no use for.
void checkSewn(const Entry& root, const Entry& entry, const Case& c, const GarmentKind& kind) {
  if (c.human && !c.dressing.layer_by_layer && c.dressing.from.empty())
    entry.failAt(kind.word, "needs dressing.layer_by_layer: panels are sewn around the wearer before they have weight");
  if (!c.human && c.garments.size() > 1)
    entry.failAt(kind.word, "is put on by itself: without a human it is the only garment");
  for (const char* key : {"stitching", "seam_stiffness"})
    if (entry.node.find(key))
      entry.failAt(key, "is for drafted garments; a pattern says it of each seam, in its file or in pattern.seams");
  if (c.time.motion.scheme != MotionScheme::verlet)
    failAt(root, {"time", "scheme"}, "sewn seams hold in steps of velocity Verlet; allowed with a pattern: verlet");
}

void checkGarments(const Entry& root, const Case& c) {
  std::set<std::string> names, regions;
  bool all_own = true;
  for (std::size_t i = 0; i < c.garments.size(); ++i) {
    const GarmentCase& g = c.garments[i];
    const Entry entry = garmentEntry(root, i);
    if (c.garments.size() > 1 && g.name.empty())
      entry.failAt("name", "is required where there are several garments: what supports and tables call it");
    if (!names.insert(g.name).second)
      entry.failAt("name", fmt::format("\"{}\" names two garments; allowed: a name of its own", g.name));
    const GarmentKind& kind = kindOf(g);
    if (kind.drafted && !c.human)
      entry.failAt(kind.word, fmt::format("a {} is drafted on a human, and the case has none", kind.word));
    checkModel(entry, c, g);
    checkFieldsOf(entry, c, g);
    checkRegions(entry, c, g, regions);
    all_own = all_own && g.fabric;
    if (kind.sewn) checkSewn(root, entry, c, kind);
    if (g.stitching && !c.dressing.layer_by_layer && c.dressing.from.empty())
      entry.failAt("stitching", "needs dressing.layer_by_layer: each garment is then put on by itself");
  }
  for (std::size_t i = 0; i < c.garments.size(); ++i) {
    const Entry entry = garmentEntry(root, i);
    if (const auto& own = c.garments[i].fabric) refuseCell(entry.member(*entry.node.find("fabric")), *own);
    for (std::size_t k = 0; k < c.garments[i].other_fabrics.size(); ++k)
      refuseCell(entry.member(*entry.node.find("other_fabrics")).item(k), c.garments[i].other_fabrics[k]);
  }
  if (const JsonNode* fabric = root.node.find("fabric")) refuseCell(root.member(*fabric), c.fabric);
  const bool common = root.node.find("fabric");
  if (!common && !all_own)
    root.failAt("fabric", "is required: what garments without a fabric of their own are made of");
  if (common && all_own) root.failAt("fabric", "is of no use: every garment has a fabric of its own");
}

void requireContact(const Entry& root, const Case& c) {
  if ((c.human || !c.obstacles.empty() || c.garments.size() > 1) && !root.node.find("contact"))
    root.failAt("contact",
                "is required where there is a human, an obstacle or a second garment: at least its friction");
}

void checkWithoutHuman(const Entry& root, Case& c) {
  if (!c.time.duration_s) failAt(root, {"time", "duration"}, "is required without a human; allowed: > 0 s");
  if (c.air.with_pelvis) failAt(root, {"air", "velocity"}, "\"pelvis_mean\" needs a human, and the case has none");
  if (c.dressing.projecting)
    failAt(root, {"dressing", "projecting"}, "projecting dresses a human, and the case has none");
  if (c.dressing.layer_by_layer)
    failAt(root, {"dressing", "layer_by_layer"}, "garments are put on a human, and the case has none");
  if (!c.dressing.from.empty())
    failAt(root, {"dressing", "from"}, "a dressed state is one of a human, and the case has none");
  const JsonNode* dressing = root.node.find("dressing");
  if (dressing && dressing->find("settle") && c.dressing.settle_s > 0)
    failAt(root, {"dressing", "settle"}, "a garment settles on a human, and the case has none");
  c.dressing.settle_s = 0;
  if (!c.analysis.joints.empty())
    failAt(root, {"analysis", "joints"}, "joints are those of a human, and the case has none");
}

/// Natural moments are those of what the human does.
void checkTask(const Entry& root, const Case& c) {
  const Task task = c.analysis.task;
  if (task == Task::none || (c.human && kindOf(*c.human).task == task)) return;
  failAt(root, {"analysis", "task"},
         task == Task::natural_walk     ? "natural_walk compares with walking, and the human does not walk"
         : task == Task::natural_stairs ? "natural_stairs compares with climbing stairs, and the human climbs none"
                                        : "aiming compares with taking aim, and the human takes none");
}

void checkTime(const Entry& root, const Case& c) {
  const MotionScheme scheme = c.time.motion.scheme;
  if (scheme == MotionScheme::verlet) return;
  if (c.strain_limit) failAt(root, {"time", "scheme"}, "goes without strain_limit; allowed with it: \"verlet\"");
  const auto moves = [](const SupportCase& support) {
    return std::visit(
        []<class S>(const S& s) {
          if constexpr (std::is_base_of_v<HeldSupport, S>) return !s.drive.empty() || s.release_s.has_value();
          return std::is_same_v<S, CordSupport>;
        },
        support);
  };
  if (std::any_of(c.supports.begin(), c.supports.end(), moves))
    failAt(root, {"time", "scheme"},
           "goes without supports that move or let go, and without cords; allowed with them: \"verlet\"");
  if ((scheme == MotionScheme::euler || scheme == MotionScheme::midpoint) && !(c.time.step_s > 0) &&
      !(c.air.drag_kg_per_m2s > 0))
    failAt(root, {"time", "scheme"},
           "lets motion grow in steps of any length where nothing damps it; allowed: with air.drag > 0, or with "
           "time.step > 0");
}

/// What the methods of contact of their own do not treat. The cloth and the bodies of projection are looked at where
/// they are made (checkProjection).
void checkContactMethod(const Entry& root, const Case& c) {
  if (c.contact.method == ContactMethod::together) return;
  const std::string reason = "this contact.method knows Coulomb's friction; allowed with it: a number";
  if (!c.contact.friction.isCoulomb()) failAt(root, {"contact", "friction"}, reason);
  if (c.contact.friction_cloth && !c.contact.friction_cloth->isCoulomb())
    failAt(root, {"contact", "friction_cloth"}, reason);
  for (std::size_t i = 0; i < c.garments.size(); ++i)
    if (c.garments[i].friction && !c.garments[i].friction->isCoulomb())
      garmentEntry(root, i).failAt("friction", reason);
  for (std::size_t i = 0; i < c.obstacles.size(); ++i)
    if (c.obstacles[i].friction && !c.obstacles[i].friction->isCoulomb())
      itemOf(root, "obstacles", i).failAt("friction", reason);
  if (c.strain_limit) failAt(root, {"contact", "method"}, "goes without strain_limit; allowed with it: together");
  if (c.time.motion.scheme != MotionScheme::verlet)
    failAt(root, {"contact", "method"}, "goes with time.scheme verlet; allowed with others: together");
}

}  // namespace

namespace {

/// Pictures of what cloth remembers, where none of it has friction in bending.
void checkPictureFields(const Entry& root, const Case& c) {
  const auto remembers = [](const Fabric& f) {
    return std::visit([]<class L>(const L&) { return std::is_base_of_v<FrictionInBending, L>; }, f.law);
  };
  for (const GarmentCase& g : c.garments)
    if (remembers(fabricOf(c, g)) || std::any_of(g.other_fabrics.begin(), g.other_fabrics.end(), remembers)) return;
  for (std::size_t i = 0; c.output.pictures && i < c.output.pictures->size(); ++i)
    if (const PictureField f = (*c.output.pictures)[i].field; f == PictureField::set || f == PictureField::friction)
      root.member(*root.node.find("output"))
          .member(*root.node.find("output")->find("pictures"))
          .item(i)
          .failAt("field",
                  "shows what bent cloth remembers, which no fabric here does; allowed: it where a fabric's "
                  "bending has the law hysteresis");
}

}  // namespace

namespace {

/// What a table says is of one cloth as it is.
void checkFactors(const Entry& root, const Case& c) {
  const auto is_table = [](const Fabric& f) { return f.energy != nullptr; };
  if (std::none_of(c.garments.begin(), c.garments.end(), [&](const GarmentCase& g) {
        return is_table(fabricOf(c, g)) || std::any_of(g.other_fabrics.begin(), g.other_fabrics.end(), is_table);
      }))
    return;
  for (const auto& [key, factor] : {std::pair("thickness", c.factors.thickness),
                                    std::pair("bending", c.factors.bending), std::pair("membrane", c.factors.membrane)})
    if (factor != 1) failAt(root, {"factors", key}, "does not go with a fabric whose law is a table; allowed: 1");
}

}  // namespace

void applyRules(const Entry& root, Case& c) {
  Mistakes mistakes;
  const auto check = [&](auto rule) { return mistakes.without([&] { rule(root, c); }); };
  check(checkFactors);
  const bool garments_hold = check(checkGarments);
  check(requireContact);
  if (!c.human) check(checkWithoutHuman);
  check(checkTime);
  check(checkContactMethod);
  if (garments_hold) check(checkSupports);
  mistakes.without([&] { checkObstacleNames(root, c.obstacles); });
  const JsonNode* analysis = root.node.find("analysis");
  if (c.human && !(analysis && analysis->find("task"))) c.analysis.task = kindOf(*c.human).task;
  check(checkTask);
  check(checkPictureFields);
  mistakes.say();
}

}  // namespace gambeson::schema
