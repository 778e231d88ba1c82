#include "human/body/urdf_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "core/io/apart.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

constexpr int deepest = 32;
constexpr std::size_t most_links = 2000;
constexpr double largest = 1e6;  ///< of any length [m], angle [rad] or mass [kg]

enum class Kind { text, name, number, positive, not_negative, triple, sizes };

struct Attribute {
  const char* name;
  Kind kind;
  bool needed = true;
};

/// One row per element: whose child it is, how often it may stand there, what attributes it has.
struct Rule {
  const char* parent;
  const char* name;
  int least, most;
  std::vector<Attribute> attributes;
};

constexpr int many = 1 << 30;

/// Elements whose insides are not ours: read by others, they are skipped.
bool isForeign(std::string_view parent, std::string_view name) {
  const std::set<std::string_view> top{"material", "transmission", "gazebo", "sensor", "mujoco", "drake"};
  if (parent == "robot") return top.contains(name);
  if (parent == "visual") return name == "material";
  if (parent == "joint") return name == "dynamics" || name == "safety_controller" || name == "calibration";
  return false;
}

const std::vector<Rule>& rules() {
  using enum Kind;
  static const std::vector<Rule> table{
      {"", "robot", 1, 1, {{"name", name}, {"version", text, false}, {"xmlns:xacro", text, false}}},
      {"robot", "link", 1, many, {{"name", name}, {"type", text, false}}},
      {"robot", "joint", 0, many, {{"name", name}, {"type", name}}},
      {"link", "inertial", 0, 1, {}},
      {"link", "visual", 0, many, {{"name", text, false}}},
      {"link", "collision", 0, many, {{"name", text, false}}},
      {"inertial", "origin", 0, 1, {{"xyz", triple, false}, {"rpy", triple, false}}},
      {"inertial", "mass", 1, 1, {{"value", not_negative}}},
      {"inertial",
       "inertia",
       1,
       1,
       {{"ixx", number}, {"ixy", number}, {"ixz", number}, {"iyy", number}, {"iyz", number}, {"izz", number}}},
      {"visual", "origin", 0, 1, {{"xyz", triple, false}, {"rpy", triple, false}}},
      {"visual", "geometry", 1, 1, {}},
      {"collision", "origin", 0, 1, {{"xyz", triple, false}, {"rpy", triple, false}}},
      {"collision", "geometry", 1, 1, {}},
      {"geometry", "box", 0, 1, {{"size", sizes}}},
      {"geometry", "cylinder", 0, 1, {{"radius", positive}, {"length", positive}}},
      {"geometry", "sphere", 0, 1, {{"radius", positive}}},
      {"geometry", "mesh", 0, 1, {{"filename", name}, {"scale", triple, false}}},
      {"joint", "parent", 1, 1, {{"link", name}}},
      {"joint", "child", 1, 1, {{"link", name}}},
      {"joint", "origin", 0, 1, {{"xyz", triple, false}, {"rpy", triple, false}}},
      {"joint", "axis", 0, 1, {{"xyz", triple}}},
      {"joint",
       "limit",
       0,
       1,
       {{"lower", number, false}, {"upper", number, false}, {"effort", number}, {"velocity", number}}},
      {"joint", "mimic", 0, 1, {{"joint", name}, {"multiplier", number, false}, {"offset", number, false}}},
  };
  return table;
}

struct Checker {
  std::string file;

  [[noreturn]] void fail(const TiXmlElement& e, const std::string& reason) const {
    std::string element = "<" + e.ValueStr();
    if (const char* n = e.Attribute("name")) element.append(" name=\"").append(n).append("\"");
    throw InputError({file, e.Row(), element.append(">")}, reason);
  }

  /// Numbers separated by blanks.
  std::vector<double> numbers(const TiXmlElement& e, const char* attribute, std::size_t count) const {
    std::vector<double> out;
    std::string_view rest = e.Attribute(attribute);
    const std::string all(rest.substr(0, 60));
    for (;;) {
      const std::size_t begin = rest.find_first_not_of(" \t\r\n");
      if (begin == std::string_view::npos) break;
      rest.remove_prefix(begin);
      const std::size_t end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
      double value;
      if (!parseNumber(rest.substr(0, end), value))
        fail(e, fmt::format("{}=\"{}\": '{}' is not a finite number", attribute, all,
                            rest.substr(0, std::min<std::size_t>(end, 40))));
      if (!(std::abs(value) <= largest)) fail(e, fmt::format("{}=\"{}\": not within {}", attribute, all, largest));
      out.push_back(value);
      rest.remove_prefix(end);
    }
    if (out.size() != count)
      fail(e, fmt::format("{}=\"{}\": needs {} number{}", attribute, all, count, count == 1 ? "" : "s"));
    return out;
  }

