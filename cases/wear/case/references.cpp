#include "cases/wear/case/references.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/mistakes.hpp"
#include "cases/input/typed.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/human.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "core/error.hpp"

namespace gambeson::schema {
namespace {

Entry listItem(const Entry& parent, const std::string& list, std::size_t i) {
  return parent.member(*parent.node.find(list)).item(i);
}

/// "there is no joint "x"; did you mean "y"?" or what there is.
std::string absent(const std::string& what, const std::string& name, const std::vector<std::string>& names) {
  const std::string near = closest(name, names);
  return fmt::format("the human has no {} \"{}\"; {}", what, name,
                     near.empty() ? "allowed: " + joined(names) : fmt::format("did you mean \"{}\"?", near));
}

void checkJoints(const Entry& root, const Case& c, const Skeleton& skeleton) {
  std::vector<std::string> moving;
  for (const Joint& j : skeleton.joints)
    if (j.type != JointType::fixed) moving.push_back(j.name);
  for (std::size_t i = 0; i < c.analysis.joints.size(); ++i) {
    const std::string& name = c.analysis.joints[i];
    const Entry entry = listItem(root.member(*root.node.find("analysis")), "joints", i);
    const int joint = skeleton.joint(name);
    if (joint < 0) entry.fail(absent("joint", name, moving));
    if (skeleton.joints[static_cast<std::size_t>(joint)].type == JointType::fixed)
      entry.fail(fmt::format("the joint \"{}\" is fixed; allowed: {}", name, joined(moving)));
    for (std::size_t k = 0; k < i; ++k)
      if (c.analysis.joints[k] == name) entry.fail(fmt::format("\"{}\" is listed twice", name));
  }
}

void checkLinks(const Entry& root, const Case& c, const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Link& l : skeleton.links) names.push_back(l.name);
  for (std::size_t i = 0; i < c.supports.size(); ++i) {
    const SupportKind& kind = kindOf(c.supports[i]);
    const std::string* link = kind.link(c.supports[i]);
    if (!link || skeleton.link(*link) >= 0) continue;
    const Entry support = listItem(root, "supports", i);
    support.member(*support.node.find(kind.word)).failAt("link", absent("link", *link, names));
  }
  for (std::size_t i = 0; i < c.obstacles.size(); ++i)
    if (skeleton.link(c.obstacles[i].name) >= 0)
      listItem(root, "obstacles", i)
          .failAt("name",
                  fmt::format("\"{}\" is also a link of the human; allowed: a name of its own", c.obstacles[i].name));
}

void checkPictures(const Entry& root, const Case& c, double duration_s) {
  for (std::size_t i = 0; c.output.pictures && i < c.output.pictures->size(); ++i) {
    const PictureCase& p = (*c.output.pictures)[i];
    if (p.when != PictureTime::at || p.time_s <= duration_s * (1 + 1e-9)) continue;
    const Entry at = listItem(root.member(*root.node.find("output")), "pictures", i);
    at.failAt("time", fmt::format("{} is out of range; allowed: 0 to {}, peak or end",
                                  inUnitOf(at, "time", p.time_s, "s"), inUnitOf(at, "time", duration_s, "s")));
  }
}

/// Those of its panel ("front.hem", "front.3"), where the name begins with one; else all.
std::vector<std::string> alike(const std::string& name, const std::vector<std::string>& names) {
  const std::string panel = name.substr(0, name.rfind('.') + 1);
  std::vector<std::string> out;
  for (const std::string& other : names)
    if (other.starts_with(panel)) out.push_back(other);
  return out.empty() ? names : out;
}

/// What supports name of a garment with these patches and edges.
void checkSupportsOf(const Entry& root, const Case& c, const GarmentCase& garment, int patches,
                     const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < c.supports.size(); ++i) {
    const EdgeCase& edge = edgeOf(c.supports[i]);
    if (!edge.garment.empty() && edge.garment != garment.name) continue;
    const Entry support = listItem(root, "supports", i);
    const Entry kind = support.member(support.node.children.front());
    if (!edge.name.empty() && std::find(names.begin(), names.end(), edge.name) == names.end())
      kind.failAt("edge", fmt::format("\"{}\" is not an edge of this garment; allowed: {}patch and side, such as 2.u0",
                                      edge.name, names.empty() ? "" : joined(alike(edge.name, names)) + ", or "));
    if (edge.patch < patches) continue;
    kind.failAt(kind.node.find("edge") ? "edge" : "patch",
                fmt::format("there is no patch {}; allowed: 0 to {}", edge.patch, patches - 1));
  }
}

/// Runs f; what turns out to be wrong is said where the key stands.
template <class F>
auto locatedAt(const Entry& root, const std::string& key, F&& f) {
  try {
    return underKey(key, f);
  } catch (const InputError& e) {
    if (!e.where().file.empty()) throw;  // as it is, with all that is wrong there
    sayAt(root, e);
  }
}

/// A garment's file, and the patches of it that supports name.
void checkGarmentFile(const Entry& root, const Case& c, const GarmentCase& garment) {
  const auto k = static_cast<std::size_t>(&garment - c.garments.data());
  Garment read = locatedAt(root, fmt::format("garments[{}].{}", k, kindOf(garment).word),
                           [&] { return kindOf(garment).look(garment); });
  try {
    applyFields(garment.fields, read);
    applyRegions(garment.regions, read);
  } catch (const InputError& e) {
    const std::string& key = e.where().key;  // "fields[0].patch", "regions[0].parts[1].patch"
    const std::size_t open = key.find('['), dot = key.find('.');
    const JsonNode* list = root.node.find("garments");
    const Entry entry = list ? root.member(*list).item(k) : root.member(*root.node.find("garment"));
    listItem(entry, key.substr(0, open), std::stoul(key.substr(open + 1)))
        .failAt(key.substr(dot + 1, key.find('[', dot) - dot - 1), e.reason());
  }
  std::vector<std::string> names;
  for (const NamedEdge& e : read.edges) names.push_back(e.name);
  checkSupportsOf(root, c, garment, static_cast<int>(read.patches.size()), names);
}

}  // namespace

void checkReferences(const Entry& root, const Case& c) {
  Mistakes mistakes;
  double duration_s = c.time.duration_s.value_or(0);
  const bool human_holds = mistakes.without([&] {
    if (!c.human) return;
    const Human human = locatedAt(root, "human", [&] { return skeletonOf(*c.human); });
    mistakes.without([&] { checkJoints(root, c, human.skeleton); });
    mistakes.without([&] { checkLinks(root, c, human.skeleton); });
    const double motion_s = locatedAt(root, fmt::format("human.motion.{}", kindOf(*c.human).word),
                                      [&] { return motionDuration(*c.human, human); });
    duration_s = c.time.duration_s.value_or(motion_s);
  });
  for (const GarmentCase& g : c.garments)
    if (kindOf(g).isRead()) mistakes.without([&] { checkGarmentFile(root, c, g); });
  for (const ObstacleCase& o : c.obstacles) mistakes.without([&] { kindOf(o).check(o); });
  if (human_holds) mistakes.without([&] { checkPictures(root, c, duration_s); });
  mistakes.say();
}

}  // namespace gambeson::schema

namespace gambeson {

double plannedDuration(const Case& c) {
  if (c.time.duration_s || !c.human) return c.time.duration_s.value_or(0);
  return motionDuration(*c.human, skeletonOf(*c.human));
}

}  // namespace gambeson