  void attribute(const TiXmlElement& e, const Attribute& a) const {
    const char* value = e.Attribute(a.name);
    if (!value) {
      if (a.needed) fail(e, std::string("has no ").append(a.name));
      return;
    }
    const auto allowed = [&](bool good, const char* range) {
      if (!good) fail(e, fmt::format("{}=\"{}\": must be {}", a.name, value, range));
    };
    switch (a.kind) {
      case Kind::text:
        return;
      case Kind::name:
        return allowed(*value != '\0', "a name");
      case Kind::number:
        return void(numbers(e, a.name, 1));
      case Kind::positive:
        return allowed(numbers(e, a.name, 1)[0] > 0, "> 0");
      case Kind::not_negative:
        return allowed(numbers(e, a.name, 1)[0] >= 0, ">= 0");
      case Kind::triple:
        return void(numbers(e, a.name, 3));
      case Kind::sizes: {
        // 0 0 0 is what generators write for a link without a body; it makes no shape.
        const auto x = numbers(e, a.name, 3);
        const bool none = x[0] == 0 && x[1] == 0 && x[2] == 0;
        return allowed(none || (x[0] > 0 && x[1] > 0 && x[2] > 0), "three numbers > 0 (or 0 0 0 for no box)");
      }
    }
  }

  void element(const TiXmlElement& e, const Rule& rule) const {
    for (const TiXmlAttribute* a = e.FirstAttribute(); a; a = a->Next())
      if (std::none_of(rule.attributes.begin(), rule.attributes.end(),
                       [&](const Attribute& r) { return a->NameTStr() == r.name; }))
        fail(e, "the attribute '" + std::string(a->Name()) + "' is not known here");
    for (const Attribute& a : rule.attributes) attribute(e, a);
    children(e);
  }

  void children(const TiXmlElement& e) const {
    std::map<std::string, int> count;
    for (const TiXmlElement* c = e.FirstChildElement(); c; c = c->NextSiblingElement()) {
      if (isForeign(e.ValueStr(), c->ValueStr())) continue;
      const auto rule = std::find_if(rules().begin(), rules().end(), [&](const Rule& r) {
        return e.ValueStr() == r.parent && c->ValueStr() == r.name;
      });
      if (rule == rules().end()) fail(*c, "is not known in <" + e.ValueStr() + ">");
      if (++count[c->ValueStr()] > rule->most) fail(*c, "stands twice in <" + e.ValueStr() + ">");
      element(*c, *rule);
    }
    for (const Rule& r : rules())
      if (e.ValueStr() == r.parent && count[r.name] < r.least)
        fail(e, std::string("has no <").append(r.name).append(">"));
    if (e.ValueStr() == "geometry" &&
        count.size() - std::count_if(count.begin(), count.end(), [](auto& c) { return c.second == 0; }) != 1)
      fail(e, "needs exactly one of box, cylinder, sphere, mesh");
  }

  void joint(const TiXmlElement& j) const {
    const std::string type = j.Attribute("type");
    const std::set<std::string> known{"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};
    if (!known.contains(type)) fail(j, "the type '" + type + "' is not known");
    if (type == "planar") fail(j, "planar joints are not supported; use two prismatic and a revolute joint");
    const TiXmlElement *limit = j.FirstChildElement("limit"), *axis = j.FirstChildElement("axis");
    if (axis && type != "fixed" && type != "floating") {  // generators write 0 0 0 where there is nothing to turn
      const auto x = numbers(*axis, "xyz", 3);
      if (!(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] > 1e-12))
        fail(*axis, fmt::format("xyz=\"{}\": must be longer than 1e-6", axis->Attribute("xyz")));
    }
    if (type == "revolute" || type == "prismatic") {
      if (!limit) fail(j, "a " + type + " joint needs a <limit>");
      for (const char* end : {"lower", "upper"})
        if (!limit->Attribute(end)) fail(*limit, std::string("has no ").append(end));
      const double lower = numbers(*limit, "lower", 1)[0], upper = numbers(*limit, "upper", 1)[0];
      if (lower > upper) fail(*limit, fmt::format("lower {} is above upper {}", lower, upper));
    }
  }
};

const char* linkIn(const TiXmlElement& joint, const char* end) {
  return joint.FirstChildElement(end)->Attribute("link");
}

}  // namespace

void parseXml(TiXmlDocument& document, const std::string& text, const std::string& file) {
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
    throw InputError({file, 0, ""}, "is not XML: it holds a zero byte");
  // tinyxml recurses: count the depth first.
  int depth = 0, line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') ++line;
    if (text[i] != '<') continue;
    const auto skipTo = [&](std::string_view end) {
      const std::size_t stop = std::min(text.find(end, i), text.size());
      line += static_cast<int>(std::count(text.begin() + i, text.begin() + stop, '\n'));
      i = stop;
    };
    if (text.compare(i, 4, "<!--") == 0)
      skipTo("-->");
    else if (text.compare(i, 9, "<![CDATA[") == 0)
      skipTo("]]>");
    else if (text.compare(i, 2, "</") == 0)
      --depth;
    else if (text.compare(i, 2, "<?") != 0 && text.compare(i, 2, "<!") != 0) {
      char quote = 0;
      for (++i; i < text.size() && (quote || text[i] != '>'); ++i) {
        if (text[i] == '\n') ++line;
        if (quote ? text[i] == quote : text[i] == '"' || text[i] == '\'') quote = quote ? 0 : text[i];
      }
      if (i > 0 && i < text.size() && text[i - 1] != '/') ++depth;
    }
    if (depth > deepest) throw InputError({file, line, ""}, fmt::format("is nested deeper than {} elements", deepest));
  }
  // Whatever tinyxml makes of it happens to another process first.
  readApart(file, limitsFor(file), [&](BytesOut&) { TiXmlDocument().Parse(text.c_str()); });
  document.Parse(text.c_str());
  if (document.Error())
    throw InputError({file, document.ErrorRow(), ""}, std::string("is not XML: ") + document.ErrorDesc());
  if (!document.RootElement()) throw InputError({file, 0, ""}, "holds no element");
}

int lineOf(const TiXmlDocument& document, const char* element, const std::string& name) {
  for (const TiXmlElement* e = document.RootElement()->FirstChildElement(element); e;
       e = e->NextSiblingElement(element))
    if (name == e->Attribute("name")) return e->Row();
  return 0;
}

UrdfOrder checkUrdf(const TiXmlDocument& document, const std::string& file) {
  const Checker check{file};
  const TiXmlElement& robot = *document.RootElement();
  if (robot.ValueStr() != "robot") check.fail(robot, "the root element must be <robot>");
  if (const TiXmlElement* second = robot.NextSiblingElement()) check.fail(*second, "stands after </robot>");
  check.element(robot, rules().front());

  std::map<std::string, const TiXmlElement*> links, joints, parent_of;  // parent_of: link to the joint above it
  for (const TiXmlElement* l = robot.FirstChildElement("link"); l; l = l->NextSiblingElement("link"))
    if (const auto [at, fresh] = links.try_emplace(l->Attribute("name"), l); !fresh)
      check.fail(*l, fmt::format("the name stands already in line {}", at->second->Row()));
    else if (links.size() > most_links)
      check.fail(*l, fmt::format("is one link too many: at most {} are read", most_links));
  std::map<std::string, std::vector<const TiXmlElement*>> below;
  for (const TiXmlElement* j = robot.FirstChildElement("joint"); j; j = j->NextSiblingElement("joint")) {
    check.joint(*j);
    if (const auto [at, fresh] = joints.try_emplace(j->Attribute("name"), j); !fresh)
      check.fail(*j, fmt::format("the name stands already in line {}", at->second->Row()));
    for (const char* end : {"parent", "child"})
      if (!links.contains(linkIn(*j, end)))
        check.fail(*j, fmt::format("its {} '{}' is not a link", end, linkIn(*j, end)));
    if (std::string(linkIn(*j, "parent")) == linkIn(*j, "child")) check.fail(*j, "joins a link to itself");
    if (const auto [at, fresh] = parent_of.try_emplace(linkIn(*j, "child"), j); !fresh)
      check.fail(*j, fmt::format("its child '{}' already hangs on the joint in line {}", linkIn(*j, "child"),
                                 at->second->Row()));
    below[linkIn(*j, "parent")].push_back(j);
  }

  // Mimic joints lead, perhaps through others, to a joint that moves by itself.
  for (const auto& [name, j] : joints) {
    const TiXmlElement* at = j;
    for (std::size_t steps = 0; const TiXmlElement* m = at->FirstChildElement("mimic"); ++steps) {
      const auto next = joints.find(m->Attribute("joint"));
      if (next == joints.end())
        check.fail(*at, fmt::format("follows '{}', which is not a joint", m->Attribute("joint")));
      at = next->second;
      if (steps >= joints.size()) check.fail(*j, "follows itself, by way of other mimic joints");
    }
    const std::string type = at->Attribute("type");
    if (at != j && (type == "fixed" || type == "floating")) check.fail(*j, "follows a joint that has no value");
  }

  UrdfOrder order;
  for (const TiXmlElement* l = robot.FirstChildElement("link"); l; l = l->NextSiblingElement("link")) {
    if (parent_of.contains(l->Attribute("name"))) continue;
    if (!order.root.empty()) check.fail(*l, "is a second root beside '" + order.root + "'");
    order.root = l->Attribute("name");
  }
  if (order.root.empty()) check.fail(robot, "has no root: every link is the child of a joint, in a cycle");
  std::vector<const TiXmlElement*> open(below[order.root].rbegin(), below[order.root].rend());
  while (!open.empty()) {
    const TiXmlElement* j = open.back();
    open.pop_back();
    order.joints.push_back(j->Attribute("name"));
    const auto& next = below[linkIn(*j, "child")];
    open.insert(open.end(), next.rbegin(), next.rend());
  }
  if (order.joints.size() < joints.size())
    for (const auto& [name, j] : joints)
      if (std::find(order.joints.begin(), order.joints.end(), name) == order.joints.end())
        check.fail(*j, "is part of a cycle that hangs on nothing");
  for (const std::string& name : order.joints)
    if (std::string(joints[name]->Attribute("type")) == "floating" &&
        (linkIn(*joints[name], "parent") != order.root || joints.size() == 0 || below[order.root].size() != 1))
      check.fail(*joints[name], "floating joints are only supported between the root and its only child");
  return order;
}

}  // namespace gambeson
